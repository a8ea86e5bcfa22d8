//! The ways of single rays, for those who study them.

use std::ops::Range;

use super::explain::Note;
use super::{Scratch, Tracer};
use crate::csg::Start;
use crate::geometry::Ray;
use crate::picture::Size;

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
    pub start: Option<Start>,
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

impl Tracer {
    /// Traces `pixels` (positions in scan order) and hands over each ray's path instead of colours: a ray's own, then those
    /// of the shadow rays that start at its end; then those of the ray that counts most among those still to be traced.
    pub fn paths(&self, pixels: Range<u32>, scratch: &mut Scratch, mut each: impl FnMut(Path)) {
        for pixel in pixels {
            self.pixel(pixel, scratch, &mut each);
        }
    }

    /// As [`Tracer::paths`], of each `every`-th pixel in scan order; not 0.
    pub fn paths_of_some(&self, every: u32, mut each: impl FnMut(Path)) {
        let mut scratch = Scratch::default();
        for pixel in (0..self.size.pixels()).step_by(every as usize) {
            self.pixel(pixel, &mut scratch, &mut each);
        }
    }
}

/// A step in scan order at which about so many pixels of a picture are looked at.
///
/// An odd one seldom divides a width, so that the pixels are in many columns.
pub fn step_for(size: Size, looked_at: u32) -> u32 {
    (size.pixels() / looked_at) | 1
}

/// Whoever looks on while rays are traced. It is compiled in, so that nobody costs nothing.
pub(super) trait Watch {
    /// A ray was traced; `path` tells its way, which may take work.
    fn see(&mut self, path: impl FnOnce() -> Path);

    /// Something is known of the ray whose path was seen last, but for shadow rays.
    fn note(&mut self, _: impl FnOnce() -> Note) {}
}

/// Does not look, so that no path is ever worked out.
pub(super) struct Nobody;

impl Watch for Nobody {
    #[inline(always)]
    fn see(&mut self, _: impl FnOnce() -> Path) {}
}

impl<F: FnMut(Path)> Watch for F {
    fn see(&mut self, path: impl FnOnce() -> Path) {
        self(path());
    }
}
