//! What is going to happen in a run, in the order of time and, at one time, in the order in which it was planned.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use std::time::Duration;

use crate::balance::{Message, NodeId, Party};
use crate::scenario::Command;
use crate::time::Time;

/// What happens.
#[derive(Debug)]
pub(super) enum SimEvent {
    /// The run begins.
    Started,
    /// A message arrives; its receiver may be busy.
    Arrival { to: Party, mail: InTransit },
    /// The parent has handled a message.
    Handled(InTransit),
    /// The parent has sampled what the picture costs.
    Estimated(Vec<Duration>),
    /// A worker is done with its atom, unless it has been given another due time since: only the latest plan holds.
    AtomDone { node: NodeId, plan: u32 },
    /// A party's timer, unless it has been set anew since.
    Timer(Party),
    /// A message would have arrived, had it not been lost.
    Lost(u64),
    /// Something is done to the run.
    Command(Command),
}

/// A message on its way.
#[derive(Debug)]
pub(super) struct InTransit {
    pub id: u64,
    pub from: Party,
    pub message: Message,
}

/// All that is planned.
#[derive(Debug, Default)]
pub(super) struct EventQueue {
    events: BinaryHeap<Reverse<Planned>>,
    planned: u64,
}

#[derive(Debug)]
struct Planned {
    at: Time,
    sequence: u64,
    happening: SimEvent,
}

impl EventQueue {
    /// Plans something.
    pub fn plan(&mut self, at: Time, happening: SimEvent) {
        self.events.push(Reverse(Planned { at, sequence: self.planned, happening }));
        self.planned += 1;
    }

    /// When the next thing happens.
    pub fn next(&self) -> Option<Time> {
        self.events.peek().map(|Reverse(planned)| planned.at)
    }

    /// Whether anything of this kind is planned.
    pub fn has(&self, kind: impl Fn(&SimEvent) -> bool) -> bool {
        self.events.iter().any(|Reverse(planned)| kind(&planned.happening))
    }

    /// Plans what is of this kind for another time, in the order in which it was to happen.
    pub fn move_to(&mut self, at: impl Fn(Time) -> Time, kind: impl Fn(&SimEvent) -> bool) {
        let (mut moved, others): (Vec<_>, Vec<_>) =
            self.events.drain().map(|Reverse(planned)| planned).partition(|planned| kind(&planned.happening));
        self.events = others.into_iter().map(Reverse).collect();
        moved.sort_unstable();
        moved.into_iter().for_each(|planned| self.plan(at(planned.at), planned.happening));
    }

    /// Takes out what happens next, if that is until `horizon`.
    pub fn pop(&mut self, horizon: Time) -> Option<(Time, SimEvent)> {
        self.next().filter(|&at| at <= horizon)?;
        self.events.pop().map(|Reverse(planned)| (planned.at, planned.happening))
    }
}

impl PartialEq for Planned {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Planned {}

impl PartialOrd for Planned {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Planned {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.at, self.sequence).cmp(&(other.at, other.sequence))
    }
}
