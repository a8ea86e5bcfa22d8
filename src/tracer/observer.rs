//! The ways of single rays, for those who study them.

use glam::DVec3;

use crate::csg::{MaterialTag, RayStart};
use crate::geometry::Ray;

/// A ray's way, from where it starts to where it ends.
#[derive(Clone, Copy, Debug)]
pub struct Path {
    /// Why the ray was sent.
    pub kind: RayKind,
    /// Its place in the tree of rays: 1 for a primary ray, one more for each reflection and refraction. A shadow ray
    /// has the level of the ray at whose end it starts.
    pub level: u32,
    /// The ray at whose end it starts, by its number among the sample's: the primary ray has 0, and the others are
    /// numbered as they are traced, but for shadow rays. None for a primary ray.
    pub from: Option<u64>,
    /// What the sample keeps of its colour; of a shadow ray's, what it keeps of that of the ray at whose end it starts.
    pub weight: f64,
    /// Where it starts and where it goes.
    pub ray: Ray,
    /// The face that it starts on; a primary ray starts on none.
    pub start: Option<RayStart>,
    /// The distance at which it ends: at what it hits; a shadow ray at its light, or at the nearest surface that lets
    /// no light through. Infinite if it ends nowhere.
    pub to: f64,
}

/// Why a ray is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the camera.
    Primary,
    /// Towards a light.
    Shadow,
    /// From a surface that reflects.
    Reflected,
    /// Through a surface that transmits.
    Refracted,
}

/// What a ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// The solid and its face, and where a ray starts that goes on from there.
    pub start: RayStart,
    /// The primitive's number for its surface (which material it has).
    pub tag: MaterialTag,
    /// The solid is entered; else left.
    pub enters: bool,
    /// Of length 1, on the side that the ray came from.
    pub normal: DVec3,
}

/// What a light adds where a ray ends.
#[derive(Clone, Debug)]
pub struct LightTerm {
    /// The light's place in the scene's list.
    pub light: usize,
    /// What part of its intensity arrives.
    pub arriving: f64,
    /// The light that arrives: Il.
    pub coming: DVec3,
    /// Kd (N·L), by the surface's colour.
    pub diffuse: DVec3,
    /// Ks (S·R)ⁿ
    pub specular: f64,
}

/// What is known of a ray.
pub(super) enum Note {
    Background(DVec3),
    Intersection {
        met: Intersection,
        ambient: DVec3,
        inside: usize,
    },
    LightTerm(LightTerm),
    TooDeep(f64),
    /// What was left out of the whole sample, and how many rays these were.
    LeftOut(f64, u64),
    /// Of all samples: whether the pixel is the mean of all of them, or of all but the first four.
    CornersCount(bool),
}

impl LightTerm {
    /// Kd Il (N·L)
    pub fn diffuse(&self) -> DVec3 {
        self.coming * self.diffuse
    }

    /// Ks Il (S·R)ⁿ
    pub fn specular(&self) -> DVec3 {
        self.coming * self.specular
    }
}

/// Whoever looks on while rays are traced. It is compiled in, so that nobody costs nothing.
pub(super) trait Observer {
    /// A ray was traced; `path` tells its way, which may take work.
    fn ray_traced(&mut self, path: impl FnOnce() -> Path);

    /// Something is known of the ray whose path was seen last, but for shadow rays.
    fn note(&mut self, _: impl FnOnce() -> Note) {}
}

/// Does not look, so that no path is ever worked out.
pub(super) struct NoObserver;

impl Observer for NoObserver {
    #[inline(always)]
    fn ray_traced(&mut self, _: impl FnOnce() -> Path) {}
}

impl<F: FnMut(Path)> Observer for F {
    fn ray_traced(&mut self, path: impl FnOnce() -> Path) {
        self(path());
    }
}
