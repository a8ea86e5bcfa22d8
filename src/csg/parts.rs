//! Parts that together look like a solid: the unions inside its differences and intersections are brought to the top,
//! (a ∪ b) − c = (a − c) ∪ (b − c), and each part keeps only what its bounds reach.
//!
//! So a ray tests a few small parts, the nearest first, instead of merging the spans of a large tree. These are the
//! local trees of Romeiro, Velho and de Figueiredo (*Hardware-assisted Rendering of CSG Models*, 2006), found once for
//! each part instead of for each cell of space. Parts share their nodes and leaves.

use super::id::NodeIndex;
use super::merge::Operation;
use super::tree::{Node, NodeKind, Tree};
use super::{LeafIndex, Pass, RootId};
use crate::geometry::Aabb;

/// Solids with fewer parts are traced faster whole: their parts would share most of what is subtracted.
const MIN_PARTS: usize = 64;
/// What is subtracted from a part is listed one by one up to this many; more stay the union that they are.
const MAX_TAKEN: usize = 8;

/// A part: a node, and what is done to it, in this order.
#[derive(Clone)]
struct Part {
    core: NodeIndex,
    steps: Vec<Step>,
    bounds: Aabb,
}

#[derive(Clone, Copy, PartialEq)]
enum Step {
    Subtract(NodeIndex),
    /// Intersects with a node that stands behind the part.
    Intersect(NodeIndex),
    /// Intersects with a node that stands before it.
    IntersectBehind(NodeIndex),
}

impl Tree {
    /// Divides the solid `root` into parts, each with a box. Only for a solid that no ray enters: the boundaries
    /// between its parts are there, too. A solid stays whole where its parts might look different: a face of `a` that
    /// lies in `b` is seen where it coincides with one of `c`.
    pub fn parts(&mut self, root: RootId, bounds: Aabb) -> Vec<(RootId, Aabb)> {
        let mut parts = self.parts_of(root.node());
        if parts.len() < MIN_PARTS || !parts.iter().all(|part| self.looks_the_same(part)) {
            return vec![(root, bounds)];
        }
        // Of coincident faces that of the first leaf is seen.
        parts.sort_by_cached_key(|part| self.first_leaf(part.core));
        parts.into_iter().map(|part| (RootId(self.add_part(&part).0), part.bounds)).collect()
    }

    fn parts_of(&self, node: NodeIndex) -> Vec<Part> {
        let Node { bounds, kind } = &self.nodes[node.index()];
        let whole = || vec![Part { core: node, steps: Vec::new(), bounds: *bounds }];
        let NodeKind::Composition { operation, children, .. } = kind else { return whole() };
        match operation {
            Operation::Union => children.iter().flat_map(|&child| self.parts_of(child)).collect(),
            Operation::Difference => {
                let mut parts = self.parts_of(children[0]);
                if parts.len() == 1 {
                    return whole();
                }
                for part in &mut parts {
                    for &taken in &children[1..] {
                        let mut within_reach = Vec::new();
                        self.find_within_reach(taken, part.bounds, &mut within_reach);
                        let taken = if within_reach.len() > MAX_TAKEN { vec![taken] } else { within_reach };
                        part.steps.extend(taken.into_iter().map(Step::Subtract));
                    }
                }
                parts
            }
            Operation::Intersection => {
                let divided = children.iter().map(|&child| self.parts_of(child)).enumerate();
                let Some((place, mut parts)) = divided.into_iter().find(|(_, parts)| parts.len() > 1) else {
                    return whole();
                };
                for part in &mut parts {
                    part.bounds = part.bounds.intersection(*bounds);
                    for (index, &other) in children.iter().enumerate().filter(|&(index, _)| index != place) {
                        if !self.surrounds(other, part.bounds) {
                            let is_behind = index < place;
                            part.steps.push(if is_behind {
                                Step::IntersectBehind(other)
                            } else {
                                Step::Intersect(other)
                            });
                        }
                    }
                }
                parts.retain(|part| !part.bounds.is_empty());
                parts
            }
        }
    }

    /// Finds the operands of a union, or the node itself, whose boxes meet this one.
    fn find_within_reach(&self, node: NodeIndex, reach: Aabb, found: &mut Vec<NodeIndex>) {
        let Node { bounds, kind } = &self.nodes[node.index()];
        if bounds.intersection(reach).is_empty() || found.len() > MAX_TAKEN {
            return;
        }
        match kind {
            NodeKind::Composition { operation: Operation::Union, children, .. } => {
                children.iter().for_each(|&child| self.find_within_reach(child, reach, found));
            }
            _ => found.push(node),
        }
    }

    /// Whether a box lies in a convex node, clearly.
    fn surrounds(&self, node: NodeIndex, bounds: Aabb) -> bool {
        /// Far more than the tolerance of a ray that starts a thousand times the box's size away.
        const ROOM: f64 = 1e-6;
        let room = (bounds.max - bounds.min) * ROOM;
        let [min, max] = [bounds.min - room, bounds.max + room];
        let is_in = |leaf: &LeafIndex| {
            let leaf = &self.leaves[leaf.index()];
            leaf.is_convex()
                && (0..8_usize).all(|corner| {
                    let side = |axis: usize| if corner >> axis & 1 == 0 { min[axis] } else { max[axis] };
                    leaf.contains([side(0), side(1), side(2)].into())
                })
        };
        bounds.is_finite()
            && match &self.nodes[node.index()].kind {
                NodeKind::Leaf(leaf) => is_in(leaf),
                NodeKind::Convex(leaves) => leaves.iter().all(is_in),
                NodeKind::Composition { .. } => false,
            }
    }

    /// Whether the same faces are seen as in the whole, or faces that look the same, where some coincide. The faces of
    /// what stands before a part are seen in any case.
    fn looks_the_same(&self, part: &Part) -> bool {
        let core = self.leaves_of(RootId(part.core.0));
        part.steps.iter().all(|step| {
            let (Step::Subtract(node) | Step::Intersect(node)) = step else { return true };
            let others = self.leaves_of(RootId(node.0));
            core.iter().all(|leaf| others.iter().all(|other| leaf.tag == other.tag || !leaf.may_share_face(other)))
        })
    }

    fn first_leaf(&self, node: NodeIndex) -> Option<LeafIndex> {
        match &self.nodes[node.index()].kind {
            NodeKind::Leaf(leaf) => Some(*leaf),
            NodeKind::Convex(leaves) => leaves.first().copied(),
            NodeKind::Composition { children, .. } => children.iter().filter_map(|&child| self.first_leaf(child)).min(),
        }
    }

    /// Adds the nodes of a part. Even a part to which nothing is done gets a new one: solids are in the order of
    /// their nodes.
    fn add_part(&mut self, part: &Part) -> NodeIndex {
        let mut node = self.push(self.nodes[part.core.index()].kind.clone(), part.bounds);
        for steps in part.steps.chunk_by(|a, b| matches!((a, b), (Step::Subtract(_), Step::Subtract(_)))) {
            let (operation, mut children) = match *steps {
                [Step::Intersect(other)] => (Operation::Intersection, vec![node, other]),
                [Step::IntersectBehind(other)] => (Operation::Intersection, vec![other, node]),
                _ => {
                    let taken = steps
                        .iter()
                        .map(|&(Step::Subtract(node) | Step::Intersect(node) | Step::IntersectBehind(node))| node);
                    (Operation::Difference, std::iter::once(node).chain(taken).collect())
                }
            };
            if operation == Operation::Intersection && self.passes.has(Pass::ConvexSpans) {
                self.join_convex(&mut children);
            }
            node = match children[..] {
                [only] => only,
                _ => self.push(NodeKind::Composition { operation, children, boxes: Vec::new() }, part.bounds),
            };
            self.nodes[node.index()].bounds = part.bounds;
        }
        node
    }
}
