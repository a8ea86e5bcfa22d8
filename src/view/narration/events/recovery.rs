//! How the adaptive ring recovers: one event for all messages of a step.

use super::list::{EventKind, EventLog, with};
use crate::balance::{Message, NodeId, Party};
use crate::picture::atoms_in;
use crate::time::Time;
use crate::view::narration::failure::Failure;
use crate::view::narration::happening::Happening;
use crate::view::state::run_state::RunState;

impl EventLog {
    /// Takes in a message to a node, if it is part of a recovery.
    pub(super) fn apply_recovery(
        &mut self,
        at: Time,
        (from, to): (Party, NodeId),
        message: &Message,
        state: &RunState,
    ) {
        match (from, message) {
            (Party::Parent, Message::Gone(_)) => {
                // All present nodes get the same message; only the first makes an event.
                if let Some(failure) = Failure::ring_changed(state, at) {
                    self.add(at, EventKind::RingChanged, Happening::Failure(failure));
                }
            }
            (Party::Parent, Message::Again(ranges)) => {
                let before = self.take(at, |kind| matches!(kind, EventKind::HandedOutAgain { .. }));
                let (to, atoms) = match before {
                    Some(EventKind::HandedOutAgain { to: others, atoms }) => {
                        (with(others, to), atoms + atoms_in(ranges))
                    }
                    _ => (vec![to], atoms_in(ranges)),
                };
                let failure = Failure::HandedOutAgain { to: to.clone(), atoms };
                self.add(at, EventKind::HandedOutAgain { to, atoms }, Happening::Failure(failure));
            }
            (Party::Node(from), Message::Again(ranges)) => {
                let is_same =
                    |kind: &EventKind| matches!(kind, EventKind::Copies { from: other, .. } if *other == from);
                let (to, atoms) = match self.take(at, is_same) {
                    Some(EventKind::Copies { to: others, atoms, .. }) => (with(others, to), atoms + atoms_in(ranges)),
                    _ => (vec![to], atoms_in(ranges)),
                };
                let failure = Failure::Copies { from, to: to.clone(), atoms };
                self.add(at, EventKind::Copies { from, to, atoms }, Happening::Failure(failure));
            }
            (Party::Node(from), Message::Wake) => {
                let is_same = |kind: &EventKind| matches!(kind, EventKind::Wakes { from: other, .. } if *other == from);
                let to = match self.take(at, is_same) {
                    Some(EventKind::Wakes { to: others, .. }) => with(others, to),
                    _ => vec![to],
                };
                let failure = Failure::Wakes { from, to: to.clone() };
                self.add(at, EventKind::Wakes { from, to }, Happening::Failure(failure));
            }
            _ => {}
        }
    }
}
