//! Why a pixel has its colour and why it took so long: the tree of rays of each of its samples (Figure 3), and every term of
//! the equation (§3).

use glam::DVec3;

use super::observer::{Intersection, LightTerm, Note, Observer, Path, RayKind};
use super::{Scratch, Tracer};
use crate::csg::{RayStart, RootId, SpanDiagram};
use crate::geometry::Ray;

/// One sample of a pixel.
#[derive(Clone, Debug, Default)]
pub struct ExplainedSample {
    /// Its primary, reflected and refracted rays in the order in which they were traced; a ray's number is its place here.
    pub rays: Vec<ExplainedRay>,
    /// Whether it is one of those whose mean the pixel is: a corner may only tell that more samples are needed.
    pub counts: bool,
    /// What the rays that were left out would have counted together: no more than the cutoff.
    pub left_out: f64,
    /// How many they were.
    pub rays_left_out: u64,
}

/// A ray, and all that it brings but for what comes by the rays that start at its end.
#[derive(Clone, Debug)]
pub struct ExplainedRay {
    /// Its way.
    pub path: Path,

    /// What it met; nothing, if it met no solid.
    pub met: Option<Intersection>,
    /// In how many solids that transmit it was.
    pub inside: usize,
    /// The term Ka Ia; the background's colour if it met nothing.
    pub ambient: DVec3,
    /// The terms Kd Il (N·L) and Ks Il (S·R)ⁿ of each light that is on its side.
    pub lights: Vec<LightTerm>,
    /// The ways of the rays to these lights.
    pub shadows: Vec<Path>,
    /// What rays from its end would count, which the limit of the tree of rays forbids.
    pub too_deep: f64,
}

impl ExplainedRay {
    /// What it brings, but for what comes by rays that start at its end.
    pub fn colour(&self) -> DVec3 {
        self.lights.iter().fold(self.ambient, |sum, lit| sum + lit.coming * (lit.diffuse + lit.specular))
    }
}

impl ExplainedSample {
    /// The sample's colour: what all its rays bring, each times what the sample keeps of it.
    pub fn colour(&self) -> DVec3 {
        self.rays.iter().fold(DVec3::ZERO, |sum, ray| sum + ray.colour() * ray.path.weight)
    }

    /// The colour of the pixel of these samples.
    pub fn mean(samples: &[Self]) -> DVec3 {
        let counting = || samples.iter().filter(|sample| sample.counts);
        counting().map(Self::colour).sum::<DVec3>() / counting().count() as f64
    }

    /// What part of the pixel it is, that has all these samples.
    pub fn share(&self, samples: &[Self]) -> f64 {
        let counting = samples.iter().filter(|sample| sample.counts).count();
        if self.counts { 1.0 / counting as f64 } else { 0.0 }
    }

    /// What comes by the ray of this number (its place in [`ExplainedSample::rays`]) and all that follow from it, times what the
    /// sample keeps of it.
    pub fn brings(&self, number: usize) -> DVec3 {
        let mut sums: Vec<DVec3> = self.rays.iter().map(|ray| ray.colour() * ray.path.weight).collect();
        // A ray comes after that at whose end it starts.
        for place in (number + 1..self.rays.len()).rev() {
            if let Some(from) = self.rays[place].path.from {
                let sum = sums[place];
                sums[from as usize] += sum;
            }
        }
        sums[number]
    }
}

impl Tracer {
    /// Traces one pixel (its position in scan order) and tells all of each of its samples.
    pub fn explain(&self, pixel: u32, scratch: &mut Scratch) -> Vec<ExplainedSample> {
        let mut notes = Notes::default();
        self.pixel(pixel, scratch, &mut notes);
        notes.0
    }

    /// What a ray from `start` passes until the distance `to`, solid by solid in the order in which it enters what they are
    /// made of: its stays in each and in all its operands. So a solid that it only goes through the bore of is there too.
    pub fn span_diagrams(&self, ray: &Ray, start: Option<RayStart>, to: f64) -> Vec<(RootId, SpanDiagram)> {
        let diagrams = self.scene.roots().map(|root| (root, self.scene.tree.span_diagram(root, ray, start)));
        let mut passed: Vec<(f64, RootId, SpanDiagram)> = diagrams
            .map(|(root, diagram)| (first_entry(&diagram), root, diagram))
            .filter(|(enter, ..)| *enter <= to)
            .collect();
        passed.sort_by(|(a, ..), (b, ..)| a.total_cmp(b));
        passed.into_iter().map(|(_, root, diagram)| (root, diagram)).collect()
    }
}

/// Where a ray first enters a solid or any of its operands; infinite if it enters none.
fn first_entry(diagram: &SpanDiagram) -> f64 {
    let own = diagram.spans.iter().find(|[_, leave]| *leave > 0.0).map_or(f64::INFINITY, |[enter, _]| *enter);
    diagram.operands.iter().map(first_entry).fold(own, f64::min)
}

/// Writes everything down.
#[derive(Default)]
struct Notes(Vec<ExplainedSample>);

impl Observer for Notes {
    fn ray_traced(&mut self, path: impl FnOnce() -> Path) {
        let path = path();
        match path.kind {
            RayKind::Shadow => {
                let ray = self.0.last_mut().and_then(|sample| sample.rays.last_mut());
                ray.into_iter().for_each(|ray| ray.shadows.push(path));
                return;
            }
            RayKind::Primary => self.0.push(ExplainedSample::default()),
            RayKind::Reflected | RayKind::Refracted => {}
        }
        let ray = ExplainedRay {
            path,

            met: None,
            inside: 0,
            ambient: DVec3::ZERO,
            lights: Vec::new(),
            shadows: Vec::new(),
            too_deep: 0.0,
        };
        self.0.last_mut().into_iter().for_each(|sample| sample.rays.push(ray.clone()));
    }

    fn note(&mut self, note: impl FnOnce() -> Note) {
        let note = note();
        if let Note::CornersCount(count) = note {
            self.0.iter_mut().enumerate().for_each(|(place, sample)| sample.counts = count || place >= 4);
            return;
        }
        let Some(sample) = self.0.last_mut() else { return };
        let Some(ray) = sample.rays.last_mut() else { return };
        match note {
            Note::Background(colour) => ray.ambient = colour,
            Note::Intersection { met, ambient, inside } => {
                (ray.met, ray.ambient, ray.inside) = (Some(met), ambient, inside)
            }
            Note::LightTerm(lit) => ray.lights.push(lit),
            Note::TooDeep(weight) => ray.too_deep = weight,
            // What is left of a sum may be less than nothing by rounding.
            Note::LeftOut(weight, rays) => (sample.left_out, sample.rays_left_out) = (weight.max(0.0), rays),
            Note::CornersCount(_) => {}
        }
    }
}
