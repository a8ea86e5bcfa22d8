//! Normals of flat ellipsoids.

use fastrand::Rng;
use glam::{DAffine3, DMat3, DVec3};

use super::super::exact::{cross, dot, vector};
use super::super::random::{random_rotation, unit_vector};
use super::placed_primitive::PlacedPrimitive;
use super::{MethodResult, ResultCounter, StabilityCase, powers_of_10};
use crate::csg::{LeafIndex, Primitive, Surface};
use crate::view::Scale;

pub(super) fn cases() -> [StabilityCase; 2] {
    let flat = |name, title, about, required, attempt| StabilityCase {
        name,
        title,
        about,
        parameter: "scale s",
        values: powers_of_10(0, -10),
        required,
        scale: Scale::Log10,
        methods: &["as a vector", "ours"],
        measured_figure: Some("greatest n · tangent"),
        tries: 5000,
        attempt,
    };
    [
        flat(
            "ellipsoid",
            "Normals of a flat ellipsoid",
            "A sphere scaled by (1, 1, s), and our normal at its points: the greatest n · tangent of any unit \
             tangent, which is the sine of the angle to the true normal. Naive: the sphere's normal, transformed as a \
             vector instead of by the inverse transpose. Wrong: more than 10⁻¹². Truth: the exact gradient at that \
             very point.",
            1e-3,
            |scale, tries, rng| attempt(scale, tries, rng, |_| DMat3::IDENTITY),
        ),
        flat(
            "ellipsoid-turned",
            "Normals of a flat ellipsoid that is rotated",
            "The same, rotated at random. At its rim the ellipsoid's curvature is s⁻², so that the last digit of a \
             point, or of the rotation, moves the true normal by some 10⁻¹⁶ s⁻²: from s = 10⁻³ on a normal is as \
             exact as its point, but no longer within 10⁻¹².",
            1e-2,
            |scale, tries, rng| attempt(scale, tries, rng, random_rotation),
        ),
    ]
}

fn attempt(scale: f64, tries: u32, rng: &mut Rng, turned: fn(&mut Rng) -> DMat3) -> Vec<MethodResult> {
    const MAX_ERROR: f64 = 1e-12;
    let mut count = ResultCounter::<2>::new();
    for _ in 0..tries {
        let map = DAffine3::from_mat3(turned(rng) * DMat3::from_diagonal(DVec3::new(1.0, 1.0, scale)));
        let ellipsoid = PlacedPrimitive::new(Primitive::Sphere, map);
        let own = unit_vector(rng);
        let point = map.transform_point3(own);
        let truth = ellipsoid.gradient(point);
        let sine = |normal: DVec3| {
            let normal = vector(normal);
            let across = cross(&normal, &truth);
            (dot(&across, &across).to_f64() / (dot(&normal, &normal) * dot(&truth, &truth)).to_f64()).sqrt()
        };
        let ours = ellipsoid.normal(Surface { leaf: LeafIndex::default(), face: 0 }, point);
        count.add_errors([map.transform_vector3(own).normalize(), ours].map(sine), MAX_ERROR);
    }
    count.results()
}

#[cfg(test)]
mod tests {
    #[test]
    fn normals_of_flat_ellipsoids_are_exact() {
        super::cases().iter().for_each(|case| super::super::check(case, 300));
    }
}
