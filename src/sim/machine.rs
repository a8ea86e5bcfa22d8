//! The emulated machine: how long its worker takes for what the thread has already done.

use std::time::Duration;

use crate::time::Time;

/// How far a machine may be behind the run's clock and still make up for it. Threads wake late and lose their core for
/// a while; more than this means that the computer is too slow for the machines, and then the run takes longer.
const MOST_LATE: Duration = Duration::from_millis(50);

/// One machine's worker. Work is measured in CPU seconds of this computer, of which the machine does
/// speed × pace in a second.
#[derive(Debug)]
pub struct Machine {
    pace: f64,
    /// As a fraction of the reference machine's; a pause does not change it.
    speed: f64,
    paused: bool,
    time: Time,
    /// Work of the piece in hand that is left at `time`, in CPU seconds.
    left: f64,
}

impl Machine {
    /// A machine without work at [`Time::ZERO`]. `speed` is a fraction of the reference machine's, which gets the
    /// fraction `pace` of a core.
    pub fn new(speed: f64, pace: f64) -> Self {
        Self { pace, speed, paused: false, time: Time::ZERO, left: 0.0 }
    }

    /// The machine's own time: up to here it has done what it had to.
    pub fn time(&self) -> Time {
        self.time
    }

    /// Whether the machine is this computer itself: then it waits for nothing, and its times are real.
    pub fn is_full(&self) -> bool {
        self.rate() >= 1.0
    }

    /// Whether its worker stands still, because it is paused or has speed 0.
    pub fn is_stopped(&self) -> bool {
        self.rate() == 0.0
    }

    /// When the machine can begin something that it could have had since `available`: at once if it is idle. The
    /// clock shows `now`.
    pub fn ready(&self, available: Time, now: Time) -> Time {
        if self.is_full() { now } else { self.time.max(available).max(now - MOST_LATE) }
    }

    /// Takes a piece of work in hand at `start`.
    pub fn begin(&mut self, start: Time, work: Duration) {
        self.time = start;
        self.left = work.as_secs_f64();
    }

    /// When the piece in hand will be done; `None` if never, at the present speed.
    pub fn due(&self) -> Option<Time> {
        if self.left == 0.0 {
            return Some(self.time);
        }
        (!self.is_stopped()).then(|| self.time + Duration::from_nanos(Time::from_secs(self.left / self.rate()).0))
    }

    /// The piece in hand is done at `at`.
    pub fn finish(&mut self, at: Time) {
        self.time = at;
        self.left = 0.0;
    }

    /// Changes the speed at `at`: what is left of the piece in hand goes on at the new one, once the machine is not
    /// paused.
    pub fn set_speed(&mut self, speed: f64, at: Time) {
        self.work_until(at);
        self.speed = speed;
    }

    /// Whether the machine is paused, whatever its speed.
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    /// Makes the machine stand still at `at`, in the middle of a piece too, or go on at its speed.
    pub fn set_paused(&mut self, paused: bool, at: Time) {
        self.work_until(at);
        self.paused = paused;
    }

    /// Moves the machine's time on to `at`, if that is later.
    fn work_until(&mut self, at: Time) {
        let done = at.since(self.time).as_secs_f64() * self.rate();
        self.left = (self.left - done).max(0.0);
        self.time = self.time.max(at);
    }

    /// CPU seconds of this computer that the machine does in a second, from 0 to 1.
    fn rate(&self) -> f64 {
        let rate = if self.paused { 0.0 } else { self.speed * self.pace };
        // NaN is not above 0 either: a machine that stands still.
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
    fn work_takes_longer_on_a_slow_machine() {
        let mut machine = Machine::new(0.5, 0.5);
        machine.begin(Time::from_secs(1.0), Duration::from_secs(1));
        assert_eq!(machine.due(), secs(5.0));
    }

    #[test]
    fn a_new_speed_is_for_what_is_left() {
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
    fn a_pause_stands_still_at_any_speed() {
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
    fn lateness_is_made_up_within_bounds() {
        let mut machine = Machine::new(0.5, 1.0);
        machine.finish(Time::from_secs(1.0));
        let ready = |available, now| machine.ready(Time::from_secs(available), Time::from_secs(now)).secs();
        assert_eq!([ready(0.5, 1.01), ready(1.25, 1.25), ready(0.5, 2.05)], [1.0, 1.25, 2.0]);
        assert_eq!(Machine::new(1.0, 1.0).ready(Time::ZERO, Time::from_secs(3.0)).secs(), 3.0);
    }

    proptest! {
        /// However often the speed swings and the machine is paused, the work done is the integral of the rate.
        #[test]
        fn swings_and_pauses_do_the_work_once(
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
