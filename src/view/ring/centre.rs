//! The middle of the ring: the parent and how far the picture is, or what the run came to.

use std::f32::consts::{PI, TAU};

use super::angles::arc;
use super::layout::RingLayout;
use crate::balance::Strategy;
use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::analysis::summary::Summary;
use crate::view::draw::display_list::{Anchor, Hue, Mark, TextSize};
use crate::view::state::run_state::RunState;
use crate::view::state::scheduler::Sharing;
use crate::view::text::format::{duration, fraction, percent};

/// The parent, how far the picture is, and whether it is busy.
pub(crate) fn parent(plan: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>, language: Language) {
    let waiting = state.line_length(now);
    if waiting > 0 || state.is_estimating {
        marks.push(Mark::Disc { centre: plan.centre, radius: plan.parent, ink: Hue::Hairline.faint(0.6) });
    }
    // A single message is soon handled: its number would only flicker.
    let (caption, hue) = match waiting {
        _ if state.is_estimating => (word!(language, "estimating", "estimando").into(), Hue::Text),
        0..2 if state.sharing == Sharing::Stealing => (word!(language, "picture", "imagem").into(), Hue::Quiet),
        0..2 => (word!(language, "parent", "pai").into(), Hue::Quiet),
        many => (say!(language, "{many} waiting", "{many} na fila"), Hue::Text),
    };
    let (done, large) = (state.done() as f32 / state.atoms().max(1) as f32, large(plan));
    // Where the parent may be busy that is said wherever there is room; what it is called goes without saying.
    let is_busy_at_times = !state.handling.is_zero() || state.sharing == Sharing::By(Strategy::StaticEstimate);
    let has_room = TextSize::Small(plan.labels.text).width("estimating".len()) < 2.0 * plan.parent;
    let captions = has_captions(plan) || is_busy_at_times && has_room;
    let lift = if captions { large * 0.25 } else { 0.0 };
    let (size, small) = (TextSize::Fit(large), TextSize::Small(plan.labels.text));
    text(plan, -lift, percent(state.done(), state.atoms()), size, Hue::Text, marks);
    if captions {
        text(plan, large * 0.6, caption, small, hue, marks);
    }
    let points = arc(plan.centre, plan.parent, 0.0, TAU);
    marks.push(Mark::Line { points, width: 1.5, ink: Hue::Hairline.full() });
    if done > 0.0 {
        let points = arc(plan.centre, plan.parent, -PI / 2.0, TAU * done);
        marks.push(Mark::Line { points, width: 2.5, ink: Hue::Text.full() });
    }
}

/// The result of a finished run.
pub(crate) fn result(plan: &RingLayout, outcome: &Summary, marks: &mut Vec<Mark>, language: Language) {
    let (large, captions) = (large(plan) * 1.1, has_captions(plan));
    let (size, small) = (TextSize::Fit(large), TextSize::Small(plan.labels.text));
    // What explains them has no room within a small ring; the sentence below says it too.
    let lines = if captions { [-1.3, 0.65] } else { [-0.65, 0.65] };
    text(plan, large * lines[0], duration(outcome.makespan, language), size, Hue::Text, marks);
    text(plan, large * lines[1], fraction(outcome.efficiency), size, Hue::Text, marks);
    if captions {
        text(plan, -large * 0.45, word!(language, "start to finish", "início ao fim").into(), small, Hue::Quiet, marks);
        text(plan, large * 1.5, word!(language, "efficiency", "eficiência").into(), small, Hue::Quiet, marks);
    }
}

/// The size of what is read in the centre.
fn large(plan: &RingLayout) -> f32 {
    (plan.rail * 0.15).clamp(10.0, 48.0)
}

/// Whether the numbers in the centre have room for what they are.
fn has_captions(plan: &RingLayout) -> bool {
    const LETTERS: usize = "start to finish".len();
    let width = TextSize::Small(plan.labels.text).width(LETTERS);
    !plan.labels.are_small() && width < 2.0 * plan.interior()
}

/// Text in the centre, `dy` below its middle.
fn text(plan: &RingLayout, dy: f32, text: String, size: TextSize, hue: Hue, marks: &mut Vec<Mark>) {
    let at = [plan.centre[0], plan.centre[1] + dy];
    marks.push(Mark::Label { at, anchor: Anchor::Centre, text, size, ink: hue.full() });
}
