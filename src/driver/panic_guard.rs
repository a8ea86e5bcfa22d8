//! A tracer that may panic: the adaptive ring catches the panic and continues.

use std::mem;
use std::ops::Range;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;

use super::TracePixels;
use crate::picture::Colour;
use crate::tracer::{RayCounts, Scratch};

/// A tracer with its scratch.
pub(super) struct GuardedTracer {
    trace: Arc<TracePixels>,
    scratch: Scratch,
    /// Whether to catch a panic; else it ends the thread.
    catches: bool,
}

impl GuardedTracer {
    /// Creates a guard around `trace`.
    pub fn new(trace: Arc<TracePixels>, catches: bool) -> Self {
        Self { trace, scratch: Scratch::default(), catches }
    }

    /// Appends the colours of `pixels` to `out`. Returns false if the tracer has panicked; `out` is then unchanged.
    pub fn trace(&mut self, pixels: Range<u32>, out: &mut Vec<Colour>) -> bool {
        let before = out.len();
        let trace = || (self.trace)(pixels, &mut self.scratch, out);
        if !self.catches {
            trace();
        } else if panic::catch_unwind(AssertUnwindSafe(trace)).is_err() {
            out.truncate(before);
            // The rest of the scratch may be in an inconsistent state.
            self.scratch.rays = mem::take(&mut self.scratch).rays;
            return false;
        }
        true
    }

    /// Returns the number of rays traced, by kind.
    pub fn rays(&self) -> RayCounts {
        self.scratch.rays
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panic_leaves_the_output_and_counts_the_rays() {
        let trace = |pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>| {
            for pixel in pixels {
                scratch.rays.primary += 1;
                assert!(pixel != 13, "pixel 13 panics");
                out.push([pixel as f32; 3]);
            }
        };
        let (mut tracer, mut out) = (GuardedTracer::new(Arc::new(trace), true), Vec::new());
        assert!(tracer.trace(8..10, &mut out) && !tracer.trace(10..16, &mut out) && tracer.trace(20..21, &mut out));
        assert_eq!(out, [[8.0; 3], [9.0; 3], [20.0; 3]]);
        assert_eq!(tracer.rays().primary, 7);
    }
}
