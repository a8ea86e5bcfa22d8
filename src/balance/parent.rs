//! The parent (§8): hands out bands once, assembles the picture, sends shutdown; decides nothing else.

use super::message::{Action, Event, Message, NodeId, Party};
use super::strategy::Strategy;
use crate::picture::{Atom, Division};
use crate::time::Time;

/// The parent of a run.
#[derive(Debug)]
pub struct Parent {
    strategy: Strategy,
    division: Division,
    nodes: NodeId,
    /// By atom: whether its pixels are in the picture.
    placed: Vec<bool>,
    missing: u32,
}

impl Parent {
    /// The parent of `nodes` nodes (at least one), which are to trace the atoms of `division`.
    pub fn new(strategy: Strategy, division: Division, nodes: NodeId) -> Self {
        assert!(nodes > 0, "a run needs a node");
        let missing = division.atoms();
        Self { strategy, division, nodes, placed: vec![false; missing as usize], missing }
    }

    /// Answers `event` by appending to `actions`; the time does not matter to a parent.
    ///
    /// # Panics
    /// If the event is impossible: an atom that has been placed before, or a message that no node sends here.
    pub fn handle(&mut self, _now: Time, event: Event, actions: &mut Vec<Action>) {
        match event {
            Event::Started => {
                let bands = self.strategy.bands(self.division, self.nodes);
                for (node, band) in (0..self.nodes).zip(bands) {
                    actions.push(Action::Send { to: Party::Node(node), message: Message::Band(band) });
                }
            }
            Event::Message { message: Message::Results(ranges), .. } => {
                ranges.into_iter().flatten().for_each(|atom| self.place(atom));
                if self.missing == 0 {
                    self.shut_down(actions);
                }
            }
            other => unreachable!("a parent is never handed {other:?}"),
        }
    }

    fn place(&mut self, atom: Atom) {
        let placed = &mut self.placed[atom as usize];
        assert!(!*placed, "atom {atom} was traced twice");
        *placed = true;
        self.missing -= 1;
    }

    fn shut_down(&self, actions: &mut Vec<Action>) {
        let nodes = (0..self.nodes).map(Party::Node);
        actions.extend(nodes.map(|to| Action::Send { to, message: Message::Shutdown }));
        actions.push(Action::Finish);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "atom 2 was traced twice")]
    fn an_atom_is_placed_only_once() {
        let mut parent = Parent::new(Strategy::Ring, Division::new(100, 10), 2);
        let message = Message::Results(vec![1..3, 2..4]);
        parent.handle(Time::ZERO, Event::Message { from: Party::Node(0), message }, &mut Vec::new());
    }
}
