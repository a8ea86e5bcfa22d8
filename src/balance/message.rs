//! The protocol's vocabulary: messages between parties, events that happen to a party, and actions that it asks of its
//! driver.

use std::ops::Range;
use std::slice;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::picture::{Atom, Division};
use crate::time::Time;

/// Number of a node: its place in the ring, from 0. The left neighbour of node `i` of `n` is `(i + n - 1) % n`.
pub type NodeId = u16;

/// A sender or receiver of messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Party {
    /// Hands out bands once, assembles the picture and sends the shutdown. It decides nothing else, except in a farm
    /// and about lost atoms.
    Parent,
    /// One node of the ring.
    Node(NodeId),
}

/// A message. Pixels are not part of it: the driver carries them with [`Message::Results`].
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Message {
    /// From the parent: the scene, and the node's first atoms, which may be none.
    Band(Range<Atom>),
    /// To the parent: in a farm, the sender has no more atoms and asks for some; in the adaptive ring, it has started
    /// afresh and asks to be let in.
    Request,
    /// Farm with leases, to the parent: the sender has started afresh, and asks for the scene.
    Join,
    /// In a farm: the parent's answer, consecutive atoms; an empty range says that there are no more.
    Part(Range<Atom>),
    /// The token: node `who` has no more atoms, and has traced `done` atoms since the start.
    Offer {
        /// The node that offers; the sender is another node if the offer is passed on.
        who: NodeId,
        /// Number of atoms that it has traced since the start.
        done: u32,
        /// Details of an offer in the adaptive ring; `None` in the article's.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        help: Option<OfferDetails>,
    },
    /// Atoms sent straight to the node that offered.
    Transfer(Vec<Range<Atom>>),
    /// Traced atoms on their way to the parent, in the order in which they were traced.
    Results(Vec<Range<Atom>>),
    /// Adaptive ring and farm with leases: atoms to trace once more, since the node that has them is late or lost. They
    /// may still be traced there; the first result counts.
    Again(Vec<Range<Atom>>),
    /// Adaptive: the sender has atoms to give, and the receiver sleeps, as far as the sender knows.
    Wake,
    /// Adaptive ring and farm with leases: a node's heartbeat to the parent.
    Beat {
        /// The atoms that the node holds and vouches for: those in the queue, those in the pipe, and those traced but
        /// not sent.
        holds: Vec<Range<Atom>>,
        /// Whether queue and pipe are empty.
        idle: bool,
        /// When it was sent, by the sender's clock.
        sent: Time,
    },
    /// Adaptive, from the parent: the nodes that are not in the ring; all others are.
    Gone(Vec<NodeId>),
    /// Adaptive ring and farm with leases, from the parent: atoms that the receiver holds and that are in the picture
    /// already.
    Placed(Vec<Range<Atom>>),
    /// Adaptive ring and farm with leases: the sender's worker has failed to trace this atom; the sender does not hold
    /// it any more.
    Failed(Atom),
    /// The parent's last message.
    Shutdown,
}

/// Details of an offer in the adaptive ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OfferDetails {
    /// Speed of the offerer in millionths of the reference machine's; 0 if it has not traced any atom yet.
    pub speed: u32,
    /// When the offer was made, by the offerer's clock.
    pub sent: Time,
    /// The number of this stop among the offerer's stops, from 0.
    pub stop: u16,
    /// Number of stops after this one, before the offer is back; `None`: the offer stays here as a notice that its node
    /// sleeps.
    pub left: Option<u16>,
}

impl OfferDetails {
    /// Converts a speed to millionths: at least 1, or 0 if the speed is unknown.
    pub fn millionths(speed: f64) -> u32 {
        if speed > 0.0 { ((speed * 1e6).round() as u32).max(1) } else { 0 }
    }

    /// Returns the speed of the offerer as a fraction of the reference machine's; 0 if unknown.
    pub fn speed(self) -> f64 {
        f64::from(self.speed) * 1e-6
    }
}

impl Message {
    /// Creates an offer of the article's ring.
    pub fn offer(who: NodeId, done: u32) -> Self {
        Self::Offer { who, done, help: None }
    }

    /// Returns how many atoms `from` has traced, if this is its own offer and not a sleep notice.
    pub fn own_offer(&self, from: NodeId) -> Option<u32> {
        match *self {
            Self::Offer { help: Some(OfferDetails { left: None, .. }), .. } => None,
            Self::Offer { who, done, .. } => (who == from).then_some(done),
            _ => None,
        }
    }

    /// Returns the atoms that the message carries, to be traced or traced.
    pub fn ranges(&self) -> &[Range<Atom>] {
        match self {
            Self::Band(atoms) | Self::Part(atoms) => slice::from_ref(atoms),
            Self::Transfer(ranges) | Self::Results(ranges) | Self::Again(ranges) => ranges,
            Self::Offer { .. } | Self::Request | Self::Join | Self::Shutdown => &[],
            Self::Wake | Self::Beat { .. } | Self::Gone(_) | Self::Placed(_) | Self::Failed(_) => &[],
        }
    }

    /// Returns the size of the message on a wire in bytes: 16 for the envelope, 8 for each range of atoms, 12 for each
    /// traced pixel (three 32-bit floats), and the scene's text with a band.
    pub fn bytes(&self, division: Division, scene_bytes: u64) -> u64 {
        const ENVELOPE: u64 = 16;
        const RANGE: u64 = 8;
        const PIXEL: u64 = 12;
        const DETAILS: u64 = 16;
        const NODE: u64 = 2;
        ENVELOPE
            + match self {
                Self::Band(_) => RANGE + scene_bytes,
                Self::Part(_) => RANGE,
                Self::Offer { help: Some(_), .. } => DETAILS,
                Self::Offer { .. } | Self::Request | Self::Join | Self::Wake | Self::Shutdown => 0,
                Self::Transfer(ranges) | Self::Again(ranges) | Self::Placed(ranges) => RANGE * ranges.len() as u64,
                Self::Beat { holds, .. } => RANGE * (1 + holds.len() as u64),
                Self::Gone(nodes) => NODE * nodes.len() as u64,
                Self::Failed(_) => RANGE,
                Self::Results(ranges) => {
                    let pixels = ranges.iter().map(|range| u64::from(division.pixels_in(range)));
                    RANGE * ranges.len() as u64 + PIXEL * pixels.sum::<u64>()
                }
            }
    }
}

/// An event that happens to a party.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// The run starts: the parent's first event. A node gets this event only when its machine starts afresh during the
    /// run; it then knows nothing of the time before.
    Started,
    /// The answer to [`Action::Estimate`]: the cost of each stretch's sample ([`estimate`](super::estimate)), in CPU
    /// time.
    Estimated(Vec<Duration>),
    /// A message has arrived.
    Message {
        /// The sender; of an offer that was passed on, the node that passed it on.
        from: Party,
        /// The message.
        message: Message,
    },
    /// The node's worker has traced an atom.
    AtomDone {
        /// The atom.
        atom: Atom,
        /// The CPU time that it took; at full speed an estimate, since only the record gets the final value.
        cost: Duration,
    },
    /// The node's worker has failed to trace an atom, which has left the pipe. Only a node of the adaptive ring or
    /// of the farm with leases handles this.
    AtomFailed {
        /// The atom.
        atom: Atom,
    },
    /// The time set with [`Action::SetTimer`] has come.
    Timer,
}

/// An action that a party asks of its driver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Action {
    /// Send a message.
    Send {
        /// The receiver; a node alone in the ring is its own left neighbour.
        to: Party,
        /// The message.
        message: Message,
    },
    /// Parent only: trace a coarse sample of the picture to estimate its cost, then hand over [`Event::Estimated`]. It
    /// takes the parent as long as the reference machine.
    Estimate,
    /// Put an atom into the worker's pipe. The worker traces atoms in this order.
    Trace(Atom),
    /// Hand the party [`Event::Timer`] at this time. A later `SetTimer` replaces this one.
    SetTimer(Time),
    /// Record that the node has retired (its own offer came back), or sleeps. There is nothing else to do.
    Retire,
    /// End the party: it has nothing more to do.
    Finish,
    /// Parent only: end the run as failed, since this atom cannot be traced.
    Fail(Atom),
}
