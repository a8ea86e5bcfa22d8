//! Traversal of the compiled tree by a ray: its spans in a solid, and its crossings of the solid's boundary.

use super::boundary::{Hit, RayStart, visit_crossings, visit_span};
use super::coincidence::{coincide, drop_slivers};
use super::id::NodeIndex;
use super::merge::{Operation, merge};
use super::span::{Span, Spans};
use super::tree::{Node, NodeKind};
use super::{Crossing, LeafIndex, RootId, Surface, Tree};
use crate::geometry::{BoxRay, Boxes, Ray, WIDTH, fast_max, fast_min};

/// Scratch memory for the crossings of one ray, two for each span.
pub type Stack = Vec<Crossing>;

impl Tree {
    /// Finds the first crossing of the boundary of the solid `root` before `t_max`; see [`Tree::crossings`].
    #[inline(always)]
    pub fn nearest(
        &self,
        root: RootId,
        ray: &Ray,
        start: Option<RayStart>,
        t_max: f64,
        is_inside: bool,
        stack: &mut Stack,
    ) -> Option<Hit> {
        let mut found = None;
        self.crossings(root, ray, start, t_max, is_inside, stack, |hit| {
            found = Some(hit);
            false
        });
        found
    }

    /// Visits the crossings of the boundary of the solid `root` between the ray's start and `t_max`, in order, until
    /// `visit` returns false. `is_inside` tells whether the ray is in the solid at first.
    #[expect(clippy::too_many_arguments, reason = "the ray, its range and its state, and scratch memory")]
    #[inline(always)]
    pub fn crossings(
        &self,
        root: RootId,
        ray: &Ray,
        start: Option<RayStart>,
        t_max: f64,
        is_inside: bool,
        stack: &mut Stack,
        visit: impl FnMut(Hit) -> bool,
    ) {
        let start = start.filter(|start| start.root == root).map(|start| start.surface);
        // At edges and coincident faces rounding alone may leave a sliver, inside or outside the solid; it is dropped.
        // A ray that starts on this solid starts exactly on the face, and may be inside for any short distance.
        let is_sliver =
            |earlier: Crossing, later: Crossing| start.is_none() && coincide(&self.leaves, earlier, later, ray);
        let slack = ray.tolerance(0.0);
        stack.clear();
        let span = match &self.nodes[root.node().index()].kind {
            NodeKind::Leaf(leaf) => match self.leaf_spans(*leaf, ray, start) {
                Spans { first: None, second: None } => return,
                Spans { first: Some(span), second: None } | Spans { first: None, second: Some(span) } => {
                    Some(span_crossings(*leaf, span))
                }
                Spans { first: Some(first), second: Some(second) } => {
                    stack.extend([first, second].into_iter().flat_map(|span| span_crossings(*leaf, span)));
                    None
                }
            },
            NodeKind::Convex(leaves) => match self.convex_span(leaves, ray, start) {
                Some([enter, leave]) if !is_sliver(enter, leave) => Some([enter, leave]),
                _ => return,
            },
            NodeKind::Composition { operation, children, boxes } => {
                let window = [-2.0 * slack, t_max + ray.tolerance(t_max)];
                // The caller has tested the bounds.
                let line = Line { ray, start, single: self.frame.as_ref().map(|frame| frame.ray(ray)) };
                self.push_composition_crossings(*operation, (children, boxes), &line, window, stack);
                drop_slivers(stack, is_sliver);
                None
            }
        };
        match span {
            Some([enter, leave]) if enter.t > slack => visit_span([enter, leave], t_max, is_inside, visit),
            Some([_, leave]) if leave.t <= -slack => {}
            Some(span) => visit_crossings(&span, ray, start, t_max, is_inside, visit),
            None => visit_crossings(stack, ray, start, t_max, is_inside, visit),
        }
    }

    /// Pushes the crossings of a node. May leave out spans outside `window`.
    #[inline(always)]
    fn push_crossings(&self, node: NodeIndex, line: &Line<'_>, window: [f64; 2], stack: &mut Stack) {
        let Node { bounds, kind } = &self.nodes[node.index()];
        if bounds.entry(line.ray, window[0], window[1]).is_some() {
            self.push_crossings_within_bounds(kind, line, window, stack);
        }
    }

    /// Does the same for a ray that is known to meet the node's bounds.
    #[inline(always)]
    fn push_crossings_within_bounds(&self, kind: &NodeKind, line: &Line<'_>, window: [f64; 2], stack: &mut Stack) {
        let Line { ray, start, .. } = *line;
        let mut push = |[enter, leave]: [Crossing; 2]| {
            if leave.t >= window[0] && enter.t <= window[1] {
                stack.extend([enter, leave]);
            }
        };
        match kind {
            NodeKind::Leaf(leaf) => {
                let Spans { first, second } = self.leaf_spans(*leaf, ray, start);
                if let Some(span) = first {
                    push(span_crossings(*leaf, span));
                }
                if let Some(span) = second {
                    push(span_crossings(*leaf, span));
                }
            }
            NodeKind::Convex(leaves) => {
                if let Some(span) = self.convex_span(leaves, ray, start) {
                    push(span);
                }
            }
            NodeKind::Composition { operation, children, boxes } => {
                self.push_composition_crossings(*operation, (children, boxes), line, window, stack);
            }
        }
    }

    fn push_composition_crossings(
        &self,
        operation: Operation,
        (children, boxes): (&[NodeIndex], &[Boxes]),
        line: &Line<'_>,
        mut window: [f64; 2],
        stack: &mut Stack,
    ) {
        let first = stack.len();
        let ray = line.ray;
        if let Some(single) = line.single.as_ref().filter(|_| !boxes.is_empty()) {
            let mut tested = children;
            if let Some((minuend, others)) = children.split_first().filter(|_| operation == Operation::Difference) {
                self.push_crossings_within_bounds(&self.nodes[minuend.index()].kind, line, window, stack);
                if !narrow(&mut window, &stack[first..], ray) {
                    return;
                }
                tested = others;
            }
            for (group, boxes) in tested.chunks(WIDTH).zip(boxes) {
                let range = window.map(|t| single.place(t));
                let mut met = single.meets(boxes, range, &mut [0.0; WIDTH]);
                while met != 0 {
                    let child = group[met.trailing_zeros() as usize];
                    met &= met - 1;
                    let second = stack.len();
                    self.push_crossings_within_bounds(&self.nodes[child.index()].kind, line, window, stack);
                    merge(operation, stack, first, second, ray);
                }
            }
            return;
        }
        for (index, &child) in children.iter().enumerate() {
            let second = stack.len();
            if index == 0 && operation == Operation::Difference {
                // The bounds of a difference are those of its first operand.
                self.push_crossings_within_bounds(&self.nodes[child.index()].kind, line, window, stack);
            } else {
                self.push_crossings(child, line, window, stack);
                if index > 0 {
                    merge(operation, stack, first, second, ray);
                }
            }
            if operation != Operation::Union && !narrow(&mut window, &stack[first..], ray) {
                return;
            }
        }
    }

    /// The crossings of a leaf over the whole line.
    pub(super) fn leaf_crossings(&self, leaf: LeafIndex, ray: &Ray, start: Option<Surface>) -> Vec<Crossing> {
        let Spans { first, second } = self.leaf_spans(leaf, ray, start);
        [first, second].into_iter().flatten().flat_map(|span| span_crossings(leaf, span)).collect()
    }

    #[inline(always)]
    fn leaf_spans(&self, leaf: LeafIndex, ray: &Ray, start: Option<Surface>) -> Spans {
        self.leaves[leaf.index()].spans(ray, start_face(start, leaf))
    }

    /// Finds the one span of a ray in the intersection of convex leaves. As in [`merge`], of coincident faces the first
    /// leaf's is seen, and a span shorter than the tolerance is dropped.
    pub(super) fn convex_span(&self, leaves: &[LeafIndex], ray: &Ray, start: Option<Surface>) -> Option<[Crossing; 2]> {
        let (&first, others) = leaves.split_first()?;
        let [mut enter, mut leave] = span_crossings(first, self.leaf_spans(first, ray, start).first?);
        if leave.t <= enter.t + ray.tolerance(enter.t) {
            return None;
        }
        for &leaf in others {
            let [from, to] = span_crossings(leaf, self.leaf_spans(leaf, ray, start).first?);
            if from.t > enter.t + ray.tolerance(from.t) || enter.t == f64::NEG_INFINITY {
                enter = from;
            }
            if to.t < leave.t - ray.tolerance(to.t) || leave.t == f64::INFINITY {
                leave = to;
            }
            if leave.t <= enter.t + ray.tolerance(enter.t) {
                return None;
            }
        }
        Some([enter, leave])
    }
}

/// A ray's line through a solid.
struct Line<'a> {
    ray: &'a Ray,
    /// The face of the solid that the ray starts on, if any.
    start: Option<Surface>,
    /// The ray in single precision, to test many boxes; none for a tree without such boxes.
    single: Option<BoxRay>,
}

/// Narrows a window to the spans of the first operand: outside them nothing can change the result any more. Returns
/// false if there are none.
#[inline(always)]
fn narrow(window: &mut [f64; 2], spans: &[Crossing], ray: &Ray) -> bool {
    let (Some(enter), Some(leave)) = (spans.first(), spans.last()) else { return false };
    if enter.t.is_finite() {
        window[0] = fast_max(window[0], enter.t - 2.0 * ray.tolerance(enter.t));
    }
    if leave.t.is_finite() {
        window[1] = fast_min(window[1], leave.t + 2.0 * ray.tolerance(leave.t));
    }
    true
}

#[inline(always)]
fn span_crossings(leaf: LeafIndex, span: Span) -> [Crossing; 2] {
    let crossing = |t: f64, face: u8| Crossing { t, surface: Surface { leaf, face } };
    [crossing(span.from, span.from_face), crossing(span.to, span.to_face)]
}

/// The face of `leaf` that a ray starts on.
#[inline(always)]
fn start_face(start: Option<Surface>, leaf: LeafIndex) -> Option<u8> {
    start.filter(|surface| surface.leaf == leaf).map(|surface| surface.face)
}
