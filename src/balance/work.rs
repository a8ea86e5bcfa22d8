//! A node's atoms, from their arrival to the results: what every strategy's node does with its worker.

use std::ops::Range;
use std::time::Duration;

use super::message::{Action, Message, Party};
use super::queue::Queue;
use crate::picture::{Atom, push_atom};
use crate::time::Time;

/// How many atoms the worker's pipe holds while there are any, the one being traced included: two, so that neither
/// worker nor node waits for the other (§8).
const PIPE: u32 = 2;

/// The atoms of a node: those that wait, those in the pipe, and those traced but not yet sent.
#[derive(Debug)]
pub(super) struct Work {
    batch: Option<Duration>,
    queue: Queue,
    in_pipe: u32,
    traced: u32,
    unsent: Vec<Range<Atom>>,
}

impl Work {
    /// No atoms yet; traced ones leave after [`Rules::batch`](super::Rules::batch).
    pub fn new(batch: Option<Duration>) -> Self {
        Self { batch, queue: Queue::default(), in_pipe: 0, traced: 0, unsent: Vec::new() }
    }

    /// How many atoms wait in the queue; those in the pipe are the worker's and never leave it untraced.
    pub fn waiting(&self) -> u32 {
        self.queue.len()
    }

    /// How many atoms the worker has traced since the start.
    pub fn traced(&self) -> u32 {
        self.traced
    }

    /// Whether queue and pipe are empty.
    pub fn is_idle(&self) -> bool {
        self.in_pipe == 0
    }

    /// Queues atoms and fills the pipe.
    pub fn add(&mut self, ranges: impl IntoIterator<Item = Range<Atom>>, actions: &mut Vec<Action>) {
        ranges.into_iter().for_each(|range| self.queue.push(range));
        self.fill_pipe(actions);
    }

    /// Takes the last `count` atoms off the queue, to be given away.
    pub fn give(&mut self, count: u32) -> Vec<Range<Atom>> {
        self.queue.split_off(count)
    }

    /// Counts a traced atom, keeps it for the parent, and puts one more into the pipe (§7). The results will leave
    /// soon, unless it was the last atom: then its node sends them at once.
    pub fn atom_done(&mut self, now: Time, atom: Atom, actions: &mut Vec<Action>) {
        assert!(self.in_pipe > 0, "atom {atom} was not in the pipe");
        self.in_pipe -= 1;
        self.traced += 1;
        self.fill_pipe(actions);
        if let Some(batch) = self.batch
            && self.unsent.is_empty()
            && !self.is_idle()
        {
            actions.push(Action::SetTimer(now + batch));
        }
        push_atom(&mut self.unsent, atom);
    }

    /// Sends the parent what is traced and unsent, if there is any.
    pub fn send_results(&mut self, actions: &mut Vec<Action>) {
        if !self.unsent.is_empty() {
            let message = Message::Results(std::mem::take(&mut self.unsent));
            actions.push(Action::Send { to: Party::Parent, message });
        }
    }

    fn fill_pipe(&mut self, actions: &mut Vec<Action>) {
        while self.in_pipe < PIPE
            && let Some(atom) = self.queue.pop()
        {
            self.in_pipe += 1;
            actions.push(Action::Trace(atom));
        }
    }
}
