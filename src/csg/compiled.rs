//! A scene's solids, compiled: what can never be seen is gone, and every composition knows its bounds.

use super::merge::{Operation, merge};
use super::shape::Span;
use super::{Event, Leaf, Solid, Surface};
use crate::geometry::{Aabb, Ray};

/// Solids compiled for tracing. A *root* is the number of one of them.
#[derive(Debug, Default)]
pub struct Tree {
    leaves: Vec<Leaf>,
    nodes: Vec<Node>,
}

/// Where a ray first crosses the boundary of a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, at least 0.
    pub t: f64,
    /// The face that it crosses.
    pub surface: Surface,
    /// The solid (not the leaf) is entered; else left.
    pub enters: bool,
}

/// Where a ray that does not come from the camera starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The root that was hit.
    pub root: u32,
    /// Its face.
    pub surface: Surface,
}

/// Scratch memory for the spans of one ray.
pub type Stack = Vec<Event>;

#[derive(Debug)]
enum Node {
    Leaf(u32),
    Composition { operation: Operation, bounds: Aabb, children: Vec<u32> },
}

impl Tree {
    /// Adds a solid. Gives its root and the box that holds it, or nothing if it can be proved empty.
    pub fn add(&mut self, solid: &Solid) -> Option<(u32, Aabb)> {
        let (operation, solids) = match solid {
            Solid::Placed { primitive, scene_from_own, tag } => {
                let (leaf, bounds) = Leaf::new(primitive, scene_from_own, *tag);
                self.leaves.push(leaf);
                return Some((self.node(Node::Leaf(self.leaves.len() as u32 - 1)), bounds));
            }
            Solid::Union(solids) => (Operation::Union, solids),
            Solid::Intersection(solids) => (Operation::Intersection, solids),
            Solid::Difference(solids) => (Operation::Difference, solids),
        };
        let mut children: Vec<u32> = Vec::new();
        let mut bounds = if operation == Operation::Intersection { Aabb::ALL } else { Aabb::EMPTY };
        for (index, solid) in solids.iter().enumerate() {
            let child = self.add(solid);
            match operation {
                Operation::Union => {
                    let Some((child, child_bounds)) = child else { continue };
                    bounds = bounds.union(child_bounds);
                    self.absorb(Operation::Union, child, &mut children);
                }
                Operation::Intersection => {
                    let (child, child_bounds) = child?;
                    bounds = bounds.intersection(child_bounds);
                    if bounds.is_empty() {
                        return None;
                    }
                    self.absorb(Operation::Intersection, child, &mut children);
                }
                Operation::Difference if index == 0 => {
                    let (child, child_bounds) = child?;
                    bounds = child_bounds;
                    // (a − b) − c = a − b − c
                    self.absorb(Operation::Difference, child, &mut children);
                }
                Operation::Difference => {
                    let Some((child, child_bounds)) = child else { continue };
                    // What does not reach the first operand takes nothing from it.
                    if !bounds.intersection(child_bounds).is_empty() {
                        // a − (b ∪ c) = a − b − c
                        self.absorb(Operation::Union, child, &mut children);
                    }
                }
            }
        }
        match children[..] {
            [] => None,
            [only] => Some((only, bounds)),
            _ => Some((self.node(Node::Composition { operation, bounds, children }), bounds)),
        }
    }

    /// The leaf that a surface belongs to.
    pub fn leaf(&self, surface: Surface) -> &Leaf {
        &self.leaves[surface.leaf as usize]
    }

    /// Every leaf of the solid `root`.
    pub fn leaves_of(&self, root: u32) -> Vec<&Leaf> {
        match &self.nodes[root as usize] {
            Node::Leaf(leaf) => vec![&self.leaves[*leaf as usize]],
            Node::Composition { children, .. } => {
                children.iter().flat_map(|&child| self.leaves_of(child)).collect()
            }
        }
    }

    /// Where `ray` first crosses the boundary of the solid `root` before `t_max`.
    #[inline]
    pub fn nearest(&self, root: u32, ray: &Ray, start: Option<Start>, t_max: f64, stack: &mut Stack) -> Option<Hit> {
        let mut found = None;
        self.crossings(root, ray, start, t_max, stack, |hit| {
            found = Some(hit);
            false
        });
        found
    }

    /// Hands over every crossing of the boundary of the solid `root` between the ray's start and `t_max`, in order,
    /// until `visit` answers false.
    #[inline]
    pub fn crossings(
        &self,
        root: u32,
        ray: &Ray,
        start: Option<Start>,
        t_max: f64,
        stack: &mut Stack,
        mut visit: impl FnMut(Hit) -> bool,
    ) {
        let slack = ray.tolerance(0.0);
        // A ray that starts on this solid does not meet it there again. On any other solid it may: what touches the
        // solid it starts on is entered at 0, on whichever side of 0 rounding puts that.
        let on_this = start.is_some_and(|start| start.root == root);
        let counts = |t: f64, enters: bool| t < t_max && t > if enters && !on_this { -slack } else { slack };
        let start = start.filter(|_| on_this).map(|start| start.surface);
        match &self.nodes[root as usize] {
            Node::Leaf(leaf) => {
                let spans = self.leaves[*leaf as usize].spans(ray, face_of(start, *leaf));
                for span in [spans.first, spans.second].into_iter().flatten() {
                    for (t, face, enters) in [(span.from, span.from_face, true), (span.to, span.to_face, false)] {
                        let surface = Surface { leaf: *leaf, face };
                        if counts(t, enters) && !visit(Hit { t: t.max(0.0), surface, enters }) {
                            return;
                        }
                    }
                }
            }
            Node::Composition { .. } => {
                stack.clear();
                let window = [-2.0 * slack, t_max + ray.tolerance(t_max)];
                self.events(root, ray, start, window, stack);
                for (index, event) in stack.iter().enumerate() {
                    let enters = index % 2 == 0;
                    let hit = Hit { t: event.t.max(0.0), surface: event.surface, enters };
                    if counts(event.t, enters) && !visit(hit) {
                        return;
                    }
                }
            }
        }
    }

    /// Pushes the events of a node. Spans that lie outside `window` may be left out.
    fn events(&self, node: u32, ray: &Ray, start: Option<Surface>, window: [f64; 2], stack: &mut Stack) {
        let (operation, bounds, children) = match &self.nodes[node as usize] {
            Node::Leaf(leaf) => return self.leaf_events(*leaf, ray, start, window, stack),
            Node::Composition { operation, bounds, children } => (*operation, bounds, children),
        };
        if bounds.entry(ray, window[0], window[1]).is_none() {
            return;
        }
        let first = stack.len();
        let mut window = window;
        for (index, &child) in children.iter().enumerate() {
            let second = stack.len();
            self.events(child, ray, start, window, stack);
            if index > 0 {
                merge(operation, stack, first, second, ray);
            }
            if operation != Operation::Union {
                // Nothing outside the first operand's spans can matter any more.
                let (Some(enter), Some(leave)) = (stack.get(first), stack.last()) else { return };
                if enter.t.is_finite() {
                    window[0] = window[0].max(enter.t - 2.0 * ray.tolerance(enter.t));
                }
                if leave.t.is_finite() {
                    window[1] = window[1].min(leave.t + 2.0 * ray.tolerance(leave.t));
                }
            }
        }
    }

    fn leaf_events(&self, leaf: u32, ray: &Ray, start: Option<Surface>, window: [f64; 2], stack: &mut Stack) {
        let spans = self.leaves[leaf as usize].spans(ray, face_of(start, leaf));
        for Span { from, from_face, to, to_face } in [spans.first, spans.second].into_iter().flatten() {
            if to >= window[0] && from <= window[1] {
                stack.push(Event { t: from, surface: Surface { leaf, face: from_face } });
                stack.push(Event { t: to, surface: Surface { leaf, face: to_face } });
            }
        }
    }

    fn node(&mut self, node: Node) -> u32 {
        self.nodes.push(node);
        self.nodes.len() as u32 - 1
    }

    /// Adds `child`, or its children in its place if it is a composition by `operation`.
    fn absorb(&self, operation: Operation, child: u32, children: &mut Vec<u32>) {
        match &self.nodes[child as usize] {
            Node::Composition { operation: same, children: inner, .. } if *same == operation => {
                children.extend(inner);
            }
            _ => children.push(child),
        }
    }
}

/// The face of `leaf` that a ray starts on.
fn face_of(start: Option<Surface>, leaf: u32) -> Option<u8> {
    start.filter(|surface| surface.leaf == leaf).map(|surface| surface.face)
}
