//! Messages in the state of a run.

use std::ops::Range;
use std::time::Duration;

use super::RunState;
use crate::balance::{NodeId, Party};
use crate::picture::{Atom, atoms_in};
use crate::time::Time;
use crate::view::state::flight::{Cargo, Flight};

impl RunState {
    /// Notes that the parent has placed atoms of a node in the picture.
    fn placed(&mut self, atoms: &Range<Atom>, (from, at): (NodeId, Time)) {
        if atoms.end as usize > self.atoms.len() {
            return;
        }
        for atom in atoms.clone() {
            match self.atoms[atom as usize].place() {
                true => {}
                false if self.scheduler.survives_losses() => self.count_late(atom, from, at),
                false => _ = self.placed_early.insert(atom),
            }
        }
        self.touched.push(atoms.clone());
    }

    /// Counts the pixels of atoms that are not in the picture yet.
    fn new_pixels(&self, ranges: &[Range<Atom>]) -> u32 {
        let is_new = |atom: &Atom| !self.atoms.get(*atom as usize).is_some_and(|place| place.is_placed());
        let atoms = ranges.iter().cloned().flatten().filter(is_new);
        atoms.map(|atom| self.division.pixels_in(&(atom..atom + 1))).sum()
    }

    /// Notes a sent message.
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
                    // A node that slept has been woken.
                    (sender.awaits_answer, sender.retired) = (true, false);
                }
                Cargo::Offer { .. } => sender.hops += 1,
                Cargo::Request => (sender.requests, sender.awaits_answer) = (sender.requests + 1, true),
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
        if self.received_early.remove(&id) {
            let at = flight.arrives;
            self.received(flight, at);
        } else {
            self.pending.insert(id, flight);
        }
    }

    /// Whether a message is drawn. Results are many, and requests and parts may be: of each node they are drawn at a
    /// minimum distance in time.
    fn is_drawn(&mut self, flight: &Flight) -> bool {
        let min_distance = [90, 300, 450].map(Duration::from_millis);
        let is_in_run = |party: Party| match party {
            Party::Parent => true,
            Party::Node(node) => usize::from(node) < self.nodes.len(),
        };
        if !is_in_run(flight.from) || !is_in_run(flight.to) {
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
        let drawn = last.is_none_or(|last| flight.sent >= last + min_distance[kind]);
        if drawn {
            *last = Some(flight.sent);
        }
        drawn
    }

    /// Delays the messages that are on a link at `at` until `until`.
    pub(super) fn delayed(&mut self, link: (Party, Party), at: Time, until: Time) {
        let is_there = |flight: &&mut Flight| (flight.from, flight.to) == link && flight.arrives > at;
        self.pending.values_mut().filter(is_there).for_each(|flight| flight.hold(at, until));
        self.flights.hold(link, at, until);
    }

    /// Notes a received message.
    pub(super) fn received(&mut self, flight: Flight, at: Time) {
        self.note_heard(&flight, at);
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
            Cargo::Again(ranges) => Some(self.count_new(to, ranges.iter().cloned().flatten())),
            _ => None,
        };
        let Some(state) = self.node(to) else { return };
        let ranges = match flight.cargo {
            Cargo::Band(band) => {
                // The parent sends a band again to a node that it took for gone.
                state.band_at.get_or_insert(at);
                vec![band]
            }
            Cargo::Part(part) => {
                state.awaits_answer = false;
                if !part.is_empty() {
                    state.got.add(part.len() as u32);
                }
                vec![part]
            }
            Cargo::Transfer(ranges) | Cargo::Again(ranges) => {
                state.awaits_answer = false;
                state.got.add(atoms_in(&ranges));
                ranges
            }
            Cargo::Offer { .. } | Cargo::Request | Cargo::Results(_) | Cargo::Shutdown => return,
            Cargo::Wake | Cargo::Sleeps | Cargo::Beat | Cargo::Notice => return,
        };
        state.give(again.unwrap_or_else(|| atoms_in(&ranges)), at);
        for range in ranges {
            if let Some(places) = self.atoms.get_mut(range.start as usize..range.end as usize) {
                places.iter_mut().for_each(|place| place.arrive(to, flight.arrives));
                self.touched.push(range);
            }
        }
    }
}
