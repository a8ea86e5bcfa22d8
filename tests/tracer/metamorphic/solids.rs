//! Random solids and rays.

use anel::csg::{MaterialTag, Primitive, QuadricCoefficients, Solid};
use anel::geometry::{Ray, rotation};
use glam::{DAffine3, DMat3, DVec3};
use proptest::prelude::*;

/// The primitive scaled, then rotated, then moved.
pub fn placed(primitive: Primitive, scale: DVec3, degrees: DVec3, at: DVec3) -> Solid {
    let matrix3 = rotation(degrees) * DMat3::from_diagonal(scale);
    Solid::Placed { primitive, scene_from_local: DAffine3 { matrix3, translation: at }, tag: MaterialTag(0) }
}

pub fn vectors(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
    (range.clone(), range.clone(), range).prop_map(DVec3::from)
}

/// A ray that passes near the middle, from outside or inside.
pub fn rays() -> impl Strategy<Value = Ray> {
    let ends =
        (vectors(-4.0..4.0), vectors(-1.0..1.0)).prop_filter("two points", |(from, to)| (to - from).length() > 0.1);
    ends.prop_map(|(from, to)| Ray::new(from, (to - from).normalize()))
}

/// Primitives placed at random near the middle, and compositions of up to two dozen of them.
pub fn solids() -> impl Strategy<Value = Solid> {
    compositions(prop_oneof![
        3 => bodies(),
        1 => Just(Primitive::HalfSpace { normal: DVec3::new(0.6, 0.0, 0.8), offset: 0.2 }),
        1 => sheets(),
    ])
}

/// Like [`solids`], but bounded.
pub fn closed_solids() -> impl Strategy<Value = Solid> {
    compositions(bodies())
}

/// Vectors of integer multiples of `step`.
fn lattice(range: std::ops::RangeInclusive<i32>, step: f64) -> impl Strategy<Value = DVec3> {
    [range.clone(), range.clone(), range].prop_map(move |multiples| DVec3::from(multiples.map(f64::from)) * step)
}

fn bodies() -> impl Strategy<Value = Primitive> {
    prop_oneof![
        Just(Primitive::Sphere),
        Just(Primitive::Cube),
        Just(Primitive::Cylinder),
        (0.0..1.0f64).prop_map(|top| Primitive::Cone { bottom: 1.0, top }),
        (0.1..0.9f64).prop_map(|tube| Primitive::Torus { tube }),
    ]
}

/// Hyperboloids of one sheet and of two.
pub fn sheets() -> impl Strategy<Value = Primitive> {
    (0.3..2.0f64, -0.5..0.5f64).prop_map(|(slope, constant)| {
        let squares = DVec3::new(1.0, -slope, 1.0);
        Primitive::Quadric(QuadricCoefficients { squares, products: DVec3::ZERO, linear: DVec3::ZERO, constant })
    })
}

fn compositions(primitives: impl Strategy<Value = Primitive> + 'static) -> impl Strategy<Value = Solid> {
    let at_random = (vectors(0.3..1.5), vectors(0.0..360.0), vectors(-1.0..1.0));
    // On a lattice many faces coincide.
    let on_a_lattice = (lattice(1..=2, 0.5), lattice(0..=3, 90.0), lattice(-2..=2, 0.5));
    let leaf = (primitives, prop_oneof![2 => at_random, 1 => on_a_lattice])
        .prop_map(|(primitive, (scale, degrees, at))| placed(primitive, scale, degrees, at));
    leaf.prop_recursive(4, 24, 4, |inner| {
        let several = prop::collection::vec(inner, 1..4);
        prop_oneof![
            several.clone().prop_map(Solid::Union),
            several.clone().prop_map(Solid::Intersection),
            several.prop_map(Solid::Difference),
        ]
    })
}
