//! Traces the picture of a recorded run again.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use crossbeam_channel::{Receiver, Sender};

use super::error::RunError;
use super::retrace_plan::plan;
use super::supervisor::{Supervisor, Threads};
use super::worker::trace_pieces;
use super::{TracePixels, Update};
use crate::cancel::CancelToken;
use crate::parallel::cores;
use crate::picture::Colour;
use crate::runlog::RunLog;
use crate::tracer::{Scratch, Tracer};

/// Threads that trace a recorded picture again. Dropping it stops them and waits for them.
pub struct Retrace {
    cancel: CancelToken,
    supervisor: Supervisor,
}

impl Retrace {
    /// Traces the atoms that the parent of `log` received, on all cores and about in the order in which it received
    /// them. The scene, the size and the quality are those of `tracer`. The updates are [`Update::Placed`], and
    /// [`Update::Finished`] at the end.
    pub fn start(tracer: Arc<Tracer>, log: Arc<RunLog>) -> Self {
        Self::start_with(move |pixels, scratch, out| tracer.trace(pixels, scratch, out), log)
    }

    /// Does the same as [`Retrace::start`] with any function in place of the tracer.
    pub fn start_with(
        trace: impl Fn(Range<u32>, &mut Scratch, &mut Vec<Colour>) + Send + Sync + 'static,
        log: Arc<RunLog>,
    ) -> Self {
        let cancel = CancelToken::default();
        let its_cancel = cancel.clone();
        let supervisor = Supervisor::start("retrace", move |updates| trace_all(&log, &its_cancel, &trace, updates));
        Self { cancel, supervisor }
    }

    /// Returns the updates, oldest first.
    pub fn updates(&self) -> &Receiver<Update> {
        self.supervisor.updates()
    }

    /// Tells all threads to end and returns at once. The last update is then [`Update::Failed`], unless all was traced.
    pub fn stop(&self) {
        self.cancel.cancel();
    }

    /// Returns whether all threads have ended.
    pub fn has_ended(&self) -> bool {
        self.supervisor.has_ended()
    }
}

impl Drop for Retrace {
    fn drop(&mut self) {
        self.stop();
        self.supervisor.join();
    }
}

fn trace_all(
    log: &RunLog,
    cancel: &CancelToken,
    trace: &TracePixels,
    updates: &Sender<Update>,
) -> Result<(), RunError> {
    let (division, jobs, next) = (log.header.division, plan(log, cancel), AtomicUsize::new(0));
    thread::scope(|scope| {
        let mut threads = Threads::new(scope, || cancel.cancel());
        for index in 0..cores().min(jobs.len()) {
            let (jobs, next) = (&jobs, &next);
            threads.start(&format!("tracer {index}"), move || {
                let mut scratch = Scratch::default();
                while let Some(atoms) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let (mut pixels, is_over) = (Vec::new(), || cancel.is_cancelled());
                    if !trace_pieces(trace, division.pixels_of(atoms), &mut scratch, &mut pixels, is_over) {
                        return;
                    }
                    // The receiver may be gone.
                    let _ = updates.send(Update::Placed { atoms: vec![atoms.clone()], pixels });
                }
            });
        }
        threads.join()
    })?;
    if cancel.is_cancelled() { Err(RunError::Stopped) } else { Ok(()) }
}
