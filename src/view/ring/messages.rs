//! Messages of the ring: results on the spokes, offers on the rail, atoms across.

use super::layers::{RingLayer, RingMarks};
use super::layout::RingLayout;
use super::{offers, parcels};
use crate::balance::Party;
use crate::time::Time;
use crate::view::draw::display_list::{Hue, Mark, Point};
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::run_state::RunState;

/// Draws results, offers and atoms on their way. The message with the id `highlighted` stands out.
pub(crate) fn draw(layout: &RingLayout, state: &RunState, now: Time, highlighted: Option<u64>, marks: &mut RingMarks) {
    results(layout, state, now, marks.layer(RingLayer::Results));
    offers::draw(layout, state, now, highlighted, marks.layer(RingLayer::Offers));
    parcels::draw(layout, state, now, highlighted, marks.layer(RingLayer::Parcels));
}

/// Finds the topmost message that is drawn at `point`, and its layer.
pub(crate) fn message_at<'a>(
    layout: &RingLayout,
    state: &'a RunState,
    now: Time,
    point: Point,
) -> Option<(RingLayer, &'a Flight)> {
    parcels::parcel_at(layout, state, now, point).or_else(|| offers::offer_at(layout, state, now, point))
}

/// Draws results on the spokes.
fn results(layout: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>) {
    let dot = (layout.rail_radius * 0.011).clamp(1.5, 3.0);
    for flight in state.flights() {
        if let (Party::Node(from), Cargo::Results(_)) = (flight.from, &flight.cargo)
            && flight.shown().contains(&now)
            && state.opacity(now) > 0.0
        {
            let (start, end) = (layout.seat_radius - layout.node_radius * 1.3, layout.parent_radius);
            let radius = start + (end - start) * flight.progress(now);
            let ink = Hue::Node(from).faint(state.opacity(now));
            marks.push(Mark::Disc { centre: layout.at(layout.angle(from), radius), radius: dot, ink });
        }
    }
}
