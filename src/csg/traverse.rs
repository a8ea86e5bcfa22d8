//! Traversal of the compiled tree by a ray: its spans in a solid, and its crossings of the solid's boundary.

use super::coincidence::{coincide, without_slivers};
use super::id::NodeIndex;
use super::merge::{Operation, merge};
use super::span::Span;
use super::tree::{Node, NodeKind};
use super::{Crossing, LeafIndex, RootId, Surface, Tree};
use crate::geometry::{Ray, fast_max, fast_min};

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
pub struct RayStart {
    /// The root that was hit.
    pub root: RootId,
    /// Its face.
    pub surface: Surface,
    /// Whether the solid is left there, as seen along the ray that came.
    pub exits: bool,
    /// Whether this ray turns back to where that one came from.
    pub reversed: bool,
}

/// Where in the scene's own order a crossing stands among those at the same place.
///
/// Boundaries of solids that touch lie at one place, and rounding puts them in any order along a ray. If a ray took
/// them as they came it would cross some twice and some never, so they have one order: what is entered comes before
/// what is left, and then what stands first in the scene. A ray that turns back there passes them in reverse.
pub fn tie_break(root: RootId, enters: bool, reversed: bool) -> (bool, RootId) {
    (enters == reversed, root)
}

impl RayStart {
    /// Whether the ray has yet to cross the boundary of another solid at the same place.
    fn is_before(&self, root: RootId, enters: bool) -> bool {
        let (here, other) = ((self.exits, self.root), tie_break(root, enters, self.reversed));
        if self.reversed { other < here } else { other > here }
    }
}

/// Scratch memory for the spans of one ray.
pub type Stack = Vec<Crossing>;

impl Tree {
    /// Where `ray` first crosses the boundary of the solid `root` before `t_max`.
    #[inline]
    pub fn nearest(
        &self,
        root: RootId,
        ray: &Ray,
        start: Option<RayStart>,
        t_max: f64,
        stack: &mut Stack,
    ) -> Option<Hit> {
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
        root: RootId,
        ray: &Ray,
        start: Option<RayStart>,
        t_max: f64,
        stack: &mut Stack,
        mut visit: impl FnMut(Hit) -> bool,
    ) {
        let slack = ray.tolerance(0.0);
        // A ray that starts on this solid does not report it there again. On any other solid it may: of what touches
        // the solid that it starts on, it meets at 0 what it has not passed, on whichever side of 0 rounding puts it.
        let on_this = start.is_some_and(|start| start.root == root);
        let is_crossed_at_0 = |enters: bool| start.map_or(enters, |start| !on_this && start.is_before(root, enters));
        let is_on_ray = |t: f64, enters: bool| t < t_max && (t > slack || (t > -slack && is_crossed_at_0(enters)));
        let start = start.filter(|_| on_this).map(|start| start.surface);
        let mut report = |crossing: Crossing, enters: bool| {
            !is_on_ray(crossing.t, enters) || visit(Hit { t: crossing.t.max(0.0), surface: crossing.surface, enters })
        };
        // What rounding alone makes a stay, at an edge or where faces coincide, is none; so is such a gap. A ray that
        // starts on this solid starts there exactly, and may be inside as briefly as it likes.
        let is_sliver =
            |earlier: Crossing, later: Crossing| start.is_none() && coincide(&self.leaves, earlier, later, ray);
        match &self.nodes[root.node().index()].kind {
            NodeKind::Leaf(leaf) => {
                let [first, second] = self.leaf_spans(*leaf, ray, start);
                let mut go_on = true;
                if let Some([enter, leave]) = first {
                    go_on = report(enter, true) && report(leave, false);
                }
                if let Some([enter, leave]) = second.filter(|_| go_on)
                    && report(enter, true)
                {
                    report(leave, false);
                }
            }
            NodeKind::Convex(leaves) => {
                if let Some([enter, leave]) = self.convex_span(leaves, ray, start)
                    && !is_sliver(enter, leave)
                    && report(enter, true)
                {
                    report(leave, false);
                }
            }
            NodeKind::Composition { operation, children } => {
                stack.clear();
                let window = [-2.0 * slack, t_max + ray.tolerance(t_max)];
                // Whoever asks has looked at the bounds.
                self.push_composition_crossings(*operation, children, ray, start, window, stack);
                let mut enters = true;
                for crossing in without_slivers(stack, is_sliver) {
                    if !report(crossing, enters) {
                        return;
                    }
                    enters = !enters;
                }
            }
        }
    }

    /// Pushes the crossings of a node. Spans that lie outside `window` may be left out.
    #[inline(always)]
    pub(super) fn push_crossings(
        &self,
        node: NodeIndex,
        ray: &Ray,
        start: Option<Surface>,
        window: [f64; 2],
        stack: &mut Stack,
    ) {
        let Node { bounds, kind } = &self.nodes[node.index()];
        if bounds.entry(ray, window[0], window[1]).is_some() {
            self.push_crossings_within_bounds(kind, ray, start, window, stack);
        }
    }

    /// As [`Tree::push_crossings`], for a ray that is known to report the node's bounds.
    #[inline(always)]
    fn push_crossings_within_bounds(
        &self,
        kind: &NodeKind,
        ray: &Ray,
        start: Option<Surface>,
        window: [f64; 2],
        stack: &mut Stack,
    ) {
        let mut push = |[enter, leave]: [Crossing; 2]| {
            if leave.t >= window[0] && enter.t <= window[1] {
                stack.extend([enter, leave]);
            }
        };
        match kind {
            NodeKind::Leaf(leaf) => {
                let [first, second] = self.leaf_spans(*leaf, ray, start);
                if let Some(span) = first {
                    push(span);
                }
                if let Some(span) = second {
                    push(span);
                }
            }
            NodeKind::Convex(leaves) => {
                if let Some(span) = self.convex_span(leaves, ray, start) {
                    push(span);
                }
            }
            NodeKind::Composition { operation, children } => {
                self.push_composition_crossings(*operation, children, ray, start, window, stack);
            }
        }
    }

    fn push_composition_crossings(
        &self,
        operation: Operation,
        children: &[NodeIndex],
        ray: &Ray,
        start: Option<Surface>,
        mut window: [f64; 2],
        stack: &mut Stack,
    ) {
        let first = stack.len();
        for (index, &child) in children.iter().enumerate() {
            let second = stack.len();
            if index == 0 && operation == Operation::Difference {
                // The bounds of a difference are those of its first operand.
                self.push_crossings_within_bounds(&self.nodes[child.index()].kind, ray, start, window, stack);
            } else {
                self.push_crossings(child, ray, start, window, stack);
                if index > 0 {
                    merge(operation, stack, first, second, ray);
                }
            }
            if operation != Operation::Union {
                // Nothing outside the first operand's spans can matter any more.
                let (Some(enter), Some(leave)) = (stack.get(first), stack.last()) else { return };
                if enter.t.is_finite() {
                    window[0] = fast_max(window[0], enter.t - 2.0 * ray.tolerance(enter.t));
                }
                if leave.t.is_finite() {
                    window[1] = fast_min(window[1], leave.t + 2.0 * ray.tolerance(leave.t));
                }
            }
        }
    }

    /// The crossings of a leaf.
    pub(super) fn leaf_crossings(&self, leaf: LeafIndex, ray: &Ray, start: Option<Surface>) -> Vec<Crossing> {
        self.leaf_spans(leaf, ray, start).into_iter().flatten().flatten().collect()
    }

    #[inline(always)]
    fn leaf_spans(&self, leaf: LeafIndex, ray: &Ray, start: Option<Surface>) -> [Option<[Crossing; 2]>; 2] {
        let spans = self.leaves[leaf.index()].spans(ray, start_face(start, leaf));
        [spans.first, spans.second].map(|span| span.map(|span| span_crossings(leaf, span)))
    }

    /// The one stay of a ray in the intersection of convex leaves. As in [`merge`], of faces that coincide the
    /// first leaf's is seen, and a stay shorter than the tolerance is none.
    fn convex_span(&self, leaves: &[LeafIndex], ray: &Ray, start: Option<Surface>) -> Option<[Crossing; 2]> {
        let mut stay: Option<[Crossing; 2]> = None;
        for &leaf in leaves {
            let span = self.leaves[leaf.index()].spans(ray, start_face(start, leaf)).first?;
            let [enter, leave] = span_crossings(leaf, span);
            let [first, last] = stay.get_or_insert([enter, leave]);
            if enter.t > first.t + ray.tolerance(enter.t) || first.t == f64::NEG_INFINITY {
                *first = enter;
            }
            if leave.t < last.t - ray.tolerance(leave.t) || last.t == f64::INFINITY {
                *last = leave;
            }
            if last.t <= first.t + ray.tolerance(first.t) {
                return None;
            }
        }
        stay
    }
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
