//! Hands over the paths of a picture's rays instead of its colours.

use std::ops::Range;

use super::observer::Path;
use super::{Scratch, Tracer};

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
