//! The compared runs side by side: name, picture, progress, and time of each.

use egui::text::LayoutJob;
use egui::{
    Align, Color32, Layout, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, UiBuilder, WidgetInfo, pos2, vec2,
};

use super::{CompareColumn, MAX_RUNS, adding};
use crate::gui::widgets::explained::explain_at;
use crate::gui::widgets::icons::Icon;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::gui::widgets::{Emphasis, button};
use crate::language::{Language, say, word};
use crate::sim::Change;
use crate::time::Time;
use crate::view::{ComparedRun, Definition, Layer, duration, fraction, percent};

/// Action of a column's button; the index is the column's.
pub enum ColumnAction {
    /// Removes the run.
    Remove(usize),
    /// Adds the same run with one change.
    Fork(usize, Change),
}

/// Height of the heading above a picture, in points.
const HEADING_HEIGHT_PT: f32 = 5.0 * GRID;
/// Height of the progress below a picture, in points.
const PROGRESS_HEIGHT_PT: f32 = 5.0 * GRID;
/// Least width of a column whose button has a text, in points.
const MIN_TEXT_BUTTON_COLUMN_PT: f32 = 36.0 * GRID;

/// Returns the letter of a column.
pub fn letter(index: usize) -> char {
    char::from(b'A' + index.min(25) as u8)
}

/// Shows all columns. A click on a picture or on a letter puts its run into the `pair` whose difference is explained.
/// `below` is the height to leave below the columns. Returns the action of the pressed button.
pub fn show(
    ui: &mut Ui,
    columns: &mut [CompareColumn],
    now: Time,
    length: Time,
    (pair, below): (&mut [usize; 2], f32),
    look: Look,
    language: Language,
) -> Option<ColumnAction> {
    let gap = 2.0 * GRID;
    let count = columns.len().max(1) as f32;
    let area = ui.available_rect_before_wrap();
    let wide = ((area.width() - gap * (count - 1.0)) / count).max(1.0);
    let aspect = columns.first().map_or(0.75, |column| {
        let size = column.trial.header.size;
        size.height() as f32 / size.width() as f32
    });
    // The findings below need their room. Where that makes the pictures small, the columns are narrower too.
    let high = (wide * aspect).min(area.height() - HEADING_HEIGHT_PT - PROGRESS_HEIGHT_PT - below).max(8.0 * GRID);
    let wide = wide.min((1.4 * high / aspect).max(30.0 * GRID));
    let (mut action, many) = (None, columns.len() > 2);
    let is_full = columns.len() >= MAX_RUNS;
    for (index, column) in columns.iter_mut().enumerate() {
        let left = area.left() + index as f32 * (wide + gap);
        let top = area.top();
        let is_chosen = pair.contains(&index);
        let row = Rect::from_min_size(pos2(left, top), vec2(wide, HEADING_HEIGHT_PT - 0.5 * GRID));
        let (headed, is_chip_clicked) =
            heading(ui, row, (index, column), (many, is_full, now), is_chosen, look, language);
        action = action.or(headed);
        let frame = Rect::from_min_size(pos2(left, top + HEADING_HEIGHT_PT), vec2(wide, high));
        let response = picture(ui, frame, (index, column), is_chosen, look, language);
        if (response.clicked() || is_chip_clicked) && !is_chosen {
            // The run that was chosen last stays in the pair.
            *pair = [pair[1], index];
        }
        let below = Rect::from_min_size(frame.left_bottom(), vec2(wide, PROGRESS_HEIGHT_PT));
        progress(ui, below, column.run.as_deref(), now, length, look, language);
    }
    ui.allocate_rect(
        Rect::from_min_size(area.min, vec2(area.width(), HEADING_HEIGHT_PT + high + PROGRESS_HEIGHT_PT)),
        Sense::hover(),
    );
    action
}

/// Shows letter, name and buttons of a run. Returns the action of the pressed button, and whether the letter was
/// clicked.
fn heading(
    ui: &mut Ui,
    row: Rect,
    (index, column): (usize, &CompareColumn),
    (can_go, is_full, now): (bool, bool, Time),
    is_chosen: bool,
    look: Look,
    language: Language,
) -> (Option<ColumnAction>, bool) {
    let (mut action, mut is_clicked) = (None, false);
    let end = column.run.as_ref().and_then(|run| run.end());
    let fork_at = (now > Time::ZERO && end.is_none_or(|end| now < end)).then_some(now);
    let layout = Layout::right_to_left(Align::Center);
    ui.scope_builder(UiBuilder::new().max_rect(row).layout(layout), |ui| {
        ui.spacing_mut().item_spacing.x = GRID / 2.0;
        let letter = letter(index);
        let remove = say!(language, "Remove {letter}", "Retirar {letter}");
        if can_go && button(ui, Some(Icon::Close), &remove, false, Emphasis::Quiet).clicked() {
            action = Some(ColumnAction::Remove(index));
        }
        if !is_full
            && let Some(change) = adding::changes(
                ui,
                letter,
                &column.trial,
                fork_at,
                row.width() > MIN_TEXT_BUTTON_COLUMN_PT,
                look,
                language,
            )
        {
            action = Some(ColumnAction::Fork(index, change));
        }
        let left = Layout::left_to_right(Align::Center);
        ui.with_layout(left, |ui| {
            let ground = if is_chosen { look.accent } else { look.raised };
            let (chip, response) = ui.allocate_exact_size(vec2(3.0 * GRID, 3.0 * GRID), Sense::click());
            let choose = say!(language, "Choose {letter}", "Escolher {letter}");
            response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_chosen, &choose));
            ui.painter().rect_filled(chip, 4.0, ground);
            if response.hovered() || response.has_focus() {
                ui.painter().rect_stroke(chip, 4.0, Stroke::new(1.5, look.quiet), StrokeKind::Outside);
            }
            is_clicked = response.on_hover_text(choose_hint(language)).clicked();
            let colour = if is_chosen { look.on_accent } else { look.text };
            let font = theme::strong(theme::BODY);
            ui.painter().text(chip.center(), egui::Align2::CENTER_CENTER, letter, font, colour);
            name(ui, &column.name(language), look);
        });
    });
    (action, is_clicked)
}

fn choose_hint(language: Language) -> &'static str {
    word!(
        language,
        "Click: compare it with the run that was chosen last",
        "Clique: comparar com a execução escolhida por último"
    )
}

/// Shows the name of a run, in up to two lines; the tooltip has all of it.
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

/// Shows the picture of a run at the shown time.
fn picture(
    ui: &mut Ui,
    frame: Rect,
    (index, column): (usize, &mut CompareColumn),
    is_chosen: bool,
    look: Look,
    language: Language,
) -> Response {
    let response = ui.interact(frame, ui.scope_id().with(("compared run", column.id)), Sense::click());
    ui.painter().rect_filled(frame, 0.0, look.raised);
    let letter = letter(index);
    if let Some(run) = &mut column.run {
        let ground = theme::rgb(look.ground);
        let canvas = run.canvas((Layer::Owners, 0.6), ground);
        if let Some(texture) = column.texture.upload(ui.ctx(), canvas, false) {
            let size = column.trial.header.size;
            let aspect = size.width() as f32 / size.height() as f32;
            let wide = frame.width().min(frame.height() * aspect);
            let fitted = Rect::from_center_size(frame.center(), vec2(wide, wide / aspect));
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter().image(texture, fitted, whole, Color32::WHITE);
        }
        let (done, all) = (run.snapshot().state.done(), run.snapshot().state.atoms());
        response.widget_info(|| {
            let name = run.name(language);
            let share = percent(done, all);
            let text =
                say!(language, "{letter}, {name}: {share} of the picture", "{letter}, {name}: {share} da imagem");
            WidgetInfo::selected(Role::Button, true, is_chosen, text)
        });
    } else {
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{letter}")));
    }
    if is_chosen || response.hovered() || response.has_focus() {
        let colour = if is_chosen { look.accent } else { look.quiet };
        ui.painter().rect_stroke(frame, 0.0, Stroke::new(2.0, colour), StrokeKind::Outside);
    }
    response.on_hover_text(choose_hint(language))
}

/// Paints the progress of a run on a line as long as the longest run, and its makespan when it has ended.
fn progress(ui: &Ui, rect: Rect, run: Option<&ComparedRun>, now: Time, length: Time, look: Look, language: Language) {
    let Some(run) = run else { return };
    let rail = Rect::from_min_size(rect.left_top() + vec2(0.0, GRID), vec2(rect.width(), 6.0));
    let x = |time: Time| rail.left() + rail.width() * (time.secs() / length.secs().max(f64::MIN_POSITIVE)) as f32;
    let painter = ui.painter();
    painter.rect_filled(rail, 3.0, look.hairline.gamma_multiply(0.5));
    let end = run.end();
    let until = end.unwrap_or(length);
    painter.rect_filled(rail.with_max_x(x(until)), 3.0, look.hairline);
    painter.rect_filled(rail.with_max_x(x(now.min(until))), 3.0, look.accent);
    let base = pos2(rail.left(), rail.bottom() + 0.5 * GRID);
    let (large, small) = (theme::strong(theme::BODY), theme::regular(theme::SMALL));
    let state = &run.snapshot().state;
    let is_over = end.is_some_and(|end| now >= end);
    let (first, colour) = match &run.budget {
        Some(budget) if is_over => (duration(budget.makespan, language), look.text),
        None if now >= length => (word!(language, "never ends", "nunca termina").to_owned(), look.trouble),
        _ => {
            let share = percent(state.done(), state.atoms());
            (say!(language, "{share} done", "{share} feito"), look.quiet)
        }
    };
    painter.text(base, egui::Align2::LEFT_TOP, first, large, colour);
    if let Some(budget) = run.budget.as_ref().filter(|_| is_over) {
        let efficiency = fraction(budget.efficiency());
        let text = say!(language, "efficiency {efficiency}", "eficiência {efficiency}");
        let place = painter.text(pos2(rail.right(), base.y + 2.0), egui::Align2::RIGHT_TOP, text, small, look.quiet);
        explain_at(ui, (place, rail.left() as i32), Definition::EFFICIENCY, language);
    }
}
