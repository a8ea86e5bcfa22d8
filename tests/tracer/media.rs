//! Transmitting solids inside and beside each other.

use anel::picture::{Colour, Quality, Size};
use anel::scene::Scene;
use anel::tracer::{Path, RayKind, Scratch, Tracer};
use glam::DVec3;

fn tracer(text: &str, size: &str) -> (Tracer, Size) {
    let scene = Scene::parse(text).unwrap_or_else(|error| panic!("{error}"));
    let size: Size = size.parse().expect("a size");
    (Tracer::new(&scene, size, Quality { cutoff: 0.0, ..Quality::default() }), size)
}

fn traced(text: &str) -> Vec<Colour> {
    let (tracer, size) = tracer(text, "120x90");
    let mut pixels = Vec::new();
    tracer.trace(0..size.pixels(), &mut Scratch::default(), &mut pixels);
    pixels
}

/// The directions along the path of a ray that enters `objects` at 30° to the z axis, in order, without reflections.
fn directions(objects: &str) -> Vec<DVec3> {
    let text = format!(
        r#"(camera: (eye: (0, -4, 6.928203230275509), look_at: (0, 0, 0), field_of_view: 0.001), background: (1, 1, 1),
        materials: {{"glass": (ka: 0, kd: 0, kt: 1, ior: 1.5), "water": (ka: 0, kd: 0, kt: 1, ior: 1.33)}},
        objects: [{objects}])"#
    );
    let (tracer, _) = tracer(&text, "1x1");
    let mut directions: Vec<DVec3> = Vec::new();
    tracer.paths(0..1, &mut Scratch::default(), |path: Path| {
        if path.kind != RayKind::Reflected
            && directions.last().is_none_or(|last| (*last - path.ray.direction).length() > 1e-9)
        {
            directions.push(path.ray.direction);
        }
    });
    directions
}

/// A slab between two z coordinates.
fn slab(low: f64, high: f64, material: &str) -> String {
    format!(r#"Box(min: (-50, -50, {low}), max: (50, 50, {high}), material: "{material}")"#)
}

/// The sines of the angles to the z axis.
fn sines(directions: &[DVec3]) -> Vec<f64> {
    directions.iter().map(|direction| direction.truncate().length()).collect()
}

#[test]
fn ray_between_two_media_bends_by_the_ratio_of_their_indices() {
    let expected = [0.5, 0.5 / 1.33, 0.5 / 1.5, 0.5];
    let water = slab(0.0, 1.0, "water");
    // The glass overlaps the water or touches it; either is first in the scene.
    for (above, order) in [(0.1, "glass first"), (0.0, "glass first"), (0.0, "water first")] {
        let glass = slab(-1.0, above, "glass");
        let objects = if order == "glass first" { [glass, water.clone()] } else { [water.clone(), glass] };
        let sines = sines(&directions(&objects.join(", ")));
        assert_eq!(sines.len(), expected.len(), "{order}, {above}: {sines:?}");
        let close = sines.iter().zip(expected).all(|(sine, expected)| (sine - expected).abs() < 1e-9);
        assert!(close, "{order}, {above}: {sines:?}");
    }
}

#[test]
fn first_medium_in_the_scene_fills_an_overlap() {
    let (water, glass) = (slab(0.0, 2.0, "water"), slab(0.5, 1.5, "glass"));
    assert_eq!(
        sines(&directions(&format!("{water}, {glass}"))).len(),
        3,
        "glass inside water has no effect if the water is first"
    );
    assert_eq!(sines(&directions(&format!("{glass}, {water}"))).len(), 5);
}

#[test]
fn eye_in_the_water_sees_glass_in_water() {
    let inside = directions(&format!("{}, {}", slab(-1.0, 1.0, "glass"), slab(-20.0, 20.0, "water")));
    let ratio = sines(&inside)[1] / sines(&inside)[0];
    assert!((ratio - 1.33 / 1.5).abs() < 1e-9, "{ratio}");
}

/// A scene with a lamp, a floor, a ball of glass and water around it.
fn scene(objects: &str) -> String {
    format!(
        r#"(camera: (eye: (2, 3, 7), look_at: (0, 0.8, 0), field_of_view: 30), background: (0.3, 0.5, 0.7),
        ambient: (0.2, 0.2, 0.2), lights: [Point(position: (4, 9, 5))],
        materials: {{"glass": (ka: 0, kd: 0, ks: 0.1, kt: 0.8, ior: 1.5),
            "water": (ka: 0, kd: 0, ks: 0.1, kt: 0.8, ior: 1.33),
            "floor": (colour: (0.8, 0.6, 0.3))}},
        solids: {{"ball": Sphere(centre: (0.2, 0.9, 0.1), radius: 0.7),
            "pool": Box(min: (-1.3, 0.05, -1.2), max: (1.4, 1.2, 1.1))}},
        objects: [HalfSpace(normal: (0, 1, 0), material: "floor"), {objects}])"#
    )
}

/// A ball that overlaps the water, and a ball in a hole of its size, in either order: media and surfaces are the same,
/// and here all surfaces reflect and transmit alike. So the pictures are the same.
#[test]
fn ball_that_overlaps_the_water_looks_like_one_in_a_hole() {
    let (ball, pool) = (r#"Use(solid: "ball", material: "glass")"#, r#"Use(solid: "pool", material: "water")"#);
    let cut = r#"Difference(of: [Use(solid: "pool"), Use(solid: "ball")], material: "water")"#;
    let overlapping = traced(&scene(&format!("{ball}, {pool}")));
    for (objects, what) in [(format!("{ball}, {cut}"), "ball first"), (format!("{cut}, {ball}"), "water first")] {
        let pixels = traced(&scene(&objects));
        let differing =
            pixels.iter().zip(&overlapping).filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 1e-3));
        // At the outlines of ball and water a ray may pass on either side.
        assert!(differing.count() <= 3, "{what}");
    }
}

#[test]
fn thousands_of_hidden_boundaries_do_not_overflow_the_stack() {
    let slabs: Vec<String> =
        (0..3000).map(|i| slab(f64::from(i) * 1e-3, f64::from(i) * 1e-3 + 5e-4, "water")).collect();
    let found = sines(&directions(&format!("{}, {}", slab(-1.0, 4.0, "glass"), slabs.join(", "))));
    assert_eq!(found.len(), 3, "into the glass and out of it");
}
