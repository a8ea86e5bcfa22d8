//! The emulated machine: it converts work that a thread has done already into the time that the machine takes for it.

use std::time::Duration;

use crate::time::Time;

/// Longest time that a machine may be behind the run's clock and still catch up. Threads wake late and lose their core
/// for a while; a longer delay means that the computer is too slow for the machines, and then the run takes longer.
const MAX_LATENESS: Duration = Duration::from_millis(50);

/// The worker of one machine. Work is measured in CPU seconds of this computer; the machine does speed × pace of them
/// per second.
#[derive(Debug)]
pub struct Machine {
    pace: f64,
    /// Fraction of the reference machine's speed; a pause does not change it.
    speed: f64,
    paused: bool,
    time: Time,
    /// Work left of the piece in hand at `time`, in CPU seconds.
    work_left: f64,
}

impl Machine {
    /// Creates a machine without work at [`Time::ZERO`]. `speed` is a fraction of the reference machine's speed, and
    /// the reference machine gets the fraction `pace` of a core.
    pub fn new(speed: f64, pace: f64) -> Self {
        Self { pace, speed, paused: false, time: Time::ZERO, work_left: 0.0 }
    }

    /// Returns the machine's own time: it has done its work up to here.
    pub fn time(&self) -> Time {
        self.time
    }

    /// Returns whether the machine is as fast as this computer: then it never waits, and its times are those of the
    /// clock.
    pub fn is_full(&self) -> bool {
        self.rate() >= 1.0
    }

    /// Returns whether the worker stands still, since it is paused or has speed 0.
    pub fn is_stopped(&self) -> bool {
        self.rate() == 0.0
    }

    /// Returns when the machine can begin a piece of work that has been available since `available`, at the clock's
    /// time `now`: at once if it is idle.
    pub fn ready(&self, available: Time, now: Time) -> Time {
        if self.is_full() { now } else { self.time.max(available).max(now - MAX_LATENESS) }
    }

    /// Begins a piece of work at `start`.
    pub fn begin(&mut self, start: Time, work: Duration) {
        self.time = start;
        self.work_left = work.as_secs_f64();
    }

    /// Returns when the piece in hand will be done at the present speed; `None` if never.
    pub fn due(&self) -> Option<Time> {
        if self.work_left == 0.0 {
            return Some(self.time);
        }
        (!self.is_stopped()).then(|| self.time + Duration::from_nanos(Time::from_secs(self.work_left / self.rate()).0))
    }

    /// Ends the piece in hand at `at`.
    pub fn finish(&mut self, at: Time) {
        self.time = at;
        self.work_left = 0.0;
    }

    /// Sets the speed at `at`: the rest of the piece in hand continues at the new speed, once the machine is not
    /// paused.
    pub fn set_speed(&mut self, speed: f64, at: Time) {
        self.work_until(at);
        self.speed = speed;
    }

    /// Returns whether the machine is paused, at any speed.
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    /// Pauses the machine at `at`, even in the middle of a piece, or lets it continue at its speed.
    pub fn set_paused(&mut self, paused: bool, at: Time) {
        self.work_until(at);
        self.paused = paused;
    }

    /// Advances the machine's time to `at`, if that is later, and does the work of that time.
    fn work_until(&mut self, at: Time) {
        let done = at.since(self.time).as_secs_f64() * self.rate();
        self.work_left = (self.work_left - done).max(0.0);
        self.time = self.time.max(at);
    }

    /// Returns the CPU seconds of this computer that the machine does per second, from 0 to 1.
    fn rate(&self) -> f64 {
        let rate = if self.paused { 0.0 } else { self.speed * self.pace };
        // NaN is not above 0: such a machine stands still.
        if rate > 0.0 { rate.min(1.0) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn secs(secs: f64) -> Option<Time> {
        Some(Time::from_secs(secs))
    }

    #[test]
    fn slow_machine_takes_longer() {
        let mut machine = Machine::new(0.5, 0.5);
        machine.begin(Time::from_secs(1.0), Duration::from_secs(1));
        assert_eq!(machine.due(), secs(5.0));
    }

    #[test]
    fn new_speed_applies_to_the_rest_of_the_piece() {
        let mut machine = Machine::new(0.5, 1.0);
        machine.begin(Time::ZERO, Duration::from_secs(1));
        machine.set_speed(0.25, Time::from_secs(1.0));
        assert_eq!(machine.due(), secs(3.0));
        machine.set_speed(0.0, Time::from_secs(2.0));
        assert_eq!(machine.due(), None);
        machine.set_speed(0.125, Time::from_secs(7.0));
        assert_eq!(machine.due(), secs(9.0));
    }

    #[test]
    fn paused_machine_stands_still_at_any_speed() {
        let mut machine = Machine::new(0.5, 1.0);
        machine.begin(Time::ZERO, Duration::from_secs(1));
        machine.set_paused(true, Time::from_secs(1.0));
        assert_eq!((machine.is_stopped(), machine.is_full(), machine.due()), (true, false, None));
        machine.set_speed(1.0, Time::from_secs(2.0));
        assert_eq!((machine.is_stopped(), machine.is_full(), machine.due()), (true, false, None));
        machine.set_paused(false, Time::from_secs(3.0));
        assert_eq!((machine.is_full(), machine.due()), (true, secs(3.5)));
    }

    #[test]
    fn machine_catches_up_within_bounds() {
        let mut machine = Machine::new(0.5, 1.0);
        machine.finish(Time::from_secs(1.0));
        let ready = |available, now| machine.ready(Time::from_secs(available), Time::from_secs(now)).secs();
        assert_eq!([ready(0.5, 1.01), ready(1.25, 1.25), ready(0.5, 2.05)], [1.0, 1.25, 2.0]);
        assert_eq!(Machine::new(1.0, 1.0).ready(Time::ZERO, Time::from_secs(3.0)).secs(), 3.0);
    }

    proptest! {
        /// The work done is the integral of the rate, for any sequence of speeds and pauses.
        #[test]
        fn work_done_is_the_integral_of_the_rate(
            swings in prop::collection::vec((0.01f64..0.2, prop::option::of(0.0f64..1.0), any::<bool>()), 0..20),
        ) {
            let mut machine = Machine::new(0.3, 0.5);
            machine.begin(Time::ZERO, Duration::from_secs(10));
            let (mut at, mut left, mut speed, mut paused) = (0.0, 10.0, 0.3, false);
            for (later, new_speed, pause) in swings {
                at += later;
                left -= if paused { 0.0 } else { later * speed * 0.5 };
                match new_speed {
                    Some(new_speed) => {
                        speed = new_speed;
                        machine.set_speed(speed, Time::from_secs(at));
                    }
                    None => {
                        paused = pause;
                        machine.set_paused(paused, Time::from_secs(at));
                    }
                }
                prop_assert_eq!(machine.is_paused(), paused);
            }
            machine.set_speed(0.5, Time::from_secs(at));
            machine.set_paused(false, Time::from_secs(at));
            let due = machine.due().unwrap().secs();
            prop_assert!((due - (at + left / 0.25)).abs() < 1e-6, "{due}");
        }
    }
}
