//! The article's equation (§3), term by term, on scenes whose colours follow by hand.

use anel::picture::{Colour, Quality, Size};
use anel::scene::Scene;
use anel::tracer::{RayCounts, Scratch, Tracer};

/// Traces the middle pixel of a picture of 3 × 3. Returns its colour and its numbers of rays.
fn middle_with(text: &str, quality: Quality) -> (Colour, RayCounts) {
    let scene = Scene::parse(text).unwrap_or_else(|error| panic!("{error}"));
    let tracer = Tracer::new(&scene, Size::new(3, 3).expect("nine pixels"), quality);
    let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
    tracer.trace(4..5, &mut scratch, &mut pixels);
    (pixels[0], scratch.rays)
}

fn middle(text: &str) -> Colour {
    middle_with(text, Quality::default()).0
}

fn assert_near(seen: Colour, expected: [f64; 3]) {
    let near = seen.iter().zip(expected).all(|(a, b)| (f64::from(*a) - b).abs() < 1e-6);
    assert!(near, "{seen:?} is not {expected:?}");
}

/// A scene whose camera looks along −z from z = 5 to the origin.
fn scene(rest: &str) -> String {
    format!("(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), {rest})")
}

#[test]
fn ray_without_a_hit_shows_the_background() {
    assert_near(middle(&scene("background: (0.1, 0.2, 0.3), objects: []")), [0.1, 0.2, 0.3]);
}

#[test]
fn ambient_light_needs_no_light_source() {
    let text = scene(
        r#"ambient: (0.5, 0.5, 1), materials: {"m": (colour: (1, 0.5, 0.5), ka: 0.5, kd: 0.9)},
           objects: [Sphere(radius: 1, material: "m")]"#,
    );
    assert_near(middle(&text), [0.25, 0.125, 0.25]);
}

#[test]
fn diffuse_light_follows_the_cosine_and_adds_up() {
    // One light along the normal, one at 60° to it.
    let text = scene(
        r#"lights: [Directional(direction: (0, 0, -1), colour: (0.5, 0.5, 0.5)),
                    Directional(direction: (0, -0.8660254037844386, -0.5), colour: (0.4, 0.4, 0.4))],
           materials: {"m": (colour: (1, 0.5, 0), kd: 0.5)},
           objects: [Box(min: (-1, -1, -1), max: (1, 1, 1), material: "m")]"#,
    );
    let both = 0.5 * (0.5 + 0.4 * 0.5);
    assert_near(middle(&text), [both, both * 0.5, 0.0]);
}

#[test]
fn highlight_is_the_cosine_to_the_eye_to_the_power_n() {
    // The reflected light is at 60° to the eye: cos = 0.5, to the third power 1/8.
    let text = scene(
        r#"lights: [Directional(direction: (0, -0.8660254037844386, -0.5))],
           materials: {"m": (kd: 0, ks: 0.4, n: 3)},
           objects: [Box(min: (-1, -1, -1), max: (1, 1, 1), material: "m")]"#,
    );
    // The mirror term adds Ks times the black background.
    assert_near(middle(&text), [0.4 / 8.0; 3]);
}

#[test]
fn light_behind_the_surface_adds_nothing() {
    let text = scene(
        r#"lights: [Point(position: (0, 0, -5))], materials: {"m": (kd: 1, ks: 0.5)},
           objects: [Box(min: (-1, -1, -1), max: (1, 1, 1), material: "m")]"#,
    );
    assert_near(middle(&text), [0.0; 3]);
}

/// A scene of a floor, a light above it, and `between` them; the camera looks down at a slant.
fn floor_under(between: &str) -> String {
    format!(
        r#"(camera: (eye: (4, 4, 0), look_at: (0, 0, 0), up: (0, 1, 0)),
            lights: [Point(position: (0, 9, 0))],
            materials: {{"floor": (kd: 1), "clear": (ka: 0, kd: 0, kt: 0.5), "solid": (ka: 0, kd: 0)}},
            objects: [HalfSpace(normal: (0, 1, 0), material: "floor"), {between}])"#
    )
}

#[test]
fn shadow_ray_is_dimmed_by_transmitting_surfaces_and_stopped_by_others() {
    assert_near(middle(&floor_under("")), [1.0; 3]);
    let clear = r#"Sphere(centre: (0, 6, 0), radius: 0.5, material: "clear")"#;
    assert_near(middle(&floor_under(clear)), [0.25; 3]);
    let two = format!(r#"{clear}, Sphere(centre: (0, 7.5, 0), radius: 0.5, material: "clear")"#);
    assert_near(middle(&floor_under(&two)), [0.0625; 3]);
    let solid = format!(r#"{clear}, Sphere(centre: (0, 7.5, 0), radius: 0.5, material: "solid")"#);
    assert_near(middle(&floor_under(&solid)), [0.0; 3]);
    let beyond_the_light = r#"Sphere(centre: (0, 12, 0), radius: 0.5, material: "solid")"#;
    assert_near(middle(&floor_under(beyond_the_light)), [1.0; 3]);
}

#[test]
fn mirror_shows_the_scene_behind_the_eye() {
    let text = scene(
        r#"ambient: (1, 1, 1), materials: {"mirror": (ka: 0, kd: 0, ks: 0.5), "red": (colour: (0.8, 0, 0))},
           objects: [Box(min: (-1, -1, -1), max: (1, 1, 0), material: "mirror"),
                     Box(min: (-1, -1, 8), max: (1, 1, 9), material: "red")]"#,
    );
    assert_near(middle(&text), [0.4, 0.0, 0.0]);
}

/// The rays of a prism that the ray enters at right angles and whose far face it meets at `degrees`.
fn prism(degrees: f64) -> RayCounts {
    let text = scene(&format!(
        r#"background: (1, 1, 1), materials: {{"glass": (ka: 0, kd: 0, kt: 1, ior: 1.5)}},
           objects: [Intersection(material: "glass", of: [
               Box(min: (-20, -20, -20), max: (20, 20, 1)),
               HalfSpace(normal: (0, 0, -1), transform: [Rotate(({degrees}, 0, 0))])])]"#
    ));
    middle_with(&text, Quality { max_depth: 3, ..Quality::default() }).1
}

#[test]
fn light_leaves_glass_up_to_the_critical_angle_and_is_totally_reflected_beyond_it() {
    // sin⁻¹(1 / 1.5) = 41.810°
    assert_eq!(prism(41.80), RayCounts { primary: 1, shadow: 0, reflected: 0, refracted: 2 });
    assert_eq!(prism(41.82), RayCounts { primary: 1, shadow: 0, reflected: 1, refracted: 1 });
}

#[test]
fn slab_shifts_a_ray_but_does_not_turn_it() {
    // Behind ten tilted slabs a narrow red wall stands where only a shifted, unturned ray hits it.
    let slabs: String = (0..10)
        .map(|k| {
            format!(
                r#"Box(min: (-9, -9, -0.05), max: (9, 9, 0.05), material: "glass",
                   transform: [Rotate((30, 0, 0)), Translate((0, 0, {}))]),"#,
                2.0 - 0.3 * f64::from(k)
            )
        })
        .collect();
    let wall = |from: f64, to: f64| {
        scene(&format!(
            r#"ambient: (1, 1, 1), materials: {{"glass": (ka: 0, kd: 0, kt: 1, ior: 1.5), "red": (colour: (1, 0, 0))}},
               objects: [{slabs} Box(min: (-1, {from}, -100), max: (1, {to}, -99), material: "red")]"#
        ))
    };
    let quality = Quality { max_depth: 30, ..Quality::default() };
    // Each slab of thickness 0.1 shifts the ray by 0.1 sin(30°) (1 − cos 30° / √(1.5² − sin² 30°)) = 0.01938.
    let (sine, cosine) = (0.5, 0.75f64.sqrt());
    let shift: f64 = 10.0 * 0.1 * sine * (1.0 - cosine / (2.25f64 - sine * sine).sqrt());
    let seen = |from, to| middle_with(&wall(from, to), quality).0;
    // The front face is tilted down, so the ray in the glass bends up.
    assert_eq!(seen(shift - 1e-9, shift + 1e-9), [1.0, 0.0, 0.0], "the ray is not shifted up by {shift}");
}

#[test]
fn tree_of_rays_ends_at_the_depth_limit() {
    // Two mirrors that face each other reflect without end.
    let text = scene(
        r#"materials: {"mirror": (ka: 0, kd: 0, ks: 1)},
           objects: [Box(min: (-1, -1, -1), max: (1, 1, 0), material: "mirror"),
                     Box(min: (-1, -1, 8), max: (1, 1, 9), material: "mirror")]"#,
    );
    let (_, rays) = middle_with(&text, Quality { max_depth: 10, ..Quality::default() });
    assert_eq!((rays.primary, rays.reflected), (1, 9));
}

#[test]
fn ray_below_the_cutoff_is_not_followed() {
    let text = scene(
        r#"materials: {"mirror": (ka: 0, kd: 0, ks: 0.1)},
           objects: [Box(min: (-1, -1, -1), max: (1, 1, 0), material: "mirror"),
                     Box(min: (-1, -1, 8), max: (1, 1, 9), material: "mirror")]"#,
    );
    // 0.1 and 0.01 exceed 1/255, 0.001 does not.
    assert_eq!(middle_with(&text, Quality::default()).1.reflected, 2);
}

#[test]
fn camera_inside_a_solid_sees_its_inner_surface() {
    let text = scene(
        r#"ambient: (1, 1, 1), materials: {"m": (colour: (0, 1, 0))}, objects: [Sphere(radius: 50, material: "m")]"#,
    );
    assert_near(middle(&text), [0.0, 1.0, 0.0]);
}

#[test]
fn samples_are_averaged() {
    // The box covers the left half of the middle pixel: 2 × 2 samples see half of the light.
    let text = scene(r#"ambient: (1, 1, 1), objects: [Box(min: (-9, -9, -1), max: (0, 9, 0))]"#);
    let (colour, rays) = middle_with(&text, Quality { samples: 2, ..Quality::default() });
    assert_near(colour, [0.5; 3]);
    assert_eq!(rays.primary, 4);
}
