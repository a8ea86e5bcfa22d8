//! Time until a preview of a scene is ready.

use cpu_time::ThreadTime;

use crate::cancel::CancelToken;
use crate::driver::TimedPicture;
use crate::tracer::Tracer;

/// CPU times on this thread until a scene can be seen, in seconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct PreviewTimes {
    /// Until the scene is compiled.
    pub compiled: f64,
    /// Until the coarsest preview is ready.
    pub first: f64,
    /// Until the picture that began with that preview is ready.
    pub exact: f64,
    /// Until the picture is ready without a preview.
    pub plain: f64,
    /// Whether both pictures are identical.
    pub same: bool,
}

impl PreviewTimes {
    pub fn new(compile: impl Fn() -> Tracer) -> Self {
        let begun = ThreadTime::now();
        let mut tracer = compile();
        let compiled = begun.elapsed().as_secs_f64();
        tracer.refine(1);
        let first = begun.elapsed().as_secs_f64();
        let (with, without) = (trace_timed(&tracer), trace_timed(&compile()));
        let [exact, plain] = [first + with.cpu.as_secs_f64(), compiled + without.cpu.as_secs_f64()];
        Self { compiled, first, exact, plain, same: with.frame.pixels() == without.frame.pixels() }
    }
}

/// Traces a picture on this thread and measures its CPU time.
pub(super) fn trace_timed(tracer: &Tracer) -> TimedPicture {
    // Nothing cancels it.
    TimedPicture::of(tracer, &CancelToken::default()).expect("a whole picture")
}
