//! The table of machines: number, speed, progress, atoms, idle time and activity of each machine.

mod row_layout;

use egui::{Align2, Color32, Rect, Response, ScrollArea, Sense, Stroke, StrokeKind, Ui, UiBuilder, Vec2, pos2, vec2};

use crate::balance::NodeId;
use crate::gui::input::machine_menu;
use crate::gui::input::selection::Selection;
use crate::gui::input::speed_slider::{self, recorded_hint};
use crate::gui::session::{Phase, Session};
use crate::gui::settings::undo::Gesture;
use crate::gui::widgets;
use crate::gui::widgets::explained::explain_at;
use crate::gui::widgets::icons::{self, Icon};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, say, word};
use crate::palette::text_on;
use crate::view::{
    Activity, Definition, Highlight, NodeRow, Subject, activity_word, count, fraction, node_name, node_rows,
    rate_number, row_words,
};
use row_layout::{RowGrid, RowLayout};

/// Returns the height of the panel for this number of machines in this width, in points: at most `room`, which leaves
/// the ring large, or a part of the window. Then rows come closer, and at last they scroll.
pub fn height(ui: &Ui, width: f32, nodes: usize, room: f32) -> f32 {
    let part = if RowGrid::are_many(nodes) { 0.19 } else { 0.24 };
    let most = room.max(part * ui.ctx().content_rect().height()).max(9.0 * GRID);
    RowGrid::new(nodes, [width - 4.0 * GRID, most]).usual_height().min(most)
}

/// Shows all rows, in as many columns as fit. A click on a row selects its machine.
pub fn show(ui: &mut Ui, session: &mut Session, selection: &mut Selection, highlight: &Highlight) {
    let language = session.language();
    let look = Look::of(ui.ctx());
    let rows = node_rows(session.stage().state(), session.now());
    let grid = RowGrid::new(rows.len(), ui.available_size().into());
    // Where rows scroll, the wheel must not change a speed under the mouse.
    let takes_wheel = grid.height() <= ui.available_height() + 1.0;
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let (area, _) = ui.allocate_exact_size(vec2(ui.available_width(), grid.height()), Sense::hover());
        for column in 0..grid.columns {
            let corner = area.min + vec2(grid.left(column), 0.0);
            head(
                ui,
                &RowLayout::new(Rect::from_min_size(corner, vec2(grid.width, grid.head())), grid.density),
                look,
                language,
            );
        }
        for (i, row) in rows.iter().enumerate() {
            let corner = area.min + vec2(grid.left(i / grid.lines), grid.head() + (i % grid.lines) as f32 * grid.row);
            let layout = RowLayout::new(Rect::from_min_size(corner, vec2(grid.width, grid.row)), grid.density);
            let is_highlighted = highlight.nodes.contains(&row.node);
            let is_selected = selection.node() == Some(row.node);
            let response = background(ui, &layout, row, (is_selected, is_highlighted), look, language);
            if response.hovered() {
                selection.hover(Subject::Node(row.node));
            }
            if response.clicked() {
                selection.toggle(Subject::Node(row.node));
            }
            figures(ui, &layout, row, session, look);
            controls(ui, &layout, row.node, (session, takes_wheel), look);
            machine_menu::on(&response, session, selection, row.node, look);
            let place = (layout.activity, layout.row);
            machine_menu::on_activity(ui, place, (session, selection), row, look);
        }
    });
}

/// Paints the captions of the columns, which explain themselves.
fn head(ui: &Ui, layout: &RowLayout, look: Look, language: Language) {
    let y = layout.row.center().y;
    let caption = |x: f32, anchor, text: &str, definition| {
        let place = ui.painter().text(pos2(x, y), anchor, text, theme::regular(theme::SMALL), look.quiet);
        explain_at(ui, (place, layout.row.left() as i32), definition, language);
    };
    let named = |x, anchor, definition: Definition| caption(x, anchor, definition.name(language), definition);
    named(layout.slider.left(), Align2::LEFT_CENTER, Definition::SPEED);
    if let Some(bar) = layout.bar {
        named(bar.left(), Align2::LEFT_CENTER, Definition::DONE_AND_LEFT);
    }
    if let Some(x) = layout.rate {
        let is_tight = x - layout.left < 7.0 * GRID;
        let rate = if is_tight { word!(language, "atoms/s", "át./s") } else { Definition::RATE.name(language) };
        caption(x, Align2::RIGHT_CENTER, rate, Definition::RATE);
    }
    for (x, definition) in
        [(layout.done, Definition::DONE), (Some(layout.left), Definition::LEFT), (layout.idle, Definition::IDLE)]
    {
        if let Some(x) = x {
            named(x, Align2::RIGHT_CENTER, definition);
        }
    }
    named(layout.activity, Align2::LEFT_CENTER, Definition::NOW_COLUMN);
}

/// Paints the background of a row, which shows selection and highlight, and names the row for screen readers.
fn background(
    ui: &Ui,
    layout: &RowLayout,
    row: &NodeRow,
    (is_selected, is_highlighted): (bool, bool),
    look: Look,
    language: Language,
) -> Response {
    let name = node_name(row.node);
    let response = ui.interact(layout.row, ui.scope_id().with(("row", row.node)), Sense::click());
    widgets::describe(&response, &say!(language, "Machine {name}", "Máquina {name}"), || {
        let selected = if is_selected { word!(language, ", selected", ", selecionada") } else { "" };
        let (done, left, activity) = (row.done, row.left + row.lost, row_words(row, language));
        say!(
            language,
            "{done} atoms done, {left} left, {activity}{selected}",
            "átomos feitos: {done}, restantes: {left}, {activity}{selected}"
        )
    });
    if is_selected || is_highlighted {
        let rect = layout.row.expand2(vec2(0.5 * GRID, -0.5));
        ui.painter().rect_filled(rect, 6.0, look.raised.gamma_multiply(0.5));
        if is_selected {
            ui.painter().rect_stroke(rect, 6.0, Stroke::new(1.5, look.text), StrokeKind::Inside);
        }
    }
    response
}

/// Paints number, figures, activity and progress of a machine.
fn figures(ui: &Ui, layout: &RowLayout, row: &NodeRow, session: &Session, look: Look) {
    let language = session.language();
    let own = session.stage().colours[usize::from(row.node)];
    let (y, colour) = (layout.row.center().y, theme::colour(own));
    let painter = ui.painter();
    let chip = Rect::from_center_size(
        pos2(layout.row.left() + 1.5 * GRID, y),
        vec2(layout.side().max(2.5 * GRID), layout.side()),
    );
    painter.rect_filled(chip, 6.0, colour);
    let on_chip = theme::colour(text_on(own));
    let name = node_name(row.node).to_string();
    let size = if layout.is_small { theme::SMALL } else { theme::BODY };
    painter.text(chip.center(), Align2::CENTER_CENTER, name, theme::strong(size), on_chip);
    let number = |x: Option<f32>, text: String, colour: Color32| {
        if let Some(x) = x {
            painter.text(pos2(x, y), Align2::RIGHT_CENTER, text, theme::regular(size), colour);
        }
    };
    let ink = |stands_out: bool| if stands_out { look.text } else { look.quiet };
    number(layout.done, count(row.done), look.text);
    if row.lost > 0 {
        number(Some(layout.left), count(row.lost), look.trouble);
    } else {
        number(Some(layout.left), count(row.left), ink(row.left > 0));
    }
    number(layout.rate, rate_number(row.rate, language), ink(row.rate > 0.0));
    number(layout.idle, fraction(row.idle), look.text);
    let is_calm = row.activity.is_out() || matches!(row.activity, Activity::Idle | Activity::NoBand | Activity::Done);
    let now = pos2(layout.activity, y);
    // Where a row has no room for all, the activity alone.
    let (words, activity) = (row_words(row, language), activity_word(row.activity, language).to_owned());
    let words_ink = if row.lost > 0 { look.trouble } else { ink(!is_calm) };
    let layouts = [(&words, size), (&words, theme::SMALL), (&activity, size), (&activity, theme::SMALL)]
        .map(|(words, size)| painter.layout_no_wrap(words.clone(), theme::regular(size), words_ink));
    let [.., least] = &layouts;
    let galley = layouts.iter().find(|galley| now.x + galley.size().x <= layout.row.right()).unwrap_or(least).clone();
    painter.galley(now - vec2(0.0, galley.size().y / 2.0), galley, look.text);
    if let Some(bar) = layout.bar {
        let upto = |share: f32| bar.with_max_x(bar.left() + bar.width() * share);
        painter.rect_filled(upto(row.left_bar), 4.0, colour.gamma_multiply(0.28));
        painter.rect_filled(upto(row.done_bar), 4.0, colour);
    }
}

/// Shows slider, number field and pause button of a machine's speed.
fn controls(ui: &mut Ui, layout: &RowLayout, node: NodeId, (session, takes_wheel): (&mut Session, bool), look: Look) {
    let language = session.language();
    let name = node_name(node);
    let enabled = !session.is_recorded();
    let can_pause = enabled && session.stage().phase == Phase::Running;
    let at = |rect: Rect, salt: &str| UiBuilder::new().max_rect(rect).id_salt((salt, node));
    let width = layout.slider.width();
    ui.scope_builder(at(layout.slider, "slider"), |ui| speed_slider::show(ui, node, width, session, takes_wheel));
    // The column has room for one decimal.
    let before = (session.speed(node) * 1e3).round() / 10.0;
    let mut percent = before;
    ui.scope_builder(at(layout.speed, "value"), |ui| {
        ui.add_enabled_ui(enabled, |ui| {
            let name = say!(language, "Exact speed of machine {name}", "Velocidade exata da máquina {name}");
            let width = layout.speed.width();
            let field = widgets::number_field(ui, &mut percent, 0.0..=100.0, " %", width, (&name, language));
            field.on_disabled_hover_text(recorded_hint(language));
        });
    });
    if percent != before {
        session.change(Gesture::Speed(node), |settings| settings.set_speed(node, percent / 100.0));
    }
    let paused = session.is_node_paused(node);
    let response = ui.interact(layout.pause, ui.scope_id().with(("pause", node)), Sense::click());
    response.widget_info(|| {
        let name = say!(language, "Pause machine {name}", "Pausar a máquina {name}");
        egui::WidgetInfo::selected(egui::Role::Button, can_pause, paused, name)
    });
    let (icon, ink) = match (paused, response.hovered() || response.has_focus()) {
        _ if !can_pause => (Icon::Pause, look.hairline),
        (true, _) => (Icon::Play, look.accent),
        (false, true) => (Icon::Pause, look.text),
        (false, false) => (Icon::Pause, look.quiet),
    };
    icons::paint(ui.painter(), icon, Rect::from_center_size(layout.pause.center(), Vec2::splat(1.75 * GRID)), ink);
    let hint = if !enabled {
        recorded_hint(language)
    } else if paused {
        word!(language, "Resume this machine", "Retomar esta máquina")
    } else {
        word!(language, "Pause this machine", "Pausar esta máquina")
    };
    if widgets::hint_above(response, hint).clicked() && can_pause {
        session.toggle_node_pause(node);
    }
}
