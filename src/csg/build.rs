//! Compilation of solids: drops parts that can never be seen, and brings every composition into the form in which a
//! ray needs least work.

use super::bounds::Extent;
use super::id::NodeIndex;
use super::merge::Operation;
use super::outline::{Outline, OutlineKind};
use super::tree::{Node, NodeKind, Tree};
use super::{LeafIndex, Pass, Passes, RootId, Solid};
use crate::geometry::{Aabb, BoxFrame, Boxes, WIDTH, split, split_into};

/// A union of more operands than this becomes a tree of unions.
const MAX_FLAT_OPERANDS: usize = WIDTH;

impl Tree {
    /// An empty tree, to which solids are added by these passes.
    pub fn new(passes: Passes) -> Self {
        Self { passes, ..Self::default() }
    }

    /// Compiles a solid. Returns its root and a box around it, or nothing if the solid is proved empty.
    pub fn add(&mut self, solid: &Solid) -> Option<(RootId, Aabb)> {
        let outline = Outline::new(solid, self.passes);
        self.add_node(outline, &Extent::ALL).map(|(node, bounds)| (RootId(node.0), bounds))
    }

    /// Adds a solid that has to be right within `around` only.
    fn add_node(&mut self, outline: Outline, around: &Extent) -> Option<(NodeIndex, Aabb)> {
        let finds_bounds = self.passes.has(Pass::FoundBounds);
        let narrowed = |mut extent: Extent| {
            if finds_bounds {
                extent.add(around);
                extent.close();
            }
            extent
        };
        let upper = outline.upper.unwrap_or_else(|| outline.extent.clone());
        let within = narrowed(outline.extent);
        let (operation, operands) = match outline.kind {
            OutlineKind::Leaf(leaf) => {
                let index = LeafIndex(self.leaves.len() as u32);
                self.leaves.push(*leaf);
                return Some((self.push(NodeKind::Leaf(index), within.bounds), within.bounds));
            }
            OutlineKind::Composition(operation, operands) => (operation, operands),
        };
        let mut children: Vec<NodeIndex> = Vec::new();
        let mut bounds = if operation == Operation::Intersection { within.bounds } else { Aabb::EMPTY };
        // A union's operands matter wherever each of them is. Other operands matter only within the extent without
        // subtractions: elsewhere one of them is missing.
        let inner = if operation == Operation::Union { around.clone() } else { narrowed(upper) };
        for (index, operand) in operands.into_iter().enumerate() {
            let child = self.add_node(operand, &inner);
            match operation {
                Operation::Union => {
                    let Some((child, child_bounds)) = child else { continue };
                    bounds = bounds.union(child_bounds);
                    children.push(child);
                }
                Operation::Intersection => {
                    let (child, child_bounds) = child?;
                    bounds = bounds.intersection(child_bounds);
                    if bounds.is_empty() && self.passes.has(Pass::CullEmpty) {
                        self.dropped.empty += 1;
                        return None;
                    }
                    children.push(child);
                }
                Operation::Difference if index == 0 => {
                    let (child, child_bounds) = child?;
                    bounds = child_bounds;
                    children.push(child);
                }
                Operation::Difference => {
                    let Some((child, child_bounds)) = child else { continue };
                    if bounds.intersection(child_bounds).is_empty() && self.passes.has(Pass::CullEmpty) {
                        self.dropped.out_of_reach += 1;
                    } else {
                        children.push(child);
                    }
                }
            }
        }
        if children.is_empty() {
            return None;
        }
        match operation {
            Operation::Union => return Some((self.union_of(&children), bounds)),
            Operation::Intersection if self.passes.has(Pass::ConvexSpans) => self.join_convex(&mut children),
            Operation::Difference if children.len() - 1 > MAX_FLAT_OPERANDS && self.passes.has(Pass::UnionTrees) => {
                let taken = self.union_of(&children[1..]);
                children.splice(1.., [taken]);
            }
            Operation::Intersection | Operation::Difference => {}
        }
        match children[..] {
            [only] => {
                self.nodes[only.index()].bounds = bounds;
                Some((only, bounds))
            }
            _ => {
                let bounds = bounds.intersection(within.bounds);
                Some((self.push(NodeKind::Composition { operation, children, boxes: Vec::new() }, bounds), bounds))
            }
        }
    }

    /// Makes the union of at least one node. A union of many becomes a tree of unions of neighbours: a ray visits only
    /// those near it, and their spans are merged with few others instead of with all that were found before.
    fn union_of(&mut self, parts: &[NodeIndex]) -> NodeIndex {
        let mut boxes: Vec<_> = parts.iter().map(|&part| (part, self.nodes[part.index()].bounds)).collect();
        self.union_tree(&mut boxes, 0)
    }

    fn union_tree(&mut self, parts: &mut [(NodeIndex, Aabb)], depth: u32) -> NodeIndex {
        if let [(only, _)] = parts {
            return *only;
        }
        let bounds = parts.iter().fold(Aabb::EMPTY, |all, (_, bounds)| all.union(*bounds));
        let is_tree = parts.len() > MAX_FLAT_OPERANDS && self.passes.has(Pass::UnionTrees);
        let children = if is_tree {
            let halve = |parts: &mut [_], depth| Some(split(parts, depth).unwrap_or(parts.len() / 2));
            let groups = split_into(parts, depth, MAX_FLAT_OPERANDS, halve);
            groups.into_iter().map(|(group, depth)| self.union_tree(group, depth)).collect()
        } else {
            parts.iter().map(|(part, _)| *part).collect()
        };
        self.push(NodeKind::Composition { operation: Operation::Union, children, boxes: Vec::new() }, bounds)
    }

    /// Joins the convex leaves at the beginning of an intersection's operands into one operand.
    pub(super) fn join_convex(&mut self, children: &mut Vec<NodeIndex>) {
        let mut leaves = Vec::new();
        let mut bounds = Aabb::ALL;
        let mut joined = 0;
        for &child in &*children {
            let Node { kind, bounds: child_bounds } = &self.nodes[child.index()];
            match kind {
                NodeKind::Leaf(leaf) if self.leaves[leaf.index()].is_convex() => leaves.push(*leaf),
                NodeKind::Convex(inner) => leaves.extend(inner),
                _ => break,
            }
            bounds = bounds.intersection(*child_bounds);
            joined += 1;
        }
        if joined > 1 {
            let convex = self.push(NodeKind::Convex(leaves), bounds);
            children.splice(..joined, [convex]);
        }
    }

    /// Removes the bounds of all nodes unless [`Pass::CompositionBounds`] is on, and with them groups the boxes of
    /// compositions with many operands, so that a ray tests them together.
    pub fn finish(&mut self) {
        if !self.passes.has(Pass::CompositionBounds) {
            self.nodes.iter_mut().for_each(|node| node.bounds = Aabb::ALL);
            return;
        }
        let finite = self.nodes.iter().map(|node| node.bounds).filter(|bounds| bounds.is_finite());
        let frame = BoxFrame::new(finite.fold(Aabb::EMPTY, Aabb::union));
        let bounds: Vec<Aabb> = self.nodes.iter().map(|node| node.bounds).collect();
        for node in &mut self.nodes {
            let NodeKind::Composition { operation, children, boxes } = &mut node.kind else { continue };
            let tested = match operation {
                Operation::Union => &children[..],
                Operation::Difference => &children[1..],
                // Each operand of an intersection leaves less for the next.
                Operation::Intersection => &[],
            };
            if tested.len() > 2 {
                *boxes = tested
                    .chunks(WIDTH)
                    .map(|group| {
                        let mut boxes = Boxes::NONE;
                        group.iter().for_each(|child| boxes.add(bounds[child.index()], &frame));
                        boxes
                    })
                    .collect();
            }
        }
        self.frame = Some(frame);
    }

    pub(super) fn push(&mut self, kind: NodeKind, bounds: Aabb) -> NodeIndex {
        let index = NodeIndex(self.nodes.len() as u32);
        self.nodes.push(Node { bounds, kind });
        index
    }
}
