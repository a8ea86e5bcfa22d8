//! The traced rays of a picture, instead of its colours.

use std::ops::Range;

use super::observer::Path;
use super::{Scratch, Tracer};

impl Tracer {
    /// Traces `pixels` (positions in scan order) and visits each ray: the ray itself, then its shadow rays, then the
    /// waiting ray with the greatest weight.
    pub fn paths(&self, pixels: Range<u32>, scratch: &mut Scratch, mut each: impl FnMut(Path)) {
        for pixel in pixels {
            self.pixel(pixel, scratch, &mut each);
        }
    }

    /// Does the same for each `every`-th pixel in scan order; `every` must not be 0.
    pub fn paths_of_some(&self, every: u32, mut each: impl FnMut(Path)) {
        let mut scratch = Scratch::default();
        for pixel in (0..self.size.pixels()).step_by(every as usize) {
            self.pixel(pixel, &mut scratch, &mut each);
        }
    }
}
