//! Small marks of the adaptive ring: sparks for messages that wake a node, and crosses where messages were lost.

use super::angles::{curve, ease};
use super::emphasis::visibility;
use super::layers::{RingLayer, RingMarks};
use super::layout::RingLayout;
use crate::balance::Party;
use crate::time::Time;
use crate::view::draw::display_list::{Hue, Mark, Point};
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::run_state::RunState;

/// Draws wake messages and the crosses of lost messages.
pub(crate) fn draw(layout: &RingLayout, state: &RunState, now: Time, marks: &mut RingMarks) {
    wakes(layout, state, now, marks.layer(RingLayer::Wakes));
    losses(layout, state, now, marks.layer(RingLayer::Losses));
}

/// Draws each wake message as a spark on the straight path from node to node.
fn wakes(layout: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>) {
    for flight in state.flights().iter().filter(|flight| flight.cargo == Cargo::Wake && flight.sent <= now) {
        let (Party::Node(from), alpha) = (flight.from, visibility(state, flight, now)) else { continue };
        if alpha == 0.0 {
            continue;
        }
        let ([start, end], here) = (path_ends(layout, flight), flight.progress(now));
        let at = |way: f32| [start[0] + (end[0] - start[0]) * way, start[1] + (end[1] - start[1]) * way];
        let (hue, points) = (Hue::Node(from), vec![at((here - 0.35).max(0.0)), at(here)]);
        marks.push(Mark::Trail { points, width: 4.0, ink: hue.faint(0.8 * alpha) });
        if flight.shown().contains(&now) {
            let radius = (layout.node_radius * 0.14).clamp(2.5, 5.0);
            marks.push(Mark::Disc { centre: at(here), radius: radius + 1.5, ink: Hue::Ground.faint(alpha) });
            marks.push(Mark::Disc { centre: at(here), radius, ink: hue.faint(alpha) });
        }
    }
}

/// Draws a small cross where a message was lost.
fn losses(layout: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>) {
    for flight in state.flights() {
        let alpha = flight.cross_opacity(now) * state.opacity(now);
        if alpha == 0.0 {
            continue;
        }
        let ([x, y], arm) = (position(layout, flight, now), (layout.node_radius * 0.2).clamp(3.5, 6.0));
        for (width, ink) in [(5.0, Hue::Ground.faint(alpha)), (2.5, Hue::Text.faint(alpha))] {
            for side in [-arm, arm] {
                marks.push(Mark::Line { points: vec![[x - arm, y - side], [x + arm, y + side]], width, ink });
            }
        }
    }
}

/// Returns the point at which a message is drawn.
fn position(layout: &RingLayout, flight: &Flight, now: Time) -> Point {
    let here = flight.progress(now);
    if let (Party::Node(from), Cargo::Offer { .. }) = (flight.from, &flight.cargo) {
        return layout.at(layout.angle(from) - layout.offer_sweep(from, flight.to) * here, layout.rail_radius);
    }
    let [start, end] = path_ends(layout, flight);
    let bend = match flight.cargo {
        Cargo::Transfer(_) | Cargo::Again(_) | Cargo::Band(_) => layout.bend(start, end),
        _ => [(start[0] + end[0]) / 2.0, (start[1] + end[1]) / 2.0],
    };
    curve(start, bend, end, ease(here))
}

/// Returns the start and the end of a message's path.
fn path_ends(layout: &RingLayout, flight: &Flight) -> [Point; 2] {
    let seat = |party| match party {
        Party::Parent => layout.centre,
        Party::Node(node) => layout.seat(node),
    };
    let (start, end) = layout.path_ends(seat(flight.from), seat(flight.to));
    [start, end]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::{Condition, Strategy};
    use crate::language::Language;
    use crate::scenario::Command;
    use crate::sim::Sim;
    use crate::view::tests::sample_runs;

    #[test]
    fn lost_messages_and_wakes_are_drawn() {
        let language = Language::English;
        let mut header = sample_runs::header(&[1.0; 4], 900);
        header.rules.strategy = Strategy::Adaptive;
        let slow = Command::Speed { node: 3, speed: 0.01 };
        let off = Command::Condition { node: 2, condition: Condition::Off };
        let well = Command::Condition { node: 2, condition: Condition::Well };
        let script = [(2.0, slow), (2.1, off), (2.6, well)].map(|(at, command)| (Time::from_secs(at), command));
        let mut state = RunState::new(&header);
        let (mut crossed, mut sparked, mut copied) = (0, 0, 0);
        Sim::new(&header, &script, |_| sample_runs::COST).run(&mut |record| {
            state.apply(&record);
            let layout = RingLayout::new(4, [520.0, 480.0], language);
            let drawn = |draw: fn(&RingLayout, &RunState, Time, &mut Vec<Mark>)| {
                let mut marks = Vec::new();
                draw(&layout, &state, record.at, &mut marks);
                marks.len()
            };
            crossed += drawn(losses);
            sparked += drawn(wakes);
            let is_copy = |flight: &&Flight| matches!(flight.cargo, Cargo::Again(_));
            copied += state.flights().iter().filter(is_copy).count();
        });
        assert!(crossed > 0 && sparked > 0 && copied > 0, "{crossed} {sparked} {copied}");
    }
}
