//! The timelines of all runs, one below the other on one axis of time.

use egui::text::LayoutJob;
use egui::{Align2, Painter, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};

use super::CompareColumn;
use super::columns::letter;
use crate::balance::NodeId;
use crate::gui::widgets;
use crate::gui::widgets::paint::{Inks, quads};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, word};
use crate::time::Time;
use crate::view::{ComparedRun, TimeWindow, TimelineLayout, axis, node_name, time_budget_words, time_words, timeline};

/// Left of the lanes: the run's letter, and its machines' numbers.
const LETTER: f32 = 2.5 * GRID;
const NUMBERS: f32 = 2.5 * GRID;
/// The height of the axis below them.
const AXIS: f32 = 2.25 * GRID;

/// Shows all lanes of all runs; returns the time that somebody drags to.
pub fn show(
    ui: &mut Ui,
    entries: &mut [CompareColumn],
    now: Time,
    length: Time,
    look: Look,
    language: Language,
) -> Option<Time> {
    let mut sought = None;
    let area = ui.available_rect_before_wrap();
    let is_changed = entries.iter().any(|entry| entry.parts().next().is_some());
    let legend =
        LayoutJob::simple(legend(is_changed, language), theme::regular(theme::SMALL), look.quiet, area.width());
    let legend = ui.painter().layout_job(legend);
    let foot = AXIS + legend.size().y;
    let each = ((area.height() - foot) / entries.len().max(1) as f32).min(14.0 * GRID);
    let mut window = TimeWindow::default();
    window.fit(length);
    let bottom = area.top() + each * entries.len() as f32 - 0.5 * GRID;
    let all = Rect::from_min_max(pos2(area.left() + LETTER + NUMBERS, area.top()), pos2(area.right(), bottom));
    seconds(ui.painter(), all, &window, look, language);
    for (place, entry) in entries.iter_mut().enumerate() {
        let top = area.top() + each * place as f32;
        let strip = Rect::from_min_size(pos2(all.left(), top), vec2(all.width(), each - GRID));
        let at = pos2(area.left(), strip.center().y);
        ui.painter().text(at, Align2::LEFT_CENTER, letter(place), theme::strong(theme::BODY), look.text);
        if let Some(share) = run(ui, strip, entry, &window, look, language) {
            sought = Some(window.at(share));
        }
    }
    let x = all.left() + all.width() * window.share(now.min(length)) as f32;
    ui.painter().line_segment([pos2(x, all.top()), pos2(x, bottom)], Stroke::new(1.5, look.accent));
    ui.painter().galley(pos2(area.left(), bottom + AXIS), legend, look.quiet);
    sought
}

/// The lanes of one run; returns the share of the width that somebody drags to.
fn run(
    ui: &Ui,
    strip: Rect,
    entry: &mut CompareColumn,
    window: &TimeWindow,
    look: Look,
    language: Language,
) -> Option<f64> {
    let parts: Vec<Time> = entry.parts().collect();
    let contender = entry.contender.as_ref()?;
    let lanes = contender.lanes.lanes().len();
    let lane = strip.height() / lanes.max(1) as f32;
    let plan = TimelineLayout { width: strip.width(), header_height: 0.0, axis_height: 0.0, lane_height: lane, lanes };
    let key = (strip.size(), window.to());
    if entry.lanes.as_ref().is_none_or(|(size, of, _)| (*size, *of) != key) {
        let drawn = timeline(&contender.lanes, window, &plan, contender.length());
        entry.lanes = Some((key.0, key.1, drawn));
    }
    let (.., drawn) = entry.lanes.as_ref()?;
    let (inks, painter) = (Inks { look, nodes: &contender.colours }, ui.painter());
    painter.add(Shape::mesh(quads(&drawn.quads, strip.min, &inks)));
    // Of many messages one would see only that they are many.
    for (from, to, ink) in &drawn.lines {
        let at = |[x, y]: [f32; 2]| strip.min + vec2(x, y);
        painter.line_segment([at(*from), at(*to)], Stroke::new(1.0, inks.colour(*ink)));
    }
    numbers(painter, strip, &plan, look);
    let upright = |time: Time| {
        let x = strip.left() + strip.width() * window.share(time) as f32;
        [pos2(x, strip.top()), pos2(x, strip.bottom())]
    };
    if let Some(end) = contender.end() {
        painter.line_segment(upright(end), Stroke::new(1.5, look.text));
    }
    for at in parts {
        let line = upright(at);
        painter.extend(Shape::dashed_line(&line, Stroke::new(1.5, look.text), 4.0, 3.0));
        let above = [vec2(-4.0, -6.0), vec2(4.0, -6.0), vec2(0.0, 0.0)].map(|corner| line[0] + corner);
        painter.add(Shape::convex_polygon(above.into(), look.text, Stroke::NONE));
    }
    let response = ui.interact(strip, ui.scope_id().with(("lanes", entry.id)), Sense::click_and_drag());
    widgets::describe(&response, &contender.name, || words(contender, language));
    let at = response.interact_pointer_pos()?;
    Some(f64::from(((at.x - strip.left()) / strip.width()).clamp(0.0, 1.0)))
}

/// The machines' numbers, as many as there is room for.
fn numbers(painter: &Painter, strip: Rect, plan: &TimelineLayout, look: Look) {
    let every = (theme::SMALL / plan.lane_height).ceil().max(1.0) as usize;
    for node in (0..plan.lanes as NodeId).step_by(every) {
        let [top, bottom] = plan.lane(node);
        let at = pos2(strip.left() - 0.5 * GRID, strip.top() + (top + bottom) / 2.0);
        painter.text(at, Align2::RIGHT_CENTER, node_name(node), theme::regular(theme::SMALL), look.quiet);
    }
}

/// Seconds below all lanes, and hairlines through them.
fn seconds(painter: &Painter, all: Rect, window: &TimeWindow, look: Look, language: Language) {
    let (times, rate) = axis(window, all.width());
    for time in times {
        let x = all.left() + all.width() * window.share(time) as f32;
        painter.line_segment([pos2(x, all.top()), pos2(x, all.bottom() + 3.0)], Stroke::new(1.0, look.hairline));
        let words = painter.layout_no_wrap(time_words(time, rate, language), theme::regular(theme::SMALL), look.quiet);
        let left = (x - words.size().x / 2.0).clamp(all.left(), (all.right() - words.size().x).max(all.left()));
        painter.galley(pos2(left, all.bottom() + 2.0), words, look.quiet);
    }
}

fn words(contender: &ComparedRun, language: Language) -> String {
    contender
        .budget
        .as_ref()
        .map_or_else(String::new, |account| time_budget_words(&[(&contender.name, account)], language))
}

/// What is to be seen; of changes only if there are any.
fn legend(is_changed: bool, language: Language) -> String {
    let mut told = word!(
        language,
        "Bars: tracing. Thin: asking, or done. Across: atoms given away; fainter: offers. Upright: complete.",
        "Barras: calculando. Finas: pedindo, ou pronta. Através: átomos cedidos; mais fracas: ofertas. Em pé: imagem \
         pronta."
    )
    .to_owned();
    if is_changed {
        told += word!(language, " Dashed: a machine changed.", " Tracejada: uma máquina mudada.");
    }
    told
}
