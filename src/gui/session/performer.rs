//! Whoever performs what the window shows: nodes that trace, or whoever traces a recorded run's picture again.

use std::time::Duration;

use crossbeam_channel::Receiver;

use crate::balance::{Condition, NodeId, Party};
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

    /// Something becomes of a node's machine.
    pub fn set_condition(&self, node: NodeId, condition: Condition) {
        if let Self::Live(run) = self {
            run.command(Command::Condition { node, condition });
        }
    }

    /// What is on its way from one party to another is held up.
    pub fn delay(&self, from: Party, to: Party, by: Duration) {
        if let Self::Live(run) = self {
            run.command(Command::Delay { from, to, by });
        }
    }

    /// Lets the run's own clock go so many times as fast, if it is one of virtual time.
    pub fn set_rate(&self, rate: f64) {
        if let Self::Live(run) = self {
            run.set_rate(rate);
        }
    }

    /// Changes how long messages travel.
    pub fn set_latency(&self, latency: Duration) {
        if let Self::Live(run) = self {
            run.set_latency(latency);
        }
    }
}
