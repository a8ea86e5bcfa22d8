//! What all parties of a run share: the clock, the network, and each other's inboxes.

use std::cmp::Ordering;
use std::sync::atomic::{self, AtomicU64};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

use crossbeam_channel::{Receiver, Sender};

use super::clock::Clock;
use super::failures::Failures;
use crate::balance::{Event, Message, NodeId, Party};
use crate::picture::{Atom, Colour, Division};
use crate::runlog::{Driver, Header};
use crate::scenario::Command;
use crate::sim::{Link, Wire};
use crate::time::Time;

/// What all parties of a run share.
pub(super) struct Shared {
    pub clock: Clock,
    /// By node, the parent's, and by node those of the workers that have threads of their own.
    inboxes: Vec<Sender<Parcel>>,
    nodes: usize,
    next_id: AtomicU64,
    /// Whether messages travel at all: rayon's threads share their memory.
    travels: bool,
    /// Of every link, in nanoseconds.
    latency: AtomicU64,
    bandwidth: Option<f64>,
    /// What all links share, if they do.
    wire: Option<Mutex<Wire>>,
    /// Whether machines and links can fail: only where a node is one thread.
    pub can_fail: bool,
    pub losses: Failures,
    /// Why the run has failed, if it has.
    failure: OnceLock<String>,
    pub division: Division,
    pub scene_bytes: u64,
}

/// Something on its way to a party. The earlier is the smaller; of those due at once, the one sent first.
pub(super) struct Parcel {
    pub due: Time,
    pub id: u64,
    pub content: Content,
}

/// What is on its way.
pub(super) enum Content {
    Message {
        from: Party,
        message: Message,
        /// Of the atoms of [`Message::Results`], in their order.
        pixels: Vec<Colour>,
    },
    /// A message that would arrive, had its link not been cut when it was sent.
    Lost,
    /// From a worker with a thread of its own to its node: it has traced an atom, or failed to.
    Worked {
        event: Event,
        pixels: Vec<Colour>,
    },
    /// From a node to such a worker.
    WorkerOrder(WorkerOrder),
    Command(Command),
    /// Nothing but a reason to look whether the run is over or was stopped.
    Wake,
}

/// Where the parties' parcels come out.
pub(super) struct Inboxes {
    pub nodes: Vec<Receiver<Parcel>>,
    pub parent: Receiver<Parcel>,
    /// By node, but only where workers have threads of their own ([`Driver::Pairs`]).
    pub workers: Vec<Receiver<Parcel>>,
}

/// What a worker with a thread of its own is told through its pipe.
pub(super) enum WorkerOrder {
    Trace(Atom),
    /// There is nothing more to do.
    End,
}

impl Shared {
    /// What the parties share, and their inboxes.
    pub fn new(header: &Header) -> (Arc<Self>, Inboxes) {
        let nodes = header.speeds.len();
        let workers = if header.driver == Driver::Pairs { nodes } else { 0 };
        // Unbounded, so that no party ever waits for another; `balance::ring` argues how little is in flight.
        let (inboxes, receivers) = (0..=nodes + workers).map(|_| crossbeam_channel::unbounded()).unzip();
        let shared = Self {
            clock: Clock::start(),
            inboxes,
            nodes,
            next_id: AtomicU64::new(0),
            travels: header.driver != Driver::WorkStealing,
            latency: AtomicU64::new(nanoseconds(header.link.latency)),
            bandwidth: header.link.bandwidth,
            wire: header.link.shared.then(Mutex::default),
            can_fail: header.driver == Driver::Threads,
            losses: Failures::default(),
            failure: OnceLock::new(),
            division: header.division,
            scene_bytes: header.scene_text.len() as u64,
        };
        let mut receivers: Vec<_> = receivers;
        let workers = receivers.split_off(nodes + 1);
        let parent = receivers.remove(nodes);
        (Arc::new(shared), Inboxes { nodes: receivers, parent, workers })
    }

    /// How many parties there are.
    pub fn parties(&self) -> usize {
        self.nodes + 1
    }

    /// The place of a party among all: by node, and the parent last.
    pub fn index(&self, party: Party) -> usize {
        match party {
            Party::Node(node) => usize::from(node),
            Party::Parent => self.nodes,
        }
    }

    /// The place of the inbox of a node's worker: the node's own, unless the worker has a thread of its own.
    pub fn worker(&self, node: NodeId) -> usize {
        let own = self.inboxes.len() > self.parties();
        usize::from(node) + if own { self.parties() } else { 0 }
    }

    /// What a message weighs.
    pub fn bytes(&self, message: &Message) -> u64 {
        message.bytes(self.division, self.scene_bytes)
    }

    /// When a message of `bytes` arrives that leaves by `link` at `at`.
    pub fn arrival(&self, link: &mut Link, at: Time, bytes: u64) -> Time {
        let latency = Duration::from_nanos(self.latency.load(atomic::Ordering::Relaxed));
        // A thread that panicked meanwhile has left the wire whole.
        let mut wire = self.wire.as_ref().map(|wire| wire.lock().unwrap_or_else(PoisonError::into_inner));
        link.arrival(at, bytes, latency, self.bandwidth, wire.as_deref_mut())
    }

    /// Gives a command now: a node's to its worker (one that has ended, or never was, does not mind), and a change of
    /// the latency or of a link to the parent, to be noted down.
    pub fn command(&self, command: Command) {
        match command {
            Command::Latency(latency) => self.set_latency(latency),
            Command::Link { one, other, cut } => self.cut(one, other, cut),
            Command::Delay { from, to, by } => self.delay(from, to, by),
            Command::Condition { .. } if !self.can_fail => {}
            Command::Speed { node, .. } | Command::Pause { node, .. } | Command::Condition { node, .. } => {
                if usize::from(node) < self.nodes {
                    self.deliver(self.worker(node), self.clock.now(), Content::Command(command));
                }
            }
        }
    }

    /// Sets the latency of every link for the messages that leave from now on, and tells the parent of a change.
    fn set_latency(&self, latency: Duration) {
        let nanoseconds = nanoseconds(latency);
        if self.travels && self.latency.swap(nanoseconds, atomic::Ordering::Relaxed) != nanoseconds {
            let command = Content::Command(Command::Latency(latency));
            self.deliver(self.index(Party::Parent), self.clock.now(), command);
        }
    }

    /// Cuts a link for the messages that leave or arrive from now on, or mends it, and tells the parent of a change.
    fn cut(&self, one: Party, other: Party, cut: bool) {
        if self.has_link(one, other) && self.losses.cut_link(one, other, cut) {
            let command = Content::Command(Command::Link { one, other, cut });
            self.deliver(self.index(Party::Parent), self.clock.now(), command);
        }
    }

    /// Holds up the way from one party to another, and tells who waits there.
    fn delay(&self, from: Party, to: Party, by: Duration) {
        let now = self.clock.now();
        if self.has_link(from, to) && from != to && self.losses.delay(from, to, now, by) {
            self.deliver(self.index(to), now, Content::Command(Command::Delay { from, to, by }));
        }
    }

    /// Whether something can become of the link between the two.
    fn has_link(&self, one: Party, other: Party) -> bool {
        let exists = |party| matches!(party, Party::Parent) || self.index(party) < self.nodes;
        self.can_fail && exists(one) && exists(other)
    }

    /// The next thing's id.
    pub fn new_id(&self) -> u64 {
        self.next_id.fetch_add(1, atomic::Ordering::Relaxed)
    }

    /// Puts something into the inbox of the party with this index; returns the id that it was given.
    pub fn deliver(&self, to: usize, due: Time, content: Content) -> u64 {
        let id = self.new_id();
        // A party that has ended no longer listens: what still comes its way is void.
        let _ = self.inboxes[to].send(Parcel { due, id, content });
        id
    }

    /// The parent has nothing more to do, and is about to say so: whom that cannot reach wakes to end.
    pub fn finish(&self) {
        self.losses.end();
        self.wake_all();
    }

    /// Ends all threads: the paused ones go on and the waiting ones wake to see it.
    pub fn stop(&self) {
        self.clock.end();
        self.wake_all();
    }

    /// Ends all threads, since the run has failed.
    pub fn fail(&self, why: String) {
        // The first reason counts.
        let _ = self.failure.set(why);
        self.stop();
    }

    /// Why the run has failed, if it has.
    pub fn failure(&self) -> Option<&str> {
        self.failure.get().map(String::as_str)
    }

    /// Whether [`Shared::stop`] was called.
    pub fn is_stopped(&self) -> bool {
        self.clock.has_ended()
    }

    fn wake_all(&self) {
        (0..self.inboxes.len()).for_each(|party| _ = self.deliver(party, Time::ZERO, Content::Wake));
    }
}

/// A length as whole nanoseconds, at most those of 584 years.
fn nanoseconds(length: Duration) -> u64 {
    u64::try_from(length.as_nanos()).unwrap_or(u64::MAX)
}

impl PartialEq for Parcel {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Parcel {}

impl PartialOrd for Parcel {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Parcel {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.due, self.id).cmp(&(other.due, other.id))
    }
}
