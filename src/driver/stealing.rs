//! What a Rust programmer would reach for today, as the ring's rival: rayon's work stealing over the atoms.
//!
//! The picture is halved again and again down to single atoms; a thread without work steals the largest half that waits
//! with another. Nobody decides anything, and nothing travels: the threads share their memory, so that latency,
//! bandwidth and handling do not apply. They are the same emulated machines as in other runs. The parent only collects:
//! to it this is a run in which the first node has the whole picture as its band.
//!
//! The records are those of other runs: a stolen half is a transfer at the time of the thief, whose sender knows nothing
//! of it.

use std::any::Any;
use std::cell::RefCell;
use std::io;
use std::mem;
use std::ops::Range;
use std::panic::{self, AssertUnwindSafe};
use std::time::Duration;

use crossbeam_channel::Receiver;
use rayon_core::{FnContext, ThreadBuilder, ThreadPoolBuilder};

use super::run_context::RunContext;
use super::shared::{Inboxes, Parcel, Shared};
use super::supervisor::Threads;
use super::worker::{Worker, WorkerHandler};
use crate::balance::{Event, Message, NodeId, Party, Rules, Strategy};
use crate::picture::{Atom, push_atom};
use crate::runlog::{Header, LinkSettings};
use crate::time::Time;

/// The header by which the parent runs: nothing takes a way, and the first node has it all.
pub(super) fn header(header: &Header) -> Header {
    Header {
        rules: Rules { strategy: Strategy::Serial, ..header.rules },
        link: LinkSettings { latency: Duration::ZERO, bandwidth: None, shared: false },
        handling: Duration::ZERO,
        spares: 0,
        ..header.clone()
    }
}

/// Starts a thread for each node, and the parent's; then has the picture traced. Returns when it is, or when the run is
/// stopped.
pub(super) fn run<'scope, 'run: 'scope, Stop: Fn() + Copy + Send + 'scope>(
    setting: RunContext<'run>,
    inboxes: Inboxes,
    threads: &mut Threads<'scope, '_, Stop>,
) {
    let mut nodes = inboxes.nodes.into_iter();
    let start = |thread: ThreadBuilder| {
        let inbox = nodes.next().ok_or_else(|| io::Error::other("there are no more nodes"))?;
        let name = format!("node {}", thread.index());
        let started = threads.start(&name, move || run_node(setting, thread, inbox));
        // What went wrong is said by the threads.
        if started { Ok(()) } else { Err(io::Error::other("no thread")) }
    };
    let pool = ThreadPoolBuilder::new().num_threads(setting.header.speeds.len()).spawn_handler(start).build();
    setting.start_parent(inboxes.parent, threads);
    // Without all its threads there is no pool, and those that could be started have been stopped.
    let Ok(pool) = pool else { return };
    let whole = 0..setting.header.division.atoms();
    // On the node that has the band. The pool ends when it is dropped.
    pool.broadcast(|context| {
        if context.index() == 0 {
            share(setting.shared, whole.clone());
        }
    });
}

thread_local! {
    /// The node of this thread, while it is one of the pool's.
    static NODE: RefCell<Option<PoolNode>> = const { RefCell::new(None) };
}

/// Runs a node on this thread: it waits for its band, is one of the pool until that ends, and waits for its shutdown.
fn run_node(setting: RunContext<'_>, thread: ThreadBuilder, inbox: Receiver<Parcel>) {
    let worker = setting.worker(thread.index() as NodeId, inbox);
    let mut node = PoolNode { worker, thief: Thief { heard: 0, awaited: 1, unsent: Vec::new() }, panic: None };
    node.wait_to_hear();
    NODE.set(Some(node));
    // Even if the run was stopped, since the pool waits for all of its threads.
    thread.run();
    let Some(mut node) = NODE.take() else { return };
    if let Some(panic) = node.panic {
        panic::resume_unwind(panic);
    }
    node.wait_to_hear();
    node.worker.end();
}

/// Traces these atoms together with whoever steals some of them.
fn share(shared: &Shared, atoms: Range<Atom>) {
    if shared.is_stopped() {
        return;
    }
    if atoms.len() < 2 {
        return with_node(|node| atoms.for_each(|atom| node.trace(atom)));
    }
    let middle = atoms.start + (atoms.end - atoms.start) / 2;
    let (left, right) = (atoms.start..middle, middle..atoms.end);
    let (owner, since) = with_node(|node| (node.worker.id, node.worker.port.time()));
    let share_right = |context: FnContext| {
        if context.migrated() {
            with_node(|node| node.steal(owner, since, right.clone()));
        }
        share(shared, right);
    };
    rayon_core::join_context(|_| share(shared, left), share_right);
}

fn with_node<R>(f: impl FnOnce(&mut PoolNode) -> R) -> R {
    NODE.with_borrow_mut(|node| f(node.as_mut().expect("each thread of the pool has its node")))
}

/// A node of the pool.
struct PoolNode {
    worker: Worker,
    thief: Thief,
    /// What the tracer said when it panicked. It is kept from rayon, which would not tell whose it was.
    panic: Option<Box<dyn Any + Send>>,
}

impl PoolNode {
    /// Waits for the band, and the next time for the shutdown; a late thread may hear of both at once. That the run was
    /// stopped meanwhile is seen by whoever looks next.
    fn wait_to_hear(&mut self) {
        let _ = self.worker.work(&mut self.thief);
        self.thief.awaited += 1;
    }

    /// Takes over what waited with `owner` since then.
    fn steal(&mut self, owner: NodeId, since: Time, atoms: Range<Atom>) {
        // Where everybody is the owner, there is no thief.
        if owner == self.worker.id {
            return;
        }
        // What the thread did to find it is no atom's cost.
        self.worker.skip();
        self.worker.port.advance(self.worker.ready(since));
        self.worker.port.take(Party::Node(owner), Message::Transfer([atoms].into()));
    }

    fn trace(&mut self, atom: Atom) {
        let trace = || self.worker.trace_atom(atom, &mut self.thief);
        match panic::catch_unwind(AssertUnwindSafe(trace)) {
            // Whoever has nothing left may find nothing to steal for long, and is not asked again until it does.
            Ok(Ok(())) if rayon_core::current_thread_has_pending_tasks() == Some(false) => {
                self.thief.send_results(&mut self.worker);
                self.worker.flush();
            }
            Ok(_) => {}
            Err(panic) => {
                self.panic = Some(panic);
                self.worker.port.shared.stop();
            }
        }
    }
}

/// What a node of the pool does besides tracing.
struct Thief {
    /// How many messages have come: the band is the first, the shutdown the second.
    heard: u32,
    /// How many messages are waited for.
    awaited: u32,
    /// What is traced and not sent.
    unsent: Vec<Range<Atom>>,
}

impl Thief {
    fn send_results(&mut self, worker: &mut Worker) {
        if !self.unsent.is_empty() {
            let atoms = mem::take(&mut self.unsent);
            let pixels = worker.take_pixels(&atoms);
            worker.port.send(Party::Parent, Message::Results(atoms), pixels);
        }
    }
}

impl WorkerHandler for Thief {
    fn event(&mut self, event: Event, worker: &mut Worker) {
        match event {
            Event::Message { message: Message::Band(_) | Message::Shutdown, .. } => self.heard += 1,
            Event::Timer => self.send_results(worker),
            other => unreachable!("nobody sends {other:?} to a node of rayon's"),
        }
    }

    fn traced(&mut self, atom: Atom, _: Duration, worker: &mut Worker) {
        if self.unsent.is_empty() {
            worker.port.set_timer(worker.port.time() + Rules::BATCH);
        }
        push_atom(&mut self.unsent, atom);
    }

    fn is_over(&self) -> bool {
        self.heard >= self.awaited
    }
}
