//! What an atom costs: the CPU time of the thread that traced it.
//!
//! Reading that clock is a system call of about 0.4 µs, too much for each atom at full speed, where an atom may take
//! 10 µs. There the meter measures batches, and splits each batch's CPU time by the atoms' wall time.

use std::time::Duration;

use cpu_time::ThreadTime;

/// A batch is split once it has this many atoms…
const BATCH_ATOMS: usize = 16;
/// …or has taken this long.
const BATCH_TIME: Duration = Duration::from_micros(200);

/// Measures the thread that it was made on.
pub(super) struct Meter {
    start: ThreadTime,
    /// CPU time since the start at the last reading.
    last: Duration,
    /// The CPU time that a reading itself takes.
    toll: Duration,
}

impl Meter {
    /// A meter for this thread.
    pub fn new() -> Self {
        let mut meter = Self { start: ThreadTime::now(), last: Duration::ZERO, toll: Duration::ZERO };
        let readings = std::array::from_fn::<_, 8, _>(|_| meter.lap());
        meter.toll = readings.into_iter().min().unwrap_or_default();
        meter
    }

    /// CPU time since the last reading, without the reading itself.
    pub fn lap(&mut self) -> Duration {
        let now = self.start.elapsed();
        let lap = now.saturating_sub(self.last).saturating_sub(self.toll);
        self.last = now;
        lap
    }
}

/// Atoms traced since the last reading of the CPU clock, by whatever names their costs.
#[derive(Debug, Default)]
pub(super) struct Batch {
    atoms: Vec<(usize, Duration)>,
    wall: Duration,
}

impl Batch {
    /// Adds an atom that took `wall`.
    pub fn push(&mut self, name: usize, wall: Duration) {
        self.atoms.push((name, wall));
        self.wall += wall;
    }

    /// Whether it is time to split.
    pub fn is_full(&self) -> bool {
        self.atoms.len() >= BATCH_ATOMS || self.wall >= BATCH_TIME
    }

    /// Whether there is nothing to split.
    pub fn is_empty(&self) -> bool {
        self.atoms.is_empty()
    }

    /// Empties the batch: each name with its share of `cpu`. The thread also did other things in that time, so the
    /// wall time stands where it had its core throughout; where it lost it, each atom is to blame in proportion.
    pub fn split(&mut self, cpu: Duration) -> impl Iterator<Item = (usize, Duration)> {
        let scale = if self.wall > cpu { cpu.as_secs_f64() / self.wall.as_secs_f64() } else { 1.0 };
        self.wall = Duration::ZERO;
        self.atoms.drain(..).map(move |(name, wall)| (name, wall.mul_f64(scale)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const US: Duration = Duration::from_micros(1);

    #[test]
    fn lost_time_is_taken_off_in_proportion() {
        let mut batch = Batch::default();
        batch.push(3, 10 * US);
        batch.push(5, 30 * US);
        assert!(batch.split(20 * US).eq([(3, 5 * US), (5, 15 * US)]));
        assert!(batch.is_empty());
        batch.push(7, 10 * US);
        assert!(batch.split(50 * US).eq([(7, 10 * US)]));
    }

    #[test]
    fn a_batch_fills_by_count_and_by_time() {
        let mut batch = Batch::default();
        (0..BATCH_ATOMS - 1).for_each(|name| batch.push(name, US));
        assert!(!batch.is_full());
        batch.push(99, US);
        assert!(batch.is_full());
        let mut batch = Batch::default();
        batch.push(0, BATCH_TIME);
        assert!(batch.is_full());
    }

    #[test]
    fn a_thread_that_sleeps_costs_nothing() {
        let mut meter = Meter::new();
        meter.lap();
        std::thread::sleep(Duration::from_millis(50));
        assert!(meter.lap() < Duration::from_millis(25));
    }
}
