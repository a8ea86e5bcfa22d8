//! Random numbers, directions and placements, the same for the same seed.

use fastrand::Rng;
use glam::{DAffine3, DMat3, DVec3};

use crate::geometry::rotation;

/// Returns a number from `from` to `to`, uniformly distributed.
pub(super) fn uniform(rng: &mut Rng, from: f64, to: f64) -> f64 {
    from + (to - from) * rng.f64()
}

/// Returns a unit vector, uniformly distributed on the sphere (Marsaglia 1972).
pub(super) fn unit_vector(rng: &mut Rng) -> DVec3 {
    loop {
        let [x, y] = [0, 1].map(|_| uniform(rng, -1.0, 1.0));
        let squared = x * x + y * y;
        if squared < 1.0 {
            let across = 2.0 * (1.0 - squared).sqrt();
            return DVec3::new(x * across, y * across, 1.0 - 2.0 * squared).normalize();
        }
    }
}

/// Returns a unit vector perpendicular to the unit vector `axis`.
pub(super) fn perpendicular(rng: &mut Rng, axis: DVec3) -> DVec3 {
    loop {
        let side = axis.cross(unit_vector(rng));
        if side.length() > 0.1 {
            return side.normalize();
        }
    }
}

/// Returns a rotation.
pub(super) fn random_rotation(rng: &mut Rng) -> DMat3 {
    rotation(DVec3::from([0, 1, 2].map(|_| uniform(rng, 0.0, 360.0))))
}

/// Returns a map that scales by `scale`, rotates at random, and moves by less than 1.
pub(super) fn random_placement(rng: &mut Rng, scale: DVec3) -> DAffine3 {
    DAffine3 { matrix3: random_rotation(rng) * DMat3::from_diagonal(scale), translation: unit_vector(rng) * rng.f64() }
}

/// Returns −1 or 1.
pub(super) fn random_sign(rng: &mut Rng) -> f64 {
    if rng.bool() { 1.0 } else { -1.0 }
}
