//! The guarantees of the quality settings.

use anel::picture::{Colour, Quality, Size};
use anel::scene::{Opened, SMALL_BUILT_IN, Scene};
use anel::tracer::{Scratch, Tracer};

/// Clear balls and mirrors under a white sky: no ray contributes more than 1, and every ray that is cut off darkens its
/// pixel.
const WHITE: &str = r#"(
    camera: (eye: (0, 2, 9), look_at: (0, 0, 0), field_of_view: 40),
    background: (1, 1, 1),
    materials: {
        "mirror": (ka: 0, kd: 0, ks: 0.9),
        "glass": (ka: 0, kd: 0, ks: 0.15, kt: 0.85, ior: 1.5),
        "gray": (ka: 0, kd: 0, ks: 0.3, kt: 0.4, ior: 1.2),
    },
    objects: [
        HalfSpace(normal: (0, 1, 0), offset: -1, material: "mirror"),
        Sphere(centre: (-1.2, 0, 0), radius: 1, material: "glass"),
        Sphere(centre: (1.2, 0, 0.5), radius: 1, material: "gray"),
        Difference(material: "glass", of: [
            Box(min: (-0.8, -0.9, 1.5), max: (0.8, 0.2, 2.5)),
            Sphere(centre: (0, 0.3, 2), radius: 0.6),
        ]),
    ],
)"#;

fn picture(scene: &Scene, quality: Quality) -> (Vec<Colour>, u64) {
    let size = Size::new(48, 36).expect("a small picture");
    let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
    Tracer::new(scene, size, quality).trace(0..size.pixels(), &mut scratch, &mut pixels);
    (pixels, scratch.rays.total())
}

/// The differences `b` − `a` of all channels.
fn brighter<'a>(a: &'a [Colour], b: &'a [Colour]) -> impl Iterator<Item = f64> + 'a {
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| f64::from(*b) - f64::from(*a))
}

fn rmse(a: &[Colour], b: &[Colour]) -> f64 {
    (brighter(a, b).map(|error| error * error).sum::<f64>() / (3 * a.len()) as f64).sqrt()
}

#[test]
fn cut_off_rays_contribute_less_than_the_cutoff() {
    let scene = Scene::parse(WHITE).expect("a scene");
    let with = |cutoff| picture(&scene, Quality { cutoff, max_depth: 100, ..Quality::default() });
    let (exact, mut most_rays) = with(1e-7);
    for cutoff in [1e-4, 1e-3, 1.0 / 255.0, 0.02, 0.1, 0.5] {
        let (pixels, rays) = with(cutoff);
        let worst = brighter(&pixels, &exact).fold(0.0, f64::max);
        assert!(worst <= cutoff + 1e-6, "{worst} is lost with a cutoff of {cutoff}");
        assert!(brighter(&pixels, &exact).all(|error| error > -1e-6));
        // The limit is nearly reached.
        assert!(worst > 0.5 * cutoff, "a cutoff of {cutoff} loses only {worst}");
        assert!(rays < most_rays);
        most_rays = rays;
    }
}

#[test]
fn threshold_saves_samples_and_keeps_its_error() {
    for (name, _) in SMALL_BUILT_IN {
        let scene = Opened::new(name).expect("a built-in scene").scene;
        let with = |samples, threshold| picture(&scene, Quality { samples, threshold, ..Quality::default() });
        let (reference, _) = with(16, 0.0);
        let (all, all_rays) = with(8, 0.0);
        for threshold in [0.02, 0.005] {
            let (pixels, rays) = with(8, threshold);
            assert!(rays < all_rays, "{name}: {rays} rays of {all_rays} with a threshold of {threshold}");
            let error = rmse(&pixels, &reference);
            assert!(error < threshold + rmse(&all, &reference), "{name}: {error} with a threshold of {threshold}");
        }
    }
}

#[test]
fn threshold_of_0_takes_all_samples() {
    let scene = Scene::parse(r#"(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), background: (1, 1, 1), objects: [])"#)
        .expect("a sky");
    let rays = |samples, threshold| picture(&scene, Quality { samples, threshold, ..Quality::default() }).1;
    let pixels = 48 * 36;
    assert_eq!([1, 2, 3, 8].map(|samples| rays(samples, 0.0)), [1, 4, 9, 64].map(|samples| samples * pixels));
    // An empty picture: the corners and four more samples are enough.
    assert_eq!([1, 2, 3, 8].map(|samples| rays(samples, 1e-9)), [1, 8, 8, 8].map(|samples| samples * pixels));
}

#[test]
fn more_samples_reduce_the_error_with_every_pattern() {
    let scene = Opened::new("ten-objects").expect("a built-in scene").scene;
    let with = |samples, pattern| picture(&scene, Quality { samples, pattern, ..Quality::default() }).0;
    let reference = with(24, 99);
    for pattern in [0, 1, 2] {
        let errors = [1, 2, 4, 8].map(|samples| rmse(&with(samples, pattern), &reference));
        // Sixteen times the samples reduce the error to a quarter at most, as random samples would.
        assert!(errors[3] < errors[1] / 4.0 && errors[1] < errors[0], "{errors:?}");
    }
    assert_eq!(with(1, 0), with(1, 1), "one sample lies in the middle of its pixel");
    assert_ne!(with(2, 0), with(2, 1));
}

#[test]
fn preview_does_not_change_the_picture_or_its_rays() {
    for (name, text) in SMALL_BUILT_IN {
        let scene = Scene::parse(text).expect("a built-in scene");
        let size = Size::new(75, 41).expect("a small picture");
        let traced = |tracer: &Tracer| {
            let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
            tracer.trace(0..size.pixels(), &mut scratch, &mut pixels);
            (pixels, scratch.rays)
        };
        let mut tracer = Tracer::new(&scene, size, Quality::default());
        let plain = traced(&tracer);
        for step in [16, 8, 4, 2, 1] {
            tracer.refine(3);
            let preview = tracer.preview().expect("a preview");
            assert_eq!(preview.step(), step);
            for (x, y) in [(0, 0), (16, 32), (64, 16)] {
                assert_eq!(
                    preview.interpolate(x, y),
                    plain.0[(y * 75 + x) as usize],
                    "{name}: a pixel known from the preview"
                );
            }
            assert!(traced(&tracer) == plain, "{name}: with every {step}th pixel known from the preview");
        }
        let preview = tracer.preview().expect("the whole picture");
        let whole: Vec<_> = (0..size.pixels()).map(|pixel| preview.interpolate(pixel % 75, pixel / 75)).collect();
        assert!(whole == plain.0, "{name}");
    }
}
