//! A recorded run once more: its records when a clock reaches their times, and its pixels, which are traced again.

use std::ops::Range;
use std::sync::Arc;
use std::thread;

use crossbeam_channel::{Receiver, Sender};

use super::clock::Clock;
use super::jobs::plan;
use super::pace::cores;
use super::supervisor::{Supervisor, Threads};
use super::teller::{Note, Teller};
use super::worker::trace_pieces;
use super::{TracePixels, Update};
use crate::picture::Colour;
use crate::runlog::RunLog;
use crate::time::Time;
use crate::tracer::{Scratch, Tracer};

/// A replay that goes on in its own threads. Dropping it stops them and waits for them.
pub struct Replay {
    shared: Arc<Shared>,
    supervisor: Supervisor,
}

struct Shared {
    clock: Clock,
    notes: Sender<Note>,
}

impl Replay {
    /// Starts the replay of `log`, whose scene, size and quality are those of `tracer`. Records are told when the
    /// clock, which begins at 0, reaches their times; pixels once the parent has received them and they are traced. The
    /// last update is [`Update::Finished`] when all of this is told, also where the log is incomplete.
    pub fn start(tracer: Arc<Tracer>, log: Arc<RunLog>) -> Self {
        Self::start_with(move |pixels, scratch, out| tracer.trace(pixels, scratch, out), log)
    }

    /// [`Replay::start`] with anything in the tracer's place.
    pub fn start_with(
        trace: impl Fn(Range<u32>, &mut Scratch, &mut Vec<Colour>) + Send + Sync + 'static,
        log: Arc<RunLog>,
    ) -> Self {
        // Unbounded, but at most a note for each job that is ahead and each call of the user's is in it.
        let (sender, notes) = crossbeam_channel::unbounded();
        let shared = Arc::new(Shared { clock: Clock::start(), notes: sender });
        let supervisor = {
            let shared = shared.clone();
            Supervisor::start("replay", move |updates| supervise(&log, &shared, &notes, &trace, updates))
        };
        Self { shared, supervisor }
    }

    /// What has happened since, oldest first.
    pub fn updates(&self) -> &Receiver<Update> {
        self.supervisor.updates()
    }

    /// The replay's clock, which shows the recorded run's time; it stands still while the replay is paused.
    pub fn now(&self) -> Time {
        self.shared.clock.now()
    }

    /// Stops the clock. Pixels that were due before may still come.
    pub fn pause(&self) {
        self.shared.clock.pause();
    }

    /// Lets the replay go on after [`Replay::pause`].
    pub fn resume(&self) {
        self.shared.clock.resume();
        self.shared.wake();
    }

    /// Tells all threads to end and returns at once. The last update is then [`Update::Failed`], unless the replay was
    /// over.
    pub fn stop(&self) {
        self.shared.stop();
    }

    /// Whether all threads of the replay have ended: nothing is left to wait for.
    pub fn has_ended(&self) -> bool {
        self.supervisor.has_ended()
    }
}

impl Drop for Replay {
    fn drop(&mut self) {
        self.stop();
        self.supervisor.join();
    }
}

impl Shared {
    fn wake(&self) {
        // A teller that has ended needs no waking.
        let _ = self.notes.send(Note::Wake);
    }

    fn stop(&self) {
        self.clock.end();
        self.wake();
    }
}

/// Tells the log on this thread, and traces on others, until all is told.
fn supervise(
    log: &RunLog,
    shared: &Shared,
    notes: &Receiver<Note>,
    trace: &TracePixels,
    updates: &Sender<Update>,
) -> Result<(), String> {
    let jobs = plan(log, || shared.clock.has_ended());
    thread::scope(|scope| {
        let (todo, tracers) = crossbeam_channel::unbounded();
        let mut threads = Threads::new(scope, || shared.stop());
        for index in 0..cores().min(jobs.len()) {
            let todo = tracers.clone();
            threads.start(&format!("tracer {index}"), move || trace_jobs(&todo, shared, trace));
        }
        let teller = Teller::new(log, &jobs, &shared.clock, notes, todo, updates);
        // Without the teller there are no more jobs, and the tracers end.
        let told = teller.tell();
        threads.join().and(told)
    })
}

/// Traces what there is to do until there is no more.
fn trace_jobs(todo: &Receiver<(usize, Range<u32>)>, shared: &Shared, trace: &TracePixels) {
    let mut scratch = Scratch::default();
    for (job, pixels) in todo {
        let mut colours = Vec::with_capacity(pixels.len());
        if !trace_pieces(trace, pixels, &mut scratch, &mut colours, || shared.clock.has_ended()) {
            return;
        }
        let _ = shared.notes.send(Note::Traced(job, colours));
    }
}

#[cfg(test)]
mod tests {
    use super::super::jobs::MOST;
    use super::super::teller::AHEAD;
    use super::*;
    use crate::balance::{Message, Party};
    use crate::picture::Division;
    use crate::record::{Record, What};
    use crate::runlog::Header;
    use crate::runlog::examples::header;
    use std::iter::once;
    use std::sync::atomic::{AtomicU32, Ordering};
    use std::time::Duration;

    /// Four times as many pixels as are traced ahead, all of which the parent receives at `at`.
    fn log(at: Time) -> Arc<RunLog> {
        let (id, from, to) = (0, Party::Node(0), Party::Parent);
        let division = Division::new(4 * AHEAD, 64);
        let message = Message::Results(once(0..division.atoms()).collect());
        let sent = What::Sent { id, from, to, message, bytes: 0, arrives: at };
        let mut log = RunLog::new(Header { division, ..header(&[1.0]) });
        log.add(vec![Record { at: Time::ZERO, what: sent }, Record { at, what: What::Received { id, by: to } }]);
        Arc::new(log)
    }

    /// Counts the pixels that it traces.
    fn start(log: Arc<RunLog>) -> (Replay, Arc<AtomicU32>) {
        let traced = Arc::new(AtomicU32::new(0));
        let count = Arc::clone(&traced);
        let trace = move |pixels: Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>| {
            count.fetch_add(pixels.len() as u32, Ordering::SeqCst);
            out.resize(out.len() + pixels.len(), [0.0; 3]);
        };
        (Replay::start_with(trace, log), traced)
    }

    #[test]
    fn tracing_goes_ahead_only_so_far() {
        let (replay, traced) = start(log(Time(u64::MAX)));
        while traced.load(Ordering::SeqCst) < AHEAD {
            thread::sleep(Duration::from_millis(1));
        }
        thread::sleep(Duration::from_millis(20));
        assert!(traced.load(Ordering::SeqCst) < AHEAD + MOST);
        drop(replay);
        assert_eq!(Arc::strong_count(&traced), 1, "a tracer goes on");
    }

    #[test]
    fn what_was_too_far_ahead_is_traced_later() {
        let (replay, traced) = start(log(Time(1)));
        let last = replay.updates().iter().last();
        assert!(matches!(last, Some(Update::Finished)), "{last:?}");
        assert_eq!(traced.load(Ordering::SeqCst), 4 * AHEAD);
    }
}
