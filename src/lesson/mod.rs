//! Lessons: text files with runs in virtual time, steps through these runs, questions that are answered before the
//! result is shown, and claims about the runs, which are checked.

mod claim;
mod claim_words;
mod error;
mod file;
mod moment;
mod perform;
mod words;

pub use claim::{Claim, ClaimFigure};
pub use error::{LessonError, MissingMoment};
pub use file::is_lesson_file;
pub use moment::Moment;
pub use perform::LessonRun;
pub use words::Words;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Duration;

use serde::Deserialize;

use crate::balance::{NodeId, Remedies, Strategy};
use crate::picture::Size;
use crate::scenario::Script;

/// The greatest number of machines of a run; the window can show no more.
const MAX_MACHINES: usize = 32;
/// The greatest number of atoms of a run.
const MAX_ATOMS: u32 = 1 << 18;
/// The longest side of a run's picture.
const MAX_SIDE_PX: u32 = 2048;

/// A lesson as read from its file: its names exist, and its numbers are in their ranges.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// The name of its file without the ending.
    pub name: String,
    /// The directory of its file and of its scene files; empty, which is the working directory, for a built-in lesson.
    pub directory: PathBuf,
    /// The title.
    pub title: Words,
    /// The subject, in one line.
    pub about: Words,
    /// The runs that it shows, by name; at least one.
    pub runs: BTreeMap<String, RunPlan>,
    /// The steps in their order; at least one.
    pub steps: Vec<Step>,
}

/// A run that a lesson shows.
#[derive(Clone, Debug)]
pub struct RunPlan {
    /// The name of a built-in scene, or of a scene file beside the lesson file.
    pub scene: String,
    /// Width and height of the picture.
    pub size: Size,
    /// Pixels in an atom.
    pub atom: u32,
    /// How the atoms are shared.
    pub strategy: Strategy,
    /// Atoms of a farm's part, or the fewest atoms of a transfer; the strategy's default if `None`.
    pub part: Option<u32>,
    /// The speed of each machine, 0 to 1.
    pub speeds: Vec<f64>,
    /// The number of machines, the last ones, that are off at first and may join.
    pub spares: NodeId,
    /// The remedies of the adaptive ring that are in use.
    pub remedies: Remedies,
    /// The latency of each machine, or one for all: a message takes the larger one of its two ends.
    pub latencies: Vec<Duration>,
    /// The time for which the parent is busy with a message.
    pub handling: Duration,
    /// The makespan if the work were shared perfectly.
    pub lasts: Duration,
    /// Commands to the run, in the order of their times.
    pub script: Script,
}

/// A step of a lesson.
#[derive(Clone, Debug)]
pub struct Step {
    /// The text.
    pub say: Words,
    /// The name of the run that is shown.
    pub run: String,
    /// The moment to which the run is played; if `None` it stays at the moment of the step before.
    pub until: Option<Moment>,
    /// The node of the machine that stands out.
    pub machine: Option<NodeId>,
    /// The view beside the picture.
    pub look: StepView,
    /// The question that is answered before the run goes on.
    pub ask: Option<Question>,
    /// The claims about the runs.
    pub holds: Vec<Claim>,
}

/// The view beside the picture in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum StepView {
    /// The ring of machines.
    #[default]
    Machines,
    /// The timeline, with a lane for each machine.
    Timeline,
}

/// A question with answers, one of which is right.
#[derive(Clone, Debug)]
pub struct Question {
    /// The question.
    pub question: Words,
    /// The answers to choose from, two to five.
    pub answers: Vec<Words>,
    /// The index of the right answer, from 0.
    pub right: usize,
    /// The reason, shown after the answer.
    pub because: Words,
}

/// The built-in lessons in the order in which they are best taken: name and text.
pub const BUILT_IN: [(&str, &str); 15] = [
    ("atoms", include_str!("../../assets/lessons/atoms.ron")),
    ("bands", include_str!("../../assets/lessons/bands.ron")),
    ("farm", include_str!("../../assets/lessons/farm.ron")),
    ("ring", include_str!("../../assets/lessons/ring.ron")),
    ("slow-machine", include_str!("../../assets/lessons/slow-machine.ron")),
    ("sizes", include_str!("../../assets/lessons/sizes.ron")),
    ("far", include_str!("../../assets/lessons/far.ron")),
    ("limits", include_str!("../../assets/lessons/limits.ron")),
    ("by-speed", include_str!("../../assets/lessons/by-speed.ron")),
    ("crumbs", include_str!("../../assets/lessons/crumbs.ron")),
    ("early", include_str!("../../assets/lessons/early.ron")),
    ("copies", include_str!("../../assets/lessons/copies.ron")),
    ("woken", include_str!("../../assets/lessons/woken.ron")),
    ("shortcuts", include_str!("../../assets/lessons/shortcuts.ron")),
    ("lost-machine", include_str!("../../assets/lessons/lost-machine.ron")),
];
