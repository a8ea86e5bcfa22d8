//! A node's atoms, from their arrival to the results. Nodes of all strategies feed their workers in this way.

use std::collections::VecDeque;
use std::ops::Range;
use std::time::Duration;

use super::message::{Action, Message, Party};
use super::queue::Queue;
use crate::picture::{Atom, push_atom};
use crate::time::Time;

/// Atoms in the worker's pipe while there are enough, including the one being traced: two, so that neither the worker
/// nor the node waits for the other (§8).
pub const PIPE_ATOMS: u32 = 2;

/// The atoms of a node: those in the queue, those in the pipe, and those traced but not sent.
#[derive(Debug)]
pub(super) struct Work {
    batch: Option<Duration>,
    queue: Queue,
    pipe: VecDeque<Atom>,
    traced: u32,
    unsent: Vec<Range<Atom>>,
    /// When the unsent results have waited long enough.
    due: Option<Time>,
}

impl Work {
    /// Creates a node's work without atoms. Results leave after `batch` ([`Rules::batch`](super::Rules::batch)).
    pub fn new(batch: Option<Duration>) -> Self {
        Self { batch, queue: Queue::default(), pipe: VecDeque::new(), traced: 0, unsent: Vec::new(), due: None }
    }

    /// Returns the number of atoms in the queue. Those in the pipe do not count: they belong to the worker and never
    /// leave it untraced.
    pub fn waiting(&self) -> u32 {
        self.queue.len()
    }

    /// Returns the atoms in the worker's pipe; the first one is in hand.
    pub fn pipe(&self) -> &VecDeque<Atom> {
        &self.pipe
    }

    /// Returns the number of atoms traced since the start.
    pub fn traced(&self) -> u32 {
        self.traced
    }

    /// Returns whether queue and pipe are empty.
    pub fn is_idle(&self) -> bool {
        self.pipe.is_empty()
    }

    /// Returns when the unsent results are due, if that is before the last atom is traced.
    pub fn due(&self) -> Option<Time> {
        self.due
    }

    /// Returns all atoms of the node: those traced but not sent, those in the pipe, and those in the queue.
    pub fn held(&self) -> Vec<Range<Atom>> {
        let mut held = self.unsent.clone();
        self.pipe.iter().for_each(|&atom| push_atom(&mut held, atom));
        for range in self.queue.ranges() {
            match held.last_mut() {
                Some(last) if last.end == range.start => last.end = range.end,
                _ => held.push(range.clone()),
            }
        }
        held
    }

    /// Queues atoms and fills the pipe.
    pub fn add(&mut self, ranges: impl IntoIterator<Item = Range<Atom>>, actions: &mut Vec<Action>) {
        ranges.into_iter().for_each(|range| self.queue.push(range));
        self.fill_pipe(actions);
    }

    /// Queues the atoms among these that the node does not hold, and fills the pipe.
    pub fn add_new(&mut self, ranges: impl IntoIterator<Item = Range<Atom>>, actions: &mut Vec<Action>) {
        for range in ranges {
            self.queue.remove(&range);
            self.queue.push(range);
        }
        self.pipe.iter().for_each(|&atom| self.queue.remove(&(atom..atom + 1)));
        self.unsent.iter().for_each(|range| self.queue.remove(range));
        self.fill_pipe(actions);
    }

    /// Removes and returns the last `count` atoms of the queue, to be given away.
    pub fn give(&mut self, count: u32) -> Vec<Range<Atom>> {
        self.queue.split_off(count)
    }

    /// Removes these atoms from the queue, as far as they are there.
    pub fn forget(&mut self, atoms: &Range<Atom>) {
        self.queue.remove(atoms);
    }

    /// Moves a traced atom from the pipe to the unsent results, and refills the pipe (§7). Sets the timer for the
    /// results, except after the last atom: the node sends those results at once.
    pub fn atom_done(&mut self, now: Time, atom: Atom, actions: &mut Vec<Action>) {
        self.leave_pipe(atom, actions);
        self.traced += 1;
        if let Some(batch) = self.batch
            && self.unsent.is_empty()
            && !self.is_idle()
        {
            self.due = Some(now + batch);
            actions.push(Action::SetTimer(now + batch));
        }
        push_atom(&mut self.unsent, atom);
    }

    /// Removes an atom that the worker has failed to trace from the pipe, and refills the pipe.
    pub fn atom_failed(&mut self, atom: Atom, actions: &mut Vec<Action>) {
        self.leave_pipe(atom, actions);
    }

    /// Sends the unsent results to the parent, if there are any.
    pub fn send_results(&mut self, actions: &mut Vec<Action>) {
        self.due = None;
        if !self.unsent.is_empty() {
            let message = Message::Results(std::mem::take(&mut self.unsent));
            actions.push(Action::Send { to: Party::Parent, message });
        }
    }

    fn leave_pipe(&mut self, atom: Atom, actions: &mut Vec<Action>) {
        let first = self.pipe.pop_front();
        assert!(first == Some(atom), "atom {atom} was not the first in the pipe");
        self.fill_pipe(actions);
    }

    fn fill_pipe(&mut self, actions: &mut Vec<Action>) {
        while self.pipe.len() < PIPE_ATOMS as usize
            && let Some(atom) = self.queue.pop()
        {
            self.pipe.push_back(atom);
            actions.push(Action::Trace(atom));
        }
    }
}
