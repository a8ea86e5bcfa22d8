//! The run as it is shown at one time: what moves, and what each node does.

use std::borrow::Cow;
use std::time::Duration;

use super::flight::{Cargo, Flight};
use super::node_state::{Activity, NodeState};
use super::run_state::RunState;
use crate::balance::{Condition, NodeId, Party, Remedy};
use crate::picture::Atom;
use crate::time::Time;

impl RunState {
    /// Whether anything moves at `now`: a drawn message, a machine that traces, a falling rate, or the line at the
    /// parent.
    pub fn moves(&self, now: Time) -> bool {
        let flies = self.flights.iter().any(|flight| flight.gone() > now) && self.opacity(now) > 0.0;
        let works = |node: &NodeState| node.computes() || node.rate(now) > 0.0;
        flies || self.finished.is_none() && (self.nodes.iter().any(works) || self.is_in_line(now))
    }

    /// Opacity of everything that moves at `now`, 0 to 1: it fades out once the picture is complete.
    pub fn opacity(&self, now: Time) -> f32 {
        const FADE_TIME: Duration = Duration::from_millis(250);
        let after = self.finished.map_or(Duration::ZERO, |end| now.since(end));
        1.0 - (after.as_secs_f64() / (FADE_TIME.as_secs_f64() * self.rate())).min(1.0) as f32
    }

    /// The number of messages that have arrived at the parent and that it has not handled yet at `now`.
    pub fn line_length(&self, now: Time) -> usize {
        self.in_line(now).count()
    }

    /// Whether messages wait at a parent that is busy for some time with each.
    fn is_in_line(&self, now: Time) -> bool {
        !self.handling.is_zero() && self.line_length(now) > 0
    }

    /// Messages that have arrived at the parent and that it has not handled yet at `now`, in the order of their
    /// numbers.
    pub(crate) fn in_line(&self, now: Time) -> impl Iterator<Item = &Flight> {
        /// Records come in batches: this late at most.
        const BATCH_DELAY: Duration = Duration::from_millis(100);
        // The parent's records up to its latest one are complete.
        let known = self.parent_head.min(now);
        let goes_on = self.finished.is_none_or(|end| now < end);
        let waits = move |flight: &&Flight| {
            goes_on && flight.to == Party::Parent && (flight.arrives < known || flight.arrives + BATCH_DELAY <= now)
        };
        self.pending.values().filter(waits)
    }

    /// Returns a node as it is shown at `now`. Parcels are drawn slower than they travel, and atoms in a parcel that is
    /// still drawn on its way do not count as the node's yet. The parts of a farm are drawn about as fast as they
    /// travel, and of its band a node traces the first atoms at once.
    pub(crate) fn node_as_drawn(&self, node: NodeId, now: Time) -> Cow<'_, NodeState> {
        let state = &self.nodes[usize::from(node)];
        let lands = |flight: &&Flight| {
            let is_part = matches!(flight.cargo, Cargo::Part(_) | Cargo::Band(_));
            let lands = flight.to == Party::Node(node) && flight.arrives <= now && flight.shown().contains(&now);
            lands && flight.lost.is_none() && !is_part
        };
        let landing: u32 = match self.finished {
            None => self.flights.iter().filter(lands).map(|flight| flight.cargo.atoms()).sum(),
            Some(_) => 0,
        };
        if landing == 0 { Cow::Borrowed(state) } else { Cow::Owned(state.without(landing)) }
    }

    /// Whether any atoms are on their way to a machine.
    pub(crate) fn has_atoms_under_way(&self) -> bool {
        let carries = |flight: &Flight| {
            matches!(flight.cargo, Cargo::Band(_) | Cargo::Part(_) | Cargo::Transfer(_) | Cargo::Again(_))
        };
        self.pending.values().any(carries)
    }

    /// Finds the message in which `atom` is on its way to a node.
    pub fn carrier(&self, atom: Atom) -> Option<&Flight> {
        let carries = |flight: &&Flight| {
            let goes_to_a_node = !matches!(flight.cargo, Cargo::Results(_));
            goes_to_a_node && flight.cargo.ranges().iter().any(|range| range.contains(&atom))
        };
        self.pending.values().find(carries)
    }

    /// Returns what `node` does at `now`, as it is shown.
    pub fn activity(&self, node: NodeId, now: Time) -> Activity {
        let state = &self.nodes[usize::from(node)];
        // An offer may be away for an instant only: it counts as long as its drawing.
        let offers =
            self.flights.iter().any(|flight| flight.cargo == Cargo::Offer { who: node } && flight.opacity(now) > 0.4);
        let offers_again = state.awaits_answer && state.left() == 0 && !self.is_sent_atoms(node);
        let is_over = self.finished.is_some_and(|end| end <= now);
        if state.spare {
            Activity::Spare
        } else if state.condition != Condition::Well {
            match state.condition {
                Condition::Off => Activity::Off,
                Condition::Hung => Activity::Hung,
                Condition::CutOff | Condition::Well => Activity::CutOff,
            }
        } else if is_over {
            Activity::Done
        } else if state.retired && state.left() == 0 {
            match &self.scheduler {
                scheduler if scheduler.is_farm() => Activity::NoMore,
                _ if self.has(Remedy::Wake) => Activity::Asleep,
                _ => Activity::Retired,
            }
        } else if state.band_at.is_none() {
            Activity::NoBand
        } else if state.paused && state.left() > 0 {
            Activity::Paused
        } else if self.receives(node, now) && !offers_again {
            Activity::Receiving
        } else if state.left() > 0 {
            if state.speed > 0.0 { Activity::Tracing } else { Activity::SpeedZero }
        } else if self.scheduler.is_farm() && state.awaits_answer {
            self.request_progress(node, now)
        } else if state.awaits_answer || offers {
            Activity::Offering
        } else {
            Activity::Idle
        }
    }

    /// Tells how far the request of `node` is.
    fn request_progress(&self, node: NodeId, now: Time) -> Activity {
        let (mut asks, mut gets) = (false, false);
        for flight in self.pending.values() {
            asks |= flight.from == Party::Node(node) && flight.cargo == Cargo::Request && now < flight.arrives;
            gets |= flight.to == Party::Node(node) && matches!(flight.cargo, Cargo::Part(_));
        }
        match (asks, gets) {
            (_, true) => Activity::Receiving,
            (true, false) => Activity::Asking,
            (false, false) => Activity::InLine,
        }
    }

    /// Whether a parcel for `node` has not arrived yet: its drawing may go on after that, while the node offers again.
    fn is_sent_atoms(&self, node: NodeId) -> bool {
        let carries = |flight: &Flight| matches!(flight.cargo, Cargo::Transfer(_) | Cargo::Again(_));
        self.pending.values().any(|flight| flight.to == Party::Node(node) && carries(flight))
    }

    /// Whether a parcel for `node` is drawn at `now`.
    fn receives(&self, node: NodeId, now: Time) -> bool {
        self.flights.iter().any(|flight| {
            flight.to == Party::Node(node)
                && matches!(flight.cargo, Cargo::Transfer(_) | Cargo::Again(_))
                && flight.lost.is_none()
                && flight.shown().contains(&now)
        })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::record::{Record, RecordKind};
    use crate::view::tests::sample_runs;

    #[test]
    fn slow_node_traces_while_others_offer_and_receive() {
        let header = sample_runs::header(&[1.0, 1.0, 0.1], 60);
        let mut state = RunState::new(&header);
        let mut seen = BTreeSet::new();
        for record in sample_runs::records(&header) {
            state.apply(&record);
            for node in 0..3 {
                let activity = state.activity(node, record.at);
                seen.insert((node, format!("{activity:?}")));
            }
        }
        for kind in ["NoBand", "Tracing", "Offering", "Receiving", "Done"] {
            assert!(seen.contains(&(1, kind.to_owned())), "{kind} {seen:?}");
        }
        assert!(state.nodes[1].done > 20 && state.nodes[2].done < 20, "{:?}", state.nodes);
        let idle: Vec<_> = state.nodes.iter().map(|node| node.idle(state.head())).collect();
        assert!(
            idle.iter().all(|&idle| idle >= Duration::from_millis(40) && idle < Duration::from_secs(1)),
            "{idle:?}"
        );
    }

    #[test]
    fn paused_node_is_shown_as_paused_while_it_has_atoms() {
        let header = sample_runs::header(&[1.0, 1.0, 0.1], 60);
        let mut state = RunState::new(&header);
        let mut seen = Vec::new();
        for record in sample_runs::records(&header) {
            state.apply(&record);
            if seen.is_empty() {
                state.apply(&Record { at: record.at, kind: RecordKind::Paused { node: 1 } });
            }
            let activity = state.activity(1, record.at);
            assert!(activity != Activity::Tracing, "{record:?}");
            assert!((activity == Activity::Paused) <= (state.nodes[1].left() > 0));
            seen.push(activity);
        }
        for activity in [Activity::NoBand, Activity::Paused, Activity::Offering, Activity::Receiving] {
            assert!(seen.contains(&activity), "{activity:?} {seen:?}");
        }
    }

    #[test]
    fn carrier_is_found_until_the_atom_arrives() {
        let header = sample_runs::header(&[1.0, 1.0, 0.1], 60);
        let mut state = RunState::new(&header);
        let mut carriers = BTreeSet::new();
        for record in sample_runs::records(&header) {
            state.apply(&record);
            if let Some(flight) = state.carrier(59) {
                assert!(flight.sent <= record.at && state.atom_states()[59].owner().is_none());
                carriers.insert((flight.from, flight.to));
            }
        }
        assert!(carriers.contains(&(Party::Parent, Party::Node(2))) && carriers.len() > 1, "{carriers:?}");
        assert_eq!(state.carrier(59), None);
    }

    #[test]
    fn nothing_moves_while_all_machines_are_stopped_nor_after_the_end() {
        let header = sample_runs::header(&[1.0, 1.0], 40);
        let mut state = RunState::new(&header);
        let records = sample_runs::records(&header);
        records.iter().take(30).for_each(|record| state.apply(record));
        let later = state.head() + Duration::from_secs(5);
        assert!(state.moves(later));
        for node in 0..2 {
            assert!(state.moves(later));
            state.apply(&Record { at: state.head(), kind: RecordKind::SpeedSet { node, speed: 0.0 } });
        }
        assert!(state.moves(state.head()), "something is still in flight");
        assert!(!state.moves(later));
        state.apply(&Record { at: later, kind: RecordKind::SpeedSet { node: 1, speed: 0.3 } });
        assert!(state.moves(later));

        records.iter().skip(30).for_each(|record| state.apply(record));
        let end = state.finished().expect("the run is complete");
        assert!(state.opacity(end) == 1.0 && state.opacity(end + Duration::from_millis(400)) == 0.0);
        assert!(!state.moves(end + Duration::from_millis(400)));
    }
}
