//! The parent's ledger, in the ring that adapts: who was heard of when, and when each atom was last known to be with somebody.
//!
//! One rule mends every loss, of a machine, of a message or of a machine's memory: an atom that is missing from the picture, and
//! that nobody has vouched for during a lease, goes back to the pool, and whoever is idle gets some of it. Should it be traced
//! twice after all, the first result counts.

use std::collections::BTreeMap;
use std::ops::Range;
use std::time::Duration;

use super::message::{Action, Message, NodeId, Party};
use super::strategy::LEASE_BEATS;
use crate::picture::{Atom, atoms_in, push_atom};
use crate::time::Time;

/// An atom that so many workers failed to trace makes the run fail.
const MOST_FAILURES: u8 = 3;

/// For so many beats a long delay is remembered, and up to twice as many.
const MEMORY: u32 = 256;

/// What the parent knows of nodes and atoms.
#[derive(Debug)]
pub(super) struct Ledger {
    beat: Duration,
    nodes: Vec<LedgerEntry>,
    /// By atom: when somebody was last known to have it; `None` if nobody is known to.
    held: Vec<Option<Time>>,
    /// What nobody has had for a lease, as far as was looked.
    pool: Vec<Range<Atom>>,
    /// No other atom can be lost before this time.
    next_lost: Time,
    failures: BTreeMap<Atom, u8>,
    /// How long messages have taken at most, in this stretch of time and in the one before: one that was held up for long does
    /// not count for ever.
    delays: [Duration; 2],
    /// When the next stretch begins.
    forgets: Time,
}

#[derive(Clone, Debug)]
struct LedgerEntry {
    /// `None` until the node's first beat.
    heard: Option<Time>,
    idle: bool,
    gone: bool,
    /// When one that is gone was asked back last.
    asked: Time,
    /// One that was never there is not asked back.
    spare: bool,
}

impl Ledger {
    /// A ledger of so many nodes, of which the last are spares that are not there yet, and so many atoms, all of which are with
    /// their nodes at the start.
    pub fn new(beat: Duration, (nodes, spares): (NodeId, NodeId), atoms: Atom) -> Self {
        let entry = |node| {
            let spare = node + spares >= nodes;
            LedgerEntry { heard: None, idle: false, gone: spare, asked: Time::ZERO, spare }
        };
        Self {
            beat,
            nodes: (0..nodes).map(entry).collect(),
            held: vec![None; atoms as usize],
            pool: Vec::new(),
            next_lost: Time::ZERO,
            failures: BTreeMap::new(),
            delays: [Duration::ZERO; 2],
            forgets: Time::ZERO + beat * MEMORY,
        }
    }

    /// The parent looks at its ledger at every beat.
    pub fn next_look(&self, now: Time) -> Time {
        now + self.beat
    }

    /// The bands leave now.
    pub fn start(&mut self, now: Time, actions: &mut Vec<Action>) {
        self.held.fill(Some(now));
        if self.nodes.iter().any(|entry| entry.spare) {
            self.tell_who_is_gone(actions);
        }
    }

    /// A node has been heard of; if it was gone, it is back, and all are told.
    pub fn hear(&mut self, now: Time, node: NodeId, actions: &mut Vec<Action>) {
        let entry = &mut self.nodes[usize::from(node)];
        entry.heard = Some(now);
        entry.spare = false;
        if std::mem::take(&mut entry.gone) {
            self.tell_who_is_gone(actions);
        }
    }

    /// A node says what it has and vouches for.
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
        self.look_for_lost(now, placed, actions);
    }

    /// A worker has failed to trace an atom: it is tried elsewhere, unless it has failed too often.
    pub fn failed(&mut self, now: Time, atom: Atom, placed: &[bool], actions: &mut Vec<Action>) {
        // A copy of it may have been traced all the same.
        if placed[atom as usize] {
            return;
        }
        let failures = self.failures.entry(atom).or_default();
        *failures += 1;
        if *failures >= MOST_FAILURES {
            actions.push(Action::Fail(atom));
        } else {
            self.held[atom as usize] = None;
            self.pool.push(atom..atom + 1);
            self.give_out(now, placed, actions);
        }
    }

    /// A machine has begun anew, or may have, and knows nothing.
    pub fn ask_in(&mut self, node: NodeId, actions: &mut Vec<Action>) {
        let to = Party::Node(node);
        actions.push(Action::Send { to, message: Message::Band(0..0) });
        let gone = self.gone();
        if !gone.is_empty() {
            actions.push(Action::Send { to, message: Message::Gone(gone) });
        }
    }

    /// Looks who has been silent for too long, and which atoms nobody has.
    pub fn look(&mut self, now: Time, placed: &[bool], actions: &mut Vec<Action>) {
        if now > self.forgets {
            self.delays = [Duration::ZERO, self.delays[0]];
            self.forgets = now + self.beat * MEMORY;
        }
        let lease = self.lease();
        let mut changed = false;
        for entry in self.nodes.iter_mut().filter(|entry| !entry.gone) {
            // Until its first beat the scene may be on its way to it.
            let patience = if entry.heard.is_some() { lease } else { lease * LEASE_BEATS };
            if now.since(entry.heard.unwrap_or_default()) > patience {
                (entry.gone, entry.asked, changed) = (true, now, true);
            }
        }
        if changed {
            self.tell_who_is_gone(actions);
        }
        // What made them gone may be over, and whoever begins anew may not have been heard.
        for node in 0..self.nodes.len() {
            let entry = &mut self.nodes[node];
            if entry.gone && !entry.spare && now.since(entry.asked) > lease {
                entry.asked = now;
                self.ask_in(node as NodeId, actions);
            }
        }
        self.look_for_lost(now, placed, actions);
    }

    /// If somebody is idle, looks for atoms that nobody has, and gives them out.
    fn look_for_lost(&mut self, now: Time, placed: &[bool], actions: &mut Vec<Action>) {
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
        self.give_out(now, placed, actions);
    }

    fn lease(&self) -> Duration {
        self.beat * LEASE_BEATS + self.delays[0].max(self.delays[1]) * 2
    }

    /// Gives each idle node an equal part of the pool; the ring shares it on.
    fn give_out(&mut self, now: Time, placed: &[bool], actions: &mut Vec<Action>) {
        let mut idle = self.nodes.iter().filter(|entry| entry.idle && !entry.gone).count().max(1) as u32;
        for node in 0..self.nodes.len() {
            if self.pool.is_empty() {
                return;
            }
            let LedgerEntry { idle: true, gone: false, .. } = self.nodes[node] else { continue };
            let count = atoms_in(&self.pool).div_ceil(idle);
            idle = (idle - 1).max(1);
            let again = self.take(now, count, placed);
            if !again.is_empty() {
                self.nodes[node].idle = false;
                actions.push(Action::Send { to: Party::Node(node as NodeId), message: Message::Again(again) });
            }
        }
    }

    /// The first `count` atoms of the pool that are missing still.
    fn take(&mut self, now: Time, count: u32, placed: &[bool]) -> Vec<Range<Atom>> {
        let (mut taken, mut rest, mut left) = (Vec::new(), Vec::new(), count);
        let lease = self.lease();
        for atom in std::mem::take(&mut self.pool).into_iter().flatten() {
            // Somebody may have got it meanwhile, or vouched for it.
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

    fn gone(&self) -> Vec<NodeId> {
        (0..).zip(&self.nodes).filter(|(_, entry)| entry.gone).map(|(node, _)| node).collect()
    }

    fn tell_who_is_gone(&self, actions: &mut Vec<Action>) {
        tell_who_is_gone(self.nodes.len() as NodeId, &self.gone(), actions);
    }
}

/// Tells those who are there whom offers are to pass over.
pub(super) fn tell_who_is_gone(nodes: NodeId, gone: &[NodeId], actions: &mut Vec<Action>) {
    let there = (0..nodes).filter(|node| !gone.contains(node));
    actions.extend(there.map(|node| Action::Send { to: Party::Node(node), message: Message::Gone(gone.to_vec()) }));
}
