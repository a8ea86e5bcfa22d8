//! A ray's stays in a solid and in all that it is made of (the article's Figure 2).

use super::coincidence::{coincide, without_slivers};
use super::id::NodeIndex;
use super::tree::NodeKind;
use super::{Crossing, LeafIndex, MaterialTag, Operation, RayStart, RootId, Surface, Tree};
use crate::geometry::Ray;

/// A ray's stays in a solid as it was compiled, and in its operands.
#[derive(Clone, Debug, PartialEq)]
pub struct SpanDiagram {
    /// What the solid is.
    pub what: SolidKind,
    /// Where the ray enters and leaves it, in order; distances along the ray, which may be infinite or negative.
    pub stays: Vec<[f64; 2]>,
    /// What it is made of.
    pub operands: Vec<SpanDiagram>,
}

/// What a solid is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolidKind {
    /// A primitive.
    Primitive {
        /// Of its surface (which material it has).
        tag: MaterialTag,
        /// What kind it is.
        kind: &'static str,
    },
    /// A composition.
    Composition(Operation),
}

impl Tree {
    /// The stays of a whole line, of which `ray` is a part, in the solid `root` and in its operands. `start` is where the
    /// ray starts, if it starts on a solid.
    pub fn figure(&self, root: RootId, ray: &Ray, start: Option<RayStart>) -> SpanDiagram {
        let start = start.filter(|start| start.root == root).map(|start| start.surface);
        let mut events = self.node_events(root.node(), ray, start);
        // As a ray meets them.
        let is_leaf = matches!(self.nodes[root.node().index()].kind, NodeKind::Leaf(_));
        if start.is_none() && !is_leaf {
            let are_one = |earlier, later| coincide(&self.leaves, earlier, later, ray);
            events = without_slivers(&events, are_one).collect();
        }
        self.figure_of(root.node(), &events, ray, start)
    }

    fn node_events(&self, node: NodeIndex, ray: &Ray, start: Option<Surface>) -> Vec<Crossing> {
        const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
        let mut events = Vec::new();
        self.events(node, ray, start, EVERYWHERE, &mut events);
        events
    }

    /// The figure of a node with these events.
    fn figure_of(&self, node: NodeIndex, events: &[Crossing], ray: &Ray, start: Option<Surface>) -> SpanDiagram {
        let (what, operands) = match &self.nodes[node.index()].kind {
            NodeKind::Leaf(leaf) => (self.primitive(*leaf), Vec::new()),
            NodeKind::Convex(leaves) => {
                let operand = |&leaf: &LeafIndex| {
                    let spans = self.leaf_stays(leaf, ray, start);
                    SpanDiagram { what: self.primitive(leaf), stays: stays(&spans), operands: Vec::new() }
                };
                (SolidKind::Composition(Operation::Intersection), leaves.iter().map(operand).collect())
            }
            NodeKind::Composition { operation, children } => {
                let operand =
                    |&child: &NodeIndex| self.figure_of(child, &self.node_events(child, ray, start), ray, start);
                (SolidKind::Composition(*operation), children.iter().map(operand).collect())
            }
        };
        SpanDiagram { what, stays: stays(events), operands }
    }

    fn primitive(&self, leaf: LeafIndex) -> SolidKind {
        let leaf = &self.leaves[leaf.index()];
        SolidKind::Primitive { tag: leaf.tag, kind: leaf.kind() }
    }
}

fn stays(events: &[Crossing]) -> Vec<[f64; 2]> {
    events.chunks_exact(2).map(|pair| [pair[0].t, pair[1].t]).collect()
}
