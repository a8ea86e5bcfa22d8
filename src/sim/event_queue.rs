//! The queue of future events: by time, and at the same time in the order in which they were scheduled.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use std::time::Duration;

use crate::balance::{Message, NodeId, Party};
use crate::scenario::Command;
use crate::time::Time;

/// An event of a run in virtual time.
#[derive(Debug)]
pub(super) enum SimEvent {
    /// The run starts.
    Started,
    /// A message arrives; the parent may be busy.
    Arrival { to: Party, mail: InTransit },
    /// The parent has handled a message.
    Handled(InTransit),
    /// The parent has sampled the cost of the picture: these are the costs by stretch.
    Estimated(Vec<Duration>),
    /// A worker finishes its atom, unless the atom has a newer due time: only the latest `version` counts.
    AtomDone { node: NodeId, version: u32 },
    /// A party's timer fires, unless it was set again.
    Timer(Party),
    /// The message with this id would arrive now, but is lost.
    Lost(u64),
    /// A command of the script is executed.
    Command(Command),
}

/// A message in transit.
#[derive(Debug)]
pub(super) struct InTransit {
    pub id: u64,
    pub from: Party,
    pub message: Message,
}

/// The future events of a run.
#[derive(Debug, Default)]
pub(super) struct EventQueue {
    events: BinaryHeap<Reverse<Scheduled>>,
    /// Number of events scheduled so far.
    scheduled: u64,
}

#[derive(Debug)]
struct Scheduled {
    at: Time,
    sequence: u64,
    event: SimEvent,
}

impl EventQueue {
    /// Schedules an event.
    pub fn schedule(&mut self, at: Time, event: SimEvent) {
        self.events.push(Reverse(Scheduled { at, sequence: self.scheduled, event }));
        self.scheduled += 1;
    }

    /// Returns the time of the next event.
    pub fn next(&self) -> Option<Time> {
        self.events.peek().map(|Reverse(scheduled)| scheduled.at)
    }

    /// Returns whether an event matches `filter`.
    pub fn any(&self, filter: impl Fn(&SimEvent) -> bool) -> bool {
        self.events.iter().any(|Reverse(scheduled)| filter(&scheduled.event))
    }

    /// Moves the events that match `filter` to the times that `at` returns for theirs; they keep their order.
    pub fn reschedule(&mut self, at: impl Fn(Time) -> Time, filter: impl Fn(&SimEvent) -> bool) {
        let (mut moved, others): (Vec<_>, Vec<_>) =
            self.events.drain().map(|Reverse(scheduled)| scheduled).partition(|scheduled| filter(&scheduled.event));
        self.events = others.into_iter().map(Reverse).collect();
        moved.sort_unstable();
        moved.into_iter().for_each(|scheduled| self.schedule(at(scheduled.at), scheduled.event));
    }

    /// Removes and returns the next event, if its time is not after `horizon`.
    pub fn pop(&mut self, horizon: Time) -> Option<(Time, SimEvent)> {
        self.next().filter(|&at| at <= horizon)?;
        self.events.pop().map(|Reverse(scheduled)| (scheduled.at, scheduled.event))
    }
}

impl PartialEq for Scheduled {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Scheduled {}

impl PartialOrd for Scheduled {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Scheduled {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.at, self.sequence).cmp(&(other.at, other.sequence))
    }
}
