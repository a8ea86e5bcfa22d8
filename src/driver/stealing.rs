//! Work stealing by rayon, for comparison with the ring: it is what a Rust programmer would use today.
//!
//! The picture is halved recursively down to single atoms. A thread without work steals the largest half that waits at
//! another thread. The threads share their memory, so messages do not travel, and latency, bandwidth and handling do
//! not apply. The threads emulate the same machines as in other runs. The parent only collects results: to the parent
//! this is a run in which the first node has the whole picture as its band.
//!
//! The records have the same kinds as in other runs: a stolen half is a transfer at the time of the thief, though its
//! sender does not know of it.

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
use super::shared::{Envelope, Inboxes, SharedRun};
use super::supervisor::Threads;
use super::worker::{Worker, WorkerHandler};
use crate::balance::{Event, Message, NodeId, Party, Rules, Strategy};
use crate::picture::{Atom, push_atom};
use crate::runlog::{Header, LinkSettings};
use crate::time::Time;

/// Returns the header for the parent: links take no time, and the first node gets all atoms.
pub(super) fn header(header: &Header) -> Header {
    Header {
        rules: Rules { strategy: Strategy::Serial, ..header.rules },
        link: LinkSettings::default(),
        handling: Duration::ZERO,
        spares: 0,
        ..header.clone()
    }
}

/// Starts a thread for each node, and the parent's, and traces the picture on the nodes' threads. Returns when it is
/// traced, or when the run is stopped.
pub(super) fn run<'scope, 'run: 'scope, Stop: Fn() + Copy + Send + 'scope>(
    context: RunContext<'run>,
    inboxes: Inboxes,
    threads: &mut Threads<'scope, '_, Stop>,
) {
    let mut nodes = inboxes.nodes.into_iter();
    let start = |thread: ThreadBuilder| {
        let inbox = nodes.next().ok_or_else(|| io::Error::other("there are no more nodes"))?;
        let name = format!("node {}", thread.index());
        let started = threads.start(&name, move || run_node(context, thread, inbox));
        // `Threads` has the reason.
        if started { Ok(()) } else { Err(io::Error::other("no thread")) }
    };
    let pool = ThreadPoolBuilder::new().num_threads(context.header.speeds.len()).spawn_handler(start).build();
    context.start_parent(inboxes.parent, threads);
    // If a thread could not be started there is no pool, and the other threads are stopped already.
    let Ok(pool) = pool else { return };
    let whole = 0..context.header.division.atoms();
    // On the first node, which has the band. The pool ends when it is dropped.
    pool.broadcast(|thread| {
        if thread.index() == 0 {
            trace_split(context.shared, whole.clone());
        }
    });
}

thread_local! {
    /// The node of this thread, while the thread belongs to the pool.
    static NODE: RefCell<Option<PoolNode>> = const { RefCell::new(None) };
}

/// Runs a node on this thread: it waits for its band, joins the pool until that ends, and waits for its shutdown.
fn run_node(context: RunContext<'_>, thread: ThreadBuilder, inbox: Receiver<Envelope>) {
    let worker = context.worker(thread.index() as NodeId, inbox);
    let mut node =
        PoolNode { worker, handler: StealingHandler { received: 0, awaited: 1, unsent: Vec::new() }, panic: None };
    node.wait_for_message();
    NODE.set(Some(node));
    // Even if the run was stopped, since the pool waits for all its threads.
    thread.run();
    let Some(mut node) = NODE.take() else { return };
    if let Some(panic) = node.panic {
        panic::resume_unwind(panic);
    }
    node.wait_for_message();
    node.worker.end();
}

/// Traces these atoms, together with the threads that steal some of them.
fn trace_split(shared: &SharedRun, atoms: Range<Atom>) {
    if shared.is_stopped() {
        return;
    }
    if atoms.len() < 2 {
        return with_node(|node| atoms.for_each(|atom| node.trace(atom)));
    }
    let middle = atoms.start + (atoms.end - atoms.start) / 2;
    let (left, right) = (atoms.start..middle, middle..atoms.end);
    let (owner, since) = with_node(|node| (node.worker.id, node.worker.endpoint.time()));
    let trace_right = |context: FnContext| {
        if context.migrated() {
            with_node(|node| node.steal(owner, since, right.clone()));
        }
        trace_split(shared, right);
    };
    rayon_core::join_context(|_| trace_split(shared, left), trace_right);
}

/// Calls `f` with the node of this thread.
fn with_node<R>(f: impl FnOnce(&mut PoolNode) -> R) -> R {
    NODE.with_borrow_mut(|node| f(node.as_mut().expect("each thread of the pool has its node")))
}

/// A node of the pool.
struct PoolNode {
    worker: Worker,
    handler: StealingHandler,
    /// The tracer's panic. Rayon must not see it, since it would not say which thread has panicked.
    panic: Option<Box<dyn Any + Send>>,
}

impl PoolNode {
    /// Waits for the band, and at the next call for the shutdown; a late thread may get both at once. Returns early if
    /// the run is stopped, which the caller sees at its next step.
    fn wait_for_message(&mut self) {
        let _ = self.worker.work(&mut self.handler);
        self.handler.awaited += 1;
    }

    /// Takes over atoms that have waited at `owner` since `since`.
    fn steal(&mut self, owner: NodeId, since: Time, atoms: Range<Atom>) {
        // Rayon also reports a migration back to the owner, which is no theft.
        if owner == self.worker.id {
            return;
        }
        // The time of the search for these atoms is no cost of an atom.
        self.worker.skip();
        self.worker.endpoint.advance(self.worker.ready(since));
        self.worker.endpoint.record_taken(Party::Node(owner), Message::Transfer([atoms].into()));
    }

    fn trace(&mut self, atom: Atom) {
        let trace = || self.worker.trace_atom(atom, &mut self.handler);
        match panic::catch_unwind(AssertUnwindSafe(trace)) {
            // A thread without tasks may find nothing to steal for a long time: it sends its results before.
            Ok(Ok(())) if rayon_core::current_thread_has_pending_tasks() == Some(false) => {
                self.handler.send_results(&mut self.worker);
                self.worker.flush();
            }
            Ok(_) => {}
            Err(panic) => {
                self.panic = Some(panic);
                self.worker.endpoint.shared.stop();
            }
        }
    }
}

/// Handler of a worker in the pool.
struct StealingHandler {
    /// Number of messages received: the band is the first, the shutdown the second.
    received: u32,
    /// The worker waits while `received` is below this number.
    awaited: u32,
    /// Atoms that are traced and not sent.
    unsent: Vec<Range<Atom>>,
}

impl StealingHandler {
    fn send_results(&mut self, worker: &mut Worker) {
        if !self.unsent.is_empty() {
            let atoms = mem::take(&mut self.unsent);
            let pixels = worker.take_pixels(&atoms);
            worker.endpoint.send(Party::Parent, Message::Results(atoms), pixels);
        }
    }
}

impl WorkerHandler for StealingHandler {
    fn event(&mut self, event: Event, worker: &mut Worker) {
        match event {
            Event::Message { message: Message::Band(_) | Message::Shutdown, .. } => self.received += 1,
            Event::Timer => self.send_results(worker),
            other => unreachable!("no party sends {other:?} to a node of the pool"),
        }
    }

    fn traced(&mut self, atom: Atom, _: Duration, worker: &mut Worker) {
        if self.unsent.is_empty() {
            worker.endpoint.set_timer(worker.endpoint.time() + Rules::BATCH);
        }
        push_atom(&mut self.unsent, atom);
    }

    fn is_over(&self) -> bool {
        self.received >= self.awaited
    }
}
