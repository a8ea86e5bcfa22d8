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
    /// Hands out bands once, assembles the picture, sends shutdown; decides nothing else.
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
    },
    /// Atoms sent straight to the node that offered.
    Transfer(Vec<Range<Atom>>),
    /// Traced atoms on their way to the parent, in the order in which they were traced.
    Results(Vec<Range<Atom>>),
    /// The parent's last message.
    Shutdown,
}

impl Message {
    /// The atoms that it is about: to be traced, or traced.
    pub fn ranges(&self) -> &[Range<Atom>] {
        match self {
            Self::Band(atoms) | Self::Part(atoms) => slice::from_ref(atoms),
            Self::Transfer(ranges) | Self::Results(ranges) => ranges,
            Self::Offer { .. } | Self::Request | Self::Shutdown => &[],
        }
    }

    /// What the message would weigh on a wire, in bytes: 16 for the envelope, 8 a range of atoms, 12 a traced
    /// pixel (three 32-bit floats), and the scene's text with a band.
    pub fn bytes(&self, division: Division, scene_bytes: u64) -> u64 {
        const ENVELOPE: u64 = 16;
        const RANGE: u64 = 8;
        const PIXEL: u64 = 12;
        ENVELOPE
            + match self {
                Self::Band(_) => RANGE + scene_bytes,
                Self::Part(_) => RANGE,
                Self::Offer { .. } | Self::Request | Self::Shutdown => 0,
                Self::Transfer(ranges) => RANGE * ranges.len() as u64,
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
    /// The run begins: the parent's first event, and no node's.
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
    /// The node is retired (its own offer came back): a note for the records, nothing to do.
    Retire,
    /// The party has nothing more to do: its thread may end.
    Finish,
}
