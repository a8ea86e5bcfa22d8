//! The parent (§8): it hands out bands once, assembles the picture and sends the shutdown. It decides nothing else,
//! except in a farm, and about lost atoms in the adaptive ring.

use std::ops::Range;

use super::estimate;
use super::farm::Parts;
use super::farm_leases::Lessor;
use super::ledger::{Ledger, announce_gone};
use super::message::{Action, Event, Message, NodeId, Party};
use super::remedy::Remedy;
use super::strategy::{Rules, Strategy};
use crate::picture::{Atom, Division};
use crate::time::Time;

/// The parent of a run.
#[derive(Debug)]
pub struct Parent {
    assignment: Assignment,
    division: Division,
    nodes: NodeId,
    spares: NodeId,
    /// By atom: whether its pixels are in the picture.
    placed: Vec<bool>,
    /// Number of atoms that are not in the picture.
    missing: u32,
}

/// The parent's part in sharing the atoms, by strategy.
#[derive(Debug)]
enum Assignment {
    /// The first node gets all atoms.
    Serial,
    /// Equal bands.
    Bands,
    /// Bands of about equal cost, by a sample.
    Estimate,
    /// A part for each node that asks.
    Farm(Parts),
    /// A part for each node that asks, and leases on the parts, since machines may be lost.
    FarmWithLeases(Lessor),
    /// Equal bands, and a ledger of nodes and atoms, since machines may be lost.
    WithLeases(Ledger),
    /// Equal bands in an adaptive ring without leases. The parent knows only the nodes that have not joined yet.
    WithoutLeases(Vec<NodeId>),
}

impl Parent {
    /// Creates the parent of `nodes` nodes (at least one) that trace the atoms of `division`.
    pub fn new(rules: &Rules, division: Division, nodes: NodeId) -> Self {
        Self::with_spares(rules, division, nodes, 0)
    }

    /// Creates the parent of `nodes` nodes, the last `spares` of which are off at first: they get no band, and may
    /// join.
    pub fn with_spares(rules: &Rules, division: Division, nodes: NodeId, spares: NodeId) -> Self {
        assert!(nodes > spares, "a run needs a node");
        let missing = division.atoms();
        let farm = |by_speed| Assignment::Farm(Parts::new(missing, nodes, rules.part, by_speed));
        let assignment = match rules.strategy {
            Strategy::Serial => Assignment::Serial,
            Strategy::Static | Strategy::Ring => Assignment::Bands,
            Strategy::StaticEstimate => Assignment::Estimate,
            Strategy::Farm => farm(false),
            Strategy::FarmBySpeed => farm(true),
            Strategy::FarmLeases => Assignment::FarmWithLeases(Lessor::new(rules, (nodes, spares), missing)),
            Strategy::Adaptive => {
                if rules.remedies.has(Remedy::Leases) {
                    Assignment::WithLeases(Ledger::new(rules.beat, (nodes, spares), missing))
                } else {
                    Assignment::WithoutLeases((nodes - spares..nodes).collect())
                }
            }
        };
        Self { assignment, division, nodes, spares, placed: vec![false; missing as usize], missing }
    }

    /// Handles `event` at the time `now` and appends its answer to `actions`. The time matters only where
    /// machines may be lost.
    ///
    /// # Panics
    /// If the event is impossible: an atom that is already placed (except where machines may be lost), or a message
    /// that no node of this strategy sends.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        if let Event::Message { from: Party::Node(node), .. } = event {
            match &mut self.assignment {
                Assignment::WithLeases(ledger) => ledger.note_heard(now, node, actions),
                Assignment::FarmWithLeases(lessor) => lessor.note_heard(node),
                _ => {}
            }
        }
        match event {
            Event::Started => {
                let nodes = usize::from(self.nodes - self.spares);
                match &mut self.assignment {
                    Assignment::Serial => {
                        let all = self.division.atoms();
                        hand_out_bands((0..nodes).map(|node| if node == 0 { 0..all } else { all..all }), actions);
                    }
                    Assignment::Bands => hand_out_bands(self.division.bands(nodes), actions),
                    Assignment::Estimate => actions.push(Action::Estimate),
                    Assignment::Farm(parts) => hand_out_bands((0..self.nodes).map(|node| parts.next(node)), actions),
                    Assignment::FarmWithLeases(lessor) => {
                        lessor.start(now, actions);
                        actions.push(Action::SetTimer(lessor.next_check(now)));
                    }
                    Assignment::WithLeases(ledger) => {
                        hand_out_bands(self.division.bands(nodes), actions);
                        ledger.start(now, actions);
                        actions.push(Action::SetTimer(ledger.next_check(now)));
                    }
                    Assignment::WithoutLeases(gone) => {
                        hand_out_bands(self.division.bands(nodes), actions);
                        if !gone.is_empty() {
                            announce_gone(self.nodes, gone, actions);
                        }
                    }
                }
            }
            Event::Estimated(costs) => {
                hand_out_bands(estimate::bands(&costs, self.division, usize::from(self.nodes)), actions);
            }
            Event::Message { message: Message::Results(ranges), .. } => {
                ranges.into_iter().flatten().for_each(|atom| self.place(atom));
                if self.missing == 0 {
                    self.shut_down(actions);
                }
            }
            Event::Message { from: Party::Node(node), message } => self.answer(now, node, message, actions),
            Event::Timer => {
                let next = match &mut self.assignment {
                    Assignment::WithLeases(ledger) => {
                        ledger.check(now, &self.placed, actions);
                        ledger.next_check(now)
                    }
                    Assignment::FarmWithLeases(lessor) => {
                        lessor.check(now, &self.placed, actions);
                        lessor.next_check(now)
                    }
                    _ => return,
                };
                actions.push(Action::SetTimer(next));
            }
            other => unreachable!("a parent is never handed {other:?}"),
        }
    }

    /// Answers a message other than results.
    fn answer(&mut self, now: Time, node: NodeId, message: Message, actions: &mut Vec<Action>) {
        match (&mut self.assignment, message) {
            (Assignment::Farm(parts), Message::Request) => {
                let message = Message::Part(parts.next(node));
                actions.push(Action::Send { to: Party::Node(node), message });
            }
            (Assignment::FarmWithLeases(lessor), Message::Request) => lessor.request(now, node, &self.placed, actions),
            (Assignment::FarmWithLeases(lessor), Message::Join) => lessor.join(now, node, actions),
            (Assignment::FarmWithLeases(lessor), Message::Beat { holds, idle, sent }) => {
                lessor.beat(now, (node, sent), (&holds, idle), &self.placed, actions);
            }
            (Assignment::FarmWithLeases(lessor), Message::Failed(atom)) => {
                lessor.atom_failed(now, atom, &self.placed, actions);
            }
            (Assignment::WithLeases(ledger), Message::Request) => ledger.invite(node, actions),
            // Without a ledger the atoms that it had stay lost, but it may help with the others.
            (Assignment::WithoutLeases(gone), Message::Request) => {
                hand_out_band(node, 0..0, actions);
                gone.retain(|&other| other != node);
                announce_gone(self.nodes, gone, actions);
            }
            (Assignment::WithLeases(ledger), Message::Beat { holds, idle, sent }) => {
                ledger.beat(now, (node, sent), (&holds, idle), &self.placed, actions);
            }
            (Assignment::WithLeases(ledger), Message::Failed(atom)) => {
                ledger.atom_failed(now, atom, &self.placed, actions)
            }
            (Assignment::WithoutLeases(_), Message::Failed(atom)) => actions.push(Action::Fail(atom)),
            (_, other) => unreachable!("node {node} sends {other:?} to a parent that has no use for it"),
        }
    }

    /// Marks an atom as placed. If it was traced more than once, the first result counts.
    fn place(&mut self, atom: Atom) {
        let placed = &mut self.placed[atom as usize];
        let again = std::mem::replace(placed, true);
        let may_repeat = matches!(
            self.assignment,
            Assignment::WithLeases(_) | Assignment::WithoutLeases(_) | Assignment::FarmWithLeases(_)
        );
        assert!(!again || may_repeat, "atom {atom} was traced twice");
        self.missing -= u32::from(!again);
    }

    fn shut_down(&self, actions: &mut Vec<Action>) {
        let nodes = (0..self.nodes).map(Party::Node);
        actions.extend(nodes.map(|to| Action::Send { to, message: Message::Shutdown }));
        actions.push(Action::Finish);
    }
}

/// Sends each node its band, and the scene with it.
fn hand_out_bands(bands: impl IntoIterator<Item = Range<Atom>>, actions: &mut Vec<Action>) {
    (0..).zip(bands).for_each(|(node, band)| hand_out_band(node, band, actions));
}

fn hand_out_band(node: NodeId, band: Range<Atom>, actions: &mut Vec<Action>) {
    actions.push(Action::Send { to: Party::Node(node), message: Message::Band(band) });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "atom 2 was traced twice")]
    fn placing_an_atom_twice_panics_in_the_articles_ring() {
        let division = Division::new(100, 10);
        let mut parent = Parent::new(&Rules::usual(Strategy::Ring, division, 2), division, 2);
        let message = Message::Results(vec![1..3, 2..4]);
        parent.handle(Time::ZERO, Event::Message { from: Party::Node(0), message }, &mut Vec::new());
    }
}
