//! Faces at one place, and faces close together: what grouping of distances costs.

use fastrand::Rng;
use glam::{DAffine3, DVec3};

use super::Workload;
use crate::csg::{Leaf, LeafIndex, MaterialTag, Primitive, RootId, Solid, Stack, Surface, Tree};
use crate::geometry::Ray;
use crate::study::random::{perpendicular, random_rotation, uniform, unit_vector};

/// Rays of the study.
const TRIES: usize = 100_000;

/// A ray, and a difference or intersection of two convex leaves.
pub(super) struct Try {
    ray: Ray,
    tree: Tree,
    root: RootId,
    is_difference: bool,
    right: u64,
}

pub(super) fn workload(rng: &mut Rng) -> Workload<Try> {
    tried(rng, TRIES)
}

pub(super) fn tried(rng: &mut Rng, tries: usize) -> Workload<Try> {
    let tries: Vec<Try> =
        (0..tries).map(|_| if rng.bool() { through_a_bore(rng) } else { through_a_plate(rng) }).collect();
    Workload {
        name: "flush",
        title: "Faces at one place",
        about: "Half of the rays pass a cylinder through a bore that ends exactly where the cylinder ends: they must \
                cross nothing. Half pass a plate of a thickness of 10⁻¹ to 10⁻⁷, the intersection of two half-spaces: \
                they must cross two faces. All is turned at random. Ours groups distances within 10⁻¹² of the numbers that they \
                were computed from. Without grouping, rounding leaves skins over the \
                bore; roots in f32 need so wide a tolerance that thin plates are lost. Truth: by construction.",
        truth: tries.iter().map(|one| one.right).collect(),
        tries,
        methods: vec![
            ("ours", |tries, out| {
                let mut stack = Stack::new();
                out.extend(tries.iter().map(|Try { ray, tree, root, .. }| {
                    let mut count = 0;
                    tree.crossings(*root, ray, None, f64::INFINITY, false, &mut stack, |_| {
                        count += 1;
                        true
                    });
                    count
                }));
            }),
            ("without grouping", |tries, out| {
                out.extend(tries.iter().map(|one| one.count(|_| 0.0, |t| t)));
            }),
            ("f32 roots, grouped", |tries, out| {
                let single = |t: f64| f64::from(t as f32);
                out.extend(tries.iter().map(|one| one.count(|t| 4.0 * f64::from(f32::EPSILON) * (10.0 + t), single)));
            }),
        ],
        is_wrong: |answer, truth| answer != truth,
    }
}

impl Try {
    /// Counts the crossings by the spans of both leaves. `tolerance` is the greatest difference between equal
    /// distances, `rounded` rounds a distance.
    #[inline(always)]
    fn count(&self, tolerance: impl Fn(f64) -> f64, rounded: impl Fn(f64) -> f64) -> u64 {
        let [first, second] = [0, 1].map(|leaf| self.leaf(leaf).first_span(&self.ray));
        let Some([enter, leave]) = first.map(|span| span.map(&rounded)) else { return 0 };
        let Some([from, to]) = second.map(|span| span.map(&rounded)) else {
            return if self.is_difference { 2 } else { 0 };
        };
        let is_long = |from: f64, to: f64| to > from + tolerance(from.abs());
        if self.is_difference {
            2 * (u64::from(is_long(enter, from)) + u64::from(is_long(to, leave)))
        } else {
            2 * u64::from(is_long(enter.max(from), leave.min(to)))
        }
    }

    fn leaf(&self, index: u32) -> &Leaf {
        self.tree.leaf(Surface { leaf: LeafIndex::of(index), face: 0 })
    }
}

fn compiled(ray: Ray, solid: &Solid, right: u64) -> Try {
    let mut tree = Tree::default();
    let (root, _) = tree.add(solid).expect("the solid is not empty");
    Try { ray, tree, root, is_difference: matches!(solid, Solid::Difference(_)), right }
}

fn through_a_bore(rng: &mut Rng) -> Try {
    let turned = random_rotation(rng);
    let place = DAffine3 { matrix3: turned, translation: unit_vector(rng) * uniform(rng, 0.0, 10.0) };
    let body = place * DAffine3::from_scale(DVec3::new(1.0, 1.5, 1.0));
    // The same height by a longer sequence: moved, scaled, moved back.
    let up = DAffine3::from_translation(DVec3::Y * 0.75) * DAffine3::from_scale(DVec3::new(0.4, 0.75, 0.4));
    let bore =
        place * DAffine3::from_translation(DVec3::Y * -1.5) * DAffine3::from_scale(DVec3::new(1.0, 2.0, 1.0)) * up;
    let axis = turned * DVec3::Y;
    // Slightly tilted, so that a ray passes both caps but no wall.
    let direction = (axis + perpendicular(rng, axis) * uniform(rng, 0.0, 0.02)).normalize();
    let through = place.translation + perpendicular(rng, axis) * uniform(rng, 0.0, 0.3);
    let cylinder =
        |scene_from_local| Solid::Placed { primitive: Primitive::Cylinder, scene_from_local, tag: MaterialTag(0) };
    let solid = Solid::Difference(vec![cylinder(body), cylinder(bore)]);
    compiled(Ray::new(through - direction * 8.0, direction), &solid, 0)
}

fn through_a_plate(rng: &mut Rng) -> Try {
    let turned = random_rotation(rng);
    let half = 10f64.powf(uniform(rng, -7.0, -1.0)) / 2.0;
    let side = |y: f64| Solid::Placed {
        primitive: Primitive::HalfSpace { normal: DVec3::Y * y, offset: half },
        scene_from_local: DAffine3::from_mat3(turned),
        tag: MaterialTag(0),
    };
    let tilted = (DVec3::NEG_Y + perpendicular(rng, DVec3::Y) * uniform(rng, 0.0, 0.5)).normalize();
    let target = perpendicular(rng, DVec3::Y) * rng.f64();
    let ray = Ray::new(turned * (target - tilted * 10.0), turned * tilted);
    compiled(ray, &Solid::Intersection(vec![side(1.0), side(-1.0)]), 2)
}
