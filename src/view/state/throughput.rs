//! How many atoms a second a node has traced of late: counts in bins of time, so that memory is bounded.

use crate::time::Time;

/// Counts of the last few seconds, by bin.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Rate {
    /// A ring: the bin of number `n` is at `n` modulo its length.
    counts: [u32; BINS],
    /// The number of the latest bin that counts anything.
    newest: u64,
}

/// Nanoseconds of a bin.
const BIN: u64 = 100_000_000;
/// Nanoseconds over which the mean is taken.
const WINDOW: u64 = 3_000_000_000;
/// One more than the window has, for the two that it covers partly; a power of two divides fast.
const BINS: usize = 32;

impl Rate {
    /// Counts an atom traced at `at`; what is older than all bins is left out.
    pub(crate) fn count(&mut self, at: Time) {
        let bin = at.0 / BIN;
        if bin > self.newest {
            let emptied = (bin - self.newest).min(BINS as u64);
            (bin + 1 - emptied..=bin).for_each(|bin| self.counts[place(bin)] = 0);
            self.newest = bin;
        }
        if bin + BINS as u64 > self.newest {
            self.counts[place(bin)] += 1;
        }
    }

    /// Atoms a second over the last 3 s before `now`, or since the node began at `since` if that is later.
    pub(crate) fn per_second(&self, since: Time, now: Time) -> f64 {
        let window = now.0.saturating_sub(WINDOW);
        let start = window.max(since.0);
        let length = now.0.saturating_sub(start);
        if length == 0 {
            return 0.0;
        }
        let kept = (self.newest + 1).saturating_sub(BINS as u64);
        let bins = (start / BIN).max(kept)..=(now.0 / BIN).min(self.newest);
        let counted = |bin: u64| {
            // The window begins within its first bin, of which it takes a part.
            let before = window.saturating_sub(bin * BIN).min(BIN);
            f64::from(self.counts[place(bin)]) * (BIN - before) as f64 / BIN as f64
        };
        bins.map(counted).sum::<f64>() / (length as f64 * 1e-9)
    }
}

fn place(bin: u64) -> usize {
    (bin % BINS as u64) as usize
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const SECOND: u64 = 1_000_000_000;

    /// A rate that has counted `each` atoms a second from `since` to `until`, in ns.
    fn steady(each: u64, since: u64, until: u64) -> Rate {
        let mut rate = Rate::default();
        (1..).map(|i| since + i * SECOND / each).take_while(|&at| at <= until).for_each(|at| rate.count(Time(at)));
        rate
    }

    proptest! {
        #[test]
        fn a_steady_node_has_its_rate_at_all_times(
            each in 20..2000u64, since in 0..5 * SECOND, lasts in SECOND / 2..8 * SECOND,
        ) {
            let now = since + lasts;
            let found = steady(each, since, now).per_second(Time(since), Time(now));
            // At most the atom in hand and a part of the oldest bin are in doubt.
            let doubt = 2.0 / (lasts.min(WINDOW) as f64 * 1e-9);
            prop_assert!((found - each as f64).abs() <= doubt + 0.02 * each as f64, "{found} for {each}");
        }

        #[test]
        fn it_sinks_to_nothing_while_nothing_is_done(each in 1..500u64, lasts in SECOND..8 * SECOND) {
            let rate = steady(each, 0, lasts);
            let at = |later: u64| rate.per_second(Time::ZERO, Time(lasts + later * SECOND / 10));
            prop_assert!((0..40).all(|later| at(later) >= at(later + 1)));
            prop_assert_eq!(at(31), 0.0);
            prop_assert_eq!(at(1000), 0.0);
        }
    }

    #[test]
    fn nothing_is_counted_twice_when_bins_are_used_again() {
        let mut rate = Rate::default();
        for at in [0, 1, 4 * SECOND, 400 * SECOND, 400 * SECOND] {
            rate.count(Time(at));
        }
        assert_eq!(rate.per_second(Time::ZERO, Time(400 * SECOND)) * 3.0, 2.0);
        // Too old to be kept, and too late to be known.
        rate.count(Time(5));
        assert_eq!(rate.per_second(Time::ZERO, Time(401 * SECOND)) * 3.0, 2.0);
        assert_eq!(rate.per_second(Time::ZERO, Time(3 * SECOND)), 0.0);
    }
}
