//! Scenes of the kinds that users of other ray tracers complained about.

use anel::picture::{Colour, Quality, Size};
use anel::scene::Scene;
use anel::tracer::{Scratch, Tracer};
use glam::DVec3;
use proptest::prelude::*;

fn traced(text: &str) -> Vec<Colour> {
    let scene = Scene::parse(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let size: Size = "64x48".parse().expect("a size");
    let mut pixels = Vec::new();
    Tracer::new(&scene, size, Quality::default()).trace(0..size.pixels(), &mut Scratch::default(), &mut pixels);
    pixels
}

/// The greatest difference of two pictures in any channel.
fn difference(one: &[Colour], other: &[Colour]) -> f32 {
    let channels = one.iter().zip(other).flat_map(|(a, b)| a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    channels.fold(0.0, f32::max)
}

fn mean(pixels: &[Colour]) -> DVec3 {
    pixels.iter().map(|pixel| DVec3::from(pixel.map(f64::from))).sum::<DVec3>() / pixels.len() as f64
}

/// A scene with materials of all kinds, seen from the front.
fn scene(light: &str, objects: &str) -> String {
    format!(
        r#"(camera: (eye: (0, 1, 6), look_at: (0, 0, 0), field_of_view: 35), background: (0.6, 0.7, 0.9),
        ambient: (0.3, 0.3, 0.3), lights: [{light}],
        materials: {{"glass": (ka: 0, kd: 0, ks: 0.1, kt: 0.9, ior: 1.5), "floor": (colour: (0.8, 0.6, 0.5)),
            "water": (ka: 0, kd: 0, ks: 0.1, kt: 0.9, ior: 1.05), "red": (colour: (0.9, 0.1, 0.1), ks: 0.4),
            "ruby": (ka: 0, kd: 0, kt: (0.9, 0.2, 0.3), ior: 1.5)}},
        objects: [HalfSpace(normal: (0, 1, 0), offset: -1.2, material: "floor"), {objects}])"#
    )
}

const LAMP: &str = "Point(position: (-4, 6, 5))";

#[test]
fn sun_along_a_turned_wall_shines_as_along_one_turned_the_other_way() {
    let suns = ["(0, -1, 0)", "(-1, 0, 0)", "(1, 0, 0)", "(0, 0, -1)"];
    for (sun, axis) in suns.into_iter().flat_map(|sun| [(sun, 0), (sun, 2)]) {
        let picture = |quarters: i32| {
            let mut degrees = [0; 3];
            degrees[axis] = 90 * quarters;
            let [x, y, z] = degrees;
            let turned = |solid: &str| format!("{solid} transform: [Rotate(({x}, {y}, {z})), Translate((0, 0, -3))])");
            let wall = turned(r#"HalfSpace(normal: (0, 1, 0), material: "red","#);
            let pipe = turned(r#"Quadric(squares: (1, 0, 1), constant: -0.04, material: "glass","#);
            traced(&scene(&format!("Directional(direction: {sun})"), &format!("{wall}, {pipe}, Sphere(radius: 0.5)")))
        };
        for quarters in [1, 2, 3] {
            let expected = picture(quarters);
            assert_eq!(picture(quarters - 4), expected, "by {} quarters about axis {axis}", quarters - 4);
            assert_eq!(picture(quarters + 4), expected, "by {} quarters about axis {axis}", quarters + 4);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// A room and its sun, turned together: the sun goes along a wall, an endless pipe of glass and a slab, up to
    /// rounding.
    #[test]
    fn sun_along_faces_that_are_turned_by_any_angle_is_not_shadowed_by_them(
        x in -180.0..180.0f64, y in -180.0..180.0f64, z in -180.0..180.0f64
    ) {
        let turn = format!("transform: [Rotate(({x}, {y}, {z}))]");
        let sun = anel::geometry::rotation(DVec3::new(x, y, z)) * DVec3::NEG_Y;
        let text = |walls: &str| format!(
            r#"(camera: (eye: (0, 0, 6), look_at: (0, 0, 0)), lights: [Directional(direction: ({}, {}, {}))],
            materials: {{"glass": (kt: 0.5)}},
            objects: [Sphere(radius: 1) {walls}])"#, sun.x, sun.y, sun.z
        );
        let walls = format!(
            r#", HalfSpace(normal: (1, 0, 0), offset: -9, {turn}), HalfSpace(normal: (0, 0, 1), offset: -9, {turn}),
            Quadric(squares: (1, 0, 1), constant: -400, material: "glass", {turn}),
            Quadric(squares: (0, 0, 1), constant: -500, material: "glass", {turn})"#
        );
        let lit = |pixels: &[Colour]| pixels.iter().filter(|pixel| pixel[0] > 0.3).count();
        let alone = lit(&traced(&text("")));
        prop_assert!(lit(&traced(&text(&walls))) >= alone, "{alone}");
    }
}

#[test]
fn the_same_glass_twice_is_the_glass_once() {
    let ball = r#"Sphere(radius: 1, material: "glass")"#;
    let pane = r#"Box(min: (-1.5, -1, -0.4), max: (1.5, 1, 0.4), material: "glass")"#;
    let bar = r#"Box(min: (-0.3, -1, -0.4), max: (0.3, 1, 0.4), material: "glass")"#;
    for (once, twice) in [(ball, [ball, ball]), (pane, [pane, bar])] {
        assert_eq!(traced(&scene(LAMP, &twice.join(", "))), traced(&scene(LAMP, once)), "{twice:?}");
    }
    // Where the bar is the first, its own faces stay, but Kt counts once a face.
    let light = mean(&traced(&scene(LAMP, &[bar, pane].join(", "))));
    assert!((light - mean(&traced(&scene(LAMP, pane)))).abs().max_element() < 0.05, "{light}");
}

#[test]
fn an_eye_in_a_face_of_glass_sees_as_from_just_outside() {
    let rest = r#"Sphere(centre: (0, 0.3, 4), radius: 1, material: "glass"), Box(min: (-4, -2, 7), max: (4, 1, 8))"#;
    let ball = r#"Sphere(radius: 1, material: "water")"#;
    let block = r#"Box(min: (-1, -1, -1), max: (1, 1, 1), material: "water")"#;
    let beside = r#"Box(min: (1, -1, -1), max: (2, 1, 1), material: "glass")"#;
    let union = format!("Union(of: [{block}, {beside}])");
    let cases = [
        ("in a ball", ball, [0.0, 0.0, 1.0], [0.0, 0.0, 1e-7]),
        ("in a face", block, [0.2, 0.3, 1.0], [0.0, 0.0, 1e-7]),
        ("on an edge", block, [1.0, 0.3, 1.0], [1e-7, 0.0, 1e-7]),
        ("in a corner", block, [1.0, 1.0, 1.0], [1e-7, 1e-7, 1e-7]),
        ("where faces of two media meet", &union, [1.0, 0.1, 1.0], [0.0, 0.0, 1e-7]),
    ];
    for (place, solid, eye, outwards) in cases {
        let picture = |eye: [f64; 3]| {
            let [x, y, z] = eye;
            traced(&format!(
                r#"(camera: (eye: ({x}, {y}, {z}), look_at: (0, 0.2, 6), field_of_view: 50),
                background: (0.5, 0.7, 0.9), ambient: (0.3, 0.3, 0.3), lights: [Directional(direction: (-1, -2, 1))],
                materials: {{"water": (ka: 0, kd: 0, ks: 0.1, kt: 0.9, ior: 1.5),
                    "glass": (ka: 0, kd: 0, ks: 0.1, kt: 0.9, ior: 1.9)}},
                objects: [{solid}, {rest}])"#
            ))
        };
        let outside = picture([0, 1, 2].map(|axis| eye[axis] + outwards[axis]));
        let differing = picture(eye).iter().zip(&outside).filter(|(a, b)| difference(&[**a], &[**b]) > 1e-3).count();
        // At outlines.
        assert!(differing <= 12, "{place}: {differing} pixels differ");
    }
}

#[test]
fn parts_of_a_union_of_several_media_are_solids_of_their_own() {
    let ball = |x: f64, radius: f64, material: &str| {
        format!(r#"Sphere(centre: ({x}, 0, 0), radius: {radius}, material: "{material}")"#)
    };
    let parts = [ball(-0.6, 0.8, "glass"), ball(-0.6, 0.4, "red"), ball(0.4, 0.8, "water"), ball(-0.2, 0.5, "glass")];
    let union = traced(&scene(LAMP, &format!("Union(of: [{}])", parts.join(", "))));
    let [glass, red, water, more] = &parts;
    let apart = traced(&scene(LAMP, &format!("Union(of: [{glass}, {more}]), {red}, {water}")));
    assert_eq!(difference(&union, &apart), 0.0);
    let is_red = |pixel: &&Colour| pixel[0] > 2.0 * pixel[1];
    assert!(union.iter().filter(is_red).count() > 20, "the core is seen in its glass");
    // The same below another operation.
    let cutter = "HalfSpace(normal: (0, -1, 0), offset: -0.2)";
    let cut = |solid: &str| format!("Difference(of: [{solid}, {cutter}])");
    let union = traced(&scene(LAMP, &cut(&format!("Union(of: [{}])", parts.join(", ")))));
    let apart = [cut(&format!("Union(of: [{glass}, {more}])")), cut(red), cut(water)].join(", ");
    assert_eq!(difference(&union, &traced(&scene(LAMP, &apart))), 0.0);
}

#[test]
fn a_cut_through_glass_leaves_its_index_of_refraction() {
    let ball = r#"Sphere(radius: 1, material: "glass")"#;
    let cut = |material: &str| {
        let cutter = format!(r#"Sphere(centre: (0, 0, 1.2), radius: 0.8, material: "{material}")"#);
        traced(&scene(LAMP, &format!("Difference(of: [{ball}, {cutter}])")))
    };
    assert_eq!(cut("water"), cut("glass"), "the two differ in nothing but the index");
}

#[test]
fn a_view_straight_down_has_minus_z_at_the_top() {
    let text = |eye: &str, up: &str| {
        format!(
            r#"(camera: (eye: {eye}, look_at: (0, 0, 0) {up}), ambient: (1, 1, 1),
            materials: {{"red": (colour: (1, 0, 0))}},
            objects: [Sphere(centre: (0, 0, -1), radius: 0.5, material: "red"), Sphere(centre: (1, 0, 0), radius: 0.5)])"#
        )
    };
    let up = |z: f64| format!(", up: (0, 0, {z})");
    let down = traced(&text("(0, 6, 0)", ""));
    assert_eq!(difference(&down, &traced(&text("(0, 6, 0)", &up(-1.0)))), 0.0);
    assert_eq!(difference(&traced(&text("(0, -6, 0)", "")), &traced(&text("(0, -6, 0)", &up(1.0)))), 0.0);
    let is_red = |pixel: &Colour| pixel[0] > 0.5 && pixel[1] < 0.1;
    assert!(down[..64 * 24].iter().any(is_red) && !down[64 * 24..].iter().any(is_red), "red is at the top");
}

#[test]
fn coloured_glass_colours_its_shadow_and_what_is_seen_through_it() {
    let ball = |material: &str| format!(r#"Sphere(centre: (0, 0.2, 0), radius: 1, material: "{material}")"#);
    let with = traced(&scene(LAMP, &ball("ruby")));
    let without = traced(&scene(LAMP, ""));
    // The floor's own colour has more blue than a fifth of its red.
    let shadow = with.iter().zip(&without).filter(|(with, without)| {
        let part = [0, 1, 2].map(|channel| with[channel] / without[channel]);
        part[0] > 0.75 && part[0] < 0.99 && part[1] < 0.6 && part[2] < 0.6
    });
    assert!(shadow.count() > 30, "the shadow lets red through");
    let triple = scene(LAMP, &ball("glass")).replace("kt: 0.9, ior: 1.5", "kt: (0.9, 0.9, 0.9), ior: 1.5");
    assert_eq!(traced(&triple), traced(&scene(LAMP, &ball("glass"))), "three equal numbers are one number");
    let error = Scene::parse(&scene(LAMP, "").replace("(0.9, 0.2, 0.3)", "(0.9, 1.2, 0.3)")).expect_err("above 1");
    assert!(error.to_string().contains("three numbers between 0 and 1"), "{error}");
}
