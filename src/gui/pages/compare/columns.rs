//! The runs side by side: what each is called, its picture, how far it is, and how long it took.

use egui::text::LayoutJob;
use egui::{
    Align, Color32, Layout, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, UiBuilder, WidgetInfo, pos2, vec2,
};

use super::{CompareColumn, MOST, adding};
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button};
use crate::language::{Language, say, word};
use crate::sim::Change;
use crate::time::Time;
use crate::view::{ComparedRun, Layer, duration, fraction, percent};

/// What is to be done with a run.
pub enum ColumnAction {
    /// Take it away.
    Remove(usize),
    /// The same with one thing changed.
    Fork(usize, Change),
}

/// What stands above and below a picture.
const ABOVE: f32 = 5.0 * GRID;
const BELOW: f32 = 5.0 * GRID;
/// In a narrower column there is no room for words on a button.
const WIDE: f32 = 36.0 * GRID;

/// The letter of a run.
pub fn letter(place: usize) -> char {
    char::from(b'A' + place.min(25) as u8)
}

/// Shows all columns; a click on a picture makes its run one of the `pair` of which is told why they differ.
pub fn show(
    ui: &mut Ui,
    entries: &mut [CompareColumn],
    now: Time,
    length: Time,
    (pair, below): (&mut [usize; 2], f32),
    look: Look,
    language: Language,
) -> Option<ColumnAction> {
    let gap = 2.0 * GRID;
    let count = entries.len().max(1) as f32;
    let area = ui.available_rect_before_wrap();
    let wide = ((area.width() - gap * (count - 1.0)) / count).max(1.0);
    let aspect = entries.first().map_or(0.75, |entry| {
        let size = entry.trial.header.size;
        size.height() as f32 / size.width() as f32
    });
    // What explains them needs its room below; where that makes pictures small, they stand in the middle of columns that
    // are not much wider.
    let high = (wide * aspect).min(area.height() - ABOVE - BELOW - below).max(8.0 * GRID);
    let wide = wide.min((1.4 * high / aspect).max(30.0 * GRID));
    let (mut asked, many) = (None, entries.len() > 2);
    let is_full = entries.len() >= MOST;
    for (place, entry) in entries.iter_mut().enumerate() {
        let left = area.left() + place as f32 * (wide + gap);
        let column = Rect::from_min_size(pos2(left, area.top()), vec2(wide, ABOVE + high + BELOW));
        let chosen = pair.iter().position(|&one| one == place);
        let row = column.with_max_y(column.top() + ABOVE - 0.5 * GRID);
        asked = asked.or(heading(ui, row, (place, entry), (many, is_full, now), chosen.is_some(), look, language));
        let frame = Rect::from_min_size(pos2(left, column.top() + ABOVE), vec2(wide, high));
        let response = picture(ui, frame, (place, entry), chosen.is_some(), look, language);
        if response.clicked() && chosen.is_none() {
            // The one that was chosen last stays.
            *pair = [pair[1], place];
        }
        let below = Rect::from_min_size(frame.left_bottom(), vec2(wide, BELOW));
        bar(ui, below, entry.contender.as_deref(), now, length, look, language);
    }
    ui.allocate_rect(Rect::from_min_size(area.min, vec2(area.width(), ABOVE + high + BELOW)), Sense::hover());
    asked
}

/// What it is called, and what can be done with it.
fn heading(
    ui: &mut Ui,
    row: Rect,
    (place, entry): (usize, &CompareColumn),
    (can_go, is_full, now): (bool, bool, Time),
    is_chosen: bool,
    look: Look,
    language: Language,
) -> Option<ColumnAction> {
    let mut asked = None;
    let end = entry.contender.as_ref().and_then(|run| run.end());
    let fork_at = (now > Time::ZERO && end.is_none_or(|end| now < end)).then_some(now);
    let layout = Layout::right_to_left(Align::Center);
    ui.scope_builder(UiBuilder::new().max_rect(row).layout(layout), |ui| {
        ui.spacing_mut().item_spacing.x = GRID / 2.0;
        let letter = letter(place);
        let remove = say!(language, "Take {letter} away", "Retirar {letter}");
        if can_go && button(ui, Some(Icon::Close), &remove, false, Emphasis::Quiet).clicked() {
            asked = Some(ColumnAction::Remove(place));
        }
        if !is_full
            && let Some(change) = adding::changes(ui, letter, &entry.trial, fork_at, row.width() > WIDE, look, language)
        {
            asked = Some(ColumnAction::Fork(place, change));
        }
        let left = Layout::left_to_right(Align::Center);
        ui.with_layout(left, |ui| {
            let ground = if is_chosen { look.accent } else { look.raised };
            let (chip, _) = ui.allocate_exact_size(vec2(3.0 * GRID, 3.0 * GRID), Sense::hover());
            ui.painter().rect_filled(chip, 4.0, ground);
            let colour = if is_chosen { look.on_accent } else { look.text };
            let font = theme::strong(theme::BODY);
            ui.painter().text(chip.center(), egui::Align2::CENTER_CENTER, letter, font, colour);
            name(ui, &entry.name(language), look);
        });
    });
    asked
}

/// A run's name: in two small lines where it needs them, and all of it for whoever rests on it.
fn name(ui: &mut Ui, name: &str, look: Look) {
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    let fitted = |size, rows| {
        let mut job = LayoutJob::simple(name.to_owned(), theme::strong(size), look.text, rect.width());
        job.wrap.max_rows = rows;
        ui.painter().layout_job(job)
    };
    let large = fitted(theme::BODY, 1);
    let galley = if large.elided { fitted(theme::SMALL, 2) } else { large };
    ui.painter().galley(pos2(rect.left(), rect.center().y - galley.size().y / 2.0), galley, look.text);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, name));
    response.on_hover_text(name);
}

/// Its picture, as far as it is.
fn picture(
    ui: &mut Ui,
    frame: Rect,
    (place, entry): (usize, &mut CompareColumn),
    is_chosen: bool,
    look: Look,
    language: Language,
) -> Response {
    let response = ui.interact(frame, ui.scope_id().with(("contender", entry.id)), Sense::click());
    ui.painter().rect_filled(frame, 0.0, look.raised);
    let letter = letter(place);
    let hint = word!(language, "Click: why does it differ from the other?", "Clique: por que difere da outra?");
    if let Some(contender) = &mut entry.contender {
        let ground = theme::rgb(look.ground);
        let canvas = contender.canvas((Layer::Owners, 0.6), ground);
        if let Some(texture) = entry.texture.upload(ui.ctx(), canvas, false) {
            let size = entry.trial.header.size;
            let aspect = size.width() as f32 / size.height() as f32;
            let wide = frame.width().min(frame.height() * aspect);
            let fitted = Rect::from_center_size(frame.center(), vec2(wide, wide / aspect));
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter().image(texture, fitted, whole, Color32::WHITE);
        }
        let (done, all) = (contender.snapshot().state.done(), contender.snapshot().state.atoms());
        response.widget_info(|| {
            let name = &contender.name;
            let share = percent(done, all);
            let words =
                say!(language, "{letter}, {name}: {share} of the picture", "{letter}, {name}: {share} da imagem");
            WidgetInfo::selected(Role::Button, true, is_chosen, words)
        });
    } else {
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{letter}")));
    }
    if is_chosen || response.hovered() || response.has_focus() {
        let colour = if is_chosen { look.accent } else { look.quiet };
        ui.painter().rect_stroke(frame, 0.0, Stroke::new(2.0, colour), StrokeKind::Outside);
    }
    response.on_hover_text(hint)
}

/// How far it is, on a line that is as long as the longest run; its time once it is over.
fn bar(ui: &Ui, rect: Rect, contender: Option<&ComparedRun>, now: Time, length: Time, look: Look, language: Language) {
    let Some(contender) = contender else { return };
    let rail = Rect::from_min_size(rect.left_top() + vec2(0.0, GRID), vec2(rect.width(), 6.0));
    let x = |time: Time| rail.left() + rail.width() * (time.secs() / length.secs().max(f64::MIN_POSITIVE)) as f32;
    let painter = ui.painter();
    painter.rect_filled(rail, 3.0, look.hairline.gamma_multiply(0.5));
    let end = contender.end();
    let until = end.unwrap_or(length);
    painter.rect_filled(rail.with_max_x(x(until)), 3.0, look.hairline);
    painter.rect_filled(rail.with_max_x(x(now.min(until))), 3.0, look.accent);
    let base = pos2(rail.left(), rail.bottom() + 0.5 * GRID);
    let (large, small) = (theme::strong(theme::BODY), theme::regular(theme::SMALL));
    let state = &contender.snapshot().state;
    let is_over = end.is_some_and(|end| now >= end);
    let (first, colour) = match &contender.budget {
        Some(account) if is_over => (duration(account.makespan, language), look.text),
        None if now >= length => (word!(language, "never ends", "nunca termina").to_owned(), look.trouble),
        _ => (percent(state.done(), state.atoms()), look.quiet),
    };
    painter.text(base, egui::Align2::LEFT_TOP, first, large, colour);
    if let Some(account) = contender.budget.as_ref().filter(|_| is_over) {
        let efficiency = fraction(account.efficiency());
        let words = say!(language, "efficiency {efficiency}", "eficiência {efficiency}");
        painter.text(pos2(rail.right(), base.y + 2.0), egui::Align2::RIGHT_TOP, words, small, look.quiet);
    }
}
