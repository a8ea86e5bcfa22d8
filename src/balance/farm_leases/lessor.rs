//! The parent's side of the farm with leases: the fresh parts, the leases on all others, and the nodes that wait.

use std::ops::Range;
use std::time::Duration;

use crate::balance::farm::Parts;
use crate::balance::leases::Leases;
use crate::balance::message::{Action, Message, NodeId, Party};
use crate::balance::strategy::{LEASE_BEATS, Rules};
use crate::picture::Atom;
use crate::time::Time;

/// The parent's knowledge of parts and nodes.
#[derive(Debug)]
pub(in crate::balance) struct Lessor {
    fresh: Parts,
    /// Atoms in a part.
    part: u32,
    leases: Leases,
    nodes: Vec<Lessee>,
    spares: NodeId,
}

/// A node, as the parent knows it.
#[derive(Clone, Debug)]
struct Lessee {
    /// Whether it has no atoms and is to get some.
    waits: bool,
    /// When it was last given atoms; `None` once a message shows that they have come, or that it has none.
    given: Option<Time>,
    /// When the parent sends the band again, and the pause until then; `None` once it has heard of the node.
    next_band: Option<(Time, Duration)>,
}

impl Lessor {
    /// Creates the parent's side for `nodes` nodes, the last `spares` of which have not joined yet.
    pub fn new(rules: &Rules, (nodes, spares): (NodeId, NodeId), atoms: Atom) -> Self {
        let lessee = Lessee { waits: false, given: None, next_band: None };
        Self {
            fresh: Parts::new(atoms, nodes, rules.part, false),
            part: rules.part.max(1),
            leases: Leases::new(rules.beat, atoms),
            nodes: vec![lessee; usize::from(nodes)],
            spares,
        }
    }

    /// Returns when the parent should next call [`Lessor::check`]: one beat later.
    pub fn next_check(&self, now: Time) -> Time {
        now + self.leases.beat()
    }

    /// Gives each node that is not a spare its band.
    pub fn start(&mut self, now: Time, actions: &mut Vec<Action>) {
        // The scene may travel long.
        let pause = self.leases.length() * LEASE_BEATS;
        for node in 0..self.nodes.len() as NodeId - self.spares {
            self.nodes[usize::from(node)].next_band = Some((now + pause, pause));
            let band = self.take_fresh(now, node);
            send(node, Message::Band(band), actions);
        }
    }

    /// Notes that the parent has heard of `node`.
    pub fn note_heard(&mut self, node: NodeId) {
        self.nodes[usize::from(node)].next_band = None;
    }

    /// Answers the request of a node that has no atoms.
    pub fn request(&mut self, now: Time, node: NodeId, placed: &[bool], actions: &mut Vec<Action>) {
        self.give(now, node, placed, actions);
        if self.nodes[usize::from(node)].waits {
            send(node, Message::Part(0..0), actions);
        }
    }

    /// Sends the scene to a node that has started afresh, with a fresh part unless one may be on its way already.
    pub fn join(&mut self, now: Time, node: NodeId, actions: &mut Vec<Action>) {
        let band = if self.may_be_on_the_way(now, node) { 0..0 } else { self.take_fresh(now, node) };
        send(node, Message::Band(band), actions);
    }

    /// Notes a node's beat: the atoms that it `holds` and vouches for, and whether it is `idle`. Tells it which of
    /// these atoms are in the picture already.
    pub fn beat(
        &mut self,
        now: Time,
        (node, sent): (NodeId, Time),
        (holds, idle): (&[Range<Atom>], bool),
        placed: &[bool],
        actions: &mut Vec<Action>,
    ) {
        let done = self.leases.vouch(now, sent, holds, placed);
        if !done.is_empty() {
            send(node, Message::Placed(done), actions);
        }
        if !idle {
            let lessee = &mut self.nodes[usize::from(node)];
            (lessee.waits, lessee.given) = (false, None);
        } else if !self.may_be_on_the_way(now, node) {
            self.give(now, node, placed, actions);
        }
    }

    /// Notes that a worker has failed to trace an atom: another node gets it, or the run fails.
    pub fn atom_failed(&mut self, now: Time, atom: Atom, placed: &[bool], actions: &mut Vec<Action>) {
        if self.leases.atom_failed(atom, placed, actions) {
            self.give_lost(now, placed, actions);
        }
    }

    /// Gives lost atoms to the waiting nodes, and repeats bands that may be lost.
    pub fn check(&mut self, now: Time, placed: &[bool], actions: &mut Vec<Action>) {
        self.leases.forget_delays(now);
        for (node, lessee) in (0..).zip(&mut self.nodes) {
            if let Some((at, pause)) = lessee.next_band.filter(|(at, _)| *at <= now) {
                lessee.next_band = Some((at + pause * 2, pause * 2));
                send(node, Message::Band(0..0), actions);
            }
        }
        self.give_lost(now, placed, actions);
    }

    /// Gives a node without atoms the next fresh part, or lost atoms. If there are none, the node waits.
    fn give(&mut self, now: Time, node: NodeId, placed: &[bool], actions: &mut Vec<Action>) {
        let lessee = &mut self.nodes[usize::from(node)];
        (lessee.waits, lessee.given) = (true, None);
        let part = self.take_fresh(now, node);
        if part.is_empty() {
            self.give_lost(now, placed, actions);
        } else {
            send(node, Message::Part(part), actions);
        }
    }

    fn note_given(&mut self, now: Time, node: NodeId) {
        let lessee = &mut self.nodes[usize::from(node)];
        (lessee.waits, lessee.given) = (false, Some(now));
    }

    /// Returns whether the atoms that the node was last given may still be on their way to it.
    fn may_be_on_the_way(&self, now: Time, node: NodeId) -> bool {
        self.nodes[usize::from(node)].given.is_some_and(|given| now.since(given) <= self.leases.length())
    }

    /// Takes the next fresh part for a node; it is empty if there is none.
    fn take_fresh(&mut self, now: Time, node: NodeId) -> Range<Atom> {
        let part = self.fresh.next(node);
        if !part.is_empty() {
            self.leases.hand_out(now, &part);
            self.note_given(now, node);
        }
        part
    }

    /// If nodes wait, gives each of them an equal number of the lost atoms, but at most a part. No part is fresh then.
    fn give_lost(&mut self, now: Time, placed: &[bool], actions: &mut Vec<Action>) {
        let mut waiting = self.nodes.iter().filter(|lessee| lessee.waits).count() as u32;
        if waiting == 0 {
            return;
        }
        self.leases.find_lost(now, placed);
        for node in 0..self.nodes.len() as NodeId {
            if !self.nodes[usize::from(node)].waits {
                continue;
            }
            let count = self.leases.pooled().div_ceil(waiting).min(self.part);
            waiting -= 1;
            let again = self.leases.take_lost(now, count, placed);
            if !again.is_empty() {
                self.note_given(now, node);
                send(node, Message::Again(again), actions);
            }
        }
    }
}

/// Appends the action that sends `message` to a node.
fn send(node: NodeId, message: Message, actions: &mut Vec<Action>) {
    actions.push(Action::Send { to: Party::Node(node), message });
}
