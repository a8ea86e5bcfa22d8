//! What is shown: one run, and everything that is known of it.

use crate::driver::Update;
use crate::palette::{Rgb, node_colour};
use crate::picture::Frame;
use crate::runlog::{Header, RunLog, Tally};
use crate::time::Time;
use crate::tracer::Tracer;
use crate::view::{Canvas, Narrator, Outcome, RunState, parts_words, result_words};

use super::performer::Performer;

/// A run, and everything that is known of it.
pub struct Stage {
    /// Whoever performs it.
    pub performer: Performer,
    /// How far it is.
    pub phase: Phase,
    /// Its clock, as of the last tick: everything in a frame shows the same time.
    pub now: Time,
    /// Whether its clock stands still because it was asked to.
    pub paused: bool,
    /// Which machines were asked to stand still.
    pub paused_nodes: Vec<bool>,
    /// Its records so far.
    pub log: RunLog,
    /// What is known of it.
    pub state: RunState,
    /// The sentences.
    pub narrator: Narrator,
    /// The picture in linear light.
    pub frame: Frame,
    canvas: Canvas,
    /// What the finished run amounts to.
    pub outcome: Option<Outcome>,
    /// The same in words.
    pub result: String,
    /// Who did most and least of it.
    pub parts: String,
    /// The nodes' colours.
    pub colours: Vec<Rgb>,
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

impl Stage {
    /// The beginning of a run.
    pub fn new(performer: Performer, header: Header, ground: Rgb) -> Self {
        let nodes = header.speeds.len();
        let colours: Vec<_> = (0..nodes).map(|node| node_colour(node, nodes)).collect();
        Self {
            phase: if matches!(performer, Performer::Nobody) { Phase::Preparing } else { Phase::Running },
            performer,
            now: Time::ZERO,
            paused: false,
            paused_nodes: vec![false; nodes],
            state: RunState::new(&header),
            narrator: Narrator::default(),
            frame: Frame::new(header.size),
            canvas: Canvas::new(header.size, header.division, colours.clone(), ground),
            outcome: None,
            result: String::new(),
            parts: String::new(),
            log: RunLog::new(header),
            colours,
        }
    }

    /// Shows what is known of the picture beforehand where nothing is traced yet.
    pub fn show_preview(&mut self, tracer: &Tracer) {
        if let Some(preview) = tracer.preview() {
            self.canvas.preview(|x, y| preview.guess(x, y), &self.state);
        }
    }

    /// Takes in what has happened since the last call. Returns whether the run has just come to its end.
    pub fn tick(&mut self) -> bool {
        self.now = self.performer.now();
        // One batch for the log, which would else sort its end for each party's.
        let (mut told, mut ends) = (Vec::new(), false);
        while let Some(update) = self.performer.updates().and_then(|updates| updates.try_recv().ok()) {
            match update {
                Update::Records(records) => {
                    for record in &records {
                        self.state.apply(record);
                        self.narrator.apply(record, &self.state);
                    }
                    told.extend(records);
                }
                Update::Placed { atoms, pixels } => {
                    let division = self.log.header.division;
                    for (range, (place, colours)) in atoms.iter().zip(division.placed(&atoms, &pixels)) {
                        self.frame.place(place, colours);
                        self.canvas.place(range.clone(), colours);
                        self.canvas.paint(range.clone(), &self.state);
                    }
                }
                Update::Rays(_) => {}
                Update::Finished => {
                    self.phase = Phase::Finished;
                    ends = true;
                }
                Update::Failed(why) => self.phase = Phase::Failed(why),
            }
        }
        self.log.add(told);
        if ends {
            self.outcome = outcome(&self.log);
            // Sums over all atoms, so not for every frame.
            self.result = self.outcome.map(|outcome| result_words(&self.state, &outcome)).unwrap_or_default();
            self.parts = parts_words(&self.state).unwrap_or_default();
        }
        for atoms in self.state.take_touched() {
            self.canvas.paint(atoms, &self.state);
        }
        ends
    }

    /// The picture as it is shown, after what it is to look like.
    pub fn canvas(&mut self, blend: f32, ground: Rgb) -> &mut Canvas {
        self.canvas.set_look(blend, ground, &self.state);
        &mut self.canvas
    }

    /// The run's clock; it stops when the picture is complete, or nothing more happens.
    pub fn lasted(&self) -> Time {
        let end = (self.phase == Phase::Finished).then(|| self.state.head());
        self.state.finished().or(end).unwrap_or(self.now)
    }
}

/// What the run amounts to, if it came to its end.
fn outcome(log: &RunLog) -> Option<Outcome> {
    let tally = Tally::of(log);
    let (makespan, ideal, efficiency) = (tally.makespan()?, tally.ideal()?, tally.efficiency()?);
    Some(Outcome { makespan, ideal, efficiency, spread: tally.finish_spread() })
}
