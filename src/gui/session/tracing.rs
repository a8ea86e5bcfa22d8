//! Progress of a job that traces pictures for runs in virtual time.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use super::Session;
use crate::cancel::{CancelOnDrop, CancelToken};

/// The window's end of a job that traces pictures: dropping it cancels the job.
pub struct TracingProgress {
    traced: Arc<AtomicU32>,
    cancel: CancelOnDrop,
    pixels: u32,
    /// egui's clock at the start, in seconds.
    started: f64,
}

/// The job's end.
pub(super) struct TracingJob {
    traced: Arc<AtomicU32>,
    /// Whether the job is to end early.
    pub cancel: CancelToken,
}

/// Share of the pictures that is traced, 0 to 1, and the seconds since the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TracedShare {
    /// 0 before the first pixel is traced.
    pub share: f64,
    /// Seconds since the start.
    pub elapsed_s: f64,
}

impl TracingProgress {
    /// Creates the progress of pictures with this many pixels.
    pub(super) fn new(pixels: u32, clock: f64) -> Self {
        Self { traced: Arc::default(), cancel: CancelOnDrop::default(), pixels: pixels.max(1), started: clock }
    }

    /// Tells the job to end, whose result is still wanted.
    pub(super) fn cancel(&self) {
        self.cancel.token().cancel();
    }

    /// Returns the job's end.
    pub(super) fn job(&self) -> TracingJob {
        TracingJob { traced: Arc::clone(&self.traced), cancel: self.cancel.token() }
    }
}

impl TracingJob {
    /// Adds pixels that are traced.
    pub fn add(&self, pixels: u32) {
        self.traced.fetch_add(pixels, Ordering::Relaxed);
    }
}

impl Session {
    /// Returns how far a job has come.
    pub fn traced_share(&self, progress: &TracingProgress) -> TracedShare {
        let traced = progress.traced.load(Ordering::Relaxed);
        TracedShare { share: f64::from(traced) / f64::from(progress.pixels), elapsed_s: self.clock - progress.started }
    }
}
