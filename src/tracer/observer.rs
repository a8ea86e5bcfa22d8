//! Observation of single rays, to explain pixels and to count rays.

use glam::DVec3;

use crate::csg::{MaterialTag, RayStart};
use crate::geometry::Ray;

/// A traced ray, from its start to its end.
#[derive(Clone, Copy, Debug)]
pub struct Path {
    /// The kind of ray.
    pub kind: RayKind,
    /// The ray's level in the tree of rays: 1 for a primary ray, one more for each reflection or refraction. A shadow
    /// ray has the level of its parent.
    pub level: u32,
    /// The number of the parent, the ray at whose end this one starts; none for a primary ray. A sample's rays except
    /// shadow rays are numbered in the order of tracing, from 0.
    pub from: Option<u64>,
    /// The greatest part of `factor`: how much the ray can matter.
    pub weight: f64,
    /// The factor of the ray's colour in the sample's colour, for red, green and blue; for a shadow ray, its parent's.
    pub factor: DVec3,
    /// The ray's origin and direction.
    pub ray: Ray,
    /// The surface that it starts on; none for a primary ray.
    pub start: Option<RayStart>,
    /// The distance at which it ends: at its hit, or for a shadow ray at its light or the nearest surface that does not
    /// transmit. Infinite if the ray has no end.
    pub to: f64,
}

/// The reason why a ray is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the camera.
    Primary,
    /// Towards a light.
    Shadow,
    /// From a reflecting surface.
    Reflected,
    /// Through a transmitting surface.
    Refracted,
}

/// A ray's hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// The face that was hit, as the start of secondary rays.
    pub start: RayStart,
    /// The tag of the surface: its material.
    pub tag: MaterialTag,
    /// Whether the ray enters the solid; otherwise it leaves it.
    pub enters: bool,
    /// The unit normal on the side of the incoming ray.
    pub normal: DVec3,
}

/// The terms of the equation that a light adds at a ray's end.
#[derive(Clone, Debug)]
pub struct LightTerm {
    /// The light's index in the scene.
    pub light: usize,
    /// The part of its intensity that arrives, 0 to 1, for red, green and blue.
    pub arriving: DVec3,
    /// Il, the intensity that arrives.
    pub coming: DVec3,
    /// Kd (N·L) times the surface's colour.
    pub diffuse: DVec3,
    /// Ks (S·R)ⁿ.
    pub specular: f64,
}

/// An event of tracing.
pub(super) enum Note {
    Background(DVec3),
    Intersection {
        met: Intersection,
        ambient: DVec3,
        inside: usize,
    },
    LightTerm(LightTerm),
    TooDeep(f64),
    /// The total weight and the number of the rays that the sample left out.
    LeftOut(f64, u64),
    /// Whether the pixel's mean includes the samples at the corners, which are the first four.
    CornersCount(bool),
}

impl LightTerm {
    /// The term Kd Il (N·L).
    pub fn diffuse(&self) -> DVec3 {
        self.coming * self.diffuse
    }

    /// The term Ks Il (S·R)ⁿ.
    pub fn specular(&self) -> DVec3 {
        self.coming * self.specular
    }
}

/// Observer of traced rays. A type parameter, so that [`NoObserver`] costs nothing.
pub(super) trait Observer {
    /// Is told of a traced ray. `path` may be costly to compute.
    fn ray_traced(&mut self, path: impl FnOnce() -> Path);

    /// Is told of a ray that will be traced now. `is_lost` says whether the ray is not where its history of boundaries
    /// has it; it is costly.
    fn ray_starts(&mut self, _is_lost: impl FnOnce() -> bool) {}

    /// Is told of the ray that was traced last, shadow rays not counted.
    fn note(&mut self, _: impl FnOnce() -> Note) {}
}

/// Observes nothing, so that no path is ever computed.
pub(super) struct NoObserver;

impl Observer for NoObserver {
    #[inline(always)]
    fn ray_traced(&mut self, _: impl FnOnce() -> Path) {}
}

/// Notes whether a sample's primary ray hits a solid.
#[derive(Default)]
pub(super) struct PrimaryHit(Option<bool>);

impl PrimaryHit {
    /// Whether it hits one.
    pub fn is_hit(&self) -> bool {
        self.0 == Some(true)
    }
}

impl Observer for PrimaryHit {
    #[inline(always)]
    fn ray_traced(&mut self, _: impl FnOnce() -> Path) {}

    #[inline(always)]
    fn note(&mut self, note: impl FnOnce() -> Note) {
        // The first note of a sample is about its primary ray.
        self.0.get_or_insert_with(|| !matches!(note(), Note::Background(_)));
    }
}

impl<F: FnMut(Path)> Observer for F {
    fn ray_traced(&mut self, path: impl FnOnce() -> Path) {
        self(path());
    }
}
