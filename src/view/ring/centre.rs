//! The centre of the ring: the parent and the share of the picture that is traced, or the result of the run.

use std::f32::consts::{PI, TAU};

use super::angles::arc;
use super::layout::RingLayout;
use crate::balance::Scheduler;
use crate::balance::Strategy;
use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::analysis::summary::Summary;
use crate::view::draw::display_list::{Anchor, Hue, Mark, TextSize};
use crate::view::state::run_state::RunState;
use crate::view::text::format::{duration, fraction, percent};
use crate::view::text::glossary::Definition;

/// Distance of a caption from the middle of a number, as a share of the number's size.
const CAPTION_DISTANCE: f32 = 0.75;

/// Draws the parent, the share of the picture that is traced, and whether the parent is busy.
pub(crate) fn parent(layout: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>, language: Language) {
    let waiting = state.line_length(now);
    if waiting > 0 || state.is_estimating {
        marks.push(Mark::Disc { centre: layout.centre, radius: layout.parent_radius, ink: Hue::Hairline.faint(0.6) });
    }
    // One message is handled quickly: its count would flicker.
    let (caption, hue) = match waiting {
        _ if state.is_estimating => (word!(language, "estimating", "estimando").into(), Hue::Text),
        0..2 if state.scheduler == Scheduler::WorkStealing => (word!(language, "picture", "imagem").into(), Hue::Quiet),
        0..2 => (word!(language, "parent", "pai").into(), Hue::Quiet),
        many => (say!(language, "{many} waiting", "{many} na fila"), Hue::Text),
    };
    let (done, large) = (state.done() as f32 / state.atoms().max(1) as f32, large_text_size(layout));
    // A parent that may be busy keeps its caption in smaller rings too.
    let is_busy_at_times =
        !state.handling.is_zero() || state.scheduler == Scheduler::Protocol(Strategy::StaticEstimate);
    let has_room = TextSize::Small(layout.labels.text_scale).width("estimating".len()) < 2.0 * layout.parent_radius;
    let captions = has_captions(layout) || is_busy_at_times && has_room;
    let (size, small) = (TextSize::Fit(large), TextSize::Small(layout.labels.text_scale));
    let share = percent(state.done(), state.atoms());
    if captions && !is_busy_at_times && has_two_captions(layout, large) {
        text(layout, -large * CAPTION_DISTANCE, caption, small, hue, marks);
        text(layout, 0.0, share, size, Hue::Text, marks);
        text(layout, large * CAPTION_DISTANCE, word!(language, "done", "feito").into(), small, Hue::Quiet, marks);
    } else if captions {
        text(layout, -large * 0.25, share, size, Hue::Text, marks);
        text(layout, large * 0.6, caption, small, hue, marks);
    } else {
        text(layout, 0.0, share, size, Hue::Text, marks);
    }
    let points = arc(layout.centre, layout.parent_radius, 0.0, TAU);
    marks.push(Mark::Line { points, width: 1.5, ink: Hue::Hairline.full() });
    if done > 0.0 {
        let points = arc(layout.centre, layout.parent_radius, -PI / 2.0, TAU * done);
        marks.push(Mark::Line { points, width: 2.5, ink: Hue::Text.full() });
    }
}

/// Draws the result of a finished run: makespan and efficiency.
pub(crate) fn result(layout: &RingLayout, summary: &Summary, marks: &mut Vec<Mark>, language: Language) {
    let (large, captions) = (large_text_size(layout) * 1.1, has_captions(layout));
    let (size, small) = (TextSize::Fit(large), TextSize::Small(layout.labels.text_scale));
    let makespan = duration(summary.makespan, language);
    // A small ring has no room for captions. A share without a word could be taken for another one.
    if !captions {
        return text(layout, 0.0, makespan, size, Hue::Text, marks);
    }
    text(layout, -large * 1.3, makespan, size, Hue::Text, marks);
    text(layout, -large * 0.45, Definition::MAKESPAN.name(language).into(), small, Hue::Quiet, marks);
    text(layout, large * 0.65, fraction(summary.efficiency), size, Hue::Text, marks);
    text(layout, large * 1.5, Definition::EFFICIENCY.name(language).into(), small, Hue::Quiet, marks);
}

/// Returns the text size of the numbers in the centre.
fn large_text_size(layout: &RingLayout) -> f32 {
    (layout.rail_radius * 0.14).clamp(10.0, 48.0)
}

/// Whether the centre has room for captions of its numbers.
fn has_captions(layout: &RingLayout) -> bool {
    const LETTERS: usize = "start to finish".len();
    let width = TextSize::Small(layout.labels.text_scale).width(LETTERS);
    !layout.labels.are_small() && width < 2.0 * layout.interior_radius()
}

/// Whether the parent has room for a caption above and one below its number of this size.
fn has_two_captions(layout: &RingLayout, number: f32) -> bool {
    let small = TextSize::Small(layout.labels.text_scale);
    let away = number * CAPTION_DISTANCE + 0.4 * small.units();
    let half = (layout.parent_radius.powi(2) - away.powi(2)).max(0.0).sqrt();
    small.width("parent".len()) < 2.0 * half
}

/// Draws a line of text `dy` below the middle of the centre.
fn text(layout: &RingLayout, dy: f32, text: String, size: TextSize, hue: Hue, marks: &mut Vec<Mark>) {
    let at = [layout.centre[0], layout.centre[1] + dy];
    marks.push(Mark::Label { at, anchor: Anchor::Centre, text, size, ink: hue.full() });
}
