//! Commands to a run that goes on, from the user or from a script.

use std::time::Duration;

use crate::balance::{Condition, NodeId, Party};
use crate::time::Time;

/// A command to a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// Sets the speed of a node; 0 stops its worker, not its messages.
    Speed {
        /// The node.
        node: NodeId,
        /// The new speed as a fraction of the reference machine's, 0 to 1.
        speed: f64,
    },
    /// Pauses the worker of a node, or lets it continue at the node's speed. A speed that is set meanwhile counts
    /// afterwards.
    Pause {
        /// The node.
        node: NodeId,
        /// Whether the worker pauses.
        paused: bool,
    },
    /// Sets the condition of a node's machine.
    Condition {
        /// The node.
        node: NodeId,
        /// The new condition.
        condition: Condition,
    },
    /// Cuts or restores the link between two parties, in both directions. Messages that are sent or arrive while it is
    /// cut are lost.
    Link {
        /// One end of the link.
        one: Party,
        /// The other end.
        other: Party,
        /// Whether the link is cut.
        cut: bool,
    },
    /// Delays the messages from one party to another, those in flight and those sent meanwhile: none arrives before the
    /// delay ends. They keep their order.
    Delay {
        /// The sender.
        from: Party,
        /// The receiver.
        to: Party,
        /// Length of the delay, from now.
        by: Duration,
    },
    /// Sets the latency of all nodes that have none of their own, for messages that leave from now on. None overtakes
    /// an earlier one.
    Latency(Duration),
    /// Sets a party's own latency, or with `None` takes it away, in the same way.
    OwnLatency {
        /// The party.
        party: Party,
        /// Its own latency.
        latency: Option<Duration>,
    },
}

impl Command {
    /// Returns the command with its speed clamped to 0 to 1; NaN becomes 0.
    pub fn clamped(self) -> Self {
        match self {
            Self::Speed { node, speed } => Self::Speed { node, speed: if speed > 0.0 { speed.min(1.0) } else { 0.0 } },
            other => other,
        }
    }
}

/// Commands with their times, in the order of time.
pub type Script = Vec<(Time, Command)>;

/// Returns a script in which the speed of a node alternates between `high` and `low`: it starts high, changes after
/// each half of `period`, and changes for the last time before `end`.
pub fn square_wave(node: NodeId, high: f64, low: f64, period: Duration, end: Time) -> Script {
    let half = (period / 2).max(Duration::from_nanos(1));
    let times = std::iter::successors(Some(Time::ZERO + half), |&at| Some(at + half)).take_while(|&at| at < end);
    let speeds = [low, high].into_iter().cycle();
    times.zip(speeds).map(|(at, speed)| (at, Command::Speed { node, speed })).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_are_clamped_to_0_to_1() {
        let speed = |speed| Command::Speed { node: 1, speed };
        for (asked, given) in [(-1.0, 0.0), (f64::NAN, 0.0), (0.25, 0.25), (7.0, 1.0)] {
            assert_eq!(speed(asked).clamped(), speed(given));
        }
    }

    #[test]
    fn square_wave_starts_high_and_alternates_each_half_period() {
        let wave = square_wave(3, 1.0, 0.25, Duration::from_secs(2), Time::from_secs(3.5));
        let speed = |at, speed| (Time::from_secs(at), Command::Speed { node: 3, speed });
        assert_eq!(wave, [speed(1.0, 0.25), speed(2.0, 1.0), speed(3.0, 0.25)]);
    }
}
