//! Parts of a picture: regions, and pictures without their background.

use anel::picture::{Colour, Coverage, Quality, Region, Size, srgba8};
use anel::scene::{Scene, built_in};
use anel::tracer::{RayKind, Scratch, Tracer};
use glam::DVec3;
use proptest::prelude::*;

const SIZE: [u32; 2] = [48, 36];

fn scene(name: &str) -> Scene {
    Scene::parse(built_in(name).expect("it is built in")).expect("a scene")
}

fn tracer(scene: &Scene, samples: u32, threshold: f64) -> Tracer {
    let size = Size::new(SIZE[0], SIZE[1]).unwrap();
    Tracer::new(scene, size, Quality { samples, threshold, ..Quality::default() })
}

fn traced(tracer: &Tracer) -> Vec<Colour> {
    let mut pixels = Vec::new();
    tracer.trace(0..tracer.size().pixels(), &mut Scratch::default(), &mut pixels);
    pixels
}

/// The premultiplied colours and the coverage of each pixel.
fn traced_transparent(tracer: &Tracer) -> (Vec<Colour>, Vec<f32>) {
    let (mut pixels, coverage) = (Vec::new(), Coverage::new(tracer.size().pixels()));
    let all = 0..tracer.size().pixels();
    tracer.trace_transparent(all, &mut Scratch::default(), &mut pixels, |pixel, share| coverage.set(pixel, share));
    (pixels, coverage.shares().collect())
}

fn over(colour: Colour, share: f32, background: DVec3) -> DVec3 {
    DVec3::from(colour.map(f64::from)) + (1.0 - f64::from(share)) * background
}

fn difference(one: Colour, other: DVec3) -> f64 {
    (DVec3::from(one.map(f64::from)) - other).abs().max_element()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn region_is_a_crop_of_the_whole_picture(
        name in prop::sample::select(&["glass", "csg-primer", "corner"][..]), samples in 1..4_u32,
        threshold in prop::sample::select(&[0.0, 0.03][..]), corner in (0..SIZE[0], 0..SIZE[1]), size in (1..20_u32, 1..20_u32),
        transparent: bool,
    ) {
        let scene = scene(name);
        let (x, y) = corner;
        let size = Size::new(size.0.min(SIZE[0] - x), size.1.min(SIZE[1] - y)).unwrap();
        let (whole, part) = (tracer(&scene, samples, threshold), tracer(&scene, samples, threshold));
        let part = part.of_region(Region { x, y, size });
        prop_assert_eq!(part.size(), size);
        let cropped = |pixels: Vec<Colour>| -> Vec<Colour> {
            let rows = pixels.chunks(SIZE[0] as usize).skip(y as usize).take(size.height() as usize);
            rows.flat_map(|row| row[x as usize..][..size.width() as usize].to_vec()).collect()
        };
        let trace = |tracer: &Tracer| if transparent { traced_transparent(tracer).0 } else { traced(tracer) };
        prop_assert_eq!(trace(&part), cropped(trace(&whole)));
    }
}

#[test]
fn transparent_picture_over_the_background_is_the_opaque_picture() {
    let mut all_edges = 0;
    for (name, samples) in [("ten-objects", 3), ("csg-primer", 3), ("glass", 2), ("machine-part", 1), ("rings", 2)] {
        let mut scene = scene(name);
        // An edge of what is brighter than white is clipped in another order.
        scene.lights.clear();
        scene.ambient = DVec3::splat(0.6);
        let tracer = tracer(&scene, samples, 0.0);
        let (colours, shares) = traced_transparent(&tracer);
        let edges = shares.iter().filter(|&&share| 0.0 < share && share < 1.0).count();
        assert!(edges == 0 || samples > 1, "{name}: {edges} edges");
        all_edges += edges;
        for ((opaque, colour), share) in traced(&tracer).into_iter().zip(colours).zip(shares) {
            assert!(difference(opaque, over(colour, share, scene.background)) < 1e-6, "{name}");
            // As a viewer composes the file in linear light: alpha has 8 bits, and colours at least 8.
            let [red, green, blue, alpha] = srgba8(colour, share);
            let alpha = f32::from(alpha) / 255.0;
            let shown = [red, green, blue].map(|channel| alpha * linear(channel));
            assert!(difference(opaque, over(shown, alpha, scene.background)) < 1.2 / 255.0, "{name}: {opaque:?}");
        }
    }
    assert!(all_edges > 40, "{all_edges}");
}

fn linear(channel: u8) -> f32 {
    let encoded = f32::from(channel) / 255.0;
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// Which pixels have a secondary ray that meets nothing.
fn secondary_misses(tracer: &Tracer) -> Vec<bool> {
    let misses = |pixel| {
        let samples = tracer.explain(pixel, &mut Scratch::default());
        let mut rays = samples.iter().flat_map(|sample| &sample.rays);
        rays.any(|ray| ray.path.kind != RayKind::Primary && ray.met.is_none())
    };
    (0..tracer.size().pixels()).map(misses).collect()
}

#[test]
fn transparent_picture_is_right_over_any_background() {
    let mut all_compared = 0;
    for name in ["glass", "csg-primer", "machine-part"] {
        let mut scene = scene(name);
        let (colours, shares) = traced_transparent(&tracer(&scene, 3, 0.0));
        for background in [DVec3::ZERO, DVec3::ONE] {
            scene.background = background;
            let tracer = tracer(&scene, 3, 0.0);
            let is_seen_again = secondary_misses(&tracer);
            for (pixel, opaque) in traced(&tracer).into_iter().enumerate().filter(|(pixel, _)| !is_seen_again[*pixel]) {
                let shown = over(colours[pixel], shares[pixel], background);
                assert!(difference(opaque, shown) < 1e-6, "{name}: {opaque:?} is not {shown}");
                all_compared += 1;
            }
        }
    }
    assert!(all_compared > 3000, "{all_compared}");
}

/// A white ball before white: its edge has no contrast, and gets its samples nevertheless.
#[test]
fn edge_without_contrast_to_the_background_is_antialiased() {
    let text = "Scene(camera: (eye: (0, 0, 6), look_at: (0, 0, 0)), background: (1, 1, 1), ambient: (1, 1, 1), \
                objects: [Sphere(radius: 1.3)])";
    let scene = Scene::parse(text).expect("a scene");
    let (_, shares) = traced_transparent(&tracer(&scene, 8, 0.02));
    let (_, exact) = traced_transparent(&tracer(&scene, 16, 0.0));
    let errors: Vec<f32> = shares.iter().zip(&exact).map(|(share, exact)| (share - exact).abs()).collect();
    let greatest = errors.iter().copied().fold(0.0, f32::max);
    assert!(greatest < 0.07, "{greatest}");
    assert!(traced(&tracer(&scene, 8, 0.02)).iter().all(|pixel| *pixel == [1.0; 3]));
}
