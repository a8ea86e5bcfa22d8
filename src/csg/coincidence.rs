//! Slivers: neighbouring crossings of a composition that are one point, which rounding has moved apart.
//!
//! Rounding moves a face by a few parts in 10¹⁶ of the numbers around it. A ray's crossing moves by that distance
//! divided by the cosine between the ray and the normal. Unless the ray grazes the face this is far less than the ray's
//! tolerance, by which merging groups crossings. So the cosines are computed only where two crossings lie between one
//! and a million tolerances apart, which is rare.

use super::{Crossing, Leaf};
use crate::geometry::Ray;

/// Two crossings at most this many tolerances apart may be one point.
const MAX_TOLERANCES: f64 = 1e6;

/// Bound of the distance by which rounding moves a face, relative to the numbers that the ray's tolerance is relative
/// to; with a margin.
const RELATIVE_ROUNDING: f64 = 4e-15;

/// Removes the pairs of a composition's crossings that bound a sliver, be it inside or outside the solid.
#[inline(always)]
pub(super) fn drop_slivers(crossings: &mut Vec<Crossing>, is_sliver: impl Fn(Crossing, Crossing) -> bool) {
    let (mut kept, mut at) = (0, 0);
    while let Some(&crossing) = crossings.get(at) {
        match crossings.get(at + 1) {
            Some(&next) if is_sliver(crossing, next) => at += 2,
            _ => {
                crossings[kept] = crossing;
                (kept, at) = (kept + 1, at + 1);
            }
        }
    }
    crossings.truncate(kept);
}

/// Whether `later` is one point with `earlier`: at most the tolerance after it, or at most what rounding explains.
#[inline(always)]
pub(super) fn coincide(leaves: &[Leaf], earlier: Crossing, later: Crossing, ray: &Ray) -> bool {
    let tolerance = ray.tolerance(earlier.t);
    // Sums instead of differences, so that an infinite crossing coincides with none.
    later.t <= earlier.t + MAX_TOLERANCES * tolerance
        && (later.t <= earlier.t + tolerance || rounding_explains(leaves, earlier, later, ray))
}

/// Whether rounding explains the distance between two crossings.
#[cold]
#[inline(never)]
fn rounding_explains(leaves: &[Leaf], earlier: Crossing, later: Crossing, ray: &Ray) -> bool {
    let error = |crossing: Crossing| {
        let normal = leaves[crossing.surface.leaf.index()].normal(crossing.surface.face, ray.at(crossing.t));
        RELATIVE_ROUNDING * (ray.scale + crossing.t.abs()) / normal.dot(ray.direction).abs()
    };
    later.t - earlier.t <= error(earlier) + error(later)
}
