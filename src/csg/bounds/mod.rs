//! Bounds of solids whose primitives have none: a quadric between planes, a polyhedron of half-spaces, a cutter without
//! end within what it cuts.
//!
//! Every solid lies within the planes and quadrics of those of its operands that it cannot leave: all operands of an
//! intersection, the first of a difference, and the far sides of what is subtracted. From these a box is computed:
//!
//! 1. A plane bounds a direction if the direction is a sum of normals ([`Polyhedron::support`]).
//! 2. A quadric bounds its own axes, given how far the others reach ([`Quadric::clip`]); this gives new planes.
//! 3. Where that leaves a direction open, a quadric and the product of two planes may have an ellipsoid as their sum
//!    ([`Quadric::ellipsoids`]): a cone between two slanted planes.
//!
//! Each step is an inequality that holds for all points of the solid, so the box contains it. A box with an infinite
//! side is not used.

mod polyhedron;
mod quadric;

use glam::DAffine3;

use self::polyhedron::{Plane, Polyhedron};
use self::quadric::Quadric;
use super::{Primitive, Solid};
use crate::geometry::Aabb;

/// Planes and quadrics within which a solid lies, and a box around it.
#[derive(Clone, Debug)]
pub(super) struct Extent {
    /// Contains the solid in spite of rounding.
    pub bounds: Aabb,
    planes: Polyhedron,
    quadrics: Vec<Quadric>,
}

/// More quadrics than this are left out. What is left out makes a box wider, never wrong.
const MAX_QUADRICS: usize = 8;
/// No solid that is meant reaches farther. Planes that are parallel but for rounding meet there.
const MAX_REACH: f64 = 1e13;
/// Each round makes what is known of one quadric known to the others.
const ROUNDS: usize = 4;

impl Extent {
    /// Nothing is known.
    pub const ALL: Self = Self::within(Aabb::ALL);

    /// Within a box.
    pub const fn within(bounds: Aabb) -> Self {
        Self { bounds, planes: Polyhedron::ALL, quadrics: Vec::new() }
    }

    /// The extent of a placed primitive, of which `bounds` is a box.
    pub fn of_primitive(primitive: &Primitive, scene_from_local: &DAffine3, bounds: Aabb) -> Self {
        let mut extent = Self::within(bounds);
        match primitive {
            Primitive::HalfSpace { normal, offset } => {
                extent.planes.add(Plane::placed(*normal, *offset, scene_from_local));
            }
            Primitive::Quadric(coefficients) => {
                extent.add_quadric(Quadric::new(coefficients, scene_from_local));
            }
            _ => {}
        }
        extent
    }

    /// Adds what is known of another solid that contains this one.
    pub fn add(&mut self, other: &Self) {
        self.bounds = self.bounds.intersection(other.bounds);
        self.planes.extend(&other.planes);
        other.quadrics.iter().for_each(|quadric| self.add_quadric(quadric.clone()));
    }

    fn add_quadric(&mut self, quadric: Quadric) {
        if self.quadrics.len() < MAX_QUADRICS {
            self.quadrics.push(quadric);
        }
    }

    /// Adds that this solid lies outside of `solid`, as far as that bounds it.
    pub fn add_outside(&mut self, solid: &Solid) {
        match solid {
            Solid::Placed { primitive: Primitive::HalfSpace { normal, offset }, scene_from_local, .. } => {
                self.planes.add(Plane::placed(*normal, *offset, scene_from_local).flipped());
            }
            Solid::Placed { primitive: Primitive::Quadric(coefficients), scene_from_local, .. } => {
                self.add_quadric(Quadric::new(coefficients, scene_from_local).flipped());
            }
            Solid::Union(solids) => solids.iter().for_each(|solid| self.add_outside(solid)),
            _ => {}
        }
    }

    /// Computes the box from all that is known. Once it is finite, nothing else is needed any more.
    pub fn close(&mut self) {
        self.planes.keep_those_that_cut(self.bounds);
        if self.planes.is_empty() && self.quadrics.is_empty() {
            return;
        }
        if let Some(bounds) = self.closed() {
            *self = Self::within(self.bounds.intersection(bounds.padded()));
        }
    }

    /// A finite box around the solid, if there is one.
    fn closed(&self) -> Option<Aabb> {
        let reach = |bounds: Aabb| bounds.min.abs().max(bounds.max.abs()).max_element();
        if self.bounds.is_finite() {
            return self.rounds(reach(self.bounds));
        }
        // First as if there were no rounding: this gives the coordinates to which rounding errors are relative.
        let exact = self.rounds(0.0)?;
        if reach(exact) > MAX_REACH {
            return None;
        }
        let bounds = self.rounds(reach(exact))?;
        (reach(bounds) <= 2.0 * reach(exact)).then_some(bounds)
    }

    /// Computes the box, with tolerance for rounding of coordinates up to `reach`.
    fn rounds(&self, reach: f64) -> Option<Aabb> {
        let mut planes = self.planes.clone();
        planes.add_box(self.bounds);
        let mut bounds = planes.bounds(reach);
        let rounds = if self.quadrics.is_empty() { 0 } else { ROUNDS };
        for _ in 0..rounds {
            let before = bounds;
            for quadric in &self.quadrics {
                planes.add_all(quadric.clip(&planes, reach));
            }
            bounds = planes.bounds(reach);
            if !bounds.is_finite() && !bounds.is_empty() {
                let ellipsoids = self.quadrics.iter().flat_map(|quadric| quadric.ellipsoids(&planes));
                let all = ellipsoids.fold(bounds, Aabb::intersection);
                planes.add_box(all);
                bounds = planes.bounds(reach);
            }
            if bounds == before {
                break;
            }
        }
        (bounds.is_finite() || bounds.is_empty()).then_some(bounds)
    }
}

#[cfg(test)]
mod tests {
    use glam::{DMat3, DVec3};
    use proptest::prelude::*;

    use super::*;
    use crate::csg::{MaterialTag, QuadricCoefficients, Tree};
    use crate::geometry::rotation;

    fn quadric(squares: [f64; 3], linear: [f64; 3], constant: f64) -> Primitive {
        let [squares, linear] = [squares, linear].map(DVec3::from);
        Primitive::Quadric(QuadricCoefficients { squares, products: DVec3::ZERO, linear, constant })
    }

    fn half_space(normal: [f64; 3], offset: f64) -> Primitive {
        Primitive::HalfSpace { normal: DVec3::from(normal).normalize(), offset }
    }

    fn placed(primitive: Primitive, map: DAffine3) -> Solid {
        Solid::Placed { primitive, scene_from_local: map, tag: MaterialTag(0) }
    }

    fn all(primitives: Vec<Primitive>, map: DAffine3) -> Solid {
        Solid::Intersection(primitives.into_iter().map(|primitive| placed(primitive, map)).collect())
    }

    fn bounds(solid: &Solid) -> Aabb {
        Tree::default().add(solid).expect("not empty").1
    }

    fn turned() -> DAffine3 {
        let matrix3 = rotation(DVec3::new(20.0, -35.0, 50.0)) * DMat3::from_diagonal(DVec3::new(1.0, 2.0, 0.7));
        DAffine3 { matrix3, translation: DVec3::new(-20.0, 3.0, 7.0) }
    }

    /// Parts as people draw them, each bounded, without a box of its own. In local coordinates their points lie within
    /// the number given of the origin.
    fn bounded_parts() -> Vec<(&'static str, Vec<Primitive>, f64)> {
        let hyperboloid = quadric([1.0, -1.0, 1.0], [0.0; 3], -1.0);
        let cone = quadric([1.0, -1.0, 1.0], [0.0; 3], 0.0);
        let paraboloid = quadric([1.0, 0.0, 1.0], [0.0, -1.0, 0.0], 0.0);
        let tube = quadric([1.0, 0.0, 1.0], [0.0; 3], -1.0);
        let up = |height: f64| half_space([0.0, 1.0, 0.0], height);
        let down = |height: f64| half_space([0.0, -1.0, 0.0], -height);
        vec![
            ("hyperboloid between planes", vec![hyperboloid, down(2.5), up(5.5)], 8.0),
            ("cone under a slanted plane", vec![cone, down(0.0), half_space([0.3, 1.0, 0.2], 2.0)], 5.0),
            (
                "cone between slanted planes",
                vec![cone, half_space([0.3, 1.0, 0.2], 2.0), half_space([-0.2, -1.0, 0.1], 1.0)],
                6.0,
            ),
            ("paraboloid under a plane", vec![paraboloid, up(3.0)], 3.6),
            ("paraboloid under a slanted plane", vec![paraboloid, half_space([0.5, 1.0, 0.0], 3.0)], 5.5),
            (
                "tube cut at a slant",
                vec![tube, half_space([0.4, 1.0, 0.0], 1.0), half_space([0.3, -1.0, 0.5], 1.0)],
                3.0,
            ),
            ("two tubes across", vec![tube, quadric([0.0, 1.0, 1.0], [0.0; 3], -1.0)], 1.8),
            (
                "hyperboloid in a tube",
                vec![quadric([-1.0, 1.0, 1.0], [0.0; 3], 0.2), tube, quadric([0.0, 1.0, 0.0], [0.0; 3], -4.0)],
                3.0,
            ),
            (
                "tetrahedron",
                vec![
                    half_space([1.0, 1.0, 1.0], 1.0),
                    half_space([-1.0, -1.0, 1.0], 1.0),
                    half_space([-1.0, 1.0, -1.0], 1.0),
                    half_space([1.0, -1.0, -1.0], 1.0),
                ],
                5.2,
            ),
        ]
    }

    #[test]
    fn what_is_bounded_is_found_to_be_bounded() {
        for (name, primitives, radius) in bounded_parts() {
            for map in [DAffine3::IDENTITY, turned()] {
                let found = bounds(&all(primitives.clone(), map));
                assert!(found.is_finite(), "{name}: {found:?}");
                let reach = Aabb::of_cube(&(map * DAffine3::from_scale(DVec3::splat(2.0 * radius))));
                let inside = found.min.cmpge(reach.min).all() && found.max.cmple(reach.max).all();
                assert!(inside, "{name}: {found:?} is much too wide, {reach:?}");
            }
        }
    }

    #[test]
    fn box_of_a_hyperboloid_between_planes_is_tight() {
        let (_, primitives, _) = &bounded_parts()[0];
        let found = bounds(&all(primitives.clone(), DAffine3::IDENTITY));
        let waist = (1.0_f64 + 5.5 * 5.5).sqrt();
        let expected = Aabb { min: DVec3::new(-waist, 2.5, -waist), max: DVec3::new(waist, 5.5, waist) };
        let close = (found.min - expected.min).abs().max((found.max - expected.max).abs()).max_element();
        assert!(close < 1e-6, "{found:?}");
    }

    #[test]
    fn cutters_and_unions_are_bounded_by_what_is_around_them() {
        let tube = placed(quadric([1.0, 0.0, 1.0], [0.0; 3], -1.0), turned());
        let cube = placed(Primitive::Cube, turned());
        let endless = Solid::Union(vec![tube.clone(), placed(half_space([1.0, 1.0, 0.0], 0.1), turned())]);
        for solid in [
            Solid::Intersection(vec![endless.clone(), cube.clone()]),
            Solid::Difference(vec![cube, endless]),
            Solid::Difference(vec![
                tube,
                placed(half_space([0.0, 1.0, 0.0], -1.0), turned()),
                placed(half_space([0.0, -1.0, 0.2], -1.0), turned()),
            ]),
        ] {
            let mut tree = Tree::default();
            let (root, _) = tree.add(&solid).expect("not empty");
            assert!(tree.boxes_of(root).iter().all(|bounds| bounds.is_finite()), "{solid:?}");
        }
    }

    #[test]
    fn what_has_no_bounds_gets_none() {
        let tube = quadric([1.0, 0.0, 1.0], [0.0; 3], -1.0);
        let up = half_space([0.0, 1.0, 0.0], 1.0);
        let along = half_space([1.0, 0.0, 0.0], 0.5);
        let cone = quadric([1.0, -1.0, 1.0], [0.0; 3], 0.0);
        for primitives in
            [vec![tube, up], vec![tube, along], vec![cone, up], vec![cone, half_space([1.0, 1.0, 0.0], 1.0), up]]
        {
            for map in [DAffine3::IDENTITY, turned()] {
                assert!(!bounds(&all(primitives.clone(), map)).is_finite(), "{primitives:?}");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn points_of_a_solid_lie_in_its_box(
            primitives in prop::collection::vec(primitive(), 1..6), cut in prop::collection::vec(primitive(), 0..3),
            points in prop::collection::vec(prop::array::uniform3(-4.0..4.0f64), 200), is_turned in any::<bool>(),
        ) {
            let map = if is_turned { turned() } else { DAffine3::IDENTITY };
            let mut of = vec![all(primitives, map)];
            of.extend(cut.into_iter().map(|primitive| placed(primitive, map)));
            let solid = Solid::Difference(of);
            let found = Tree::default().add(&solid);
            for point in points {
                let point = map.transform_point3(DVec3::from(point));
                let is_in_box = found.is_some_and(|(_, bounds)| {
                    point.cmpge(bounds.min).all() && point.cmple(bounds.max).all()
                });
                prop_assert!(is_in_box || !solid.contains(point), "{} lies outside {:?}", point, found);
            }
        }
    }

    fn primitive() -> impl Strategy<Value = Primitive> {
        let number = || prop_oneof![Just(0.0), Just(1.0), Just(-1.0), -2.0..2.0f64];
        let three = || [number(), number(), number()];
        prop_oneof![
            (three(), three(), three(), number()).prop_map(|(squares, products, linear, constant)| {
                let [squares, products, linear] = [squares, products, linear].map(DVec3::from);
                Primitive::Quadric(QuadricCoefficients { squares, products, linear, constant })
            }),
            (three(), number()).prop_map(|(normal, offset)| Primitive::HalfSpace {
                normal: DVec3::from(normal).normalize_or(DVec3::Y),
                offset
            }),
            Just(Primitive::Cube),
        ]
    }
}
