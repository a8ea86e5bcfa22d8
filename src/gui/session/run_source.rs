//! Source of the records and pixels on the stage: the threads of a live run, or a recorded run whose picture is traced
//! again.

use crossbeam_channel::Receiver;

use crate::driver::{Retrace, Run, Update};
use crate::scenario::Command;

/// Source of a run's records and pixels.
pub enum RunSource {
    /// None yet: the first scene is still being compiled.
    None,
    /// A live run in threads.
    Live(Run),
    /// A recorded run, whose picture is traced again.
    Recorded(Retrace),
}

impl RunSource {
    /// Returns the channel of updates, oldest first.
    pub fn updates(&self) -> Option<&Receiver<Update>> {
        match self {
            Self::None => None,
            Self::Live(run) => Some(run.updates()),
            Self::Recorded(retrace) => Some(retrace.updates()),
        }
    }

    /// Pauses or resumes the clock of a live run.
    pub fn set_paused(&self, paused: bool) {
        match (self, paused) {
            (Self::Live(run), true) => run.pause(),
            (Self::Live(run), false) => run.resume(),
            (Self::None | Self::Recorded(_), _) => {}
        }
    }

    /// Tells all threads to end, without waiting for them.
    pub fn stop(&self) {
        match self {
            Self::None => {}
            Self::Live(run) => run.stop(),
            Self::Recorded(retrace) => retrace.stop(),
        }
    }

    /// Whether all threads have ended.
    pub fn has_ended(&self) -> bool {
        match self {
            Self::None => true,
            Self::Live(run) => run.has_ended(),
            Self::Recorded(retrace) => retrace.has_ended(),
        }
    }

    /// Executes a command on a live run; a recorded run ignores it.
    pub fn command(&self, command: Command) {
        if let Self::Live(run) = self {
            run.command(command);
        }
    }

    /// Sets the rate of the run's clock (run seconds per wall second) in virtual time.
    pub fn set_rate(&self, rate: f64) {
        if let Self::Live(run) = self {
            run.set_rate(rate);
        }
    }
}
