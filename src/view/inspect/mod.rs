//! The inspector: why a pixel has its colour, and why it takes its time. It shows the tree of rays (the article's
//! Figure 3), the spans along a ray (Figure 2), and the terms of the equation (§3).

mod phrases;
mod rays;
mod spans;
mod terms;
mod words;

use std::sync::Arc;

use glam::DVec3;

use super::draw::display_list::{Anchor, Hue, Ink, Mark, Point, TextSize};
use crate::csg::{MaterialTag, RootId, SpanDiagram};
use crate::language::{Language, word};
use crate::palette::{Rgb, mix};
use crate::picture::srgb8;
use crate::scene::{Material, Scene};
use crate::tracer::{ExplainedRay, ExplainedSample, RayCounts, Scratch, Tracer};

pub use rays::{RaySpot, RayTree};
pub use spans::SpanPlot;
pub use terms::{Term, Terms};

/// An inspected pixel, and the one of its rays that is shown in detail.
#[derive(Clone, Debug)]
pub struct Inspected {
    /// Column and row, from 0 at the upper left corner.
    pub pixel: [u32; 2],
    /// Samples; one at least.
    pub samples: Arc<[ExplainedSample]>,
    /// Numbers of rays.
    pub rays: RayCounts,
    /// The chosen ray.
    pub chosen: ChosenRay,
    /// Solids on the chosen ray: the root of each, and the spans of the solid and of its operands.
    pub diagrams: Vec<(RootId, SpanDiagram)>,
    materials: Arc<[(String, Material)]>,
    lights: usize,
}

/// Position of a ray among those of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ChosenRay {
    /// Index of the sample.
    pub sample: usize,
    /// Index among the sample's rays; 0 is the primary ray.
    pub ray: usize,
}

impl Inspected {
    /// Traces a pixel once more and notes its rays. `scene` is the one that `tracer` was compiled from. `None` if the
    /// picture does not have the pixel.
    pub fn new(tracer: &Tracer, scene: &Scene, pixel: [u32; 2]) -> Option<Self> {
        let size = tracer.size();
        let [x, y] = pixel;
        if x >= size.width() || y >= size.height() {
            return None;
        }
        let mut scratch = Scratch::default();
        let samples: Arc<[ExplainedSample]> = tracer.explain(y * size.width() + x, &mut scratch).into();
        let materials = scene.names.iter().cloned().zip(scene.materials.iter().copied()).collect();
        let (rays, lights) = (scratch.rays, scene.lights.len());
        let chosen = ChosenRay { sample: samples.iter().position(|sample| sample.counts)?, ray: 0 };
        let inspected = Self { pixel, samples, rays, chosen, diagrams: Vec::new(), materials, lights };
        inspected.choose(tracer, chosen)
    }

    /// Returns the pixel with another chosen ray; `None` if it does not have that ray.
    pub fn choose(&self, tracer: &Tracer, chosen: ChosenRay) -> Option<Self> {
        let ray = self.samples.get(chosen.sample)?.rays.get(chosen.ray)?;
        let diagrams = tracer.span_diagrams(&ray.path.ray, ray.path.start, ray.path.to);
        Some(Self { chosen, diagrams, ..self.clone() })
    }

    /// Colour of the pixel in linear light.
    pub fn colour(&self) -> DVec3 {
        ExplainedSample::mean(&self.samples)
    }

    /// Sample of the chosen ray.
    pub fn sample(&self) -> &ExplainedSample {
        &self.samples[self.chosen.sample]
    }

    /// The chosen ray.
    pub fn ray(&self) -> &ExplainedRay {
        &self.sample().rays[self.chosen.ray]
    }

    /// Name of a material, if it has one.
    fn name(&self, tag: MaterialTag) -> Option<&str> {
        self.materials.get(tag.index()).map(|(name, _)| &**name).filter(|name| !name.is_empty())
    }

    /// A material; the default one for an unknown tag.
    fn material(&self, tag: MaterialTag) -> Material {
        self.materials.get(tag.index()).map(|(_, material)| *material).unwrap_or_default()
    }

    /// Name of the material that a ray met.
    fn met_name(&self, ray: &ExplainedRay, language: Language) -> &str {
        let nameless = word!(language, "a solid without a material", "um sólido sem material");
        ray.met.map_or(word!(language, "nothing", "nada"), |met| self.name(met.tag).unwrap_or(nameless))
    }

    /// Colour of the material that a ray met, in sRGB.
    fn met_colour(&self, ray: &ExplainedRay) -> Rgb {
        match ray.met {
            Some(met) => shown(self.material(met.tag).colour),
            None => shown(ray.ambient),
        }
    }
}

/// Converts linear light to sRGB.
fn shown(colour: DVec3) -> Rgb {
    srgb8(colour.as_vec3().to_array())
}

/// Luminance of linear light (Rec. ITU-R BT.709).
fn brightness(colour: DVec3) -> f64 {
    colour.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

/// Size of the inspector's texts.
const SMALL: TextSize = TextSize::Small(1.0);

fn label(at: Point, anchor: Anchor, text: impl Into<String>, hue: Hue) -> Mark {
    Mark::Label { at, anchor, text: text.into(), size: SMALL, ink: hue.full() }
}

/// Draws a box of a colour with an edge that is visible on every ground.
fn swatch(centre: Point, half: Point, colour: Rgb) -> [Mark; 2] {
    let part = |by: f32, colour| {
        let half = half.map(|half| half - by);
        Mark::Box { centre, half, round: 2.0, ink: Hue::Fixed(colour).full() }
    };
    [part(0.0, edge(colour)), part(1.0, colour)]
}

/// Returns the colour of an edge that is visible on a dark and on a light ground.
fn edge(colour: Rgb) -> Rgb {
    mix(colour, [0x80; 3], 0.7)
}

/// Cuts a text to a width.
fn cut(text: &str, width: f32) -> String {
    let most = (width / SMALL.width(1)) as usize;
    if text.chars().count() <= most {
        return text.to_owned();
    }
    text.chars().take(most.saturating_sub(1)).collect::<String>().trim_end().to_owned() + "…"
}

fn line(points: [Point; 2], width: f32, ink: Ink) -> Mark {
    Mark::Line { points: points.to_vec(), width, ink }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Quality, Size};
    use crate::scene::SMALL_BUILT_IN;

    /// Calls `each` with pixels of each built-in scene.
    pub(super) fn each(quality: Quality, mut each: impl FnMut(&Tracer, Inspected)) {
        let size = Size::new(24, 18).expect("a small picture");
        for (_, text) in SMALL_BUILT_IN {
            let scene = Scene::parse(text).expect("a built-in scene");
            let tracer = Tracer::new(&scene, size, quality);
            for pixel in (0..size.pixels()).step_by(7) {
                let place = [pixel % size.width(), pixel / size.width()];
                each(&tracer, Inspected::new(&tracer, &scene, place).expect("a pixel of the picture"));
            }
        }
    }

    /// Asserts that all marks are within a size.
    pub(super) fn assert_within(marks: &[Mark], [width, height]: Point) {
        for mark in marks {
            let places: Vec<Point> = match mark {
                Mark::Disc { centre: [x, y], radius, .. } => vec![[x - radius, y - radius], [x + radius, y + radius]],
                Mark::Box { centre: [x, y], half: [w, h], .. } => vec![[x - w, y - h], [x + w, y + h]],
                Mark::Line { points, .. } | Mark::Trail { points, .. } => points.clone(),
                Mark::Label { at: [x, y], anchor, text, size, .. } => {
                    let long = size.width(text.chars().count());
                    let left = anchor.left(*x, long);
                    vec![[left, y - size.units() / 2.0], [left + long, y + size.units() / 2.0]]
                }
            };
            for [x, y] in places {
                let is_in = (-0.5..=width + 0.5).contains(&x) && (-0.5..=height + 0.5).contains(&y);
                assert!(is_in, "{mark:?} is not within {width} × {height}");
            }
        }
    }

    #[test]
    fn pixel_outside_the_picture_and_missing_ray_are_none() {
        let scene = Scene::parse(SMALL_BUILT_IN[0].1).expect("a built-in scene");
        let tracer = Tracer::new(&scene, Size::new(4, 3).expect("small"), Quality::default());
        assert!([[4, 0], [0, 3], [u32::MAX; 2]].iter().all(|&place| Inspected::new(&tracer, &scene, place).is_none()));
        let inspected = Inspected::new(&tracer, &scene, [3, 2]).expect("the last pixel");
        let beyond = ChosenRay { sample: 0, ray: inspected.samples[0].rays.len() };
        assert!(inspected.choose(&tracer, beyond).is_none());
        assert!(inspected.choose(&tracer, ChosenRay { sample: 1, ray: 0 }).is_none());
    }

    #[test]
    fn long_text_is_cut() {
        assert_eq!([cut("box", 100.0), cut("a long name", 40.0), cut("x", 0.0)], ["box", "a lo…", "…"]);
    }
}
