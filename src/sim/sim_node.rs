//! A node with its machine, in virtual time.

use std::collections::{BTreeMap, VecDeque};

use super::event_queue::InTransit;
use super::link::Link;
use super::machine::Machine;
use crate::balance::{Condition, Node, NodeId, Rules};
use crate::picture::Atom;
use crate::runlog::Header;
use crate::time::Time;

/// A node with its machine.
#[derive(Debug)]
pub(super) struct SimNode {
    pub node: Node,
    pub machine: Machine,
    pub pipe: VecDeque<Atom>,
    /// Whether the worker has begun the first atom in the pipe; one that stands still begins none.
    pub in_hand: bool,
    /// Counts the due times that the first was given.
    pub plan: u32,
    pub timer: Option<Time>,
    pub condition: Condition,
    /// What has arrived while the machine hangs.
    pub mailbox: Vec<InTransit>,
    /// Whether the user has paused the worker; a machine that hangs stands still too.
    pub paused: bool,
    pub finished: bool,
    /// By the receiver's place: to those that something was ever sent to.
    pub links: BTreeMap<usize, Link>,
}

impl SimNode {
    /// Node `id` of the run that `header` describes.
    pub fn new(header: &Header, id: NodeId) -> Self {
        Self {
            node: Node::new(&header.rules, id, header.speeds.len() as NodeId),
            machine: Machine::new(header.speeds[usize::from(id)], header.pace),
            pipe: VecDeque::new(),
            in_hand: false,
            plan: 0,
            timer: None,
            condition: if header.is_spare(id) { Condition::Off } else { Condition::Well },
            mailbox: Vec::new(),
            paused: false,
            finished: false,
            links: BTreeMap::new(),
        }
    }

    /// The machine is switched off: what it had is lost.
    pub fn lose_all(&mut self, rules: &Rules, id: NodeId, nodes: NodeId, now: Time) {
        self.node = Node::new(rules, id, nodes);
        self.machine.finish(now);
        self.pipe.clear();
        self.in_hand = false;
        self.plan = self.plan.wrapping_add(1);
        self.timer = None;
    }
}
