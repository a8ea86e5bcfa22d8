//! Whoever performs what the window shows: nodes that trace, or whoever traces a recorded run's picture again.

use crossbeam_channel::Receiver;

use crate::driver::{Retrace, Run, Update};
use crate::scenario::Command;

/// Whoever performs a run.
pub enum RunSource {
    /// Nobody yet: the first scene is still being prepared.
    Nobody,
    /// Nodes as threads.
    Live(Run),
    /// All records are there; the picture is traced again.
    Recorded(Retrace),
}

impl RunSource {
    /// What has happened since, oldest first.
    pub fn updates(&self) -> Option<&Receiver<Update>> {
        match self {
            Self::Nobody => None,
            Self::Live(run) => Some(run.updates()),
            Self::Recorded(retrace) => Some(retrace.updates()),
        }
    }

    /// Stops the run's clock, or lets it go on.
    pub fn set_paused(&self, paused: bool) {
        match (self, paused) {
            (Self::Live(run), true) => run.pause(),
            (Self::Live(run), false) => run.resume(),
            (Self::Nobody | Self::Recorded(_), _) => {}
        }
    }

    /// Asks all threads to end, without waiting for them.
    pub fn stop(&self) {
        match self {
            Self::Nobody => {}
            Self::Live(run) => run.stop(),
            Self::Recorded(retrace) => retrace.stop(),
        }
    }

    /// Whether all threads have ended.
    pub fn has_ended(&self) -> bool {
        match self {
            Self::Nobody => true,
            Self::Live(run) => run.has_ended(),
            Self::Recorded(retrace) => retrace.has_ended(),
        }
    }

    /// Executes a command on a live run; a recorded run does not change any more.
    pub fn command(&self, command: Command) {
        if let Self::Live(run) = self {
            run.command(command);
        }
    }

    /// Lets the run's own clock go so many times as fast, if it is one of virtual time.
    pub fn set_rate(&self, rate: f64) {
        if let Self::Live(run) = self {
            run.set_rate(rate);
        }
    }
}
