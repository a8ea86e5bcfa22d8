//! What parties say to each other, what happens to them, and what they ask of their driver.

use std::ops::Range;
use std::slice;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::picture::{Atom, Division};
use crate::time::Time;

/// A node's place in the ring, from 0. The left neighbour of node `i` of `n` is `(i + n - 1) % n`.
pub type NodeId = u16;

/// Whoever can send and receive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Party {
    /// Hands out bands once, assembles the picture, sends shutdown; decides nothing else, but in a farm, and of what is lost.
    Parent,
    /// One machine of the ring.
    Node(NodeId),
}

/// A message. Pixels are not part of it: the driver carries them along with [`Message::Results`].
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Message {
    /// The parent gives a node the scene and its first share; it may be empty.
    Band(Range<Atom>),
    /// In a farm: the sender has no more atoms and asks the parent for some.
    Request,
    /// In a farm: the parent's answer, consecutive atoms; an empty one says that there are no more.
    Part(Range<Atom>),
    /// The token: `who` is done, and has traced `done` atoms since the start.
    Offer {
        /// The node that offers; the sender is another node where the offer is passed on.
        who: NodeId,
        /// Atoms that it has traced since the start.
        done: u32,
        /// What an offer says besides in the ring that adapts; nothing in the article's.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        help: Option<OfferDetails>,
    },
    /// Atoms sent straight to the node that offered.
    Transfer(Vec<Range<Atom>>),
    /// Traced atoms on their way to the parent, in the order in which they were traced.
    Results(Vec<Range<Atom>>),
    /// Adaptive: atoms to be traced once more, since whoever has them is late with them or lost. The sender does not know
    /// that they are not being traced elsewhere; the first result counts.
    Again(Vec<Range<Atom>>),
    /// Adaptive: the sender has atoms to give, and knows that the receiver sleeps, or did.
    Wake,
    /// Adaptive: what a node tells the parent at every beat.
    Beat {
        /// The atoms that it has and vouches for: those that wait, those in the pipe, and those traced but not yet sent.
        holds: Vec<Range<Atom>>,
        /// Whether it has none at all.
        idle: bool,
        /// When it was sent, by the sender's clock.
        sent: Time,
    },
    /// Adaptive: the parent says which nodes are not in the ring; all others are.
    Gone(Vec<NodeId>),
    /// Adaptive: the parent says of atoms that the receiver still has that they are in the picture.
    Placed(Vec<Range<Atom>>),
    /// Adaptive: the sender's worker has failed to trace the atom, which has left it.
    Failed(Atom),
    /// The parent's last message.
    Shutdown,
}

/// What an offer says in the ring that adapts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OfferDetails {
    /// How fast the offerer is, in millionths of the reference machine; 0 if it has not traced anything yet.
    pub speed: u32,
    /// When the offer was made, by the offerer's clock.
    pub sent: Time,
    /// Which of its stops this is.
    pub stop: u16,
    /// How many stops come after this one, before it is back; `None`: it stays here, and its node sleeps.
    pub left: Option<u16>,
}

impl OfferDetails {
    /// A speed in millionths: at least one, unless it is not known.
    pub fn millionths(speed: f64) -> u32 {
        if speed > 0.0 { ((speed * 1e6).round() as u32).max(1) } else { 0 }
    }

    /// How fast the offerer is; 0 if that is not known.
    pub fn speed(self) -> f64 {
        f64::from(self.speed) * 1e-6
    }
}

impl Message {
    /// The offer of the article's ring.
    pub fn offer(who: NodeId, done: u32) -> Self {
        Self::Offer { who, done, help: None }
    }

    /// How many atoms `from` has traced, if this is its own offer, and not one that stays with its receiver.
    pub fn own_offer(&self, from: NodeId) -> Option<u32> {
        match *self {
            Self::Offer { help: Some(OfferDetails { left: None, .. }), .. } => None,
            Self::Offer { who, done, .. } => (who == from).then_some(done),
            _ => None,
        }
    }

    /// The atoms that it is about: to be traced, or traced.
    pub fn ranges(&self) -> &[Range<Atom>] {
        match self {
            Self::Band(atoms) | Self::Part(atoms) => slice::from_ref(atoms),
            Self::Transfer(ranges) | Self::Results(ranges) | Self::Again(ranges) => ranges,
            Self::Offer { .. } | Self::Request | Self::Shutdown => &[],
            Self::Wake | Self::Beat { .. } | Self::Gone(_) | Self::Placed(_) | Self::Failed(_) => &[],
        }
    }

    /// What the message would weigh on a wire, in bytes: 16 for the envelope, 8 a range of atoms, 12 a traced
    /// pixel (three 32-bit floats), and the scene's text with a band.
    pub fn bytes(&self, division: Division, scene_bytes: u64) -> u64 {
        const ENVELOPE: u64 = 16;
        const RANGE: u64 = 8;
        const PIXEL: u64 = 12;
        const HELP: u64 = 16;
        const NODE: u64 = 2;
        ENVELOPE
            + match self {
                Self::Band(_) => RANGE + scene_bytes,
                Self::Part(_) => RANGE,
                Self::Offer { help: Some(_), .. } => HELP,
                Self::Offer { .. } | Self::Request | Self::Wake | Self::Shutdown => 0,
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

/// What happens to a party.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// The run begins: the parent's first event. Of nodes only one whose machine begins anew while the run goes on is
    /// handed it: it knows nothing of what was before.
    Started,
    /// The parent has what it asked for with [`Action::Estimate`]: what the sample of each stretch costs
    /// ([`estimate`](super::estimate)), in CPU time.
    Estimated(Vec<Duration>),
    /// A message has arrived.
    Message {
        /// Who sent it (not who wrote it: an offer may have been passed on).
        from: Party,
        /// What it says.
        message: Message,
    },
    /// The node's worker has traced an atom.
    AtomDone {
        /// Which one.
        atom: Atom,
        /// The CPU time that it took; at full speed only an estimate, since the record gets the final one.
        cost: Duration,
    },
    /// The node's worker has failed to trace an atom, which is out of its pipe: only a node of the ring that adapts goes on.
    AtomFailed {
        /// Which one.
        atom: Atom,
    },
    /// The time asked for with [`Action::SetTimer`] has come.
    Timer,
}

/// What a party asks of its driver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Action {
    /// Send a message.
    Send {
        /// To whom; a node may be its own left neighbour.
        to: Party,
        /// What.
        message: Message,
    },
    /// Only the parent's: trace a coarse sample of the picture to learn what it costs, and hand over
    /// [`Event::Estimated`] when that is done. It takes the parent as long as it takes the reference machine.
    Estimate,
    /// Put an atom into the worker's pipe; atoms are traced in the order in which they are put in.
    Trace(Atom),
    /// Hand the party [`Event::Timer`] at this time; a later one replaces it.
    SetTimer(Time),
    /// The node is retired (its own offer came back), or sleeps: a note for the records, nothing to do.
    Retire,
    /// The party has nothing more to do: its thread may end.
    Finish,
    /// Only the parent's: the run has failed, since this atom cannot be traced.
    Fail(Atom),
}
