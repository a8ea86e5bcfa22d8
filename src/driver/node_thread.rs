//! A node and its worker on one thread: the node's handler runs between two pieces of the worker's, and while the
//! worker waits.
//!
//! One thread instead of two, since the article itself complains (§10) that child and grandchild compete for the
//! processor.

use std::mem;
use std::time::Duration;

use super::endpoint::Endpoint;
use super::run_context::RunContext;
use super::shared::Inboxes;
use super::supervisor::Threads;
use super::worker::{Worker, WorkerHandler, take_pixels};
use crate::balance::{Action, Event, Message, Node, NodeId, Rules};
use crate::picture::{Atom, Colour, Division};
use crate::record::RecordKind;
use crate::runlog::Header;

/// Starts a thread for each node, and the parent's.
pub(super) fn start<'scope, 'run: 'scope, Stop: Fn() + Copy + Send + 'scope>(
    context: RunContext<'run>,
    inboxes: Inboxes,
    threads: &mut Threads<'scope, '_, Stop>,
) {
    for (id, inbox) in (0..).zip(inboxes.nodes) {
        let node = move || run(context.header, context.worker(id, inbox));
        threads.start(&format!("node {id}"), node);
    }
    context.start_parent(inboxes.parent, threads);
}

/// Runs a node on this thread until its shutdown, or until the run is stopped.
fn run(header: &Header, mut worker: Worker) {
    let _ = worker.work(&mut NodeHandler::new(header, worker.id));
    worker.end();
}

/// A node's handler: it hands events to the node and executes its actions.
pub(super) struct NodeHandler {
    id: NodeId,
    nodes: NodeId,
    rules: Rules,
    node: Node,
    division: Division,
    actions: Vec<Action>,
    finished: bool,
}

impl NodeHandler {
    /// Creates the handler of node `id`.
    pub fn new(header: &Header, id: NodeId) -> Self {
        let (nodes, rules) = (header.speeds.len() as NodeId, header.rules.clone());
        let node = Node::new(&rules, id, nodes);
        Self { id, nodes, rules, node, division: header.division, actions: Vec::new(), finished: false }
    }

    /// Hands an event to the node and executes its actions. `pixels` are those of the atoms that are traced and not
    /// sent; atoms to trace go to `pipe`.
    pub fn handle_event(
        &mut self,
        event: Event,
        endpoint: &mut Endpoint,
        pixels: &mut Vec<Colour>,
        mut pipe: impl FnMut(Atom),
    ) {
        let mut actions = mem::take(&mut self.actions);
        self.node.handle(endpoint.time(), event, &mut actions);
        for action in actions.drain(..) {
            match action {
                Action::Send { to, message } => {
                    let pixels = match &message {
                        Message::Results(atoms) => take_pixels(pixels, self.division, atoms),
                        _ => Vec::new(),
                    };
                    endpoint.send(to, message, pixels);
                }
                Action::Trace(atom) => pipe(atom),
                Action::SetTimer(at) => endpoint.set_timer(at),
                Action::Retire => _ = endpoint.record(RecordKind::Retired { node: self.id }),
                Action::Finish => self.finished = true,
                Action::Estimate | Action::Fail(_) => unreachable!("only the parent asks for {action:?}"),
            }
        }
        self.actions = actions;
    }

    /// Returns whether the node has ended.
    pub fn has_finished(&self) -> bool {
        self.finished
    }
}

impl WorkerHandler for NodeHandler {
    fn event(&mut self, event: Event, worker: &mut Worker) {
        let (now, pipe) = (worker.endpoint.time(), &mut worker.pipe);
        self.handle_event(event, &mut worker.endpoint, &mut worker.pixels, |atom| pipe.push_back((atom, now)));
    }

    fn traced(&mut self, atom: Atom, cost: Duration, worker: &mut Worker) {
        self.event(Event::AtomDone { atom, cost }, worker);
    }

    fn failed(&mut self, atom: Atom, worker: &mut Worker) {
        self.event(Event::AtomFailed { atom }, worker);
    }

    fn lose_memory(&mut self) {
        self.node = Node::new(&self.rules, self.id, self.nodes);
    }

    fn is_over(&self) -> bool {
        self.finished
    }

    fn is_atom_unneeded(&self) -> bool {
        self.finished
    }
}
