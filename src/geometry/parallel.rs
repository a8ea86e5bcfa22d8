//! What is parallel to a face, but for rounding.
//!
//! A half-space and many quadrics have no end: a ray meets such a face however slowly it approaches, at its height
//! above the face divided by its approach for each unit of length. Where the scene means the two to be parallel,
//! rounding leaves an approach of some 10⁻¹⁶ (of a normal that was turned, of a direction that was normalised, of their
//! product), in either direction. A ray would then meet the face some 10¹⁶ away, or, where the coefficient of a square
//! was rounded, 10⁸ away. No crossing that is meant lies at such a distance: an approach below the bound counts as
//! none. So a ray along an endless face is inside all along or outside all along, and a light along a face does not
//! shine on it.
//!
//! Faces that end need no such rule: their caps and bounds cut off what is far away.

use glam::DVec3;

/// A cosine between a ray and a normal of at most this is 0 but for rounding: both have length 1, and each may have
/// gone through some ten operations.
pub const PARALLEL_COSINE: f64 = 16.0 * f64::EPSILON;

/// The approach of a ray to the outer side of a face for each unit of length: the cosine between its direction and the
/// outward `normal`, both of length 1; exactly 0 if the ray is parallel to the face but for rounding.
#[inline(always)]
pub fn approach(normal: DVec3, direction: DVec3) -> f64 {
    let cosine = normal.dot(direction);
    if cosine.abs() <= PARALLEL_COSINE { 0.0 } else { cosine }
}
