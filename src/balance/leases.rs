//! Leases on atoms: when a node last vouched for each atom, and which atoms are lost.
//!
//! One rule repairs every loss, of a machine, of a message or of a machine's memory: an atom that is missing from the
//! picture and that no node has vouched for during a lease goes to the pool, from which the parent hands it out again.
//! If an atom is traced twice after all, the first result counts.

use std::collections::BTreeMap;
use std::ops::Range;
use std::time::Duration;

use super::message::Action;
use super::strategy::LEASE_BEATS;
use crate::picture::{Atom, atoms_in, push_atom};
use crate::time::Time;

/// Failures to trace the same atom that make the run fail.
const MAX_ATOM_FAILURES: u8 = 3;

/// Beats for which a long delay is remembered at least; at most it is twice as many.
const DELAY_MEMORY_BEATS: u32 = 256;

/// The parent's knowledge of atoms that are not in the picture.
#[derive(Debug)]
pub(super) struct Leases {
    beat: Duration,
    /// By atom: when a node last vouched for it; `None` before it is handed out, or if a worker has failed to trace it.
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

impl Leases {
    /// Creates the leases on `atoms` atoms, none of which is handed out yet.
    pub fn new(beat: Duration, atoms: Atom) -> Self {
        Self {
            beat,
            held: vec![None; atoms as usize],
            pool: Vec::new(),
            next_lost: Time::ZERO,
            failures: BTreeMap::new(),
            delays: [Duration::ZERO; 2],
            next_period: Time::ZERO + beat * DELAY_MEMORY_BEATS,
        }
    }

    /// Returns the interval of the nodes' beats.
    pub fn beat(&self) -> Duration {
        self.beat
    }

    /// Returns the length of a lease: four beats and twice the longest delay seen lately.
    pub fn length(&self) -> Duration {
        self.beat * LEASE_BEATS + self.delays[0].max(self.delays[1]) * 2
    }

    /// Notes that these atoms are handed out at `now`.
    pub fn hand_out(&mut self, now: Time, atoms: &Range<Atom>) {
        self.held[atoms.start as usize..atoms.end as usize].fill(Some(now));
    }

    /// Notes that a node vouches for `holds` with a beat sent at `sent`. Returns the atoms among them that are in the
    /// picture already.
    pub fn vouch(&mut self, now: Time, sent: Time, holds: &[Range<Atom>], placed: &[bool]) -> Vec<Range<Atom>> {
        self.delays[0] = self.delays[0].max(now.since(sent));
        let mut done = Vec::new();
        for atom in holds.iter().cloned().flatten() {
            if placed[atom as usize] {
                push_atom(&mut done, atom);
            } else {
                self.held[atom as usize] = Some(now);
            }
        }
        done
    }

    /// Notes that a worker has failed to trace an atom: it goes to the pool, or the run fails after
    /// [`MAX_ATOM_FAILURES`]. Returns whether the pool has grown.
    pub fn atom_failed(&mut self, atom: Atom, placed: &[bool], actions: &mut Vec<Action>) -> bool {
        // A copy of the atom may have been traced by another node.
        if placed[atom as usize] {
            return false;
        }
        let failures = self.failures.entry(atom).or_default();
        *failures += 1;
        if *failures >= MAX_ATOM_FAILURES {
            actions.push(Action::Fail(atom));
            return false;
        }
        self.held[atom as usize] = None;
        self.pool.push(atom..atom + 1);
        true
    }

    /// Forgets delays that are long ago.
    pub fn forget_delays(&mut self, now: Time) {
        if now > self.next_period {
            self.delays = [Duration::ZERO, self.delays[0]];
            self.next_period = now + self.beat * DELAY_MEMORY_BEATS;
        }
    }

    /// Finds the atoms that no node has vouched for during a lease.
    pub fn find_lost(&mut self, now: Time, placed: &[bool]) {
        if now > self.next_lost {
            let lease = self.length();
            self.pool.clear();
            self.next_lost = now + lease;
            for (atom, held) in (0..).zip(&self.held).filter(|(atom, _)| !placed[*atom as usize]) {
                match held.map(|held| held + lease) {
                    Some(lost) if lost >= now => self.next_lost = self.next_lost.min(lost),
                    _ => push_atom(&mut self.pool, atom),
                }
            }
        }
    }

    /// Returns the number of atoms in the pool, as of the last search.
    pub fn pooled(&self) -> u32 {
        atoms_in(&self.pool)
    }

    /// Takes the first `count` atoms of the pool that are still missing and that no node has vouched for meanwhile.
    pub fn take_lost(&mut self, now: Time, count: u32, placed: &[bool]) -> Vec<Range<Atom>> {
        let (mut taken, mut rest, mut left) = (Vec::new(), Vec::new(), count);
        let lease = self.length();
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
}
