//! The parent (§8): hands out bands once, assembles the picture, sends shutdown; decides nothing else, but in a farm,
//! and in the ring that adapts of what is lost.

use std::ops::Range;

use super::estimate;
use super::farm::Parts;
use super::ledger::{Ledger, tell_who_is_gone};
use super::message::{Action, Event, Message, NodeId, Party};
use super::remedy::Remedy;
use super::strategy::{Rules, Strategy};
use crate::picture::{Atom, Division};
use crate::time::Time;

/// The parent of a run.
#[derive(Debug)]
pub struct Parent {
    sharing: Assignment,
    division: Division,
    nodes: NodeId,
    spares: NodeId,
    /// By atom: whether its pixels are in the picture.
    placed: Vec<bool>,
    missing: u32,
}

/// What the parent does to share the atoms.
#[derive(Debug)]
enum Assignment {
    /// The first node gets all.
    Serial,
    /// Equal bands.
    Bands,
    /// Bands of equal cost, as far as a sample tells.
    Estimate,
    /// A part for whoever asks.
    Farm(Parts),
    /// Equal bands, and a ledger, since machines may be lost.
    Adaptive(Ledger),
    /// The same without leases: nothing is known but who has not joined yet.
    Trusting(Vec<NodeId>),
}

impl Parent {
    /// The parent of `nodes` nodes (at least one), which are to trace the atoms of `division`.
    pub fn new(rules: &Rules, division: Division, nodes: NodeId) -> Self {
        Self::with_spares(rules, division, nodes, 0)
    }

    /// The same where the last `spares` of the nodes are off at first: they are given no band, and may join.
    pub fn with_spares(rules: &Rules, division: Division, nodes: NodeId, spares: NodeId) -> Self {
        assert!(nodes > spares, "a run needs a node");
        let missing = division.atoms();
        let farm = |by_speed| Assignment::Farm(Parts::new(missing, nodes, rules.part, by_speed));
        let sharing = match rules.strategy {
            Strategy::Serial => Assignment::Serial,
            Strategy::Static | Strategy::Ring => Assignment::Bands,
            Strategy::StaticEstimate => Assignment::Estimate,
            Strategy::Farm => farm(false),
            Strategy::FarmBySpeed => farm(true),
            Strategy::Adaptive => {
                if rules.remedies.has(Remedy::Leases) {
                    Assignment::Adaptive(Ledger::new(rules.beat, (nodes, spares), missing))
                } else {
                    Assignment::Trusting((nodes - spares..nodes).collect())
                }
            }
        };
        Self { sharing, division, nodes, spares, placed: vec![false; missing as usize], missing }
    }

    /// Answers `event`, which happens at `now`, by appending to `actions`; the time matters only in the ring that adapts.
    ///
    /// # Panics
    /// If the event is impossible: an atom that has been placed before (but in the ring that adapts), or a message that no
    /// node sends here.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        if let (Assignment::Adaptive(ledger), Event::Message { from: Party::Node(node), .. }) =
            (&mut self.sharing, &event)
        {
            ledger.hear(now, *node, actions);
        }
        match event {
            Event::Started => {
                let nodes = usize::from(self.nodes - self.spares);
                match &mut self.sharing {
                    Assignment::Serial => {
                        let all = self.division.atoms();
                        hand_out((0..nodes).map(|node| if node == 0 { 0..all } else { all..all }), actions);
                    }
                    Assignment::Bands => hand_out(self.division.bands(nodes), actions),
                    Assignment::Estimate => actions.push(Action::Estimate),
                    Assignment::Farm(parts) => hand_out((0..self.nodes).map(|node| parts.next(node)), actions),
                    Assignment::Adaptive(ledger) => {
                        hand_out(self.division.bands(nodes), actions);
                        ledger.start(now, actions);
                        actions.push(Action::SetTimer(ledger.next_look(now)));
                    }
                    Assignment::Trusting(gone) => {
                        hand_out(self.division.bands(nodes), actions);
                        if !gone.is_empty() {
                            tell_who_is_gone(self.nodes, gone, actions);
                        }
                    }
                }
            }
            Event::Estimated(costs) => {
                hand_out(estimate::bands(&costs, self.division, usize::from(self.nodes)), actions);
            }
            Event::Message { message: Message::Results(ranges), .. } => {
                ranges.into_iter().flatten().for_each(|atom| self.place(atom));
                if self.missing == 0 {
                    self.shut_down(actions);
                }
            }
            Event::Message { from: Party::Node(node), message } => self.answer(now, node, message, actions),
            Event::Timer => {
                if let Assignment::Adaptive(ledger) = &mut self.sharing {
                    ledger.look(now, &self.placed, actions);
                    actions.push(Action::SetTimer(ledger.next_look(now)));
                }
            }
            other => unreachable!("a parent is never handed {other:?}"),
        }
    }

    /// Answers what is not results.
    fn answer(&mut self, now: Time, node: NodeId, message: Message, actions: &mut Vec<Action>) {
        match (&mut self.sharing, message) {
            (Assignment::Farm(parts), Message::Request) => {
                let message = Message::Part(parts.next(node));
                actions.push(Action::Send { to: Party::Node(node), message });
            }
            (Assignment::Adaptive(ledger), Message::Request) => ledger.ask_in(node, actions),
            // Without a ledger what it had is lost; it may help all the same.
            (Assignment::Trusting(gone), Message::Request) => {
                hand_out_to(node, 0..0, actions);
                gone.retain(|&other| other != node);
                tell_who_is_gone(self.nodes, gone, actions);
            }
            (Assignment::Adaptive(ledger), Message::Beat { holds, idle, sent }) => {
                ledger.beat(now, (node, sent), (&holds, idle), &self.placed, actions);
            }
            (Assignment::Adaptive(ledger), Message::Failed(atom)) => ledger.failed(now, atom, &self.placed, actions),
            (Assignment::Trusting(_), Message::Failed(atom)) => actions.push(Action::Fail(atom)),
            (_, other) => unreachable!("node {node} sends {other:?} to a parent that has no use for it"),
        }
    }

    /// Of an atom that was traced more than once the first result counts.
    fn place(&mut self, atom: Atom) {
        let placed = &mut self.placed[atom as usize];
        let again = std::mem::replace(placed, true);
        assert!(
            !again || matches!(self.sharing, Assignment::Adaptive(_) | Assignment::Trusting(_)),
            "atom {atom} was traced twice"
        );
        self.missing -= u32::from(!again);
    }

    fn shut_down(&self, actions: &mut Vec<Action>) {
        let nodes = (0..self.nodes).map(Party::Node);
        actions.extend(nodes.map(|to| Action::Send { to, message: Message::Shutdown }));
        actions.push(Action::Finish);
    }
}

/// Gives each node its first share, and the scene with it.
fn hand_out(bands: impl IntoIterator<Item = Range<Atom>>, actions: &mut Vec<Action>) {
    (0..).zip(bands).for_each(|(node, band)| hand_out_to(node, band, actions));
}

fn hand_out_to(node: NodeId, band: Range<Atom>, actions: &mut Vec<Action>) {
    actions.push(Action::Send { to: Party::Node(node), message: Message::Band(band) });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "atom 2 was traced twice")]
    fn an_atom_is_placed_only_once() {
        let division = Division::new(100, 10);
        let mut parent = Parent::new(&Rules::usual(Strategy::Ring, division, 2), division, 2);
        let message = Message::Results(vec![1..3, 2..4]);
        parent.handle(Time::ZERO, Event::Message { from: Party::Node(0), message }, &mut Vec::new());
    }
}
