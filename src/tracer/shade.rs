//! The article's equation (§3; Whitted 1980): the colour that a ray brings.
//!
//! Cp = Ka Ia + Kd Σ Ilj (N·Lj) + Ks Σ Ilj (S·Rj)ⁿ + Ks Is + Kt It

use glam::DVec3;

use super::compiled_scene::Shading;
use super::intersect::{HitScratch, has_turned_at};
use super::media::{Media, MediaSets, Medium};
use super::observer::{Intersection, LightTerm, Note, Observer, Path, RayKind};
use super::ray_queue::{QueuedRay, RayQueue};
use super::{RayCounts, Tracer};
use crate::csg::{Hit, RayStart, RootId, rank};
use crate::geometry::Ray;
use crate::scene::Light;

/// What a thread needs to trace, kept from pixel to pixel so that nothing is allocated; it counts the rays.
#[derive(Debug, Default)]
pub struct Scratch {
    /// Rays traced with this scratch so far.
    pub rays: RayCounts,
    memory: HitScratch,
    media: MediaSets,
    branches: RayQueue,
}

/// A hit with what the equation needs of it.
struct ShadingPoint<'a> {
    start: RayStart,
    enters: bool,
    t: f64,
    /// Of length 1, on the side that the ray comes from.
    normal: DVec3,
    finish: &'a Shading,
    /// What the ray is in before it.
    media: Media,
    /// What is around the solid, if that transmits and it is not air.
    around: Option<Medium>,
}

impl ShadingPoint<'_> {
    /// The solid as a medium.
    fn medium(&self) -> Medium {
        Medium { root: self.start.root, ior: self.finish.ior }
    }

    /// For rays that stay on the side from which the place was met: to a light, or reflected.
    fn turned(&self) -> RayStart {
        RayStart { turned: !self.start.turned, ..self.start }
    }
}

impl Tracer {
    /// The colour that a primary ray brings, in linear light.
    pub(super) fn sample(&self, ray: &Ray, scratch: &mut Scratch, watch: &mut impl Observer) -> DVec3 {
        scratch.rays.count(RayKind::Primary);
        let media = scratch.media.restart(&self.world.eye_media);
        scratch.branches.restart();
        let primary = QueuedRay {
            kind: RayKind::Primary,
            weight: 1.0,
            level: 1,
            number: 0,
            from: None,
            ray: *ray,
            start: None,
            media,
        };
        let mut colour = self.colour(&primary, scratch, watch);
        while let Some(branch) = scratch.branches.next(self.quality.cutoff) {
            scratch.rays.count(branch.kind);
            colour += self.colour(&branch, scratch, watch) * branch.weight;
        }
        watch.note(|| Note::LeftOut(scratch.branches.weight(), scratch.branches.rays()));
        colour
    }

    /// The colour that a ray brings, but for what comes by rays that start at its end: these now wait.
    #[inline(always)]
    fn colour(&self, branch: &QueuedRay, scratch: &mut Scratch, watch: &mut impl Observer) -> DVec3 {
        let QueuedRay { ray, start, media, .. } = branch;
        let nearest = self.world.nearest(ray, *start, &mut scratch.memory);
        let around = self.around(nearest, *media, scratch);
        if let Some((root, hit)) = nearest.filter(|(root, _)| is_hidden(*root, around)) {
            let turned = has_turned_at(*start, ray, hit.t);
            let place = self.place(ray, root, &hit, turned, *media, around);
            return self.colour_behind(branch, place, scratch, watch);
        }
        watch.see(|| path(branch, nearest.map_or(f64::INFINITY, |(_, hit)| hit.t)));
        let Some((root, hit)) = nearest else {
            watch.note(|| Note::Background(self.world.background));
            return self.world.background;
        };
        let place = self.place(ray, root, &hit, has_turned_at(*start, ray, hit.t), *media, around);
        self.shade(ray, &place, branch, scratch, watch)
    }

    /// The colour of a ray that meets a boundary that is not there, since another medium fills the place: of what it meets
    /// further on.
    #[cold]
    fn colour_behind<'a>(
        &'a self,
        branch: &QueuedRay,
        mut place: ShadingPoint<'a>,
        scratch: &mut Scratch,
        watch: &mut impl Observer,
    ) -> DVec3 {
        let (mut ray, mut passed) = (branch.ray, 0.0);
        loop {
            let media = scratch.media.beyond(place.media, place.medium(), place.enters);
            ray = ray.onward(place.t, ray.direction);
            passed += place.t;
            let start = Some(place.start);
            let nearest = self.world.nearest(&ray, start, &mut scratch.memory);
            let around = self.around(nearest, media, scratch);
            if let Some((root, hit)) = nearest {
                place = self.place(&ray, root, &hit, has_turned_at(start, &ray, hit.t), media, around);
                if is_hidden(root, around) {
                    continue;
                }
            }
            watch.see(|| path(branch, passed + nearest.map_or(f64::INFINITY, |(_, hit)| hit.t)));
            return match nearest {
                Some(_) => self.shade(&ray, &place, branch, scratch, watch),
                None => {
                    watch.note(|| Note::Background(self.world.background));
                    self.world.background
                }
            };
        }
    }

    /// What is around the solid that is met, if that transmits and it is not air.
    #[inline(always)]
    fn around(&self, nearest: Option<(RootId, Hit)>, media: Media, scratch: &Scratch) -> Option<Medium> {
        let (root, _) = nearest.filter(|(_, hit)| self.world.finish(hit.surface).kt > 0.0)?;
        scratch.media.around(media, root)
    }

    #[inline(always)]
    fn shade(
        &self,
        ray: &Ray,
        place: &ShadingPoint<'_>,
        branch: &QueuedRay,
        scratch: &mut Scratch,
        watch: &mut impl Observer,
    ) -> DVec3 {
        let finish = place.finish;
        let mut colour = finish.ambient;
        watch.note(|| {
            let ShadingPoint { start, enters, normal, media, .. } = *place;
            let met = Intersection { start, tag: self.world.tree.leaf(start.surface).tag, enters, normal };
            Note::Intersection { met, ambient: colour, inside: scratch.media.get(media).len() }
        });
        for index in 0..self.world.lights.len() {
            colour += self.light(index, ray, place, branch, scratch, watch);
        }
        if finish.ks == 0.0 && finish.kt == 0.0 {
            return colour;
        }
        if branch.level == self.quality.max_depth {
            watch.note(|| Note::TooDeep(branch.weight * (finish.ks + finish.kt)));
            return colour;
        }
        let refracted = (finish.kt > 0.0).then(|| refract(ray.direction, place)).flatten();
        // Light that is not let through is reflected: under total internal reflection It comes from there.
        let reflection = finish.ks + if refracted.is_none() { finish.kt } else { 0.0 };
        let mut follow = |kind, coefficient: f64, direction, start, media| {
            scratch.branches.add(QueuedRay {
                kind,
                weight: branch.weight * coefficient,
                level: branch.level + 1,
                number: 0,
                from: Some(branch.number),
                ray: ray.onward(place.t, direction),
                start: Some(start),
                media,
            });
        };
        if reflection > 0.0 {
            follow(RayKind::Reflected, reflection, reflect(ray.direction, place.normal), place.turned(), place.media);
        }
        if let Some(direction) = refracted {
            let media = scratch.media.beyond(place.media, place.medium(), place.enters);
            follow(RayKind::Refracted, finish.kt, direction, place.start, media);
        }
        colour
    }

    #[inline(always)]
    fn place(
        &self,
        ray: &Ray,
        root: RootId,
        hit: &Hit,
        turned: bool,
        media: Media,
        around: Option<Medium>,
    ) -> ShadingPoint<'_> {
        let outward = self.world.tree.leaf(hit.surface).normal(hit.surface.face, ray.at(hit.t));
        let normal = if outward.dot(ray.direction) > 0.0 { -outward } else { outward };
        ShadingPoint {
            start: RayStart { root, surface: hit.surface, leaves: rank(root, hit.enters, turned).0, turned },
            enters: hit.enters,
            t: hit.t,
            normal,
            finish: self.world.finish(hit.surface),
            media,
            around,
        }
    }

    /// The diffuse and the specular term of one light.
    #[inline(always)]
    fn light(
        &self,
        index: usize,
        ray: &Ray,
        place: &ShadingPoint<'_>,
        branch: &QueuedRay,
        scratch: &mut Scratch,
        watch: &mut impl Observer,
    ) -> DVec3 {
        let point = ray.at(place.t);
        let (direction, distance, intensity) = match self.world.lights[index] {
            Light::Point { position, colour } => {
                let way = position - point;
                let distance = way.length();
                // A lamp may lie in a face, which then does not stand in its light.
                (way / distance, distance - ray.tolerance(distance), colour)
            }
            Light::Directional { direction, colour } => (-direction, f64::INFINITY, colour),
        };
        let cosine = place.normal.dot(direction);
        // NaN if the light is at the very point.
        if cosine <= 0.0 || cosine.is_nan() {
            return DVec3::ZERO;
        }
        scratch.rays.count(RayKind::Shadow);
        let Scratch { memory, media, .. } = scratch;
        let onward = ray.onward(place.t, direction);
        watch.see(|| Path {
            kind: RayKind::Shadow,
            level: branch.level,
            from: Some(branch.number),
            weight: branch.weight,
            ray: onward,
            start: Some(place.turned()),
            to: self.world.light_ends(&onward, place.turned(), distance, memory),
        });
        let arriving = self.world.light_arriving(&onward, place.turned(), media.get(place.media), distance, memory);
        if arriving == 0.0 {
            watch.note(|| {
                Note::LightTerm(LightTerm {
                    light: index,
                    arriving,
                    coming: DVec3::ZERO,
                    diffuse: DVec3::ZERO,
                    specular: 0.0,
                })
            });
            return DVec3::ZERO;
        }
        let diffuse = place.finish.diffuse * cosine;
        let mut specular = 0.0;
        if place.finish.ks > 0.0 {
            let towards_eye = -ray.direction.dot(reflect(-direction, place.normal));
            if towards_eye > 0.0 {
                specular = place.finish.ks * place.finish.exponent.raise(towards_eye);
            }
        }
        let coming = intensity * arriving;
        watch.note(|| Note::LightTerm(LightTerm { light: index, arriving, coming, diffuse, specular }));
        coming * (diffuse + specular)
    }
}

/// Whether what is around the solid `root` fills it too.
fn is_hidden(root: RootId, around: Option<Medium>) -> bool {
    around.is_some_and(|medium| medium.root < root)
}

fn path(branch: &QueuedRay, to: f64) -> Path {
    Path {
        kind: branch.kind,
        level: branch.level,
        from: branch.from,
        weight: branch.weight,
        ray: branch.ray,
        start: branch.start,
        to,
    }
}

/// Of length 1 again: in a mirror ball, what is missing or too much would grow 18 times with each reflection.
fn reflect(direction: DVec3, normal: DVec3) -> DVec3 {
    (direction - normal * (2.0 * direction.dot(normal))).normalize()
}

/// Snell's law, between the place's solid and what is around it; nothing under total internal reflection.
fn refract(direction: DVec3, place: &ShadingPoint<'_>) -> Option<DVec3> {
    let (inside, outside) = (place.finish.ior, place.around.map_or(1.0, |medium| medium.ior));
    let ratio = if place.enters { outside / inside } else { inside / outside };
    let cosine = -direction.dot(place.normal);
    let squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    (squared >= 0.0).then(|| (direction * ratio + place.normal * (ratio * cosine - squared.sqrt())).normalize())
}
