//! Solids compiled for tracing: what can never be seen is gone, and every node knows its bounds.

use serde::Serialize;

use super::merge::Operation;
use super::{Leaf, Passes, Surface};
use crate::geometry::Aabb;

/// Solids compiled for tracing. A *root* is the number of one of them.
#[derive(Debug, Default)]
pub struct Tree {
    pub(super) leaves: Vec<Leaf>,
    pub(super) nodes: Vec<Node>,
    pub(super) reductions: Passes,
    pub(super) dropped: Dropped,
}

/// What was left out of solids, since nothing of it can be seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Dropped {
    /// Compositions that were proved empty.
    pub empty: usize,
    /// Operands of differences that take nothing away.
    pub out_of_reach: usize,
}

#[derive(Debug)]
pub(super) struct Node {
    pub bounds: Aabb,
    pub kind: NodeKind,
}

#[derive(Debug)]
pub(super) enum NodeKind {
    Leaf(u32),
    /// The intersection of convex leaves: one span at most, found without merging.
    Convex(Vec<u32>),
    Composition {
        operation: Operation,
        children: Vec<u32>,
    },
}

impl Tree {
    /// What was left out.
    pub fn dropped(&self) -> Dropped {
        self.dropped
    }

    /// How many boolean operations the solid `root` is made by: as few as it could be written with, since unions of unions
    /// are one, and so is a difference with the union that it takes away.
    pub fn operations_of(&self, root: u32) -> usize {
        match &self.nodes[root as usize].kind {
            NodeKind::Leaf(_) => 0,
            NodeKind::Convex(_) => 1,
            NodeKind::Composition { operation, children } => {
                let counted = |(index, &child): (usize, &u32)| {
                    let takes_unions = match operation {
                        Operation::Union => true,
                        Operation::Intersection => false,
                        Operation::Difference => index > 0,
                    };
                    let child_kind = &self.nodes[child as usize].kind;
                    let is_union = matches!(child_kind, NodeKind::Composition { operation: Operation::Union, .. });
                    self.operations_of(child) - usize::from(takes_unions && is_union)
                };
                1 + children.iter().enumerate().map(counted).sum::<usize>()
            }
        }
    }

    /// The leaf that a surface belongs to.
    pub fn leaf(&self, surface: Surface) -> &Leaf {
        &self.leaves[surface.leaf as usize]
    }

    /// Every leaf of the solid `root`.
    pub fn leaves_of(&self, root: u32) -> Vec<&Leaf> {
        match &self.nodes[root as usize].kind {
            NodeKind::Leaf(leaf) => vec![&self.leaves[*leaf as usize]],
            NodeKind::Convex(leaves) => leaves.iter().map(|&leaf| &self.leaves[leaf as usize]).collect(),
            NodeKind::Composition { children, .. } => {
                children.iter().flat_map(|&child| self.leaves_of(child)).collect()
            }
        }
    }

    /// The box of every leaf of the solid `root`, cut down to where the leaf can matter: the bounds of all
    /// compositions around it. Leaves that matter nowhere have none.
    pub fn boxes_of(&self, root: u32) -> Vec<Aabb> {
        let Node { bounds, kind } = &self.nodes[root as usize];
        let boxes: Vec<Aabb> = match kind {
            NodeKind::Leaf(_) => vec![*bounds],
            NodeKind::Convex(leaves) => vec![*bounds; leaves.len()],
            NodeKind::Composition { children, .. } => children.iter().flat_map(|&child| self.boxes_of(child)).collect(),
        };
        boxes.into_iter().map(|inner| inner.intersection(*bounds)).filter(|inner| !inner.is_empty()).collect()
    }
}
