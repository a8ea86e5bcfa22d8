//! The state of a run at one moment, as a fold over its records.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::time::Duration;

use super::flight::{Cargo, Flight, atoms_in};
use super::node::NodeState;
use crate::balance::{NodeId, Party};
use crate::picture::Atom;
use crate::record::{Record, What};
use crate::runlog::Header;
use crate::time::Time;

/// What is known of a run after some of its records.
///
/// Records of different parties may come interleaved: a message may be received here before it was sent.
#[derive(Clone, Debug)]
pub struct RunState {
    pub(super) nodes: Vec<NodeState>,
    owners: Vec<Option<NodeId>>,
    holders: Vec<Option<NodeId>>,
    /// Since when each atom is where it is: atoms may be handed on before the first hand's record comes.
    held_since: Vec<Time>,
    pub(super) flights: Vec<Flight>,
    pub(super) pending: BTreeMap<u64, Flight>,
    early: BTreeSet<u64>,
    touched: Vec<Range<Atom>>,
    head: Time,
    pub(super) finished: Option<Time>,
}

impl RunState {
    /// The state before anything has happened.
    pub fn new(header: &Header) -> Self {
        let atoms = header.division.atoms() as usize;
        Self {
            nodes: header.speeds.iter().map(|&speed| NodeState::new(speed)).collect(),
            owners: vec![None; atoms],
            holders: vec![None; atoms],
            held_since: vec![Time::ZERO; atoms],
            flights: Vec::new(),
            pending: BTreeMap::new(),
            early: BTreeSet::new(),
            touched: Vec::new(),
            head: Time::ZERO,
            finished: None,
        }
    }

    /// Takes in what happened next. What does not belong to the header's nodes and atoms is left out.
    pub fn apply(&mut self, record: &Record) {
        let at = record.at;
        self.head = self.head.max(at);
        match &record.what {
            What::Sent { id, from, to, message, arrives, .. } => {
                self.sent(*id, Flight::new(*from, *to, message, at, *arrives));
            }
            What::Received { id, .. } => match self.pending.remove(id) {
                Some(flight) => self.received(flight, at),
                None => {
                    self.early.insert(*id);
                }
            },
            What::AtomStarted { node, atom } => {
                if let Some(state) = self.nodes.get_mut(usize::from(*node)) {
                    state.atom = Some(*atom);
                    self.touched.push(*atom..*atom + 1);
                }
            }
            What::AtomDone { node, atom, .. } => {
                if let (Some(state), Some(owner)) =
                    (self.nodes.get_mut(usize::from(*node)), self.owners.get_mut(*atom as usize))
                {
                    *owner = Some(*node);
                    state.atom_done(at);
                    self.touched.push(*atom..*atom + 1);
                }
            }
            What::SpeedSet { node, speed } => {
                if let Some(state) = self.nodes.get_mut(usize::from(*node)) {
                    (state.speed_before, state.speed) = (state.speed, *speed);
                }
            }
            What::Retired { node } => {
                if let Some(state) = self.nodes.get_mut(usize::from(*node)) {
                    (state.retired, state.offer_out) = (true, false);
                }
            }
            What::Paused { .. } | What::Resumed { .. } | What::LatencySet { .. } => {}
            What::Finished => self.finished = Some(at),
        }
    }

    /// All nodes, in the order of the ring.
    pub fn nodes(&self) -> &[NodeState] {
        &self.nodes
    }

    /// Who has traced each atom.
    pub fn owners(&self) -> &[Option<NodeId>] {
        &self.owners
    }

    /// In whose queue each atom is or last was.
    pub fn holders(&self) -> &[Option<NodeId>] {
        &self.holders
    }

    /// The messages that can still be seen, in the order in which they left; of results, which are many, only
    /// some.
    pub fn flights(&self) -> &[Flight] {
        &self.flights
    }

    /// How many atoms have been traced.
    pub fn done(&self) -> u32 {
        self.nodes.iter().map(|node| node.done).sum()
    }

    /// How many atoms there are.
    pub fn atoms(&self) -> u32 {
        self.owners.len() as u32
    }

    /// The time of the latest record.
    pub fn head(&self) -> Time {
        self.head
    }

    /// When the picture was complete.
    pub fn finished(&self) -> Option<Time> {
        self.finished
    }

    /// The atoms that look different since this was last asked.
    pub fn take_touched(&mut self) -> Vec<Range<Atom>> {
        std::mem::take(&mut self.touched)
    }

    fn sent(&mut self, id: u64, flight: Flight) {
        if let (Party::Node(from), Cargo::Transfer(ranges)) = (flight.from, &flight.cargo)
            && let Some(giver) = self.nodes.get_mut(usize::from(from))
        {
            giver.left -= i64::from(atoms_in(ranges));
        }
        if let (Party::Node(from), Cargo::Offer { who }) = (flight.from, &flight.cargo)
            && from == *who
            && let Some(offerer) = self.nodes.get_mut(usize::from(from))
        {
            offerer.offer_out = true;
        }
        if self.is_drawn(&flight) {
            self.flights.retain(|earlier| earlier.gone() > flight.sent);
            self.flights.push(flight.clone());
        }
        if self.early.remove(&id) {
            let at = flight.arrives;
            self.received(flight, at);
        } else {
            self.pending.insert(id, flight);
        }
    }

    /// Results are many: of each node only as many are drawn as can be told apart.
    fn is_drawn(&mut self, flight: &Flight) -> bool {
        const BETWEEN_RESULTS: Duration = Duration::from_millis(90);
        let known = |party: Party| match party {
            Party::Parent => true,
            Party::Node(node) => usize::from(node) < self.nodes.len(),
        };
        if !known(flight.from) || !known(flight.to) {
            return false;
        }
        match (flight.from, &flight.cargo) {
            (_, Cargo::Shutdown) => false,
            (Party::Node(from), Cargo::Results(_)) => {
                let last = &mut self.nodes[usize::from(from)].last_results;
                let drawn = last.is_none_or(|last| flight.sent >= last + BETWEEN_RESULTS);
                if drawn {
                    *last = Some(flight.sent);
                }
                drawn
            }
            _ => true,
        }
    }

    fn received(&mut self, flight: Flight, at: Time) {
        let Party::Node(to) = flight.to else { return };
        let Some(state) = self.nodes.get_mut(usize::from(to)) else { return };
        let ranges = match flight.cargo {
            Cargo::Band(band) => {
                state.has_band = true;
                vec![band]
            }
            Cargo::Transfer(ranges) => {
                state.offer_out = false;
                ranges
            }
            Cargo::Offer { .. } | Cargo::Results(_) | Cargo::Shutdown => return,
        };
        state.give(atoms_in(&ranges), at);
        for range in ranges {
            let places = range.start as usize..range.end as usize;
            let (Some(holders), Some(since)) = (self.holders.get_mut(places.clone()), self.held_since.get_mut(places))
            else {
                continue;
            };
            for (holder, since) in holders.iter_mut().zip(since).filter(|(_, since)| **since <= flight.arrives) {
                (*holder, *since) = (Some(to), flight.arrives);
            }
            self.touched.push(range);
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::sample;
    use super::*;

    fn in_flight(state: &RunState) -> u32 {
        state
            .pending
            .values()
            .filter(|flight| !matches!(flight.cargo, Cargo::Results(_)))
            .map(|f| f.cargo.atoms())
            .sum()
    }

    /// Who wrote a record down.
    fn party(record: &Record) -> Party {
        match &record.what {
            What::Sent { from, .. } => *from,
            What::Received { by, .. } => *by,
            What::AtomStarted { node, .. }
            | What::AtomDone { node, .. }
            | What::SpeedSet { node, .. }
            | What::Paused { node }
            | What::Resumed { node }
            | What::Retired { node } => Party::Node(*node),
            What::LatencySet { .. } | What::Finished => Party::Parent,
        }
    }

    proptest! {
        #[test]
        fn no_atom_is_lost_or_doubled(speeds in prop::collection::vec(0.05..1.0f64, 1..6), atoms in 1..80u32) {
            let header = sample::header(&speeds, atoms);
            let mut state = RunState::new(&header);
            for record in sample::records(&header) {
                state.apply(&record);
                let left: u32 = state.nodes.iter().map(NodeState::left).sum();
                prop_assert!(left + state.done() + in_flight(&state) <= atoms);
                if left > 0 && state.nodes.iter().all(|node| node.has_band) {
                    prop_assert_eq!(left + state.done() + in_flight(&state), atoms);
                }
            }
            prop_assert!(state.finished().is_some());
            prop_assert!(state.owners().iter().all(Option::is_some));
            prop_assert!(state.nodes.iter().all(|node| node.retired && node.left() == 0));
        }

        #[test]
        fn interleaving_changes_nothing(speeds in prop::collection::vec(0.05..1.0f64, 1..6), atoms in 1..60u32, batch in 2..40usize) {
            let header = sample::header(&speeds, atoms);
            let records = sample::records(&header);
            let (mut straight, mut mixed) = (RunState::new(&header), RunState::new(&header));
            records.iter().for_each(|record| straight.apply(record));
            for batch in records.chunks(batch) {
                let mut batch = batch.to_vec();
                // Each party's records stay in order, but whole parties come one after the other.
                batch.sort_by_key(party);
                batch.iter().for_each(|record| mixed.apply(record));
            }
            prop_assert_eq!(straight.owners(), mixed.owners());
            prop_assert_eq!(straight.holders(), mixed.holders());
            for (one, other) in straight.nodes.iter().zip(&mixed.nodes) {
                prop_assert_eq!((one.done, one.left, one.retired), (other.done, other.left, other.retired));
            }
        }
    }

    #[test]
    fn strangers_are_left_out() {
        let mut state = RunState::new(&sample::header(&[1.0], 2));
        let offer = crate::balance::Message::Offer { who: 9, done: 0 };
        let (from, to, at) = (Party::Node(9), Party::Node(8), Time::ZERO);
        state.apply(&Record { at, what: What::Sent { id: 0, from, to, message: offer, bytes: 0, arrives: at } });
        state.apply(&Record { at, what: What::Received { id: 0, by: to } });
        state.apply(&Record { at, what: What::AtomDone { node: 9, atom: 77, cost: Duration::ZERO } });
        assert!(state.flights().is_empty());
        assert_eq!(state.done(), 0);
    }
}
