//! What can happen in a run. Everything that a view or a study shows comes from records.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::balance::{Condition, Message, NodeId, Party};
use crate::picture::Atom;
use crate::time::Time;

/// One entry of the run log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// When it happened.
    pub at: Time,
    /// What happened.
    pub what: RecordKind,
}

/// What happened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum RecordKind {
    /// A message left; it can be drawn in flight from [`Record::at`] to `arrives`.
    ///
    /// An offer is *sent* where `from` is the node that offers, else *passed on* (a hop). A transfer says that
    /// an offer was *taken*: its receiver is the node that offered.
    Sent {
        /// Names this message in the run; [`RecordKind::Received`] has the same.
        id: u64,
        /// The sender.
        from: Party,
        /// The receiver.
        to: Party,
        /// What it says.
        message: Message,
        /// Its weight on the wire ([`Message::bytes`]).
        bytes: u64,
        /// When the link delivers it, always after [`Record::at`]; the receiver may handle it a little later.
        arrives: Time,
    },
    /// A message was handled by its receiver.
    Received {
        /// Which one.
        id: u64,
        /// The receiver.
        by: Party,
    },
    /// The parent begins to sample what the picture costs.
    Estimating,
    /// The parent has sampled what the picture costs, and sends bands by it.
    Estimated {
        /// What the sample of each stretch cost ([`estimate`](crate::balance::estimate)), in CPU time of this computer.
        costs: Vec<Duration>,
    },
    /// A worker began an atom.
    AtomStarted {
        /// Whose worker.
        node: NodeId,
        /// Which atom.
        atom: Atom,
    },
    /// A worker has traced an atom.
    AtomDone {
        /// Whose worker.
        node: NodeId,
        /// Which atom.
        atom: Atom,
        /// The CPU time that it took on this computer, not the emulated machine's.
        cost: Duration,
    },
    /// A node's speed was changed while the run went on.
    SpeedSet {
        /// Which node.
        node: NodeId,
        /// The new speed as a fraction of the reference machine; 0 stops its worker, not its messages.
        speed: f64,
    },
    /// A node's worker was made to stand still while the run goes on; the node still answers messages.
    Paused {
        /// Which node.
        node: NodeId,
    },
    /// The worker of a paused node goes on, at the node's speed.
    Resumed {
        /// Which node.
        node: NodeId,
    },
    /// Something has become of a node's machine.
    Condition {
        /// Whose.
        node: NodeId,
        /// How it is from now on.
        condition: Condition,
    },
    /// The link between two parties was cut, in both directions, or mended.
    Link {
        /// One of the two.
        one: Party,
        /// The other.
        other: Party,
        /// Whether it is cut now.
        cut: bool,
    },
    /// The way from one party to another was held up: what would have arrived after [`Record::at`] arrives at `until`, and
    /// nothing arrives before.
    Delayed {
        /// Who sends it.
        from: Party,
        /// Who waits for it.
        to: Party,
        /// Until when.
        until: Time,
    },
    /// A message would have arrived now, and is lost: its link is cut, or its receiver is off.
    Lost {
        /// Which one.
        id: u64,
    },
    /// A worker has failed to trace an atom.
    AtomFailed {
        /// Whose worker.
        node: NodeId,
        /// Which atom.
        atom: Atom,
    },
    /// The latency of all links was changed, for the messages that leave from now on.
    LatencySet {
        /// How long a message travels.
        latency: Duration,
    },
    /// A node's own offer came back: it makes no more, or sleeps until it is woken, in the ring that adapts.
    Retired {
        /// Which node.
        node: NodeId,
    },
    /// The parent has placed the last atom: the picture is complete.
    Finished,
    /// The run has failed: this atom cannot be traced.
    GivenUp {
        /// Which atom.
        atom: Atom,
    },
}
