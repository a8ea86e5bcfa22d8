//! A ray's stays in a solid and in all that it is made of (the article's Figure 2).

use super::compiled::Kind;
use super::{Event, Operation, Start, Surface, Tree};
use crate::geometry::Ray;

/// A ray's stays in a solid as it was compiled, and in its operands.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What the solid is.
    pub what: What,
    /// Where the ray enters and leaves it, in order; distances along the ray, which may be infinite or negative.
    pub stays: Vec<[f64; 2]>,
    /// What it is made of.
    pub operands: Vec<Figure>,
}

/// What a solid is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// A primitive.
    Primitive {
        /// Of its surface (which material it has).
        tag: u32,
        /// What kind it is.
        kind: &'static str,
    },
    /// A composition.
    Composition(Operation),
}

impl Tree {
    /// The stays of a whole line, of which `ray` is a part, in the solid `root` and in its operands. `start` is where the
    /// ray starts, if it starts on a solid.
    pub fn figure(&self, root: u32, ray: &Ray, start: Option<Start>) -> Figure {
        let start = start.filter(|start| start.root == root).map(|start| start.surface);
        self.figure_of_node(root, ray, start)
    }

    fn figure_of_node(&self, node: u32, ray: &Ray, start: Option<Surface>) -> Figure {
        const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
        let mut events: Vec<Event> = Vec::new();
        self.events(node, ray, start, EVERYWHERE, &mut events);
        let (what, operands) = match &self.nodes[node as usize].kind {
            Kind::Leaf(leaf) => (self.primitive(*leaf), Vec::new()),
            Kind::Convex(leaves) => {
                let operand = |&leaf: &u32| {
                    let spans = self.leaf_stays(leaf, ray, start);
                    Figure { what: self.primitive(leaf), stays: stays(&spans), operands: Vec::new() }
                };
                (What::Composition(Operation::Intersection), leaves.iter().map(operand).collect())
            }
            Kind::Composition { operation, children } => {
                let operands = children.iter().map(|&child| self.figure_of_node(child, ray, start)).collect();
                (What::Composition(*operation), operands)
            }
        };
        Figure { what, stays: stays(&events), operands }
    }

    fn primitive(&self, leaf: u32) -> What {
        let leaf = &self.leaves[leaf as usize];
        What::Primitive { tag: leaf.tag, kind: leaf.kind() }
    }
}

fn stays(events: &[Event]) -> Vec<[f64; 2]> {
    events.chunks_exact(2).map(|pair| [pair[0].t, pair[1].t]).collect()
}
