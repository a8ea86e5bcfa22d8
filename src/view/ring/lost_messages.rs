//! What is small and quick in the ring that adapts: sparks that wake sleepers, and crosses where messages are lost.

use super::angles::{curve, ease};
use super::layout::RingLayout;
use super::messages::seen_at;
use crate::balance::Party;
use crate::time::Time;
use crate::view::draw::display_list::{Hue, Mark, Point};
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::run_state::RunState;

/// Sparks fly straight from machine to machine.
pub(crate) fn sparks(plan: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>) {
    for flight in state.flights().iter().filter(|flight| flight.cargo == Cargo::Wake && flight.sent <= now) {
        let (Party::Node(from), alpha) = (flight.from, seen_at(state, flight, now)) else { continue };
        if alpha == 0.0 {
            continue;
        }
        let ([start, end], here) = (ends(plan, flight), flight.progress(now));
        let at = |way: f32| [start[0] + (end[0] - start[0]) * way, start[1] + (end[1] - start[1]) * way];
        let (hue, points) = (Hue::Node(from), vec![at((here - 0.35).max(0.0)), at(here)]);
        marks.push(Mark::Trail { points, width: 4.0, ink: hue.faint(0.8 * alpha) });
        if flight.shown().contains(&now) {
            let radius = (plan.node * 0.14).clamp(2.5, 5.0);
            marks.push(Mark::Disc { centre: at(here), radius: radius + 1.5, ink: Hue::Ground.faint(alpha) });
            marks.push(Mark::Disc { centre: at(here), radius, ink: hue.faint(alpha) });
        }
    }
}

/// A small cross stands where a message is lost.
pub(crate) fn crosses(plan: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>) {
    for flight in state.flights() {
        let alpha = flight.cross_opacity(now) * state.opacity(now);
        if alpha == 0.0 {
            continue;
        }
        let ([x, y], arm) = (place(plan, flight, now), (plan.node * 0.2).clamp(3.5, 6.0));
        for (width, ink) in [(5.0, Hue::Ground.faint(alpha)), (2.5, Hue::Text.faint(alpha))] {
            for side in [-arm, arm] {
                marks.push(Mark::Line { points: vec![[x - arm, y - side], [x + arm, y + side]], width, ink });
            }
        }
    }
}

/// Where a message is drawn.
fn place(plan: &RingLayout, flight: &Flight, now: Time) -> Point {
    let here = flight.progress(now);
    if let (Party::Node(from), Cargo::Offer { .. }) = (flight.from, &flight.cargo) {
        return plan.at(plan.angle(from) - plan.way(from, flight.to) * here, plan.rail);
    }
    let [start, end] = ends(plan, flight);
    let bend = match flight.cargo {
        Cargo::Transfer(_) | Cargo::Again(_) | Cargo::Band(_) => plan.bend(start, end),
        _ => [(start[0] + end[0]) / 2.0, (start[1] + end[1]) / 2.0],
    };
    curve(start, bend, end, ease(here))
}

/// Where it begins and where it would end.
fn ends(plan: &RingLayout, flight: &Flight) -> [Point; 2] {
    let seat = |party| match party {
        Party::Parent => plan.centre,
        Party::Node(node) => plan.seat(node),
    };
    let (start, end) = plan.between(seat(flight.from), seat(flight.to));
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
    fn what_is_lost_and_who_is_woken_is_seen() {
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
            let plan = RingLayout::new(4, [520.0, 480.0], language);
            let drawn = |draw: fn(&RingLayout, &RunState, Time, &mut Vec<Mark>)| {
                let mut marks = Vec::new();
                draw(&plan, &state, record.at, &mut marks);
                marks.len()
            };
            crossed += drawn(crosses);
            sparked += drawn(sparks);
            let is_copy = |flight: &&Flight| matches!(flight.cargo, Cargo::Again(_));
            copied += state.flights().iter().filter(is_copy).count();
        });
        assert!(crossed > 0 && sparked > 0 && copied > 0, "{crossed} {sparked} {copied}");
    }
}
