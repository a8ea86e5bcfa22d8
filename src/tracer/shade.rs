//! The article's equation (§3; Whitted 1980): the colour of a ray.
//!
//! Cp = Ka Ia + Kd Σ Ilj (N·Lj) + Ks Σ Ilj (S·Rj)ⁿ + Ks Is + Kt It

use glam::DVec3;

use super::compiled_scene::Shading;
use super::intersect::HitScratch;
use super::media::{Media, MediaSets, Medium};
use super::observer::{Intersection, LightTerm, Note, Observer, Path, RayKind};
use super::ray_queue::{QueuedRay, RayQueue};
use super::{RayCounts, Tracer};
use crate::csg::{Hit, RayStart, RootId};
use crate::geometry::{Ray, approach};
use crate::scene::Light;

/// Scratch memory of a thread, kept from pixel to pixel so that nothing is allocated, and the thread's ray counts.
#[derive(Debug, Default)]
pub struct Scratch {
    /// Rays that were traced with this scratch.
    pub rays: RayCounts,
    hits: HitScratch,
    media: MediaSets,
    queue: RayQueue,
}

/// A hit, with the values that the equation needs.
struct ShadingPoint<'a> {
    start: RayStart,
    enters: bool,
    t: f64,
    /// The unit normal on the side of the incoming ray.
    normal: DVec3,
    shading: &'a Shading,
    /// The media that the incoming ray is in.
    media: Media,
    /// The medium around the solid, if the solid transmits; none is air.
    surrounding: Option<Medium>,
}

impl Tracer {
    /// The colour of a sample, given its primary ray, in linear light.
    pub(super) fn sample(&self, ray: &Ray, scratch: &mut Scratch, observer: &mut impl Observer) -> DVec3 {
        let media = scratch.media.restart(&self.scene.eye_media);
        scratch.queue.restart();
        let mut queued = QueuedRay {
            kind: RayKind::Primary,
            weight: DVec3::ONE,
            level: 1,
            number: 0,
            from: None,
            ray: *ray,
            start: None,
            media,
        };
        let mut colour = DVec3::ZERO;
        loop {
            scratch.rays.count(queued.kind);
            colour += self.colour(&queued, scratch, observer) * queued.weight;
            match scratch.queue.next(self.quality.cutoff) {
                Some(next) => queued = next,
                None => break,
            }
        }
        observer.note(|| Note::LeftOut(scratch.queue.remaining_weight(), scratch.queue.remaining_rays()));
        colour
    }

    /// The colour of a ray without that of its secondary rays, which are added to the queue.
    #[inline(always)]
    fn colour(&self, queued: &QueuedRay, scratch: &mut Scratch, observer: &mut impl Observer) -> DVec3 {
        let QueuedRay { ray, start, media, .. } = queued;
        let Scratch { hits, media: sets, .. } = scratch;
        observer.ray_starts(|| self.scene.is_lost(ray, *start, sets.get(*media)));
        let nearest = self.scene.nearest(ray, *start, sets.get(*media), hits);
        let surrounding = self.surrounding(nearest, *media, scratch);
        if let Some((root, hit)) = nearest.filter(|(root, _)| is_hidden(*root, surrounding)) {
            let point = self.shading_point(ray, root, &hit, *media, surrounding);
            return self.colour_behind(queued, point, scratch, observer);
        }
        observer.ray_traced(|| path(queued, nearest.map_or(f64::INFINITY, |(_, hit)| hit.t)));
        let Some((root, hit)) = nearest else {
            observer.note(|| Note::Background(self.scene.background));
            return self.scene.background;
        };
        let point = self.shading_point(ray, root, &hit, *media, surrounding);
        self.shade(ray, &point, queued, scratch, observer)
    }

    /// The colour of a ray whose first boundary does not exist, since another medium fills the space: goes on to the
    /// first boundary that exists.
    #[cold]
    fn colour_behind<'a>(
        &'a self,
        queued: &QueuedRay,
        mut point: ShadingPoint<'a>,
        scratch: &mut Scratch,
        observer: &mut impl Observer,
    ) -> DVec3 {
        let (mut ray, mut passed) = (queued.ray, 0.0);
        loop {
            let media = self.media_behind(&point, scratch);
            ray = ray.onward(point.t, ray.direction);
            passed += point.t;
            let Scratch { hits, media: sets, .. } = scratch;
            observer.ray_starts(|| self.scene.is_lost(&ray, Some(point.start), sets.get(media)));
            let nearest = self.scene.nearest(&ray, Some(point.start), sets.get(media), hits);
            let surrounding = self.surrounding(nearest, media, scratch);
            if let Some((root, hit)) = nearest {
                point = self.shading_point(&ray, root, &hit, media, surrounding);
                if is_hidden(root, surrounding) {
                    continue;
                }
            }
            observer.ray_traced(|| path(queued, passed + nearest.map_or(f64::INFINITY, |(_, hit)| hit.t)));
            return match nearest {
                Some(_) => self.shade(&ray, &point, queued, scratch, observer),
                None => {
                    observer.note(|| Note::Background(self.scene.background));
                    self.scene.background
                }
            };
        }
    }

    /// The media of a ray that goes on behind a surface.
    #[inline(always)]
    fn media_behind(&self, point: &ShadingPoint<'_>, scratch: &mut Scratch) -> Media {
        scratch.media.after_crossing(point.media, self.scene.medium(point.start.root), point.enters)
    }

    /// The medium around the solid that was hit, if the solid transmits; none is air.
    #[inline(always)]
    fn surrounding(&self, nearest: Option<(RootId, Hit)>, media: Media, scratch: &Scratch) -> Option<Medium> {
        let (root, _) = nearest.filter(|(_, hit)| self.scene.shading(hit.surface).transmits)?;
        scratch.media.surrounding(media, root)
    }

    #[inline(always)]
    fn shade(
        &self,
        ray: &Ray,
        point: &ShadingPoint<'_>,
        queued: &QueuedRay,
        scratch: &mut Scratch,
        observer: &mut impl Observer,
    ) -> DVec3 {
        let shading = point.shading;
        let mut colour = shading.ambient;
        observer.note(|| {
            let ShadingPoint { start, enters, normal, media, .. } = *point;
            let met = Intersection { start, tag: self.scene.tree.leaf(start.surface).tag, enters, normal };
            Note::Intersection { met, ambient: colour, inside: scratch.media.get(media).len() }
        });
        for index in 0..self.scene.lights.len() {
            colour += self.light(index, ray, point, queued, scratch, observer);
        }
        if shading.ks == 0.0 && !shading.transmits {
            return colour;
        }
        if queued.level == self.quality.max_depth {
            observer.note(|| Note::TooDeep((queued.weight * (shading.kt + shading.ks)).max_element()));
            return colour;
        }
        let refracted =
            shading.transmits.then(|| refract(ray.direction, point, self.scene.medium(point.start.root).ior)).flatten();
        // Under total internal reflection the transmitted light It comes from the reflected direction.
        let reflection = if refracted.is_none() { shading.kt + shading.ks } else { DVec3::splat(shading.ks) };
        let behind = refracted.map(|direction| (direction, self.media_behind(point, scratch)));
        let mut follow = |kind, coefficient: DVec3, direction, media| {
            scratch.queue.add(QueuedRay {
                kind,
                weight: queued.weight * coefficient,
                level: queued.level + 1,
                number: 0,
                from: Some(queued.number),
                ray: ray.onward(point.t, direction),
                start: Some(point.start),
                media,
            });
        };
        if reflection.max_element() > 0.0 {
            follow(RayKind::Reflected, reflection, reflect(ray.direction, point.normal), point.media);
        }
        if let Some((direction, media)) = behind {
            follow(RayKind::Refracted, shading.kt, direction, media);
        }
        colour
    }

    #[inline(always)]
    fn shading_point(
        &self,
        ray: &Ray,
        root: RootId,
        hit: &Hit,
        media: Media,
        surrounding: Option<Medium>,
    ) -> ShadingPoint<'_> {
        let outward = self.scene.tree.leaf(hit.surface).normal(hit.surface.face, ray.at(hit.t));
        let normal = if outward.dot(ray.direction) > 0.0 { -outward } else { outward };
        ShadingPoint {
            start: RayStart { root, surface: hit.surface },
            enters: hit.enters,
            t: hit.t,
            normal,
            shading: self.scene.shading(hit.surface),
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
        point: &ShadingPoint<'_>,
        queued: &QueuedRay,
        scratch: &mut Scratch,
        observer: &mut impl Observer,
    ) -> DVec3 {
        let at = ray.at(point.t);
        let (direction, distance, intensity) = match self.scene.lights[index] {
            Light::Point { position, colour } => {
                let way = position - at;
                let distance = way.length();
                // A light may lie in a face, which must not shadow it.
                (way / distance, distance - ray.tolerance(distance), colour)
            }
            Light::Directional { direction, colour } => (-direction, f64::INFINITY, colour),
        };
        let cosine = approach(point.normal, direction);
        // NaN if the light lies exactly at the point.
        if cosine <= 0.0 || cosine.is_nan() {
            return DVec3::ZERO;
        }
        scratch.rays.count(RayKind::Shadow);
        let Scratch { hits, media, .. } = scratch;
        let media = media.get(point.media);
        let onward = ray.onward(point.t, direction);
        observer.ray_starts(|| self.scene.is_lost(&onward, Some(point.start), media));
        observer.ray_traced(|| Path {
            kind: RayKind::Shadow,
            level: queued.level,
            from: Some(queued.number),
            weight: queued.weight.max_element(),
            factor: queued.weight,
            ray: onward,
            start: Some(point.start),
            to: self.scene.shadow_ray_end(&onward, point.start, media, distance, hits),
        });
        let arriving = self.scene.light_transmittance(&onward, point.start, media, distance, hits);
        if arriving == DVec3::ZERO {
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
        let diffuse = point.shading.diffuse * cosine;
        let mut specular = 0.0;
        if point.shading.ks > 0.0 {
            let towards_eye = -ray.direction.dot(reflect(-direction, point.normal));
            if towards_eye > 0.0 {
                specular = point.shading.ks * point.shading.exponent.raise(towards_eye);
            }
        }
        let coming = intensity * arriving;
        observer.note(|| Note::LightTerm(LightTerm { light: index, arriving, coming, diffuse, specular }));
        coming * (diffuse + specular)
    }
}

/// Whether a surrounding medium with priority over the solid `root` hides its boundary.
fn is_hidden(root: RootId, surrounding: Option<Medium>) -> bool {
    surrounding.is_some_and(|medium| medium.root < root)
}

fn path(queued: &QueuedRay, to: f64) -> Path {
    Path {
        kind: queued.kind,
        level: queued.level,
        from: queued.from,
        weight: queued.weight.max_element(),
        factor: queued.weight,
        ray: queued.ray,
        start: queued.start,
        to,
    }
}

/// Normalised again: in a mirror ball an error of length would grow 18 times with each reflection.
fn reflect(direction: DVec3, normal: DVec3) -> DVec3 {
    (direction - normal * (2.0 * direction.dot(normal))).normalize()
}

/// Snell's law at the boundary between the solid and its surrounding; nothing under total internal reflection.
fn refract(direction: DVec3, point: &ShadingPoint<'_>, ior: f64) -> Option<DVec3> {
    let (inside, outside) = (ior, point.surrounding.map_or(1.0, |medium| medium.ior));
    let ratio = if point.enters { outside / inside } else { inside / outside };
    let cosine = -direction.dot(point.normal);
    let squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    (squared >= 0.0).then(|| (direction * ratio + point.normal * (ratio * cosine - squared.sqrt())).normalize())
}
