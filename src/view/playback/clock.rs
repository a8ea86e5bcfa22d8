//! The playback clock: which time of a run is shown, and how fast it goes on.

use std::time::Duration;

use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::text::format::count;

/// Playback rates: run seconds per wall second. The last is as fast as possible.
pub const RATES: [f64; 17] =
    [1e-6, 1e-5, 1e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, f64::INFINITY];

/// Index of rate 1 in [`RATES`].
const REAL_TIME_INDEX: usize = 12;

/// Clock of the shown time. It follows the run's own clock (*live*), or plays the recorded part.
#[derive(Clone, Copy, Debug)]
pub struct Playback {
    /// The shown time in nanoseconds of the run; fractions count at slow rates.
    now: f64,
    /// The latest time that was shown.
    reached: f64,
    is_live: bool,
    is_paused: bool,
    rate_index: usize,
}

impl Playback {
    /// Starts live.
    pub fn live() -> Self {
        Self { now: 0.0, reached: 0.0, is_live: true, is_paused: false, rate_index: REAL_TIME_INDEX }
    }

    /// Starts at the beginning of the record.
    pub fn from_start() -> Self {
        Self { is_live: false, ..Self::live() }
    }

    /// Returns the shown time.
    pub fn now(&self) -> Time {
        Time(self.now as u64)
    }

    /// Returns the latest time that was shown.
    pub fn reached(&self) -> Time {
        Time(self.reached as u64)
    }

    /// Whether it follows the run's own clock.
    pub fn is_live(&self) -> bool {
        self.is_live
    }

    /// Whether playback is paused; while live this has no effect.
    pub fn is_paused(&self) -> bool {
        self.is_paused
    }

    /// Playback rate: run seconds per wall second.
    pub fn rate(&self) -> f64 {
        RATES[self.rate_index]
    }

    /// Returns the index of the rate in [`RATES`].
    pub fn rate_index(&self) -> usize {
        self.rate_index
    }

    /// Sets the rate by its index in [`RATES`].
    pub fn set_rate(&mut self, index: usize) {
        self.rate_index = index.min(RATES.len() - 1);
    }

    /// Changes the rate by this many steps of [`RATES`].
    pub fn change_rate(&mut self, by: isize) {
        self.set_rate(self.rate_index.saturating_add_signed(by));
    }

    /// Advances by `passed` of wall time; the run's own clock is at `head`. With `run_keeps_pace` the run itself goes
    /// at the playback rate, so a live clock never falls behind.
    pub fn advance(&mut self, passed: Duration, head: Time, run_keeps_pace: bool) {
        self.go(passed, head, run_keeps_pace);
        self.reached = self.reached.max(self.now);
    }

    fn go(&mut self, passed: Duration, head: Time, run_keeps_pace: bool) {
        let head = head.0 as f64;
        if self.is_live && (self.rate() >= 1.0 || run_keeps_pace) {
            self.now = head;
            return;
        }
        // Slower than the run: it is not live any more.
        self.is_live = false;
        if !self.is_paused {
            let further = self.now + passed.as_nanos() as f64 * self.rate();
            // 0 × ∞ is not a number.
            self.now = if further.is_nan() { self.now } else { further };
        }
        if self.now >= head {
            (self.now, self.is_live) = (head, self.rate() >= 1.0 || run_keeps_pace);
        }
    }

    /// Shows another time, paused or playing from there.
    pub fn seek(&mut self, time: Time, is_paused: bool) {
        (self.now, self.is_live, self.is_paused) = (time.0 as f64, false, is_paused);
        self.reached = self.reached.max(self.now);
    }

    /// Follows the run again, at rate 1 or faster.
    pub fn follow(&mut self) {
        (self.is_live, self.is_paused) = (true, false);
        self.rate_index = self.rate_index.max(REAL_TIME_INDEX);
    }

    /// Pauses or resumes playback.
    pub fn set_paused(&mut self, is_paused: bool) {
        self.is_paused = is_paused;
    }
}

/// Puts a playback rate into words: `1 000 × slower`, `2 × faster`.
pub fn rate_of_time_words(rate: f64, language: Language) -> String {
    let times = count((1.0 / rate).round() as u32);
    if rate.is_infinite() {
        word!(language, "as fast as possible", "o mais rápido possível").into()
    } else if rate < 1.0 {
        say!(language, "{times} × slower", "{times} × mais lento")
    } else if rate > 1.0 {
        say!(language, "{rate} × faster", "{rate} × mais rápido")
    } else {
        word!(language, "in real time", "em tempo real").into()
    }
}

/// Puts a playback rate into few letters: `1/1 000 ×`, `2 ×`.
pub fn short_rate_words(rate: f64, language: Language) -> String {
    if rate.is_infinite() {
        word!(language, "fastest", "máximo").into()
    } else if rate < 1.0 {
        format!("1/{} ×", count((1.0 / rate).round() as u32))
    } else {
        format!("{rate} ×")
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const FRAME: Duration = Duration::from_millis(40);

    #[test]
    fn reached_time_never_decreases() {
        let mut playback = Playback::from_start();
        playback.advance(Duration::from_secs(2), Time::from_secs(9.0), false);
        playback.seek(Time::from_secs(1.0), true);
        assert_eq!((playback.now(), playback.reached()), (Time::from_secs(1.0), Time::from_secs(2.0)));
        playback.seek(Time::from_secs(5.0), true);
        assert_eq!(playback.reached(), Time::from_secs(5.0));
    }

    #[test]
    fn slow_clock_leaves_live_and_fast_clock_catches_up() {
        let mut clock = Playback::live();
        clock.advance(FRAME, Time(5_000), false);
        assert_eq!((clock.now(), clock.is_live()), (Time(5_000), true));
        clock.change_rate(-3);
        assert_eq!(clock.rate(), 0.1);
        clock.advance(FRAME, Time(40_005_000), false);
        assert_eq!((clock.now(), clock.is_live()), (Time(4_005_000), false));
        clock.set_rate(15);
        clock.advance(FRAME, Time(80_005_000), false);
        assert_eq!((clock.now(), clock.is_live()), (Time(80_005_000), true));
    }

    #[test]
    fn run_that_keeps_pace_is_followed_at_any_rate() {
        let mut clock = Playback::live();
        clock.set_rate(0);
        clock.advance(FRAME, Time(40), true);
        assert_eq!((clock.now(), clock.is_live()), (Time(40), true));
    }

    #[test]
    fn slowest_rate_still_advances() {
        let mut clock = Playback::from_start();
        clock.set_rate(0);
        // A nanosecond of the run per millisecond, in frames of a fraction of a nanosecond.
        (0..3_000).for_each(|_| clock.advance(Duration::from_micros(1_500), Time::from_secs(1.0), false));
        assert!(clock.now().0.abs_diff(4_500) <= 1, "{:?}", clock.now());
    }

    proptest! {
        #[test]
        fn clock_goes_neither_back_nor_beyond_the_run(
            frames in prop::collection::vec((0..100u64, 0..200_000_000u64, -2..=2isize, any::<bool>()), 1..60),
        ) {
            let (mut clock, mut head) = (Playback::from_start(), 0);
            for (ms, further, by, is_paused) in frames {
                head += further;
                clock.change_rate(by);
                clock.set_paused(is_paused);
                let before = clock.now();
                clock.advance(Duration::from_millis(ms), Time(head), false);
                prop_assert!(before <= clock.now() && clock.now() <= Time(head));
                prop_assert!(!clock.is_live() || clock.now() == Time(head));
            }
        }
    }

    #[test]
    fn rates_have_words() {
        let said = [1e-6, 0.5, 1.0, 2.0, f64::INFINITY].map(|rate| rate_of_time_words(rate, Language::English));
        let expected =
            ["1\u{a0}000\u{a0}000 × slower", "2 × slower", "in real time", "2 × faster", "as fast as possible"];
        assert_eq!(said, expected);
        assert!(RATES.is_sorted() && RATES[REAL_TIME_INDEX] == 1.0);
    }
}
