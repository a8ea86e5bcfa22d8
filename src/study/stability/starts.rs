//! Rays that start on a face.

use fastrand::Rng;
use glam::DVec3;

use super::super::random::{perpendicular, random_placement, random_sign, uniform, unit_vector};
use super::placed_primitive::PlacedPrimitive;
use super::{MethodResult, ResultCounter, StabilityCase, powers_of_10};
use crate::csg::Primitive;
use crate::geometry::Ray;
use crate::view::Scale;

/// Offsets of naive methods, which ignore nearer crossings.
const OFFSETS: [f64; 2] = [1e-4, 1e-9];

/// Returns the case: the root at a ray's start is 0, and rounding turns it into another number.
pub(super) fn on_faces() -> StabilityCase {
    StabilityCase {
        name: "start",
        title: "Rays that start on a face",
        about: "Rays leave a face of a sphere, ellipsoid, cylinder or cone at a small angle, from a point that \
                another ray has hit: outwards they must meet nothing, inwards they must leave the solid once. A naive \
                method ignores hits nearer than an offset: a large offset ignores the exit of a short span, a small \
                one meets the face itself again (acne). Ours knows which root of which primitive is 0. Truth: the \
                exact sign of the quadratic's slope at the start, which represents its point on the surface.",
        parameter: "angle, radians",
        values: powers_of_10(0, -16),
        required: 1e-8,
        scale: Scale::Log10,
        methods: &["beyond 1e-4", "beyond 1e-9", "ours"],
        measured_figure: None,
        tries: 8000,
        attempt,
    }
}

fn attempt(angle: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    const SEMI_AXES: DVec3 = DVec3::new(1.0, 0.8, 0.6);
    let solids = [
        (Primitive::Sphere, DVec3::ONE),
        (Primitive::Sphere, SEMI_AXES),
        (Primitive::Cylinder, SEMI_AXES),
        (Primitive::Cone { bottom: 1.0, top: 0.3 }, SEMI_AXES),
    ];
    let mut count = ResultCounter::<3>::new();
    for index in 0..tries {
        let (primitive, size) = solids[index as usize % solids.len()];
        let solid = PlacedPrimitive::new(primitive, random_placement(rng, size));
        let towards = unit_vector(rng);
        let target = solid.scene_from_local.translation + unit_vector(rng) * uniform(rng, 0.0, 0.5);
        let first = Ray::new(target - towards * 5.0, towards);
        let Some(hit) = solid.crossings(&first, None, false).into_iter().next() else { continue };
        let normal = solid.normal(hit.surface, first.at(hit.t));
        let (sine, cosine) = (angle.sin() * random_sign(rng), angle.cos());
        let ray = first.onward(hit.t, (perpendicular(rng, normal) * cosine + normal * sine).normalize());
        let face = hit.surface.face;
        let slope = if face == 0 { solid.truth(&ray).b } else { solid.outwards_of_cap(&ray, face == 2) };
        let leaves = !slope.is_negative();
        let ours = solid.crossings(&ray, Some(solid.start(&hit)), !leaves);
        let is_right =
            if leaves { ours.is_empty() } else { matches!(ours[..], [exit] if !exit.enters && exit.t > 0.0) };
        let textbook = solid.textbook(&ray);
        let is_wrong = |offset: f64| textbook.iter().filter(|&&t| t > offset).count() != usize::from(!leaves);
        count.add([is_wrong(OFFSETS[0]), is_wrong(OFFSETS[1]), !is_right]);
    }
    count.results()
}

#[cfg(test)]
mod tests {
    #[test]
    fn ray_from_a_face_neither_meets_it_again_nor_misses_its_exit() {
        super::super::check(&super::on_faces(), 2000);
    }
}
