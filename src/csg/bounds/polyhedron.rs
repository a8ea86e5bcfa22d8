//! The intersection of half-spaces, and how far it reaches in a direction.

use glam::{DAffine3, DVec3};

use crate::csg::primitive::carry_half_space;
use crate::geometry::Aabb;

/// All points with `normal · p ≤ offset`; `normal` has length 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    pub normal: DVec3,
    pub offset: f64,
}

/// The points on the inner side of all planes.
#[derive(Clone, Debug)]
pub(super) struct Polyhedron(Vec<Plane>);

/// More planes than this are left out.
const MAX_PLANES: usize = 40;

impl Plane {
    /// The half-space `normal · p ≤ offset`, carried by a map.
    pub fn placed(normal: DVec3, offset: f64, scene_from_local: &DAffine3) -> Self {
        let (normal, offset) = carry_half_space(normal, offset, &scene_from_local.inverse());
        Self { normal, offset }
    }

    /// The other side of the plane.
    pub fn flipped(self) -> Self {
        Self { normal: -self.normal, offset: -self.offset }
    }
}

impl Polyhedron {
    /// Contains all points.
    pub const ALL: Self = Self(Vec::new());

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Removes the planes on whose inner side a whole finite box lies.
    pub fn keep_those_that_cut(&mut self, bounds: Aabb) {
        if bounds.is_finite() {
            let (centre, half) = (bounds.centre(), (bounds.max - bounds.min) * 0.5);
            self.0.retain(|plane| plane.normal.dot(centre) + plane.normal.abs().dot(half) > plane.offset);
        }
    }

    pub fn planes(&self) -> &[Plane] {
        &self.0
    }

    /// Adds a plane. Of parallel planes only the closest is kept.
    pub fn add(&mut self, plane: Plane) {
        if let Some(known) = self.0.iter_mut().find(|known| known.normal == plane.normal) {
            known.offset = known.offset.min(plane.offset);
        } else if self.0.len() < MAX_PLANES {
            self.0.push(plane);
        }
    }

    pub fn add_all(&mut self, planes: impl IntoIterator<Item = Plane>) {
        planes.into_iter().for_each(|plane| self.add(plane));
    }

    pub fn extend(&mut self, other: &Self) {
        self.add_all(other.0.iter().copied());
    }

    /// Adds the finite sides of a box.
    pub fn add_box(&mut self, bounds: Aabb) {
        for (axis, normal) in DVec3::AXES.into_iter().enumerate() {
            let sides = [(normal, bounds.max[axis]), (-normal, -bounds.min[axis])];
            self.add_all(
                sides.into_iter().filter(|(_, offset)| offset.is_finite()).map(|(n, o)| Plane { normal: n, offset: o }),
            );
        }
    }

    /// A box around the polyhedron; infinite where the polyhedron is.
    pub fn bounds(&self, reach: f64) -> Aabb {
        let along = |direction: DVec3| self.support(direction, reach);
        Aabb { min: DVec3::AXES.map(|axis| -along(-axis)).into(), max: DVec3::AXES.map(along).into() }
    }

    /// The greatest `direction · p` of the polyhedron's points, or more; infinite if it has no bound. `direction` has
    /// length 1; coordinates are at most `reach`.
    ///
    /// If `direction` = Σ λ n with λ ≥ 0, then `direction · p` ≤ Σ λ offset: each such sum is a bound, and the least
    /// one, which needs three normals at most, is the greatest value (duality of linear programs; Schrijver, *Theory of
    /// Linear and Integer Programming*, §7.4). Unlike a search for corners, rounding cannot make it too small by more
    /// than the part of `direction` that the sum misses.
    pub fn support(&self, direction: DVec3, reach: f64) -> f64 {
        let mut least = f64::INFINITY;
        // Normals that all point away from the direction have no sum that reaches it.
        if self.0.iter().all(|plane| plane.normal.dot(direction) <= 0.0) {
            return least;
        }
        let mut add = |of: [(f64, &Plane); 3]| {
            let sum: DVec3 = of.iter().map(|(factor, plane)| *factor * plane.normal).sum();
            let missed = (direction - sum).abs().element_sum();
            if of.iter().all(|(factor, _)| *factor >= 0.0) && missed <= MAX_MISSED {
                let bound: f64 = of.iter().map(|(factor, plane)| factor * plane.offset).sum();
                least = least.min(bound + missed * reach);
            }
        };
        for (at, a) in self.0.iter().enumerate() {
            add([(direction.dot(a.normal), a), (0.0, a), (0.0, a)]);
            for (next, b) in self.0[..at].iter().enumerate() {
                if let Some([x, y]) = factors_of_two(direction, a.normal, b.normal) {
                    add([(x, a), (y, b), (0.0, a)]);
                }
                let across = a.normal.cross(b.normal);
                for c in &self.0[..next] {
                    // Cramer's rule.
                    let determinant = across.dot(c.normal);
                    if determinant.abs() <= MIN_DETERMINANT {
                        continue;
                    }
                    let of_c = across.dot(direction) / determinant;
                    if of_c < -MAX_MISSED {
                        continue;
                    }
                    let of_a = direction.cross(b.normal).dot(c.normal) / determinant;
                    let of_b = a.normal.cross(direction).dot(c.normal) / determinant;
                    // A factor of −10⁻¹⁷ is a 0.
                    let [x, y, z] =
                        [of_a, of_b, of_c].map(|factor| if factor.abs() < MAX_MISSED / 8.0 { 0.0 } else { factor });
                    add([(x, a), (y, b), (z, c)]);
                }
            }
        }
        least
    }
}

/// The greatest part of a direction that a sum of normals may miss.
const MAX_MISSED: f64 = 1e-12;
/// Three normals that are closer to a plane than this give no bound that could be trusted.
const MIN_DETERMINANT: f64 = 1e-6;

/// The factors of two vectors of length 1 whose sum is closest to `direction`; none if they are parallel.
fn factors_of_two(direction: DVec3, a: DVec3, b: DVec3) -> Option<[f64; 2]> {
    let cosine = a.dot(b);
    let determinant = 1.0 - cosine * cosine;
    let (along_a, along_b) = (direction.dot(a), direction.dot(b));
    let factors = [(along_a - cosine * along_b) / determinant, (along_b - cosine * along_a) / determinant];
    (determinant > MIN_DETERMINANT).then_some(factors)
}
