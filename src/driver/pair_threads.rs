//! A node on two threads, as in the article (§8): one for its handler, and one for its worker, which gets its atoms
//! through a pipe. The two compete for the processor (§10); this driver measures how much.
//!
//! The worker records when it begins and ends an atom, the handler what it sends and receives. Each delivers its
//! records separately, in the order of time.

use std::mem;
use std::time::Duration;

use crossbeam_channel::Receiver;

use super::endpoint::{Endpoint, Incoming, Stopped};
use super::node_thread::NodeHandler;
use super::run_context::RunContext;
use super::shared::{Content, Envelope, Inboxes, WorkerOrder};
use super::supervisor::Threads;
use super::worker::{Worker, WorkerHandler};
use crate::balance::{Event, NodeId, Party};
use crate::picture::Atom;

/// Starts two threads for each node, and the parent's.
pub(super) fn start<'scope, 'run: 'scope, Stop: Fn() + Copy + Send + 'scope>(
    context: RunContext<'run>,
    inboxes: Inboxes,
    threads: &mut Threads<'scope, '_, Stop>,
) {
    for ((id, inbox), pipe) in (0..).zip(inboxes.nodes).zip(inboxes.workers) {
        threads.start(&format!("node {id}"), move || run_handler(context, id, inbox));
        threads.start(&format!("worker {id}"), move || run_worker(context, id, pipe));
    }
    context.start_parent(inboxes.parent, threads);
}

/// Runs the handler of node `id` on this thread, then ends its worker.
fn run_handler(context: RunContext<'_>, id: NodeId, inbox: Receiver<Envelope>) {
    let mut endpoint = context.endpoint(Party::Node(id), inbox);
    let _ = handle(context, id, &mut endpoint);
    pipe(context, id, &endpoint, WorkerOrder::End);
    endpoint.flush();
}

fn handle(context: RunContext<'_>, id: NodeId, endpoint: &mut Endpoint) -> Result<(), Stopped> {
    let mut handler = NodeHandler::new(context.header, id);
    let (mut pixels, mut atoms) = (Vec::new(), Vec::new());
    while !handler.has_finished() {
        let now = endpoint.step(Endpoint::flush)?;
        match endpoint.next(now) {
            Some(Incoming::Event(event, traced)) => {
                pixels.extend(traced);
                handler.handle_event(event, endpoint, &mut pixels, |atom| atoms.push(atom));
                atoms.drain(..).for_each(|atom| pipe(context, id, endpoint, WorkerOrder::Trace(atom)));
            }
            Some(Incoming::Command(_) | Incoming::WorkerOrder(_)) => unreachable!("only the worker gets these"),
            None => endpoint.wait(None),
        }
    }
    Ok(())
}

/// Puts an order into the pipe of a node's worker.
fn pipe(context: RunContext<'_>, id: NodeId, endpoint: &Endpoint, order: WorkerOrder) {
    context.shared.deliver(context.shared.worker_index(id), endpoint.time(), Content::WorkerOrder(order));
}

/// Runs the worker of node `id` on this thread until its handler ends it.
fn run_worker(context: RunContext<'_>, id: NodeId, pipe: Receiver<Envelope>) {
    let mut worker = context.worker(id, pipe);
    let _ = worker.work(&mut PipeHandler { ended: false });
    worker.end();
}

/// Handler of a worker that has its own thread.
struct PipeHandler {
    ended: bool,
}

impl WorkerHandler for PipeHandler {
    fn event(&mut self, event: Event, _: &mut Worker) {
        unreachable!("only the handler gets {event:?}");
    }

    fn order(&mut self, order: WorkerOrder, worker: &mut Worker) {
        match order {
            WorkerOrder::Trace(atom) => worker.pipe.push_back((atom, worker.endpoint.time())),
            WorkerOrder::End => self.ended = true,
        }
    }

    fn traced(&mut self, atom: Atom, cost: Duration, worker: &mut Worker) {
        send_to_node(Event::AtomDone { atom, cost }, worker);
    }

    fn failed(&mut self, atom: Atom, worker: &mut Worker) {
        send_to_node(Event::AtomFailed { atom }, worker);
    }

    fn is_over(&self) -> bool {
        self.ended
    }
}

/// Sends the worker's event to its node, with the pixels.
fn send_to_node(event: Event, worker: &mut Worker) {
    let pixels = mem::take(&mut worker.pixels);
    let node = worker.endpoint.shared.index(Party::Node(worker.id));
    worker.endpoint.shared.deliver(node, worker.endpoint.time(), Content::WorkerEvent { event, pixels });
}
