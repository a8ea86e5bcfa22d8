//! What is cut: links, and nodes that nothing reaches.

use std::collections::BTreeSet;

use crate::balance::{NodeId, Party};

/// Links that are cut, and nodes that are cut off from all others.
#[derive(Clone, Debug, Default)]
pub struct Cuts {
    /// The lesser party first.
    links: BTreeSet<(Party, Party)>,
    nodes: BTreeSet<NodeId>,
}

impl Cuts {
    /// Cuts the link between two parties, in both directions, or mends it. Whether that changes anything.
    pub fn cut_link(&mut self, one: Party, other: Party, is_cut: bool) -> bool {
        change(&mut self.links, link(one, other), is_cut)
    }

    /// Cuts a node off from all others, or no longer.
    pub fn cut_off(&mut self, node: NodeId, is_cut_off: bool) {
        change(&mut self.nodes, node, is_cut_off);
    }

    /// Whether nothing travels between the two. What a party sends to itself goes no way.
    pub fn is_cut(&self, one: Party, other: Party) -> bool {
        let is_cut_off = |party| matches!(party, Party::Node(node) if self.nodes.contains(&node));
        one != other && (self.links.contains(&link(one, other)) || is_cut_off(one) || is_cut_off(other))
    }
}

fn link(one: Party, other: Party) -> (Party, Party) {
    (one.min(other), one.max(other))
}

/// Has it among them, or not. Whether that is new.
fn change<T: Ord>(all: &mut BTreeSet<T>, one: T, is_in: bool) -> bool {
    if is_in { all.insert(one) } else { all.remove(&one) }
}
