//! Events of a run. Records that belong together are one event, so that no kind of event crowds out the others.

mod list;
mod recovery;

use super::failure::Failure;
use super::happening::Happening;
use crate::balance::{Message, NodeId, Party, Scheduler};
use crate::picture::atoms_in;
use crate::record::{Record, RecordKind};
use crate::time::Time;
use crate::view::state::run_state::RunState;
use list::{EventKind, with};

pub(crate) use list::EventLog;

/// A transfer of at most this many atoms is small.
const SMALL_TRANSFER_ATOMS: u32 = 5;

impl EventLog {
    /// Takes in a record; `state` already knows it.
    pub(crate) fn apply(&mut self, record: &Record, state: &RunState) {
        let at = record.at;
        match &record.kind {
            RecordKind::Sent { from: Party::Parent, message: Message::Band(band), .. } => {
                if !self.has(&EventKind::Bands) {
                    self.add(at, EventKind::Bands, Happening::bands(state, band));
                }
            }
            RecordKind::Sent { from: Party::Node(from), message, .. } if message.own_offer(*from).is_some() => {
                let (who, done) = (from, message.own_offer(*from).unwrap_or_default());
                // The transfers that follow tell of the later offers.
                if let Some(node) = state.nodes().get(usize::from(*who)).filter(|node| node.offers == 1) {
                    let whole = node.given.atoms == 0;
                    self.add(at, EventKind::Offer(*who), Happening::offer(state, *who, whole, done));
                }
            }
            RecordKind::Sent {
                from: Party::Node(from),
                to: Party::Node(to),
                message: Message::Transfer(ranges),
                ..
            } => {
                self.add_transfer(at, *from, *to, atoms_in(ranges), state);
            }
            RecordKind::Sent { message: Message::Part(part), .. } if !part.is_empty() => {
                // One event for each round in which every node could have a part.
                let parts = state.handed_out.count;
                if parts.is_multiple_of(state.nodes().len() as u32) {
                    self.remove(&EventKind::Parts);
                    self.add(at, EventKind::Parts, Happening::PartsSoFar(parts));
                }
            }
            RecordKind::Received { by: Party::Parent, .. } => {
                if let Some(waiting) = waiting_messages(state, at).filter(|&waiting| !self.had_queue_of(at, waiting)) {
                    self.take(at, |kind| matches!(kind, EventKind::Queue(_)));
                    self.add(at, EventKind::Queue(waiting), Happening::queue(state, waiting));
                }
            }
            RecordKind::AtomDone { node, .. } if is_band_done(state, *node) => {
                let nodes = self.take_nodes(at, *node, |kind| match kind {
                    EventKind::BandsDone(nodes) => Some(nodes),
                    _ => None,
                });
                self.add(at, EventKind::BandsDone(nodes.clone()), Happening::BandsDone(nodes));
            }
            RecordKind::Estimating => self.add(at, EventKind::Estimating, Happening::Estimating),
            RecordKind::SpeedSet { node, speed } => {
                let Some(machine) = state.nodes().get(usize::from(*node)) else { return };
                let same = |kind: &EventKind| matches!(kind, EventKind::Speed { node: other, .. } if other == node);
                let before = match self.take(at, same) {
                    Some(EventKind::Speed { before, .. }) => before,
                    _ => machine.previous_speed,
                };
                let happening = Happening::speed(state, *node, before, *speed);
                self.add(at, EventKind::Speed { node: *node, before }, happening);
            }
            RecordKind::Paused { node } => self.add(at, EventKind::Paused, Happening::paused(state, *node)),
            RecordKind::Resumed { node } => self.add(at, EventKind::Paused, Happening::resumed(state, *node)),
            RecordKind::LatencySet { latency } => {
                self.take(at, |kind| *kind == EventKind::Latency);
                self.add(at, EventKind::Latency, Happening::latency(state, *latency));
            }
            RecordKind::OwnLatencySet { party, latency } => {
                self.take(at, |kind| *kind == EventKind::OwnLatency(*party));
                let happening = Happening::OwnLatency { party: *party, latency: *latency };
                self.add(at, EventKind::OwnLatency(*party), happening);
            }
            RecordKind::Retired { node } => {
                let nodes = self.take_nodes(at, *node, |kind| match kind {
                    EventKind::Retired(nodes) => Some(nodes),
                    _ => None,
                });
                let happening = Happening::retired(state, nodes.clone());
                self.add(at, EventKind::Retired(nodes), happening);
            }
            RecordKind::Finished => self.add(at, EventKind::Complete, Happening::Complete),
            RecordKind::Condition { node, .. } => {
                if let Some(failure) = Failure::condition(state, *node) {
                    self.add(at, EventKind::Condition, Happening::Failure(failure));
                }
            }
            RecordKind::Sent { from, to: Party::Node(to), message, .. } => {
                self.apply_recovery(at, (*from, *to), message, state);
            }
            RecordKind::Delayed { from, to, until } => {
                let failure = Failure::Delayed { from: *from, to: *to, by: until.since(at) };
                self.add(at, EventKind::Condition, Happening::Failure(failure));
            }
            RecordKind::Sent { .. }
            | RecordKind::Link { .. }
            | RecordKind::Lost { .. }
            | RecordKind::AtomFailed { .. }
            | RecordKind::GivenUp { .. }
            | RecordKind::Received { .. }
            | RecordKind::AtomStarted { .. }
            | RecordKind::AtomDone { .. }
            | RecordKind::Estimated { .. } => {}
        }
    }

    fn add_transfer(&mut self, at: Time, from: NodeId, to: NodeId, atoms: u32, state: &RunState) {
        let is_theft = state.scheduler == Scheduler::WorkStealing;
        if atoms > SMALL_TRANSFER_ATOMS {
            return self.add(at, EventKind::Transfer, Happening::gift(state, from, to, atoms));
        }
        let same = |kind: &EventKind| matches!(kind, EventKind::SmallTransfers { from: other, .. } if *other == from);
        let (receivers, transfers, sum) = match self.take(at, same) {
            Some(EventKind::SmallTransfers { to, transfers, atoms, .. }) => (to, transfers, atoms),
            _ => (Vec::new(), 0, 0),
        };
        let (to, transfers, atoms) = (with(receivers, to), transfers + 1, sum + atoms);
        let happening = Happening::SmallTransfers { from, to: to.clone(), transfers, atoms, is_theft };
        self.add(at, EventKind::SmallTransfers { from, to, transfers, atoms }, happening);
    }
}

/// How many messages wait at the parent at `now`; `None` if they are few or the parent needs no time for them.
pub(crate) fn waiting_messages(state: &RunState, now: Time) -> Option<usize> {
    /// A shorter queue is soon handled.
    const MIN_QUEUE_MESSAGES: usize = 4;
    if state.handling.is_zero() {
        return None;
    }
    Some(state.line_length(now)).filter(|&waiting| waiting >= MIN_QUEUE_MESSAGES)
}

/// Whether `node` has just traced the last atom of its fixed band, while others still have atoms.
pub(crate) fn is_band_done(state: &RunState, node: NodeId) -> bool {
    let is_last = state.nodes().get(usize::from(node)).is_some_and(|of| of.band_at.is_some() && of.left() == 0);
    is_last && state.scheduler.is_fixed() && state.nodes().iter().any(|other| other.left() > 0)
}

#[cfg(test)]
mod tests;
