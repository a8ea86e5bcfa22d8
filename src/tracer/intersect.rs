//! A ray's nearest hit among all solids, and the light that reaches a point.
//!
//! The tracing code is compiled twice, with an observer and without (see [`super::observer`]). Functions with one
//! caller in the source then have two, and the compiler stops inlining them, which costs 3 to 4 %; hence the
//! `#[inline(always)]`.

use super::bvh::Pending;
use super::compiled_scene::CompiledScene;
use super::media::Medium;
use crate::csg::{Hit, RayStart, RootId, Stack, tie_break};
use crate::geometry::Ray;

/// Scratch memory of a search for hits, kept from ray to ray.
#[derive(Debug, Default)]
pub(super) struct HitScratch {
    spans: Stack,
    boxes: Pending,
    surfaces: Vec<TransparentCrossing>,
    media: Vec<RootId>,
}

/// A shadow ray's crossing of a transmitting surface.
#[derive(Debug)]
struct TransparentCrossing {
    t: f64,
    root: RootId,
    enters: bool,
    kt: f64,
}

/// Whether a ray at the distance `t` passes coincident boundaries in reverse: it is reversed, and still at its start.
pub(super) fn is_reversed_at(start: Option<RayStart>, ray: &Ray, t: f64) -> bool {
    start.is_some_and(|start| start.reversed) && t <= ray.tolerance(0.0)
}

impl CompiledScene {
    /// Finds the nearest boundary on `ray`, and the root that it belongs to.
    #[inline(always)]
    pub fn nearest(&self, ray: &Ray, start: Option<RayStart>, scratch: &mut HitScratch) -> Option<(RootId, Hit)> {
        let HitScratch { spans, boxes, .. } = scratch;
        let mut nearest: Option<(RootId, Hit)> = None;
        let test = |root: RootId, t_max: f64| match self.tree.nearest(root, ray, start, t_max, spans) {
            Some(hit) => {
                let slack = ray.tolerance(hit.t);
                let is_nearer = nearest.is_none_or(|(other, best)| {
                    if (hit.t - best.t).abs() > slack {
                        return hit.t < best.t;
                    }
                    let reversed = is_reversed_at(start, ray, hit.t);
                    let (this, other) =
                        (tie_break(root, hit.enters, reversed), tie_break(other, best.enters, reversed));
                    if reversed { this > other } else { this < other }
                });
                if is_nearer {
                    nearest = Some((root, hit));
                    hit.t + slack
                } else {
                    t_max
                }
            }
            None => t_max,
        };
        self.visit_roots(ray, f64::INFINITY, boxes, test);
        nearest
    }

    /// Visits the solids that `ray` may meet before `t_max`: those without bounds, then the others, nearer boxes first.
    /// `visit` returns the new `t_max`; a negative one ends the search.
    #[inline(always)]
    fn visit_roots(&self, ray: &Ray, mut t_max: f64, pending: &mut Pending, mut visit: impl FnMut(RootId, f64) -> f64) {
        for &root in &self.unbounded {
            t_max = visit(root, t_max);
            if t_max < 0.0 {
                return;
            }
        }
        self.bounded.visit(ray, t_max, pending, visit);
    }

    /// The part of a light's intensity that arrives at a point in `media` over the distance `t_max`: the product of Kt
    /// over all surfaces between two media on the way, and 0 behind any surface that does not transmit.
    #[inline(always)]
    pub fn light_transmittance(
        &self,
        ray: &Ray,
        start: RayStart,
        media: &[Medium],
        t_max: f64,
        scratch: &mut HitScratch,
    ) -> f64 {
        let HitScratch { spans, boxes, surfaces, media: inside } = scratch;
        let mut arriving = 1.0;
        surfaces.clear();
        let test = |root: RootId, t_max: f64| {
            self.tree.crossings(root, ray, Some(start), t_max, spans, |hit| {
                let kt = self.shading(hit.surface).kt;
                surfaces.push(TransparentCrossing { t: hit.t, root, enters: hit.enters, kt });
                arriving = if kt > 0.0 { arriving } else { 0.0 };
                kt > 0.0
            });
            if arriving > 0.0 { t_max } else { -1.0 }
        };
        self.visit_roots(ray, t_max, boxes, test);
        if arriving == 0.0 || surfaces.is_empty() {
            return arriving;
        }
        inside.clear();
        inside.extend(media.iter().map(|medium| medium.root));
        transmittance(surfaces, inside, ray, start.reversed)
    }

    /// The distance at which the light that comes against `ray` from `t_max` is blocked: that of the nearest surface
    /// that does not transmit, or `t_max`. Unlike [`CompiledScene::light_transmittance`], which stops at any such
    /// surface, it finds the nearest.
    pub fn shadow_ray_end(&self, ray: &Ray, start: RayStart, t_max: f64, scratch: &mut HitScratch) -> f64 {
        let HitScratch { spans, boxes, .. } = scratch;
        let mut end = t_max;
        let test = |root: RootId, t_max: f64| {
            self.tree.crossings(root, ray, Some(start), t_max, spans, |hit| {
                let passes = self.shading(hit.surface).kt > 0.0;
                if !passes {
                    end = hit.t;
                }
                passes
            });
            end
        };
        self.visit_roots(ray, t_max, boxes, test);
        end
    }
}

/// The part of light that passes these surfaces. Surfaces inside a medium of higher priority do not exist. `inside` are
/// the roots that contain the ray's start, where the ray may be `reversed`.
fn transmittance(surfaces: &mut [TransparentCrossing], inside: &mut Vec<RootId>, ray: &Ray, reversed: bool) -> f64 {
    surfaces.sort_unstable_by(|a, b| a.t.total_cmp(&b.t));
    let touch = |a: &TransparentCrossing, b: &TransparentCrossing| b.t - a.t <= ray.tolerance(b.t);
    let mut part = 1.0;
    for together in surfaces.chunk_by_mut(touch) {
        let reversed = reversed && together[0].t <= ray.tolerance(0.0);
        together.sort_unstable_by_key(|surface| tie_break(surface.root, surface.enters, reversed));
        if reversed {
            together.reverse();
        }
        for &mut TransparentCrossing { root, enters, kt, .. } in together {
            if !inside.iter().any(|&other| other < root) {
                part *= kt;
            }
            inside.retain(|&other| other != root);
            if enters {
                inside.push(root);
            }
        }
    }
    part
}
