//! Slivers: neighbouring events of a composition that are one place, which rounding has moved apart.
//!
//! Rounding moves a face by a few parts in 10¹⁶ of the numbers around, and the place where a ray crosses it by so much
//! over the cosine between the ray and the normal. For all but grazing rays that is far less than the ray's tolerance,
//! by which merging groups events; so the cosines are looked at only where two events lie between one and a million
//! tolerances apart, which is rare.

use super::{Crossing, Leaf};
use crate::geometry::Ray;

/// Two events may be one place up to this many tolerances apart.
const REACH: f64 = 1e6;

/// How far rounding moves a face, as a part of the numbers that the ray's tolerance follows too; with a margin.
const ROUNDING: f64 = 4e-15;

/// The events of a composition but for slivers of it and in it, whose two ends are one place.
#[inline(always)]
pub(super) fn without_slivers(
    mut events: &[Crossing],
    are_one: impl Fn(Crossing, Crossing) -> bool,
) -> impl Iterator<Item = Crossing> {
    std::iter::from_fn(move || {
        loop {
            match events {
                [earlier, later, rest @ ..] if are_one(*earlier, *later) => events = rest,
                [event, rest @ ..] => {
                    events = rest;
                    return Some(*event);
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
    // Sums and not differences, so that an infinite event coincides with none.
    later.t <= earlier.t + REACH * tolerance
        && (later.t <= earlier.t + tolerance || are_blurred(leaves, earlier, later, ray))
}

/// Whether rounding explains the distance between two events.
#[cold]
#[inline(never)]
fn are_blurred(leaves: &[Leaf], earlier: Crossing, later: Crossing, ray: &Ray) -> bool {
    let blur = |event: Crossing| {
        let normal = leaves[event.surface.leaf.index()].normal(event.surface.face, ray.at(event.t));
        ROUNDING * (ray.scale + event.t.abs()) / normal.dot(ray.direction).abs()
    };
    later.t - earlier.t <= blur(earlier) + blur(later)
}
