//! How soon there is something to see of a scene.

use cpu_time::ThreadTime;

use crate::tracer::{Scratch, Tracer};

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
        let picture = |tracer: &Tracer| {
            let mut pixels = Vec::new();
            tracer.trace(0..tracer.size().pixels(), &mut Scratch::default(), &mut pixels);
            pixels
        };
        let with = picture(&tracer);
        let exact = begun.elapsed().as_secs_f64();
        let begun = ThreadTime::now();
        let without = picture(&compile());
        Self { compiled, first, exact, plain: begun.elapsed().as_secs_f64(), same: with == without }
    }
}
