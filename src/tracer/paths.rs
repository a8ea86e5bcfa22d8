//! The traced rays of a picture, instead of its colours.

use std::ops::Range;

use super::observer::{Observer, Path};
use super::{Scratch, Tracer};

/// Numbers of rays.
#[derive(Clone, Copy, Debug, Default)]
pub struct LostRays {
    /// All rays, of all kinds.
    pub rays: u64,
    /// Those that are not where their history has them.
    pub lost: u64,
}

impl Observer for LostRays {
    fn ray_traced(&mut self, _: impl FnOnce() -> Path) {}

    fn ray_starts(&mut self, is_lost: impl FnOnce() -> bool) {
        self.rays += 1;
        self.lost += u64::from(is_lost());
    }
}

impl Tracer {
    /// Traces `pixels` (positions in scan order) and visits each ray: the ray itself, then its shadow rays, then the
    /// waiting ray with the greatest weight.
    pub fn paths(&self, pixels: Range<u32>, scratch: &mut Scratch, mut each: impl FnMut(Path)) {
        for pixel in pixels {
            self.pixel(pixel, scratch, &mut each);
        }
    }

    /// Traces the picture, and counts its rays and those that are lost: rays whose history of boundaries does not
    /// close, so that they are in a solid that they have not entered, or not in one that they have not left.
    pub fn count_lost(&self) -> LostRays {
        let (mut scratch, mut count) = (Scratch::default(), LostRays::default());
        (0..self.size.pixels()).for_each(|pixel| _ = self.pixel(pixel, &mut scratch, &mut count));
        count
    }

    /// Does the same as [`Tracer::paths`] for each `every`-th pixel in scan order; `every` must not be 0.
    pub fn paths_of_some(&self, every: u32, mut each: impl FnMut(Path)) {
        let mut scratch = Scratch::default();
        for pixel in (0..self.size.pixels()).step_by(every as usize) {
            self.pixel(pixel, &mut scratch, &mut each);
        }
    }
}
