//! A node on two threads, as the article has it (§8): one for its handler, and one for its worker, which is fed through
//! a pipe. They compete for the processor (§10); this is here so that one can measure how much.
//!
//! The worker tells when it began and ended an atom, and the handler what it has sent and received: their records are
//! told apart, each in the order of time.

use std::mem;
use std::time::Duration;

use crossbeam_channel::Receiver;

use super::endpoint::{Endpoint, Incoming, Stopped};
use super::node_thread::Handler;
use super::run_context::RunContext;
use super::shared::{Content, Inboxes, Parcel, WorkerOrder};
use super::supervisor::Threads;
use super::worker::{Worker, WorkerHandler};
use crate::balance::{Event, NodeId, Party};
use crate::picture::Atom;

/// Starts two threads for each node, and the parent's.
pub(super) fn start<'scope, 'run: 'scope, Stop: Fn() + Copy + Send + 'scope>(
    setting: RunContext<'run>,
    inboxes: Inboxes,
    threads: &mut Threads<'scope, '_, Stop>,
) {
    for ((id, inbox), pipe) in (0..).zip(inboxes.nodes).zip(inboxes.workers) {
        threads.start(&format!("node {id}"), move || run_handler(setting, id, inbox));
        threads.start(&format!("worker {id}"), move || run_worker(setting, id, pipe));
    }
    setting.start_parent(inboxes.parent, threads);
}

/// Runs the handler of node `id` on this thread, then ends its worker.
fn run_handler(setting: RunContext<'_>, id: NodeId, inbox: Receiver<Parcel>) {
    let mut port = setting.port(Party::Node(id), inbox);
    let _ = handle(setting, id, &mut port);
    pipe(setting, id, &port, WorkerOrder::End);
    port.flush();
}

fn handle(setting: RunContext<'_>, id: NodeId, port: &mut Endpoint) -> Result<(), Stopped> {
    let mut handler = Handler::new(setting.header, id);
    let (mut pixels, mut atoms) = (Vec::new(), Vec::new());
    while !handler.has_finished() {
        let now = port.step(Endpoint::flush)?;
        match port.next(now) {
            Some(Incoming::Event(event, traced)) => {
                pixels.extend(traced);
                handler.hand_over(event, port, &mut pixels, |atom| atoms.push(atom));
                atoms.drain(..).for_each(|atom| pipe(setting, id, port, WorkerOrder::Trace(atom)));
            }
            Some(Incoming::Command(_) | Incoming::WorkerOrder(_)) => unreachable!("these are for the worker"),
            None => port.wait(None),
        }
    }
    Ok(())
}

/// Puts something into the pipe of a node's worker.
fn pipe(setting: RunContext<'_>, id: NodeId, port: &Endpoint, order: WorkerOrder) {
    setting.shared.deliver(setting.shared.worker(id), port.time(), Content::WorkerOrder(order));
}

/// Runs the worker of node `id` on this thread until its node ends it.
fn run_worker(setting: RunContext<'_>, id: NodeId, pipe: Receiver<Parcel>) {
    let mut worker = setting.worker(id, pipe);
    let _ = worker.work(&mut Piped { ended: false });
    worker.end();
}

/// What a worker does that has a thread of its own.
struct Piped {
    ended: bool,
}

impl WorkerHandler for Piped {
    fn event(&mut self, event: Event, _: &mut Worker) {
        unreachable!("{event:?} is for the handler");
    }

    fn order(&mut self, order: WorkerOrder, worker: &mut Worker) {
        match order {
            WorkerOrder::Trace(atom) => worker.pipe.push_back((atom, worker.port.time())),
            WorkerOrder::End => self.ended = true,
        }
    }

    fn traced(&mut self, atom: Atom, cost: Duration, worker: &mut Worker) {
        tell(Event::AtomDone { atom, cost }, worker);
    }

    fn failed(&mut self, atom: Atom, worker: &mut Worker) {
        tell(Event::AtomFailed { atom }, worker);
    }

    fn is_over(&self) -> bool {
        self.ended
    }
}

/// Tells the worker's node what has become of an atom, and hands over the pixels.
fn tell(event: Event, worker: &mut Worker) {
    let pixels = mem::take(&mut worker.pixels);
    let node = worker.port.shared.index(Party::Node(worker.id));
    worker.port.shared.deliver(node, worker.port.time(), Content::Worked { event, pixels });
}
