//! The view's own clock: which moment of a run is shown, and how fast its time goes.

use std::time::Duration;

use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::text::format::count;

/// How fast a run's time goes before the user's eyes, in seconds of the run a second; the last is as fast as one can.
pub const RATES: [f64; 17] =
    [1e-6, 1e-5, 1e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, f64::INFINITY];

const REAL_TIME_INDEX: usize = 12;

/// A clock that shows a run's time: it follows the run's own clock (it is *live*), or goes through what has happened.
#[derive(Clone, Copy, Debug)]
pub struct Playback {
    /// In nanoseconds of the run; a fraction of one counts where time goes slowly.
    now: f64,
    /// The latest that was shown.
    reached: f64,
    is_live: bool,
    is_paused: bool,
    rate_index: usize,
}

impl Playback {
    /// Shows what happens as it happens.
    pub fn live() -> Self {
        Self { now: 0.0, reached: 0.0, is_live: true, is_paused: false, rate_index: REAL_TIME_INDEX }
    }

    /// Goes through what has happened, from its beginning.
    pub fn from_start() -> Self {
        Self { is_live: false, ..Self::live() }
    }

    /// The shown time.
    pub fn now(&self) -> Time {
        Time(self.now as u64)
    }

    /// The latest time that was shown.
    pub fn reached(&self) -> Time {
        Time(self.reached as u64)
    }

    /// Whether it follows the run's own clock.
    pub fn is_live(&self) -> bool {
        self.is_live
    }

    /// Whether it stands still, apart from following the run.
    pub fn is_paused(&self) -> bool {
        self.is_paused
    }

    /// Seconds of the run that go by in a second.
    pub fn rate(&self) -> f64 {
        RATES[self.rate_index]
    }

    /// Which of [`RATES`].
    pub fn rate_index(&self) -> usize {
        self.rate_index
    }

    /// Sets one of [`RATES`].
    pub fn set_rate(&mut self, index: usize) {
        self.rate_index = index.min(RATES.len() - 1);
    }

    /// Faster or slower by so many of [`RATES`].
    pub fn change_rate(&mut self, by: isize) {
        self.set_rate(self.rate_index.saturating_add_signed(by));
    }

    /// A moment has passed, in which the run's clock has come to `head`. Where `run_keeps_pace` the run itself goes as
    /// fast as is asked here, so that whoever follows it never falls behind.
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
        // Slower than the run: it is left behind.
        self.is_live = false;
        if !self.is_paused {
            let further = self.now + passed.as_nanos() as f64 * self.rate();
            // Nothing times infinity is no number.
            self.now = if further.is_nan() { self.now } else { further };
        }
        if self.now >= head {
            (self.now, self.is_live) = (head, self.rate() >= 1.0 || run_keeps_pace);
        }
    }

    /// Shows another moment, and whether time goes on from there.
    pub fn seek(&mut self, time: Time, is_paused: bool) {
        (self.now, self.is_live, self.is_paused) = (time.0 as f64, false, is_paused);
        self.reached = self.reached.max(self.now);
    }

    /// Follows the run again.
    pub fn follow(&mut self) {
        (self.is_live, self.is_paused) = (true, false);
        self.rate_index = self.rate_index.max(REAL_TIME_INDEX);
    }

    /// Stands still, or goes on.
    pub fn set_paused(&mut self, is_paused: bool) {
        self.is_paused = is_paused;
    }
}

/// A rate in words: `1 000 × slower`, `2 × faster`.
pub fn rate_of_time_words(rate: f64, language: Language) -> String {
    let times = count((1.0 / rate).round() as u32);
    if rate.is_infinite() {
        word!(language, "as fast as it can", "o mais rápido possível").into()
    } else if rate < 1.0 {
        say!(language, "{times} × slower", "{times} × mais lento")
    } else if rate > 1.0 {
        say!(language, "{rate} × faster", "{rate} × mais rápido")
    } else {
        word!(language, "in its own time", "em seu próprio tempo").into()
    }
}

/// The same where there is little room: `1/1 000 ×`, `2 ×`.
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
    fn what_was_reached_stays_reached() {
        let mut playback = Playback::from_start();
        playback.advance(Duration::from_secs(2), Time::from_secs(9.0), false);
        playback.seek(Time::from_secs(1.0), true);
        assert_eq!((playback.now(), playback.reached()), (Time::from_secs(1.0), Time::from_secs(2.0)));
        playback.seek(Time::from_secs(5.0), true);
        assert_eq!(playback.reached(), Time::from_secs(5.0));
    }

    #[test]
    fn it_follows_until_it_is_slower_and_catches_up_when_it_is_faster() {
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
    fn a_run_that_keeps_pace_is_followed_at_any_rate() {
        let mut clock = Playback::live();
        clock.set_rate(0);
        clock.advance(FRAME, Time(40), true);
        assert_eq!((clock.now(), clock.is_live()), (Time(40), true));
    }

    #[test]
    fn a_million_times_slower_still_goes_on() {
        let mut clock = Playback::from_start();
        clock.set_rate(0);
        // A nanosecond a millisecond, in frames that are no whole number of nanoseconds.
        (0..3_000).for_each(|_| clock.advance(Duration::from_micros(1_500), Time::from_secs(1.0), false));
        assert!(clock.now().0.abs_diff(4_500) <= 1, "{:?}", clock.now());
    }

    proptest! {
        #[test]
        fn it_never_goes_back_nor_beyond_the_run(
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
    fn rates_are_told_in_words() {
        let said = [1e-6, 0.5, 1.0, 2.0, f64::INFINITY].map(|rate| rate_of_time_words(rate, Language::English));
        let expected =
            ["1\u{a0}000\u{a0}000 × slower", "2 × slower", "in its own time", "2 × faster", "as fast as it can"];
        assert_eq!(said, expected);
        assert!(RATES.is_sorted() && RATES[REAL_TIME_INDEX] == 1.0);
    }
}
