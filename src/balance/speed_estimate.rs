//! The node's estimate of its own speed: the work in its last atoms over the time that they took.

use std::time::Duration;

use super::strategy::LEASE_BEATS;
use crate::time::Time;

/// A worker counts as stuck if its atom takes this many leases and this many times [`LEASE_BEATS`] usual atoms.
const STUCK_LEASES: u32 = 16;
/// Weight of the last atom in the moving average of the speed.
const SPEED_WEIGHT: f64 = 0.25;
/// Weight of the last atom in the moving average of an atom's cost.
const COST_WEIGHT: f64 = 1.0 / 16.0;

/// A node's measurement of its own worker.
#[derive(Debug, Default)]
pub(super) struct SpeedEstimate {
    /// Fraction of the reference machine's speed; `None` until an atom is traced.
    speed: Option<f64>,
    /// Cost of an atom on the reference machine, in seconds.
    cost: f64,
    /// When the worker began the atom in hand.
    since: Time,
}

impl SpeedEstimate {
    /// Notes that the worker begins an atom at `now`, after a time without any.
    pub fn begin(&mut self, now: Time) {
        self.since = now;
    }

    /// Notes that the worker has traced an atom of this cost, and begins the next one.
    pub fn atom_done(&mut self, now: Time, cost: Duration) {
        let (took, cost) = (now.since(self.since).as_secs_f64(), cost.as_secs_f64());
        self.since = now;
        if took > 0.0 && cost > 0.0 {
            let measured = cost / took;
            self.cost = if self.speed.is_some() { mix(self.cost, cost, COST_WEIGHT) } else { cost };
            self.speed = Some(self.speed.map_or(measured, |speed| mix(speed, measured, SPEED_WEIGHT)));
        }
    }

    /// Returns the average speed and the average cost of an atom in seconds.
    pub fn averages(&self) -> Option<(f64, f64)> {
        self.speed.map(|speed| (speed, self.cost))
    }

    /// Returns when the worker began the atom in hand, if it has one.
    pub fn since(&self) -> Time {
        self.since
    }

    /// Returns the usual time of an atom, by the averages.
    pub fn usual_time(&self) -> Option<Duration> {
        self.averages().map(|(speed, cost)| Duration::from_nanos(Time::from_secs(cost / speed).0))
    }

    /// Returns the speed at `now`: the average, or less if the atom in hand already takes longer than usual.
    pub fn speed(&self, now: Time) -> Option<f64> {
        let (speed, cost) = self.averages()?;
        let age = now.since(self.since).as_secs_f64();
        Some(if age > 0.0 { speed.min(cost / age) } else { speed })
    }

    /// Returns whether the worker has had the atom in hand for so long that its node no longer vouches for the atoms
    /// that it holds. The bound is high, because an atom that is merely costly should not be traced by all nodes.
    pub fn is_stuck(&self, now: Time, lease: Duration) -> bool {
        let usual = self.usual_time().unwrap_or_default();
        now.since(self.since) > lease.max(usual * LEASE_BEATS) * STUCK_LEASES
    }

    /// Returns how long the atom in hand will still take: the rest of the usual time, or as long as its age exceeds
    /// half of the usual time, whichever is more.
    pub fn time_left(&self, now: Time) -> Duration {
        let age = now.since(self.since);
        let usual = self.usual_time().unwrap_or_default();
        usual.saturating_sub(age).max(age.saturating_sub(usual / 2))
    }
}

fn mix(before: f64, last: f64, weight: f64) -> f64 {
    before + weight * (last - before)
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn speed_is_work_over_time_and_follows_a_change() {
        let mut estimate = SpeedEstimate::default();
        assert_eq!((estimate.speed(Time(5)), estimate.time_left(Time(5))), (None, Duration::from_nanos(5)));
        let mut now = Time::ZERO;
        let mut trace = |estimate: &mut SpeedEstimate, atoms: u32, took: Duration| {
            for _ in 0..atoms {
                now += took;
                estimate.atom_done(now, MS);
            }
            estimate.speed(now).expect("it has traced")
        };
        assert!((trace(&mut estimate, 3, 2 * MS) - 0.5).abs() < 1e-9);
        assert!((trace(&mut estimate, 20, 10 * MS) - 0.1).abs() < 0.01);
    }

    #[test]
    fn overdue_atom_lowers_the_speed_and_raises_the_time_left() {
        let mut estimate = SpeedEstimate::default();
        estimate.atom_done(Time::ZERO + 2 * MS, MS);
        let at = |ms| Time::ZERO + ms * MS;
        let left = [3, 4, 6, 22].map(|ms| estimate.time_left(at(ms)));
        assert_eq!(left, [MS, MS, 3 * MS, 19 * MS]);
        let speed = |ms| estimate.speed(at(ms)).expect("it has traced");
        assert!((speed(3) - 0.5).abs() < 1e-9 && (speed(22) - 0.05).abs() < 1e-9);
    }
}
