//! Atoms a second of a node in the last few seconds: counts in bins of time, so that memory is bounded.

use crate::time::Time;

/// Counts of atoms in the last few seconds, by bin.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Throughput {
    /// Ring buffer: bin number `n` is at `n` modulo its length.
    counts: [u32; BIN_COUNT],
    /// Number of the latest bin with an atom.
    newest: u64,
}

/// Length of a bin.
const BIN_NS: u64 = 100_000_000;
/// Length of the time over which the mean is taken.
const WINDOW_NS: u64 = 3_000_000_000;
/// At least one more than the window's 30, since it covers two bins partly; a power of two, for a fast modulo.
const BIN_COUNT: usize = 32;

impl Throughput {
    /// Counts an atom traced at `at`, unless that is older than all bins.
    pub(crate) fn count(&mut self, at: Time) {
        let bin = at.0 / BIN_NS;
        if bin > self.newest {
            let emptied = (bin - self.newest).min(BIN_COUNT as u64);
            (bin + 1 - emptied..=bin).for_each(|bin| self.counts[place(bin)] = 0);
            self.newest = bin;
        }
        if bin + BIN_COUNT as u64 > self.newest {
            self.counts[place(bin)] += 1;
        }
    }

    /// Atoms a second in the 3 s before `now`, or since the node began at `since` if that is later.
    pub(crate) fn per_second(&self, since: Time, now: Time) -> f64 {
        let window = now.0.saturating_sub(WINDOW_NS);
        let start = window.max(since.0);
        let length = now.0.saturating_sub(start);
        if length == 0 {
            return 0.0;
        }
        let kept = (self.newest + 1).saturating_sub(BIN_COUNT as u64);
        let bins = (start / BIN_NS).max(kept)..=(now.0 / BIN_NS).min(self.newest);
        let counted = |bin: u64| {
            // The window covers a part of its first bin.
            let before = window.saturating_sub(bin * BIN_NS).min(BIN_NS);
            f64::from(self.counts[place(bin)]) * (BIN_NS - before) as f64 / BIN_NS as f64
        };
        bins.map(counted).sum::<f64>() / (length as f64 * 1e-9)
    }
}

fn place(bin: u64) -> usize {
    (bin % BIN_COUNT as u64) as usize
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const SECOND_NS: u64 = 1_000_000_000;

    /// Counts `each` atoms a second from `since` to `until`, in ns.
    fn steady(each: u64, since: u64, until: u64) -> Throughput {
        let mut rate = Throughput::default();
        (1..).map(|i| since + i * SECOND_NS / each).take_while(|&at| at <= until).for_each(|at| rate.count(Time(at)));
        rate
    }

    proptest! {
        #[test]
        fn rate_of_a_steady_node_is_right_at_all_times(
            each in 20..2000u64, since in 0..5 * SECOND_NS, lasts in SECOND_NS / 2..8 * SECOND_NS,
        ) {
            let now = since + lasts;
            let found = steady(each, since, now).per_second(Time(since), Time(now));
            // The atom that is being traced and a part of the oldest bin are uncertain.
            let tolerance = 2.0 / (lasts.min(WINDOW_NS) as f64 * 1e-9);
            prop_assert!((found - each as f64).abs() <= tolerance + 0.02 * each as f64, "{found} for {each}");
        }

        #[test]
        fn rate_falls_to_0_while_nothing_is_traced(each in 1..500u64, lasts in SECOND_NS..8 * SECOND_NS) {
            let rate = steady(each, 0, lasts);
            let at = |later: u64| rate.per_second(Time::ZERO, Time(lasts + later * SECOND_NS / 10));
            prop_assert!((0..40).all(|later| at(later) >= at(later + 1)));
            prop_assert_eq!(at(31), 0.0);
            prop_assert_eq!(at(1000), 0.0);
        }
    }

    #[test]
    fn reused_bins_start_from_0() {
        let mut rate = Throughput::default();
        for at in [0, 1, 4 * SECOND_NS, 400 * SECOND_NS, 400 * SECOND_NS] {
            rate.count(Time(at));
        }
        assert_eq!(rate.per_second(Time::ZERO, Time(400 * SECOND_NS)) * 3.0, 2.0);
        // Older than all bins, and a time before all bins.
        rate.count(Time(5));
        assert_eq!(rate.per_second(Time::ZERO, Time(401 * SECOND_NS)) * 3.0, 2.0);
        assert_eq!(rate.per_second(Time::ZERO, Time(3 * SECOND_NS)), 0.0);
    }
}
