//! Vectors and affine maps of any number type.

use std::ops::{Add, Mul, Sub};

use glam::{DAffine3, DVec3};

use super::number::Number;

/// A vector or a point.
#[derive(Clone, Copy, Debug)]
pub struct Vector<N>(pub [N; 3]);

impl<N: Number> Add for Vector<N> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self([0, 1, 2].map(|axis| self.0[axis] + other.0[axis]))
    }
}

impl<N: Number> Sub for Vector<N> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self([0, 1, 2].map(|axis| self.0[axis] - other.0[axis]))
    }
}

impl<N: Number> Mul<N> for Vector<N> {
    type Output = Self;

    fn mul(self, factor: N) -> Self {
        Self(self.0.map(|part| part * factor))
    }
}

impl<N: Number> Vector<N> {
    pub fn from_f64(vector: DVec3) -> Self {
        Self(vector.to_array().map(N::from_f64))
    }

    pub fn to_f64(self) -> DVec3 {
        DVec3::from_array(self.0.map(N::to_f64))
    }

    pub fn dot(self, other: Self) -> N {
        self.0[0] * other.0[0] + self.0[1] * other.0[1] + self.0[2] * other.0[2]
    }

    pub fn cross(self, other: Self) -> Self {
        let [a, b] = [self.0, other.0];
        Self([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
    }

    pub fn normalize(self) -> Self {
        self * (N::from_f64(1.0) / self.dot(self).sqrt())
    }
}

/// The inverse of an affine map: from the scene's coordinates to a primitive's.
#[derive(Clone, Copy, Debug)]
pub struct ToLocal<N> {
    rows: [Vector<N>; 3],
    origin: Vector<N>,
}

impl<N: Number> ToLocal<N> {
    pub fn new(scene_from_local: &DAffine3) -> Self {
        let DAffine3 { matrix3: m, translation } = *scene_from_local;
        let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(Vector::<N>::from_f64);
        let crosses = [y.cross(z), z.cross(x), x.cross(y)];
        let factor = N::from_f64(1.0) / x.dot(crosses[0]);
        Self { rows: crosses.map(|cross| cross * factor), origin: Vector::from_f64(translation) }
    }

    pub fn vector(&self, v: Vector<N>) -> Vector<N> {
        Vector(self.rows.map(|row| row.dot(v)))
    }

    pub fn point(&self, p: Vector<N>) -> Vector<N> {
        self.vector(p - self.origin)
    }

    /// A gradient in the primitive's coordinates, in the scene's.
    pub fn gradient_to_scene(&self, gradient: Vector<N>) -> Vector<N> {
        let [x, y, z] = gradient.0;
        self.rows[0] * x + self.rows[1] * y + self.rows[2] * z
    }
}
