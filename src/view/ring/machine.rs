//! One machine of the ring: as large as its speed, with its number, its pipe, and what it does.

use std::f32::consts::{PI, TAU};

use super::angles::arc;
use super::condition_badge::Badge;
use super::layout::RingLayout;
use crate::balance::NodeId;
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::state::node_state::{Activity, NodeState, Slot};
use crate::view::text::format::node_name;

/// From this radius on a machine's number can be read.
const NUMBER_SEEN: f32 = 4.0;
/// Below this radius of a node what its pipe holds could not be told.
const PIPE_SEEN: f32 = 20.0;

/// Draws a machine; its arc says how much of its work is done.
pub(crate) fn machine(
    plan: &RingLayout,
    (node, of): (NodeId, &NodeState),
    activity: Activity,
    is_selected: bool,
    marks: &mut Vec<Mark>,
) {
    let centre = plan.seat(node);
    if activity == Activity::Spare {
        return empty_seat(plan, node, is_selected, marks);
    }
    progress(plan, centre, (node, of), activity, marks);
    let radius = plan.node * (0.5 + 0.5 * of.speed.clamp(0.0, 1.0).sqrt() as f32);
    let colour = Hue::Node(node);
    let (fill, hue) = match activity {
        Activity::Tracing | Activity::Done => (1.0, Hue::OnNode(node)),
        Activity::Receiving => (0.55, Hue::Text),
        Activity::CutOff if of.computes() => (1.0, Hue::OnNode(node)),
        Activity::Paused | Activity::SpeedZero | Activity::Hung => (0.3, Hue::Text),
        Activity::NoBand | Activity::Offering | Activity::Asking | Activity::InLine | Activity::Idle => {
            (0.18, Hue::Text)
        }
        Activity::CutOff => (0.18, Hue::Text),
        Activity::Retired | Activity::Asleep | Activity::NoMore => (0.0, Hue::Quiet),
        Activity::Off | Activity::Spare => (0.0, Hue::Quiet),
    };
    marks.push(Mark::Disc { centre, radius, ink: colour.faint(fill) });
    match activity {
        Activity::Retired | Activity::NoMore => dashes(centre, radius - 0.75, marks),
        Activity::Off => {
            let points = arc(centre, radius - 0.75, 0.0, TAU);
            marks.push(Mark::Line { points, width: 1.5, ink: Hue::Quiet.faint(0.6) });
        }
        _ if fill < 1.0 => {
            let points = arc(centre, radius - 0.75, 0.0, TAU);
            marks.push(Mark::Line { points, width: 1.5, ink: colour.faint(0.9) });
        }
        _ => {}
    }
    let has_pipe = plan.node >= PIPE_SEEN && !activity.is_out() && activity != Activity::Done;
    let raised = if has_pipe { 0.2 * radius } else { 0.0 };
    number(plan, node, [centre[0], centre[1] - raised], radius, hue, marks);
    if has_pipe {
        pipe(plan, [centre[0], centre[1] + 0.55 * radius], of, hue, marks);
    }
    if let Some(badge) = Badge::of(activity, of.paused) {
        badge.draw(plan, centre, marks);
    }
    if is_selected {
        selection(plan, centre, marks);
    }
}

/// Where a machine may join: only its number within a broken outline.
fn empty_seat(plan: &RingLayout, node: NodeId, is_selected: bool, marks: &mut Vec<Mark>) {
    let centre = plan.seat(node);
    marks.push(Mark::Disc { centre, radius: plan.reach(), ink: Hue::Ground.full() });
    dashes(centre, plan.node, marks);
    number(plan, node, centre, 0.8 * plan.node, Hue::Quiet, marks);
    if is_selected {
        selection(plan, centre, marks);
    }
}

fn number(plan: &RingLayout, node: NodeId, at: Point, radius: f32, hue: Hue, marks: &mut Vec<Mark>) {
    if plan.node >= NUMBER_SEEN {
        let (text, size) = (node_name(node).to_string(), TextSize::Fit((0.86 * plan.node).min(1.05 * radius)));
        marks.push(Mark::Label { at, anchor: Anchor::Centre, text, size, ink: hue.full() });
    }
}

fn selection(plan: &RingLayout, centre: Point, marks: &mut Vec<Mark>) {
    let points = arc(centre, plan.reach() + 1.5, 0.0, TAU);
    marks.push(Mark::Line { points, width: 2.5, ink: Hue::Text.full() });
}

/// What of its work is done, round the machine.
fn progress(
    plan: &RingLayout,
    centre: Point,
    (node, of): (NodeId, &NodeState),
    activity: Activity,
    marks: &mut Vec<Mark>,
) {
    let (track, width, colour) = (plan.node * RingLayout::TRACK, plan.track_width(), Hue::Node(node));
    let work = of.done + of.left();
    let done = if work == 0 { 0.0 } else { of.done as f32 / work as f32 };
    marks.push(Mark::Disc { centre, radius: plan.reach(), ink: Hue::Ground.full() });
    marks.push(Mark::Line { points: arc(centre, track, 0.0, TAU), width, ink: colour.faint(0.2) });
    if done > 0.0 {
        let strength = if activity.is_out() { 0.4 } else { 1.0 };
        let points = arc(centre, track, -PI / 2.0, TAU * done);
        marks.push(Mark::Line { points, width, ink: colour.faint(strength) });
    }
}

/// A broken outline: whoever has retired is no longer needed.
fn dashes(centre: Point, radius: f32, marks: &mut Vec<Mark>) {
    let count = (radius * 0.5).round().clamp(5.0, 12.0);
    let step = TAU / count;
    for i in 0..count as usize {
        let points = arc(centre, radius, step * i as f32, step * 0.55);
        marks.push(Mark::Line { points, width: 1.5, ink: Hue::Quiet.faint(0.8) });
    }
}

/// The two places of the pipe, the atom that is traced on the left.
fn pipe(plan: &RingLayout, [x, y]: Point, of: &NodeState, hue: Hue, marks: &mut Vec<Mark>) {
    let half = 0.12 * plan.node;
    for (slot, side) in of.pipe().into_iter().zip([-1.0, 1.0]) {
        let ink = hue.faint(match slot {
            Slot::Traced => 1.0,
            Slot::Filled => 0.65,
            Slot::Empty => 0.18,
        });
        marks.push(Mark::Box { centre: [x + side * 1.35 * half, y], half: [half; 2], round: 0.45 * half, ink });
    }
}
