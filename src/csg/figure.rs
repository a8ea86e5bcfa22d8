//! A ray's stays in a solid and in all that it is made of (the article's Figure 2).

use super::coincidence::coincide;
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
        let mut figure = self.figure_of_node(root, ray, start);
        if start.is_none() && !figure.operands.is_empty() {
            figure.stays = stays(&self.without_slivers(&self.node_events(root, ray, start), ray));
        }
        figure
    }

    /// What a ray that starts elsewhere meets (see [`super::coincidence`]).
    fn without_slivers(&self, mut events: &[Event], ray: &Ray) -> Vec<Event> {
        let mut kept = Vec::new();
        while let [event, rest @ ..] = events {
            events = match rest {
                [next, rest @ ..] if coincide(&self.leaves, *event, *next, ray) => rest,
                _ => {
                    kept.push(*event);
                    rest
                }
            };
        }
        kept
    }

    fn node_events(&self, node: u32, ray: &Ray, start: Option<Surface>) -> Vec<Event> {
        const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
        let mut events = Vec::new();
        self.events(node, ray, start, EVERYWHERE, &mut events);
        events
    }

    fn figure_of_node(&self, node: u32, ray: &Ray, start: Option<Surface>) -> Figure {
        let events = self.node_events(node, ray, start);
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
