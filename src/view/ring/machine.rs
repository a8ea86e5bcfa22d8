//! One machine of the ring: a disc whose size shows the speed, with number, pipe, progress and badge.

use std::f32::consts::{PI, TAU};

use super::angles::arc;
use super::condition_badge::Badge;
use super::layout::RingLayout;
use crate::balance::NodeId;
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::state::node_state::{Activity, NodeState, Slot};
use crate::view::text::format::node_name;

/// Least radius of a node whose number can be read.
const MIN_NUMBER_RADIUS_PX: f32 = 4.0;
/// Least radius of a node whose pipe can be seen.
pub(crate) const MIN_PIPE_RADIUS_PX: f32 = 20.0;

/// Draws a machine; the arc round it shows its atoms left as a share of `full`.
pub(crate) fn draw(
    layout: &RingLayout,
    (node, state): (NodeId, &NodeState),
    (activity, full): (Activity, u32),
    is_selected: bool,
    marks: &mut Vec<Mark>,
) {
    let centre = layout.seat(node);
    if activity == Activity::Spare {
        return empty_seat(layout, node, is_selected, marks);
    }
    atoms_left(layout, centre, (node, state), full, marks);
    let radius = layout.node_radius * (0.5 + 0.5 * state.speed.clamp(0.0, 1.0).sqrt() as f32);
    let colour = Hue::Node(node);
    let (fill, hue) = match activity {
        Activity::Tracing | Activity::Done => (1.0, Hue::OnNode(node)),
        Activity::Receiving => (0.55, Hue::Text),
        Activity::CutOff if state.computes() => (1.0, Hue::OnNode(node)),
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
    let has_pipe = shows_pipe(layout, state, activity);
    let raised = if has_pipe { 0.2 * radius } else { 0.0 };
    number(layout, node, [centre[0], centre[1] - raised], radius, hue, marks);
    if has_pipe {
        pipe(layout, [centre[0], centre[1] + 0.55 * radius], state, hue, marks);
    }
    if let Some(badge) = Badge::of(activity, state.paused) {
        badge.draw(layout, centre, marks);
    }
    if is_selected {
        selection(layout, centre, marks);
    }
}

/// Whether the pipe of a machine is drawn: while it holds all that is left, which nobody else can take.
pub(crate) fn shows_pipe(layout: &RingLayout, state: &NodeState, activity: Activity) -> bool {
    let is_there = !activity.is_out() && !matches!(activity, Activity::Done | Activity::Spare);
    layout.node_radius >= MIN_PIPE_RADIUS_PX && is_there && (1..=2).contains(&state.left())
}

/// Draws the seat of a spare machine: its number within a dashed outline.
fn empty_seat(layout: &RingLayout, node: NodeId, is_selected: bool, marks: &mut Vec<Mark>) {
    let centre = layout.seat(node);
    marks.push(Mark::Disc { centre, radius: layout.node_reach(), ink: Hue::Ground.full() });
    dashes(centre, layout.node_radius, marks);
    number(layout, node, centre, 0.8 * layout.node_radius, Hue::Quiet, marks);
    if is_selected {
        selection(layout, centre, marks);
    }
}

fn number(layout: &RingLayout, node: NodeId, at: Point, radius: f32, hue: Hue, marks: &mut Vec<Mark>) {
    if layout.node_radius >= MIN_NUMBER_RADIUS_PX {
        let (text, size) = (node_name(node).to_string(), TextSize::Fit((0.86 * layout.node_radius).min(1.05 * radius)));
        marks.push(Mark::Label { at, anchor: Anchor::Centre, text, size, ink: hue.full() });
    }
}

fn selection(layout: &RingLayout, centre: Point, marks: &mut Vec<Mark>) {
    let points = arc(centre, layout.node_reach() + 1.5, 0.0, TAU);
    marks.push(Mark::Line { points, width: 2.5, ink: Hue::Text.full() });
}

/// Draws the arc of the atoms left. Atoms that are given away leave the giver's arc and lengthen the receiver's.
fn atoms_left(
    layout: &RingLayout,
    centre: Point,
    (node, state): (NodeId, &NodeState),
    full: u32,
    marks: &mut Vec<Mark>,
) {
    let (track, width, colour) = (layout.node_radius * RingLayout::TRACK_RADIUS, layout.track_width(), Hue::Node(node));
    let left = (state.left() as f32 / full.max(1) as f32).min(1.0);
    marks.push(Mark::Disc { centre, radius: layout.node_reach(), ink: Hue::Ground.full() });
    marks.push(Mark::Line { points: arc(centre, track, 0.0, TAU), width, ink: colour.faint(0.2) });
    if left > 0.0 {
        marks.push(Mark::Line { points: arc(centre, track, -PI / 2.0, TAU * left), width, ink: colour.full() });
    }
}

/// Draws a dashed outline, the sign of a machine that is not needed.
fn dashes(centre: Point, radius: f32, marks: &mut Vec<Mark>) {
    let count = (radius * 0.5).round().clamp(5.0, 12.0);
    let step = TAU / count;
    for i in 0..count as usize {
        let points = arc(centre, radius, step * i as f32, step * 0.55);
        marks.push(Mark::Line { points, width: 1.5, ink: Hue::Quiet.faint(0.8) });
    }
}

/// Draws the two slots of the pipe; the atom that is being traced is on the left.
fn pipe(layout: &RingLayout, [x, y]: Point, state: &NodeState, hue: Hue, marks: &mut Vec<Mark>) {
    let half = 0.12 * layout.node_radius;
    for (slot, side) in state.pipe().into_iter().zip([-1.0, 1.0]) {
        let ink = hue.faint(match slot {
            Slot::Traced => 1.0,
            Slot::Filled => 0.65,
            Slot::Empty => 0.18,
        });
        marks.push(Mark::Box { centre: [x + side * 1.35 * half, y], half: [half; 2], round: 0.45 * half, ink });
    }
}
