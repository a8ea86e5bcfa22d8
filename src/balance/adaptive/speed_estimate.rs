//! How fast a node is now, measured by itself: work done over the time that it took.

use std::time::Duration;

use crate::time::Time;

/// How much the last atom counts against all before it, for the speed and for the cost of an atom.
const OF_SPEED: f64 = 0.25;
const OF_COST: f64 = 1.0 / 16.0;

/// A node's measure of its own worker.
#[derive(Debug, Default)]
pub(super) struct SpeedEstimate {
    /// As a fraction of the reference machine; `None` until an atom was traced.
    speed: Option<f64>,
    /// What an atom costs the reference machine, in seconds.
    cost: f64,
    /// Since when the worker has had its atom in hand.
    since: Time,
}

impl SpeedEstimate {
    /// The worker, which had none, takes an atom in hand.
    pub fn begin(&mut self, now: Time) {
        self.since = now;
    }

    /// The worker is done with an atom of this cost, and takes the next in hand.
    pub fn done(&mut self, now: Time, cost: Duration) {
        let (took, cost) = (now.since(self.since).as_secs_f64(), cost.as_secs_f64());
        self.since = now;
        if took > 0.0 && cost > 0.0 {
            let seen = cost / took;
            self.cost = if self.speed.is_some() { mix(self.cost, cost, OF_COST) } else { cost };
            self.speed = Some(self.speed.map_or(seen, |speed| mix(speed, seen, OF_SPEED)));
        }
    }

    /// The speed by the last atoms, and what an atom costs.
    pub fn known(&self) -> Option<(f64, f64)> {
        self.speed.map(|speed| (speed, self.cost))
    }

    /// Since when the worker has had its atom in hand, if it has one.
    pub fn since(&self) -> Time {
        self.since
    }

    /// How long an atom takes, by the last ones.
    pub fn atom(&self) -> Option<Duration> {
        self.known().map(|(speed, cost)| Duration::from_nanos(Time::from_secs(cost / speed).0))
    }

    /// The speed now: that of the last atoms, or less if the worker has had its atom in hand for longer than they took.
    pub fn speed(&self, now: Time) -> Option<f64> {
        let (speed, cost) = self.known()?;
        let age = now.since(self.since).as_secs_f64();
        Some(if age > 0.0 { speed.min(cost / age) } else { speed })
    }

    /// How long the atom in hand will still take: what is left of an atom's usual time; but the longer it takes, the longer it
    /// will, by as much as it is over half of that.
    pub fn left(&self, now: Time) -> Duration {
        let age = now.since(self.since);
        let usual = self.atom().unwrap_or_default();
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
        let mut gauge = SpeedEstimate::default();
        assert_eq!((gauge.speed(Time(5)), gauge.left(Time(5))), (None, Duration::from_nanos(5)));
        let mut now = Time::ZERO;
        let mut trace = |gauge: &mut SpeedEstimate, atoms: u32, took: Duration| {
            for _ in 0..atoms {
                now += took;
                gauge.done(now, MS);
            }
            gauge.speed(now).expect("it has traced")
        };
        assert!((trace(&mut gauge, 3, 2 * MS) - 0.5).abs() < 1e-9);
        assert!((trace(&mut gauge, 20, 10 * MS) - 0.1).abs() < 0.01);
    }

    #[test]
    fn who_is_late_is_slow_and_will_take_long() {
        let mut gauge = SpeedEstimate::default();
        gauge.done(Time::ZERO + 2 * MS, MS);
        let at = |ms| Time::ZERO + ms * MS;
        let left = [3, 4, 6, 22].map(|ms| gauge.left(at(ms)));
        assert_eq!(left, [MS, MS, 3 * MS, 19 * MS]);
        let speed = |ms| gauge.speed(at(ms)).expect("it has traced");
        assert!((speed(3) - 0.5).abs() < 1e-9 && (speed(22) - 0.05).abs() < 1e-9);
    }
}
