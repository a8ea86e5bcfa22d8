//! The list of the last events, and how a later event joins an earlier one.

use std::collections::VecDeque;
use std::time::Duration;

use crate::balance::{NodeId, Party};
use crate::time::Time;
use crate::view::narration::happening::Happening;

/// The last events, the newest last.
#[derive(Clone, Debug, Default)]
pub(crate) struct EventLog {
    pub(super) events: VecDeque<ListedEvent>,
    /// Number of events that were dropped because newer ones came.
    dropped: usize,
}

/// An event of the list.
#[derive(Clone, Debug)]
pub(super) struct ListedEvent {
    pub(super) at: Time,
    pub(super) kind: EventKind,
    pub(super) happening: Happening,
}

/// Kind of an event, with the facts that a later event needs to join it.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum EventKind {
    /// The parent hands out the bands.
    Bands,
    /// A node makes its first offer.
    Offer(NodeId),
    /// A transfer that is not small.
    Transfer,
    /// Small transfers of one giver.
    SmallTransfers { from: NodeId, to: Vec<NodeId>, transfers: u32, atoms: u32 },
    /// Nodes retire.
    Retired(Vec<NodeId>),
    /// Nodes have traced their fixed bands.
    BandsDone(Vec<NodeId>),
    /// The parent estimates costs.
    Estimating,
    /// The parent of a farm has handed out parts.
    Parts,
    /// Messages wait at the parent: the largest number so far.
    Queue(usize),
    /// A machine's speed is changed; `before` is the speed before the first of these changes.
    Speed { node: NodeId, before: f64 },
    /// A pause begins or ends.
    Paused,
    /// The latency is changed.
    Latency,
    /// A party's own latency is changed.
    OwnLatency(Party),
    /// A machine or a link fails, or works again.
    Condition,
    /// The parent takes machines out of the ring, or back into it.
    RingChanged,
    /// The parent hands out lost atoms again.
    HandedOutAgain { to: Vec<NodeId>, atoms: u32 },
    /// Nodes trace copies of the late atoms of `from`.
    Copies { from: NodeId, to: Vec<NodeId>, atoms: u32 },
    /// A node wakes others.
    Wakes { from: NodeId, to: Vec<NodeId> },
    /// The picture is complete.
    Complete,
}

/// Events that are kept.
pub(super) const MAX_EVENTS: usize = 64;
/// Events of one kind join while they are no further apart than this.
const JOIN_TIME: Duration = Duration::from_secs(3);

impl EventLog {
    /// The events and their times, the newest last.
    pub(crate) fn iter(&self) -> impl DoubleEndedIterator<Item = (Time, &Happening)> + ExactSizeIterator {
        self.events.iter().map(|event| (event.at, &event.happening))
    }

    /// Number of events so far, the dropped ones included.
    pub(crate) fn so_far(&self) -> usize {
        self.dropped + self.events.len()
    }

    /// The last change that the user made to the run.
    pub(crate) fn latest_user_change(&self) -> Option<&Happening> {
        let is_user_change = |event: &&ListedEvent| {
            matches!(
                event.kind,
                EventKind::Speed { .. } | EventKind::Paused | EventKind::Latency | EventKind::Condition
            )
        };
        self.events.iter().rev().find(is_user_change).map(|event| &event.happening)
    }

    /// Whether the list has an event of this kind.
    pub(super) fn has(&self, kind: &EventKind) -> bool {
        self.events.iter().any(|event| event.kind == *kind)
    }

    /// Whether at least `waiting` messages have waited at the parent shortly before `now`.
    pub(super) fn had_queue_of(&self, now: Time, waiting: usize) -> bool {
        self.events
            .iter()
            .any(|event| matches!(event.kind, EventKind::Queue(most) if most >= waiting) && now <= event.at + JOIN_TIME)
    }

    /// Removes all events of this kind.
    pub(super) fn remove(&mut self, kind: &EventKind) {
        self.events.retain(|event| event.kind != *kind);
    }

    /// Takes the nodes of the latest event that `nodes_of` reads, if it is fresh at `at`, and adds `node` to them.
    pub(super) fn take_nodes(
        &mut self,
        at: Time,
        node: NodeId,
        nodes_of: impl Fn(EventKind) -> Option<Vec<NodeId>>,
    ) -> Vec<NodeId> {
        let before = self.take(at, |kind| nodes_of(kind.clone()).is_some());
        with(before.and_then(nodes_of).unwrap_or_default(), node)
    }

    /// Takes out the latest event that `is_kind` accepts, if it is fresh at `now`: the next event joins it.
    pub(super) fn take(&mut self, now: Time, is_kind: impl Fn(&EventKind) -> bool) -> Option<EventKind> {
        let index = self.events.iter().rposition(|event| is_kind(&event.kind) && now <= event.at + JOIN_TIME)?;
        self.events.remove(index).map(|event| event.kind)
    }

    /// Adds an event in the order of times: records of different parties may come a little out of order.
    pub(super) fn add(&mut self, at: Time, kind: EventKind, happening: Happening) {
        let index = self.events.iter().rposition(|event| event.at <= at).map_or(0, |before| before + 1);
        self.events.insert(index, ListedEvent { at, kind, happening });
        if self.events.len() > MAX_EVENTS {
            self.events.pop_front();
            self.dropped += 1;
        }
    }
}

/// Adds `node` to `nodes`, which are sorted.
pub(super) fn with(mut nodes: Vec<NodeId>, node: NodeId) -> Vec<NodeId> {
    if let Err(index) = nodes.binary_search(&node) {
        nodes.insert(index, node);
    }
    nodes
}
