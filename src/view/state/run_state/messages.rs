//! What messages change in the state of a run.

use std::ops::Range;
use std::time::Duration;

use super::RunState;
use crate::balance::{NodeId, Party};
use crate::picture::{Atom, atoms_in};
use crate::time::Time;
use crate::view::state::flight::{Cargo, Flight};

impl RunState {
    /// The parent has placed these atoms in the picture.
    fn placed(&mut self, atoms: &Range<Atom>, (from, at): (NodeId, Time)) {
        if atoms.end as usize > self.places.len() {
            return;
        }
        for atom in atoms.clone() {
            match self.places[atom as usize].place() {
                true => {}
                false if self.sharing.is_adaptive() => self.count_late(atom, from, at),
                false => _ = self.early_atoms.insert(atom),
            }
        }
        self.touched.push(atoms.clone());
    }

    /// The pixels of atoms that are not in the picture yet.
    fn new_pixels(&self, ranges: &[Range<Atom>]) -> u32 {
        let is_new = |atom: &Atom| !self.places.get(*atom as usize).is_some_and(|place| place.is_placed());
        let atoms = ranges.iter().cloned().flatten().filter(is_new);
        atoms.map(|atom| self.division.pixels_in(&(atom..atom + 1))).sum()
    }

    pub(super) fn sent(&mut self, id: u64, flight: Flight) {
        if let Party::Node(from) = flight.from
            && let Some(sender) = self.node(from)
        {
            match &flight.cargo {
                Cargo::Transfer(ranges) => {
                    let atoms = atoms_in(ranges);
                    sender.given.add(atoms);
                    sender.left -= i64::from(atoms);
                }
                Cargo::Offer { who } if *who == from => {
                    sender.offers += 1;
                    // Whoever slept has been woken.
                    (sender.offer_out, sender.retired) = (true, false);
                }
                Cargo::Offer { .. } => sender.hops += 1,
                Cargo::Request => (sender.requests, sender.offer_out) = (sender.requests + 1, true),
                Cargo::Band(_) | Cargo::Part(_) | Cargo::Results(_) | Cargo::Shutdown => {}
                Cargo::Again(_) | Cargo::Wake | Cargo::Sleeps | Cargo::Beat | Cargo::Notice => {}
            }
        }
        if let Cargo::Part(part) = &flight.cargo
            && !part.is_empty()
        {
            self.handed_out.add(part.len() as u32);
        }
        if self.is_drawn(&flight) {
            self.flights.push(flight.clone());
        }
        if self.early.remove(&id) {
            let at = flight.arrives;
            self.received(flight, at);
        } else {
            self.pending.insert(id, flight);
        }
    }

    /// Results are many, and requests and parts may be: of each node only as many are drawn as can be told apart.
    fn is_drawn(&mut self, flight: &Flight) -> bool {
        let between = [90, 300, 450].map(Duration::from_millis);
        let known = |party: Party| match party {
            Party::Parent => true,
            Party::Node(node) => usize::from(node) < self.nodes.len(),
        };
        if !known(flight.from) || !known(flight.to) {
            return false;
        }
        let (node, kind) = match (flight.from, flight.to, &flight.cargo) {
            (_, _, Cargo::Shutdown | Cargo::Sleeps | Cargo::Beat | Cargo::Notice) => return false,
            (Party::Node(from), _, Cargo::Results(_)) => (from, 0),
            (Party::Node(from), _, Cargo::Request) => (from, 1),
            (_, Party::Node(to), Cargo::Part(part)) if !part.is_empty() => (to, 2),
            _ => return true,
        };
        let last = &mut self.nodes[usize::from(node)].last_drawn[kind];
        let drawn = last.is_none_or(|last| flight.sent >= last + between[kind]);
        if drawn {
            *last = Some(flight.sent);
        }
        drawn
    }

    /// What is on this way arrives later.
    pub(super) fn delayed(&mut self, way: (Party, Party), at: Time, until: Time) {
        let is_there = |flight: &&mut Flight| (flight.from, flight.to) == way && flight.arrives > at;
        self.pending.values_mut().filter(is_there).for_each(|flight| flight.hold(at, until));
        self.flights.hold(way, at, until);
    }

    pub(super) fn received(&mut self, flight: Flight, at: Time) {
        self.heard(&flight, at);
        let to = match (flight.to, &flight.cargo) {
            (Party::Parent, Cargo::Results(ranges)) => {
                let Party::Node(from) = flight.from else { return };
                self.arrived.pixels += self.new_pixels(ranges);
                ranges.iter().for_each(|range| self.placed(range, (from, at)));
                return;
            }
            (Party::Parent, _) => return,
            (Party::Node(to), _) => to,
        };
        let again = match &flight.cargo {
            Cargo::Again(ranges) => Some(self.new_to(to, ranges.iter().cloned().flatten())),
            _ => None,
        };
        let Some(state) = self.node(to) else { return };
        let ranges = match flight.cargo {
            Cargo::Band(band) => {
                // The parent asks those back whom it thinks gone.
                state.band_at.get_or_insert(at);
                vec![band]
            }
            Cargo::Part(part) => {
                state.offer_out = false;
                if !part.is_empty() {
                    state.got.add(part.len() as u32);
                }
                vec![part]
            }
            Cargo::Transfer(ranges) | Cargo::Again(ranges) => {
                state.offer_out = false;
                state.got.add(atoms_in(&ranges));
                ranges
            }
            Cargo::Offer { .. } | Cargo::Request | Cargo::Results(_) | Cargo::Shutdown => return,
            Cargo::Wake | Cargo::Sleeps | Cargo::Beat | Cargo::Notice => return,
        };
        state.give(again.unwrap_or_else(|| atoms_in(&ranges)), at);
        for range in ranges {
            if let Some(places) = self.places.get_mut(range.start as usize..range.end as usize) {
                places.iter_mut().for_each(|place| place.arrive(to, flight.arrives));
                self.touched.push(range);
            }
        }
    }
}
