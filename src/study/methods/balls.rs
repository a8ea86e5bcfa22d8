//! Rays and balls: the roots of a quadratic.

use fastrand::Rng;
use glam::{DAffine3, DVec3, Vec3};

use super::Workload;
use crate::csg::{Leaf, MaterialTag, Primitive, Solid, Surface, Tree};
use crate::geometry::Ray;
use crate::study::exact::{Exact, dot, vector};
use crate::study::random::{perpendicular, random_sign, uniform, unit_vector};

/// Rays of the study.
const TRIES: usize = 200_000;

/// A ray and a ball, in both precisions.
pub(super) struct Try {
    ray: Ray,
    leaf: Leaf,
    centre: DVec3,
    radius: f64,
    /// Origin relative to the centre, direction and radius.
    single: (Vec3, Vec3, f32),
}

pub(super) fn workload(rng: &mut Rng) -> Workload<Try> {
    tried(rng, TRIES)
}

pub(super) fn tried(rng: &mut Rng, tries: usize) -> Workload<Try> {
    let tries: Vec<Try> = (0..tries).map(|_| attempt(rng)).collect();
    Workload {
        name: "balls",
        title: "Balls",
        about: "A ball of radius 1 and a ray from a distance of 2 to 10,000. Half of the rays pass the centre at any \
                distance up to 2, half pass a tangent's point by 10⁻¹ to 10⁻¹² radii: hit or miss? Truth: the sign of \
                the discriminant, without rounding. The textbook's b² − ac is a difference of numbers that grow with \
                the square of the distance; ours takes the discriminant from the line's closest approach.",
        truth: tries.iter().map(truth).collect(),
        tries,
        methods: vec![
            ("ours", |tries, out| {
                out.extend(tries.iter().map(|Try { ray, leaf, .. }| leaf.count_crossings(ray)));
            }),
            ("f64, textbook", |tries, out| {
                out.extend(tries.iter().map(|&Try { ray, centre, radius, .. }| {
                    let f = ray.origin - centre;
                    let (b, c) = (f.dot(ray.direction), f.length_squared() - radius * radius);
                    crossings(b * b - c > 0.0)
                }));
            }),
            ("ours in f32", |tries, out| {
                out.extend(tries.iter().map(|&Try { single: (f, d, radius), .. }| {
                    let closest = f - d * f.dot(d);
                    crossings(radius * radius - closest.length_squared() > 0.0)
                }));
            }),
            ("f32, textbook", |tries, out| {
                out.extend(tries.iter().map(|&Try { single: (f, d, radius), .. }| {
                    let (b, c) = (f.dot(d), f.length_squared() - radius * radius);
                    crossings(b * b - c > 0.0)
                }));
            }),
        ],
        is_wrong: |answer, truth| answer != truth,
    }
}

fn crossings(is_hit: bool) -> u64 {
    if is_hit { 2 } else { 0 }
}

fn attempt(rng: &mut Rng) -> Try {
    let centre = unit_vector(rng) * uniform(rng, 0.0, 2.0);
    let direction = unit_vector(rng);
    let distance = 10f64.powf(uniform(rng, 0.3, 4.0));
    let past = if rng.bool() {
        uniform(rng, 0.0, 2.0)
    } else {
        1.0 + random_sign(rng) * 10f64.powf(uniform(rng, -12.0, -1.0))
    };
    let ray = Ray::new(centre + perpendicular(rng, direction) * past - direction * distance, direction);
    let single = ((ray.origin - centre).as_vec3(), ray.direction.as_vec3(), 1.0);
    let mut tree = Tree::default();
    let scene_from_local = DAffine3::from_translation(centre);
    tree.add(&Solid::Placed { primitive: Primitive::Sphere, scene_from_local, tag: MaterialTag(0) });
    let leaf = tree.leaf(Surface { leaf: Default::default(), face: 0 }).clone();
    Try { ray, leaf, centre, radius: 1.0, single }
}

fn truth(Try { ray, centre, radius, .. }: &Try) -> u64 {
    let (o, c, d) = (vector(ray.origin), vector(*centre), vector(ray.direction));
    let f = [0, 1, 2].map(|axis| &o[axis] - &c[axis]);
    let radius = Exact::from(*radius);
    let (a, b, c) = (dot(&d, &d), dot(&f, &d), dot(&f, &f) - &radius * &radius);
    crossings((&b * &b - a * c).is_positive())
}
