//! A node's atoms, from their arrival to the results: what every strategy's node does with its worker.

use std::collections::VecDeque;
use std::ops::Range;
use std::time::Duration;

use super::message::{Action, Message, Party};
use super::queue::Queue;
use crate::picture::{Atom, push_atom};
use crate::time::Time;

/// Atoms in the worker's pipe while there are enough, including the one being traced: two, so that neither the worker nor
/// the node waits for the other (§8).
pub const PIPE_ATOMS: u32 = 2;

/// The atoms of a node: those that wait, those in the pipe, and those traced but not yet sent.
#[derive(Debug)]
pub(super) struct Work {
    batch: Option<Duration>,
    queue: Queue,
    pipe: VecDeque<Atom>,
    traced: u32,
    unsent: Vec<Range<Atom>>,
    /// When what is unsent has waited long enough.
    due: Option<Time>,
}

impl Work {
    /// No atoms yet; traced ones leave after [`Rules::batch`](super::Rules::batch).
    pub fn new(batch: Option<Duration>) -> Self {
        Self { batch, queue: Queue::default(), pipe: VecDeque::new(), traced: 0, unsent: Vec::new(), due: None }
    }

    /// How many atoms wait in the queue; those in the pipe are the worker's and never leave it untraced.
    pub fn waiting(&self) -> u32 {
        self.queue.len()
    }

    /// The atoms in the worker's pipe, the one in hand first.
    pub fn pipe(&self) -> &VecDeque<Atom> {
        &self.pipe
    }

    /// How many atoms the worker has traced since the start.
    pub fn traced(&self) -> u32 {
        self.traced
    }

    /// Whether queue and pipe are empty.
    pub fn is_idle(&self) -> bool {
        self.pipe.is_empty()
    }

    /// When results are to be sent, if they are to before the last atom is traced.
    pub fn due(&self) -> Option<Time> {
        self.due
    }

    /// All atoms of the node: those that wait, those in the pipe, and those traced but not sent.
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

    /// Queues those of these atoms that the node does not have, and fills the pipe.
    pub fn add_new(&mut self, ranges: impl IntoIterator<Item = Range<Atom>>, actions: &mut Vec<Action>) {
        for range in ranges {
            self.queue.remove(&range);
            self.queue.push(range);
        }
        self.pipe.iter().for_each(|&atom| self.queue.remove(&(atom..atom + 1)));
        self.unsent.iter().for_each(|range| self.queue.remove(range));
        self.fill_pipe(actions);
    }

    /// Takes the last `count` atoms off the queue, to be given away.
    pub fn give(&mut self, count: u32) -> Vec<Range<Atom>> {
        self.queue.split_off(count)
    }

    /// Takes these atoms off the queue, if they are there.
    pub fn forget(&mut self, atoms: &Range<Atom>) {
        self.queue.remove(atoms);
    }

    /// Counts a traced atom, keeps it for the parent, and puts one more into the pipe (§7). The results will leave
    /// soon, unless it was the last atom: then its node sends them at once.
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

    /// The worker could not trace an atom: it goes, and one more comes into the pipe.
    pub fn atom_failed(&mut self, atom: Atom, actions: &mut Vec<Action>) {
        self.leave_pipe(atom, actions);
    }

    /// Sends the parent what is traced and unsent, if there is any.
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
