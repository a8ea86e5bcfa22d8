//! The latest state of a run and its history, independent of the shown time.

use super::snapshots::Snapshot;
use crate::record::Record;
use crate::runlog::{Header, RunLog};
use crate::view::state::lanes::Lanes;
use crate::view::timeline::markers::Markers;

/// The latest state, the markers and the lanes of a run, as a fold over its records.
#[derive(Clone, Debug)]
pub struct RunView {
    /// Its latest state.
    pub latest: Snapshot,
    /// Its markers on the time line.
    pub markers: Markers,
    /// What each machine did, and when.
    pub lanes: Lanes,
}

impl RunView {
    /// Starts before the first record.
    pub fn new(header: &Header) -> Self {
        Self { latest: Snapshot::new(header), markers: Markers::default(), lanes: Lanes::new(header) }
    }

    /// Folds all records of a run.
    pub fn of(log: &RunLog) -> Self {
        let mut view = Self::new(&log.header);
        log.records().iter().for_each(|record| view.apply(record));
        view
    }

    /// Takes in the next record.
    pub fn apply(&mut self, record: &Record) {
        self.latest.apply(record);
        self.markers.apply(record, &self.latest.state);
        self.lanes.apply(record);
    }
}
