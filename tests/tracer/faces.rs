//! Rays that start on a face, and coincident faces of different solids.

use anel::csg::{MaterialTag, Primitive, QuadricCoefficients, RayStart, Solid, Stack, Tree};
use anel::geometry::{Ray, rotation};
use anel::picture::{Colour, Quality, Size};
use anel::scene::Scene;
use anel::tracer::{RayCounts, Scratch, Tracer};
use glam::{DAffine3, DMat3, DVec3};
use proptest::prelude::*;

fn primitives() -> impl Strategy<Value = Primitive> {
    let paraboloid = QuadricCoefficients {
        squares: DVec3::new(1.0, 0.0, 1.0),
        products: DVec3::ZERO,
        linear: DVec3::NEG_Y,
        constant: -1.0,
    };
    prop_oneof![
        Just(Primitive::Sphere),
        Just(Primitive::HalfSpace { normal: DVec3::new(0.6, 0.0, 0.8), offset: 0.2 }),
        Just(Primitive::Cube),
        Just(Primitive::Cylinder),
        Just(Primitive::Cone { bottom: 1.0, top: 0.0 }),
        Just(Primitive::Cone { bottom: 0.3, top: 1.0 }),
        (0.05..0.95f64).prop_map(|tube| Primitive::Torus { tube }),
        Just(Primitive::Quadric(paraboloid)),
    ]
}

fn vectors(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
    (range.clone(), range.clone(), range).prop_map(DVec3::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// A ray that leaves a face outwards, at any angle, never hits its own convex solid again, and a torus only from
    /// outside. A ray inwards hits the exit.
    #[test]
    fn ray_that_starts_on_a_face_has_no_surface_acne(
        primitive in primitives(), scale in vectors(0.3..1.5), degrees in vectors(0.0..360.0), at in vectors(-1.0..1.0),
        aim in vectors(-0.7..0.7), from in vectors(-1.0..1.0), aside in vectors(-1.0..1.0), power in 1.0..8.0f64
    ) {
        prop_assume!(from.length() > 0.1 && aside.length() > 0.1);
        let map = DAffine3 { matrix3: rotation(degrees) * DMat3::from_diagonal(scale), translation: at };
        let mut tree = Tree::default();
        let placed = Solid::Placed { primitive, scene_from_local: map, tag: MaterialTag(0) };
        let (root, _) = tree.add(&placed).expect("a primitive is not empty");
        let target = map.transform_point3(aim);
        let ray = Ray::new(target - from.normalize() * 5.0, from.normalize());
        let stack = &mut Stack::new();
        let hit = tree.nearest(root, &ray, None, f64::INFINITY, false, stack);
        let Some(hit) = hit.filter(|hit| hit.enters) else { return Ok(()) };
        let normal = tree.leaf(hit.surface).normal(hit.surface.face, ray.at(hit.t));
        let along = normal.cross(aside.normalize());
        prop_assume!(along.length() > 0.1);
        let (sine, cosine) = 10f64.powf(-power).sin_cos();
        let start = RayStart { root, surface: hit.surface };
        let mut next = |side: f64| {
            let direction = along.normalize() * cosine + normal * (side * sine);
            let onward = ray.onward(hit.t, direction.normalize());
            tree.nearest(root, &onward, Some(start), f64::INFINITY, side < 0.0, stack)
        };
        let (outwards, is_convex) = (next(1.0), !matches!(primitive, Primitive::Torus { .. }));
        prop_assert!(outwards.is_none_or(|hit| !is_convex && hit.enters), "outwards at 1e-{power}: {outwards:?}");
        let inwards = next(-1.0);
        let endless = matches!(primitive, Primitive::HalfSpace { .. });
        let leaves = inwards.map_or(endless, |exit| !exit.enters && exit.t > 0.0);
        prop_assert!(leaves, "inwards at 1e-{power}: {inwards:?}");
    }
}

fn traced(text: &str, size: &str) -> (Vec<Colour>, RayCounts) {
    let scene = Scene::parse(text).unwrap_or_else(|error| panic!("{error}"));
    let size: Size = size.parse().expect("a size");
    let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
    Tracer::new(&scene, size, Quality::default()).trace(0..size.pixels(), &mut scratch, &mut pixels);
    (pixels, scratch.rays)
}

/// The number of pixels that differ when `OBJECTS` in `scene` is replaced by `a, b` and by `b, a`.
fn differing_by_order(scene: &str, a: &str, b: &str) -> usize {
    let render = |objects: String| traced(&scene.replace("OBJECTS", &objects), "160x120").0;
    let (one, other) = (render(format!("{a}, {b}")), render(format!("{b}, {a}")));
    assert!(one.iter().any(|pixel| *pixel != one[0]), "the picture is not empty");
    one.iter().zip(&other).filter(|(p, q)| p.iter().zip(*q).any(|(p, q)| (p - q).abs() > 1e-4)).count()
}

const GLASS: &str = r#"(camera: (eye: (3, 4, 6), look_at: (0, 0, 0)), ambient: (0.3, 0.3, 0.3),
    background: (0.2, 0.4, 0.8), lights: [Point(position: (2, 9, 5))],
    materials: {"glass": (ka: 0, kd: 0, ks: 0.1, kt: 0.9, ior: 1.5), "floor": (colour: (0.8, 0.3, 0.1))},
    objects: [OBJECTS])"#;

#[test]
fn glass_in_contact_looks_the_same_in_either_order() {
    let turn = "transform: [Rotate((10, 25, 5))]";
    let front = format!(r#"Box(min: (-1, -1, 0), max: (1, 1, 1), material: "glass", {turn})"#);
    let back = format!(r#"Box(min: (-1, -1, -1), max: (1, 1, 0), material: "glass", {turn})"#);
    assert_eq!(differing_by_order(GLASS, &front, &back), 0);
}

#[test]
fn glass_on_a_floor_looks_the_same_in_either_order() {
    let glass = r#"Box(min: (-1, 0, -1), max: (1, 1, 1), material: "glass")"#;
    let floor = r#"HalfSpace(normal: (0, 1, 0), material: "floor")"#;
    assert_eq!(differing_by_order(GLASS, glass, floor), 0);
}

#[test]
fn coincident_fronts_of_two_clear_solids_are_one_surface() {
    let text = r#"(camera: (eye: (0.1, 0.2, 5), look_at: (0.1, 0.2, 0)), background: (1, 1, 1),
        materials: {"clear": (ka: 0, kd: 0, kt: 1)},
        objects: [Box(min: (-1, -1, -1), max: (1, 1, 1), material: "clear"),
                  Box(min: (-2, -2, -3), max: (2, 2, 1), material: "clear")])"#;
    let (pixels, rays) = traced(text, "1x1");
    // Into both at once, out of the nearer one, out of the other.
    assert_eq!((pixels[0], rays.refracted), ([1.0; 3], 3));
}

/// The rounding error of one reflection must not grow in the next.
#[test]
fn ray_in_a_mirror_ball_stays_in_it_for_fifty_reflections() {
    for radius in [1.0, 1e9] {
        let text = format!(
            r#"(camera: (eye: (0.3, 0.2, 0.1), look_at: (1, 2, 3)), materials: {{"mirror": (ks: 1)}},
            objects: [Sphere(radius: {radius:.0}, material: "mirror")])"#
        );
        let scene = Scene::parse(&text).unwrap_or_else(|error| panic!("{error}"));
        let quality = Quality { max_depth: 50, ..Quality::default() };
        let mut rays = 0;
        Tracer::new(&scene, Size::new(8, 6).expect("small"), quality).paths(0..48, &mut Scratch::default(), |path| {
            rays += 1;
            let (length, distance) = (path.ray.direction.length(), path.ray.at(path.to).length());
            assert!((length - 1.0).abs() < 1e-14, "level {}: the direction's length is {length}", path.level);
            assert!((distance / radius - 1.0).abs() < 1e-12, "level {}: {distance} from the centre", path.level);
        });
        assert_eq!(rays, 48 * 50);
    }
}

#[test]
fn lamp_in_the_ceiling_lights_like_one_just_below_it() {
    let room = |lamp: f64| {
        format!(
            r#"(camera: (eye: (0, 2.5, 6), look_at: (0, 0, 0)), lights: [Point(position: (0.3, {lamp}, 0.7))],
            materials: {{"wall": (ka: 0, kd: 1)}},
            objects: [HalfSpace(normal: (0, 1, 0), material: "wall"),
                Sphere(centre: (0, 1, 0), radius: 0.5, material: "wall"),
                HalfSpace(normal: (0, -1, 0), offset: -4.1, material: "wall")])"#
        )
    };
    let (inside, below) = (traced(&room(4.1), "100x75").0, traced(&room(4.1 - 1e-6), "100x75").0);
    let differing = inside.iter().zip(&below).filter(|(a, b)| (a[0] - b[0]).abs() > 1e-3).count();
    assert_eq!(differing, 0);
}
