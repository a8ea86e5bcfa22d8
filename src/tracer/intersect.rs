//! A ray's nearest hit among all solids, and the light that reaches a point.
//!
//! The tracing code is compiled twice, with an observer and without (see [`super::observer`]). Functions with one
//! caller in the source then have two, and the compiler stops inlining them, which costs 3 to 4 %; hence the
//! `#[inline(always)]`.

use glam::DVec3;

use super::bvh::{Order, Pending};
use super::compiled_scene::CompiledScene;
use super::media::Medium;
use crate::csg::{Hit, Rank, RayStart, RootId, Stack};
use crate::geometry::Ray;

/// Scratch memory of a search for hits, kept from ray to ray.
#[derive(Debug, Default)]
pub(super) struct HitScratch {
    spans: Stack,
    boxes: Pending,
    ties: Vec<(RootId, Hit)>,
    surfaces: Vec<TransparentCrossing>,
    media: Vec<RootId>,
}

/// A shadow ray's crossing of a transmitting surface.
#[derive(Debug)]
struct TransparentCrossing {
    t: f64,
    root: RootId,
    enters: bool,
    kt: DVec3,
}

impl CompiledScene {
    /// Finds the nearest boundary on `ray`, which starts in `media`, and the root that it belongs to: of all within the
    /// tolerance of the very nearest, the first by [`Rank`]. Its distance is the very nearest one's, so that the ray
    /// passes by none of the others. The result does not depend on the order in which solids are visited.
    #[inline(always)]
    pub fn nearest(
        &self,
        ray: &Ray,
        start: Option<RayStart>,
        media: &[Medium],
        scratch: &mut HitScratch,
    ) -> Option<(RootId, Hit)> {
        let HitScratch { spans, boxes, ties, .. } = scratch;
        ties.clear();
        let mut nearest = NearestHits { nearest: None, ties };
        let mut t_max = f64::INFINITY;
        let mut walk = self.bvh.walk(ray, Order::Nearest, boxes);
        while let Some(roots) = walk.next(t_max) {
            for &root in roots {
                if let Some(hit) = self.tree.nearest(root, ray, start, t_max, self.is_inside(root, media), spans) {
                    t_max = nearest.add(root, hit, ray);
                }
            }
        }
        nearest.first_by_rank(ray)
    }

    /// The part of a light's intensity that arrives at a point in `media` over the distance `t_max`, for red, green and
    /// blue: the product of Kt over all surfaces between two media on the way, and 0 behind any surface that does not
    /// transmit.
    #[inline(always)]
    pub fn light_transmittance(
        &self,
        ray: &Ray,
        start: RayStart,
        media: &[Medium],
        t_max: f64,
        scratch: &mut HitScratch,
    ) -> DVec3 {
        let HitScratch { spans, boxes, surfaces, media: inside, .. } = scratch;
        let mut blocked = false;
        surfaces.clear();
        let mut walk = self.bvh.walk(ray, Order::Any, boxes);
        while let Some(roots) = walk.next(t_max) {
            for &root in roots {
                self.tree.crossings(root, ray, Some(start), t_max, self.is_inside(root, media), spans, |hit| {
                    let shading = self.shading(hit.surface);
                    surfaces.push(TransparentCrossing { t: hit.t, root, enters: hit.enters, kt: shading.kt });
                    blocked = !shading.transmits;
                    shading.transmits
                });
                if blocked {
                    return DVec3::ZERO;
                }
            }
        }
        if surfaces.is_empty() {
            return DVec3::ONE;
        }
        inside.clear();
        inside.extend(media.iter().map(|medium| medium.root));
        transmittance(surfaces, inside, ray)
    }

    /// The distance at which the light that comes against `ray`, which starts in `media`, from `t_max` is blocked: that
    /// of the nearest surface that does not transmit, or `t_max`. Unlike [`CompiledScene::light_transmittance`], which
    /// stops at any such surface, it finds the nearest.
    pub fn shadow_ray_end(
        &self,
        ray: &Ray,
        start: RayStart,
        media: &[Medium],
        t_max: f64,
        scratch: &mut HitScratch,
    ) -> f64 {
        let HitScratch { spans, boxes, .. } = scratch;
        let mut end = t_max;
        let mut walk = self.bvh.walk(ray, Order::Nearest, boxes);
        while let Some(roots) = walk.next(end) {
            for &root in roots {
                self.tree.crossings(root, ray, Some(start), end, self.is_inside(root, media), spans, |hit| {
                    let passes = self.shading(hit.surface).transmits;
                    if !passes {
                        end = hit.t;
                    }
                    passes
                });
            }
        }
        end
    }
}

/// The nearest of all hits so far, and those that may be within the tolerance of it.
#[derive(Debug)]
struct NearestHits<'a> {
    nearest: Option<(RootId, Hit)>,
    ties: &'a mut Vec<(RootId, Hit)>,
}

impl NearestHits<'_> {
    /// Adds a hit. Returns the distance up to which another hit would count.
    #[inline(always)]
    fn add(&mut self, root: RootId, hit: Hit, ray: &Ray) -> f64 {
        let reach = |hit: Hit| hit.t + ray.tolerance(hit.t);
        match self.nearest {
            Some((_, nearest)) if nearest.t <= hit.t => {
                if hit.t <= reach(nearest) {
                    self.ties.push((root, hit));
                }
                return reach(nearest);
            }
            Some(before) if before.1.t <= reach(hit) => self.ties.push(before),
            _ => self.ties.clear(),
        }
        self.nearest = Some((root, hit));
        reach(hit)
    }

    /// Returns the first by rank of the hits within the tolerance of the nearest, at the distance of the nearest.
    #[inline(always)]
    fn first_by_rank(self, ray: &Ray) -> Option<(RootId, Hit)> {
        if self.ties.is_empty() { self.nearest } else { self.first_of_ties(ray) }
    }

    #[cold]
    fn first_of_ties(self, ray: &Ray) -> Option<(RootId, Hit)> {
        let (_, Hit { t, .. }) = self.nearest?;
        let reach = t + ray.tolerance(t);
        let tied = self.ties.iter().copied().filter(|(_, hit)| hit.t <= reach).chain(self.nearest);
        let (root, hit) = tied.min_by_key(|&(root, hit)| Rank::new(root, hit.enters))?;
        Some((root, Hit { t, ..hit }))
    }
}

/// The part of light that passes these surfaces. Surfaces inside a medium of higher priority do not exist. `inside` are
/// the roots that contain the ray's start.
fn transmittance(surfaces: &mut [TransparentCrossing], inside: &mut Vec<RootId>, ray: &Ray) -> DVec3 {
    surfaces.sort_unstable_by(|a, b| a.t.total_cmp(&b.t));
    let mut part = DVec3::ONE;
    for place in 0..surfaces.len() {
        // As for any ray: the first by rank of those within the tolerance of the nearest.
        let nearest = surfaces[place].t;
        let rest = &mut surfaces[place..];
        let tied = rest.iter().take_while(|surface| surface.t <= nearest + ray.tolerance(nearest)).enumerate();
        let first = tied.min_by_key(|(_, surface)| Rank::new(surface.root, surface.enters)).map_or(0, |(at, _)| at);
        rest[..=first].rotate_right(1);
        let TransparentCrossing { root, enters, kt, .. } = rest[0];
        if !inside.iter().any(|&other| other < root) {
            part *= kt;
        }
        inside.retain(|&other| other != root);
        if enters {
            inside.push(root);
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::csg::{LeafIndex, Surface};

    proptest! {
        #[test]
        fn nearest_hit_does_not_depend_on_the_order_of_visiting(
            hits in prop::collection::vec((0..12_u32, any::<bool>()), 1..9).prop_shuffle(), order in any::<u64>()
        ) {
            let ray = Ray::new(DVec3::X, DVec3::Y);
            // Distances are multiples of 0.4 of the tolerance, so that neighbours tie and their ends do not.
            let hit = |(root, &(place, enters)): (u32, &(u32, bool))| {
                let t = 1.0 + f64::from(place) * 0.4 * ray.tolerance(1.0);
                let surface = Surface { leaf: LeafIndex::default(), face: 0 };
                (RootId(root), Hit { t, surface, enters })
            };
            let mut hits: Vec<(RootId, Hit)> = (0..).zip(&hits).map(hit).collect();
            let first = |hits: &[(RootId, Hit)]| {
                let mut ties = Vec::new();
                let mut nearest = NearestHits { nearest: None, ties: &mut ties };
                let mut t_max = f64::INFINITY;
                for &(root, hit) in hits.iter() {
                    if hit.t < t_max {
                        t_max = nearest.add(root, hit, &ray);
                    }
                }
                nearest.first_by_rank(&ray)
            };
            let found = first(&hits);
            fastrand::Rng::with_seed(order).shuffle(&mut hits);
            prop_assert_eq!(first(&hits), found);
            let nearest = hits.iter().map(|(_, hit)| hit.t).fold(f64::INFINITY, f64::min);
            prop_assert_eq!(found.map(|(_, hit)| hit.t), Some(nearest));
        }
    }
}
