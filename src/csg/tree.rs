//! The compiled tree: solids without their invisible parts, and bounds for every node.

use serde::Serialize;

use super::id::NodeIndex;
use super::merge::Operation;
use super::{Leaf, LeafIndex, Passes, RootId, Surface};
use crate::geometry::{Aabb, BoxFrame, Boxes};

/// Solids compiled for tracing. A *root* is the number of one of them.
#[derive(Debug, Default)]
pub struct Tree {
    pub(super) leaves: Vec<Leaf>,
    pub(super) nodes: Vec<Node>,
    pub(super) passes: Passes,
    pub(super) dropped: DroppedCounts,
    /// Of the boxes in the nodes; none until [`Tree::finish`].
    pub(super) frame: Option<BoxFrame>,
}

/// The number of parts that were dropped because they cannot be seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct DroppedCounts {
    /// Compositions that were proved empty.
    pub empty: usize,
    /// Operands of differences that subtract nothing.
    pub out_of_reach: usize,
}

#[derive(Debug)]
pub(super) struct Node {
    pub bounds: Aabb,
    pub kind: NodeKind,
}

#[derive(Clone, Debug)]
pub(super) enum NodeKind {
    Leaf(LeafIndex),
    /// The intersection of convex leaves: at most one span, found without merging.
    Convex(Vec<LeafIndex>),
    Composition {
        operation: Operation,
        children: Vec<NodeIndex>,
        /// The boxes of the children, in groups; empty where a test of each is as good.
        boxes: Vec<Boxes>,
    },
}

impl Tree {
    /// The number of parts that were dropped.
    pub fn dropped(&self) -> DroppedCounts {
        self.dropped
    }

    /// Counts the boolean operations of the solid `root`, at the least number that can express it: nested unions count
    /// as one, and a difference and the union that it subtracts count as one.
    pub fn operations_of(&self, root: RootId) -> usize {
        self.operations_in(root.node())
    }

    fn operations_in(&self, node: NodeIndex) -> usize {
        match &self.nodes[node.index()].kind {
            NodeKind::Leaf(_) => 0,
            NodeKind::Convex(_) => 1,
            NodeKind::Composition { operation, children, .. } => {
                let counted = |(index, &child): (usize, &NodeIndex)| {
                    let takes_unions = match operation {
                        Operation::Union => true,
                        Operation::Intersection => false,
                        Operation::Difference => index > 0,
                    };
                    let child_kind = &self.nodes[child.index()].kind;
                    let is_union = matches!(child_kind, NodeKind::Composition { operation: Operation::Union, .. });
                    self.operations_in(child) - usize::from(takes_unions && is_union)
                };
                1 + children.iter().enumerate().map(counted).sum::<usize>()
            }
        }
    }

    /// The leaf to which a surface belongs.
    pub fn leaf(&self, surface: Surface) -> &Leaf {
        &self.leaves[surface.leaf.index()]
    }

    /// All leaves of the solid `root`.
    pub fn leaves_of(&self, root: RootId) -> Vec<&Leaf> {
        self.leaves_in(root.node())
    }

    fn leaves_in(&self, node: NodeIndex) -> Vec<&Leaf> {
        match &self.nodes[node.index()].kind {
            NodeKind::Leaf(leaf) => vec![&self.leaves[leaf.index()]],
            NodeKind::Convex(leaves) => leaves.iter().map(|&leaf| &self.leaves[leaf.index()]).collect(),
            NodeKind::Composition { children, .. } => {
                children.iter().flat_map(|&child| self.leaves_in(child)).collect()
            }
        }
    }

    /// The box of every leaf of the solid `root`, clipped to the bounds of all compositions around the leaf: elsewhere
    /// the leaf cannot matter. Leaves whose clipped box is empty are left out.
    pub fn boxes_of(&self, root: RootId) -> Vec<Aabb> {
        self.boxes_in(root.node())
    }

    fn boxes_in(&self, node: NodeIndex) -> Vec<Aabb> {
        let Node { bounds, kind } = &self.nodes[node.index()];
        let boxes: Vec<Aabb> = match kind {
            NodeKind::Leaf(_) => vec![*bounds],
            NodeKind::Convex(leaves) => vec![*bounds; leaves.len()],
            NodeKind::Composition { children, .. } => children.iter().flat_map(|&child| self.boxes_in(child)).collect(),
        };
        boxes.into_iter().map(|inner| inner.intersection(*bounds)).filter(|inner| !inner.is_empty()).collect()
    }
}
