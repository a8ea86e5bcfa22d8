//! What moves in the ring: results down the spokes, offers along the rail, atoms across.

use super::angles::{arc, curve, ease};
use super::layout::RingLayout;
use crate::balance::{NodeId, Party};
use crate::time::Time;
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::run_state::RunState;
use crate::view::text::format::{count, node_name};

/// Results stream down the spokes.
pub(crate) fn results(plan: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>) {
    let dot = (plan.rail * 0.011).clamp(1.5, 3.0);
    for flight in state.flights() {
        if let (Party::Node(from), Cargo::Results(_)) = (flight.from, &flight.cargo)
            && flight.shown().contains(&now)
            && state.opacity(now) > 0.0
        {
            let (start, end) = (plan.seats - plan.node * 1.3, plan.parent);
            let radius = start + (end - start) * flight.progress(now);
            let ink = Hue::Node(from).faint(state.opacity(now));
            marks.push(Mark::Disc { centre: plan.at(plan.angle(from), radius), radius: dot, ink });
        }
    }
}

/// Offers run along the rail; where an offer has been, its trail fades. Each has a lane of its own.
pub(crate) fn offers(plan: &RingLayout, state: &RunState, now: Time, lit: Option<u64>, marks: &mut Vec<Mark>) {
    for (lane, flight) in in_lanes(state, now) {
        let (Party::Node(from), Cargo::Offer { who }) = (flight.from, &flight.cargo) else { continue };
        let radius = plan.rail + lane_offset(plan, lane);
        let sweep = -plan.way(from, flight.to) * flight.progress(now);
        let strength = if lane < FOLLOWED { 0.9 } else { HINT };
        marks.push(Mark::Line {
            points: arc(plan.centre, radius, plan.angle(from), sweep),
            width: lane_width(plan),
            ink: Hue::Node(*who).faint(strength * seen_at(state, flight, now)),
        });
    }
    for token in tokens(plan, state, now) {
        token.draw(state, now, lit == Some(token.flight.id), marks);
    }
}

/// The offer whose token is drawn at `point`.
pub(crate) fn offer_at<'a>(plan: &RingLayout, state: &'a RunState, now: Time, [x, y]: Point) -> Option<&'a Flight> {
    let covers = |token: &OfferDisc<'_>| {
        let [u, v] = token.centre;
        token.flight.shown().contains(&now) && (x - u).hypot(y - v) <= token.radius + 2.0
    };
    tokens(plan, state, now).into_iter().rev().find(covers).map(|token| token.flight)
}

/// The disc of an offer that is on its way, or has just been: it lies where its last hop is.
struct OfferDisc<'a> {
    flight: &'a Flight,
    who: NodeId,
    centre: Point,
    radius: f32,
}

fn tokens<'a>(plan: &RingLayout, state: &'a RunState, now: Time) -> Vec<OfferDisc<'a>> {
    let hops = in_lanes(state, now);
    let last = |lane| hops.iter().rfind(|(other, _)| *other == lane).map(|(_, flight)| *flight);
    let token = |lane| {
        let flight = last(lane)?;
        let (Party::Node(from), Cargo::Offer { who }) = (flight.from, &flight.cargo) else { return None };
        let angle = plan.angle(from) - plan.way(from, flight.to) * flight.progress(now);
        let radius = (plan.node * 0.42).clamp(7.0, 13.0);
        // Further out it would lie on what is said of a node.
        let most = plan.labels.gap() - radius - BORDER;
        let centre = plan.at(angle, plan.rail + lane_offset(plan, lane).min(most));
        Some(OfferDisc { flight, who: *who, centre, radius })
    };
    (0..FOLLOWED).filter_map(token).collect()
}

/// The hops of offers that are seen, each with the lane of its offerer.
fn in_lanes(state: &RunState, now: Time) -> Vec<(usize, &Flight)> {
    let mut offerers: Vec<NodeId> = Vec::new();
    let seen = |flight: &&Flight| flight.sent <= now && seen_at(state, flight, now) > 0.0;
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
    fn draw(&self, state: &RunState, now: Time, is_lit: bool, marks: &mut Vec<Mark>) {
        let &OfferDisc { flight, who, centre, radius } = self;
        let alpha = seen_at(state, flight, now);
        let (wide, border) = if is_lit { (BORDER, Hue::Text) } else { (2.0, Hue::Ground) };
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

/// How strongly a flight or its trail is seen.
pub(crate) fn seen_at(state: &RunState, flight: &Flight, now: Time) -> f32 {
    flight.opacity(now) * state.opacity(now)
}

/// Lanes lie on the rail, then by turns outside and inside it; beyond eight they are shared.
pub(crate) fn lane_offset(plan: &RingLayout, lane: usize) -> f32 {
    let lane = lane % 8;
    let out = lane.div_ceil(2) as f32 * lane_width(plan);
    if lane % 2 == 1 { out } else { -out }
}

pub(crate) fn lane_width(plan: &RingLayout) -> f32 {
    (plan.rail * 0.025).clamp(1.5, 4.0)
}

/// Atoms on their way: bands from the parent, transfers from node to node, each with its count.
pub(crate) fn parcels(plan: &RingLayout, state: &RunState, now: Time, lit: Option<u64>, marks: &mut Vec<Mark>) {
    for parcel in on_their_way(plan, state, now).into_iter().rev() {
        parcel.draw(plan, now, lit == Some(parcel.flight.id), marks);
    }
}

/// The flight of the parcel that is drawn at `point`.
pub(crate) fn parcel_at<'a>(plan: &RingLayout, state: &'a RunState, now: Time, [x, y]: Point) -> Option<&'a Flight> {
    let covers = |parcel: &Parcel<'_>| {
        let (_, [u, v], half) = parcel.shape(plan, now);
        parcel.flight.shown().contains(&now) && (x - u).abs() <= half[0] && (y - v).abs() <= half[1]
    };
    on_their_way(plan, state, now).into_iter().find(covers).map(|parcel| parcel.flight)
}

/// A message with atoms as it is drawn.
struct Parcel<'a> {
    flight: &'a Flight,
    from: Point,
    to: Point,
    node: NodeId,
    /// Or only hinted at.
    is_followed: bool,
    /// How strongly it is seen.
    strength: f32,
}

/// The parcels that are drawn, the largest first; it lies on top.
fn on_their_way<'a>(plan: &RingLayout, state: &'a RunState, now: Time) -> Vec<Parcel<'a>> {
    let moving = |flight: &&Flight| flight.sent <= now && seen_at(state, flight, now) > 0.0 && flight.cargo.atoms() > 0;
    let mut flights: Vec<_> = state.flights().iter().filter(moving).collect();
    // The sort keeps the order of equals, so nothing flickers.
    flights.sort_by_key(|flight| std::cmp::Reverse(flight.cargo.atoms()));
    let mut transfers = 0;
    let parcel = |flight: &'a Flight| {
        let (from, to, node) = match (flight.from, flight.to, &flight.cargo) {
            (Party::Parent, Party::Node(to), Cargo::Band(_)) => {
                let (from, to_rim) = plan.between(plan.centre, plan.seat(to));
                (from, to_rim, to)
            }
            (Party::Parent, Party::Node(to), Cargo::Again(_)) => {
                transfers += 1;
                let (from, to_rim) = plan.between(plan.centre, plan.seat(to));
                (from, to_rim, to)
            }
            (Party::Node(from), Party::Node(to), Cargo::Transfer(_) | Cargo::Again(_)) => {
                transfers += 1;
                let (rim, to_rim) = plan.between(plan.seat(from), plan.seat(to));
                (rim, to_rim, from)
            }
            _ => return None,
        };
        // Bands begin in a heap: each has its count once it has left it.
        let in_heap = matches!(flight.cargo, Cargo::Band(_)) && flight.progress(now) < CLEAR;
        let is_followed = transfers <= FOLLOWED && !in_heap;
        let strength = if is_followed || in_heap { 1.0 } else { HINT };
        Some(Parcel { flight, from, to, node, is_followed, strength: strength * seen_at(state, flight, now) })
    };
    flights.into_iter().filter_map(parcel).collect()
}

impl Parcel<'_> {
    /// Its text, its middle, and half its width and height.
    fn shape(&self, plan: &RingLayout, now: Time) -> (String, Point, Point) {
        let text = format!("×{}", count(self.flight.cargo.atoms()));
        let letters = text.chars().count() as f32;
        let half = if !self.is_followed {
            [0.16 * plan.node; 2]
        } else if plan.labels.are_small() {
            [5.0 + 3.8 * letters, 9.0]
        } else {
            [7.0 + 4.6 * letters, 12.0].map(|side| side * plan.labels.text)
        };
        let middle = curve(self.from, plan.bend(self.from, self.to), self.to, ease(self.flight.progress(now)));
        (text, middle, half)
    }

    fn draw(&self, plan: &RingLayout, now: Time, is_lit: bool, marks: &mut Vec<Mark>) {
        let (from, to, alpha) = (self.from, self.to, self.strength);
        let (bend, here) = (plan.bend(from, to), ease(self.flight.progress(now)));
        let pieces = 24;
        let points = (0..=pieces).map(|i| curve(from, bend, to, here * i as f32 / pieces as f32)).collect();
        let hue = Hue::Node(self.node);
        marks.push(Mark::Trail { points, width: plan.node * 0.5, ink: hue.faint(0.7 * alpha) });
        if !self.flight.shown().contains(&now) {
            return;
        }
        let (text, centre, half) = self.shape(plan, now);
        if !self.is_followed {
            return marks.push(Mark::Box { centre, half, round: 0.5 * half[0], ink: hue.faint(alpha) });
        }
        let round = 6.0;
        if matches!(self.flight.cargo, Cargo::Again(_)) {
            // A copy looks like a second sheet behind the first.
            let behind = [centre[0] + 4.0, centre[1] - 4.0];
            marks.push(Mark::Box {
                centre: behind,
                half: half.map(|side| side + 2.0),
                round,
                ink: Hue::Ground.faint(alpha),
            });
            marks.push(Mark::Box { centre: behind, half, round, ink: hue.faint(0.6 * alpha) });
        }
        let (wide, border) = if is_lit { (BORDER, Hue::Text) } else { (2.0, Hue::Ground) };
        marks.push(Mark::Box { centre, half: half.map(|side| side + wide), round, ink: border.faint(alpha) });
        marks.push(Mark::Box { centre, half, round, ink: hue.faint(alpha) });
        let ink = Hue::OnNode(self.node).faint(alpha);
        marks.push(Mark::Label { at: centre, anchor: Anchor::Centre, text, size: plan.labels.size(), ink });
    }
}

/// People follow four to six things at a time: more of a kind are only hinted at.
const FOLLOWED: usize = 6;
const HINT: f32 = 0.3;
/// How broad the border of what stands out is.
const BORDER: f32 = 3.0;
/// How far bands are on their way when they have left each other.
const CLEAR: f32 = 0.45;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::Language;
    use crate::view::tests::sample_runs;

    #[test]
    fn no_offer_lies_on_what_is_said_of_a_node() {
        let language = Language::English;
        let header = sample_runs::header(&[1.0, 1.0, 1.0, 1.0, 1.0, 0.1], 600);
        let mut state = RunState::new(&header);
        let mut most = 0;
        for record in sample_runs::records(&header) {
            state.apply(&record);
            for size in [[560.0, 250.0], [330.0, 300.0], [640.0, 490.0], [1200.0, 900.0]] {
                let plan = RingLayout::new(header.speeds.len(), size, language);
                let tokens = tokens(&plan, &state, record.at);
                most = most.max(tokens.len());
                for OfferDisc { centre: [x, y], radius, .. } in tokens {
                    let out = (x - plan.centre[0]).hypot(y - plan.centre[1]) + radius + BORDER;
                    assert!(out <= plan.rail + plan.labels.gap() + 0.01, "{out} in {size:?}");
                }
            }
        }
        assert!(most > 1, "several offers at once");
    }
}
