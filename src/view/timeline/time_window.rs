//! The stretch of a run's time that is shown.

use crate::time::Time;

/// A stretch of a run's time that is shown across some width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeWindow {
    /// Its beginning, in nanoseconds.
    from: f64,
    /// Its length, in nanoseconds; never 0.
    length: f64,
    /// Whether it shows all of the run, and grows with it.
    shows_all: bool,
}

/// Least length: a hundredth of the shortest atom.
const MIN_LENGTH_NS: f64 = 100.0;

impl Default for TimeWindow {
    fn default() -> Self {
        Self { from: 0.0, length: 1.0, shows_all: true }
    }
}

impl TimeWindow {
    /// Returns its beginning.
    pub fn from(&self) -> Time {
        Time(self.from as u64)
    }

    /// Returns its end.
    pub fn to(&self) -> Time {
        Time((self.from + self.length).ceil() as u64)
    }

    /// Whether it shows all of the run.
    pub fn shows_all(&self) -> bool {
        self.shows_all
    }

    /// Shows all of the run.
    pub fn show_all(&mut self) {
        self.shows_all = true;
    }

    /// Adapts to the present length of the run: stays inside it, or shows all of it.
    pub fn fit(&mut self, length: Time) {
        let whole = (length.0 as f64).max(MIN_LENGTH_NS);
        if self.shows_all || self.length >= whole {
            *self = Self { from: 0.0, length: whole, shows_all: true };
        }
        self.from = self.from.clamp(0.0, whole - self.length);
    }

    /// Shows `factor` times as much time (less than 1: nearer). The time at `share` of the width, 0 to 1, stays there.
    pub fn zoom(&mut self, share: f64, factor: f64) {
        let (at, before) = (self.from + share * self.length, self.length);
        self.length = (self.length * factor).max(MIN_LENGTH_NS);
        self.from = (at - share * self.length).max(0.0);
        self.shows_all &= self.length >= before;
    }

    /// Moves by a share of its length; positive shows later times.
    pub fn pan(&mut self, share: f64) {
        self.from = (self.from + share * self.length).max(0.0);
    }

    /// Moves `time` to the middle if it is not in the window.
    pub fn show(&mut self, time: Time) {
        let time = time.0 as f64;
        if time < self.from || time > self.from + self.length {
            self.from = (time - self.length / 2.0).max(0.0);
        }
    }

    /// Returns the position of a time as a share of the width; outside 0 to 1 it is not visible.
    pub fn share(&self, time: Time) -> f64 {
        (time.0 as f64 - self.from) / self.length
    }

    /// Returns the time at a share of the width.
    pub fn at(&self, share: f64) -> Time {
        Time((self.from + share * self.length).max(0.0) as u64)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn time_under_the_pointer_stays_there(share in 0.0..1.0f64, factor in 0.1..1.0f64, length in 1_000_000..u64::MAX / 4096) {
            let mut window = TimeWindow::default();
            window.fit(Time(length));
            let before = window.at(share);
            window.zoom(share, factor);
            window.fit(Time(length));
            prop_assert!((window.share(before) - share).abs() < 1e-3, "{} for {share}", window.share(before));
            prop_assert!(!window.shows_all());
        }

        #[test]
        fn window_never_leaves_the_run(moves in prop::collection::vec((0.0..1.0f64, 0.2..4.0f64, -2.0..2.0f64), 1..30)) {
            let (mut window, length) = (TimeWindow::default(), Time::from_secs(20.0));
            window.fit(length);
            for (share, factor, by) in moves {
                window.zoom(share, factor);
                window.pan(by);
                window.fit(length);
                prop_assert!(window.from() < window.to() && window.to().0 <= length.0 + 1);
            }
        }
    }

    #[test]
    fn window_grows_with_the_run_until_zoomed() {
        let mut window = TimeWindow::default();
        window.fit(Time(5_000));
        window.fit(Time(9_000));
        assert_eq!((window.from(), window.to()), (Time(0), Time(9_000)));
        window.zoom(0.5, 0.5);
        window.fit(Time(20_000));
        assert_eq!((window.from(), window.to()), (Time(2_250), Time(6_750)));
        window.show(Time(18_000));
        assert!(window.from() < Time(18_000) && Time(18_000) < window.to());
        window.show_all();
        window.fit(Time(20_000));
        assert_eq!(window.to(), Time(20_000));
    }
}
