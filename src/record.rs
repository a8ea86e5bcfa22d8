//! Records: the things that can happen in a run. Everything that a view or a study shows comes from records.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::balance::{Condition, Message, NodeId, Party};
use crate::picture::Atom;
use crate::time::Time;

/// One entry of the run log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The time.
    pub at: Time,
    /// The kind of record, with its details.
    #[serde(rename = "what")]
    pub kind: RecordKind,
}

/// Kind of a record, with its details.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum RecordKind {
    /// A message was sent; it is in flight from [`Record::at`] to `arrives`.
    ///
    /// An offer is *sent* if `from` is the node that offers, else *passed on* (a hop). A transfer means that an offer
    /// was *taken*: its receiver is the node that offered.
    Sent {
        /// Id of the message, unique in the run; [`RecordKind::Received`] and [`RecordKind::Lost`] refer to it.
        id: u64,
        /// The sender.
        from: Party,
        /// The receiver.
        to: Party,
        /// The message.
        message: Message,
        /// Its size on the wire ([`Message::bytes`]).
        bytes: u64,
        /// When the link delivers it, always after [`Record::at`]. The receiver may handle it a little later.
        arrives: Time,
    },
    /// A receiver has handled a message.
    Received {
        /// Id of the message.
        id: u64,
        /// The receiver.
        by: Party,
    },
    /// The parent began to sample the cost of the picture.
    Estimating,
    /// The parent has sampled the cost of the picture, and sends bands of about equal cost.
    Estimated {
        /// Cost of each stretch's sample ([`estimate`](crate::balance::estimate)), in CPU time of this computer.
        costs: Vec<Duration>,
    },
    /// A worker began an atom.
    AtomStarted {
        /// The worker's node.
        node: NodeId,
        /// The atom.
        atom: Atom,
    },
    /// A worker has traced an atom.
    AtomDone {
        /// The worker's node.
        node: NodeId,
        /// The atom.
        atom: Atom,
        /// The CPU time on this computer, not on the emulated machine.
        cost: Duration,
    },
    /// The speed of a node was changed during the run.
    SpeedSet {
        /// The node.
        node: NodeId,
        /// The new speed as a fraction of the reference machine's; 0 stops the worker, not the messages.
        speed: f64,
    },
    /// The worker of a node was paused; the node still answers messages.
    Paused {
        /// The node.
        node: NodeId,
    },
    /// The worker of a paused node continues, at the node's speed.
    Resumed {
        /// The node.
        node: NodeId,
    },
    /// The condition of a node's machine changed.
    Condition {
        /// The node.
        node: NodeId,
        /// The new condition.
        condition: Condition,
    },
    /// The link between two parties was cut or restored, in both directions.
    Link {
        /// One end of the link.
        one: Party,
        /// The other end.
        other: Party,
        /// Whether the link is cut now.
        cut: bool,
    },
    /// The messages from one party to another were delayed: those that would arrive after [`Record::at`] arrive at
    /// `until` or later.
    Delayed {
        /// The sender.
        from: Party,
        /// The receiver.
        to: Party,
        /// End of the delay.
        until: Time,
    },
    /// A message would have arrived now, but is lost: its link is cut, or its receiver is off.
    Lost {
        /// Id of the message.
        id: u64,
    },
    /// A worker has failed to trace an atom.
    AtomFailed {
        /// The worker's node.
        node: NodeId,
        /// The atom.
        atom: Atom,
    },
    /// The latency of all nodes that have none of their own was changed, for messages that leave from now on.
    LatencySet {
        /// The new latency.
        latency: Duration,
    },
    /// A party's own latency was changed, for messages that leave from now on.
    OwnLatencySet {
        /// The party.
        party: Party,
        /// The new latency; `None` if the party has none of its own any more.
        latency: Option<Duration>,
    },
    /// A node's own offer came back: the node makes no more offers, or, in the adaptive ring, sleeps until it is woken.
    Retired {
        /// The node.
        node: NodeId,
    },
    /// The parent has placed the last atom: the picture is complete.
    Finished,
    /// The run has failed: this atom cannot be traced.
    GivenUp {
        /// The atom.
        atom: Atom,
    },
}
