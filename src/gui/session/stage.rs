//! The run on the stage, at the shown time.

use std::sync::Arc;
use std::time::Duration;

use super::run_source::RunSource;
use crate::driver::Update;
use crate::language::Language;
use crate::palette::{Rgb, node_colours};
use crate::picture::Frame;
use crate::record::Record;
use crate::runlog::{Driver, Header, RunLog};
use crate::time::Time;
use crate::view::{
    Canvas, Details, Lanes, Layer, Markers, Narrator, Playback, RATES, RunState, RunView, Snapshot, SnapshotCache,
    StepUnit, Subject, Summary, TimeScale, step,
};

/// A run with its records, its picture and the shown time.
pub struct Stage {
    /// Source of records and pixels.
    pub source: RunSource,
    /// Whether it runs.
    pub phase: Phase,
    /// Whether the user has paused its clock.
    pub paused: bool,
    /// Whether the user has paused each machine.
    pub paused_nodes: Vec<bool>,
    /// Header and records so far.
    pub log: RunLog,
    /// The shown time and its rate.
    pub time: Playback,
    /// Whether everything after the shown time is hidden, as in a lesson, which asks what will happen.
    pub hides_later: bool,
    /// The picture in linear light.
    pub frame: Frame,
    /// The nodes' colours.
    pub colours: Vec<Rgb>,
    view: RunView,
    /// Snapshot of the shown moment, unless that is the latest.
    earlier: Option<Snapshot>,
    /// Number of records before the shown moment after a step; several records can have the same time.
    stepped_to: Option<usize>,
    snapshots: SnapshotCache,
    canvas: Canvas,
    result: Option<Summary>,
    /// egui's clock at the last tick, in seconds.
    ticked: Option<f64>,
}

/// Phase of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Phase {
    /// There is no run yet.
    Preparing,
    /// The run goes on or is paused.
    Running,
    /// The run has ended.
    Finished,
    /// The run failed; a sentence gives the reason.
    Failed(String),
}

/// Time for which the clock continues after the end of a run, so that its last messages arrive on the screen.
const LINGER: Duration = Duration::from_millis(1500);

/// Most time that passes in one frame. A window that was hidden continues where it was.
const LONGEST_FRAME: Duration = Duration::from_millis(100);

impl Stage {
    /// Creates the stage of a live run.
    pub fn new(source: RunSource, header: Header, ground: Rgb) -> Self {
        let colours = node_colours(header.speeds.len());
        Self {
            phase: if matches!(source, RunSource::None) { Phase::Preparing } else { Phase::Running },
            source,
            paused: false,
            paused_nodes: vec![false; colours.len()],
            time: Playback::live(),
            hides_later: false,
            view: RunView::new(&header),
            earlier: None,
            stepped_to: None,
            snapshots: SnapshotCache::default(),
            frame: Frame::new(header.size),
            canvas: Canvas::new(header.size, header.division, colours.clone(), ground),
            result: None,
            log: RunLog::new(header),
            colours,
            ticked: None,
        }
    }

    /// Creates the stage of a recorded run at its beginning; `view` is that of the complete run.
    pub fn recorded(source: RunSource, log: RunLog, view: RunView, ground: Rgb) -> Self {
        let result = Summary::of(&log);
        let mut time = Playback::from_start();
        // A short run is shown slower, or it would end at once.
        let length = view.latest.state.head().secs();
        time.set_rate(RATES.iter().rposition(|&rate| rate <= 1.0 && length >= 6.0 * rate).unwrap_or_default());
        let plain = Self::new(source, log.header.clone(), ground);
        let mut stage = Self { phase: Phase::Finished, log, view, time, result, ..plain };
        stage.show_now();
        stage
    }

    /// Shows the coarse preview where nothing is traced yet.
    pub fn show_preview(&mut self, preview: Arc<[Rgb]>) {
        self.canvas.preview(preview);
    }

    /// Applies the updates since the last call and advances the shown time; `clock` is egui's, in seconds. Returns
    /// whether the run has just ended.
    pub fn tick(&mut self, clock: f64) -> bool {
        let passed = Duration::try_from_secs_f64(clock - self.ticked.unwrap_or(clock)).unwrap_or_default();
        self.ticked = Some(clock);
        // The log sorts its end once for all parties' records.
        let (mut new_records, mut ends) = (Vec::new(), false);
        while let Some(update) = self.source.updates().and_then(|updates| updates.try_recv().ok()) {
            match update {
                Update::Records(records) => {
                    records.iter().for_each(|record| self.view.apply(record));
                    new_records.extend(records);
                }
                Update::Placed { atoms, pixels } => {
                    let division = self.log.header.division;
                    let state = &shown(&self.earlier, &self.view).state;
                    for (range, (place, colours)) in atoms.iter().zip(division.placed(&atoms, &pixels)) {
                        self.frame.place(place, colours);
                        self.canvas.take(range.clone(), colours);
                        self.canvas.show(range.clone(), state);
                    }
                }
                Update::Rays(_) => {}
                Update::Finished => {
                    ends = self.phase == Phase::Running;
                    self.phase = Phase::Finished;
                }
                Update::Failed(error) => self.phase = Phase::Failed(error.to_string()),
            }
        }
        self.sort_in(new_records);
        if ends {
            self.result = Summary::of(&self.log);
        }
        self.time.advance(passed.min(LONGEST_FRAME), self.clock(), self.keeps_pace());
        self.show_now();
        ends
    }

    /// Returns the shown time.
    pub fn now(&self) -> Time {
        self.time.now()
    }

    /// Returns the state of the run at the shown time.
    pub fn state(&self) -> &RunState {
        &self.shown().state
    }

    /// Returns the narrator at the shown time.
    pub fn narrator(&self) -> &Narrator {
        &self.shown().narrator
    }

    /// Returns the markers on the time line.
    pub fn markers(&self) -> &Markers {
        &self.view.markers
    }

    /// Returns the lanes of the whole run so far.
    pub fn lanes(&self) -> &Lanes {
        &self.view.lanes
    }

    /// Returns the details of a subject, independent of the shown time.
    pub fn details(&mut self, subject: Subject, language: Language) -> Details {
        Details::of(subject, &self.log, &self.view.lanes, &mut self.snapshots, language)
    }

    /// Returns the number of records before the shown moment.
    pub fn records_shown(&self) -> usize {
        self.shown().records()
    }

    /// Returns the record that the last step led to; it is the last one shown.
    pub fn stepped_to(&self) -> Option<&Record> {
        self.log.records().get(self.stepped_to?.checked_sub(1)?)
    }

    /// Returns the latest state of the run, independent of the shown time.
    pub fn latest(&self) -> &RunState {
        &self.view.latest.state
    }

    /// Whether the latest state is shown.
    pub fn shows_end(&self) -> bool {
        self.earlier.is_none()
    }

    /// Returns the summary of the run while its end is shown.
    pub fn result(&self) -> Option<&Summary> {
        self.result.as_ref().filter(|_| self.shows_end())
    }

    /// Returns the canvas of the picture, drawn with this layer and its share (0 to 1).
    pub fn canvas(&mut self, look: (Layer, f32), ground: Rgb) -> &mut Canvas {
        self.canvas.set_look(look, ground, &shown(&self.earlier, &self.view).state);
        &mut self.canvas
    }

    /// Returns the shown time, at most the length of the run.
    pub fn lasted(&self) -> Time {
        self.now().min(self.length())
    }

    /// Returns the length of the run so far.
    pub fn length(&self) -> Time {
        let is_over = matches!(self.phase, Phase::Finished | Phase::Failed(_));
        let end = is_over.then(|| self.view.latest.state.head());
        self.view.latest.state.finished().or(end).unwrap_or_else(|| self.clock())
    }

    /// Returns unit and precision of the run's times.
    pub fn time_scale(&self) -> TimeScale {
        /// Length that a run is taken to have while it goes on: unit and decimals do not change as it gets longer.
        const USUAL_RUN_S: f64 = 10.0;
        TimeScale::of_length(match self.phase {
            Phase::Running => Time::from_secs(USUAL_RUN_S),
            Phase::Preparing | Phase::Finished | Phase::Failed(_) => self.length(),
        })
    }

    /// Returns the same scale, precise enough to follow the run at its playback rate.
    pub fn playback_scale(&self) -> TimeScale {
        self.time_scale().at_rate(self.time.rate())
    }

    /// Whether the shown time advances.
    pub fn goes_on(&self) -> bool {
        match self.phase {
            Phase::Running if self.time.is_live() => !self.paused,
            Phase::Preparing | Phase::Failed(_) if self.time.is_live() => false,
            _ => !self.time.is_paused() && self.now() < self.clock(),
        }
    }

    /// Whether the run has ended and its end is shown.
    pub fn is_at_end(&self) -> bool {
        self.phase == Phase::Finished && self.now() >= self.length()
    }

    /// Whether the shown time follows the run.
    pub fn is_live(&self) -> bool {
        self.time.is_live()
    }

    /// Shows the run at `time`; `paused` stops the shown time there.
    pub fn seek(&mut self, time: Time, paused: bool) {
        self.stepped_to = None;
        if time >= self.clock() && self.phase == Phase::Running {
            self.time.follow();
        } else {
            self.time.seek(time.min(self.clock()), paused);
        }
        self.show_now();
    }

    /// Shows the next or the last event, atom or lap and stops there. Returns whether there is one.
    pub fn step(&mut self, by: StepUnit, forward: bool) -> bool {
        let Some(records) = step(&self.log, self.records_shown(), by, forward) else { return false };
        self.show_after(records);
        true
    }

    /// Shows the moment after this many records and stops there.
    pub fn show_after(&mut self, records: usize) {
        let at =
            records.checked_sub(1).and_then(|last| self.log.records().get(last)).map_or(Time::ZERO, |last| last.at);
        // At the end the last messages have to arrive on the screen.
        let is_end = records >= self.log.records().len() && self.view.latest.state.finished().is_some();
        self.time.seek(if is_end { self.clock() } else { at }, true);
        self.stepped_to = Some(records);
        self.show_now();
    }

    /// Follows the run, or shows its end.
    pub fn follow(&mut self) {
        self.stepped_to = None;
        match self.phase {
            Phase::Running | Phase::Preparing => self.time.follow(),
            Phase::Finished | Phase::Failed(_) => self.time.seek(self.clock(), false),
        }
        self.show_now();
    }

    /// Changes the playback rate by this many steps of [`RATES`](crate::view::RATES).
    pub fn change_rate(&mut self, by: isize) {
        self.set_rate(self.time.rate_index().saturating_add_signed(by));
    }

    /// Sets the playback rate to this entry of [`RATES`](crate::view::RATES).
    pub fn set_rate(&mut self, index: usize) {
        self.time.set_rate(index);
        self.source.set_rate(self.time.rate());
    }

    fn shown(&self) -> &Snapshot {
        shown(&self.earlier, &self.view)
    }

    /// Returns the time of the run's own clock.
    fn clock(&self) -> Time {
        let end = self.view.latest.state.head() + LINGER.mul_f64(self.time.rate().min(1.0));
        match (&self.source, &self.phase) {
            (RunSource::Live(run), Phase::Finished | Phase::Failed(_)) => run.now().min(end),
            (RunSource::Live(run), _) => run.now(),
            (RunSource::Recorded(_), _) => end,
            (RunSource::None, _) => Time::ZERO,
        }
    }

    /// Whether the run's own clock has the playback rate, as in virtual time.
    fn keeps_pace(&self) -> bool {
        matches!(self.source, RunSource::Live(_)) && self.log.header.driver == Driver::Sim
    }

    /// Adds records to the log in order of time, and drops the snapshots after the first of them.
    fn sort_in(&mut self, records: Vec<Record>) {
        if records.is_empty() {
            return;
        }
        let same = self.log.add(records);
        self.snapshots.forget_after(same);
        if self.earlier.as_ref().is_some_and(|moment| moment.records() > same) {
            // The next show_now() builds it again.
            (self.earlier, self.stepped_to) = (Some(Snapshot::new(&self.log.header)), None);
        }
    }

    /// Brings snapshot and canvas to the shown time.
    fn show_now(&mut self) {
        if !self.time.is_paused() {
            self.stepped_to = None;
        }
        let records = match self.stepped_to {
            Some(records) => records,
            _ if self.time.is_live() => usize::MAX,
            _ => self.log.until(self.now()),
        };
        if records >= self.log.records().len() {
            if self.earlier.take().is_some() {
                self.view.latest.state.take_touched();
                self.canvas.show_all(&self.view.latest.state);
            }
        } else if self.earlier.as_ref().is_none_or(|earlier| earlier.records() != records) {
            let is_first = self.earlier.is_none();
            let moment = self.earlier.get_or_insert_with(|| Snapshot::new(&self.log.header));
            let went_on = self.snapshots.seek(&self.log, records, moment);
            if is_first || !went_on {
                moment.state.take_touched();
                self.canvas.show_all(&moment.state);
            }
        }
        let state = &mut self.earlier.as_mut().unwrap_or(&mut self.view.latest).state;
        state.set_rate(self.time.rate());
        for atoms in state.take_touched() {
            self.canvas.show(atoms, state);
        }
    }
}

/// Returns the shown snapshot. A function of the two fields, so that the canvas can be borrowed mutably beside it.
fn shown<'a>(earlier: &'a Option<Snapshot>, view: &'a RunView) -> &'a Snapshot {
    earlier.as_ref().unwrap_or(&view.latest)
}
