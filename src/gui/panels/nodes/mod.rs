//! A row a node: its number and colour, its speed to drag or to type, what it has done and has left, and what it does.

mod row_layout;

use egui::{Align2, Color32, Rect, Response, ScrollArea, Sense, Stroke, StrokeKind, Ui, UiBuilder, Vec2, pos2, vec2};

use crate::balance::NodeId;
use crate::gui::input::machine_menu;
use crate::gui::input::selection::Selection;
use crate::gui::session::{Phase, Session};
use crate::gui::settings::undo::Gesture;
use crate::gui::widgets;
use crate::gui::widgets::icons::{self, Icon};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, say, word};
use crate::palette::text_on;
use crate::view::{
    Activity, Highlight, NodeRow, Subject, activity_word, count, fraction, node_name, node_rows, rate_number,
};
use row_layout::{HEAD, RowGrid, RowLayout};

/// How high the panel of so many nodes is to be: beyond a third of the window the rows scroll.
pub fn height(ui: &Ui, nodes: usize) -> f32 {
    let grid = RowGrid::new(nodes, ui.available_width() - 4.0 * GRID);
    let most = if grid.is_dense() { 0.36 } else { 0.3 } * ui.ctx().content_rect().height();
    grid.height().min(most.max(HEAD + grid.row))
}

/// Shows all rows, in as many columns as there is room for. A click on a row selects its node.
pub fn show(ui: &mut Ui, session: &mut Session, focus: &mut Selection, lit: &Highlight) {
    let language = session.language();
    let look = Look::of(ui.ctx());
    let rows = node_rows(session.stage().state(), session.now());
    let grid = RowGrid::new(rows.len(), ui.available_width());
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), grid.height()), Sense::hover());
        for column in 0..grid.columns {
            let corner = area.min + vec2(grid.left(column), 0.0);
            head(
                ui,
                &RowLayout::new(Rect::from_min_size(corner, vec2(grid.width, HEAD)), grid.is_dense()),
                look,
                language,
            );
        }
        for (i, row) in rows.iter().enumerate() {
            let corner = area.min + vec2(grid.left(i / grid.lines), HEAD + (i % grid.lines) as f32 * grid.row);
            let places = RowLayout::new(Rect::from_min_size(corner, vec2(grid.width, grid.row)), grid.is_dense());
            let is_lit = lit.nodes.contains(&row.node);
            let response = background(ui, &places, row, (focus.node() == Some(row.node), is_lit), look, language);
            if response.hovered() {
                focus.hover(Subject::Node(row.node));
            }
            if response.clicked() {
                focus.toggle(Subject::Node(row.node));
            }
            facts(ui, &places, row, session, look);
            controls(ui, &places, row.node, session, look);
            machine_menu::on(&response, session, row.node, look);
            machine_menu::on_state(ui, (places.activity, places.row), session, row, look);
        }
    });
}

fn head(ui: &Ui, places: &RowLayout, look: Look, language: Language) {
    let y = places.row.center().y;
    let words = |x: f32, anchor, text: &str| {
        ui.painter().text(pos2(x, y), anchor, text, theme::regular(theme::SMALL), look.quiet);
    };
    words(places.slider.left(), Align2::LEFT_CENTER, word!(language, "speed", "velocidade"));
    if let Some(bar) = places.bar {
        words(bar.left(), Align2::LEFT_CENTER, word!(language, "progress", "progresso"));
    }
    let is_tight = places.rate.is_some_and(|rate| rate - places.left < 7.0 * GRID);
    let rate = if is_tight { word!(language, "atoms/s", "át./s") } else { word!(language, "atoms/s", "átomos/s") };
    for (x, text) in [
        (places.done, word!(language, "done", "feitos")),
        (Some(places.left), word!(language, "left", "restam")),
        (places.rate, rate),
        (places.idle, word!(language, "idle", "ociosa")),
    ] {
        if let Some(x) = x {
            words(x, Align2::RIGHT_CENTER, text);
        }
    }
    words(places.activity, Align2::LEFT_CENTER, word!(language, "now", "agora"));
}

/// What lies under a row: its name for those who cannot see it, and what tells that it is selected or stands out.
fn background(
    ui: &Ui,
    places: &RowLayout,
    row: &NodeRow,
    (selected, is_lit): (bool, bool),
    look: Look,
    language: Language,
) -> Response {
    let name = node_name(row.node);
    let response = ui.interact(places.row, ui.scope_id().with(("row", row.node)), Sense::click());
    widgets::describe(&response, &say!(language, "Node {name}", "Máquina {name}"), || {
        let selected = if selected { word!(language, ", selected", ", selecionada") } else { "" };
        let (done, left, does) = (row.done, row.left, activity_word(row.activity, language));
        say!(
            language,
            "{done} atoms done, {left} left, {does}{selected}",
            "átomos feitos: {done}, restantes: {left}, {does}{selected}"
        )
    });
    if selected || is_lit {
        let place = places.row.expand2(vec2(0.5 * GRID, -0.5));
        ui.painter().rect_filled(place, 6.0, look.raised.gamma_multiply(0.5));
        if selected {
            ui.painter().rect_stroke(place, 6.0, Stroke::new(1.5, look.text), StrokeKind::Inside);
        }
    }
    response
}

fn facts(ui: &Ui, places: &RowLayout, row: &NodeRow, session: &Session, look: Look) {
    let language = session.language();
    let own = session.stage().colours[usize::from(row.node)];
    let (y, colour) = (places.row.center().y, theme::colour(own));
    let painter = ui.painter();
    let chip = Rect::from_center_size(pos2(places.row.left() + 1.5 * GRID, y), Vec2::splat(places.side()));
    painter.rect_filled(chip, 6.0, colour);
    let ink = theme::colour(text_on(own));
    let name = node_name(row.node).to_string();
    let size = if places.is_dense { theme::SMALL } else { theme::BODY };
    painter.text(chip.center(), Align2::CENTER_CENTER, name, theme::strong(size), ink);
    let number = |x: Option<f32>, text: String, colour: Color32| {
        if let Some(x) = x {
            painter.text(pos2(x, y), Align2::RIGHT_CENTER, text, theme::regular(size), colour);
        }
    };
    let some = |is: bool| if is { look.text } else { look.quiet };
    number(places.done, count(row.done), look.text);
    number(Some(places.left), count(row.left), some(row.left > 0));
    number(places.rate, rate_number(row.rate, language), some(row.rate > 0.0));
    number(places.idle, fraction(row.idle), look.text);
    let calm = row.activity.is_out() || matches!(row.activity, Activity::Idle | Activity::NoBand | Activity::Done);
    let now = pos2(places.activity, y);
    painter.text(now, Align2::LEFT_CENTER, activity_word(row.activity, language), theme::regular(size), some(!calm));
    if let Some(bar) = places.bar {
        let upto = |share: f32| bar.with_max_x(bar.left() + bar.width() * share);
        painter.rect_filled(upto(row.left_bar), 4.0, colour.gamma_multiply(0.28));
        painter.rect_filled(upto(row.done_bar), 4.0, colour);
    }
}

fn controls(ui: &mut Ui, places: &RowLayout, node: NodeId, session: &mut Session, look: Look) {
    let language = session.language();
    let name = node_name(node);
    let enabled = !session.is_recorded();
    let goes_on = enabled && session.stage().phase == Phase::Running;
    let at = |place: Rect, salt: &str| UiBuilder::new().max_rect(place).id_salt((salt, node));
    ui.scope_builder(at(places.slider, "slider"), |ui| speed_slider(ui, node, places.slider.width(), session));
    let before = (session.speed(node) * 100.0).round();
    let mut percent = before;
    ui.scope_builder(at(places.speed, "value"), |ui| {
        ui.add_enabled_ui(enabled, |ui| {
            let name = say!(language, "Exact speed of node {name}", "Velocidade exata da máquina {name}");
            widgets::number(ui, &mut percent, 0.0..=100.0, " %", places.speed.width(), &name);
        });
    });
    if percent != before {
        session.change(Gesture::Speed(node), |settings| settings.set_speed(node, percent / 100.0));
    }
    let paused = session.is_node_paused(node);
    let response = ui.interact(places.pause, ui.scope_id().with(("pause", node)), Sense::click());
    response.widget_info(|| {
        let name = say!(language, "Pause node {name}", "Pausar a máquina {name}");
        egui::WidgetInfo::selected(egui::Role::Button, goes_on, paused, name)
    });
    let (icon, ink) = match (paused, response.hovered() || response.has_focus()) {
        _ if !goes_on => (Icon::Pause, look.hairline),
        (true, _) => (Icon::Play, look.accent),
        (false, true) => (Icon::Pause, look.text),
        (false, false) => (Icon::Pause, look.quiet),
    };
    icons::paint(ui.painter(), icon, Rect::from_center_size(places.pause.center(), Vec2::splat(1.75 * GRID)), ink);
    let hint = if paused {
        word!(language, "Let it go on", "Retomar esta máquina")
    } else {
        word!(language, "Let this machine stand still", "Parar esta máquina")
    };
    if response.on_hover_text(hint).clicked() && goes_on {
        session.toggle_node_pause(node);
    }
}

/// The slider of a machine's speed.
pub fn speed_slider(ui: &mut Ui, node: NodeId, width: f32, session: &mut Session) {
    let language = session.language();
    let colour = theme::colour(session.stage().colours[usize::from(node)]);
    let before = (session.speed(node) * 100.0).round();
    let mut percent = before;
    ui.add_enabled_ui(!session.is_recorded(), |ui| {
        let name = node_name(node);
        let name = say!(language, "Speed of node {name}", "Velocidade da máquina {name}");
        widgets::slider(ui, &mut percent, (0.0..=100.0, true), width, colour, &name);
    });
    if percent != before {
        session.change(Gesture::Speed(node), |settings| settings.set_speed(node, percent / 100.0));
    }
}
