//! Which boundaries a ray crosses, and in which order where several lie at one place.
//!
//! A point is *in* a solid if it lies inside by more than the tolerance. A point on the solid's boundary is not in it,
//! also at an edge or a corner. (Faces of two operands of one union that fill both sides are no boundary.) A ray is in
//! a solid or not, and a crossing of the solid's boundary counts if it changes that. So a ray that starts on a boundary
//! has to cross those of the boundaries at its start that change what it is in, and no others. It does not matter on
//! which side of them rounding has put its origin.
//!
//! Boundaries of several solids at one place are crossed in the order of their [`Rank`].

use glam::DVec3;

use super::{Crossing, RootId, Surface, Tree};
use crate::geometry::Ray;

/// A ray's crossing of the boundary of a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, at least 0.
    pub t: f64,
    /// The face at the crossing.
    pub surface: Surface,
    /// Whether the ray enters the solid (not the leaf) there; otherwise it leaves it.
    pub enters: bool,
}

/// The surface on which a reflected, refracted or shadow ray starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayStart {
    /// The solid that the incoming ray hit.
    pub root: RootId,
    /// The face that it hit.
    pub surface: Surface,
}

/// Order in which a ray crosses boundaries that lie at one place: entries before exits, entries in scene order, exits
/// in the reverse of it.
///
/// So media that begin at one place also end there as a pair of brackets does, and a solid that is left is still there
/// when the one that touches it is entered: no gap of air comes between them. A ray that goes back crosses the
/// boundaries in exactly the opposite order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rank(bool, u32);

impl Rank {
    /// Creates the rank of a ray's crossing of the boundary of `root`.
    pub fn new(root: RootId, enters: bool) -> Self {
        Self(!enters, if enters { root.0 } else { !root.0 })
    }
}

/// Visits those of a line's `crossings` of a solid that a ray makes between its start and `t_max`, in order, until
/// `visit` returns false. `start` is the face of this solid that the ray starts on, if any; `is_inside` tells whether
/// the ray is in the solid at first.
pub(super) fn visit_crossings(
    crossings: &[Crossing],
    ray: &Ray,
    start: Option<Surface>,
    t_max: f64,
    is_inside: bool,
    mut visit: impl FnMut(Hit) -> bool,
) {
    let slack = ray.tolerance(0.0);
    // The crossings behind the start and at it. The last one decides on which side of the boundary the ray begins.
    let ahead = crossings.iter().position(|crossing| crossing.t > slack).unwrap_or(crossings.len());
    let (behind, ahead) = crossings.split_at(ahead);
    let lies_inside = behind.len() % 2 == 1;
    // The face that it starts on is behind it, although it lies at 0.
    let at_start = behind.last().filter(|last| last.t > -slack && !(last.t == 0.0 && start == Some(last.surface)));
    if at_start.is_none() && ahead.first().is_none_or(|next| next.t >= t_max) {
        return;
    }
    let mut inside = is_inside;
    if let Some(&Crossing { surface, .. }) = at_start.filter(|_| lies_inside != inside && t_max > 0.0) {
        if !visit(Hit { t: 0.0, surface, enters: lies_inside }) {
            return;
        }
        inside = lies_inside;
    }
    let mut enters = !lies_inside;
    for &Crossing { t, surface } in ahead {
        if t >= t_max {
            return;
        }
        if enters != inside {
            if !visit(Hit { t, surface, enters }) {
                return;
            }
            inside = enters;
        }
        enters = !enters;
    }
}

/// Does the same for a line with one span in the solid, which lies ahead of the ray's start.
#[inline(always)]
pub(super) fn visit_span(
    [enter, leave]: [Crossing; 2],
    t_max: f64,
    is_inside: bool,
    mut visit: impl FnMut(Hit) -> bool,
) {
    let hit = |Crossing { t, surface }: Crossing, enters: bool| Hit { t, surface, enters };
    if enter.t < t_max && (is_inside || visit(hit(enter, true))) && leave.t < t_max {
        visit(hit(leave, false));
    }
}

impl Tree {
    /// Whether a ray begins outside the solid `root` although it should be inside, or the other way round, and no
    /// boundary at its start explains that.
    pub fn contradicts(&self, root: RootId, ray: &Ray, start: Option<RayStart>, is_inside: bool) -> bool {
        let slack = ray.tolerance(0.0);
        let spans = self.span_diagram(root, ray, start).spans;
        let is_start = |t: f64| t == 0.0 && start.is_some_and(|start| start.root == root);
        let is_explained = spans.iter().flatten().any(|&t| t.abs() <= slack && !is_start(t));
        !is_explained && spans.iter().any(|[from, to]| *from <= slack && *to > slack) != is_inside
    }

    /// Whether `point` is in the solid `root`. `scale` is the largest number that the point was computed from.
    pub fn contains(&self, root: RootId, point: DVec3, scale: f64) -> bool {
        // At a corner, some of the lines through a point of the boundary run inside on both sides of it, never all.
        const LINES: [[f64; 3]; 12] = [
            [3.0, 5.0, 7.0],
            [-3.0, 5.0, 7.0],
            [3.0, -5.0, 7.0],
            [-3.0, -5.0, 7.0],
            [5.0, 7.0, 3.0],
            [-5.0, 7.0, 3.0],
            [5.0, -7.0, 3.0],
            [-5.0, -7.0, 3.0],
            [7.0, 3.0, 5.0],
            [-7.0, 3.0, 5.0],
            [7.0, -3.0, 5.0],
            [-7.0, -3.0, 5.0],
        ];
        LINES.iter().all(|&line| {
            let mut ray = Ray::new(point, DVec3::from(line).normalize());
            ray.scale = ray.scale.max(scale);
            let slack = ray.tolerance(0.0);
            self.span_diagram(root, &ray, None).spans.iter().any(|[from, to]| *from < -slack && *to > slack)
        })
    }
}
