//! The farm (§6.2): the picture is cut into more parts than there are nodes; a free node asks, the parent answers.

use std::ops::Range;

use super::message::{Action, Event, Message, NodeId, Party};
use super::static_node;
use super::work::Work;
use crate::picture::Atom;
use crate::time::Time;

/// The parent's share in a farm: the atoms that no node has been given yet.
#[derive(Debug)]
pub(super) struct Parts {
    rest: Range<Atom>,
    /// Atoms in a part.
    part: u32,
    by_speed: bool,
    /// By node: the atoms of its last part, and those of all before.
    given: Vec<(u32, u32)>,
}

impl Parts {
    /// All of so many `atoms`, in parts of `part` (0 counts as 1); *by speed* the parts of slower nodes are smaller.
    pub fn new(atoms: Atom, nodes: NodeId, part: u32, by_speed: bool) -> Self {
        Self { rest: 0..atoms, part: part.max(1), by_speed, given: vec![(0, 0); usize::from(nodes)] }
    }

    /// The next part for `node`, which is done with its last; an empty one if there are no more.
    ///
    /// *By speed*, what a node has traced tells how fast it is, as in the ring, since all began together: one that has
    /// traced half as much as the first of them gets parts half as large.
    pub fn next(&mut self, node: NodeId) -> Range<Atom> {
        let first = self.given.iter().map(|(_, done)| *done).max().unwrap_or_default();
        let (last, done) = &mut self.given[usize::from(node)];
        *done += *last;
        let mut size = self.part;
        if self.by_speed && *done > 0 {
            let share = f64::from(*done) / f64::from(first.max(*done));
            size = ((f64::from(self.part) * share).round() as u32).max(1);
        }
        let end = self.rest.end.min(self.rest.start.saturating_add(size));
        let part = std::mem::replace(&mut self.rest.start, end)..end;
        *last = part.len() as u32;
        part
    }
}

/// A node of a farm: one on its own that asks for more.
#[derive(Debug)]
pub(super) struct FarmNode {
    solo: static_node::StaticNode,
}

impl FarmNode {
    /// A node with this work, which is none yet.
    pub fn new(work: Work) -> Self {
        Self { solo: static_node::StaticNode::new(work) }
    }

    /// Answers `event`, which happens at `now`, by appending to `actions`.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        match event {
            Event::Message { message: Message::Part(atoms), .. } if atoms.is_empty() => actions.push(Action::Retire),
            Event::Message { message: Message::Part(atoms), .. } => self.solo.work.add([atoms], actions),
            event => {
                let may_run_out =
                    matches!(event, Event::AtomDone { .. } | Event::Message { message: Message::Band(_), .. });
                self.solo.handle(now, event, actions);
                if may_run_out && self.solo.work.is_idle() {
                    actions.push(Action::Send { to: Party::Parent, message: Message::Request });
                }
            }
        }
    }
}
