//! What is done to a run while it goes on: by a hand, or by a script.

use std::time::Duration;

use crate::balance::{Condition, NodeId, Party};
use crate::time::Time;

/// One thing that is done to a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// Gives a node another speed, a fraction of the reference machine's; 0 stops its worker, not its messages.
    Speed {
        /// Which node.
        node: NodeId,
        /// Its new speed, 0 to 1.
        speed: f64,
    },
    /// Makes a node's worker stand still, or go on at the node's speed.
    Pause {
        /// Which node.
        node: NodeId,
        /// Whether it is to stand still.
        paused: bool,
    },
    /// Something becomes of a node's machine.
    Condition {
        /// Whose.
        node: NodeId,
        /// How it is from now on.
        condition: Condition,
    },
    /// Cuts the link between two parties, in both directions, or mends it: what is sent while it is cut is lost.
    Link {
        /// One of the two.
        one: Party,
        /// The other.
        other: Party,
        /// Whether it is cut.
        cut: bool,
    },
    /// Holds up what is on its way from one party to another, and what is sent there: it arrives no earlier than so much
    /// later, all in its order.
    Delay {
        /// Who sends it.
        from: Party,
        /// Who is to wait for it.
        to: Party,
        /// How long, from now.
        by: Duration,
    },
    /// Gives all links another latency, for the messages that leave from now on.
    Latency(Duration),
}

impl Command {
    /// The same with a speed that is possible: above 1 counts as 1, and what is not above 0 as 0, NaN too.
    pub fn possible(self) -> Self {
        match self {
            Self::Speed { node, speed } => Self::Speed { node, speed: if speed > 0.0 { speed.min(1.0) } else { 0.0 } },
            other => other,
        }
    }
}

/// Commands and their times, in the order of time.
pub type Script = Vec<(Time, Command)>;

/// A node whose speed swings between `high` and `low`: it changes at the end of each half of `period`, begins high, and has
/// its last change before `end`.
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
    fn an_impossible_speed_becomes_the_nearest_that_is_possible() {
        let speed = |speed| Command::Speed { node: 1, speed };
        for (asked, given) in [(-1.0, 0.0), (f64::NAN, 0.0), (0.25, 0.25), (7.0, 1.0)] {
            assert_eq!(speed(asked).possible(), speed(given));
        }
    }

    #[test]
    fn a_square_wave_begins_high_and_swings_each_half_period() {
        let wave = square_wave(3, 1.0, 0.25, Duration::from_secs(2), Time::from_secs(3.5));
        let speed = |at, speed| (Time::from_secs(at), Command::Speed { node: 3, speed });
        assert_eq!(wave, [speed(1.0, 0.25), speed(2.0, 1.0), speed(3.0, 0.25)]);
    }
}
