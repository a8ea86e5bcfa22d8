//! What is taught: a lesson is a text file with runs in virtual time, steps through them, questions to be answered before
//! one sees, and claims that are true of the runs.

mod claim;
mod file;
mod moment;
mod perform;
mod validate;
mod words;

pub use claim::{Claim, ClaimFigure};
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

/// A lesson as it is read from its file.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// Its file's name without its ending.
    pub name: String,
    /// Where its file lies, and scenes that are files beside it; the working directory, if it is no file.
    pub directory: PathBuf,
    /// What it is called.
    pub title: Words,
    /// What it is about, in a line.
    pub about: Words,
    /// The runs that it shows, by name.
    pub runs: BTreeMap<String, RunPlan>,
    /// What is said and shown, one after the other; at least one.
    pub steps: Vec<Step>,
}

/// A run that a lesson shows.
#[derive(Clone, Debug)]
pub struct RunPlan {
    /// A built-in scene, or a scene's file beside the lesson's.
    pub scene: String,
    /// Width and height of the picture.
    pub size: Size,
    /// Pixels in an atom.
    pub atom: u32,
    /// How the atoms are shared.
    pub strategy: Strategy,
    /// The atoms of a farm's part, or the least of a transfer; the strategy's usual if `None`.
    pub part: Option<u32>,
    /// A machine a speed, 0 to 1.
    pub speeds: Vec<f64>,
    /// How many of the machines, the last ones, are off at first and may join.
    pub spares: NodeId,
    /// What the ring that adapts does otherwise than the article's.
    pub remedies: Remedies,
    /// How long a message travels.
    pub latency: Duration,
    /// How long the parent is busy with a message.
    pub handling: Duration,
    /// How long the run would last, had the work been shared perfectly.
    pub lasts: Duration,
    /// What is done to it.
    pub script: Script,
}

/// A step of a lesson.
#[derive(Clone, Debug)]
pub struct Step {
    /// What is said.
    pub say: Words,
    /// Which run is shown.
    pub run: String,
    /// Up to where time goes.
    pub until: Option<Moment>,
    /// Which machine stands out.
    pub machine: Option<NodeId>,
    /// What is looked at.
    pub look: LowerView,
    /// What is asked before one sees.
    pub ask: Option<Question>,
    /// What is claimed.
    pub holds: Vec<Claim>,
}

/// What stands below the picture and the ring.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum LowerView {
    /// The machines.
    #[default]
    Machines,
    /// A lane a machine.
    Timeline,
}

/// A question with answers, one of which is right.
#[derive(Clone, Debug)]
pub struct Question {
    /// What is asked.
    pub question: Words,
    /// What may be answered.
    pub answers: Vec<Words>,
    /// Which of them is right.
    pub right: usize,
    /// Why.
    pub because: Words,
}

/// The lessons that come with the program, in the order in which they are best taken: name and text.
pub const BUILT_IN: [(&str, &str); 14] = [
    ("atoms", include_str!("../../assets/lessons/atoms.ron")),
    ("bands", include_str!("../../assets/lessons/bands.ron")),
    ("farm", include_str!("../../assets/lessons/farm.ron")),
    ("ring", include_str!("../../assets/lessons/ring.ron")),
    ("slow-machine", include_str!("../../assets/lessons/slow-machine.ron")),
    ("sizes", include_str!("../../assets/lessons/sizes.ron")),
    ("limits", include_str!("../../assets/lessons/limits.ron")),
    ("by-speed", include_str!("../../assets/lessons/by-speed.ron")),
    ("crumbs", include_str!("../../assets/lessons/crumbs.ron")),
    ("early", include_str!("../../assets/lessons/early.ron")),
    ("copies", include_str!("../../assets/lessons/copies.ron")),
    ("woken", include_str!("../../assets/lessons/woken.ron")),
    ("shortcuts", include_str!("../../assets/lessons/shortcuts.ron")),
    ("lost-machine", include_str!("../../assets/lessons/lost-machine.ron")),
];
