//! Offers of help on the rail: a disc with the number of the machine that offers, and a fading trail.

use std::f32::consts::TAU;

use super::angles::arc;
use super::emphasis::{HIGHLIGHT_BORDER_PX, MAX_DETAILED, visibility};
use super::layers::RingLayer;
use super::layout::RingLayout;
use crate::balance::{NodeId, Party};
use crate::time::Time;
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::run_state::RunState;
use crate::view::text::format::node_name;

/// Draws offers and their fading trails. Each offer has its own lane. The message with the id `highlighted` stands
/// out.
pub(crate) fn draw(layout: &RingLayout, state: &RunState, now: Time, highlighted: Option<u64>, marks: &mut Vec<Mark>) {
    trails(layout, state, now, marks);
    for disc in discs(layout, state, now) {
        disc.draw(highlighted == Some(disc.flight.id), marks);
    }
}

/// Finds the offer whose disc is drawn at `point`, and its layer.
pub(crate) fn offer_at<'a>(
    layout: &RingLayout,
    state: &'a RunState,
    now: Time,
    [x, y]: Point,
) -> Option<(RingLayer, &'a Flight)> {
    let covers = |disc: &OfferDisc<'_>| {
        let [u, v] = disc.centre;
        disc.flight.shown().contains(&now) && (x - u).hypot(y - v) <= disc.radius + 2.0
    };
    let disc = discs(layout, state, now).into_iter().rev().find(covers);
    disc.map(|disc| (RingLayer::Offers, disc.flight))
}

/// Draws the trails. They are shorter and paler where there are many.
fn trails(layout: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>) {
    let offers = offers_shown(state, now);
    let crowd: f32 = offers.iter().filter_map(|hops| Some(visibility(state, hops.last()?, now))).sum();
    let share = (CALM_OFFERS / crowd.max(CALM_OFFERS)).max(0.15);
    let (longest, strength) = (TAU * share, 0.9 * share.sqrt());
    for (lane, hops) in offers.iter().enumerate() {
        let radius = layout.rail_radius + lane_offset(layout, lane);
        let mut behind = 0.0;
        for (flight, who, from) in hops.iter().rev().filter_map(|flight| of_offer(flight)) {
            let sweep = layout.offer_sweep(from, flight.to) * flight.progress(now);
            let length = sweep.min(longest - behind);
            if length <= 0.0 {
                break;
            }
            let fading = 1.0 - (behind + length / 2.0) / longest;
            let end = layout.angle(from) - sweep;
            marks.push(Mark::Line {
                points: arc(layout.centre, radius, end + length, -length),
                width: lane_width(layout),
                ink: Hue::Node(who).faint(strength * fading * visibility(state, flight, now)),
            });
            behind += length;
        }
    }
}

/// Disc of an offer on its last hop; it stays for a while after the arrival.
struct OfferDisc<'a> {
    flight: &'a Flight,
    who: NodeId,
    centre: Point,
    radius: f32,
    alpha: f32,
}

/// Returns the discs, the last sent on top. Where two would meet, the earlier one fades.
fn discs<'a>(layout: &RingLayout, state: &'a RunState, now: Time) -> Vec<OfferDisc<'a>> {
    let disc = |(lane, hops): (usize, Vec<&'a Flight>)| {
        let (flight, who, from) = of_offer(hops.last()?)?;
        let angle = layout.angle(from) - layout.offer_sweep(from, flight.to) * flight.progress(now);
        // Further out it would cover a label, further in a machine.
        let gap = layout.labels.gap();
        let radius = (0.42 * layout.node_radius).max(7.0).min(0.5 * gap + 1.5);
        let least = radius + 1.0 - (layout.rail_radius - layout.seat_radius - layout.node_reach());
        let offset = lane_offset(layout, lane).max(least).min(gap - radius - HIGHLIGHT_BORDER_PX);
        let centre = layout.at(angle, layout.rail_radius + offset);
        Some(OfferDisc { flight, who, centre, radius, alpha: visibility(state, flight, now) })
    };
    let offers = offers_shown(state, now).into_iter().enumerate().take(MAX_DETAILED);
    let mut discs: Vec<_> = offers.filter_map(disc).collect();
    discs.sort_by_key(|disc| disc.flight.sent);
    for i in 0..discs.len() {
        let (earlier, later) = discs.split_at_mut(i + 1);
        let OfferDisc { centre: [x, y], radius, alpha, .. } = &mut earlier[i];
        let gaps = later.iter().map(|other| {
            let [u, v] = other.centre;
            (*x - u).hypot(*y - v) - *radius - other.radius
        });
        *alpha *= (gaps.fold(f32::INFINITY, f32::min) / 4.0).clamp(0.0, 1.0);
    }
    discs.retain(|disc| disc.alpha > 0.0);
    discs
}

/// Returns the visible hops of each offer, by offerer.
fn offers_shown(state: &RunState, now: Time) -> Vec<Vec<&Flight>> {
    let mut offers: Vec<(NodeId, Vec<&Flight>)> = Vec::new();
    let is_seen = |flight: &&Flight| flight.sent <= now && visibility(state, flight, now) > 0.0;
    for flight in state.flights().iter().filter(is_seen) {
        let Some((_, who, _)) = of_offer(flight) else { continue };
        match offers.iter_mut().find(|(other, _)| *other == who) {
            Some((_, hops)) => hops.push(flight),
            None => offers.push((who, vec![flight])),
        }
    }
    offers.into_iter().map(|(_, hops)| hops).collect()
}

/// Returns a hop of an offer, the node that offers, and the node that has sent the hop; `None` for another message.
fn of_offer(flight: &Flight) -> Option<(&Flight, NodeId, NodeId)> {
    match (flight.from, &flight.cargo) {
        (Party::Node(from), Cargo::Offer { who }) => Some((flight, *who, from)),
        _ => None,
    }
}

impl OfferDisc<'_> {
    /// Draws it hollow: the machine has nothing left to trace.
    fn draw(&self, is_highlighted: bool, marks: &mut Vec<Mark>) {
        let &OfferDisc { who, centre, radius, alpha, .. } = self;
        let (wide, border) = if is_highlighted { (HIGHLIGHT_BORDER_PX, Hue::Text) } else { (2.0, Hue::Ground) };
        let line = (0.2 * radius).max(1.5);
        marks.push(Mark::Disc { centre, radius: radius + wide, ink: border.faint(alpha) });
        marks.push(Mark::Disc { centre, radius, ink: Hue::Node(who).faint(alpha) });
        marks.push(Mark::Disc { centre, radius: radius - line, ink: Hue::Ground.faint(alpha) });
        marks.push(Mark::Label {
            at: centre,
            anchor: Anchor::Centre,
            text: node_name(who).to_string(),
            size: TextSize::Fit(radius * 1.2),
            ink: Hue::Text.faint(alpha),
        });
    }
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

/// Offers whose trails may be as long as the rail.
const CALM_OFFERS: f32 = 2.0;

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
