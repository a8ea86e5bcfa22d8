//! A picture traced on this thread, and the CPU time that it took.

use std::time::Duration;

use cpu_time::ThreadTime;

use crate::picture::Colour;
use crate::tracer::{Scratch, Tracer};

/// A traced picture.
pub(super) struct Traced {
    /// In scan order.
    pub pixels: Vec<Colour>,
    /// Of this thread.
    pub cpu: Duration,
}

impl Traced {
    pub fn new(tracer: &Tracer) -> Self {
        let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
        let begun = ThreadTime::now();
        tracer.trace(0..tracer.size().pixels(), &mut scratch, &mut pixels);
        Self { cpu: begun.elapsed(), pixels }
    }
}
