//! What is seen of a run at some time: what moves, and what each node does.

use std::time::Duration;

use super::flight::{Cargo, Flight};
use super::node::{Activity, NodeState};
use super::state::RunState;
use crate::balance::{NodeId, Party};
use crate::time::Time;

impl RunState {
    /// Whether anything moves at `now`: a message that is drawn, or a machine that computes.
    pub fn moves(&self, now: Time) -> bool {
        let flies = self.flights.iter().any(|flight| flight.gone() > now) && self.presence(now) > 0.0;
        flies || self.finished.is_none() && self.nodes.iter().any(NodeState::computes)
    }

    /// How strongly what moves is seen at `now`, 0 to 1: once the picture is complete it soon makes way for the
    /// result.
    pub fn presence(&self, now: Time) -> f32 {
        const FADE: Duration = Duration::from_millis(250);
        let after = self.finished.map_or(Duration::ZERO, |end| now.since(end));
        1.0 - (after.as_secs_f64() / FADE.as_secs_f64()).min(1.0) as f32
    }

    /// Whether atoms are on their way to a machine.
    pub(super) fn has_atoms_under_way(&self) -> bool {
        let carries = |flight: &Flight| matches!(flight.cargo, Cargo::Band(_) | Cargo::Transfer(_));
        self.pending.values().any(carries)
    }

    /// What `node` is seen doing at `now`.
    pub fn activity(&self, node: NodeId, now: Time) -> Activity {
        let state = &self.nodes[usize::from(node)];
        // What lasts only an instant is shown for as long as it is drawn.
        let offers =
            self.flights.iter().any(|flight| flight.cargo == Cargo::Offer { who: node } && flight.presence(now) > 0.4);
        if self.finished.is_some_and(|end| end <= now) {
            Activity::Done
        } else if state.retired {
            Activity::Retired
        } else if !state.has_band {
            Activity::Waiting
        } else if self.receives(node, now) {
            Activity::Receiving
        } else if state.left() > 0 {
            if state.speed > 0.0 { Activity::Computing } else { Activity::Stopped }
        } else if state.offer_out || offers {
            Activity::Offering
        } else {
            Activity::Idle
        }
    }

    /// Whether atoms on their way to `node` are drawn at `now`.
    fn receives(&self, node: NodeId, now: Time) -> bool {
        self.flights.iter().any(|flight| {
            flight.to == Party::Node(node)
                && matches!(flight.cargo, Cargo::Transfer(_))
                && flight.shown().contains(&now)
        })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::sample;
    use super::*;
    use crate::record::{Record, What};

    #[test]
    fn a_slow_node_computes_while_the_others_offer_and_receive() {
        let header = sample::header(&[1.0, 1.0, 0.1], 60);
        let mut state = RunState::new(&header);
        let mut seen = BTreeSet::new();
        for record in sample::records(&header) {
            state.apply(&record);
            for node in 0..3 {
                let activity = state.activity(node, record.at);
                seen.insert((node, format!("{activity:?}")));
            }
        }
        for what in ["Waiting", "Computing", "Offering", "Receiving", "Done"] {
            assert!(seen.contains(&(1, what.to_owned())), "{what} {seen:?}");
        }
        assert!(state.nodes[1].done > 20 && state.nodes[2].done < 20, "{:?}", state.nodes);
        let idle: Vec<_> = state.nodes.iter().map(|node| node.idle(state.head())).collect();
        assert!(
            idle.iter().all(|&idle| idle >= Duration::from_millis(40) && idle < Duration::from_secs(1)),
            "{idle:?}"
        );
    }

    #[test]
    fn nothing_moves_while_all_machines_stand_still_nor_after_the_end() {
        let header = sample::header(&[1.0, 1.0], 40);
        let mut state = RunState::new(&header);
        let records = sample::records(&header);
        records.iter().take(30).for_each(|record| state.apply(record));
        let later = state.head() + Duration::from_secs(5);
        assert!(state.moves(later));
        for node in 0..2 {
            assert!(state.moves(later));
            state.apply(&Record { at: state.head(), what: What::SpeedSet { node, speed: 0.0 } });
        }
        assert!(state.moves(state.head()), "something is still in flight");
        assert!(!state.moves(later));
        state.apply(&Record { at: later, what: What::SpeedSet { node: 1, speed: 0.3 } });
        assert!(state.moves(later));

        records.iter().skip(30).for_each(|record| state.apply(record));
        let end = state.finished().expect("the run is complete");
        assert!(state.presence(end) == 1.0 && state.presence(end + Duration::from_millis(400)) == 0.0);
        assert!(!state.moves(end + Duration::from_millis(400)));
    }
}
