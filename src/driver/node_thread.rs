//! A node and its worker on one thread: the node's handler runs between two pieces of the worker's, and while it waits.
//!
//! One thread and not two, since the article's own complaint (§10) is that child and grandchild compete for the
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
    setting: RunContext<'run>,
    inboxes: Inboxes,
    threads: &mut Threads<'scope, '_, Stop>,
) {
    for (id, inbox) in (0..).zip(inboxes.nodes) {
        let node = move || run(setting.header, setting.worker(id, inbox));
        threads.start(&format!("node {id}"), node);
    }
    setting.start_parent(inboxes.parent, threads);
}

/// Runs a node on this thread until its shutdown, or until the run is stopped.
fn run(header: &Header, mut worker: Worker) {
    let _ = worker.work(&mut Handler::new(header, worker.id));
    worker.end();
}

/// A node's handler: it hands the node what happens, and carries out what that asks for.
pub(super) struct Handler {
    id: NodeId,
    nodes: NodeId,
    rules: Rules,
    node: Node,
    division: Division,
    actions: Vec<Action>,
    finished: bool,
}

impl Handler {
    /// The handler of node `id`.
    pub fn new(header: &Header, id: NodeId) -> Self {
        let (nodes, rules) = (header.speeds.len() as NodeId, header.rules);
        let node = Node::new(&rules, id, nodes);
        Self { id, nodes, rules, node, division: header.division, actions: Vec::new(), finished: false }
    }

    /// Hands the node an event. `pixels` are those of the atoms that are traced and not sent; the atoms that are to be
    /// traced go to `pipe`.
    pub fn hand_over(
        &mut self,
        event: Event,
        port: &mut Endpoint,
        pixels: &mut Vec<Colour>,
        mut pipe: impl FnMut(Atom),
    ) {
        let mut actions = mem::take(&mut self.actions);
        self.node.handle(port.time(), event, &mut actions);
        for action in actions.drain(..) {
            match action {
                Action::Send { to, message } => {
                    let pixels = match &message {
                        Message::Results(atoms) => take_pixels(pixels, self.division, atoms),
                        _ => Vec::new(),
                    };
                    port.send(to, message, pixels);
                }
                Action::Trace(atom) => pipe(atom),
                Action::SetTimer(at) => port.set_timer(at),
                Action::Retire => _ = port.record(RecordKind::Retired { node: self.id }),
                Action::Finish => self.finished = true,
                Action::Estimate | Action::Fail(_) => unreachable!("only the parent asks for {action:?}"),
            }
        }
        self.actions = actions;
    }

    /// Whether the node has nothing more to do.
    pub fn has_finished(&self) -> bool {
        self.finished
    }
}

impl WorkerHandler for Handler {
    fn event(&mut self, event: Event, worker: &mut Worker) {
        let (now, pipe) = (worker.port.time(), &mut worker.pipe);
        self.hand_over(event, &mut worker.port, &mut worker.pixels, |atom| pipe.push_back((atom, now)));
    }

    fn traced(&mut self, atom: Atom, cost: Duration, worker: &mut Worker) {
        self.event(Event::AtomDone { atom, cost }, worker);
    }

    fn failed(&mut self, atom: Atom, worker: &mut Worker) {
        self.event(Event::AtomFailed { atom }, worker);
    }

    fn lose_all(&mut self) {
        self.node = Node::new(&self.rules, self.id, self.nodes);
    }

    fn is_over(&self) -> bool {
        self.finished
    }

    fn is_void(&self) -> bool {
        self.finished
    }
}
