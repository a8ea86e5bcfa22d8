//! A ray's spans in a solid and in all its operands (the article's Figure 2).

use super::coincidence::{coincide, drop_slivers};
use super::id::NodeIndex;
use super::merge::merge;
use super::tree::NodeKind;
use super::{Crossing, LeafIndex, MaterialTag, Operation, RayStart, RootId, Surface, Tree};
use crate::geometry::Ray;

/// A ray's spans in a compiled solid, and in its operands.
#[derive(Clone, Debug, PartialEq)]
pub struct SpanDiagram {
    /// The kind of solid.
    pub kind: SolidKind,
    /// Where the ray enters and leaves it, in order; distances along the ray, which may be infinite or negative.
    pub spans: Vec<[f64; 2]>,
    /// The operands; none for a primitive.
    pub operands: Vec<SpanDiagram>,
}

/// The kind of a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolidKind {
    /// A primitive.
    Primitive {
        /// The tag of its surface: in a scene, its material.
        tag: MaterialTag,
        /// The name of its shape.
        kind: &'static str,
    },
    /// A composition.
    Composition(Operation),
}

impl Tree {
    /// The spans of the whole line through `ray` in the solid `root` and in its operands. `start` is the surface on
    /// which the ray starts, if it starts on one.
    pub fn span_diagram(&self, root: RootId, ray: &Ray, start: Option<RayStart>) -> SpanDiagram {
        let start = start.filter(|start| start.root == root).map(|start| start.surface);
        let mut crossings = self.node_crossings(root.node(), ray, start);
        // Slivers are dropped, as for a ray.
        let is_leaf = matches!(self.nodes[root.node().index()].kind, NodeKind::Leaf(_));
        if start.is_none() && !is_leaf {
            drop_slivers(&mut crossings, |earlier, later| coincide(&self.leaves, earlier, later, ray));
        }
        self.node_diagram(root.node(), &crossings, ray, start)
    }

    /// The crossings of a node by itself, without the boxes that leave out what does not matter to its solid.
    fn node_crossings(&self, node: NodeIndex, ray: &Ray, start: Option<Surface>) -> Vec<Crossing> {
        match &self.nodes[node.index()].kind {
            NodeKind::Leaf(leaf) => self.leaf_crossings(*leaf, ray, start),
            NodeKind::Convex(leaves) => self.convex_span(leaves, ray, start).into_iter().flatten().collect(),
            NodeKind::Composition { operation, children, .. } => {
                let mut crossings = Vec::new();
                for (index, &child) in children.iter().enumerate() {
                    let second = crossings.len();
                    crossings.extend(self.node_crossings(child, ray, start));
                    if index > 0 {
                        merge(*operation, &mut crossings, 0, second, ray);
                    }
                }
                crossings
            }
        }
    }

    /// The diagram of a node with these crossings.
    fn node_diagram(&self, node: NodeIndex, crossings: &[Crossing], ray: &Ray, start: Option<Surface>) -> SpanDiagram {
        let (kind, operands) = match &self.nodes[node.index()].kind {
            NodeKind::Leaf(leaf) => (self.primitive(*leaf), Vec::new()),
            NodeKind::Convex(leaves) => {
                let operand = |&leaf: &LeafIndex| {
                    let crossings = self.leaf_crossings(leaf, ray, start);
                    SpanDiagram { kind: self.primitive(leaf), spans: spans_of(&crossings), operands: Vec::new() }
                };
                (SolidKind::Composition(Operation::Intersection), leaves.iter().map(operand).collect())
            }
            NodeKind::Composition { operation, children, .. } => {
                let operand =
                    |&child: &NodeIndex| self.node_diagram(child, &self.node_crossings(child, ray, start), ray, start);
                (SolidKind::Composition(*operation), children.iter().map(operand).collect())
            }
        };
        SpanDiagram { kind, spans: spans_of(crossings), operands }
    }

    fn primitive(&self, leaf: LeafIndex) -> SolidKind {
        let leaf = &self.leaves[leaf.index()];
        SolidKind::Primitive { tag: leaf.tag, kind: leaf.kind() }
    }
}

fn spans_of(crossings: &[Crossing]) -> Vec<[f64; 2]> {
    crossings.chunks_exact(2).map(|pair| [pair[0].t, pair[1].t]).collect()
}
