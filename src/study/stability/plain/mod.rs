//! The judge of whole pictures: a plain tracer, without hierarchy, bounds or pruning, in numbers of 31 digits.

mod number;
mod random_scene;
mod solid;
mod trace;
mod vector;

use glam::DVec3;

use crate::picture::{Quality, Size};
use crate::scene::Scene;
use crate::tracer::{Path, RayKind, Scratch, Tracer};

pub(super) use number::Wide;
pub(super) use random_scene::random_scene;

use number::Number;
use trace::{PlainTracer, Sample};

/// Levels of the tree of rays.
const MAX_DEPTH: u32 = 4;
/// A colour is right if it differs by no more than this part of itself and of 1: the tracer's pixels are f32.
const TOLERANCE: f64 = 1e-5;

/// The pixels of a picture in which the tracer and the plain one differ.
#[derive(Debug, Default)]
pub(super) struct Comparison {
    pub(super) pixels: u64,
    /// Pixels that differ though all pixels around them show the same face.
    pub(super) wrong: u64,
    /// Pixels that differ beside another face, or whose rays end exactly on an edge.
    pub(super) at_edges: u64,
    /// The first wrong pixel, with our colour and the true one.
    pub(super) example: Option<(u32, DVec3, DVec3)>,
}

/// Compares a scene's picture with that of the plain tracer, which computes with numbers of the type `N`.
pub(super) fn compare<N: Number>(scene: &Scene, size: Size) -> Comparison {
    let quality = Quality { cutoff: 0.0, max_depth: MAX_DEPTH, ..Quality::default() };
    let tracer = Tracer::new(scene, size, quality);
    let (mut ours, mut directions, mut scratch) = (Vec::new(), Vec::new(), Scratch::default());
    tracer.trace(0..size.pixels(), &mut scratch, &mut ours);
    tracer.paths(0..size.pixels(), &mut scratch, |path: Path| {
        if path.kind == RayKind::Primary {
            directions.push(path.ray.direction);
        }
    });
    let plain = PlainTracer::<N>::new(scene, MAX_DEPTH);
    let truth: Vec<Sample> = directions.iter().map(|&direction| plain.sample(direction)).collect();
    let mut comparison = Comparison { pixels: u64::from(size.pixels()), ..Comparison::default() };
    for (pixel, (ours, sample)) in (0..).zip(ours.iter().zip(&truth)) {
        let colour = DVec3::from(ours.map(f64::from));
        if (colour - sample.colour).abs().max_element() <= TOLERANCE * (1.0 + sample.colour.max_element()) {
            continue;
        }
        if sample.at_edge || is_beside_another_face(&truth, size, pixel) {
            comparison.at_edges += 1;
        } else {
            comparison.wrong += 1;
            comparison.example.get_or_insert((pixel, colour, sample.colour));
        }
    }
    comparison
}

/// Whether one of the pixels around a pixel shows another face.
fn is_beside_another_face(samples: &[Sample], size: Size, pixel: u32) -> bool {
    let (x, y) = (pixel % size.width(), pixel / size.width());
    let columns = x.saturating_sub(1)..=(x + 1).min(size.width() - 1);
    let mut rows = y.saturating_sub(1)..=(y + 1).min(size.height() - 1);
    let face = |x: u32, y: u32| samples[(y * size.width() + x) as usize].face;
    rows.any(|row| columns.clone().any(|column| face(column, row) != face(x, y)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csg::{Pass, Passes};
    use crate::scene::BUILT_IN;

    /// `ANEL_PLAIN_SCENES=2000 cargo test --lib plain -- --nocapture` tries more scenes.
    #[test]
    fn no_pixel_differs_from_a_plain_tracer_of_twice_the_precision() {
        let long = std::env::var("ANEL_PLAIN_SCENES").ok().and_then(|number| number.parse().ok());
        let (scenes, mut total, mut examples) = (long.unwrap_or(400), Comparison::default(), String::new());
        for seed in 0..scenes {
            let text = random_scene(seed);
            let scene = Scene::parse(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
            let Comparison { pixels, wrong, at_edges, example } =
                compare::<Wide>(&scene, "16x12".parse().expect("a size"));
            total.pixels += pixels;
            total.wrong += wrong;
            total.at_edges += at_edges;
            if let Some((pixel, ours, truth)) = example {
                examples += &format!("seed {seed}: {wrong} wrong, pixel {pixel}: {ours} and not {truth}\n{text}\n");
            }
        }
        let Comparison { pixels, wrong, at_edges, .. } = total;
        println!("{scenes} scenes, {pixels} pixels: {wrong} wrong, {at_edges} differ beside an edge");
        assert_eq!(wrong, 0, "{examples}");
    }

    /// The passes that save work by leaving it out. The others compute the same in another way, and so round otherwise.
    const OMITTING: [Pass; 7] = [
        Pass::CullEmpty,
        Pass::FoundBounds,
        Pass::UnionTrees,
        Pass::CompositionBounds,
        Pass::SplitUnions,
        Pass::LocalParts,
        Pass::Bvh,
    ];

    /// With `ANEL_PLAIN_SCENES` it tries more random scenes, and the built-in ones at 80 × 60 pixels.
    #[test]
    fn no_bit_of_a_picture_depends_on_what_is_left_out() {
        let long = std::env::var("ANEL_PLAIN_SCENES").ok().and_then(|number| number.parse().ok());
        let random = (0..long.unwrap_or(100)).map(|seed| (format!("seed {seed}"), random_scene(seed), "32x24"));
        let size = if long.is_some() { "80x60" } else { "16x12" };
        let built_in = BUILT_IN.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned(), size));
        for (name, text, size) in random.chain(built_in) {
            let scene = Scene::parse(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
            let size: Size = size.parse().expect("a size");
            let picture = |passes| {
                let mut pixels = Vec::new();
                let tracer = Tracer::with_passes(&scene, size, Quality::default(), passes);
                tracer.trace(0..size.pixels(), &mut Scratch::default(), &mut pixels);
                pixels.into_iter().map(|pixel| pixel.map(f32::to_bits)).collect::<Vec<_>>()
            };
            let all = picture(Passes::default());
            let none = picture(OMITTING.into_iter().fold(Passes::default(), Passes::without));
            let differing = all.iter().zip(&none).filter(|(a, b)| a != b).count();
            assert_eq!(differing, 0, "pixels of {name}");
        }
    }

    #[test]
    fn plain_tracer_shows_the_same_in_either_precision() {
        let scene = Scene::parse(&random_scene(3)).expect("a valid scene");
        let plain = PlainTracer::<f64>::new(&scene, MAX_DEPTH);
        let wide = PlainTracer::<Wide>::new(&scene, MAX_DEPTH);
        let direction = scene.camera.look_at - scene.camera.eye;
        let [plain, wide] = [plain.sample(direction), wide.sample(direction)];
        assert!(wide.face.is_some() && plain.face == wide.face);
        assert!((plain.colour - wide.colour).abs().max_element() < 1e-9);
    }
}
