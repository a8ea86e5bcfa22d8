//! What is shown: one run, and everything that is known of it, at the moment that is looked at.

use std::sync::Arc;
use std::time::Duration;

use super::performer::RunSource;
use crate::driver::Update;
use crate::language::Language;
use crate::palette::{Rgb, node_colours};
use crate::picture::Frame;
use crate::record::Record;
use crate::runlog::{Driver, Header, RunLog};
use crate::time::Time;
use crate::view::{
    Canvas, Details, Lanes, Layer, Markers, Narrator, Playback, RATES, RunState, RunView, Snapshot, SnapshotCache,
    StepUnit, Subject, Summary, step,
};

/// A run, and everything that is known of it.
pub struct Stage {
    /// Whoever performs it.
    pub performer: RunSource,
    /// How far it is.
    pub phase: Phase,
    /// Whether its clock stands still because it was asked to.
    pub paused: bool,
    /// Which machines were asked to stand still.
    pub paused_nodes: Vec<bool>,
    /// Its records so far.
    pub log: RunLog,
    /// Which moment of it is shown.
    pub time: Playback,
    /// Whether what comes after that moment is hidden: who is asked what will happen is not told before.
    pub hides_later: bool,
    /// The picture in linear light.
    pub frame: Frame,
    /// The nodes' colours.
    pub colours: Vec<Rgb>,
    known: RunView,
    /// An earlier moment, if that is shown.
    earlier: Option<Snapshot>,
    /// What is shown is known to be that after so many records, although others have the same time.
    stepped_to: Option<usize>,
    past: SnapshotCache,
    canvas: Canvas,
    result: Option<Summary>,
    /// egui's clock at the last tick, in seconds.
    ticked: Option<f64>,
}

/// How far a run is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Phase {
    /// There is no run yet.
    Preparing,
    /// It goes on, or could.
    Running,
    /// Nothing more happens.
    Finished,
    /// It cannot go on; a sentence says why.
    Failed(String),
}

/// After a run's end time goes on for as long as its last messages are drawn.
const LINGER: Duration = Duration::from_millis(1500);

/// In one frame no more time goes by than this: whoever comes back to a window wants to see what he missed.
const LONGEST_FRAME: Duration = Duration::from_millis(100);

impl Stage {
    /// The beginning of a run that goes on.
    pub fn new(performer: RunSource, header: Header, ground: Rgb) -> Self {
        let colours = node_colours(header.speeds.len());
        Self {
            phase: if matches!(performer, RunSource::Nobody) { Phase::Preparing } else { Phase::Running },
            performer,
            paused: false,
            paused_nodes: vec![false; colours.len()],
            time: Playback::live(),
            hides_later: false,
            known: RunView::new(&header),
            earlier: None,
            stepped_to: None,
            past: SnapshotCache::default(),
            frame: Frame::new(header.size),
            canvas: Canvas::new(header.size, header.division, colours.clone(), ground),
            result: None,
            log: RunLog::new(header),
            colours,
            ticked: None,
        }
    }

    /// A run that was recorded, from its beginning; `known` is what is known of all of it.
    pub fn recorded(performer: RunSource, log: RunLog, known: RunView, ground: Rgb) -> Self {
        let result = Summary::of(&log);
        let mut time = Playback::from_start();
        // A run of no time would be over before anybody looked.
        let length = known.latest.state.head().secs();
        time.set_rate(RATES.iter().rposition(|&rate| rate <= 1.0 && length >= 6.0 * rate).unwrap_or_default());
        let plain = Self::new(performer, log.header.clone(), ground);
        let mut stage = Self { phase: Phase::Finished, log, known, time, result, ..plain };
        stage.show_now();
        stage
    }

    /// Shows what is known of the picture beforehand where nothing is traced yet.
    pub fn show_preview(&mut self, preview: Arc<[Rgb]>) {
        self.canvas.preview(preview, &shown(&self.earlier, &self.known).state);
    }

    /// Takes in what has happened since the last call; `clock` is egui's, in seconds. Returns whether the run has just come
    /// to its end.
    pub fn tick(&mut self, clock: f64) -> bool {
        let passed = Duration::try_from_secs_f64(clock - self.ticked.unwrap_or(clock)).unwrap_or_default();
        self.ticked = Some(clock);
        // One batch for the log, which would else sort its end for each party's.
        let (mut told, mut ends) = (Vec::new(), false);
        while let Some(update) = self.performer.updates().and_then(|updates| updates.try_recv().ok()) {
            match update {
                Update::Records(records) => {
                    records.iter().for_each(|record| self.known.apply(record));
                    told.extend(records);
                }
                Update::Placed { atoms, pixels } => {
                    let division = self.log.header.division;
                    let state = &shown(&self.earlier, &self.known).state;
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
        self.sort_in(told);
        if ends {
            self.result = Summary::of(&self.log);
        }
        self.time.advance(passed.min(LONGEST_FRAME), self.clock(), self.keeps_pace());
        self.show_now();
        ends
    }

    /// The time that is shown.
    pub fn now(&self) -> Time {
        self.time.now()
    }

    /// What is known of the run at the shown time.
    pub fn state(&self) -> &RunState {
        &self.shown().state
    }

    /// The sentences at the shown time.
    pub fn narrator(&self) -> &Narrator {
        &self.shown().narrator
    }

    /// What stands out in its time.
    pub fn signs(&self) -> &Markers {
        &self.known.markers
    }

    /// What each machine did and when, all of it.
    pub fn lanes(&self) -> &Lanes {
        &self.known.lanes
    }

    /// What is known of something, whatever moment is shown.
    pub fn dossier(&mut self, about: Subject, language: Language) -> Details {
        Details::of(about, &self.log, &self.known.lanes, &mut self.past, language)
    }

    /// How many records lie before what is shown.
    pub fn records_shown(&self) -> usize {
        self.shown().records()
    }

    /// The record to which somebody stepped, which is the last that is shown.
    pub fn stepped_to(&self) -> Option<&Record> {
        self.log.records().get(self.stepped_to?.checked_sub(1)?)
    }

    /// What is known of the run by now, whatever is shown.
    pub fn latest(&self) -> &RunState {
        &self.known.latest.state
    }

    /// Whether everything that is known is shown.
    pub fn shows_end(&self) -> bool {
        self.earlier.is_none()
    }

    /// What the run amounts to, where its end is shown.
    pub fn result(&self) -> Option<&Summary> {
        self.result.as_ref().filter(|_| self.shows_end())
    }

    /// The picture as it is shown, after what it is to look like.
    pub fn canvas(&mut self, look: (Layer, f32), ground: Rgb) -> &mut Canvas {
        self.canvas.set_look(look, ground, &shown(&self.earlier, &self.known).state);
        &mut self.canvas
    }

    /// The shown time, which stops when the picture is complete or nothing more happens.
    pub fn lasted(&self) -> Time {
        self.now().min(self.length())
    }

    /// How long the run is, so far.
    pub fn length(&self) -> Time {
        let is_over = matches!(self.phase, Phase::Finished | Phase::Failed(_));
        let end = is_over.then(|| self.known.latest.state.head());
        self.known.latest.state.finished().or(end).unwrap_or_else(|| self.clock())
    }

    /// How exactly times are to be told, as a rate at which time goes: the shorter the run and the slower it is shown, the
    /// more exactly.
    pub fn grain(&self) -> f64 {
        // A run that goes on is not told ever less exactly.
        let by_length = if self.phase == Phase::Running { 1.0 } else { self.length().secs() / 2.0 };
        self.time.rate().min(by_length).clamp(1e-9, 1.0)
    }

    /// Whether the shown time goes on by itself.
    pub fn goes_on(&self) -> bool {
        match self.phase {
            Phase::Running if self.time.is_live() => !self.paused,
            Phase::Preparing | Phase::Failed(_) if self.time.is_live() => false,
            _ => !self.time.is_paused() && self.now() < self.clock(),
        }
    }

    /// Whether the end of a run that is over is shown.
    pub fn is_at_end(&self) -> bool {
        self.phase == Phase::Finished && self.now() >= self.length()
    }

    /// Whether what happens in the run is seen at once.
    pub fn is_live(&self) -> bool {
        self.time.is_live()
    }

    /// Shows another moment.
    pub fn seek(&mut self, time: Time, stands: bool) {
        self.stepped_to = None;
        if time >= self.clock() && self.phase == Phase::Running {
            self.time.follow();
        } else {
            self.time.seek(time.min(self.clock()), stands);
        }
        self.show_now();
    }

    /// Shows what happened next or before, and stands still there. Returns whether there is such a thing.
    pub fn step(&mut self, by: StepUnit, forward: bool) -> bool {
        let Some(records) = step(&self.log, self.records_shown(), by, forward) else { return false };
        self.show_after(records);
        true
    }

    /// Shows the moment after so many records, and stands still there.
    pub fn show_after(&mut self, records: usize) {
        let at =
            records.checked_sub(1).and_then(|last| self.log.records().get(last)).map_or(Time::ZERO, |last| last.at);
        // What is still drawn on its way when the picture is complete would stand still there for good.
        let is_end = records >= self.log.records().len() && self.known.latest.state.finished().is_some();
        self.time.seek(if is_end { self.clock() } else { at }, true);
        self.stepped_to = Some(records);
        self.show_now();
    }

    /// Shows what happens as it happens, or, if nothing more does, the end.
    pub fn follow(&mut self) {
        self.stepped_to = None;
        match self.phase {
            Phase::Running | Phase::Preparing => self.time.follow(),
            Phase::Finished | Phase::Failed(_) => self.time.seek(self.clock(), false),
        }
        self.show_now();
    }

    /// Time goes faster or slower by so many of [`RATES`](crate::view::RATES).
    pub fn change_rate(&mut self, by: isize) {
        self.set_rate(self.time.rate_index().saturating_add_signed(by));
    }

    /// Time goes at one of [`RATES`](crate::view::RATES).
    pub fn set_rate(&mut self, index: usize) {
        self.time.set_rate(index);
        self.performer.set_rate(self.time.rate());
    }

    fn shown(&self) -> &Snapshot {
        shown(&self.earlier, &self.known)
    }

    /// How far the run's own clock has come.
    fn clock(&self) -> Time {
        let end = self.known.latest.state.head() + LINGER.mul_f64(self.time.rate().min(1.0));
        match (&self.performer, &self.phase) {
            (RunSource::Live(run), Phase::Finished | Phase::Failed(_)) => run.now().min(end),
            (RunSource::Live(run), _) => run.now(),
            (RunSource::Recorded(_), _) => end,
            (RunSource::Nobody, _) => Time::ZERO,
        }
    }

    /// In virtual time the run itself goes as fast as is asked.
    fn keeps_pace(&self) -> bool {
        matches!(self.performer, RunSource::Live(_)) && self.log.header.driver == Driver::Sim
    }

    fn sort_in(&mut self, told: Vec<Record>) {
        if told.is_empty() {
            return;
        }
        let same = self.log.add(told);
        self.past.forget_after(same);
        if self.earlier.as_ref().is_some_and(|moment| moment.records() > same) {
            // Told anew by the next look at it.
            (self.earlier, self.stepped_to) = (Some(Snapshot::new(&self.log.header)), None);
        }
    }

    /// Comes to the moment that the shown time asks for.
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
                self.known.latest.state.take_touched();
                self.canvas.show_all(&self.known.latest.state);
            }
        } else if self.earlier.as_ref().is_none_or(|earlier| earlier.records() != records) {
            let is_first = self.earlier.is_none();
            let moment = self.earlier.get_or_insert_with(|| Snapshot::new(&self.log.header));
            let went_on = self.past.seek(&self.log, records, moment);
            if is_first || !went_on {
                moment.state.take_touched();
                self.canvas.show_all(&moment.state);
            }
        }
        let state = &mut self.earlier.as_mut().unwrap_or(&mut self.known.latest).state;
        state.set_rate(self.time.rate());
        for atoms in state.take_touched() {
            self.canvas.show(atoms, state);
        }
    }
}

/// The moment that is shown: of its own, so that what is drawn of it can be changed meanwhile.
fn shown<'a>(earlier: &'a Option<Snapshot>, known: &'a RunView) -> &'a Snapshot {
    earlier.as_ref().unwrap_or(&known.latest)
}
