//! Counts of the messages in a run.

use serde::Serialize;

use crate::balance::{Message, OfferDetails, Party};
use crate::picture::atoms_in;

/// Number of messages in a run, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct MessageCounts {
    /// Requests to the parent: for atoms in a farm, and for admission of a node that has started afresh.
    pub requests: u64,
    /// Parts that the parent sent in a farm.
    pub parts: u64,
    /// Offers that a node made.
    pub offers: u64,
    /// Offers passed on.
    pub hops: u64,
    /// Notices of sleeping nodes.
    pub notes: u64,
    /// Transfers: offers that were taken.
    pub transfers: u64,
    /// Atoms in the transfers.
    pub atoms_moved: u64,
    /// Batches of results.
    pub results: u64,
    /// Heartbeats of nodes to the parent.
    pub beats: u64,
    /// Wake-ups of sleeping nodes.
    pub wakes: u64,
    /// Messages with atoms to trace once more.
    pub agains: u64,
    /// Atoms in these messages.
    pub atoms_again: u64,
    /// Messages of every kind.
    pub total: u64,
    /// Total size in bytes ([`Message::bytes`]).
    pub bytes: u64,
}

impl MessageCounts {
    /// Returns the number of messages that serve to share atoms: all except results and heartbeats.
    pub fn sharing(&self) -> u64 {
        self.total - self.results - self.beats
    }

    /// Counts one more message.
    pub(super) fn add(&mut self, from: Party, message: &Message, bytes: u64) {
        self.total += 1;
        self.bytes += bytes;
        match message {
            Message::Offer { help: Some(OfferDetails { left: None, .. }), .. } => self.notes += 1,
            Message::Offer { who, .. } if Party::Node(*who) == from => self.offers += 1,
            Message::Offer { .. } => self.hops += 1,
            Message::Transfer(ranges) => {
                self.transfers += 1;
                self.atoms_moved += u64::from(atoms_in(ranges));
            }
            Message::Results(_) => self.results += 1,
            Message::Request | Message::Join => self.requests += 1,
            Message::Part(_) => self.parts += 1,
            Message::Beat { .. } => self.beats += 1,
            Message::Wake => self.wakes += 1,
            Message::Again(ranges) => {
                self.agains += 1;
                self.atoms_again += u64::from(atoms_in(ranges));
            }
            Message::Gone(_) | Message::Placed(_) | Message::Failed(_) | Message::Band(_) | Message::Shutdown => {}
        }
    }
}
