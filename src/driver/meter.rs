//! Measures the cost of an atom: the CPU time of the thread that traces it.
//!
//! Reading the CPU clock is a system call of about 0.4 µs, too much for each atom at full speed, where an atom may take
//! 10 µs. There the meter measures batches of atoms, and splits the CPU time of each batch by the atoms' wall times.

use std::time::Duration;

use cpu_time::ThreadTime;

/// A batch is full with this many atoms, …
const BATCH_ATOMS: usize = 16;
/// … or after this wall time.
const BATCH_TIME: Duration = Duration::from_micros(200);

/// Measures the CPU time of the thread that creates it.
pub(super) struct Meter {
    start: ThreadTime,
    /// CPU time since the start at the last reading.
    last: Duration,
    /// CPU time of a reading itself.
    overhead: Duration,
}

impl Meter {
    /// Creates a meter for this thread.
    pub fn new() -> Self {
        let mut meter = Self { start: ThreadTime::now(), last: Duration::ZERO, overhead: Duration::ZERO };
        let readings = std::array::from_fn::<_, 8, _>(|_| meter.lap());
        meter.overhead = readings.into_iter().min().unwrap_or_default();
        meter
    }

    /// Returns the CPU time since the last reading, without the reading itself.
    pub fn lap(&mut self) -> Duration {
        let now = self.start.elapsed();
        let lap = now.saturating_sub(self.last).saturating_sub(self.overhead);
        self.last = now;
        lap
    }
}

/// Atoms traced since the last reading of the CPU clock, by the index of their records.
#[derive(Debug, Default)]
pub(super) struct Batch {
    /// Index and wall time of each atom.
    atoms: Vec<(usize, Duration)>,
    wall: Duration,
}

impl Batch {
    /// Adds an atom that took `wall`.
    pub fn push(&mut self, index: usize, wall: Duration) {
        self.atoms.push((index, wall));
        self.wall += wall;
    }

    /// Returns whether the batch should be split.
    pub fn is_full(&self) -> bool {
        self.atoms.len() >= BATCH_ATOMS || self.wall >= BATCH_TIME
    }

    /// Returns whether the batch has no atoms.
    pub fn is_empty(&self) -> bool {
        self.atoms.is_empty()
    }

    /// Empties the batch. Returns the index of each atom with its cost. The thread also did other things in the time
    /// `cpu`, so the cost is the wall time if the thread kept its core; if it lost its core, the wall times are scaled
    /// down to `cpu`.
    pub fn split(&mut self, cpu: Duration) -> impl Iterator<Item = (usize, Duration)> {
        let scale = if self.wall > cpu { cpu.as_secs_f64() / self.wall.as_secs_f64() } else { 1.0 };
        self.wall = Duration::ZERO;
        self.atoms.drain(..).map(move |(index, wall)| (index, wall.mul_f64(scale)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const US: Duration = Duration::from_micros(1);

    #[test]
    fn wall_times_are_scaled_down_to_the_cpu_time() {
        let mut batch = Batch::default();
        batch.push(3, 10 * US);
        batch.push(5, 30 * US);
        assert!(batch.split(20 * US).eq([(3, 5 * US), (5, 15 * US)]));
        assert!(batch.is_empty());
        batch.push(7, 10 * US);
        assert!(batch.split(50 * US).eq([(7, 10 * US)]));
    }

    #[test]
    fn batch_is_full_by_count_or_by_time() {
        let mut batch = Batch::default();
        (0..BATCH_ATOMS - 1).for_each(|index| batch.push(index, US));
        assert!(!batch.is_full());
        batch.push(99, US);
        assert!(batch.is_full());
        let mut batch = Batch::default();
        batch.push(0, BATCH_TIME);
        assert!(batch.is_full());
    }

    #[test]
    fn sleeping_thread_has_no_cost() {
        let mut meter = Meter::new();
        meter.lap();
        std::thread::sleep(Duration::from_millis(50));
        assert!(meter.lap() < Duration::from_millis(25));
    }
}
