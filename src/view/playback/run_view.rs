//! Everything that is known of a run by now, whatever moment is shown.

use super::snapshots::Snapshot;
use crate::record::Record;
use crate::runlog::{Header, RunLog};
use crate::view::state::lanes::Lanes;
use crate::view::timeline::markers::Markers;

/// What is known of a run, as a fold over its records.
#[derive(Clone, Debug)]
pub struct RunView {
    /// Its last moment.
    pub latest: Snapshot,
    /// What stands out in its time.
    pub markers: Markers,
    /// What each machine did and when.
    pub lanes: Lanes,
}

impl RunView {
    /// Before anything has happened.
    pub fn new(header: &Header) -> Self {
        Self { latest: Snapshot::new(header), markers: Markers::default(), lanes: Lanes::new(header) }
    }

    /// All of a recorded run.
    pub fn of(log: &RunLog) -> Self {
        let mut view = Self::new(&log.header);
        log.records().iter().for_each(|record| view.apply(record));
        view
    }

    /// Takes in what happened next.
    pub fn apply(&mut self, record: &Record) {
        self.latest.apply(record);
        self.markers.apply(record, &self.latest.state);
        self.lanes.apply(record);
    }
}
