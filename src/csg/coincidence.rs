//! Slivers: neighbouring crossings of a composition that are one place, which rounding has moved apart.
//!
//! Rounding moves a face by a few parts in 10¹⁶ of the numbers around, and the place where a ray crosses it by so much
//! over the cosine between the ray and the normal. For all but grazing rays that is far less than the ray's tolerance,
//! by which merging groups crossings; so the cosines are looked at only where two crossings lie between one and a million
//! tolerances apart, which is rare.

use super::{Crossing, Leaf};
use crate::geometry::Ray;

/// Two crossings may be one place up to this many tolerances apart.
const MAX_TOLERANCES: f64 = 1e6;

/// How far rounding moves a face, as a part of the numbers that the ray's tolerance follows too; with a margin.
const RELATIVE_ROUNDING: f64 = 4e-15;

/// The crossings of a composition but for slivers of it and in it, whose two ends are one place.
#[inline(always)]
pub(super) fn without_slivers(
    mut crossings: &[Crossing],
    is_sliver: impl Fn(Crossing, Crossing) -> bool,
) -> impl Iterator<Item = Crossing> {
    std::iter::from_fn(move || {
        loop {
            match crossings {
                [earlier, later, rest @ ..] if is_sliver(*earlier, *later) => crossings = rest,
                [crossing, rest @ ..] => {
                    crossings = rest;
                    return Some(*crossing);
                }
                [] => return None,
            }
        }
    })
}

/// Whether `later` lies no more than the tolerance after `earlier`, or than rounding explains.
#[inline(always)]
pub(super) fn coincide(leaves: &[Leaf], earlier: Crossing, later: Crossing, ray: &Ray) -> bool {
    let tolerance = ray.tolerance(earlier.t);
    // Sums and not differences, so that an infinite crossing coincides with none.
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
