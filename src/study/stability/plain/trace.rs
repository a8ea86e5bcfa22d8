//! A ray tracer by the article's equation without hierarchy, bounds or pruning: where a ray is, it knows from the
//! membership of points halfway between the places where it meets any surface.

use std::cell::Cell;

use crate::csg::Solid;
use crate::scene::{Light, Material, Scene, ior, media_of};
use glam::DVec3;

use super::number::Number;
use super::solid::{Meeting, Plain};
use super::vector::Vector;

/// Places closer together than this part of the numbers around them are one.
const TOLERANCE: f64 = 1e-12;
/// What is farther than this many times the scene's size is parallel but for the rounding of the scene's numbers.
const FAR: f64 = 1e9;

/// A scene to be traced plainly.
pub struct PlainTracer<'a, N> {
    scene: &'a Scene,
    solids: Vec<Part<N>>,
    max_depth: u32,
    /// Whether a ray of the present sample has met two faces of a primitive at one place: an edge, where the normal is
    /// anybody's guess, and where a touch may count or not.
    met_edge: Cell<bool>,
}

/// A solid, or the part of one that is one medium.
struct Part<N> {
    solid: Plain<N>,
    ior: Option<f64>,
}

/// A ray, and the solids that it is in at its start.
#[derive(Clone)]
struct Ray<N> {
    origin: Vector<N>,
    direction: Vector<N>,
    scale: f64,
    inside: Vec<bool>,
}

/// A boundary that a ray crosses.
struct Crossing<'a, N> {
    t: N,
    part: usize,
    enters: bool,
    material: &'a Material,
    normal: Vector<N>,
    /// The leaf and its surface.
    face: (usize, usize),
    /// What the ray is in before the crossing.
    inside: Vec<bool>,
}

/// A traced sample.
pub struct Sample {
    pub colour: DVec3,
    /// The leaf and the surface that is seen.
    pub face: Option<(usize, usize)>,
    /// Whether any of its rays meets an edge exactly.
    pub at_edge: bool,
}

impl<'a, N: Number> PlainTracer<'a, N> {
    pub fn new(scene: &'a Scene, max_depth: u32) -> Self {
        let mut leaves = 0;
        let media: Vec<_> = scene.solids.iter().flat_map(|solid| media_of(solid, scene)).collect();
        let mut part = |solid: &Solid| Part { solid: Plain::new(solid, &mut leaves), ior: ior(solid, scene) };
        let solids = media.iter().map(|solid| part(solid)).collect();
        Self { scene, solids, max_depth, met_edge: Cell::new(false) }
    }

    /// The colour that is seen from the eye in a direction.
    pub fn sample(&self, direction: DVec3) -> Sample {
        let scale = self.scene.camera.scale();
        let eye = Vector::from_f64(self.scene.camera.eye);
        let inside = self.solids.iter().map(|part| is_in(&part.solid, eye, scale)).collect();
        let ray = Ray { origin: eye, direction: Vector::from_f64(direction).normalize(), scale, inside };
        self.met_edge.set(false);
        let mut face = None;
        let colour = self.colour(&ray, 1, &mut face);
        Sample { colour, face, at_edge: self.met_edge.get() }
    }

    fn colour(&self, ray: &Ray<N>, level: u32, face: &mut Option<(usize, usize)>) -> DVec3 {
        let mut first = None;
        self.cross(ray, f64::INFINITY, |crossing| {
            let visible = self.is_visible(&crossing);
            first = visible.then_some(crossing);
            !visible
        });
        let Some(hit) = first else { return self.scene.background };
        *face = Some(hit.face);
        let material = hit.material;
        let into = hit.normal.dot(ray.direction).to_f64() > 0.0;
        let normal = if into { hit.normal * N::from_f64(-1.0) } else { hit.normal };
        let at = ray.origin + ray.direction * hit.t;
        let t = hit.t.to_f64();
        let scale = ray.scale.max(t).max(at.to_f64().abs().max_element());
        let on = |direction: Vector<N>, inside: Vec<bool>| Ray {
            origin: at,
            direction: direction.normalize(),
            scale,
            inside,
        };
        let mut colour = material.colour * self.scene.ambient * material.ka;
        for light in &self.scene.lights {
            let (direction, distance, intensity) = match *light {
                Light::Point { position, colour } => {
                    let way = Vector::from_f64(position) - at;
                    let distance = way.dot(way).sqrt().to_f64();
                    (way, distance - TOLERANCE * (scale + distance), colour)
                }
                Light::Directional { direction, colour } => (Vector::from_f64(-direction), f64::INFINITY, colour),
            };
            let shadow_ray = on(direction, hit.inside.clone());
            let cosine = normal.dot(shadow_ray.direction).to_f64();
            // Along the face but for the rounding of the scene's numbers.
            if cosine.is_nan() || cosine <= 1e-14 {
                continue;
            }
            let arriving = self.transmittance(&shadow_ray, distance);
            let mirrored = reflect(shadow_ray.direction * N::from_f64(-1.0), normal);
            let towards_eye = -ray.direction.dot(mirrored).to_f64();
            let specular = if towards_eye > 0.0 { material.ks * towards_eye.powf(material.n) } else { 0.0 };
            colour += intensity * arriving * (material.colour * material.kd * cosine + specular);
        }
        if level == self.max_depth {
            return colour;
        }
        let refracted = material.transmits().then(|| self.refract(ray.direction, normal, &hit)).flatten();
        let reflection = if refracted.is_none() { material.kt + material.ks } else { DVec3::splat(material.ks) };
        if reflection.max_element() > 0.0 {
            let reflected = on(reflect(ray.direction, normal), hit.inside.clone());
            colour += reflection * self.colour(&reflected, level + 1, &mut None);
        }
        if let Some(direction) = refracted {
            let mut inside = hit.inside;
            inside[hit.part] = hit.enters;
            colour += material.kt * self.colour(&on(direction, inside), level + 1, &mut None);
        }
        colour
    }

    /// The part of light that arrives against `ray` from a distance.
    fn transmittance(&self, ray: &Ray<N>, distance: f64) -> DVec3 {
        let mut part = DVec3::ONE;
        self.cross(ray, distance, |crossing| {
            if self.is_visible(&crossing) {
                part *= crossing.material.kt;
            }
            part != DVec3::ZERO
        });
        part
    }

    /// Whether a boundary exists: it does not inside a medium that comes first in the scene.
    fn is_visible(&self, crossing: &Crossing<'_, N>) -> bool {
        !crossing.material.transmits() || self.first_medium(&crossing.inside[..crossing.part]).is_none()
    }

    fn first_medium(&self, inside: &[bool]) -> Option<usize> {
        (0..inside.len()).find(|&part| inside[part] && self.solids[part].ior.is_some())
    }

    fn refract(&self, direction: Vector<N>, normal: Vector<N>, hit: &Crossing<'_, N>) -> Option<Vector<N>> {
        let mut others = hit.inside.clone();
        others[hit.part] = false;
        let outside = self.first_medium(&others).and_then(|part| self.solids[part].ior).unwrap_or(1.0);
        let inside = self.solids[hit.part].ior?;
        let (from, to) = if hit.enters { (outside, inside) } else { (inside, outside) };
        let one = N::from_f64(1.0);
        let ratio = N::from_f64(from) / N::from_f64(to);
        let cosine = -direction.dot(normal);
        let squared = one - ratio * ratio * (one - cosine * cosine);
        (squared.to_f64() >= 0.0).then(|| direction * ratio + normal * (ratio * cosine - squared.sqrt()))
    }

    /// Visits the boundaries that a ray crosses up to a distance, until `visit` returns false: those at one place in
    /// the order of entries, then exits the last in the scene first.
    fn cross<'s>(&'s self, ray: &Ray<N>, distance: f64, mut visit: impl FnMut(Crossing<'s, N>) -> bool) {
        let n = N::from_f64;
        let tolerance = |t: N| n(TOLERANCE * (ray.scale + t.to_f64().abs()));
        let far = FAR * ray.scale;
        let mut meetings: Vec<Meeting<N>> = Vec::new();
        for part in &self.solids {
            part.solid.leaves().into_iter().for_each(|leaf| leaf.meet(ray.origin, ray.direction, far, &mut meetings));
        }
        meetings.retain(|meeting| meeting.t > -tolerance(n(0.0)));
        meetings.sort_by(|a, b| a.t.partial_cmp(&b.t).expect("no NaN"));
        let at = |t: N| ray.origin + ray.direction * t;
        let mut inside = ray.inside.clone();
        // The first group are the meetings at the start; it may be empty.
        let (mut first, mut t, mut before) = (0, n(0.0), None);
        loop {
            let end = first + meetings[first..].iter().take_while(|next| next.t <= t + tolerance(t)).count();
            let last = meetings[first..end].last().map_or(t, |last| if last.t > t { last.t } else { t });
            let next = meetings.get(end).map_or(n(2.0) * last + n(ray.scale), |next| next.t);
            self.note_edges(&meetings[first..end], at(t));
            let after = at((last + next) * n(0.5));
            let now: Vec<bool> = self.solids.iter().map(|part| part.solid.contains(after)).collect();
            let changed = |enters: bool| {
                let (inside, now) = (inside.clone(), &now);
                (0..now.len()).filter(move |&part| inside[part] != enters && now[part] == enters).collect::<Vec<_>>()
            };
            let entries = changed(true).into_iter().map(|part| (part, true));
            let exits = changed(false).into_iter().rev().map(|part| (part, false));
            for (part, enters) in entries.chain(exits).collect::<Vec<_>>() {
                // At its start a ray comes from the other side.
                let from = before.unwrap_or_else(|| at(-tolerance(n(0.0)) * n(8.0)));
                let solid = &self.solids[part].solid;
                let leaves = solid.leaves();
                let leaf = solid.shown(from, after).unwrap_or(leaves[0]);
                let met = meetings[first..end].iter().find(|met| met.leaf == leaf.index);
                let surface = met.map_or(0, |met| met.surface);
                let normal = leaf.normal(surface, at(t));
                if t.to_f64() >= distance {
                    return;
                }
                let crossing = Crossing {
                    t,
                    part,
                    enters,
                    material: &self.scene.materials[leaf.tag.index()],
                    normal,
                    face: (leaf.index, surface),
                    inside: inside.clone(),
                };
                if !visit(crossing) {
                    return;
                }
                inside[part] = enters;
            }
            let Some(meeting) = meetings.get(end) else { return };
            (first, t, before) = (end, meeting.t, Some(after));
        }
    }

    /// Notes whether two of the meetings at a place are with faces of one primitive that are not parallel.
    fn note_edges(&self, meetings: &[Meeting<N>], place: Vector<N>) {
        for (index, one) in meetings.iter().enumerate() {
            for other in meetings[..index].iter().filter(|other| other.leaf == one.leaf) {
                let leaves = self.solids.iter().flat_map(|part| part.solid.leaves());
                let Some(leaf) = leaves.into_iter().find(|leaf| leaf.index == one.leaf) else { continue };
                let [a, b] = [one, other].map(|met| leaf.normal(met.surface, place));
                self.met_edge.set(self.met_edge.get() || a.dot(b).to_f64().abs() < 1.0 - 1e-9);
            }
        }
    }
}

/// Whether a point is inside by more than the tolerance.
fn is_in<N: Number>(solid: &Plain<N>, point: Vector<N>, scale: f64) -> bool {
    let around = (0..27).map(|place| [place % 3, place / 3 % 3, place / 9].map(|step| f64::from(step) - 1.0));
    around.into_iter().all(|by| solid.contains(point + Vector::from_f64(DVec3::from(by) * (scale * 1e-9))))
}

fn reflect<N: Number>(direction: Vector<N>, normal: Vector<N>) -> Vector<N> {
    direction - normal * (N::from_f64(2.0) * direction.dot(normal))
}
