//! How soon there is something to see of a scene.

use cpu_time::ThreadTime;

use crate::cancel::CancelToken;
use crate::driver::TimedPicture;
use crate::tracer::Tracer;

/// How long looking at a scene takes, in seconds of CPU time on this thread.
#[derive(Clone, Copy, Debug)]
pub(super) struct PreviewTimes {
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

impl PreviewTimes {
    pub fn new(compile: impl Fn() -> Tracer) -> Self {
        let begun = ThreadTime::now();
        let mut tracer = compile();
        let compiled = begun.elapsed().as_secs_f64();
        tracer.refine();
        let first = begun.elapsed().as_secs_f64();
        let (with, without) = (picture(&tracer), picture(&compile()));
        let [exact, plain] = [first + with.cpu.as_secs_f64(), compiled + without.cpu.as_secs_f64()];
        Self { compiled, first, exact, plain, same: with.frame.pixels() == without.frame.pixels() }
    }
}

/// A picture that is traced on this thread, and what that takes.
pub(super) fn picture(tracer: &Tracer) -> TimedPicture {
    // Nobody ends it before.
    TimedPicture::of(tracer, &CancelToken::default()).expect("a whole picture")
}
