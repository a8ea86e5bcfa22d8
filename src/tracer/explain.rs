//! Explanation of a pixel: the tree of rays of each of its samples (Figure 3), and every term of the equation (§3).

use glam::DVec3;

use super::observer::{Intersection, LightTerm, Note, Observer, Path, RayKind};
use super::{Scratch, Tracer};
use crate::csg::{RayStart, RootId, SpanDiagram};
use crate::geometry::Ray;

/// A sample of a pixel, with all its rays.
#[derive(Clone, Debug, Default)]
pub struct ExplainedSample {
    /// Its primary, reflected and refracted rays in the order of tracing. A ray's number is its index here.
    pub rays: Vec<ExplainedRay>,
    /// Whether the pixel's mean includes the sample. A corner may serve only to show that more samples are needed.
    pub counts: bool,
    /// The total weight of the rays that were left out: at most the cutoff.
    pub left_out: f64,
    /// The number of rays that were left out.
    pub rays_left_out: u64,
}

/// A ray, with the terms of the equation where it ends. The colours of secondary rays are not included.
#[derive(Clone, Debug)]
pub struct ExplainedRay {
    /// The ray with its start and end.
    pub path: Path,

    /// What the ray hit; nothing if it hit no solid.
    pub met: Option<Intersection>,
    /// The number of transmitting solids that the ray was in.
    pub inside: usize,
    /// The term Ka Ia, or the background's colour if the ray hit nothing.
    pub ambient: DVec3,
    /// The terms Kd Il (N·L) and Ks Il (S·R)ⁿ of each light on the ray's side of the surface.
    pub lights: Vec<LightTerm>,
    /// The shadow rays to these lights.
    pub shadows: Vec<Path>,
    /// The weight of secondary rays that the depth limit did not allow.
    pub too_deep: f64,
}

impl ExplainedRay {
    /// The ray's colour without that of its secondary rays.
    pub fn colour(&self) -> DVec3 {
        self.lights.iter().fold(self.ambient, |sum, lit| sum + lit.coming * (lit.diffuse + lit.specular))
    }
}

impl ExplainedSample {
    /// The sample's colour: the sum over its rays of colour times weight.
    pub fn colour(&self) -> DVec3 {
        self.rays.iter().fold(DVec3::ZERO, |sum, ray| sum + ray.colour() * ray.path.factor)
    }

    /// The colour of the pixel that has these samples.
    pub fn mean(samples: &[Self]) -> DVec3 {
        let counting = || samples.iter().filter(|sample| sample.counts);
        counting().map(Self::colour).sum::<DVec3>() / counting().count() as f64
    }

    /// The sample's part of the pixel that has these samples, 0 to 1.
    pub fn share(&self, samples: &[Self]) -> f64 {
        let counting = samples.iter().filter(|sample| sample.counts).count();
        if self.counts { 1.0 / counting as f64 } else { 0.0 }
    }

    /// The part of the sample's colour that comes from a ray, given by its number, and from all rays that follow from
    /// it.
    pub fn contribution_of(&self, number: usize) -> DVec3 {
        let mut sums: Vec<DVec3> = self.rays.iter().map(|ray| ray.colour() * ray.path.factor).collect();
        // A ray comes after its parent.
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
    /// Traces one pixel (a position in scan order) and records all its samples.
    pub fn explain(&self, pixel: u32, scratch: &mut Scratch) -> Vec<ExplainedSample> {
        let mut notes = Notes::default();
        self.pixel(pixel, scratch, &mut notes);
        notes.0
    }

    /// The spans of a ray from `start` to the distance `to`, for every solid that it enters, in order of first entry
    /// into any of the solid's operands. A solid whose bore the ray passes through is therefore listed too.
    pub fn span_diagrams(&self, ray: &Ray, start: Option<RayStart>, to: f64) -> Vec<(RootId, SpanDiagram)> {
        let diagrams = self.scene.roots().map(|root| (root, self.scene.tree.span_diagram(root, ray, start)));
        let mut passed: Vec<(f64, RootId, SpanDiagram)> = diagrams
            .map(|(root, diagram)| (first_entry(&diagram), root, diagram))
            .filter(|(enter, ..)| *enter <= to + ray.tolerance(to))
            .collect();
        passed.sort_by(|(a, ..), (b, ..)| a.total_cmp(b));
        passed.into_iter().map(|(_, root, diagram)| (root, diagram)).collect()
    }
}

/// The distance at which a ray first enters a solid or any of its operands; infinite if it enters none.
fn first_entry(diagram: &SpanDiagram) -> f64 {
    let own = diagram.spans.iter().find(|[_, leave]| *leave > 0.0).map_or(f64::INFINITY, |[enter, _]| *enter);
    diagram.operands.iter().map(first_entry).fold(own, f64::min)
}

/// Records everything.
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
            // Rounding may leave less than 0.
            Note::LeftOut(weight, rays) => (sample.left_out, sample.rays_left_out) = (weight.max(0.0), rays),
            Note::CornersCount(_) => {}
        }
    }
}
