//! The state that all parties of a run share: the clock, the network, and each other's inboxes.

use std::cmp::Ordering;
use std::sync::atomic::{self, AtomicU64};
use std::sync::{Arc, Mutex, OnceLock, PoisonError, RwLock};
use std::time::Duration;

use crossbeam_channel::{Receiver, Sender};

use super::clock::Clock;
use super::error::UntraceableAtom;
use super::failures::Failures;
use crate::balance::{Event, Message, NodeId, Party};
use crate::picture::{Atom, Colour, Division};
use crate::runlog::{Driver, Header, LinkSettings, OwnLink};
use crate::scenario::Command;
use crate::sim::{Link, Wire};
use crate::time::Time;

/// The state that all parties of a run share.
pub(super) struct SharedRun {
    pub clock: Clock,
    /// Inboxes of the nodes, of the parent, and of the workers that have their own threads.
    inboxes: Vec<Sender<Envelope>>,
    nodes: usize,
    next_id: AtomicU64,
    /// Whether the latency can change; rayon's threads share their memory, so messages do not travel.
    has_latency: bool,
    /// Latency and bandwidth of all links, as of now.
    link: RwLock<LinkSettings>,
    /// The wire that all links share, if they do.
    wire: Option<Mutex<Wire>>,
    /// Whether machines and links can fail: only if a node is one thread.
    pub can_fail: bool,
    pub failures: Failures,
    /// The atom that made the run fail, if it has failed.
    failure: OnceLock<UntraceableAtom>,
    pub division: Division,
    pub scene_bytes: u64,
}

/// An envelope in the inbox of a party. The order is by due time, then by id, so that of two due at the same time the
/// one sent first comes first.
pub(super) struct Envelope {
    pub due: Time,
    pub id: u64,
    pub content: Content,
}

/// Content of an envelope.
pub(super) enum Content {
    Message {
        from: Party,
        message: Message,
        /// Pixels of the atoms of [`Message::Results`], in their order.
        pixels: Vec<Colour>,
    },
    /// A message whose link was cut when it was sent.
    Lost,
    /// From a worker with its own thread to its node: it has traced an atom, or failed to.
    WorkerEvent {
        event: Event,
        pixels: Vec<Colour>,
    },
    /// From a node to a worker with its own thread.
    WorkerOrder(WorkerOrder),
    Command(Command),
    /// Wakes the party to check whether the run is over or was stopped.
    Wake,
}

/// The receiving ends of the inboxes.
pub(super) struct Inboxes {
    pub nodes: Vec<Receiver<Envelope>>,
    pub parent: Receiver<Envelope>,
    /// By node, but only if workers have their own threads ([`Driver::Pairs`]).
    pub workers: Vec<Receiver<Envelope>>,
}

/// An order to a worker that has its own thread, through its pipe.
pub(super) enum WorkerOrder {
    Trace(Atom),
    /// End the worker.
    End,
}

impl SharedRun {
    /// Creates the shared state and the inboxes.
    pub fn new(header: &Header) -> (Arc<Self>, Inboxes) {
        let nodes = header.speeds.len();
        let workers = if header.driver == Driver::Pairs { nodes } else { 0 };
        // Unbounded, so that no party ever waits for another. `balance::ring` bounds the number of messages in flight.
        let (inboxes, receivers) = (0..=nodes + workers).map(|_| crossbeam_channel::unbounded()).unzip();
        let shared = Self {
            clock: Clock::start(),
            inboxes,
            nodes,
            next_id: AtomicU64::new(0),
            has_latency: header.driver != Driver::WorkStealing,
            link: RwLock::new(header.link.clone()),
            wire: header.link.shared.then(Mutex::default),
            can_fail: header.driver == Driver::Threads,
            failures: Failures::default(),
            failure: OnceLock::new(),
            division: header.division,
            scene_bytes: header.scene_text.len() as u64,
        };
        let mut receivers: Vec<_> = receivers;
        let workers = receivers.split_off(nodes + 1);
        let parent = receivers.remove(nodes);
        (Arc::new(shared), Inboxes { nodes: receivers, parent, workers })
    }

    /// Returns the number of parties.
    pub fn parties(&self) -> usize {
        self.nodes + 1
    }

    /// Returns the index of a party: nodes first, the parent last.
    pub fn index(&self, party: Party) -> usize {
        match party {
            Party::Node(node) => usize::from(node),
            Party::Parent => self.nodes,
        }
    }

    /// Returns the index of the inbox of a node's worker: the node's own, unless the worker has its own thread.
    pub fn worker_index(&self, node: NodeId) -> usize {
        let own = self.inboxes.len() > self.parties();
        usize::from(node) + if own { self.parties() } else { 0 }
    }

    /// Returns the size of a message in bytes.
    pub fn bytes(&self, message: &Message) -> u64 {
        message.bytes(self.division, self.scene_bytes)
    }

    /// Sends a message of `bytes` bytes over the link from one party to another at `at`. Returns its arrival.
    pub fn arrival(&self, link: &mut Link, (from, to): (Party, Party), at: Time, bytes: u64) -> Time {
        // A panic of another thread leaves settings and wire in a valid state.
        let (latency, bandwidth) = self.link.read().unwrap_or_else(PoisonError::into_inner).between(from, to);
        let mut wire = self.wire.as_ref().map(|wire| wire.lock().unwrap_or_else(PoisonError::into_inner));
        link.arrival(at, bytes, latency, bandwidth, wire.as_deref_mut())
    }

    /// Executes a command now. A command to a node goes to its worker, and has no effect if the node has ended or does
    /// not exist. A change of the latency or of a link takes effect here, and the parent records it.
    pub fn command(&self, command: Command) {
        match command {
            Command::Latency(latency) => {
                self.set_latency(command, |link| std::mem::replace(&mut link.latency, latency) != latency);
            }
            Command::OwnLatency { party, latency } if self.exists(party) => self.set_latency(command, |link| {
                let before = link.own(party);
                link.set_own(party, OwnLink { latency, ..before });
                before.latency != latency
            }),
            Command::OwnLatency { .. } => {}
            Command::Link { one, other, cut } => self.cut_link(one, other, cut),
            Command::Delay { from, to, by } => self.delay(from, to, by),
            Command::Condition { .. } if !self.can_fail => {}
            Command::Speed { node, .. } | Command::Pause { node, .. } | Command::Condition { node, .. } => {
                if usize::from(node) < self.nodes {
                    self.deliver(self.worker_index(node), self.clock.now(), Content::Command(command));
                }
            }
        }
    }

    /// Sets a latency with `set`, which returns whether it changes, for the messages that leave from now on, and tells
    /// the parent of a change.
    fn set_latency(&self, command: Command, set: impl FnOnce(&mut LinkSettings) -> bool) {
        if self.has_latency && set(&mut self.link.write().unwrap_or_else(PoisonError::into_inner)) {
            self.deliver(self.index(Party::Parent), self.clock.now(), Content::Command(command));
        }
    }

    /// Cuts or restores a link for the messages that leave or arrive from now on, and tells the parent of a change.
    fn cut_link(&self, one: Party, other: Party, cut: bool) {
        if self.has_link(one, other) && self.failures.cut_link(one, other, cut) {
            let command = Content::Command(Command::Link { one, other, cut });
            self.deliver(self.index(Party::Parent), self.clock.now(), command);
        }
    }

    /// Delays the messages from one party to another, and tells the receiver, which records it.
    fn delay(&self, from: Party, to: Party, by: Duration) {
        let now = self.clock.now();
        if self.has_link(from, to) && from != to && self.failures.delay(from, to, now, by) {
            self.deliver(self.index(to), now, Content::Command(Command::Delay { from, to, by }));
        }
    }

    /// Returns whether the link between two parties exists and can fail.
    fn has_link(&self, one: Party, other: Party) -> bool {
        self.can_fail && self.exists(one) && self.exists(other)
    }

    /// Returns whether the run has this party.
    fn exists(&self, party: Party) -> bool {
        party == Party::Parent || self.index(party) < self.nodes
    }

    /// Returns a new id, unique in the run.
    pub fn new_id(&self) -> u64 {
        self.next_id.fetch_add(1, atomic::Ordering::Relaxed)
    }

    /// Puts an envelope into the inbox with this index. Returns the id of the envelope.
    pub fn deliver(&self, to: usize, due: Time, content: Content) -> u64 {
        let id = self.new_id();
        // A party that has ended receives nothing more.
        let _ = self.inboxes[to].send(Envelope { due, id, content });
        id
    }

    /// Marks the run as over, before the shutdown leaves. Wakes all parties, so that those that the shutdown cannot
    /// reach end.
    pub fn finish(&self) {
        self.failures.end();
        self.wake_all();
    }

    /// Ends all threads, also those that are paused or wait.
    pub fn stop(&self) {
        self.clock.end();
        self.wake_all();
    }

    /// Ends all threads, since the run has failed.
    pub fn fail(&self, why: UntraceableAtom) {
        // The first failure counts.
        let _ = self.failure.set(why);
        self.stop();
    }

    /// Returns the atom that made the run fail, if it has failed.
    pub fn failure(&self) -> Option<UntraceableAtom> {
        self.failure.get().copied()
    }

    /// Returns whether [`SharedRun::stop`] was called.
    pub fn is_stopped(&self) -> bool {
        self.clock.has_ended()
    }

    fn wake_all(&self) {
        (0..self.inboxes.len()).for_each(|party| _ = self.deliver(party, Time::ZERO, Content::Wake));
    }
}

impl PartialEq for Envelope {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Envelope {}

impl PartialOrd for Envelope {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Envelope {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.due, self.id).cmp(&(other.due, other.id))
    }
}
