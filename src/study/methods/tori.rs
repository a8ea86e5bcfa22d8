//! Rays and tori: the roots of a quartic.

use fastrand::Rng;
use glam::DAffine3;

use super::Workload;
use crate::csg::{Leaf, MaterialTag, Primitive, Solid, Surface, Tree};
use crate::geometry::Ray;
use crate::study::random::{uniform, unit_vector};
use crate::study::stability::torus::{closed_form, distinct_roots, quartic};

/// Rays of the study; the truth of each takes long.
const TRIES: usize = 20_000;

/// A ray and a torus about the y axis, with a ring of radius 1.
pub(super) struct Try {
    ray: Ray,
    leaf: Leaf,
    tube: f64,
}

pub(super) fn workload(rng: &mut Rng) -> Workload<Try> {
    tried(rng, TRIES)
}

pub(super) fn tried(rng: &mut Rng, tries: usize) -> Workload<Try> {
    let tries: Vec<Try> = (0..tries).map(|_| attempt(rng)).collect();
    Workload {
        name: "tori",
        title: "Tori",
        about: "A torus of radius 1, with a tube of 0.01 to 0.5, and a ray from a distance of 3 to 10,000 towards it: \
                how many crossings? Truth: the changes of sign in Sturm's chain, without rounding. The closed form \
                (Ferrari, Cardano) uses coefficients that grow with the fourth power of the distance; ours finds the \
                roots between those of the derivatives.",
        truth: tries.iter().map(|Try { ray, tube, .. }| distinct_roots(&quartic(*tube, ray)) as u64).collect(),
        tries,
        methods: vec![
            ("ours", |tries, out| {
                out.extend(tries.iter().map(|Try { ray, leaf, .. }| leaf.count_crossings(ray)));
            }),
            ("closed form", |tries, out| {
                out.extend(tries.iter().map(|Try { ray, tube, .. }| closed_form(*tube, ray) as u64));
            }),
        ],
        is_wrong: |answer, truth| answer != truth,
    }
}

fn attempt(rng: &mut Rng) -> Try {
    let tube = 10f64.powf(uniform(rng, -2.0, -0.3));
    let target = unit_vector(rng) * uniform(rng, 0.0, 1.5);
    let origin = target + unit_vector(rng) * 10f64.powf(uniform(rng, 0.5, 4.0));
    let ray = Ray::new(origin, (target - origin).normalize());
    let mut tree = Tree::default();
    let scene_from_local = DAffine3::IDENTITY;
    tree.add(&Solid::Placed { primitive: Primitive::Torus { tube }, scene_from_local, tag: MaterialTag(0) });
    let leaf = tree.leaf(Surface { leaf: Default::default(), face: 0 }).clone();
    Try { ray, leaf, tube }
}
