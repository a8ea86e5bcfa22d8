//! The article's equation (§3; Whitted 1980): the colour that a ray brings.
//!
//! Cp = Ka Ia + Kd Σ Ilj (N·Lj) + Ks Σ Ilj (S·Rj)ⁿ + Ks Is + Kt It

use glam::DVec3;

use super::compiled_scene::Shading;
use super::intersect::{HitScratch, is_reversed_at};
use super::media::{Media, MediaSets, Medium};
use super::observer::{Intersection, LightTerm, Note, Observer, Path, RayKind};
use super::ray_queue::{QueuedRay, RayQueue};
use super::{RayCounts, Tracer};
use crate::csg::{Hit, RayStart, RootId, tie_break};
use crate::geometry::Ray;
use crate::scene::Light;

/// What a thread needs to trace, kept from pixel to pixel so that nothing is allocated; it counts the rays.
#[derive(Debug, Default)]
pub struct Scratch {
    /// Rays traced with this scratch so far.
    pub rays: RayCounts,
    hits: HitScratch,
    media: MediaSets,
    queue: RayQueue,
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
    surrounding: Option<Medium>,
}

impl ShadingPoint<'_> {
    /// The solid as a medium.
    fn medium(&self) -> Medium {
        Medium { root: self.start.root, ior: self.finish.ior }
    }

    /// For rays that stay on the side from which the place was met: to a light, or reflected.
    fn reversed(&self) -> RayStart {
        RayStart { reversed: !self.start.reversed, ..self.start }
    }
}

impl Tracer {
    /// The colour that a primary ray brings, in linear light.
    pub(super) fn sample(&self, ray: &Ray, scratch: &mut Scratch, observer: &mut impl Observer) -> DVec3 {
        scratch.rays.count(RayKind::Primary);
        let media = scratch.media.restart(&self.scene.eye_media);
        scratch.queue.restart();
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
        let mut colour = self.colour(&primary, scratch, observer);
        while let Some(queued) = scratch.queue.next(self.quality.cutoff) {
            scratch.rays.count(queued.kind);
            colour += self.colour(&queued, scratch, observer) * queued.weight;
        }
        observer.note(|| Note::LeftOut(scratch.queue.remaining_weight(), scratch.queue.remaining_rays()));
        colour
    }

    /// The colour that a ray brings, but for what comes by rays that start at its end: these now wait.
    #[inline(always)]
    fn colour(&self, queued: &QueuedRay, scratch: &mut Scratch, observer: &mut impl Observer) -> DVec3 {
        let QueuedRay { ray, start, media, .. } = queued;
        let nearest = self.scene.nearest(ray, *start, &mut scratch.hits);
        let surrounding = self.surrounding(nearest, *media, scratch);
        if let Some((root, hit)) = nearest.filter(|(root, _)| is_hidden(*root, surrounding)) {
            let reversed = is_reversed_at(*start, ray, hit.t);
            let place = self.place(ray, root, &hit, reversed, *media, surrounding);
            return self.colour_behind(queued, place, scratch, observer);
        }
        observer.ray_traced(|| path(queued, nearest.map_or(f64::INFINITY, |(_, hit)| hit.t)));
        let Some((root, hit)) = nearest else {
            observer.note(|| Note::Background(self.scene.background));
            return self.scene.background;
        };
        let place = self.place(ray, root, &hit, is_reversed_at(*start, ray, hit.t), *media, surrounding);
        self.shade(ray, &place, queued, scratch, observer)
    }

    /// The colour of a ray that meets a boundary that is not there, since another medium fills the place: of what it meets
    /// further on.
    #[cold]
    fn colour_behind<'a>(
        &'a self,
        queued: &QueuedRay,
        mut place: ShadingPoint<'a>,
        scratch: &mut Scratch,
        observer: &mut impl Observer,
    ) -> DVec3 {
        let (mut ray, mut passed) = (queued.ray, 0.0);
        loop {
            let media = scratch.media.after_crossing(place.media, place.medium(), place.enters);
            ray = ray.onward(place.t, ray.direction);
            passed += place.t;
            let start = Some(place.start);
            let nearest = self.scene.nearest(&ray, start, &mut scratch.hits);
            let surrounding = self.surrounding(nearest, media, scratch);
            if let Some((root, hit)) = nearest {
                place = self.place(&ray, root, &hit, is_reversed_at(start, &ray, hit.t), media, surrounding);
                if is_hidden(root, surrounding) {
                    continue;
                }
            }
            observer.ray_traced(|| path(queued, passed + nearest.map_or(f64::INFINITY, |(_, hit)| hit.t)));
            return match nearest {
                Some(_) => self.shade(&ray, &place, queued, scratch, observer),
                None => {
                    observer.note(|| Note::Background(self.scene.background));
                    self.scene.background
                }
            };
        }
    }

    /// What is around the solid that is met, if that transmits and it is not air.
    #[inline(always)]
    fn surrounding(&self, nearest: Option<(RootId, Hit)>, media: Media, scratch: &Scratch) -> Option<Medium> {
        let (root, _) = nearest.filter(|(_, hit)| self.scene.shading(hit.surface).kt > 0.0)?;
        scratch.media.surrounding(media, root)
    }

    #[inline(always)]
    fn shade(
        &self,
        ray: &Ray,
        place: &ShadingPoint<'_>,
        queued: &QueuedRay,
        scratch: &mut Scratch,
        observer: &mut impl Observer,
    ) -> DVec3 {
        let finish = place.finish;
        let mut colour = finish.ambient;
        observer.note(|| {
            let ShadingPoint { start, enters, normal, media, .. } = *place;
            let met = Intersection { start, tag: self.scene.tree.leaf(start.surface).tag, enters, normal };
            Note::Intersection { met, ambient: colour, inside: scratch.media.get(media).len() }
        });
        for index in 0..self.scene.lights.len() {
            colour += self.light(index, ray, place, queued, scratch, observer);
        }
        if finish.ks == 0.0 && finish.kt == 0.0 {
            return colour;
        }
        if queued.level == self.quality.max_depth {
            observer.note(|| Note::TooDeep(queued.weight * (finish.ks + finish.kt)));
            return colour;
        }
        let refracted = (finish.kt > 0.0).then(|| refract(ray.direction, place)).flatten();
        // Light that is not let through is reflected: under total internal reflection It comes from there.
        let reflection = finish.ks + if refracted.is_none() { finish.kt } else { 0.0 };
        let mut follow = |kind, coefficient: f64, direction, start, media| {
            scratch.queue.add(QueuedRay {
                kind,
                weight: queued.weight * coefficient,
                level: queued.level + 1,
                number: 0,
                from: Some(queued.number),
                ray: ray.onward(place.t, direction),
                start: Some(start),
                media,
            });
        };
        if reflection > 0.0 {
            follow(RayKind::Reflected, reflection, reflect(ray.direction, place.normal), place.reversed(), place.media);
        }
        if let Some(direction) = refracted {
            let media = scratch.media.after_crossing(place.media, place.medium(), place.enters);
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
        reversed: bool,
        media: Media,
        surrounding: Option<Medium>,
    ) -> ShadingPoint<'_> {
        let outward = self.scene.tree.leaf(hit.surface).normal(hit.surface.face, ray.at(hit.t));
        let normal = if outward.dot(ray.direction) > 0.0 { -outward } else { outward };
        ShadingPoint {
            start: RayStart { root, surface: hit.surface, exits: tie_break(root, hit.enters, reversed).0, reversed },
            enters: hit.enters,
            t: hit.t,
            normal,
            finish: self.scene.shading(hit.surface),
            media,
            surrounding,
        }
    }

    /// The diffuse and the specular term of one light.
    #[inline(always)]
    fn light(
        &self,
        index: usize,
        ray: &Ray,
        place: &ShadingPoint<'_>,
        queued: &QueuedRay,
        scratch: &mut Scratch,
        observer: &mut impl Observer,
    ) -> DVec3 {
        let point = ray.at(place.t);
        let (direction, distance, intensity) = match self.scene.lights[index] {
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
        let Scratch { hits, media, .. } = scratch;
        let onward = ray.onward(place.t, direction);
        observer.ray_traced(|| Path {
            kind: RayKind::Shadow,
            level: queued.level,
            from: Some(queued.number),
            weight: queued.weight,
            ray: onward,
            start: Some(place.reversed()),
            to: self.scene.shadow_ray_end(&onward, place.reversed(), distance, hits),
        });
        let arriving =
            self.scene.light_transmittance(&onward, place.reversed(), media.get(place.media), distance, hits);
        if arriving == 0.0 {
            observer.note(|| {
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
        observer.note(|| Note::LightTerm(LightTerm { light: index, arriving, coming, diffuse, specular }));
        coming * (diffuse + specular)
    }
}

/// Whether what is around the solid `root` fills it too.
fn is_hidden(root: RootId, surrounding: Option<Medium>) -> bool {
    surrounding.is_some_and(|medium| medium.root < root)
}

fn path(queued: &QueuedRay, to: f64) -> Path {
    Path {
        kind: queued.kind,
        level: queued.level,
        from: queued.from,
        weight: queued.weight,
        ray: queued.ray,
        start: queued.start,
        to,
    }
}

/// Of length 1 again: in a mirror ball, what is missing or too much would grow 18 times with each reflection.
fn reflect(direction: DVec3, normal: DVec3) -> DVec3 {
    (direction - normal * (2.0 * direction.dot(normal))).normalize()
}

/// Snell's law, between the place's solid and what is around it; nothing under total internal reflection.
fn refract(direction: DVec3, place: &ShadingPoint<'_>) -> Option<DVec3> {
    let (inside, outside) = (place.finish.ior, place.surrounding.map_or(1.0, |medium| medium.ior));
    let ratio = if place.enters { outside / inside } else { inside / outside };
    let cosine = -direction.dot(place.normal);
    let squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    (squared >= 0.0).then(|| (direction * ratio + place.normal * (ratio * cosine - squared.sqrt())).normalize())
}
