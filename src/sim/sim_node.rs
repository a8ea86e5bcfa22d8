//! A node and its machine, in virtual time.

use std::collections::{BTreeMap, VecDeque};

use super::event_queue::InTransit;
use super::link::Link;
use super::machine::Machine;
use crate::balance::{Condition, Node, NodeId, Rules};
use crate::picture::Atom;
use crate::runlog::Header;
use crate::time::Time;

/// A node and its machine.
#[derive(Debug)]
pub(super) struct SimNode {
    pub node: Node,
    pub machine: Machine,
    pub pipe: VecDeque<Atom>,
    /// Whether the worker has begun the first atom in the pipe; a worker that stands still begins none.
    pub in_hand: bool,
    /// Number of due times that the first atom in the pipe has had; only the last one counts.
    pub due_version: u32,
    pub timer: Option<Time>,
    pub condition: Condition,
    /// Messages that have arrived while the machine hangs.
    pub mailbox: Vec<InTransit>,
    /// Whether the user has paused the worker; a machine that hangs stands still too.
    pub paused: bool,
    pub finished: bool,
    /// Links to the receivers so far, by node; the parent's has the key [`usize::MAX`].
    pub links: BTreeMap<usize, Link>,
}

impl SimNode {
    /// Creates node `id` of the run that `header` describes.
    pub fn new(header: &Header, id: NodeId) -> Self {
        Self {
            node: Node::new(&header.rules, id, header.speeds.len() as NodeId),
            machine: Machine::new(header.speeds[usize::from(id)], header.pace),
            pipe: VecDeque::new(),
            in_hand: false,
            due_version: 0,
            timer: None,
            condition: if header.is_spare(id) { Condition::Off } else { Condition::Well },
            mailbox: Vec::new(),
            paused: false,
            finished: false,
            links: BTreeMap::new(),
        }
    }

    /// Switches the machine off: its memory is lost, and a new node will start.
    pub fn lose_memory(&mut self, rules: &Rules, id: NodeId, nodes: NodeId, now: Time) {
        self.node = Node::new(rules, id, nodes);
        self.machine.finish(now);
        self.pipe.clear();
        self.in_hand = false;
        self.due_version = self.due_version.wrapping_add(1);
        self.timer = None;
    }
}
