//! What is known of one node.

use std::time::Duration;

use crate::picture::Atom;
use crate::time::Time;

/// What is known of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeState {
    /// Its speed as a fraction of the reference machine.
    pub speed: f64,
    /// Atoms that it has traced.
    pub done: u32,
    /// The atom that its worker is tracing.
    pub atom: Option<Atom>,
    /// Its own offer came back.
    pub retired: bool,
    /// Its speed before that was last set.
    pub(super) speed_before: f64,
    // Signed, since the record of an atom may come before that of the band it belongs to.
    pub(super) left: i64,
    pub(super) has_band: bool,
    pub(super) offer_out: bool,
    idle: Duration,
    idle_since: Option<Time>,
    pub(super) last_results: Option<Time>,
}

/// What a node is seen doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Activity {
    /// Its band has not arrived yet.
    Waiting,
    /// Its worker traces atoms.
    Computing,
    /// It has atoms, but its speed is 0.
    Stopped,
    /// Its offer of help is on its way.
    Offering,
    /// Atoms are on their way to it.
    Receiving,
    /// It has nothing to do.
    Idle,
    /// Its own offer came back: nobody needs it.
    Retired,
    /// The picture is complete.
    Done,
}

impl NodeState {
    /// Atoms in its queue and its pipe, the one being traced included.
    pub fn left(&self) -> u32 {
        self.left.max(0) as u32
    }

    /// Whether it has atoms and a speed to trace them at.
    pub fn computes(&self) -> bool {
        self.left() > 0 && self.speed > 0.0
    }

    /// How long it has had nothing to trace, from the run's beginning until `now`.
    pub fn idle(&self, now: Time) -> Duration {
        self.idle + self.idle_since.map_or(Duration::ZERO, |since| now.since(since))
    }

    pub(super) fn new(speed: f64) -> Self {
        Self {
            speed,
            speed_before: speed,
            done: 0,
            atom: None,
            retired: false,
            left: 0,
            has_band: false,
            offer_out: false,
            idle: Duration::ZERO,
            idle_since: Some(Time::ZERO),
            last_results: None,
        }
    }

    pub(super) fn give(&mut self, atoms: u32, at: Time) {
        self.left += i64::from(atoms);
        if self.left > 0
            && let Some(since) = self.idle_since.take()
        {
            self.idle += at.since(since);
        }
    }

    pub(super) fn atom_done(&mut self, at: Time) {
        self.done += 1;
        self.left -= 1;
        self.atom = None;
        if self.left <= 0 && self.idle_since.is_none() {
            self.idle_since = Some(at);
        }
    }
}
