//! Changes of a scene that must not change its picture, and laws that hold for all solids: no expected picture is
//! needed.

mod laws;
mod solids;

use anel::csg::{MaterialTag, Solid};
use anel::geometry::rotation;
use anel::picture::{Colour, Quality, Size};
use anel::scene::{Camera, Light, SMALL_BUILT_IN, Scene};
use anel::tracer::{Scratch, Tracer};
use glam::{DAffine3, DMat3, DVec3};

const WIDTH: u32 = 80;
const HEIGHT: u32 = 60;

fn picture(scene: &Scene) -> Vec<Colour> {
    let size = Size::new(WIDTH, HEIGHT).expect("small");
    let mut pixels = Vec::new();
    let tracer = Tracer::new(scene, size, Quality::default());
    tracer.trace(0..size.pixels(), &mut Scratch::default(), &mut pixels);
    pixels
}

/// Each built-in scene and its picture.
fn built_in() -> impl Iterator<Item = (&'static str, Scene, Vec<Colour>)> {
    SMALL_BUILT_IN.iter().map(|&(name, text)| {
        let scene = Scene::parse(text).unwrap_or_else(|error| panic!("{name}: {error}"));
        let pixels = picture(&scene);
        (name, scene, pixels)
    })
}

/// The pixels at which two pictures differ by more than `by` in a channel.
fn differing(one: &[Colour], other: &[Colour], by: f32) -> Vec<usize> {
    let differs = |&pixel: &usize| (0..3).any(|channel| (one[pixel][channel] - other[pixel][channel]).abs() > by);
    (0..one.len()).filter(differs).collect()
}

/// The scene with its camera and lights, rotated, then scaled by `factor`, then shifted.
fn moved(scene: &Scene, turn: DMat3, factor: f64, shift: DVec3) -> Scene {
    let point = |point: DVec3| turn * point * factor + shift;
    let map = DAffine3 { matrix3: turn * factor, translation: shift };
    let Camera { eye, look_at, up, field_of_view } = scene.camera;
    let light = |light: &Light| match *light {
        Light::Point { position, colour } => Light::Point { position: point(position), colour },
        Light::Directional { direction, colour } => Light::Directional { direction: turn * direction, colour },
    };
    Scene {
        camera: Camera { eye: point(eye), look_at: point(look_at), up: turn * up, field_of_view },
        lights: scene.lights.iter().map(light).collect(),
        solids: scene.solids.iter().map(|solid| changed(solid, &|own, tag| (map * own, tag))).collect(),
        ..scene.clone()
    }
}

/// The solid with changed maps and tags of its primitives.
fn changed(solid: &Solid, change: &impl Fn(DAffine3, MaterialTag) -> (DAffine3, MaterialTag)) -> Solid {
    let all = |solids: &[Solid]| solids.iter().map(|solid| changed(solid, change)).collect();
    match solid {
        Solid::Placed { primitive, scene_from_local, tag } => {
            let (scene_from_local, tag) = change(*scene_from_local, *tag);
            Solid::Placed { primitive: *primitive, scene_from_local, tag }
        }
        Solid::Union(solids) => Solid::Union(all(solids)),
        Solid::Intersection(solids) => Solid::Intersection(all(solids)),
        Solid::Difference(solids) => Solid::Difference(all(solids)),
    }
}

/// The same solid with the operands of every composition in reverse order; only the first operand of a difference stays
/// first.
fn reversed(solid: &Solid) -> Solid {
    let all = |solids: &[Solid]| solids.iter().rev().map(reversed).collect();
    match solid {
        Solid::Placed { .. } => solid.clone(),
        Solid::Union(solids) => Solid::Union(all(solids)),
        Solid::Intersection(solids) => Solid::Intersection(all(solids)),
        Solid::Difference(solids) => {
            let (first, others) = solids.split_first().expect("a difference has operands");
            Solid::Difference([vec![reversed(first)], all(others)].concat())
        }
    }
}

/// Rounding does not change, so no pixel may change.
#[test]
fn scene_scaled_by_a_power_of_two_gives_the_same_picture_bit_for_bit() {
    for (name, scene, pixels) in built_in() {
        for power in [-20, -13, -6, -1, 1, 5, 12, 20] {
            let scaled = moved(&scene, DMat3::IDENTITY, f64::from(power).exp2(), DVec3::ZERO);
            let bits = |pixels: &[Colour]| pixels.iter().flatten().map(|channel| channel.to_bits()).collect::<Vec<_>>();
            assert!(bits(&picture(&scaled)) == bits(&pixels), "{name} times 2^{power}");
        }
    }
}

/// The same for the lengths in a scene file.
#[test]
fn scene_file_scaled_by_a_power_of_two_gives_the_same_picture() {
    let scaled = |factor: f64| {
        let vector = |x: f64, y: f64, z: f64| format!("({:e}, {:e}, {:e})", x * factor, y * factor, z * factor);
        let text = format!(
            r#"(camera: (eye: {}, look_at: (0, 0, 0)), ambient: (0.1, 0.1, 0.1), background: (0.2, 0.3, 0.4),
                lights: [Point(position: {})],
                materials: {{"glass": (ka: 0, kd: 0.05, ks: 0.2, kt: 0.8, ior: 1.5), "matt": (ks: 0.3)}},
                objects: [Box(min: {}, max: {}, material: "matt"),
                    Sphere(centre: {}, radius: {:e}, material: "glass"),
                    Difference(material: "matt", transform: [Rotate((20, 30, 0))], of: [
                        Cylinder(from: {}, to: {}, radius: {:e}),
                        Cone(from: {}, to: {}, radius: {:e}, to_radius: {:e})])])"#,
            vector(3.0, 2.0, 6.0),
            vector(4.0, 9.0, 5.0),
            vector(-9.0, -2.0, -9.0),
            vector(9.0, -1.0, 9.0),
            vector(1.3, 0.0, 1.0),
            0.9 * factor,
            vector(-1.0, -1.0, 0.0),
            vector(-1.0, 1.0, 0.0),
            0.8 * factor,
            vector(-1.0, -1.0, 0.0),
            vector(-1.0, 1.0, 0.0),
            0.3 * factor,
            0.6 * factor,
        );
        picture(&Scene::parse(&text).unwrap_or_else(|error| panic!("{error}")))
    };
    let (same, larger, smaller) = (scaled(1.0), scaled(2f64.powi(20)), scaled(2f64.powi(-20)));
    assert!(same.iter().any(|pixel| *pixel != same[0]), "the picture is not empty");
    assert_eq!(same, larger);
    assert_eq!(same, smaller);
}

/// Rounding moves edges by much less than a pixel, also edges seen in glass and mirrors.
#[test]
fn rotated_and_shifted_scene_gives_the_same_picture_except_at_edges() {
    let anyhow = rotation(DVec3::new(20.0, 35.0, 50.0));
    let right_angles = [
        DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y),
        DMat3::from_cols(DVec3::NEG_Z, DVec3::Y, DVec3::X),
        DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z),
    ];
    let shift = DVec3::new(3.0, -2.0, 5.0);
    let motions = right_angles.map(|turn| (turn, DVec3::ZERO)).into_iter().chain([(anyhow, shift), (anyhow, -shift)]);
    for (name, scene, pixels) in built_in() {
        for (turn, shift) in motions.clone() {
            let others = differing(&pixels, &picture(&moved(&scene, turn, 1.0, shift)), 1e-4);
            assert!(others.len() * 1000 <= pixels.len(), "{name}: {} of {} pixels", others.len(), pixels.len());
            assert!(others.iter().all(|&pixel| is_at_edge(&pixels, pixel)), "{name}: pixels {others:?}");
        }
    }
}

/// Whether one of the eight neighbours of `pixel` has another colour.
fn is_at_edge(pixels: &[Colour], pixel: usize) -> bool {
    let (x, y) = ((pixel as u32 % WIDTH) as i32, (pixel as u32 / WIDTH) as i32);
    let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
    let mut inside = around.filter(|&(x, y)| (0..WIDTH as i32).contains(&x) && (0..HEIGHT as i32).contains(&y));
    inside.any(|(x, y)| {
        let other = pixels[(y * WIDTH as i32 + x) as usize];
        (0..3).any(|channel| (pixels[pixel][channel] - other[channel]).abs() > 0.01)
    })
}

#[test]
fn order_of_solids_does_not_matter() {
    for (name, scene, pixels) in built_in() {
        let mut reordered = scene.clone();
        reordered.solids.reverse();
        assert_eq!(differing(&pixels, &picture(&reordered), 0.0), [0; 0], "{name}");
    }
}

/// Each solid gets a single material: where faces coincide, the order decides which one is visible.
#[test]
fn order_of_operands_does_not_matter() {
    for (name, mut scene, _) in built_in() {
        let materials = scene.materials.len() as u32;
        for (number, solid) in (0..).zip(&mut scene.solids) {
            *solid = changed(solid, &|map, _| (map, MaterialTag(number % materials)));
        }
        let mut reordered = scene.clone();
        reordered.solids.iter_mut().for_each(|solid| *solid = reversed(solid));
        assert_eq!(differing(&picture(&scene), &picture(&reordered), 0.0), [0; 0], "{name}");
    }
}
