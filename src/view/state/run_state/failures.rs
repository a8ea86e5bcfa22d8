//! Failures in the state of a run: conditions of machines, lost messages, lost atoms, and the adaptive ring's messages
//! about them.

use std::collections::BTreeSet;

use super::RunState;
use crate::balance::{Condition, Message, NodeId, Party};
use crate::picture::Atom;
use crate::time::Time;
use crate::view::state::atom_state::AtomState;
use crate::view::state::flight::{Cargo, Flight};

impl RunState {
    /// Sets a machine's condition. A machine that is switched off loses its atoms.
    pub(super) fn set_condition(&mut self, node: NodeId, condition: Condition, at: Time) {
        let Some(state) = self.node(node) else { return };
        state.set_condition(condition, at);
        state.spare &= condition == Condition::Off;
        if condition == Condition::Off {
            state.set_left(0, at);
            (state.atom, state.band_at) = (None, None);
            (state.retired, state.awaits_answer) = (false, false);
            self.lose_all(node);
        }
    }

    /// Notes that a message did not arrive, and loses the atoms in it.
    pub(super) fn lose_message(&mut self, id: u64, at: Time) {
        let Some(flight) = self.pending.remove(&id) else { return };
        let is_off = |party: Party| match party {
            Party::Parent => false,
            Party::Node(node) => self.nodes.get(usize::from(node)).is_some_and(|of| of.condition == Condition::Off),
        };
        let off = is_off(flight.to);
        self.flights.lose(id, at, off);
        let Party::Node(from) = flight.from else { return };
        match &flight.cargo {
            Cargo::Transfer(ranges) => {
                let with_it = |place: &AtomState| matches!(place, AtomState::With { node, .. } if *node == from);
                self.lose(ranges.iter().cloned().flatten(), with_it);
            }
            Cargo::Results(ranges) => {
                self.lose(ranges.iter().cloned().flatten(), |place| place.owner() == Some(from) && !place.is_placed());
            }
            _ => {}
        }
    }

    /// Applies a message of the adaptive ring that says which atoms a node has, or which nodes have left the ring.
    pub(super) fn apply_status(&mut self, from: Party, message: &Message, at: Time) {
        match (from, message) {
            (Party::Parent, Message::Gone(gone)) => {
                self.previous_gone = std::mem::replace(&mut self.gone, gone.clone());
            }
            (Party::Node(from), Message::Offer { who, done, .. }) if from == *who => {
                if let Some(node) = self.node(from) {
                    node.offered = *done;
                }
            }
            (Party::Node(from), Message::Beat { holds, idle, .. }) if *idle || !holds.is_empty() => {
                let places = &self.atoms;
                let unsent = |atom: &Atom| places.get(*atom as usize).is_some_and(|at| at.owner() == Some(from));
                let left = holds.iter().cloned().flatten().filter(|atom| !unsent(atom)).count() as u32;
                if let Some(node) = self.node(from) {
                    node.set_left(if *idle { 0 } else { left }, at);
                }
            }
            _ => {}
        }
    }

    /// Notes when the parent received a message of a node.
    pub(super) fn note_heard(&mut self, flight: &Flight, at: Time) {
        if let (Party::Node(from), Party::Parent) = (flight.from, flight.to)
            && let Some(node) = self.node(from)
        {
            node.last_heard = Some(at);
        }
    }

    /// Counts the atoms that a node does not have yet.
    pub(super) fn count_new(&self, node: NodeId, atoms: impl Iterator<Item = Atom>) -> u32 {
        let has = |place: &AtomState| matches!(place, AtomState::With { node: with, .. } if *with == node);
        atoms.filter(|&atom| !self.atoms.get(atom as usize).is_some_and(has)).count() as u32
    }

    /// Counts an atom for a node when the parent has placed its result, although the atom was with another node, or
    /// lost.
    pub(super) fn count_late(&mut self, atom: Atom, by: NodeId, at: Time) {
        let order = self.done();
        self.orders[atom as usize] = order;
        self.atoms[atom as usize] = AtomState::traced(by, std::time::Duration::ZERO, at);
        self.atoms[atom as usize].place();
        if let Some(node) = self.node(by) {
            node.done += 1;
        }
    }

    /// Marks all atoms of a machine as lost, except those in messages that it has sent.
    fn lose_all(&mut self, node: NodeId) {
        let mut left: BTreeSet<Atom> = BTreeSet::new();
        for flight in self.pending.values().filter(|flight| flight.from == Party::Node(node)) {
            left.extend(flight.cargo.ranges().iter().cloned().flatten());
        }
        let all = self.atoms();
        let lost = self.lose((0..all).filter(|atom| !left.contains(atom)), |place| {
            place.holder() == Some(node) && !place.is_placed()
        });
        if let Some(state) = self.node(node) {
            state.lost_atoms = lost;
        }
    }

    /// Loses the atoms whose state fits. Returns their number.
    fn lose(&mut self, atoms: impl Iterator<Item = Atom>, fits: impl Fn(&AtomState) -> bool) -> u32 {
        let mut lost = 0;
        for atom in atoms {
            let Some(place) = self.atoms.get_mut(atom as usize).filter(|place| fits(place)) else { continue };
            let before = std::mem::replace(place, AtomState::Lost);
            if let AtomState::Traced { by, cost, .. } = before {
                self.total_cost -= f64::from(cost);
                if let Some(owner) = self.nodes.get_mut(usize::from(by)) {
                    owner.done = owner.done.saturating_sub(1);
                }
            }
            self.touched.push(atom..atom + 1);
            lost += 1;
        }
        lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::Strategy;
    use crate::record::{Record, RecordKind};
    use crate::runlog::Header;
    use crate::scenario::Command;
    use crate::sim::Sim;
    use crate::view::tests::sample_runs;

    /// Runs four machines; machine 2 gets conditions at some seconds.
    fn run(strategy: Strategy, conditions: &[(f64, Condition)], spares: NodeId) -> (Header, Vec<Record>) {
        let mut header = sample_runs::header(&[1.0; 4], 900);
        header.rules.strategy = strategy;
        header.spares = spares;
        let command =
            |&(at, condition): &(f64, Condition)| (Time::from_secs(at), Command::Condition { node: 1, condition });
        let script: Vec<_> = conditions.iter().map(command).collect();
        let mut records = Vec::new();
        Sim::new(&header, &script, |_| sample_runs::COST).run(&mut |record| records.push(record));
        (header, records)
    }

    #[test]
    fn atoms_lost_with_a_machine_are_traced_again_and_count_once() {
        let (header, records) = run(Strategy::Adaptive, &[(1.0, Condition::Off), (1.8, Condition::Well)], 0);
        let mut state = RunState::new(&header);
        let mut were_lost = 0;
        for record in &records {
            state.apply(record);
            assert!(state.done() <= 900);
            let traced = state.atom_states().iter().filter(|place| place.owner().is_some()).count();
            assert_eq!(traced as u32, state.done(), "{record:?}");
            if let RecordKind::Condition { condition: Condition::Off, .. } = record.kind {
                let node = &state.nodes()[1];
                assert_eq!((node.left(), node.atom, node.retired), (0, None, false));
                assert!(node.lost_atoms > 50, "{}", node.lost_atoms);
                were_lost = state.atom_states().iter().filter(|place| **place == AtomState::Lost).count();
            }
        }
        assert!(were_lost > 50, "{were_lost}");
        assert!(state.finished().is_some() && state.done() == 900);
        assert_eq!(state.nodes().iter().map(|node| node.done).sum::<u32>(), 900);
        assert!(state.nodes()[1].condition == Condition::Well && state.nodes()[1].done > 0);
    }

    #[test]
    fn lost_atoms_stay_lost_without_a_remedy() {
        let (header, records) = run(Strategy::Ring, &[(1.0, Condition::Off)], 0);
        let mut state = RunState::new(&header);
        records.iter().for_each(|record| state.apply(record));
        assert!(state.finished().is_none());
        let lost = state.atom_states().iter().filter(|place| **place == AtomState::Lost).count() as u32;
        assert!(lost > 50 && state.done() + lost <= 900, "{lost} {}", state.done());
    }

    #[test]
    fn spare_is_spare_until_it_joins() {
        let (header, records) = run(Strategy::Adaptive, &[], 1);
        let mut state = RunState::new(&header);
        records.iter().take(200).for_each(|record| state.apply(record));
        assert_eq!(state.nodes().iter().map(|node| node.spare).collect::<Vec<_>>(), [false, false, false, true]);
        let kind = RecordKind::Condition { node: 3, condition: Condition::Well };
        state.apply(&Record { at: state.head(), kind });
        assert!(!state.nodes()[3].spare && state.nodes()[3].condition == Condition::Well);
        assert_eq!(state.gone, [3], "until the parent hears of it");
    }
}
