//! Runs side by side: the state of each at one time, and its time budget.

use std::sync::Arc;

use super::snapshots::{Snapshot, SnapshotCache};
use crate::language::Language;
use crate::palette::{Rgb, node_colours};
use crate::picture::Colour;
use crate::runlog::RunLog;
use crate::sim::Change;
use crate::time::Time;
use crate::view::analysis::time_budget::TimeBudget;
use crate::view::picture::canvas::Canvas;
use crate::view::picture::overlay::Layer;
use crate::view::state::lanes::Lanes;
use crate::view::text::trial_names::trial_name;

/// One of several finished runs, at the shown time.
#[derive(Clone, Debug)]
pub struct ComparedRun {
    /// The changes that make it of the run that all are compared with.
    changes: Vec<Change>,
    /// All of its records.
    pub log: Arc<RunLog>,
    /// Its time budget; `None` if its picture was never complete.
    pub budget: Option<TimeBudget>,
    /// What each machine did and when.
    pub lanes: Lanes,
    /// Its machines' colours.
    pub colours: Vec<Rgb>,
    cache: SnapshotCache,
    snapshot: Snapshot,
    canvas: Canvas,
}

impl ComparedRun {
    /// Creates a run at its beginning; `pixels` is its whole picture in scan order.
    pub fn new(changes: Vec<Change>, log: Arc<RunLog>, pixels: &[Colour], ground: Rgb) -> Self {
        let header = &log.header;
        let colours = node_colours(header.speeds.len());
        let mut canvas = Canvas::new(header.size, header.division, colours.clone(), ground);
        canvas.take(0..header.division.atoms(), pixels);
        let (snapshot, lanes) = (Snapshot::new(header), Lanes::of(&log));
        canvas.show_all(&snapshot.state);
        Self {
            changes,
            budget: TimeBudget::new(&log, &lanes),
            log,
            lanes,
            colours,
            cache: SnapshotCache::default(),
            snapshot,
            canvas,
        }
    }

    /// Returns its name.
    pub fn name(&self, language: Language) -> String {
        trial_name(&self.log.header.rules.strategy, &self.changes, language)
    }

    /// Returns the length of its record.
    pub fn length(&self) -> Time {
        self.log.end()
    }

    /// Returns when its picture was complete; `None` if never.
    pub fn end(&self) -> Option<Time> {
        self.budget.as_ref().map(|budget| Time::ZERO + budget.makespan)
    }

    /// Returns its state at the shown time.
    pub fn snapshot(&self) -> &Snapshot {
        &self.snapshot
    }

    /// Shows another time.
    pub fn show(&mut self, time: Time) {
        let records = self.log.until(time);
        if records == self.snapshot.records() {
            return;
        }
        if self.cache.seek(&self.log, records, &mut self.snapshot) {
            for atoms in self.snapshot.state.take_touched() {
                self.canvas.show(atoms, &self.snapshot.state);
            }
        } else {
            self.snapshot.state.take_touched();
            self.canvas.show_all(&self.snapshot.state);
        }
    }

    /// Returns its picture with a layer over it, at an opacity of 0 to 1.
    pub fn canvas(&mut self, look: (Layer, f32), ground: Rgb) -> &mut Canvas {
        self.canvas.set_look(look, ground, &self.snapshot.state);
        &mut self.canvas
    }
}

/// Returns the length of the longest run.
pub fn length_of_all(runs: &[ComparedRun]) -> Time {
    runs.iter().map(ComparedRun::length).max().unwrap_or(Time::ZERO)
}

#[cfg(test)]
mod tests {
    use std::ops::Range;

    use super::*;
    use crate::view::tests::sample_runs;

    fn compared_run(speeds: &[f64]) -> ComparedRun {
        let header = sample_runs::header(speeds, 300);
        let mut log = RunLog::new(header.clone());
        log.add(sample_runs::records(&header));
        let pixels = vec![[0.5; 3]; header.size.pixels() as usize];
        ComparedRun::new(Vec::new(), Arc::new(log), &pixels, [0; 3])
    }

    #[test]
    fn run_shows_its_state_at_each_time() {
        let mut shown = compared_run(&[1.0, 0.2]);
        let rows = |shown: &mut ComparedRun| -> Vec<Rgb> {
            let all: Range<u32> = 0..shown.log.header.size.height();
            shown.canvas((Layer::Owners, 0.0), [0; 3]).rows(all).to_vec()
        };
        let end = shown.length();
        shown.show(end);
        let (complete, done) = (rows(&mut shown), shown.snapshot().state.done());
        assert_eq!((done, shown.snapshot().state.finished().is_some()), (300, true));
        assert!(shown.end().is_some_and(|complete| complete <= end));
        shown.show(Time(end.0 / 2));
        assert!((10..290).contains(&shown.snapshot().state.done()));
        assert_ne!(rows(&mut shown), complete);
        shown.show(end);
        assert_eq!(rows(&mut shown), complete);
    }
}
