//! The parent's ledger in the adaptive ring: when the parent last heard of each node, and the [`Leases`] on the atoms.
//! Idle nodes get the lost atoms.

use std::ops::Range;
use std::time::Duration;

use super::leases::Leases;
use super::message::{Action, Message, NodeId, Party};
use super::strategy::LEASE_BEATS;
use crate::picture::Atom;
use crate::time::Time;

/// The parent's knowledge of nodes and atoms.
#[derive(Debug)]
pub(super) struct Ledger {
    leases: Leases,
    nodes: Vec<LedgerEntry>,
    atoms: Atom,
}

#[derive(Clone, Debug)]
struct LedgerEntry {
    /// When the parent last heard of the node; `None` until its first message.
    heard: Option<Time>,
    idle: bool,
    gone: bool,
    /// When the parent last invited the node back, if it is gone.
    invited: Time,
    /// Whether the node was off from the start. It is not invited: it asks to be let in.
    spare: bool,
}

impl Ledger {
    /// Creates the ledger of `nodes` nodes and `atoms` atoms. The last `spares` nodes have not joined yet. At the start
    /// all atoms are with their nodes.
    pub fn new(beat: Duration, (nodes, spares): (NodeId, NodeId), atoms: Atom) -> Self {
        let entry = |node| {
            let spare = node + spares >= nodes;
            LedgerEntry { heard: None, idle: false, gone: spare, invited: Time::ZERO, spare }
        };
        Self { leases: Leases::new(beat, atoms), nodes: (0..nodes).map(entry).collect(), atoms }
    }

    /// Returns when the parent should next call [`Ledger::check`]: one beat later.
    pub fn next_check(&self, now: Time) -> Time {
        now + self.leases.beat()
    }

    /// Notes that the bands leave at `now`, and announces the spare nodes as gone.
    pub fn start(&mut self, now: Time, actions: &mut Vec<Action>) {
        self.leases.hand_out(now, &(0..self.atoms));
        if self.nodes.iter().any(|entry| entry.spare) {
            self.announce_gone(actions);
        }
    }

    /// Notes a message of `node`. If the node was gone, it is back, and all nodes are told.
    pub fn note_heard(&mut self, now: Time, node: NodeId, actions: &mut Vec<Action>) {
        let entry = &mut self.nodes[usize::from(node)];
        entry.heard = Some(now);
        entry.spare = false;
        if std::mem::take(&mut entry.gone) {
            self.announce_gone(actions);
        }
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
        self.nodes[usize::from(node)].idle = idle;
        if !done.is_empty() {
            actions.push(Action::Send { to: Party::Node(node), message: Message::Placed(done) });
        }
        self.reclaim_lost(now, placed, actions);
    }

    /// Notes that a worker has failed to trace an atom: another node gets it, or the run fails.
    pub fn atom_failed(&mut self, now: Time, atom: Atom, placed: &[bool], actions: &mut Vec<Action>) {
        if self.leases.atom_failed(atom, placed, actions) {
            self.hand_out_pool(now, placed, actions);
        }
    }

    /// Lets `node` into the ring, or invites it back: a machine that has started afresh knows neither band nor ring.
    pub fn invite(&mut self, node: NodeId, actions: &mut Vec<Action>) {
        let to = Party::Node(node);
        actions.push(Action::Send { to, message: Message::Band(0..0) });
        let gone = self.gone();
        if !gone.is_empty() {
            actions.push(Action::Send { to, message: Message::Gone(gone) });
        }
    }

    /// Finds nodes that have been silent for a lease, which are gone, and atoms that no node vouches for.
    pub fn check(&mut self, now: Time, placed: &[bool], actions: &mut Vec<Action>) {
        self.leases.forget_delays(now);
        let lease = self.leases.length();
        let mut changed = false;
        for entry in self.nodes.iter_mut().filter(|entry| !entry.gone) {
            // Before a node's first beat the scene may still travel to it.
            let patience = if entry.heard.is_some() { lease } else { lease * LEASE_BEATS };
            if now.since(entry.heard.unwrap_or_default()) > patience {
                (entry.gone, entry.invited, changed) = (true, now, true);
            }
        }
        if changed {
            self.announce_gone(actions);
        }
        // The failure may be over, and the request of a node that has started afresh may be lost.
        for node in 0..self.nodes.len() {
            let entry = &mut self.nodes[node];
            if entry.gone && !entry.spare && now.since(entry.invited) > lease {
                entry.invited = now;
                self.invite(node as NodeId, actions);
            }
        }
        self.reclaim_lost(now, placed, actions);
    }

    /// If a node is idle, finds the atoms that no node has vouched for during a lease, and hands them out.
    fn reclaim_lost(&mut self, now: Time, placed: &[bool], actions: &mut Vec<Action>) {
        if !self.nodes.iter().any(|entry| entry.idle && !entry.gone) {
            return;
        }
        self.leases.find_lost(now, placed);
        self.hand_out_pool(now, placed, actions);
    }

    /// Hands each idle node an equal part of the pool; the ring shares it further.
    fn hand_out_pool(&mut self, now: Time, placed: &[bool], actions: &mut Vec<Action>) {
        let mut idle = self.nodes.iter().filter(|entry| entry.idle && !entry.gone).count().max(1) as u32;
        for node in 0..self.nodes.len() {
            let pooled = self.leases.pooled();
            if pooled == 0 {
                return;
            }
            let LedgerEntry { idle: true, gone: false, .. } = self.nodes[node] else { continue };
            let count = pooled.div_ceil(idle);
            idle = (idle - 1).max(1);
            let again = self.leases.take_lost(now, count, placed);
            if !again.is_empty() {
                self.nodes[node].idle = false;
                actions.push(Action::Send { to: Party::Node(node as NodeId), message: Message::Again(again) });
            }
        }
    }

    /// Returns the nodes that are gone.
    fn gone(&self) -> Vec<NodeId> {
        (0..).zip(&self.nodes).filter(|(_, entry)| entry.gone).map(|(node, _)| node).collect()
    }

    fn announce_gone(&self, actions: &mut Vec<Action>) {
        announce_gone(self.nodes.len() as NodeId, &self.gone(), actions);
    }
}

/// Tells all nodes of the ring which nodes are gone, so that offers pass over these.
pub(super) fn announce_gone(nodes: NodeId, gone: &[NodeId], actions: &mut Vec<Action>) {
    let members = (0..nodes).filter(|node| !gone.contains(node));
    actions.extend(members.map(|node| Action::Send { to: Party::Node(node), message: Message::Gone(gone.to_vec()) }));
}
