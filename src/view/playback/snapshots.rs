//! Snapshots of a run after some of its records, and a cache to reach any other quickly.

use crate::record::Record;
use crate::runlog::{Header, RunLog};
use crate::view::narration::narrator::Narrator;
use crate::view::state::run_state::RunState;

/// A run after some of its records.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Its state.
    pub state: RunState,
    /// Its sentences.
    pub narrator: Narrator,
    /// Number of records taken in.
    records: usize,
}

impl Snapshot {
    /// Starts before the first record.
    pub fn new(header: &Header) -> Self {
        Self { state: RunState::new(header), narrator: Narrator::default(), records: 0 }
    }

    /// Returns the number of records taken in.
    pub fn records(&self) -> usize {
        self.records
    }

    /// Takes in the next record.
    pub fn apply(&mut self, record: &Record) {
        self.state.apply(record);
        self.narrator.apply(record, &self.state);
        self.records += 1;
    }
}

/// Cache of a run's snapshots: any other snapshot is reached from the nearest earlier one.
///
/// The distance is at most some thousand records, and all snapshots together take at most 64 MiB.
#[derive(Clone, Debug, Default)]
pub struct SnapshotCache {
    /// One snapshot every `stride` records, the earliest first; the first is the beginning.
    kept: Vec<Snapshot>,
    stride: usize,
}

/// Maximum memory of all snapshots in the cache.
const MAX_CACHE_BYTES: usize = 64 << 20;

/// Least distance between snapshots, in records: fewer records are applied faster than a snapshot is copied.
const MIN_STRIDE: usize = 1024;

impl SnapshotCache {
    /// Moves `snapshot` to the state after the first `records` records of `log`, or after all if there are fewer.
    /// Returns whether it only went forward, so that its state lists the touched atoms; else it jumped.
    pub fn seek(&mut self, log: &RunLog, records: usize, snapshot: &mut Snapshot) -> bool {
        let records = records.min(log.records().len());
        self.fill_until(log, records);
        let nearest = self.kept.iter().rfind(|kept| kept.records <= records);
        let jumps_to = nearest.filter(|kept| snapshot.records > records || snapshot.records < kept.records);
        if let Some(kept) = jumps_to {
            snapshot.clone_from(kept);
        }
        for record in &log.records()[snapshot.records..records] {
            snapshot.apply(record);
        }
        jumps_to.is_none()
    }

    /// Forgets snapshots of more than `records` records, because others were sorted in before them.
    pub fn forget_after(&mut self, records: usize) {
        self.kept.retain(|snapshot| snapshot.records <= records);
    }

    /// Adds the snapshots up to `records`; doubles the stride when there are too many.
    fn fill_until(&mut self, log: &RunLog, records: usize) {
        if self.kept.is_empty() {
            let first = Snapshot::new(&log.header);
            self.stride = MIN_STRIDE.max(first.state.atoms() as usize / 8);
            self.kept.push(first);
        }
        let most = (MAX_CACHE_BYTES / size_of_val(self.kept[0].state.atom_states()).max(1)).clamp(2, 64);
        // Never empty: the first snapshot stays.
        while let Some(last) = self.kept.last().filter(|last| last.records + self.stride <= records) {
            let mut next = last.clone();
            log.records()[next.records..next.records + self.stride].iter().for_each(|record| next.apply(record));
            next.state.take_touched();
            self.kept.push(next);
            if self.kept.len() > most {
                self.stride *= 2;
                let stride = self.stride;
                self.kept.retain(|snapshot| snapshot.records.is_multiple_of(stride));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::language::Language;
    use proptest::prelude::*;

    use super::*;
    use crate::time::Time;
    use crate::view::state::atom_state::AtomState;
    use crate::view::tests::sample_runs;

    /// All that is visible of a snapshot at its time.
    fn seen(snapshot: &Snapshot, at: Time, language: Language) -> String {
        let Snapshot { state, narrator, records } = snapshot;
        let flights: Vec<_> = state.flights().iter().filter(|flight| flight.gone() > at).collect();
        let events: Vec<_> = narrator.events().collect();
        let sentence = narrator.sentence(state, at, language);
        format!("{records} {:?} {:?} {flights:?} {events:?} {sentence}", state.nodes(), state.atom_states())
    }

    proptest! {
        #[test]
        fn jump_and_replay_reach_the_same_snapshot(
            speeds in prop::collection::vec(0.05..1.0f64, 1..6), atoms in 1..900u32, jumps in prop::collection::vec(0.0..1.0f64, 1..9),
        ) {
            let language = Language::English;
            let log = sample_runs::log(&speeds, atoms);
            let mut cache = SnapshotCache::default();
            let mut jumped = Snapshot::new(&log.header);
            for jump in jumps {
                let records = (jump * (log.records().len() + 3) as f64) as usize;
                cache.seek(&log, records, &mut jumped);
                let mut went = Snapshot::new(&log.header);
                log.records().iter().take(records).for_each(|record| went.apply(record));
                let at = went.state.head();
                prop_assert_eq!(seen(&jumped, at, language), seen(&went, at, language));
            }
        }

        #[test]
        fn late_record_is_not_forgotten(atoms in 100..2000u32, late in 0..50usize, records in 0.0..1.0f64) {
            let language = Language::English;
            let whole = sample_runs::log(&[1.0, 0.5, 0.1], atoms);
            let mut records_in_time = whole.records().to_vec();
            // One record arrives after later ones.
            let held_back = records_in_time.remove((records_in_time.len() / 2).saturating_sub(late));
            let mut log = RunLog::new(whole.header.clone());
            log.add(records_in_time);
            let mut cache = SnapshotCache::default();
            let mut snapshot = Snapshot::new(&whole.header);
            cache.seek(&log, usize::MAX, &mut snapshot);
            let before = log.until(held_back.at);
            log.add(vec![held_back]);
            cache.forget_after(before);
            let records = (records * log.records().len() as f64) as usize;
            let mut went = Snapshot::new(&log.header);
            log.records().iter().take(records).for_each(|record| went.apply(record));
            let at = went.state.head();
            let mut jumped = Snapshot::new(&log.header);
            cache.seek(&log, records, &mut jumped);
            prop_assert_eq!(seen(&jumped, at, language), seen(&went, at, language));
        }
    }

    #[test]
    fn cache_has_bounded_memory() {
        let log = sample_runs::log(&[1.0, 0.7, 0.1], 60_000);
        let mut cache = SnapshotCache::default();
        cache.seek(&log, usize::MAX, &mut Snapshot::new(&log.header));
        let bytes = cache.kept.len() * 60_000 * size_of::<AtomState>();
        assert!(bytes <= MAX_CACHE_BYTES && cache.kept.len() > 3, "{} moments", cache.kept.len());
        assert!(cache.kept.windows(2).all(|pair| pair[1].records - pair[0].records == cache.stride));
    }
}
