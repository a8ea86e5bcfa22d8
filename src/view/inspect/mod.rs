//! One pixel: what made its colour and what took its time. The tree of its rays is the article's Figure 3, the spans along
//! one of them are its Figure 2, and the terms are those of its equation (§3).

mod phrases;
mod rays;
mod spans;
mod terms;
mod words;

use std::sync::Arc;

use glam::DVec3;

use super::draw::display_list::{Anchor, Hue, Ink, Mark, Point, TextSize};
use crate::csg::SpanDiagram;
use crate::language::{Language, word};
use crate::palette::{Rgb, mix};
use crate::picture::srgb8;
use crate::scene::{Material, Scene};
use crate::tracer::{Explained, RayCounts, RayNotes, Scratch, Tracer};

pub use rays::{RaySpot, RayTree};
pub use spans::SpanPlot;
pub use terms::{Term, Terms};

/// A pixel and all that is known of it, and one of its rays, which is looked at more closely.
#[derive(Clone, Debug)]
pub struct Inspected {
    /// Its column and its row, from 0 in the upper left corner.
    pub place: [u32; 2],
    /// Its samples; one at least.
    pub samples: Arc<[Explained]>,
    /// What it took.
    pub rays: RayCounts,
    /// The ray that is looked at.
    pub chosen: ChosenRay,
    /// What this ray passes: the root of each solid, and the stays in it and in what it is made of.
    pub figures: Vec<(u32, SpanDiagram)>,
    materials: Arc<[(String, Material)]>,
    lights: usize,
}

/// A ray of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ChosenRay {
    /// Its sample.
    pub sample: usize,
    /// Its number among the sample's rays; 0 is the primary ray.
    pub ray: usize,
}

impl Inspected {
    /// Traces a pixel of the picture once more and looks at it; nothing if there is no such pixel. `scene` is the one that
    /// `tracer` was made of.
    pub fn new(tracer: &Tracer, scene: &Scene, place: [u32; 2]) -> Option<Self> {
        let size = tracer.size();
        let [x, y] = place;
        if x >= size.width() || y >= size.height() {
            return None;
        }
        let mut scratch = Scratch::default();
        let samples: Arc<[Explained]> = tracer.explain(y * size.width() + x, &mut scratch).into();
        let materials = scene.names.iter().cloned().zip(scene.materials.iter().copied()).collect();
        let (rays, lights) = (scratch.rays, scene.lights.len());
        let chosen = ChosenRay { sample: samples.iter().position(|sample| sample.counts)?, ray: 0 };
        let unseen = Self { place, samples, rays, chosen, figures: Vec::new(), materials, lights };
        unseen.choose(tracer, chosen)
    }

    /// The same pixel, seen along another of its rays; nothing if it has no such ray.
    pub fn choose(&self, tracer: &Tracer, chosen: ChosenRay) -> Option<Self> {
        let ray = self.samples.get(chosen.sample)?.rays.get(chosen.ray)?;
        let figures = tracer.figures(&ray.path.ray, ray.path.start, ray.path.to);
        Some(Self { chosen, figures, ..self.clone() })
    }

    /// Its colour in linear light.
    pub fn colour(&self) -> DVec3 {
        Explained::mean(&self.samples)
    }

    /// The sample that is looked at.
    pub fn sample(&self) -> &Explained {
        &self.samples[self.chosen.sample]
    }

    /// The ray that is looked at.
    pub fn ray(&self) -> &RayNotes {
        &self.sample().rays[self.chosen.ray]
    }

    /// What a material is called, if it has a name.
    fn name(&self, tag: u32) -> Option<&str> {
        self.materials.get(tag as usize).map(|(name, _)| &**name).filter(|name| !name.is_empty())
    }

    fn material(&self, tag: u32) -> Material {
        self.materials.get(tag as usize).map(|(_, material)| *material).unwrap_or_default()
    }

    /// What a ray met, in a word or two.
    fn what(&self, ray: &RayNotes, language: Language) -> &str {
        let nameless = word!(language, "a solid without a material", "um sólido sem material");
        ray.met.map_or(word!(language, "nothing", "nada"), |met| self.name(met.tag).unwrap_or(nameless))
    }

    /// The colour of what a ray met, as it is shown.
    fn colour_of(&self, ray: &RayNotes) -> Rgb {
        match ray.met {
            Some(met) => shown(self.material(met.tag).colour),
            None => shown(ray.ambient),
        }
    }
}

/// Linear light as it is shown.
fn shown(colour: DVec3) -> Rgb {
    srgb8(colour.as_vec3().to_array())
}

/// How bright it is (Rec. ITU-R BT.709), in linear light.
fn brightness(colour: DVec3) -> f64 {
    colour.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

/// A line of the usual small text.
const SMALL: TextSize = TextSize::Small(1.0);

fn label(at: Point, anchor: Anchor, text: impl Into<String>, hue: Hue) -> Mark {
    Mark::Label { at, anchor, text: text.into(), size: SMALL, ink: hue.full() }
}

/// A box of a colour with an edge that is seen on every ground.
fn swatch(centre: Point, half: Point, colour: Rgb) -> [Mark; 2] {
    let part = |by: f32, colour| {
        let half = half.map(|half| half - by);
        Mark::Box { centre, half, round: 2.0, ink: Hue::Told(colour).full() }
    };
    [part(0.0, edge(colour)), part(1.0, colour)]
}

/// A colour's edge, which is seen on a dark and on a light ground.
fn edge(colour: Rgb) -> Rgb {
    mix(colour, [0x80; 3], 0.7)
}

/// The beginning of a text that has so much room.
fn cut(text: &str, room: f32) -> String {
    let most = (room / SMALL.width(1)) as usize;
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
    use crate::scene::BUILT_IN;

    /// Pixels of every built-in scene.
    pub(super) fn each(quality: Quality, mut each: impl FnMut(&Tracer, Inspected)) {
        let size = Size::new(24, 18).expect("a small picture");
        for (_, text) in BUILT_IN {
            let scene = Scene::parse(text).expect("a built-in scene");
            let tracer = Tracer::new(&scene, size, quality);
            for pixel in (0..size.pixels()).step_by(7) {
                let place = [pixel % size.width(), pixel / size.width()];
                each(&tracer, Inspected::new(&tracer, &scene, place).expect("a pixel of the picture"));
            }
        }
    }

    /// Whether everything is drawn within a size.
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
    fn a_pixel_beyond_the_picture_and_a_ray_beyond_the_tree_are_not_there() {
        let scene = Scene::parse(BUILT_IN[0].1).expect("a built-in scene");
        let tracer = Tracer::new(&scene, Size::new(4, 3).expect("small"), Quality::default());
        assert!([[4, 0], [0, 3], [u32::MAX; 2]].iter().all(|&place| Inspected::new(&tracer, &scene, place).is_none()));
        let inspected = Inspected::new(&tracer, &scene, [3, 2]).expect("the last pixel");
        let beyond = ChosenRay { sample: 0, ray: inspected.samples[0].rays.len() };
        assert!(inspected.choose(&tracer, beyond).is_none());
        assert!(inspected.choose(&tracer, ChosenRay { sample: 1, ray: 0 }).is_none());
    }

    #[test]
    fn what_is_too_long_is_cut() {
        assert_eq!([cut("box", 100.0), cut("a long name", 40.0), cut("x", 0.0)], ["box", "a lo…", "…"]);
    }
}
