//! Messages of the ring: results on the spokes, offers on the rail, atoms across.

use super::angles::{arc, curve, ease};
use super::layers::{RingLayer, RingMarks};
use super::layout::RingLayout;
use crate::balance::{NodeId, Party};
use crate::time::Time;
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::run_state::RunState;
use crate::view::text::format::{count, node_name};

/// Draws results, offers and atoms on their way. The message with the id `highlighted` stands out.
pub(crate) fn draw(layout: &RingLayout, state: &RunState, now: Time, highlighted: Option<u64>, marks: &mut RingMarks) {
    results(layout, state, now, marks.layer(RingLayer::Results));
    offers(layout, state, now, highlighted, marks.layer(RingLayer::Offers));
    parcels(layout, state, now, highlighted, marks.layer(RingLayer::Parcels));
}

/// Finds the topmost message that is drawn at `point`, and its layer.
pub(crate) fn message_at<'a>(
    layout: &RingLayout,
    state: &'a RunState,
    now: Time,
    point: Point,
) -> Option<(RingLayer, &'a Flight)> {
    let parcel = parcel_at(layout, state, now, point).map(|flight| (RingLayer::Parcels, flight));
    parcel.or_else(|| offer_at(layout, state, now, point).map(|flight| (RingLayer::Offers, flight)))
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

/// Draws offers and their fading trails on the rail. Each offer has its own lane.
fn offers(layout: &RingLayout, state: &RunState, now: Time, highlighted: Option<u64>, marks: &mut Vec<Mark>) {
    for (lane, flight) in hops_in_lanes(state, now) {
        let (Party::Node(from), Cargo::Offer { who }) = (flight.from, &flight.cargo) else { continue };
        let radius = layout.rail_radius + lane_offset(layout, lane);
        let sweep = -layout.offer_sweep(from, flight.to) * flight.progress(now);
        let strength = if lane < MAX_DETAILED { 0.9 } else { HINT_ALPHA };
        marks.push(Mark::Line {
            points: arc(layout.centre, radius, layout.angle(from), sweep),
            width: lane_width(layout),
            ink: Hue::Node(*who).faint(strength * visibility(state, flight, now)),
        });
    }
    for disc in discs(layout, state, now) {
        disc.draw(state, now, highlighted == Some(disc.flight.id), marks);
    }
}

/// Finds the offer whose disc is drawn at `point`.
fn offer_at<'a>(layout: &RingLayout, state: &'a RunState, now: Time, [x, y]: Point) -> Option<&'a Flight> {
    let covers = |disc: &OfferDisc<'_>| {
        let [u, v] = disc.centre;
        disc.flight.shown().contains(&now) && (x - u).hypot(y - v) <= disc.radius + 2.0
    };
    discs(layout, state, now).into_iter().rev().find(covers).map(|disc| disc.flight)
}

/// Disc of an offer on its last hop; it stays for a while after the arrival.
struct OfferDisc<'a> {
    flight: &'a Flight,
    who: NodeId,
    centre: Point,
    radius: f32,
}

fn discs<'a>(layout: &RingLayout, state: &'a RunState, now: Time) -> Vec<OfferDisc<'a>> {
    let hops = hops_in_lanes(state, now);
    let last = |lane| hops.iter().rfind(|(other, _)| *other == lane).map(|(_, flight)| *flight);
    let disc = |lane| {
        let flight = last(lane)?;
        let (Party::Node(from), Cargo::Offer { who }) = (flight.from, &flight.cargo) else { return None };
        let angle = layout.angle(from) - layout.offer_sweep(from, flight.to) * flight.progress(now);
        let radius = (layout.node_radius * 0.42).clamp(7.0, 13.0);
        // Further out it would cover a label.
        let most = layout.labels.gap() - radius - HIGHLIGHT_BORDER_PX;
        let centre = layout.at(angle, layout.rail_radius + lane_offset(layout, lane).min(most));
        Some(OfferDisc { flight, who: *who, centre, radius })
    };
    (0..MAX_DETAILED).filter_map(disc).collect()
}

/// Returns the visible hops of offers, each with the lane of its offerer.
fn hops_in_lanes(state: &RunState, now: Time) -> Vec<(usize, &Flight)> {
    let mut offerers: Vec<NodeId> = Vec::new();
    let seen = |flight: &&Flight| flight.sent <= now && visibility(state, flight, now) > 0.0;
    let hop = |flight| {
        let &Flight { cargo: Cargo::Offer { who }, from: Party::Node(_), .. } = flight else { return None };
        let lane = offerers.iter().position(|other| *other == who).unwrap_or_else(|| {
            offerers.push(who);
            offerers.len() - 1
        });
        Some((lane, flight))
    };
    state.flights().iter().filter(seen).filter_map(hop).collect()
}

impl OfferDisc<'_> {
    fn draw(&self, state: &RunState, now: Time, is_highlighted: bool, marks: &mut Vec<Mark>) {
        let &OfferDisc { flight, who, centre, radius } = self;
        let alpha = visibility(state, flight, now);
        let (wide, border) = if is_highlighted { (HIGHLIGHT_BORDER_PX, Hue::Text) } else { (2.0, Hue::Ground) };
        marks.push(Mark::Disc { centre, radius: radius + wide, ink: border.faint(alpha) });
        marks.push(Mark::Disc { centre, radius, ink: Hue::Node(who).faint(alpha) });
        marks.push(Mark::Label {
            at: centre,
            anchor: Anchor::Centre,
            text: node_name(who).to_string(),
            size: TextSize::Fit(radius * 1.2),
            ink: Hue::OnNode(who).faint(alpha),
        });
    }
}

/// Returns the opacity of a message and its trail, 0 to 1.
pub(crate) fn visibility(state: &RunState, flight: &Flight, now: Time) -> f32 {
    flight.opacity(now) * state.opacity(now)
}

/// Returns the distance of a lane from the rail: lane 0 is on it, the others by turns outside and inside. More than
/// eight offers share lanes.
fn lane_offset(layout: &RingLayout, lane: usize) -> f32 {
    let lane = lane % 8;
    let out = lane.div_ceil(2) as f32 * lane_width(layout);
    if lane % 2 == 1 { out } else { -out }
}

/// Returns the width of a lane.
fn lane_width(layout: &RingLayout) -> f32 {
    (layout.rail_radius * 0.025).clamp(1.5, 4.0)
}

/// Draws atoms on their way, with their counts: bands from the parent, transfers from node to node.
fn parcels(layout: &RingLayout, state: &RunState, now: Time, highlighted: Option<u64>, marks: &mut Vec<Mark>) {
    for parcel in parcels_shown(layout, state, now).into_iter().rev() {
        parcel.draw(layout, now, highlighted == Some(parcel.flight.id), marks);
    }
}

/// Finds the message of the parcel that is drawn at `point`.
fn parcel_at<'a>(layout: &RingLayout, state: &'a RunState, now: Time, [x, y]: Point) -> Option<&'a Flight> {
    let covers = |parcel: &Parcel<'_>| {
        let (_, [u, v], half) = parcel.shape(layout, now);
        parcel.flight.shown().contains(&now) && (x - u).abs() <= half[0] && (y - v).abs() <= half[1]
    };
    parcels_shown(layout, state, now).into_iter().find(covers).map(|parcel| parcel.flight)
}

/// Drawing of a message that carries atoms.
struct Parcel<'a> {
    flight: &'a Flight,
    from: Point,
    to: Point,
    /// The node in whose colour it is drawn.
    node: NodeId,
    /// Whether it is drawn with its count.
    is_detailed: bool,
    /// Opacity, 0 to 1.
    alpha: f32,
}

/// Returns the parcels to draw, the largest first; the largest is on top.
fn parcels_shown<'a>(layout: &RingLayout, state: &'a RunState, now: Time) -> Vec<Parcel<'a>> {
    let moving =
        |flight: &&Flight| flight.sent <= now && visibility(state, flight, now) > 0.0 && flight.cargo.atoms() > 0;
    let mut flights: Vec<_> = state.flights().iter().filter(moving).collect();
    // The sort is stable, so equal parcels do not flicker.
    flights.sort_by_key(|flight| std::cmp::Reverse(flight.cargo.atoms()));
    let mut transfers = 0;
    let parcel = |flight: &'a Flight| {
        let (from, to, node) = match (flight.from, flight.to, &flight.cargo) {
            (Party::Parent, Party::Node(to), Cargo::Band(_)) => {
                let (from, to_rim) = layout.path_ends(layout.centre, layout.seat(to));
                (from, to_rim, to)
            }
            (Party::Parent, Party::Node(to), Cargo::Again(_)) => {
                transfers += 1;
                let (from, to_rim) = layout.path_ends(layout.centre, layout.seat(to));
                (from, to_rim, to)
            }
            (Party::Node(from), Party::Node(to), Cargo::Transfer(_) | Cargo::Again(_)) => {
                transfers += 1;
                let (rim, to_rim) = layout.path_ends(layout.seat(from), layout.seat(to));
                (rim, to_rim, from)
            }
            _ => return None,
        };
        // All bands start at the parent: counts appear when the bands are apart.
        let in_heap = matches!(flight.cargo, Cargo::Band(_)) && flight.progress(now) < HEAP_PROGRESS;
        let is_detailed = transfers <= MAX_DETAILED && !in_heap;
        let alpha = if is_detailed || in_heap { 1.0 } else { HINT_ALPHA };
        Some(Parcel { flight, from, to, node, is_detailed, alpha: alpha * visibility(state, flight, now) })
    };
    flights.into_iter().filter_map(parcel).collect()
}

impl Parcel<'_> {
    /// Returns its text, its centre, and half of its width and height.
    fn shape(&self, layout: &RingLayout, now: Time) -> (String, Point, Point) {
        let text = format!("×{}", count(self.flight.cargo.atoms()));
        let letters = text.chars().count() as f32;
        let half = if !self.is_detailed {
            [0.16 * layout.node_radius; 2]
        } else if layout.labels.are_small() {
            [5.0 + 3.8 * letters, 9.0]
        } else {
            [7.0 + 4.6 * letters, 12.0].map(|side| side * layout.labels.text_scale)
        };
        let middle = curve(self.from, layout.bend(self.from, self.to), self.to, ease(self.flight.progress(now)));
        (text, middle, half)
    }

    fn draw(&self, layout: &RingLayout, now: Time, is_highlighted: bool, marks: &mut Vec<Mark>) {
        let (from, to, alpha) = (self.from, self.to, self.alpha);
        let (bend, here) = (layout.bend(from, to), ease(self.flight.progress(now)));
        let pieces = 24;
        let points = (0..=pieces).map(|i| curve(from, bend, to, here * i as f32 / pieces as f32)).collect();
        let hue = Hue::Node(self.node);
        marks.push(Mark::Trail { points, width: layout.node_radius * 0.5, ink: hue.faint(0.7 * alpha) });
        if !self.flight.shown().contains(&now) {
            return;
        }
        let (text, centre, half) = self.shape(layout, now);
        if !self.is_detailed {
            return marks.push(Mark::Box { centre, half, round: 0.5 * half[0], ink: hue.faint(alpha) });
        }
        let round = 6.0;
        if matches!(self.flight.cargo, Cargo::Again(_)) {
            // Copies have a second box behind the first.
            let behind = [centre[0] + 4.0, centre[1] - 4.0];
            marks.push(Mark::Box {
                centre: behind,
                half: half.map(|side| side + 2.0),
                round,
                ink: Hue::Ground.faint(alpha),
            });
            marks.push(Mark::Box { centre: behind, half, round, ink: hue.faint(0.6 * alpha) });
        }
        let (wide, border) = if is_highlighted { (HIGHLIGHT_BORDER_PX, Hue::Text) } else { (2.0, Hue::Ground) };
        marks.push(Mark::Box { centre, half: half.map(|side| side + wide), round, ink: border.faint(alpha) });
        marks.push(Mark::Box { centre, half, round, ink: hue.faint(alpha) });
        let ink = Hue::OnNode(self.node).faint(alpha);
        marks.push(Mark::Label { at: centre, anchor: Anchor::Centre, text, size: layout.labels.size(), ink });
    }
}

/// Messages of a kind that are drawn with details. People can follow four to six things at a time.
const MAX_DETAILED: usize = 6;
/// Opacity of the other messages.
const HINT_ALPHA: f32 = 0.3;
/// Width of the border of a highlighted message.
const HIGHLIGHT_BORDER_PX: f32 = 3.0;
/// Progress at which bands are apart, 0 to 1.
const HEAP_PROGRESS: f32 = 0.45;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::Language;
    use crate::view::tests::sample_runs;

    #[test]
    fn offers_do_not_cover_labels() {
        let language = Language::English;
        let header = sample_runs::header(&[1.0, 1.0, 1.0, 1.0, 1.0, 0.1], 600);
        let mut state = RunState::new(&header);
        let mut most = 0;
        for record in sample_runs::records(&header) {
            state.apply(&record);
            for size in [[560.0, 250.0], [330.0, 300.0], [640.0, 490.0], [1200.0, 900.0]] {
                let layout = RingLayout::new(header.speeds.len(), size, language);
                let discs = discs(&layout, &state, record.at);
                most = most.max(discs.len());
                for OfferDisc { centre: [x, y], radius, .. } in discs {
                    let out = (x - layout.centre[0]).hypot(y - layout.centre[1]) + radius + HIGHLIGHT_BORDER_PX;
                    assert!(out <= layout.rail_radius + layout.labels.gap() + 0.01, "{out} in {size:?}");
                }
            }
        }
        assert!(most > 1, "several offers at once");
    }
}
