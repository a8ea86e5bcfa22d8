//! The primitives: solids that are not composed of others.

use glam::{DAffine3, DMat3, DVec3};

use super::torus;

/// A primitive in its own coordinates. Sizes are positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Primitive {
    /// The ball of radius 1 around the origin.
    Sphere,
    /// All points with `normal · p ≤ offset` (the article's plane); `normal` has length 1.
    HalfSpace {
        /// Points out of the solid, with length 1.
        normal: DVec3,
        /// The boundary's distance from the origin along `normal`.
        offset: f64,
    },
    /// The cube from −1 to 1.
    Cube,
    /// The cylinder about the y axis of radius 1, from y = −1 to y = 1.
    Cylinder,
    /// The cone about the y axis, from y = −1 to y = 1, whose radius goes from `bottom` to `top`; not both are 0.
    Cone {
        /// Radius at y = −1.
        bottom: f64,
        /// Radius at y = 1.
        top: f64,
    },
    /// The torus about the y axis: all points at most `tube` away from the circle of radius 1 in the plane y = 0.
    Torus {
        /// The radius of the tube, below 1.
        tube: f64,
    },
    /// All points with `xx x² + yy y² + zz z² + xy xy + yz yz + zx zx + x x + y y + z z + c ≤ 0`.
    Quadric(QuadricCoefficients),
}

/// The ten coefficients of [`Primitive::Quadric`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadricCoefficients {
    /// Coefficients of x², y², z².
    pub squares: DVec3,
    /// Coefficients of xy, yz, zx.
    pub products: DVec3,
    /// Coefficients of x, y, z.
    pub linear: DVec3,
    /// The constant term.
    pub constant: f64,
}

impl QuadricCoefficients {
    /// The symmetric matrix of the squares and products.
    pub(super) fn square(&self) -> DMat3 {
        let [xy, yz, zx] = (self.products / 2.0).to_array();
        DMat3::from_cols(
            DVec3::new(self.squares.x, xy, zx),
            DVec3::new(xy, self.squares.y, yz),
            DVec3::new(zx, yz, self.squares.z),
        )
    }
}

/// Carries the half-space `normal · p ≤ offset` to the scene. Returns its normal, of length 1, and its offset there.
pub(super) fn carry_half_space(normal: DVec3, offset: f64, local_from_scene: &DAffine3) -> (DVec3, f64) {
    let carried = local_from_scene.matrix3.transpose() * normal;
    let length = carried.length();
    (carried / length, (offset - normal.dot(local_from_scene.translation)) / length)
}

impl Primitive {
    /// Whether `p`, in the primitive's own coordinates, lies in the primitive or on its boundary.
    pub fn contains(&self, p: DVec3) -> bool {
        let across = p.x * p.x + p.z * p.z;
        match self {
            Self::Sphere => p.length_squared() <= 1.0,
            Self::HalfSpace { normal, offset } => normal.dot(p) <= *offset,
            Self::Cube => p.abs().max_element() <= 1.0,
            Self::Cylinder => across <= 1.0 && p.y.abs() <= 1.0,
            Self::Cone { bottom, top } => {
                let radius = bottom + (top - bottom) * (p.y + 1.0) / 2.0;
                across <= radius * radius && p.y.abs() <= 1.0
            }
            Self::Torus { tube } => torus::implicit(*tube, p) <= 0.0,
            Self::Quadric(q) => {
                let products = DVec3::new(p.x * p.y, p.y * p.z, p.z * p.x);
                q.squares.dot(p * p) + q.products.dot(products) + q.linear.dot(p) + q.constant <= 0.0
            }
        }
    }
}
