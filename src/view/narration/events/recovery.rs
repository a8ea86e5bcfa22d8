//! What a ring that adapts does about what is lost, late or needed: one event, however many messages it takes.

use super::{EventLog, RunEvent};
use crate::balance::{Message, NodeId, Party};
use crate::picture::atoms_in;
use crate::time::Time;
use crate::view::narration::failure::Failure;
use crate::view::narration::happening::Happening;
use crate::view::state::run_state::RunState;

/// What is done about it.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Recovery {
    /// The ring closes round machines, or opens for them.
    Ring,
    /// Atoms are given out again.
    GivenOut { to: Vec<NodeId>, atoms: u32 },
    /// What is late at a machine is traced by others too.
    Copies { from: NodeId, to: Vec<NodeId>, atoms: u32 },
    /// A machine wakes others.
    Wakes { from: NodeId, to: Vec<NodeId> },
}

impl EventLog {
    /// Takes in a message to a node that may mend something.
    pub(super) fn mend(&mut self, at: Time, (from, to): (Party, NodeId), message: &Message, state: &RunState) {
        match (from, message) {
            (Party::Parent, Message::Gone(_)) => {
                // All that are there are told the same.
                if let Some(failure) = Failure::ring_changed(state, at) {
                    self.tell(at, RunEvent::Recovery(Recovery::Ring), Happening::Failure(failure));
                }
            }
            (Party::Parent, Message::Again(ranges)) => {
                let before = self.take_mishap(at, |event| matches!(event, Recovery::GivenOut { .. }));
                let (to, atoms) = match before {
                    Some(Recovery::GivenOut { to: others, atoms }) => (with(others, to), atoms + atoms_in(ranges)),
                    _ => (vec![to], atoms_in(ranges)),
                };
                let failure = Failure::HandedOutAgain { to: to.clone(), atoms };
                self.tell(at, RunEvent::Recovery(Recovery::GivenOut { to, atoms }), Happening::Failure(failure));
            }
            (Party::Node(from), Message::Again(ranges)) => {
                let is_same =
                    |event: &Recovery| matches!(event, Recovery::Copies { from: other, .. } if *other == from);
                let (to, atoms) = match self.take_mishap(at, is_same) {
                    Some(Recovery::Copies { to: others, atoms, .. }) => (with(others, to), atoms + atoms_in(ranges)),
                    _ => (vec![to], atoms_in(ranges)),
                };
                let failure = Failure::Copies { from, to: to.clone(), atoms };
                self.tell(at, RunEvent::Recovery(Recovery::Copies { from, to, atoms }), Happening::Failure(failure));
            }
            (Party::Node(from), Message::Wake) => {
                let is_same = |event: &Recovery| matches!(event, Recovery::Wakes { from: other, .. } if *other == from);
                let to = match self.take_mishap(at, is_same) {
                    Some(Recovery::Wakes { to: others, .. }) => with(others, to),
                    _ => vec![to],
                };
                let failure = Failure::Wakes { from, to: to.clone() };
                self.tell(at, RunEvent::Recovery(Recovery::Wakes { from, to }), Happening::Failure(failure));
            }
            _ => {}
        }
    }

    fn take_mishap(&mut self, now: Time, is_it: impl Fn(&Recovery) -> bool) -> Option<Recovery> {
        match self.take(now, |event| matches!(event, RunEvent::Recovery(mishap) if is_it(mishap))) {
            Some(RunEvent::Recovery(mishap)) => Some(mishap),
            _ => None,
        }
    }
}

/// These nodes and one more, in their order.
fn with(mut nodes: Vec<NodeId>, node: NodeId) -> Vec<NodeId> {
    if let Err(place) = nodes.binary_search(&node) {
        nodes.insert(place, node);
    }
    nodes
}
