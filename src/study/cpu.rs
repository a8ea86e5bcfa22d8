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

/// How long looking at a scene takes, in seconds of CPU time on this thread.
#[derive(Clone, Copy, Debug)]
pub(super) struct Looks {
    /// Until it is compiled.
    pub compiled: f64,
    /// Until its coarsest preview is there.
    pub first: f64,
    /// Until the picture is there, which began with that preview.
    pub exact: f64,
    /// Until the picture is there without a preview.
    pub plain: f64,
    /// Whether both pictures are the same.
    pub same: bool,
}

impl Looks {
    pub fn new(compile: impl Fn() -> Tracer) -> Self {
        let begun = ThreadTime::now();
        let mut tracer = compile();
        let compiled = begun.elapsed().as_secs_f64();
        tracer.refine();
        let first = begun.elapsed().as_secs_f64();
        let with = Traced::new(&tracer);
        let exact = begun.elapsed().as_secs_f64();
        let begun = ThreadTime::now();
        let without = Traced::new(&compile());
        Self { compiled, first, exact, plain: begun.elapsed().as_secs_f64(), same: with.pixels == without.pixels }
    }
}

impl Traced {
    pub fn new(tracer: &Tracer) -> Self {
        let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
        let begun = ThreadTime::now();
        tracer.trace(0..tracer.size().pixels(), &mut scratch, &mut pixels);
        Self { cpu: begun.elapsed(), pixels }
    }
}
