//! A quadric in the directions of its own axes, and the planes that it gives.

use glam::{DAffine3, DMat3, DVec3};

use super::polyhedron::{Plane, Polyhedron};
use crate::csg::QuadricCoefficients;
use crate::geometry::Aabb;

/// All points with (p − centre) · (square (p − centre)) + 2 half_linear · (p − centre) + constant ≤ 0.
#[derive(Clone, Debug)]
pub(super) struct Quadric {
    centre: DVec3,
    square: DMat3,
    half_linear: DVec3,
    constant: f64,
    /// Columns of length 1, at right angles: along these the quadric has squares but no products.
    axes: DMat3,
}

/// Bound of rounding errors, relative to the terms of the quadric.
const RELATIVE_ROUNDING: f64 = 1e-12;

impl Quadric {
    pub fn new(q: &QuadricCoefficients, scene_from_local: &DAffine3) -> Self {
        let to_local = scene_from_local.inverse().matrix3;
        Self::of(
            scene_from_local.translation,
            to_local.transpose() * q.square() * to_local,
            to_local.transpose() * q.linear / 2.0,
            q.constant,
        )
    }

    fn of(centre: DVec3, square: DMat3, half_linear: DVec3, constant: f64) -> Self {
        Self { centre, square, half_linear, constant, axes: principal_axes(square) }
    }

    /// The other side of the surface.
    pub fn flipped(self) -> Self {
        Self { square: -self.square, half_linear: -self.half_linear, constant: -self.constant, ..self }
    }

    /// Planes at right angles to the quadric's axes, between which its part within `planes` lies.
    ///
    /// Along each axis the quadric's term is at most what the least values of the others leave for it (hull
    /// consistency; Benhamou et al., *Revising hull and box consistency*, 1999).
    pub fn clip(&self, planes: &Polyhedron, reach: f64) -> Vec<Plane> {
        let at = |axis: usize| self.axes.col(axis);
        let centre = [0, 1, 2].map(|axis| at(axis).dot(self.centre));
        let mut ranges = [0, 1, 2].map(|axis| {
            let along = |direction: DVec3| planes.support(direction, reach);
            [-along(-at(axis)) - centre[axis], along(at(axis)) - centre[axis]]
        });
        let squares = [0, 1, 2].map(|axis| at(axis).dot(self.square * at(axis)));
        let halves = [0, 1, 2].map(|axis| at(axis).dot(self.half_linear));
        let greatest = self.square.to_cols_array().into_iter().map(f64::abs).sum::<f64>();
        let far = reach + self.centre.length();
        let slack = RELATIVE_ROUNDING
            * ((greatest * far + 2.0 * self.half_linear.abs().element_sum()) * far + self.constant.abs());
        let terms = [0, 1, 2].map(|axis| Term {
            square: if squares[axis].abs() <= RELATIVE_ROUNDING * greatest { 0.0 } else { squares[axis] },
            half: if halves[axis].abs() <= RELATIVE_ROUNDING * self.half_linear.length() { 0.0 } else { halves[axis] },
        });
        for _ in 0..2 {
            for axis in 0..3 {
                let others: f64 =
                    (0..3).filter(|&other| other != axis).map(|other| terms[other].least(ranges[other])).sum();
                let most = slack - self.constant - others;
                if most.is_finite() {
                    ranges[axis] = terms[axis].clip(ranges[axis], most);
                }
            }
        }
        let sides = (0..3).flat_map(|axis| {
            let [low, high] = ranges[axis];
            [(at(axis), high + centre[axis]), (-at(axis), -low - centre[axis])]
        });
        sides.filter(|(_, offset)| offset.is_finite()).map(|(normal, offset)| Plane { normal, offset }).collect()
    }

    /// Boxes around the quadric's part between two of the planes.
    ///
    /// Between two planes the product of the heights above them is ≥ 0. A quadric minus any multiple of it is a quadric
    /// that contains the part; where it is an ellipsoid, it has a box. (The S-procedure; Boyd and Vandenberghe, *Convex
    /// Optimization*, §B.2, says that one of the multiples gives the least box.)
    pub fn ellipsoids(&self, planes: &Polyhedron) -> Vec<Aabb> {
        let size = self.square.to_cols_array().into_iter().map(f64::abs).fold(0.0, f64::max);
        let inner = |plane: &Plane| plane.offset - plane.normal.dot(self.centre);
        let mut boxes = Vec::new();
        for (at, a) in planes.planes().iter().enumerate() {
            for b in &planes.planes()[..at] {
                for power in -4..=10 {
                    let factor = size * 2_f64.powi(power);
                    let product = DMat3::from_cols(a.normal * b.normal.x, a.normal * b.normal.y, a.normal * b.normal.z);
                    let square = self.square - (product + product.transpose()) * (factor / 2.0);
                    let half_linear = self.half_linear + (inner(a) * b.normal + inner(b) * a.normal) * (factor / 2.0);
                    let constant = self.constant - factor * inner(a) * inner(b);
                    boxes.extend(Self::of(self.centre, square, half_linear, constant).bounds_of_ellipsoid());
                }
            }
        }
        boxes
    }

    /// The box of an ellipsoid, unless the quadric is none, or is too flat or too long to be computed with.
    fn bounds_of_ellipsoid(&self) -> Option<Aabb> {
        const MIN_RATIO: f64 = 1e-6;
        let squares = [0, 1, 2].map(|axis| self.axes.col(axis).dot(self.square * self.axes.col(axis)));
        let least = squares.into_iter().fold(f64::INFINITY, f64::min);
        let greatest = squares.into_iter().fold(0.0, f64::max);
        if least <= MIN_RATIO * greatest {
            return None;
        }
        let inverse = self.square.inverse();
        let middle = -(inverse * self.half_linear);
        let squared = -self.constant - self.half_linear.dot(middle);
        let half = DVec3::AXES.map(|axis| (squared.max(0.0) * axis.dot(inverse * axis)).sqrt());
        let (middle, half) = (self.centre + middle, DVec3::from(half) * (1.0 + MIN_RATIO));
        Some(Aabb { min: middle - half, max: middle + half })
    }
}

/// The part square · y² + 2 half · y of a quadric along one of its axes.
#[derive(Clone, Copy)]
struct Term {
    square: f64,
    half: f64,
}

impl Term {
    fn at(self, y: f64) -> f64 {
        // Where y is infinite, 0 times y is still 0, and the square decides.
        match (self.square == 0.0, self.half == 0.0) {
            (true, true) => 0.0,
            (true, false) => 2.0 * self.half * y,
            (false, _) if y.is_infinite() => self.square * f64::INFINITY,
            (false, _) => (self.square * y + 2.0 * self.half) * y,
        }
    }

    /// The least value over a range.
    fn least(self, [low, high]: [f64; 2]) -> f64 {
        let ends = self.at(low).min(self.at(high));
        let lowest = -self.half / self.square;
        if self.square > 0.0 && low < lowest && lowest < high { ends.min(self.at(lowest)) } else { ends }
    }

    /// The part of a range, as one range, where the term is at most `most`; an empty range if there is none.
    fn clip(self, [low, high]: [f64; 2], most: f64) -> [f64; 2] {
        if self.square == 0.0 {
            let root = most / (2.0 * self.half);
            return match self.half {
                half if half > 0.0 => [low, high.min(root)],
                half if half < 0.0 => [low.max(root), high],
                _ => [low, high],
            };
        }
        let discriminant = self.half * self.half + self.square * most;
        if discriminant <= 0.0 {
            return if self.square > 0.0 { [f64::INFINITY, f64::NEG_INFINITY] } else { [low, high] };
        }
        let root = discriminant.sqrt();
        let (a, b) = ((-self.half - root) / self.square, (-self.half + root) / self.square);
        let (first, last) = (a.min(b), a.max(b));
        if self.square > 0.0 {
            return [low.max(first), high.min(last)];
        }
        // Between the roots the term is too great.
        [if low > first { low.max(last) } else { low }, if high < last { high.min(first) } else { high }]
    }
}

/// Directions at right angles in which a symmetric matrix is diagonal (Jacobi's method; Golub and Van Loan, *Matrix
/// Computations*, §8.5).
fn principal_axes(matrix: DMat3) -> DMat3 {
    const SWEEPS: usize = 12;
    let (mut matrix, mut axes) = (matrix, DMat3::IDENTITY);
    for _ in 0..SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off = matrix.col(q)[p];
            let (first, second) = (matrix.col(p)[p], matrix.col(q)[q]);
            // What is 0 but for rounding is not turned away: it would mix axes that the scene means.
            if off.abs() <= f64::EPSILON * (first.abs() + second.abs()) {
                continue;
            }
            let ratio = (second - first) / (2.0 * off);
            let tangent = ratio.signum() / (ratio.abs() + (ratio * ratio + 1.0).sqrt());
            let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
            let mut turn = DMat3::IDENTITY;
            turn.col_mut(p)[p] = cosine;
            turn.col_mut(q)[q] = cosine;
            turn.col_mut(q)[p] = tangent * cosine;
            turn.col_mut(p)[q] = -tangent * cosine;
            matrix = turn.transpose() * matrix * turn;
            axes *= turn;
        }
    }
    axes
}
