//! The parent's ledger in the adaptive ring: when the parent last heard of each node, and when a node last vouched for
//! each atom.
//!
//! One rule repairs every loss, of a machine, of a message or of a machine's memory: an atom that is missing from the
//! picture and that no node has vouched for during a lease goes back to the pool, and idle nodes get the atoms of the
//! pool. If an atom is traced twice after all, the first result counts.

use std::collections::BTreeMap;
use std::ops::Range;
use std::time::Duration;

use super::message::{Action, Message, NodeId, Party};
use super::strategy::LEASE_BEATS;
use crate::picture::{Atom, atoms_in, push_atom};
use crate::time::Time;

/// Failures to trace the same atom that make the run fail.
const MAX_ATOM_FAILURES: u8 = 3;

/// Beats for which a long delay is remembered at least; at most it is twice as many.
const DELAY_MEMORY_BEATS: u32 = 256;

/// The parent's knowledge of nodes and atoms.
#[derive(Debug)]
pub(super) struct Ledger {
    beat: Duration,
    nodes: Vec<LedgerEntry>,
    /// By atom: when a node last vouched for it; `None` if a worker has failed to trace it.
    held: Vec<Option<Time>>,
    /// Atoms that no node has vouched for during a lease, as of the last search.
    pool: Vec<Range<Atom>>,
    /// No other atom can count as lost before this time.
    next_lost: Time,
    failures: BTreeMap<Atom, u8>,
    /// Longest delay of a beat in this period of [`DELAY_MEMORY_BEATS`] and in the period before, so that one long
    /// delay does not count for ever.
    delays: [Duration; 2],
    /// When the next period begins.
    next_period: Time,
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
        Self {
            beat,
            nodes: (0..nodes).map(entry).collect(),
            held: vec![None; atoms as usize],
            pool: Vec::new(),
            next_lost: Time::ZERO,
            failures: BTreeMap::new(),
            delays: [Duration::ZERO; 2],
            next_period: Time::ZERO + beat * DELAY_MEMORY_BEATS,
        }
    }

    /// Returns when the parent should next call [`Ledger::check`]: one beat later.
    pub fn next_check(&self, now: Time) -> Time {
        now + self.beat
    }

    /// Notes that the bands leave at `now`, and announces the spare nodes as gone.
    pub fn start(&mut self, now: Time, actions: &mut Vec<Action>) {
        self.held.fill(Some(now));
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
        self.delays[0] = self.delays[0].max(now.since(sent));
        self.nodes[usize::from(node)].idle = idle;
        let mut done = Vec::new();
        for atom in holds.iter().cloned().flatten() {
            if placed[atom as usize] {
                push_atom(&mut done, atom);
            } else {
                self.held[atom as usize] = Some(now);
            }
        }
        if !done.is_empty() {
            actions.push(Action::Send { to: Party::Node(node), message: Message::Placed(done) });
        }
        self.reclaim_lost(now, placed, actions);
    }

    /// Notes that a worker has failed to trace an atom: another node gets it, or the run fails after
    /// [`MAX_ATOM_FAILURES`].
    pub fn atom_failed(&mut self, now: Time, atom: Atom, placed: &[bool], actions: &mut Vec<Action>) {
        // A copy of the atom may have been traced by another node.
        if placed[atom as usize] {
            return;
        }
        let failures = self.failures.entry(atom).or_default();
        *failures += 1;
        if *failures >= MAX_ATOM_FAILURES {
            actions.push(Action::Fail(atom));
        } else {
            self.held[atom as usize] = None;
            self.pool.push(atom..atom + 1);
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
        if now > self.next_period {
            self.delays = [Duration::ZERO, self.delays[0]];
            self.next_period = now + self.beat * DELAY_MEMORY_BEATS;
        }
        let lease = self.lease();
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
        if now > self.next_lost {
            let lease = self.lease();
            self.pool.clear();
            self.next_lost = now + lease;
            for (atom, held) in (0..).zip(&self.held).filter(|(atom, _)| !placed[*atom as usize]) {
                match held.map(|held| held + lease) {
                    Some(lost) if lost >= now => self.next_lost = self.next_lost.min(lost),
                    _ => push_atom(&mut self.pool, atom),
                }
            }
        }
        self.hand_out_pool(now, placed, actions);
    }

    /// Returns the lease: four beats and twice the longest delay seen lately.
    fn lease(&self) -> Duration {
        self.beat * LEASE_BEATS + self.delays[0].max(self.delays[1]) * 2
    }

    /// Hands each idle node an equal part of the pool; the ring shares it further.
    fn hand_out_pool(&mut self, now: Time, placed: &[bool], actions: &mut Vec<Action>) {
        let mut idle = self.nodes.iter().filter(|entry| entry.idle && !entry.gone).count().max(1) as u32;
        for node in 0..self.nodes.len() {
            if self.pool.is_empty() {
                return;
            }
            let LedgerEntry { idle: true, gone: false, .. } = self.nodes[node] else { continue };
            let count = atoms_in(&self.pool).div_ceil(idle);
            idle = (idle - 1).max(1);
            let again = self.take_from_pool(now, count, placed);
            if !again.is_empty() {
                self.nodes[node].idle = false;
                actions.push(Action::Send { to: Party::Node(node as NodeId), message: Message::Again(again) });
            }
        }
    }

    /// Takes the first `count` atoms of the pool that are still missing and that no node has vouched for meanwhile.
    fn take_from_pool(&mut self, now: Time, count: u32, placed: &[bool]) -> Vec<Range<Atom>> {
        let (mut taken, mut rest, mut left) = (Vec::new(), Vec::new(), count);
        let lease = self.lease();
        for atom in std::mem::take(&mut self.pool).into_iter().flatten() {
            if placed[atom as usize] || self.held[atom as usize].is_some_and(|held| now.since(held) <= lease) {
                continue;
            }
            if left > 0 {
                left -= 1;
                self.held[atom as usize] = Some(now);
                push_atom(&mut taken, atom);
            } else {
                push_atom(&mut rest, atom);
            }
        }
        self.pool = rest;
        taken
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
