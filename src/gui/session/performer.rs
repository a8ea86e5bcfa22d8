//! Whoever performs what the window shows: nodes that trace, or a recorded run that is played again.

use std::time::Duration;

use crossbeam_channel::Receiver;

use crate::balance::NodeId;
use crate::driver::{Replay, Run, Update};
use crate::time::Time;

/// Whoever performs a run.
pub enum Performer {
    /// Nobody yet: the first scene is still being prepared.
    Nobody,
    /// Nodes as threads.
    Live(Run),
    /// Records.
    Recorded(Replay),
}

impl Performer {
    /// The run's clock.
    pub fn now(&self) -> Time {
        match self {
            Self::Nobody => Time::ZERO,
            Self::Live(run) => run.now(),
            Self::Recorded(replay) => replay.now(),
        }
    }

    /// What has happened since, oldest first.
    pub fn updates(&self) -> Option<&Receiver<Update>> {
        match self {
            Self::Nobody => None,
            Self::Live(run) => Some(run.updates()),
            Self::Recorded(replay) => Some(replay.updates()),
        }
    }

    /// Stops the run's clock, or lets it go on.
    pub fn set_paused(&self, paused: bool) {
        match (self, paused) {
            (Self::Nobody, _) => {}
            (Self::Live(run), true) => run.pause(),
            (Self::Live(run), false) => run.resume(),
            (Self::Recorded(replay), true) => replay.pause(),
            (Self::Recorded(replay), false) => replay.resume(),
        }
    }

    /// Asks all threads to end, without waiting for them.
    pub fn stop(&self) {
        match self {
            Self::Nobody => {}
            Self::Live(run) => run.stop(),
            Self::Recorded(replay) => replay.stop(),
        }
    }

    /// Whether all threads have ended.
    pub fn has_ended(&self) -> bool {
        match self {
            Self::Nobody => true,
            Self::Live(run) => run.has_ended(),
            Self::Recorded(replay) => replay.has_ended(),
        }
    }

    /// Changes a machine's speed; what is recorded does not change any more.
    pub fn set_speed(&self, node: NodeId, speed: f64) {
        if let Self::Live(run) = self {
            run.set_speed(node, speed);
        }
    }

    /// Lets a machine stand still, or go on.
    pub fn set_node_paused(&self, node: NodeId, paused: bool) {
        if let Self::Live(run) = self {
            run.set_paused(node, paused);
        }
    }

    /// Changes how long messages travel.
    pub fn set_latency(&self, latency: Duration) {
        if let Self::Live(run) = self {
            run.set_latency(latency);
        }
    }
}
