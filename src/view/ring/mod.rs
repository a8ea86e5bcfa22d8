//! The ring as a display list: nodes on a circle, offers on a rail round it, transfers across, the parent in the
//! centre.
//!
//! Numbers rise clockwise from the top. An offer goes to the left neighbour, so it always moves anticlockwise: at the
//! top of the ring to the left.

mod angles;
mod centre;
mod condition_badge;
pub(crate) mod corners;
mod emphasis;
mod farm_messages;
mod label_text;
pub(crate) mod labels;
mod layers;
pub(crate) mod layout;
pub(crate) mod legend;
mod lost_messages;
mod machine;
mod messages;
mod offers;
mod parcels;

use std::f32::consts::TAU;

use super::analysis::summary::Summary;
use super::draw::display_list::{Hue, Mark, Point};
use super::state::flight::Flight;
use super::state::run_state::RunState;
use crate::balance::{NodeId, Scheduler};
use crate::language::Language;
use crate::time::Time;
use angles::arc;
use label_text::is_labelled;
use layers::{RingLayer, RingMarks};
use layout::RingLayout;

/// Marks over the ring that do not come from the run's state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RingOverlay {
    /// The result, shown in the centre.
    pub summary: Option<Summary>,
    /// The selected node.
    pub selected: Option<NodeId>,
    /// Highlighted nodes.
    pub highlighted: Vec<NodeId>,
    /// The id of the highlighted message.
    pub message: Option<u64>,
}

/// A part of the ring that can be pointed at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RingSpot {
    /// A node or its progress arc.
    Node(NodeId),
    /// The parent, in the centre.
    Parent,
}

/// Draws the ring at `now`.
pub fn ring(layout: &RingLayout, state: &RunState, overlay: &RingOverlay, now: Time, language: Language) -> Vec<Mark> {
    draw(layout, state, overlay, now, language).joined()
}

/// Draws the layers of the ring at `now`.
fn draw(layout: &RingLayout, state: &RunState, overlay: &RingOverlay, now: Time, language: Language) -> RingMarks {
    let mut marks = RingMarks::default();
    let tracks = marks.layer(RingLayer::Tracks);
    if state.scheduler.is_ring() {
        rail(layout, tracks);
    }
    if state.scheduler != Scheduler::WorkStealing {
        spokes(layout, state.scheduler.is_farm(), tracks);
    }
    let machines = marks.layer(RingLayer::Machines);
    for node in 0..state.nodes().len() as NodeId {
        let of = &*state.node_as_drawn(node, now);
        let (activity, is_selected) = (state.activity(node, now), overlay.selected == Some(node));
        let stands_out = is_selected || overlay.highlighted.contains(&node);
        machine::draw(layout, (node, of), (activity, state.equal_share()), stands_out, machines);
        if is_labelled(layout, is_selected) {
            label_text::draw(layout, state, (node, of), activity, now, machines, language);
        }
    }
    let centre = marks.layer(RingLayer::Centre);
    match overlay.summary {
        Some(summary) => centre::result(layout, &summary, centre, language),
        None => centre::parent(layout, state, now, centre, language),
    }
    messages::draw(layout, state, now, overlay.message, &mut marks);
    farm_messages::draw(layout, state, now, &mut marks);
    lost_messages::draw(layout, state, now, &mut marks);
    marks
}

/// Finds the part of the ring at `point`.
pub fn ring_at(layout: &RingLayout, point: Point) -> Option<RingSpot> {
    let from = |[x, y]: Point| (point[0] - x).hypot(point[1] - y);
    let away = |node: &NodeId| from(layout.seat(*node));
    let nearest = (0..layout.nodes as NodeId).min_by(|one, other| away(one).total_cmp(&away(other)));
    match nearest {
        Some(node) if away(&node) <= layout.node_reach() => Some(RingSpot::Node(node)),
        _ => (from(layout.centre) <= layout.parent_radius).then_some(RingSpot::Parent),
    }
}

/// Finds the topmost message that is drawn at `point` at `now`: atoms, an offer, a request, or its answer.
pub fn message_at<'a>(layout: &RingLayout, state: &'a RunState, now: Time, point: Point) -> Option<&'a Flight> {
    let in_ring = messages::message_at(layout, state, now, point);
    let in_farm = farm_messages::message_at(layout, state, now, point);
    in_ring.into_iter().chain(in_farm).max_by_key(|(layer, _)| *layer).map(|(_, flight)| flight)
}

/// Maximum number of arrowheads on the rail, and of spokes: more could not be told apart.
const MAX_SPOKES: usize = 64;

/// Draws the rail. Arrowheads half-way between neighbours show the direction of offers.
fn rail(layout: &RingLayout, marks: &mut Vec<Mark>) {
    let ink = Hue::Hairline.full();
    marks.push(Mark::Line { points: arc(layout.centre, layout.rail_radius, 0.0, TAU), width: 1.5, ink });
    let wing = (layout.rail_radius * 0.022).clamp(3.0, 8.0);
    for node in (0..layout.nodes).step_by(layout.nodes.div_ceil(MAX_SPOKES)) {
        let angle = layout.angle(node as NodeId) - layout.node_step() / 2.0;
        let back = wing / layout.rail_radius;
        let points = vec![
            layout.at(angle + back, layout.rail_radius - wing),
            layout.at(angle - back * 0.2, layout.rail_radius),
            layout.at(angle + back, layout.rail_radius + wing),
        ];
        marks.push(Mark::Line { points, width: 1.5, ink: Hue::Quiet.faint(0.7) });
    }
}

/// Draws the spokes between parent and nodes. They are `strong` in a farm, where all messages take them.
fn spokes(layout: &RingLayout, strong: bool, marks: &mut Vec<Mark>) {
    let (width, ink) = if strong { (1.5, Hue::Hairline.full()) } else { (1.0, Hue::Hairline.faint(0.7)) };
    for node in (0..layout.nodes).step_by(layout.nodes.div_ceil(MAX_SPOKES)) {
        let angle = layout.angle(node as NodeId);
        let (inner, outer) =
            (layout.at(angle, layout.parent_radius), layout.at(angle, layout.seat_radius - layout.node_radius * 1.3));
        marks.push(Mark::Line { points: vec![inner, outer], width, ink });
    }
}

#[cfg(test)]
mod tests;
