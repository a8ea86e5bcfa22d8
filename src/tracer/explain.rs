//! Why a pixel has its colour and why it took so long: the tree of rays of each of its samples (Figure 3), and every term of
//! the equation (§3).

use glam::DVec3;

use super::path::{Path, RayKind, Watch};
use super::{Scratch, Tracer};
use crate::csg::{Figure, Start};
use crate::geometry::Ray;

/// One sample of a pixel.
#[derive(Clone, Debug, Default)]
pub struct Explained {
    /// Its primary, reflected and refracted rays in the order in which they were traced; a ray's number is its place here.
    pub rays: Vec<RayNotes>,
    /// What part of the pixel it is; 0 of a corner that only told that more samples are needed.
    pub share: f64,
    /// What the rays that were left out would have counted together: no more than the cutoff.
    pub left_out: f64,
    /// How many they were.
    pub rays_left_out: u64,
}

/// A ray, and all that it brings but for what comes by the rays that start at its end.
#[derive(Clone, Debug)]
pub struct RayNotes {
    /// Its way.
    pub path: Path,
    /// Where it started, unless that was the eye.
    pub began: Option<Start>,
    /// What it met; nothing, if it met no solid.
    pub met: Option<Met>,
    /// In how many solids that transmit it was.
    pub inside: usize,
    /// The term Ka Ia; the background's colour if it met nothing.
    pub ambient: DVec3,
    /// The terms Kd Il (N·L) and Ks Il (S·R)ⁿ of each light that is on its side.
    pub lights: Vec<Lit>,
    /// What rays from its end would count, which the limit of the tree of rays forbids.
    pub too_deep: f64,
}

/// What a ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// The solid and its face, and where a ray starts that goes on from there.
    pub start: Start,
    /// The primitive's number for its surface (which material it has).
    pub tag: u32,
    /// The solid is entered; else left.
    pub enters: bool,
    /// Of length 1, on the side that the ray came from.
    pub normal: DVec3,
}

/// What a light adds where a ray ends.
#[derive(Clone, Debug)]
pub struct Lit {
    /// The light's place in the scene's list.
    pub light: usize,
    /// What part of its intensity arrives.
    pub arriving: f64,
    /// Kd Il (N·L)
    pub diffuse: DVec3,
    /// Ks Il (S·R)ⁿ
    pub specular: DVec3,
}

/// What is known of a ray.
pub(super) enum Note {
    Background(DVec3),
    Met {
        met: Met,
        began: Option<Start>,
        ambient: DVec3,
        inside: usize,
    },
    Lit(Lit),
    TooDeep(f64),
    /// What was left out of the whole sample, and how many rays these were.
    LeftOut(f64, u64),
    /// Of all samples: the part of the pixel that each of the first four is, and each of the others.
    Shares([f64; 2]),
}

impl RayNotes {
    /// What it brings, but for what comes by rays that start at its end.
    pub fn colour(&self) -> DVec3 {
        self.lights.iter().fold(self.ambient, |sum, lit| sum + (lit.diffuse + lit.specular))
    }
}

impl Explained {
    /// The sample's colour: what all its rays bring, each times what the sample keeps of it.
    pub fn colour(&self) -> DVec3 {
        self.rays.iter().fold(DVec3::ZERO, |sum, ray| sum + ray.colour() * ray.path.weight)
    }

    /// What comes by the ray of this number and all that follow from it, times what the sample keeps of it.
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
    pub fn explain(&self, pixel: u32, scratch: &mut Scratch) -> Vec<Explained> {
        let mut notes = Notes::default();
        self.pixel(pixel, scratch, &mut notes);
        notes.0
    }

    /// What a ray from `start` passes until the distance `to`, solid by solid in the order in which it enters them: its
    /// stays in each and in all that it is made of.
    pub fn figures(&self, ray: &Ray, start: Option<Start>, to: f64) -> Vec<(u32, Figure)> {
        let roots = self.world.unbounded.iter().copied().chain(self.world.bounded.roots());
        let figures = roots.map(|root| (root, self.world.tree.figure(root, ray, start)));
        let entered = |figure: &Figure| figure.stays.iter().find(|[_, leave]| *leave > 0.0).map(|[enter, _]| *enter);
        let passed = figures.filter(|(_, figure)| entered(figure).is_some_and(|enter| enter <= to));
        let mut passed: Vec<(u32, Figure)> = passed.collect();
        passed.sort_by(|(_, a), (_, b)| {
            let [a, b] = [a, b].map(|figure| entered(figure).unwrap_or(f64::INFINITY));
            a.total_cmp(&b)
        });
        passed
    }
}

/// Writes everything down.
#[derive(Default)]
struct Notes(Vec<Explained>);

impl Watch for Notes {
    fn see(&mut self, path: impl FnOnce() -> Path) {
        let path = path();
        match path.kind {
            RayKind::Shadow => return,
            RayKind::Primary => self.0.push(Explained::default()),
            RayKind::Reflected | RayKind::Refracted => {}
        }
        let ray = RayNotes {
            path,
            began: None,
            met: None,
            inside: 0,
            ambient: DVec3::ZERO,
            lights: Vec::new(),
            too_deep: 0.0,
        };
        self.0.last_mut().into_iter().for_each(|sample| sample.rays.push(ray.clone()));
    }

    fn note(&mut self, note: impl FnOnce() -> Note) {
        let note = note();
        if let Note::Shares([first, others]) = note {
            let shares = [first; 4].into_iter().chain(std::iter::repeat(others));
            self.0.iter_mut().zip(shares).for_each(|(sample, share)| sample.share = share);
            return;
        }
        let Some(sample) = self.0.last_mut() else { return };
        let Some(ray) = sample.rays.last_mut() else { return };
        match note {
            Note::Background(colour) => ray.ambient = colour,
            Note::Met { met, began, ambient, inside } => {
                (ray.met, ray.began, ray.ambient, ray.inside) = (Some(met), began, ambient, inside);
            }
            Note::Lit(lit) => ray.lights.push(lit),
            Note::TooDeep(weight) => ray.too_deep = weight,
            Note::LeftOut(weight, rays) => (sample.left_out, sample.rays_left_out) = (weight, rays),
            Note::Shares(_) => {}
        }
    }
}
