//! What is known of a run at one of its moments, and how to come to any other.

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
    /// How many records are known.
    records: usize,
}

impl Snapshot {
    /// Before anything has happened.
    pub fn new(header: &Header) -> Self {
        Self { state: RunState::new(header), narrator: Narrator::default(), records: 0 }
    }

    /// How many records are known.
    pub fn records(&self) -> usize {
        self.records
    }

    /// Takes in what happened next.
    pub fn apply(&mut self, record: &Record) {
        self.state.apply(record);
        self.narrator.apply(record, &self.state);
        self.records += 1;
    }
}

/// The moments of a run that goes on, or of one that is over: any of them is found by going on from one that was kept.
///
/// No moment is further than some thousand records from one that is kept, and what is kept has no more than 64 MiB.
#[derive(Clone, Debug, Default)]
pub struct SnapshotCache {
    /// Every `stride` records, the earliest first; the first is the beginning.
    kept: Vec<Snapshot>,
    stride: usize,
}

/// What all kept moments together may take.
const KEPT_BYTES: usize = 64 << 20;

/// Fewer records than this are told again sooner than a moment is copied.
const SHORTEST: usize = 1024;

impl SnapshotCache {
    /// Comes to the moment after the first `records` records of `log`, or after all if they are fewer. Returns whether
    /// `moment` went on to there, so that its state tells what has changed; else it jumped.
    pub fn go(&mut self, log: &RunLog, records: usize, moment: &mut Snapshot) -> bool {
        let records = records.min(log.records().len());
        self.keep_until(log, records);
        let nearest = self.kept.iter().rfind(|kept| kept.records <= records);
        let jumps_to = nearest.filter(|kept| moment.records > records || moment.records < kept.records);
        if let Some(kept) = jumps_to {
            moment.clone_from(kept);
        }
        for record in &log.records()[moment.records..records] {
            moment.apply(record);
        }
        jumps_to.is_none()
    }

    /// Forgets what was found with more records than these: others were sorted in before them.
    pub fn forget_after(&mut self, records: usize) {
        self.kept.retain(|moment| moment.records <= records);
    }

    fn keep_until(&mut self, log: &RunLog, records: usize) {
        if self.kept.is_empty() {
            let first = Snapshot::new(&log.header);
            self.stride = SHORTEST.max(first.state.atoms() as usize / 8);
            self.kept.push(first);
        }
        let most = (KEPT_BYTES / size_of_val(self.kept[0].state.atom_states()).max(1)).clamp(2, 64);
        // Never empty: the first moment stays.
        while let Some(last) = self.kept.last().filter(|last| last.records + self.stride <= records) {
            let mut next = last.clone();
            log.records()[next.records..next.records + self.stride].iter().for_each(|record| next.apply(record));
            next.state.take_touched();
            self.kept.push(next);
            if self.kept.len() > most {
                self.stride *= 2;
                let stride = self.stride;
                self.kept.retain(|moment| moment.records.is_multiple_of(stride));
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

    /// All that is seen of a moment at its own time.
    fn seen(moment: &Snapshot, at: Time, language: Language) -> String {
        let Snapshot { state, narrator, records } = moment;
        let flights: Vec<_> = state.flights().iter().filter(|flight| flight.gone() > at).collect();
        let events: Vec<_> = narrator.events().collect();
        let sentence = narrator.sentence(state, at, language);
        format!("{records} {:?} {:?} {flights:?} {events:?} {sentence}", state.nodes(), state.atom_states())
    }

    proptest! {
        #[test]
        fn jumping_to_a_moment_and_going_there_show_the_same(
            speeds in prop::collection::vec(0.05..1.0f64, 1..6), atoms in 1..900u32, jumps in prop::collection::vec(0.0..1.0f64, 1..9),
        ) {
        let language = Language::English;
            let log = sample_runs::log(&speeds, atoms);
            let mut past = SnapshotCache::default();
            let mut jumped = Snapshot::new(&log.header);
            for jump in jumps {
                let records = (jump * (log.records().len() + 3) as f64) as usize;
                past.go(&log, records, &mut jumped);
                let mut went = Snapshot::new(&log.header);
                log.records().iter().take(records).for_each(|record| went.apply(record));
                let at = went.state.head();
                prop_assert_eq!(seen(&jumped, at, language), seen(&went, at, language));
            }
        }

        #[test]
        fn what_comes_late_is_not_forgotten(atoms in 100..2000u32, late in 0..50usize, records in 0.0..1.0f64) {
        let language = Language::English;
            let whole = sample_runs::log(&[1.0, 0.5, 0.1], atoms);
            let mut told = whole.records().to_vec();
            // One record is told when later ones already were.
            let held_back = told.remove((told.len() / 2).saturating_sub(late));
            let mut log = RunLog::new(whole.header.clone());
            log.add(told);
            let mut past = SnapshotCache::default();
            let mut moment = Snapshot::new(&whole.header);
            past.go(&log, usize::MAX, &mut moment);
            let before = log.until(held_back.at);
            log.add(vec![held_back]);
            past.forget_after(before);
            let records = (records * log.records().len() as f64) as usize;
            let mut went = Snapshot::new(&log.header);
            log.records().iter().take(records).for_each(|record| went.apply(record));
            let at = went.state.head();
            let mut jumped = Snapshot::new(&log.header);
            past.go(&log, records, &mut jumped);
            prop_assert_eq!(seen(&jumped, at, language), seen(&went, at, language));
        }
    }

    #[test]
    fn what_is_kept_has_a_bound() {
        let log = sample_runs::log(&[1.0, 0.7, 0.1], 60_000);
        let mut past = SnapshotCache::default();
        past.go(&log, usize::MAX, &mut Snapshot::new(&log.header));
        let bytes = past.kept.len() * 60_000 * size_of::<AtomState>();
        assert!(bytes <= KEPT_BYTES && past.kept.len() > 3, "{} moments", past.kept.len());
        assert!(past.kept.windows(2).all(|pair| pair[1].records - pair[0].records == past.stride));
    }
}
