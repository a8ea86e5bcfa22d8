//! The ring as a display list: nodes on a circle, offers on a rail round it, transfers across, the parent within.
//!
//! Numbers rise clockwise from the top, so an offer, which goes to the left neighbour, always runs anticlockwise:
//! at the top of the ring to the left.

mod angles;
mod centre;
mod condition_badge;
mod farm_messages;
mod label_text;
pub(crate) mod labels;
mod layers;
pub(crate) mod layout;
mod lost_messages;
mod machine;
mod messages;

use std::f32::consts::TAU;

use super::analysis::summary::Summary;
use super::draw::display_list::{Hue, Mark, Point};
use super::state::flight::Flight;
use super::state::run_state::RunState;
use super::state::scheduler::Sharing;
use crate::balance::NodeId;
use crate::language::Language;
use crate::time::Time;
use angles::arc;
use label_text::{is_labelled, label};
use layers::{RingLayer, RingMarks};
use layout::RingLayout;
use machine::machine;

/// What is laid over the ring.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RingOverlay {
    /// The result, which takes the centre.
    pub outcome: Option<Summary>,
    /// The node that is marked.
    pub selected: Option<NodeId>,
    /// Nodes that stand out.
    pub lit: Vec<NodeId>,
    /// A message that stands out.
    pub message: Option<u64>,
}

/// What can be pointed at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RingSpot {
    /// A node, with its progress arc.
    Node(NodeId),
    /// The parent in the centre.
    Parent,
}

/// The ring at `now`; the message, the nodes and the result of `overlay` are laid over it.
pub fn ring(layout: &RingLayout, state: &RunState, overlay: &RingOverlay, now: Time, language: Language) -> Vec<Mark> {
    let mut marks = RingMarks::default();
    let tracks = marks.layer(RingLayer::Tracks);
    if state.sharing.is_ring() {
        rail(layout, tracks);
    }
    if state.sharing != Sharing::Stealing {
        spokes(layout, state.sharing.is_farm(), tracks);
    }
    let machines = marks.layer(RingLayer::Machines);
    for node in 0..state.nodes().len() as NodeId {
        let of = &*state.seen(node, now);
        let (activity, is_selected) = (state.activity(node, now), overlay.selected == Some(node));
        machine(layout, (node, of), activity, is_selected || overlay.lit.contains(&node), machines);
        if is_labelled(layout, is_selected) {
            label(layout, state, (node, of), activity, now, machines, language);
        }
    }
    let centre = marks.layer(RingLayer::Centre);
    match overlay.outcome {
        Some(outcome) => centre::result(layout, &outcome, centre, language),
        None => centre::parent(layout, state, now, centre, language),
    }
    messages::draw(layout, state, now, overlay.message, &mut marks);
    farm_messages::draw(layout, state, now, &mut marks);
    lost_messages::draw(layout, state, now, &mut marks);
    marks.joined()
}

/// What of the ring is at `point`.
pub fn ring_at(layout: &RingLayout, point: Point) -> Option<RingSpot> {
    let from = |[x, y]: Point| (point[0] - x).hypot(point[1] - y);
    let away = |node: &NodeId| from(layout.seat(*node));
    let nearest = (0..layout.nodes as NodeId).min_by(|one, other| away(one).total_cmp(&away(other)));
    match nearest {
        Some(node) if away(&node) <= layout.reach() => Some(RingSpot::Node(node)),
        _ => (from(layout.centre) <= layout.parent).then_some(RingSpot::Parent),
    }
}

/// The topmost message that is drawn at `point` at `now`: atoms, an offer, a request, or its answer.
pub fn message_at<'a>(layout: &RingLayout, state: &'a RunState, now: Time, point: Point) -> Option<&'a Flight> {
    let in_ring = messages::message_at(layout, state, now, point);
    let in_farm = farm_messages::message_at(layout, state, now, point);
    in_ring.into_iter().chain(in_farm).max_by_key(|(layer, _)| *layer).map(|(_, flight)| flight)
}

/// Arrowheads on the rail, and spokes.
const MOST_LINES: usize = 64;

fn rail(plan: &RingLayout, marks: &mut Vec<Mark>) {
    let ink = Hue::Hairline.full();
    marks.push(Mark::Line { points: arc(plan.centre, plan.rail, 0.0, TAU), width: 1.5, ink });
    // Arrowheads half-way between neighbours say which way offers go.
    let wing = (plan.rail * 0.022).clamp(3.0, 8.0);
    // As many as can be told apart.
    for node in (0..plan.nodes).step_by(plan.nodes.div_ceil(MOST_LINES)) {
        let angle = plan.angle(node as NodeId) - plan.step() / 2.0;
        let back = wing / plan.rail;
        let points = vec![
            plan.at(angle + back, plan.rail - wing),
            plan.at(angle - back * 0.2, plan.rail),
            plan.at(angle + back, plan.rail + wing),
        ];
        marks.push(Mark::Line { points, width: 1.5, ink: Hue::Quiet.faint(0.7) });
    }
}

/// The ways between parent and nodes; in a farm, where everything goes that way, they are `strong`.
fn spokes(plan: &RingLayout, strong: bool, marks: &mut Vec<Mark>) {
    let (width, ink) = if strong { (1.5, Hue::Hairline.full()) } else { (1.0, Hue::Hairline.faint(0.7)) };
    for node in (0..plan.nodes).step_by(plan.nodes.div_ceil(MOST_LINES)) {
        let angle = plan.angle(node as NodeId);
        let (inner, outer) = (plan.at(angle, plan.parent), plan.at(angle, plan.seats - plan.node * 1.3));
        marks.push(Mark::Line { points: vec![inner, outer], width, ink });
    }
}

#[cfg(test)]
mod tests;
