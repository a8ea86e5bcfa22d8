//! The timelines of all compared runs, one below the other on one time axis.

use egui::text::LayoutJob;
use egui::{Align2, Painter, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};

use super::CompareColumn;
use super::columns::letter;
use crate::gui::panels::timeline::zoom_and_pan;
use crate::gui::widgets;
use crate::gui::widgets::paint::{Inks, quads};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::{
    ComparedRun, TimeScale, TimeWindow, TimelineLayout, axis, node_name, time_budget_words, time_words, timeline,
};

/// Width of the run's letter left of the lanes, in points.
const LETTER_WIDTH_PT: f32 = 2.5 * GRID;
/// Width of the machines' numbers left of the lanes, in points.
const NUMBERS_WIDTH_PT: f32 = 2.5 * GRID;
/// Height of the time axis below the lanes, in points.
const AXIS_HEIGHT_PT: f32 = 2.25 * GRID;

/// Shows the stretch `window` of the lanes of all runs; the wheel zooms it. Returns the time that the user chooses.
pub fn show(
    ui: &mut Ui,
    columns: &mut [CompareColumn],
    window: &mut TimeWindow,
    (now, length): (Time, Time),
    look: Look,
    language: Language,
) -> Option<Time> {
    let area = ui.available_rect_before_wrap();
    let has_changes = columns.iter().any(|column| column.change_times().next().is_some());
    let legend =
        LayoutJob::simple(legend(has_changes, language), theme::regular(theme::SMALL), look.quiet, area.width());
    let legend = ui.painter().layout_job(legend);
    let foot = AXIS_HEIGHT_PT + legend.size().y;
    let each = ((area.height() - foot) / columns.len().max(1) as f32).min(14.0 * GRID);
    let bottom = area.top() + each * columns.len() as f32 - 0.5 * GRID;
    let all = Rect::from_min_max(
        pos2(area.left() + LETTER_WIDTH_PT + NUMBERS_WIDTH_PT, area.top()),
        pos2(area.right(), bottom),
    );
    let response = ui.interact(all, ui.scope_id().with("lanes"), Sense::click_and_drag());
    widgets::describe(&response, word!(language, "Lanes of all runs", "Pistas de todas as execuções"), || {
        let [from, to] = [window.from(), window.to()];
        let [from, to] = [from, to].map(|time| time_words(time, TimeScale::of_length(length), language));
        say!(language, "from {from} to {to}", "de {from} a {to}")
    });
    window.fit(length);
    zoom_and_pan(window, ui, &response, all);
    window.fit(length);
    let is_chosen = response.clicked() || response.dragged() && window.shows_all();
    let chosen = response.interact_pointer_pos().filter(|_| is_chosen);
    let sought = chosen.map(|at| window.at(f64::from(((at.x - all.left()) / all.width()).clamp(0.0, 1.0))));
    time_axis(ui.painter(), all, window, look, language);
    for (index, column) in columns.iter_mut().enumerate() {
        let top = area.top() + each * index as f32;
        let strip = Rect::from_min_size(pos2(all.left(), top), vec2(all.width(), each - GRID));
        let at = pos2(area.left(), strip.center().y);
        ui.painter().text(at, Align2::LEFT_CENTER, letter(index), theme::strong(theme::BODY), look.text);
        run_lanes(ui, strip, column, window, look, language);
    }
    let x = all.left() + all.width() * window.share(now.min(length)) as f32;
    ui.painter_at(all.expand(1.0)).line_segment([pos2(x, all.top()), pos2(x, bottom)], Stroke::new(1.5, look.accent));
    ui.painter().galley(pos2(area.left(), bottom + AXIS_HEIGHT_PT), legend, look.quiet);
    sought
}

/// Shows the lanes of one run.
fn run_lanes(ui: &Ui, strip: Rect, column: &mut CompareColumn, window: &TimeWindow, look: Look, language: Language) {
    let change_times: Vec<Time> = column.change_times().collect();
    let Some(run) = column.run.as_ref() else { return };
    let lanes = run.lanes.lanes().len();
    let lane = strip.height() / lanes.max(1) as f32;
    let layout =
        TimelineLayout { width: strip.width(), header_height: 0.0, axis_height: 0.0, lane_height: lane, lanes };
    let key = (strip.size(), *window);
    let drawn = column.lanes.take().filter(|(size, drawn, _)| (*size, *drawn) == key);
    let drawn = drawn.unwrap_or_else(|| (key.0, key.1, timeline(&run.lanes, window, &layout, run.length())));
    let (.., drawing) = &drawn;
    numbers(ui.painter(), strip, &layout, look);
    // A change of a speed has a wedge above the lanes.
    let inks = Inks { look, nodes: &run.colours };
    let painter = &ui.painter_at(strip.expand2(vec2(1.0, GRID)));
    painter.add(Shape::mesh(quads(&drawing.quads, strip.min, &inks)));
    for (from, to, ink) in &drawing.lines {
        let at = |[x, y]: [f32; 2]| strip.min + vec2(x, y);
        painter.line_segment([at(*from), at(*to)], Stroke::new(1.0, inks.colour(*ink)));
    }
    let vertical = |time: Time| {
        let x = strip.left() + strip.width() * window.share(time) as f32;
        [pos2(x, strip.top()), pos2(x, strip.bottom())]
    };
    if let Some(end) = run.end() {
        painter.line_segment(vertical(end), Stroke::new(1.5, look.text));
    }
    for at in change_times {
        let line = vertical(at);
        painter.extend(Shape::dashed_line(&line, Stroke::new(1.5, look.text), 4.0, 3.0));
        let above = [vec2(-4.0, -6.0), vec2(4.0, -6.0), vec2(0.0, 0.0)].map(|corner| line[0] + corner);
        painter.add(Shape::convex_polygon(above.into(), look.text, Stroke::NONE));
    }
    let response = ui.interact(strip, ui.scope_id().with(("lanes", column.id)), Sense::hover());
    widgets::describe(&response, &run.name(language), || budget_text(run, language));
    column.lanes = Some(drawn);
}

/// Paints the machines' numbers, every nth if lanes are low.
fn numbers(painter: &Painter, strip: Rect, layout: &TimelineLayout, look: Look) {
    for node in layout.numbered(theme::SMALL) {
        let [top, bottom] = layout.lane(node);
        let at = pos2(strip.left() - 0.5 * GRID, strip.top() + (top + bottom) / 2.0);
        painter.text(at, Align2::RIGHT_CENTER, node_name(node), theme::regular(theme::SMALL), look.quiet);
    }
}

/// Paints the time axis below all lanes, with lines through them.
fn time_axis(painter: &Painter, all: Rect, window: &TimeWindow, look: Look, language: Language) {
    let (times, rate) = axis(window, all.width());
    for time in times {
        let x = all.left() + all.width() * window.share(time) as f32;
        painter.line_segment([pos2(x, all.top()), pos2(x, all.bottom() + 3.0)], Stroke::new(1.0, look.hairline));
        let words = time_words(time, TimeScale::of_length(window.to()).at_rate(rate), language);
        let galley = painter.layout_no_wrap(words, theme::regular(theme::SMALL), look.quiet);
        let left = (x - galley.size().x / 2.0).clamp(all.left(), (all.right() - galley.size().x).max(all.left()));
        painter.galley(pos2(left, all.bottom() + 2.0), galley, look.quiet);
    }
}

/// Describes the time budget of a run for screen readers.
fn budget_text(run: &ComparedRun, language: Language) -> String {
    run.budget.as_ref().map_or_else(String::new, |budget| time_budget_words(&[(&run.name(language), budget)], language))
}

/// Returns the legend; it explains changes only if there are any.
fn legend(has_changes: bool, language: Language) -> String {
    let mut text = word!(
        language,
        "Bars: tracing. Thin bars: asking or done. Lines across: transfers; fainter: offers. Vertical: complete.",
        "Barras: calculando. Barras finas: pedindo ou pronta. Linhas: transferências; fracas: ofertas. Vertical: \
imagem pronta."
    )
    .to_owned();
    if has_changes {
        text += word!(language, " Dashed: change of a speed.", " Tracejada: mudança de velocidade.");
    }
    text
}
