//! The inspector explains a pixel by the rays and terms that made it.

use anel::csg::{Operation, SolidKind, SpanDiagram};
use anel::language::Language;
use anel::picture::{Quality, Size};
use anel::scene::{SMALL_BUILT_IN, Scene};
use anel::tracer::{ExplainedSample, RayCounts, RayKind, Scratch, Tracer};
use anel::view::Inspected;

fn built_in() -> impl Iterator<Item = (&'static str, Scene)> {
    SMALL_BUILT_IN.iter().map(|(name, text)| (*name, Scene::parse(text).expect("a built-in scene")))
}

/// Calls `each` with the explanation, the colour and the numbers of rays of every pixel.
fn each_pixel(
    scene: &Scene,
    quality: Quality,
    mut each: impl FnMut(&Tracer, Vec<ExplainedSample>, [f32; 3], RayCounts),
) {
    let size = Size::new(40, 30).expect("a small picture");
    let tracer = Tracer::new(scene, size, quality);
    for pixel in 0..size.pixels() {
        let (mut alone, mut colour) = (Scratch::default(), Vec::new());
        tracer.trace(pixel..pixel + 1, &mut alone, &mut colour);
        let mut watched = Scratch::default();
        let explained = tracer.explain(pixel, &mut watched);
        assert_eq!(watched.rays, alone.rays, "an observer changes nothing");
        each(&tracer, explained, colour[0], alone.rays);
    }
}

#[test]
fn sum_of_all_terms_is_the_colour_of_the_pixel() {
    let usual = Quality::default();
    for quality in [usual, Quality { samples: 2, ..usual }, Quality { samples: 6, threshold: 0.02, ..usual }] {
        for (name, scene) in built_in() {
            each_pixel(&scene, quality, |_, samples, colour, _| {
                // Equal to the last bit.
                assert_eq!(ExplainedSample::mean(&samples).as_vec3().to_array(), colour, "{name}");
                for sample in &samples {
                    let (colour, brought) = (sample.colour(), sample.contribution_of(0));
                    assert!(brought.abs_diff_eq(colour, 1e-12 * (1.0 + colour.length())), "{name}");
                }
            });
        }
    }
}

#[test]
fn tree_has_all_rays_with_the_weights_of_the_equation() {
    for (name, scene) in built_in() {
        each_pixel(&scene, Quality::default(), |_, samples, _, rays| {
            let [sample] = &samples[..] else { panic!("{name}: one sample") };
            let of = |kind| sample.rays.iter().filter(|ray| ray.path.kind == kind).count() as u64;
            let counted = [RayKind::Primary, RayKind::Reflected, RayKind::Refracted].map(of);
            assert_eq!(counted, [rays.primary, rays.reflected, rays.refracted], "{name}");
            let lit: usize = sample.rays.iter().map(|ray| ray.lights.len()).sum();
            assert_eq!(lit as u64, rays.shadow, "{name}");
            assert!(sample.rays.iter().all(|ray| ray.lights.len() == ray.shadows.len()), "{name}");
            assert!(sample.left_out <= Quality::default().cutoff, "{name}");
            // Sums that cancel leave a rounding error, which does not count.
            assert_eq!(sample.rays_left_out > 0, sample.left_out > 1e-12, "{name}: {}", sample.left_out);
            for ray in &sample.rays {
                let Some(from) = ray.path.from.map(|from| &sample.rays[from as usize]) else { continue };
                let material = &scene.materials[from.met.expect("it starts on a surface").tag.index()];
                let part = ray.path.weight / from.path.weight;
                let possible = match ray.path.kind {
                    RayKind::Refracted => vec![material.kt.x],
                    // Ks + Kt under total internal reflection.
                    _ => vec![material.ks, material.ks + material.kt.x],
                };
                assert!(possible.iter().any(|expected| (part - expected).abs() < 1e-12), "{name}: {part}");
            }
        });
    }
}

/// Whether a distance is inside a composition, by the spans of its operands.
fn is_inside_by_operands(operation: Operation, operands: &[SpanDiagram]) -> impl Fn(f64) -> bool {
    move |t| {
        let mut holds = operands.iter().map(|operand| operand.spans.iter().any(|[from, to]| *from <= t && t <= *to));
        match operation {
            Operation::Union => holds.any(|holds| holds),
            Operation::Intersection => holds.all(|holds| holds),
            Operation::Difference => holds.next() == Some(true) && !holds.any(|holds| holds),
        }
    }
}

fn assert_consistent_with_operands(figure: &SpanDiagram, name: &str) {
    if let SolidKind::Composition(operation) = figure.kind {
        let mut places: Vec<f64> =
            figure.operands.iter().flat_map(|operand| operand.spans.concat()).filter(|t| t.is_finite()).collect();
        places.sort_by(f64::total_cmp);
        let holds = is_inside_by_operands(operation, &figure.operands);
        for pair in places.windows(2).filter(|pair| pair[1] - pair[0] > 1e-6) {
            let middle = (pair[0] + pair[1]) / 2.0;
            let is_inside = figure.spans.iter().any(|[from, to]| *from < middle && middle < *to);
            assert_eq!(is_inside, holds(middle), "{name}: {operation:?} at {middle}: {figure:#?}");
        }
    }
    figure.operands.iter().for_each(|operand| assert_consistent_with_operands(operand, name));
}

#[test]
fn command_explains_a_pixel_in_words_and_as_json() {
    let language = Language::English;
    let explain = |rest: &[&str]| {
        let arguments = [&["inspect", "glass", "--pixel", "31,22", "--size", "64x48", "--samples", "2"], rest].concat();
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_anel")).args(arguments).output();
        let output = output.expect("the program can be started");
        assert!(output.status.success() && output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).expect("text")
    };
    let (scene, size) =
        (Scene::parse(SMALL_BUILT_IN[2].1).expect("glass"), Size::new(64, 48).expect("a small picture"));
    let tracer = Tracer::new(&scene, size, Quality { samples: 2, ..Quality::default() });
    let inspected = Inspected::new(&tracer, &scene, [31, 22]).expect("a pixel of the picture");
    assert_eq!(explain(&[]).trim_end(), inspected.text(language).trim_end());

    let text = explain(&["--json"]);
    assert_eq!(text.trim_end().lines().count(), 1);
    let object: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(object["colour"], serde_json::json!(inspected.colour().to_array()));
    let samples = object["samples"].as_array().expect("a list");
    let rays: usize = samples.iter().map(|sample| sample["rays"].as_array().expect("a list").len()).sum();
    let counted = ["primary", "reflected", "refracted"].map(|kind| object["rays"][kind].as_u64().expect("a number"));
    assert_eq!((samples.len(), rays as u64), (4, counted.iter().sum()));
    assert_eq!(object["terms"].as_array().map(Vec::len), Some(inspected.terms(language).len()));
    assert_eq!(object["spans"].as_array().map(Vec::len), Some(inspected.diagrams.len()));
}

#[test]
fn span_diagrams_show_the_solids_along_a_ray() {
    for (name, scene) in built_in() {
        each_pixel(&scene, Quality::default(), |tracer, samples, _, _| {
            for ray in samples[0].rays.iter().take(4) {
                let figures = tracer.span_diagrams(&ray.path.ray, ray.path.start, ray.path.to);
                figures.iter().for_each(|(_, figure)| assert_consistent_with_operands(figure, name));
                let Some(met) = ray.met else { continue };
                // The ray ends at the start or the end of a span of the solid that it hit.
                let (_, figure) =
                    figures.iter().find(|(root, _)| *root == met.start.root).expect("the solid that the ray hit");
                let near = figure.spans.concat().iter().any(|t| (t - ray.path.to).abs() < 1e-9 * (1.0 + t.abs()));
                assert!(near, "{name}: {} is not in {figure:#?}", ray.path.to);
            }
        });
    }
}
