//! The farm (§6.2): the picture is divided into more parts than there are nodes, and a node without atoms asks the
//! parent for the next part.

use std::ops::Range;

use super::message::{Action, Event, Message, NodeId, Party};
use super::static_node;
use super::work::Work;
use crate::picture::Atom;
use crate::time::Time;

/// The parent's side of a farm: the atoms that no node has been given yet.
#[derive(Debug)]
pub(super) struct Parts {
    rest: Range<Atom>,
    /// Atoms in a part.
    part: u32,
    by_speed: bool,
    /// By node: the number of atoms in its last part, and in all parts before.
    given: Vec<(u32, u32)>,
}

impl Parts {
    /// Creates the parts of `atoms` atoms, `part` atoms each (0 counts as 1); with `by_speed` slower nodes get smaller
    /// parts.
    pub fn new(atoms: Atom, nodes: NodeId, part: u32, by_speed: bool) -> Self {
        Self { rest: 0..atoms, part: part.max(1), by_speed, given: vec![(0, 0); usize::from(nodes)] }
    }

    /// Returns the next part for `node`, which has traced its last one; an empty part if there are no more atoms.
    ///
    /// *By speed*: all nodes began together, so the number of atoms that a node has traced tells its speed, as in the
    /// ring. A node that has traced half as many as the fastest gets parts half as large.
    pub fn next(&mut self, node: NodeId) -> Range<Atom> {
        let most = self.given.iter().map(|(_, done)| *done).max().unwrap_or_default();
        let (last, done) = &mut self.given[usize::from(node)];
        *done += *last;
        let mut size = self.part;
        if self.by_speed && *done > 0 {
            let share = f64::from(*done) / f64::from(most.max(*done));
            size = ((f64::from(self.part) * share).round() as u32).max(1);
        }
        let end = self.rest.end.min(self.rest.start.saturating_add(size));
        let part = std::mem::replace(&mut self.rest.start, end)..end;
        *last = part.len() as u32;
        part
    }
}

/// A node of a farm: a static node that asks for more atoms.
#[derive(Debug)]
pub(super) struct FarmNode {
    base: static_node::StaticNode,
}

impl FarmNode {
    /// Creates a node with this work, which has no atoms yet.
    pub fn new(work: Work) -> Self {
        Self { base: static_node::StaticNode::new(work) }
    }

    /// Handles `event` at the time `now` and appends its answer to `actions`.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        match event {
            Event::Message { message: Message::Part(atoms), .. } if atoms.is_empty() => actions.push(Action::Retire),
            Event::Message { message: Message::Part(atoms), .. } => self.base.work.add([atoms], actions),
            event => {
                let may_run_out =
                    matches!(event, Event::AtomDone { .. } | Event::Message { message: Message::Band(_), .. });
                self.base.handle(now, event, actions);
                if may_run_out && self.base.work.is_idle() {
                    actions.push(Action::Send { to: Party::Parent, message: Message::Request });
                }
            }
        }
    }
}
