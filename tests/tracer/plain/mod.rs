//! The tracer against a plain one: 2,000 random scenes of the kinds that go wrong, in numbers of twice the precision.

mod number;
mod scenes;
mod solid;
mod trace;
mod vector;

use anel::picture::{Quality, Size};
use anel::scene::Scene;
use anel::tracer::{Path, RayKind, Scratch, Tracer};
use glam::DVec3;

use number::{Number, Wide};
use trace::{PlainTracer, Sample};

const SIZE: &str = "16x12";
const MAX_DEPTH: u32 = 4;

/// The pixels of a scene that differ between the tracer and the plain one.
struct Comparison {
    pixels: usize,
    /// Pixels that differ though all pixels around them show the same face.
    wrong: Vec<(usize, DVec3, DVec3)>,
    /// Pixels that differ beside another face, or whose rays end exactly on an edge.
    at_edges: usize,
}

fn compare<N: Number>(text: &str) -> Comparison {
    let scene = Scene::parse(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let size: Size = SIZE.parse().expect("a size");
    let quality = Quality { cutoff: 0.0, max_depth: MAX_DEPTH, ..Quality::default() };
    let tracer = Tracer::new(&scene, size, quality);
    let (mut ours, mut directions, mut scratch) = (Vec::new(), Vec::new(), Scratch::default());
    tracer.trace(0..size.pixels(), &mut scratch, &mut ours);
    tracer.paths(0..size.pixels(), &mut scratch, |path: Path| {
        if path.kind == RayKind::Primary {
            directions.push(path.ray.direction);
        }
    });
    let plain = PlainTracer::<N>::new(&scene, MAX_DEPTH);
    let truth: Vec<Sample> = directions.iter().map(|&direction| plain.sample(direction)).collect();
    let (width, height) = (size.width() as i32, size.height() as i32);
    let is_edge = |pixel: usize| {
        let (x, y) = (pixel as i32 % width, pixel as i32 / width);
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
        let inside = around.filter(|&(x, y)| (0..width).contains(&x) && (0..height).contains(&y));
        inside.map(|(x, y)| (y * width + x) as usize).any(|other| truth[other].face != truth[pixel].face)
    };
    let mut comparison = Comparison { pixels: ours.len(), wrong: Vec::new(), at_edges: 0 };
    for (pixel, sample) in truth.iter().enumerate() {
        let colour = DVec3::from(ours[pixel].map(f64::from));
        if (colour - sample.colour).abs().max_element() <= 1e-5 * (1.0 + sample.colour.max_element()) {
            continue;
        }
        if sample.at_edge || is_edge(pixel) {
            comparison.at_edges += 1;
        } else {
            comparison.wrong.push((pixel, colour, sample.colour));
        }
    }
    comparison
}

#[test]
fn no_pixel_differs_from_a_plain_tracer_of_twice_the_precision() {
    let long = std::env::var("ANEL_PLAIN_SCENES").ok().and_then(|number| number.parse().ok());
    let (scenes, mut pixels, mut wrong, mut at_edges) = (long.unwrap_or(400), 0, 0, 0);
    let mut example = String::new();
    for seed in 0..scenes {
        let text = scenes::scene(seed);
        let found = compare::<Wide>(&text);
        pixels += found.pixels;
        wrong += found.wrong.len();
        at_edges += found.at_edges;
        if let Some((pixel, ours, truth)) = found.wrong.first() {
            let wrong = found.wrong.len();
            example += &format!("seed {seed}: {wrong} wrong, pixel {pixel}: {ours} and not {truth}\n{text}\n");
        }
    }
    println!("{scenes} scenes, {pixels} pixels: {wrong} wrong, {at_edges} differ beside an edge");
    assert_eq!(wrong, 0, "{example}");
}
