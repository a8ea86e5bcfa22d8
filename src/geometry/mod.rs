//! Rays, boxes and affine maps, in f64.
//!
//! Functions beyond the root come from `libm`, which is the same on every computer: so are the pictures.

mod boxes;
mod parallel;
mod split;

pub use boxes::{BoxFrame, BoxRay, Boxes, WIDTH};
pub use parallel::{PARALLEL_COSINE, approach};
pub use split::{split, split_into};

use glam::{DAffine3, DMat3, DVec3};

/// A half-line, with the values that every intersection test needs.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// The point at distance 0.
    pub origin: DVec3,
    /// Of length 1.
    pub direction: DVec3,
    /// 1 / `direction`, by component. Where that is infinite, a very large number instead, so that no product with it
    /// is NaN.
    pub inverse_direction: DVec3,
    /// The largest coordinate that the origin was computed from. Rounding errors along the ray are a few parts in 10¹⁶
    /// of this and of the distance, so a tolerance relative to both follows the scale of the scene.
    pub scale: f64,
}

/// Two distances along a ray are equal if they differ by less than this part of the numbers that they were computed
/// from.
const RELATIVE_TOLERANCE: f64 = 1e-12;

impl Ray {
    /// A ray with its inverse direction and scale; `direction` must have length 1.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        const MAX_INVERSE: f64 = 1e300;
        let inverse_direction =
            direction.map(|component| fast_min(fast_max(1.0 / component, -MAX_INVERSE), MAX_INVERSE));
        let size = origin.abs();
        Self { origin, direction, inverse_direction, scale: fast_max(fast_max(size.x, size.y), size.z) }
    }

    /// The secondary ray that starts at distance `t` of this one.
    pub fn onward(&self, t: f64, direction: DVec3) -> Self {
        let mut ray = Self::new(self.at(t), direction);
        ray.scale = fast_max(fast_max(ray.scale, self.scale), t);
        ray
    }

    /// The point at distance `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// The greatest difference between equal distances near `t`.
    pub fn tolerance(&self, t: f64) -> f64 {
        RELATIVE_TOLERANCE * (self.scale + t.abs())
    }
}

/// An axis-aligned box; it may be infinite, and is empty where `min` exceeds `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The lowest corner.
    pub min: DVec3,
    /// The highest corner.
    pub max: DVec3,
}

impl Aabb {
    /// Contains no point.
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
    /// Contains all points.
    pub const ALL: Self = Self { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };

    /// The smallest box that contains both.
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The points in both boxes.
    pub fn intersection(self, other: Self) -> Self {
        Self { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// Whether it contains no point (a box without thickness contains some).
    pub fn is_empty(self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Whether all its corners are finite.
    pub fn is_finite(self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// Half the surface area, proportional to the probability that a random ray hits the box.
    pub fn half_area(self) -> f64 {
        let size = self.max - self.min;
        size.x * size.y + size.y * size.z + size.z * size.x
    }

    /// The centre.
    pub fn centre(self) -> DVec3 {
        (self.min + self.max) * 0.5
    }

    /// A slightly larger box, which contains the intended box in spite of rounding.
    pub fn padded(self) -> Self {
        let finite = |v: DVec3| DVec3::select(v.is_finite_mask(), v, DVec3::ZERO);
        let size = finite(self.max - self.min);
        let pad = |side: DVec3| (finite(side).abs() + size) * 1e-9;
        Self { min: self.min - pad(self.min), max: self.max + pad(self.max) }
    }

    /// The smallest box that contains the image of the cube −1…1 under `map`.
    pub fn of_cube(map: &DAffine3) -> Self {
        let half = map.matrix3.x_axis.abs() + map.matrix3.y_axis.abs() + map.matrix3.z_axis.abs();
        Self { min: map.translation - half, max: map.translation + half }
    }

    /// The distance at which `ray` enters the box, if it meets the box between `from` and `to`; at least `from`. A ray
    /// in the plane of a face may miss: where it must not, use a [`Aabb::padded`] box.
    #[inline(always)]
    pub fn entry(&self, ray: &Ray, from: f64, to: f64) -> Option<f64> {
        self.span(ray, from, to).map(|[near, _]| near)
    }

    /// The distances at which `ray` enters and leaves the box, as [`Aabb::entry`]; the second is at most `to`.
    #[inline(always)]
    pub fn span(&self, ray: &Ray, from: f64, to: f64) -> Option<[f64; 2]> {
        let a = (self.min - ray.origin) * ray.inverse_direction;
        let b = (self.max - ray.origin) * ray.inverse_direction;
        let near = fast_max(fast_max(fast_min(a.x, b.x), fast_min(a.y, b.y)), fast_max(fast_min(a.z, b.z), from));
        let far = fast_min(fast_min(fast_max(a.x, b.x), fast_max(a.y, b.y)), fast_min(fast_max(a.z, b.z), to));
        (near <= far).then_some([near, far])
    }
}

/// `f64::min` without its handling of NaN: one instruction.
#[inline(always)]
pub fn fast_min(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// `f64::max` without its handling of NaN: one instruction.
#[inline(always)]
pub fn fast_max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Rotation by `degrees` about x, then about y, then about z (right-handed).
pub fn rotation(degrees: DVec3) -> DMat3 {
    let [x, y, z] = degrees.to_array().map(sin_cos_degrees);
    let about_x = DMat3::from_cols(DVec3::X, DVec3::new(0.0, x.1, x.0), DVec3::new(0.0, -x.0, x.1));
    let about_y = DMat3::from_cols(DVec3::new(y.1, 0.0, -y.0), DVec3::Y, DVec3::new(y.0, 0.0, y.1));
    let about_z = DMat3::from_cols(DVec3::new(z.1, z.0, 0.0), DVec3::new(-z.0, z.1, 0.0), DVec3::Z);
    about_z * about_y * about_x
}

/// Sine and cosine of an angle in degrees; exactly 0 and ±1 at multiples of 90°, so that what is turned by right angles
/// stays parallel to what is not.
fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    // Both remainders are exact.
    let within_turn = degrees % 360.0;
    let quarters = (within_turn / 90.0).round();
    let (sine, cosine) = libm::sincos((within_turn - 90.0 * quarters).to_radians());
    // A sum with 0 makes −0 a plain 0.
    match quarters.rem_euclid(4.0) as u8 {
        0 => (sine, cosine),
        1 => (cosine, 0.0 - sine),
        2 => (0.0 - sine, 0.0 - cosine),
        _ => (0.0 - cosine, sine),
    }
}

/// A rotation that maps the y axis to `axis`, which has length 1.
pub fn turn_y_to(axis: DVec3) -> DMat3 {
    let side = axis.any_orthonormal_vector();
    DMat3::from_cols(side, axis, side.cross(axis))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn ray_in_plane_of_face_hits_padded_box() {
        let cube = Aabb { min: DVec3::NEG_ONE, max: DVec3::ONE }.padded();
        let ray = Ray::new(DVec3::new(-3.0, 1.0, 0.0), DVec3::X);
        let entry = cube.entry(&ray, 0.0, f64::INFINITY).expect("the ray runs in a face");
        assert!((entry - 2.0).abs() < 1e-8);
        assert_eq!(cube.entry(&ray, 0.0, 1.5), None);
        assert_eq!(cube.entry(&Ray::new(DVec3::new(-3.0, 1.1, 0.0), DVec3::X), 0.0, 9.0), None);
    }

    #[test]
    fn rotation_is_about_x_then_y_then_z() {
        let turned = rotation(DVec3::new(90.0, 90.0, 0.0)) * DVec3::Y;
        // About x, y goes to z; about y, z goes to x.
        assert!((turned - DVec3::X).length() < 1e-15, "{turned}");
    }

    #[test]
    fn rotation_by_right_angles_is_exact() {
        for quarter in -9..=9 {
            for axis in 0..3 {
                let mut degrees = DVec3::ZERO;
                degrees[axis] = 90.0 * f64::from(quarter);
                let turned = rotation(degrees);
                assert!(turned.to_cols_array().iter().all(|entry| [-1.0, 0.0, 1.0].contains(entry)), "{turned}");
                assert_eq!(turned.determinant(), 1.0);
                degrees[axis] += 360.0;
                assert_eq!(turned, rotation(degrees));
            }
        }
    }

    proptest! {
        #[test]
        fn rotation_is_orthogonal_and_adds_up(angle in -800.0..800.0f64, more in -800.0..800.0f64) {
            let about_y = |degrees| rotation(DVec3::new(0.0, degrees, 0.0));
            let turned = about_y(angle);
            prop_assert!((turned.transpose() * turned).abs_diff_eq(DMat3::IDENTITY, 1e-15));
            prop_assert!((about_y(more) * turned).abs_diff_eq(about_y(angle + more), 1e-13));
            let expected = DMat3::from_rotation_y(angle.to_radians());
            prop_assert!(turned.abs_diff_eq(expected, 1e-13));
        }
    }

    #[test]
    fn turn_y_to_keeps_handedness() {
        for axis in [DVec3::Y, DVec3::NEG_Y, DVec3::X, DVec3::new(0.6, 0.0, -0.8)] {
            let turn = turn_y_to(axis);
            assert!((turn * DVec3::Y - axis).length() < 1e-15);
            assert!((turn.determinant() - 1.0).abs() < 1e-14);
        }
    }
}
