//! How much was said in a run.

use serde::Serialize;

use crate::balance::{OfferDetails, Message, Party};
use crate::picture::atoms_in;

/// How much was said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct MessageCounts {
    /// Requests to the parent: for work in a farm, and to be let in by who begins anew.
    pub requests: u64,
    /// The parent's answers.
    pub parts: u64,
    /// Offers that a node made.
    pub offers: u64,
    /// Offers passed on.
    pub hops: u64,
    /// Offers that those who sleep left with others.
    pub notes: u64,
    /// Offers taken.
    pub transfers: u64,
    /// Atoms in the transfers.
    pub atoms_moved: u64,
    /// Batches of results.
    pub results: u64,
    /// What nodes told the parent of what they had.
    pub beats: u64,
    /// Those that sleep, woken.
    pub wakes: u64,
    /// Atoms sent to be traced once more.
    pub agains: u64,
    /// Atoms in those.
    pub atoms_again: u64,
    /// Messages of every kind.
    pub total: u64,
    /// Their weight ([`Message::bytes`]).
    pub bytes: u64,
}

impl MessageCounts {
    /// All that was said for the atoms' sake, and neither to bring results nor only to say what one has.
    pub fn sharing(&self) -> u64 {
        self.total - self.results - self.beats
    }

    /// One more was said.
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
            Message::Request => self.requests += 1,
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
