//! The picture of a recorded run, traced once more.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

use crossbeam_channel::{Receiver, Sender};

use super::pace::cores;
use super::retrace_plan::plan;
use super::supervisor::{Supervisor, Threads};
use super::worker::trace_pieces;
use super::{TracePixels, Update};
use crate::picture::Colour;
use crate::runlog::RunLog;
use crate::tracer::{Scratch, Tracer};

/// Traces a picture again in threads of its own. Dropping it stops them and waits for them.
pub struct Retrace {
    is_over: Arc<AtomicBool>,
    supervisor: Supervisor,
}

impl Retrace {
    /// Traces what the parent of `log` received, on all cores and about in the order in which it did; the scene, the size
    /// and the quality are those of `tracer`. The updates are [`Update::Placed`], and [`Update::Finished`] at the end.
    pub fn start(tracer: Arc<Tracer>, log: Arc<RunLog>) -> Self {
        Self::start_with(move |pixels, scratch, out| tracer.trace(pixels, scratch, out), log)
    }

    /// [`Retrace::start`] with anything in the tracer's place.
    pub fn start_with(
        trace: impl Fn(Range<u32>, &mut Scratch, &mut Vec<Colour>) + Send + Sync + 'static,
        log: Arc<RunLog>,
    ) -> Self {
        let is_over = Arc::new(AtomicBool::new(false));
        let its = Arc::clone(&is_over);
        let supervisor = Supervisor::start("retrace", move |updates| trace_all(&log, &its, &trace, updates));
        Self { is_over, supervisor }
    }

    /// What has happened since, oldest first.
    pub fn updates(&self) -> &Receiver<Update> {
        self.supervisor.updates()
    }

    /// Tells all threads to end and returns at once. The last update is then [`Update::Failed`], unless all was traced.
    pub fn stop(&self) {
        self.is_over.store(true, Ordering::SeqCst);
    }

    /// Whether all threads have ended: nothing is left to wait for.
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

fn trace_all(log: &RunLog, is_over: &AtomicBool, trace: &TracePixels, updates: &Sender<Update>) -> Result<(), String> {
    let ends = || is_over.load(Ordering::SeqCst);
    let (division, jobs, next) = (log.header.division, plan(log, ends), AtomicUsize::new(0));
    thread::scope(|scope| {
        let mut threads = Threads::new(scope, || is_over.store(true, Ordering::SeqCst));
        for index in 0..cores().min(jobs.len()) {
            let (jobs, next) = (&jobs, &next);
            threads.start(&format!("tracer {index}"), move || {
                let mut scratch = Scratch::default();
                while let Some(atoms) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let mut pixels = Vec::new();
                    if !trace_pieces(trace, division.pixels_of(atoms), &mut scratch, &mut pixels, ends) {
                        return;
                    }
                    // Nobody may be left to listen.
                    let _ = updates.send(Update::Placed { atoms: vec![atoms.clone()], pixels });
                }
            });
        }
        threads.join()
    })?;
    if ends() { Err("it was stopped".into()) } else { Ok(()) }
}
