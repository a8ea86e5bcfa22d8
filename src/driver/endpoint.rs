//! A party's endpoint: its messages, its timer, its time, its records, and the condition of its machine.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};
use std::mem;
use std::sync::Arc;
use std::time::Duration;

use crossbeam_channel::{Receiver, Sender};

use super::Update;
use super::shared::{Content, Envelope, SharedRun, WorkerOrder};
use crate::balance::{Condition, Event, Message, Party, Transition};
use crate::picture::Colour;
use crate::record::{Record, RecordKind};
use crate::runlog::Header;
use crate::scenario::Command;
use crate::sim::Link;
use crate::time::Time;

/// Longest time that records and placed pixels wait before they leave their thread.
pub(super) const FLUSH: Duration = Duration::from_millis(15);

/// Time of a message that does not travel, so that every cause lies before its effects.
const MIN_TRAVEL_TIME: Duration = Duration::from_nanos(1);

/// Tells a thread to end: the run was stopped, or another thread has panicked, or the run is over and the shutdown
/// cannot reach this party.
#[derive(Debug)]
pub(super) struct Stopped;

/// The next thing that a party handles.
pub(super) enum Incoming {
    /// An event for the protocol, with the pixels of results or of a traced atom.
    Event(Event, Vec<Colour>),
    /// A command of the user to its machine.
    Command(Command),
    /// An order to a worker that has its own thread.
    WorkerOrder(WorkerOrder),
}

/// The endpoint of one party; it lives on the party's thread.
pub(super) struct Endpoint {
    pub shared: Arc<SharedRun>,
    me: Party,
    inbox: Receiver<Envelope>,
    /// Envelopes that have come but are not due yet, the earliest on top.
    pending: BinaryHeap<Reverse<Envelope>>,
    /// Condition of the party's machine.
    condition: Condition,
    /// Messages that have arrived while the machine hangs.
    mailbox: VecDeque<Envelope>,
    /// Links to the other parties, in the order of [`SharedRun::index`].
    links: Vec<Link>,
    timer: Option<Time>,
    handling: Duration,
    /// Whether an envelope that is handled late is dated back to when it was due.
    backdates: bool,
    time: Time,
    updates: Sender<Update>,
    records: Vec<Record>,
    flushed: Time,
}

impl Endpoint {
    /// Creates the endpoint of `me`, whose messages come out of `inbox`.
    pub fn new(
        me: Party,
        header: &Header,
        shared: &Arc<SharedRun>,
        inbox: Receiver<Envelope>,
        updates: Sender<Update>,
    ) -> Self {
        Self {
            shared: Arc::clone(shared),
            me,
            inbox,
            pending: BinaryHeap::new(),
            condition: match me {
                Party::Node(node) if shared.can_fail && header.is_spare(node) => Condition::Off,
                _ => Condition::Well,
            },
            mailbox: VecDeque::new(),
            links: vec![Link::default(); shared.parties()],
            timer: None,
            handling: if me == Party::Parent { header.handling } else { Duration::ZERO },
            // An emulated machine is on time even if its thread wakes late. At full speed the machine is this computer.
            backdates: !header.is_full_speed(),
            time: Time::ZERO,
            updates,
            records: Vec::new(),
            flushed: Time::ZERO,
        }
    }

    /// Returns the party's own time, at which it acts. It never goes back.
    pub fn time(&self) -> Time {
        self.time
    }

    /// Advances the party's time to `to`, if that is later.
    pub fn advance(&mut self, to: Time) {
        self.time = self.time.max(to);
    }

    /// Makes a record at the party's time. Returns its index, which is valid until the next flush.
    pub fn record(&mut self, kind: RecordKind) -> usize {
        self.records.push(Record { at: self.time, kind });
        self.records.len() - 1
    }

    /// Returns a record that is not flushed yet.
    pub fn record_mut(&mut self, index: usize) -> &mut RecordKind {
        &mut self.records[index].kind
    }

    /// Sends a message at the party's time, with the pixels of its atoms.
    pub fn send(&mut self, to: Party, message: Message, pixels: Vec<Colour>) {
        let bytes = self.shared.bytes(&message);
        let receiver = self.shared.index(to);
        let arrives = self.shared.arrival(&mut self.links[receiver], (self.me, to), self.time, bytes);
        let arrives = self.shared.failures.arrival(self.me, to, arrives);
        let is_lost = self.shared.failures.is_cut(self.me, to);
        let sent = || Content::Message { from: self.me, message: message.clone(), pixels };
        let content = if is_lost { Content::Lost } else { sent() };
        let id = self.shared.deliver(receiver, arrives, content);
        self.record(RecordKind::Sent { id, from: self.me, to, message, bytes, arrives });
    }

    /// Records a message from `from` that did not travel, since this party has taken the atoms by itself.
    pub fn record_taken(&mut self, from: Party, message: Message) {
        let (id, bytes, arrives) = (self.shared.new_id(), self.shared.bytes(&message), self.time + MIN_TRAVEL_TIME);
        self.record(RecordKind::Sent { id, from, to: self.me, message, bytes, arrives });
        self.advance(arrives);
        self.record(RecordKind::Received { id, by: self.me });
    }

    /// Sets the timer: [`Endpoint::next`] returns [`Event::Timer`] at `at`. A later call replaces an earlier one.
    pub fn set_timer(&mut self, at: Time) {
        self.timer = Some(at);
    }

    /// Returns the condition of the party's machine.
    pub fn condition(&self) -> Condition {
        self.condition
    }

    /// Sets the condition of the party's machine; records it and the messages that are lost with it. Returns the effect
    /// on the machine; `None` if nothing changes, as always once the run is over.
    pub fn set_condition(&mut self, condition: Condition) -> Option<Transition> {
        let Party::Node(node) = self.me else { return None };
        let transition = self.condition.transition(condition)?;
        if !self.shared.failures.cut_off(node, condition == Condition::CutOff) {
            return None;
        }
        self.condition = condition;
        self.record(RecordKind::Condition { node, condition });
        if transition == Transition::MemoryLost {
            self.timer = None;
            let lost = mem::take(&mut self.mailbox);
            lost.into_iter().for_each(|envelope| _ = self.record(RecordKind::Lost { id: envelope.id }));
        }
        Some(transition)
    }

    /// Adds a record that messages from `from` to this party arrive late from now on, and until when.
    pub fn record_delay(&mut self, from: Party) {
        let (to, soon) = (self.me, self.time + MIN_TRAVEL_TIME);
        let until = self.shared.failures.arrival(from, to, soon);
        self.record(RecordKind::Delayed { from, to, until });
    }

    /// Returns the next thing to handle, if it is due by `horizon`, and advances the party's time to it.
    pub fn next(&mut self, horizon: Time) -> Option<Incoming> {
        while let Ok(envelope) = self.inbox.try_recv() {
            self.enqueue(envelope);
        }
        if self.condition != Condition::Hung
            && let Some(envelope) = self.mailbox.pop_front()
        {
            return self.deliver(envelope);
        }
        loop {
            let (timer, handled) = (self.timer(), self.next_handled());
            if let Some(timer) = timer.filter(|&timer| timer <= horizon && handled.is_none_or(|other| timer <= other)) {
                self.timer = None;
                self.advance(timer);
                return Some(Incoming::Event(Event::Timer, Vec::new()));
            }
            let at = handled.filter(|&at| at <= horizon)?;
            let Reverse(envelope) = self.pending.pop()?;
            let due = self.due(&envelope);
            if due > envelope.due {
                self.pending.push(Reverse(Envelope { due, ..envelope }));
                continue;
            }
            self.advance(if self.backdates { at } else { horizon });
            match &envelope.content {
                content if self.is_lost(content) => _ = self.record(RecordKind::Lost { id: envelope.id }),
                Content::Message { .. } if self.condition == Condition::Hung => self.mailbox.push_back(envelope),
                _ => return self.deliver(envelope),
            }
        }
    }

    /// Begins a step: blocks while the run is paused, and flushes if that is due. Returns the clock's time, or an error
    /// if the party should end.
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

    /// Blocks until an envelope comes in or is due, until the timer, until `until`, or until the next flush.
    pub fn wait(&mut self, until: Option<Time>) {
        // The envelope that announces it may have left the inbox already.
        if self.is_stopped() {
            return;
        }
        let flush = (!self.records.is_empty()).then_some(self.flushed + FLUSH);
        let wake = [until, self.timer(), self.next_handled(), flush].into_iter().flatten().min();
        let came = match wake {
            Some(wake) => self.inbox.recv_timeout(wake.since(self.shared.clock.now())).ok(),
            // Every thread of the run holds senders of all inboxes, so that none is ever disconnected.
            None => self.inbox.recv().ok(),
        };
        came.into_iter().for_each(|envelope| self.enqueue(envelope));
    }

    /// Sends the records to the run's owner.
    pub fn flush(&mut self) {
        if !self.records.is_empty() {
            let records = mem::take(&mut self.records);
            self.update(Update::Records(records));
        }
    }

    /// Sends an update to the run's owner, if it still listens.
    pub fn update(&self, update: Update) {
        let _ = self.updates.send(update);
    }

    fn enqueue(&mut self, envelope: Envelope) {
        if !matches!(envelope.content, Content::Wake) {
            self.pending.push(Reverse(envelope));
        }
    }

    /// Returns when an envelope is due: a message may have been delayed since it was sent.
    fn due(&self, envelope: &Envelope) -> Time {
        match envelope.content {
            Content::Message { from, .. } => self.shared.failures.arrival(from, self.me, envelope.due),
            _ => envelope.due,
        }
    }

    /// Returns whether a message that is due now is lost, or was lost on its way.
    fn is_lost(&self, content: &Content) -> bool {
        match content {
            Content::Lost => true,
            Content::Message { from, .. } => {
                self.condition == Condition::Off || self.shared.failures.is_cut(*from, self.me)
            }
            _ => false,
        }
    }

    /// Opens an envelope. Returns its content, if that is something to handle.
    fn deliver(&mut self, Envelope { id, content, .. }: Envelope) -> Option<Incoming> {
        match content {
            Content::Message { from, message, pixels } => {
                self.record(RecordKind::Received { id, by: self.me });
                Some(Incoming::Event(Event::Message { from, message }, pixels))
            }
            Content::WorkerEvent { event, pixels } => Some(Incoming::Event(event, pixels)),
            Content::Command(command) => Some(Incoming::Command(command)),
            Content::WorkerOrder(order) => Some(Incoming::WorkerOrder(order)),
            Content::Lost | Content::Wake => None,
        }
    }

    /// Returns whether the party should end: the run was stopped, or is over and the shutdown cannot reach the party.
    fn is_stopped(&self) -> bool {
        let is_unreachable = || !self.condition.is_running() || self.shared.failures.is_cut(Party::Parent, self.me);
        self.shared.is_stopped() || self.shared.failures.is_over() && is_unreachable()
    }

    /// Returns when the timer fires; `None` while the machine hangs.
    fn timer(&self) -> Option<Time> {
        self.timer.filter(|_| self.condition != Condition::Hung)
    }

    /// Returns when the party will have handled the next pending envelope. It begins with a message when that is due
    /// and the one before is handled, and takes its handling time. A command takes no time.
    fn next_handled(&self) -> Option<Time> {
        let Reverse(next) = self.pending.peek()?;
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

    /// Returns the header of a run with two emulated nodes.
    fn header(handling: Duration, latency: Duration) -> Header {
        let link = LinkSettings { latency, ..LinkSettings::default() };
        Header { handling, link, ..examples::header(&[0.5, 0.5]) }
    }

    /// Sends empty results from each node to the parent, the second node's 1 ms before the first's. Returns what the
    /// parent gets by each of `horizons`: the sender, and the time (ms, rounded down).
    fn results(header: &Header, horizons: &[u32]) -> Vec<Option<(Party, u64)>> {
        let (shared, mut inboxes) = SharedRun::new(header);
        let (updates, _listener) = crossbeam_channel::unbounded();
        let endpoint = |me, inbox| Endpoint::new(me, header, &shared, inbox, updates.clone());
        let mut parent = endpoint(Party::Parent, inboxes.parent);
        let mut second = endpoint(Party::Node(1), inboxes.nodes.remove(1));
        let mut first = endpoint(Party::Node(0), inboxes.nodes.remove(0));
        for (endpoint, at) in [(&mut first, 4), (&mut second, 3)] {
            endpoint.advance(Time::ZERO + at * MS);
            endpoint.send(Party::Parent, Message::Results(Vec::new()), Vec::new());
        }
        let mut next = |horizon: u32| match parent.next(Time::ZERO + horizon * MS)? {
            Incoming::Event(Event::Message { from, .. }, _) => Some((from, parent.time().0 / 1_000_000)),
            _ => None,
        };
        horizons.iter().map(|&horizon| next(horizon)).collect()
    }

    #[test]
    fn messages_arrive_when_due_and_in_order() {
        let (zero, one) = (Party::Node(0), Party::Node(1));
        let got = results(&header(Duration::ZERO, 10 * MS), &[12, 20, 20, 20]);
        assert_eq!(got, [None, Some((one, 13)), Some((zero, 14)), None]);
    }

    #[test]
    fn parent_handles_one_message_at_a_time() {
        let (zero, one) = (Party::Node(0), Party::Node(1));
        let got = results(&header(5 * MS, Duration::ZERO), &[7, 9, 9, 20]);
        assert_eq!(got, [None, Some((one, 8)), None, Some((zero, 13))]);
    }

    #[test]
    fn command_takes_no_handling_time() {
        let header = header(5 * MS, Duration::ZERO);
        let (shared, inboxes) = SharedRun::new(&header);
        let (updates, _listener) = crossbeam_channel::unbounded();
        let mut parent = Endpoint::new(Party::Parent, &header, &shared, inboxes.parent, updates);
        // The clock is paused, so that the command is due at its time.
        shared.clock.pause();
        shared.command(Command::Latency(MS));
        let now = shared.clock.now();
        assert!(matches!(parent.next(now), Some(Incoming::Command(Command::Latency(MS)))));
        assert_eq!(parent.time(), now);
        shared.command(Command::Latency(MS));
        assert!(parent.next(now + MS).is_none(), "nothing has changed");
    }

    #[test]
    fn timer_fires_once_and_a_later_one_replaces_it() {
        let header = header(Duration::ZERO, Duration::ZERO);
        let (shared, mut inboxes) = SharedRun::new(&header);
        let (updates, _listener) = crossbeam_channel::unbounded();
        let mut endpoint = Endpoint::new(Party::Node(0), &header, &shared, inboxes.nodes.remove(0), updates);
        endpoint.set_timer(Time::ZERO + MS);
        endpoint.set_timer(Time::ZERO + 3 * MS);
        assert!(endpoint.next(Time::ZERO + 2 * MS).is_none());
        assert!(matches!(endpoint.next(Time::ZERO + 9 * MS), Some(Incoming::Event(Event::Timer, _))));
        assert_eq!(endpoint.time(), Time::ZERO + 3 * MS);
        assert!(endpoint.next(Time::ZERO + 9 * MS).is_none());
    }

    #[test]
    fn no_party_waits_in_a_stopped_run() {
        let header = header(Duration::ZERO, Duration::ZERO);
        let (shared, mut inboxes) = SharedRun::new(&header);
        let (updates, _listener) = crossbeam_channel::unbounded();
        let mut endpoint = Endpoint::new(Party::Node(0), &header, &shared, inboxes.nodes.remove(0), updates);
        shared.stop();
        // Takes the envelope that wakes the party out of the inbox; no other will come.
        assert!(endpoint.next(Time::ZERO).is_none());
        endpoint.wait(None);
        assert!(endpoint.step(|_| {}).is_err());
    }
}
