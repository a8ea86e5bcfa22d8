//! A placed primitive that is intersected in three ways: by this program's tree, by a textbook method, and without
//! rounding.

use glam::{DAffine3, DMat3, DVec3};

use super::super::exact::{Exact, Vector, cross, dot, vector};
use crate::csg::{Hit, MaterialTag, Primitive, RayStart, RootId, Solid, Stack, Surface, Tree};
use crate::geometry::Ray;

/// A sphere, cylinder, cone or torus at its place.
pub(super) struct PlacedPrimitive {
    pub primitive: Primitive,
    pub scene_from_local: DAffine3,
    pub local_from_scene: DAffine3,
    tree: Tree,
    root: RootId,
    /// The rows of the map's inverse times its determinant, and that determinant, which is positive.
    rows: [Vector; 3],
    determinant: Exact,
}

/// Exact quadratic of a line and the primitive: inside where a t² + 2 b t + c < 0, and between the caps if there are
/// any.
pub(super) struct Truth {
    a: Exact,
    pub b: Exact,
    c: Exact,
    cap_distances: Option<Caps>,
}

/// The caps, where y + speed t is ± `height`.
struct Caps {
    y: Exact,
    speed: Exact,
    height: Exact,
}

impl PlacedPrimitive {
    /// Places the primitive; the map must not mirror.
    pub fn new(primitive: Primitive, scene_from_local: DAffine3) -> Self {
        let mut tree = Tree::default();
        let solid = Solid::Placed { primitive, scene_from_local, tag: MaterialTag(0) };
        let root = tree.add(&solid).map(|(root, _)| root).unwrap_or_default();
        let DMat3 { x_axis, y_axis, z_axis } = scene_from_local.matrix3;
        let [x, y, z] = [x_axis, y_axis, z_axis].map(vector);
        let rows = [cross(&y, &z), cross(&z, &x), cross(&x, &y)];
        let determinant = dot(&x, &rows[0]);
        Self {
            primitive,
            scene_from_local,
            local_from_scene: scene_from_local.inverse(),
            tree,
            root,
            rows,
            determinant,
        }
    }

    /// Returns the crossings of the boundary as this program finds them, by a ray that is inside at first or not.
    pub fn crossings(&self, ray: &Ray, start: Option<RayStart>, is_inside: bool) -> Vec<Hit> {
        let mut hits = Vec::new();
        self.tree.crossings(self.root, ray, start, f64::INFINITY, is_inside, &mut Stack::new(), |hit| {
            hits.push(hit);
            true
        });
        hits
    }

    /// Returns the distances of the crossings of a ray from outside.
    pub fn ours(&self, ray: &Ray) -> Vec<f64> {
        self.crossings(ray, None, false).iter().map(|hit| hit.t).collect()
    }

    /// Returns the start of a ray that continues from a hit of this solid.
    pub fn start(&self, hit: &Hit) -> RayStart {
        RayStart { root: self.root, surface: hit.surface }
    }

    /// Returns this program's normal at a point of a face.
    pub fn normal(&self, surface: Surface, point: DVec3) -> DVec3 {
        self.tree.leaf(surface).normal(surface.face, point)
    }

    /// Returns the crossings of the line as a textbook finds them, in order: roots by −b ± √(b² − ac) that lie between
    /// the caps, and points on the caps within their circles.
    pub fn textbook(&self, ray: &Ray) -> Vec<f64> {
        let o = self.local_from_scene.transform_point3(ray.origin);
        let d = self.local_from_scene.transform_vector3(ray.direction);
        let (middle, slope) = radius(self.primitive);
        let round = |p: DVec3, q: DVec3| p.x * q.x + p.z * q.z;
        let (a, b, c) = match self.primitive {
            Primitive::Sphere => (d.dot(d), o.dot(d), o.dot(o) - 1.0),
            _ => {
                let (r, rise) = (middle + slope * o.y, slope * d.y);
                (round(d, d) - rise * rise, round(o, d) - r * rise, round(o, o) - r * r)
            }
        };
        let root = (b * b - a * c).sqrt();
        let mut places: Vec<f64> = [(-b - root) / a, (-b + root) / a].into_iter().filter(|t| t.is_finite()).collect();
        if self.primitive != Primitive::Sphere {
            places.retain(|t| (o.y + d.y * t).abs() <= 1.0);
            for cap in [-1.0, 1.0] {
                let t = (cap - o.y) / d.y;
                let (p, r) = (o + d * t, middle + slope * cap);
                places.extend((t.is_finite() && round(p, p) <= r * r).then_some(t));
            }
        }
        places.sort_by(f64::total_cmp);
        places
    }

    /// Returns a point's own coordinates times [`PlacedPrimitive::determinant`].
    fn own(&self, point: DVec3) -> Vector {
        let (p, at) = (vector(point), vector(self.scene_from_local.translation));
        let from_centre: Vector = [0, 1, 2].map(|axis| &p[axis] - &at[axis]);
        self.own_vector(&from_centre)
    }

    fn own_vector(&self, v: &Vector) -> Vector {
        [0, 1, 2].map(|row| dot(&self.rows[row], v))
    }

    /// Returns the exact quadratic of the line through the ray.
    pub fn truth(&self, ray: &Ray) -> Truth {
        let (o, d) = (self.own(ray.origin), self.own_vector(&vector(ray.direction)));
        let one = &self.determinant;
        if self.primitive == Primitive::Sphere {
            return Truth { a: dot(&d, &d), b: dot(&o, &d), c: dot(&o, &o) - one * one, cap_distances: None };
        }
        let (middle, slope) = radius(self.primitive);
        let (middle, slope) = (Exact::from(middle), Exact::from(slope));
        let (r, rise) = (middle * one + &slope * &o[1], &slope * &d[1]);
        let round = |p: &Vector, q: &Vector| &p[0] * &q[0] + &p[2] * &q[2];
        Truth {
            a: round(&d, &d) - &rise * &rise,
            b: round(&o, &d) - &r * &rise,
            c: round(&o, &o) - &r * &r,
            cap_distances: Some(Caps { y: o[1].clone(), speed: d[1].clone(), height: one.clone() }),
        }
    }

    /// Returns a vector along the outward normal of a sphere's image through `point`.
    pub fn gradient(&self, point: DVec3) -> Vector {
        let own = self.own(point);
        [0, 1, 2].map(|axis| dot(&own, &[0, 1, 2].map(|row| self.rows[row][axis].clone())))
    }

    /// Returns the outward component of a ray's direction at the flat face on which it starts. Faces are numbered as in
    /// the tree.
    pub fn outwards_of_cap(&self, ray: &Ray, is_upper: bool) -> Exact {
        let speed = dot(&self.rows[1], &vector(ray.direction));
        if is_upper { speed } else { Exact::from(0.0) - speed }
    }
}

impl Truth {
    /// Returns whether part of the line is inside.
    pub fn intersects(&self) -> bool {
        let Self { a, b, c, cap_distances } = self;
        let dips = a.is_positive() && (b * b - a * c).is_positive();
        let Some(Caps { y, speed, height }) = cap_distances else { return dips };
        if speed.sign().is_eq() {
            // No line along a cap is wholly inside a cylinder or cone.
            return dips && (y - height).is_negative() && (y + height).is_positive();
        }
        // The caps are at t = n / speed.
        let ends = [(Exact::from(0.0) - height) - y, height - y];
        if ends.iter().any(|n| (a * n * n + b * n * speed * Exact::from(2.0) + c * speed * speed).is_negative()) {
            return true;
        }
        // Outside at both caps: the line dips inside if the least value lies between them.
        let sides = ends.map(|n| (n * a + b * speed).sign());
        dips && sides[0] != sides[1] && sides.iter().all(|side| side.is_ne())
    }

    /// Returns whether the point at distance `t` is inside.
    pub fn contains(&self, t: f64) -> bool {
        let t = Exact::from(t);
        let is_round = ((&self.a * &t + &self.b * Exact::from(2.0)) * &t + &self.c).is_negative();
        is_round
            && self.cap_distances.as_ref().is_none_or(|Caps { y, speed, height }| {
                let y = y + speed * t;
                (&y - height).is_negative() && (y + height).is_positive()
            })
    }

    /// Returns whether a method's distances are wrong: no entry and exit where part of the line is inside, or any
    /// distance where none is.
    pub fn contradicts(&self, places: &[f64]) -> bool {
        is_impossible(places) || places.is_empty() == self.intersects()
    }

    /// Returns whether a method's distances are further than `tolerance` from the crossings of the line.
    pub fn contradicts_within(&self, places: &[f64], tolerance: f64) -> bool {
        let is_wrong = |(index, t): (usize, &f64)| {
            let enters = index % 2 == 0;
            self.contains(t - tolerance) == enters || self.contains(t + tolerance) != enters
        };
        self.contradicts(places) || places.iter().enumerate().any(is_wrong)
    }
}

/// Returns whether the distances are impossible for a convex solid: an odd number, more than two, or not finite.
pub(super) fn is_impossible(places: &[f64]) -> bool {
    !matches!(places.len(), 0 | 2) || places.iter().any(|t| !t.is_finite())
}

/// Returns the radius at height y as r₀ and k of r₀ + k y.
fn radius(primitive: Primitive) -> (f64, f64) {
    match primitive {
        Primitive::Cone { bottom, top } => ((top + bottom) / 2.0, (top - bottom) / 2.0),
        _ => (1.0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::random::{random_placement, uniform, unit_vector};
    use super::*;

    /// On lines without difficulty all three methods agree.
    #[test]
    fn methods_agree_on_easy_lines() {
        let rng = &mut fastrand::Rng::with_seed(1);
        let (mut hits, mut all) = (0, 0);
        for primitive in [Primitive::Sphere, Primitive::Cylinder, Primitive::Cone { bottom: 1.0, top: 0.25 }] {
            for _ in 0..2000 {
                let placed_primitive =
                    PlacedPrimitive::new(primitive, random_placement(rng, DVec3::new(1.0, 0.7, 0.5)));
                let target = placed_primitive.scene_from_local.translation + unit_vector(rng) * uniform(rng, 0.0, 1.5);
                let direction = unit_vector(rng);
                let ray = Ray::new(target - direction * 5.0, direction);
                let truth = placed_primitive.truth(&ray);
                let (ours, textbook) = (placed_primitive.ours(&ray), placed_primitive.textbook(&ray));
                assert!(!truth.contradicts_within(&ours, 1e-12) && !truth.contradicts_within(&textbook, 1e-12));
                all += 1;
                hits += u32::from(truth.intersects());
            }
        }
        assert!(hits > all / 4 && hits < all * 3 / 4, "{hits} of {all}");
    }
}
