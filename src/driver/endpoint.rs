//! A party's end of everything: the messages that it sends and gets, its time, and its records.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};
use std::mem;
use std::sync::Arc;
use std::time::Duration;

use crossbeam_channel::{Receiver, Sender};

use super::Update;
use super::shared::{Content, Parcel, Shared, WorkerOrder};
use crate::balance::{Condition, Event, Message, Party, Transition};
use crate::picture::Colour;
use crate::record::{Record, RecordKind};
use crate::runlog::Header;
use crate::scenario::Command;
use crate::sim::Link;
use crate::time::Time;

/// How long records (and placed pixels) wait at most before they leave their thread.
pub(super) const FLUSH: Duration = Duration::from_millis(15);

/// What a message that goes no way takes: every cause lies before its effects.
const LEAST: Duration = Duration::from_nanos(1);

/// The run was stopped from outside, or another party's thread has panicked; or it is over, and the party cannot hear of it.
#[derive(Debug)]
pub(super) struct Stopped;

/// What happens to a party next.
pub(super) enum Incoming {
    /// To be handed to the protocol, with the pixels of results or of the traced atom.
    Event(Event, Vec<Colour>),
    /// What the user does to its machine.
    Command(Command),
    /// Something for a worker that has a thread of its own.
    WorkerOrder(WorkerOrder),
}

/// One party's port; it lives on the party's thread.
pub(super) struct Endpoint {
    pub shared: Arc<Shared>,
    me: Party,
    inbox: Receiver<Parcel>,
    /// What has come but is not due yet, the earliest on top.
    held: BinaryHeap<Reverse<Parcel>>,
    /// How the party's machine is.
    condition: Condition,
    /// Messages that have arrived while the machine hangs.
    waiting: VecDeque<Parcel>,
    /// By party, as [`Shared::index`] has them.
    links: Vec<Link>,
    timer: Option<Time>,
    handling: Duration,
    /// Whether what is handled late is dated back to when it was due.
    backdates: bool,
    time: Time,
    updates: Sender<Update>,
    records: Vec<Record>,
    flushed: Time,
}

impl Endpoint {
    /// The port of `me`, whose messages come out of `inbox`.
    pub fn new(
        me: Party,
        header: &Header,
        shared: &Arc<Shared>,
        inbox: Receiver<Parcel>,
        updates: Sender<Update>,
    ) -> Self {
        Self {
            shared: Arc::clone(shared),
            me,
            inbox,
            held: BinaryHeap::new(),
            condition: match me {
                Party::Node(node) if shared.can_fail && header.is_spare(node) => Condition::Off,
                _ => Condition::Well,
            },
            waiting: VecDeque::new(),
            links: vec![Link::default(); shared.parties()],
            timer: None,
            handling: if me == Party::Parent { header.handling } else { Duration::ZERO },
            // Emulated machines make up for threads that wake late. Where all are this computer itself, late is late.
            backdates: !header.is_full_speed(),
            time: Time::ZERO,
            updates,
            records: Vec::new(),
            flushed: Time::ZERO,
        }
    }

    /// The party's own time, at which it acts. It never goes back.
    pub fn time(&self) -> Time {
        self.time
    }

    /// Moves the party's time on to `to`, if that is later.
    pub fn advance(&mut self, to: Time) {
        self.time = self.time.max(to);
    }

    /// Adds a record of what happens at the party's time; returns its index, good until the next flush.
    pub fn record(&mut self, what: RecordKind) -> usize {
        self.records.push(Record { at: self.time, what });
        self.records.len() - 1
    }

    /// A record that has not been flushed yet.
    pub fn recorded(&mut self, index: usize) -> &mut RecordKind {
        &mut self.records[index].what
    }

    /// Sends a message at the party's time, with the pixels of the atoms in it.
    pub fn send(&mut self, to: Party, message: Message, pixels: Vec<Colour>) {
        let bytes = self.shared.bytes(&message);
        let receiver = self.shared.index(to);
        let arrives = self.shared.arrival(&mut self.links[receiver], self.time, bytes);
        let arrives = self.shared.losses.arrival(self.me, to, arrives);
        let is_lost = self.shared.losses.is_cut(self.me, to);
        let sent = || Content::Message { from: self.me, message: message.clone(), pixels };
        let content = if is_lost { Content::Lost } else { sent() };
        let id = self.shared.deliver(receiver, arrives, content);
        self.record(RecordKind::Sent { id, from: self.me, to, message, bytes, arrives });
    }

    /// Notes down a message that went no way, since the party has itself taken from `from` what it says.
    pub fn take(&mut self, from: Party, message: Message) {
        let (id, bytes, arrives) = (self.shared.new_id(), self.shared.bytes(&message), self.time + LEAST);
        self.record(RecordKind::Sent { id, from, to: self.me, message, bytes, arrives });
        self.advance(arrives);
        self.record(RecordKind::Received { id, by: self.me });
    }

    /// Makes [`Endpoint::next`] return [`Event::Timer`] at `at`; a later call replaces an earlier one.
    pub fn set_timer(&mut self, at: Time) {
        self.timer = Some(at);
    }

    /// How the party's machine is.
    pub fn condition(&self) -> Condition {
        self.condition
    }

    /// Sets the condition of the party's machine; records it and the messages that are lost with it. Returns the effect on
    /// the machine; `None` if nothing changes, as always once the run is over.
    pub fn set_condition(&mut self, condition: Condition) -> Option<Transition> {
        let Party::Node(node) = self.me else { return None };
        let transition = self.condition.transition(condition)?;
        if !self.shared.losses.cut_off(node, condition == Condition::CutOff) {
            return None;
        }
        self.condition = condition;
        self.record(RecordKind::Condition { node, condition });
        if transition == Transition::MemoryLost {
            self.timer = None;
            mem::take(&mut self.waiting)
                .into_iter()
                .for_each(|Parcel { id, .. }| _ = self.record(RecordKind::Lost { id }));
        }
        Some(transition)
    }

    /// Notes down that what `from` sends to this party is held up.
    pub fn delayed(&mut self, from: Party) {
        let (to, soon) = (self.me, self.time + LEAST);
        let until = self.shared.losses.arrival(from, to, soon);
        self.record(RecordKind::Delayed { from, to, until });
    }

    /// What happens next, if it happens until `horizon`; the party's time is then when it does.
    pub fn next(&mut self, horizon: Time) -> Option<Incoming> {
        while let Ok(parcel) = self.inbox.try_recv() {
            self.hold(parcel);
        }
        if self.condition != Condition::Hung
            && let Some(parcel) = self.waiting.pop_front()
        {
            return self.open(parcel);
        }
        loop {
            let (timer, handled) = (self.timer(), self.handled());
            if let Some(timer) = timer.filter(|&timer| timer <= horizon && handled.is_none_or(|other| timer <= other)) {
                self.timer = None;
                self.advance(timer);
                return Some(Incoming::Event(Event::Timer, Vec::new()));
            }
            let at = handled.filter(|&at| at <= horizon)?;
            let Reverse(parcel) = self.held.pop()?;
            let due = self.due(&parcel);
            if due > parcel.due {
                self.held.push(Reverse(Parcel { due, ..parcel }));
                continue;
            }
            self.advance(if self.backdates { at } else { horizon });
            match &parcel.content {
                content if self.is_lost(content) => _ = self.record(RecordKind::Lost { id: parcel.id }),
                Content::Message { .. } if self.condition == Condition::Hung => self.waiting.push_back(parcel),
                _ => return self.open(parcel),
            }
        }
    }

    /// To be called before every step: blocks while the run is paused, flushes when it is time, and fails if the run
    /// was stopped. Returns the clock's time.
    pub fn step(&mut self, flush: impl FnOnce(&mut Self)) -> Result<Time, Stopped> {
        let paused = self.shared.clock.is_paused();
        let mut now = self.shared.clock.now();
        if paused || now.since(self.flushed) >= FLUSH {
            self.flushed = now;
            flush(self);
        }
        if paused {
            self.shared.clock.wait_until_resumed();
            now = self.shared.clock.now();
        }
        if self.is_stopped() { Err(Stopped) } else { Ok(now) }
    }

    /// Blocks until something comes in or is due, or until `until`, or until it is time to flush.
    pub fn wait(&mut self, until: Option<Time>) {
        // What was sent to say so may be out of the inbox already.
        if self.is_stopped() {
            return;
        }
        let flush = (!self.records.is_empty()).then_some(self.flushed + FLUSH);
        let wake = [until, self.timer(), self.handled(), flush].into_iter().flatten().min();
        let came = match wake {
            Some(wake) => self.inbox.recv_timeout(wake.since(self.shared.clock.now())).ok(),
            // Every thread of the run holds senders of all inboxes, so that none is ever disconnected.
            None => self.inbox.recv().ok(),
        };
        came.into_iter().for_each(|parcel| self.hold(parcel));
    }

    /// Hands the records to whoever started the run.
    pub fn flush(&mut self) {
        if !self.records.is_empty() {
            let records = mem::take(&mut self.records);
            self.update(Update::Records(records));
        }
    }

    /// Tells whoever started the run; that nobody listens any more does no harm.
    pub fn update(&self, update: Update) {
        let _ = self.updates.send(update);
    }

    fn hold(&mut self, parcel: Parcel) {
        if !matches!(parcel.content, Content::Wake) {
            self.held.push(Reverse(parcel));
        }
    }

    /// When something arrives: a message may have been held up since it was sent.
    fn due(&self, parcel: &Parcel) -> Time {
        match parcel.content {
            Content::Message { from, .. } => self.shared.losses.arrival(from, self.me, parcel.due),
            _ => parcel.due,
        }
    }

    /// Whether what arrives now is lost, or would arrive had it not been lost on its way.
    fn is_lost(&self, content: &Content) -> bool {
        match content {
            Content::Lost => true,
            Content::Message { from, .. } => {
                self.condition == Condition::Off || self.shared.losses.is_cut(*from, self.me)
            }
            _ => false,
        }
    }

    fn open(&mut self, Parcel { id, content, .. }: Parcel) -> Option<Incoming> {
        match content {
            Content::Message { from, message, pixels } => {
                self.record(RecordKind::Received { id, by: self.me });
                Some(Incoming::Event(Event::Message { from, message }, pixels))
            }
            Content::Worked { event, pixels } => Some(Incoming::Event(event, pixels)),
            Content::Command(command) => Some(Incoming::Command(command)),
            Content::WorkerOrder(order) => Some(Incoming::WorkerOrder(order)),
            Content::Lost | Content::Wake => None,
        }
    }

    /// Whether the party is to end: the run was stopped, or is over and the party cannot hear of it.
    fn is_stopped(&self) -> bool {
        let is_deaf =
            || !self.condition.is_running() || self.shared.losses.is_cut(Party::Parent, self.me);
        self.shared.is_stopped() || self.shared.losses.is_over() && is_deaf()
    }

    /// A machine that hangs looks at its timer later.
    fn timer(&self) -> Option<Time> {
        self.timer.filter(|_| self.condition != Condition::Hung)
    }

    /// When the party will have handled the next parcel held: it begins with a message as soon as that is due and the
    /// one before is done with, and takes its handling time. A command takes none.
    fn handled(&self) -> Option<Time> {
        let Reverse(next) = self.held.peek()?;
        let takes_time = !self.handling.is_zero() && matches!(next.content, Content::Message { .. });
        Some(if takes_time { next.due.max(self.time) + self.handling } else { next.due })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::runlog::LinkSettings;
    use crate::runlog::examples;

    const MS: Duration = Duration::from_millis(1);

    /// Of two emulated nodes.
    fn header(handling: Duration, latency: Duration) -> Header {
        Header {
            handling,
            link: LinkSettings { latency, bandwidth: None, shared: false },
            ..examples::header(&[0.5, 0.5])
        }
    }

    /// Sends results (empty ones) from each node to the parent, the second node's 1 ms before the first's; then what
    /// the parent gets until each of `horizons`: from whom, and when (ms, rounded down).
    fn results(header: &Header, horizons: &[u32]) -> Vec<Option<(Party, u64)>> {
        let (shared, mut inboxes) = Shared::new(header);
        let (updates, _listener) = crossbeam_channel::unbounded();
        let port = |me, inbox| Endpoint::new(me, header, &shared, inbox, updates.clone());
        let mut parent = port(Party::Parent, inboxes.parent);
        let mut second = port(Party::Node(1), inboxes.nodes.remove(1));
        let mut first = port(Party::Node(0), inboxes.nodes.remove(0));
        for (port, at) in [(&mut first, 4), (&mut second, 3)] {
            port.advance(Time::ZERO + at * MS);
            port.send(Party::Parent, Message::Results(Vec::new()), Vec::new());
        }
        let mut next = |horizon: u32| match parent.next(Time::ZERO + horizon * MS)? {
            Incoming::Event(Event::Message { from, .. }, _) => Some((from, parent.time().0 / 1_000_000)),
            _ => None,
        };
        horizons.iter().map(|&horizon| next(horizon)).collect()
    }

    #[test]
    fn messages_are_held_until_they_are_due_and_come_in_order() {
        let (zero, one) = (Party::Node(0), Party::Node(1));
        let got = results(&header(Duration::ZERO, 10 * MS), &[12, 20, 20, 20]);
        assert_eq!(got, [None, Some((one, 13)), Some((zero, 14)), None]);
    }

    #[test]
    fn the_parent_handles_one_message_after_the_other() {
        let (zero, one) = (Party::Node(0), Party::Node(1));
        let got = results(&header(5 * MS, Duration::ZERO), &[7, 9, 9, 20]);
        assert_eq!(got, [None, Some((one, 8)), None, Some((zero, 13))]);
    }

    #[test]
    fn a_command_takes_no_handling_time() {
        let header = header(5 * MS, Duration::ZERO);
        let (shared, inboxes) = Shared::new(&header);
        let (updates, _listener) = crossbeam_channel::unbounded();
        let mut parent = Endpoint::new(Party::Parent, &header, &shared, inboxes.parent, updates);
        // The clock stands still, so that the command is due then.
        shared.clock.pause();
        shared.command(Command::Latency(MS));
        let now = shared.clock.now();
        assert!(matches!(parent.next(now), Some(Incoming::Command(Command::Latency(MS)))));
        assert_eq!(parent.time(), now);
        shared.command(Command::Latency(MS));
        assert!(parent.next(now + MS).is_none(), "nothing has changed");
    }

    #[test]
    fn a_timer_fires_once_and_a_later_one_replaces_it() {
        let header = header(Duration::ZERO, Duration::ZERO);
        let (shared, mut inboxes) = Shared::new(&header);
        let (updates, _listener) = crossbeam_channel::unbounded();
        let mut port = Endpoint::new(Party::Node(0), &header, &shared, inboxes.nodes.remove(0), updates);
        port.set_timer(Time::ZERO + MS);
        port.set_timer(Time::ZERO + 3 * MS);
        assert!(port.next(Time::ZERO + 2 * MS).is_none());
        assert!(matches!(port.next(Time::ZERO + 9 * MS), Some(Incoming::Event(Event::Timer, _))));
        assert_eq!(port.time(), Time::ZERO + 3 * MS);
        assert!(port.next(Time::ZERO + 9 * MS).is_none());
    }

    #[test]
    fn nobody_waits_in_a_run_that_was_stopped() {
        let header = header(Duration::ZERO, Duration::ZERO);
        let (shared, mut inboxes) = Shared::new(&header);
        let (updates, _listener) = crossbeam_channel::unbounded();
        let mut port = Endpoint::new(Party::Node(0), &header, &shared, inboxes.nodes.remove(0), updates);
        shared.stop();
        // It takes what was sent to wake it out of the inbox, and nothing else would.
        assert!(port.next(Time::ZERO).is_none());
        port.wait(None);
        assert!(port.step(|_| {}).is_err());
    }
}
