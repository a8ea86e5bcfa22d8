//! Errors of lessons: of their runs, and of their files.

use std::fmt;
use std::time::Duration;

use thiserror::Error;

use super::{MAX_ATOMS, MAX_MACHINES, MAX_SIDE_PX, Moment};
use crate::driver::ThreadError;
use crate::language::Language;
use crate::picture::SizeError;
use crate::ron_file::FileError;
use crate::view::duration;

/// Why a lesson cannot be shown, although its file is valid.
#[derive(Debug, Error)]
pub enum LessonError {
    /// The scene of a run cannot be opened.
    #[error("the run `{run}`: {source}")]
    Scene {
        /// The name of the run.
        run: String,
        /// What is wrong with the scene.
        source: FileError,
    },
    /// The picture of a run cannot be traced.
    #[error("the run `{run}`: {source}")]
    Trace {
        /// The name of the run.
        run: String,
        /// The thread's failure.
        source: ThreadError,
    },
    /// A step goes to a moment that its run does not have.
    #[error("step {step}: {missing}")]
    Moment {
        /// The number of the step, from 1.
        step: usize,
        /// The moment and the run.
        missing: MissingMoment,
    },
}

/// A moment that a run does not have.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("the run `{run}` has no {moment:?}; it lasts {}", lasted(*seconds))]
pub struct MissingMoment {
    /// The name of the run.
    pub run: String,
    /// The moment.
    pub moment: Moment,
    /// How long the run lasts, in seconds.
    pub seconds: f64,
}

fn lasted(seconds: f64) -> String {
    duration(Duration::try_from_secs_f64(seconds).unwrap_or_default(), Language::English)
}

/// An error in a lesson's file, and its place there.
#[derive(Debug, Error)]
#[error("{}{problem}", part.as_ref().map(|part| format!("{part}: ")).unwrap_or_default())]
pub(super) struct InvalidLesson {
    /// The fields that lead to the error, as in [`crate::ron_file::find_path`].
    pub path: Vec<String>,
    /// The run or the step that contains the error, if one does.
    part: Option<Part>,
    problem: Problem,
}

impl InvalidLesson {
    pub fn new(path: &[&str], problem: Problem) -> Self {
        Self { path: path.iter().map(|&field| field.to_owned()).collect(), part: None, problem }
    }

    /// The same error in a run or a step, to which its path is relative.
    pub fn within(self, part: Part) -> Self {
        let outer = match &part {
            Part::Run(name) => ["runs".to_owned(), name.clone()],
            Part::Step(index) => ["steps".to_owned(), index.to_string()],
        };
        Self { path: outer.into_iter().chain(self.path).collect(), part: Some(part), ..self }
    }
}

/// A part of a lesson's file.
#[derive(Debug)]
pub(super) enum Part {
    /// The run of this name.
    Run(String),
    /// The step of this index, from 0.
    Step(usize),
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Run(name) => write!(f, "the run `{name}`"),
            Self::Step(index) => write!(f, "step {}", index + 1),
        }
    }
}

/// What is wrong in a lesson's file.
#[derive(Debug, Error)]
pub(super) enum Problem {
    #[error("a lesson needs at least one run")]
    NoRuns,
    #[error("a lesson needs at least one step")]
    NoSteps,
    #[error("there is no scene `{scene}` beside the lesson, and no built-in one (the built-in names are {known})")]
    NoScene { scene: String, known: String },
    #[error(transparent)]
    Size(#[from] SizeError),
    #[error("a side of the picture can have up to {MAX_SIDE_PX} pixels")]
    LongSide,
    #[error("an atom needs at least one pixel")]
    EmptyAtom,
    #[error("atoms of {0} pixels are too many; there can be up to {MAX_ATOMS}, so make them larger")]
    TooManyAtoms(u32),
    #[error("there can be 1 to {MAX_MACHINES} machines, not {0}")]
    MachineCount(usize),
    #[error(
        "there are {latencies} latencies for {machines} machines; give each machine one, or leave `latencies_ms` out"
    )]
    LatencyCount { latencies: usize, machines: usize },
    #[error("a speed can be 0 to 1")]
    Speed,
    #[error(
        "only an `adaptive` or `farm-leases` run has spare machines: the last of its `speeds`, but not all of them"
    )]
    Spares,
    #[error("only an `adaptive` run has remedies; leave out `without`, or set `strategy: \"adaptive\"`")]
    NoRemedies,
    #[error("a part can be 1 to {MAX_ATOMS} atoms, not {0}")]
    Part(u32),
    #[error("{what} can be {least} to {most}, not {value}")]
    OutOfRange { what: &'static str, least: f64, most: f64, value: f64 },
    #[error("an entry of `script` needs either `speed` or `becomes`")]
    ScriptEntry,
    #[error("there are machines 1 to {machines}, not {machine}")]
    NoMachine { machine: usize, machines: usize },
    #[error("it has no run; add `run:` with the name of one to this step")]
    NoRunNamed,
    #[error("there is no run `{name}`; there are {known}")]
    NoRun { name: String, known: String },
    #[error("a claim needs `at_least` or `at_most`")]
    Unbounded,
    #[error("a question can have 2 to 5 answers, not {0}")]
    AnswerCount(usize),
    #[error("`right` is the number of the right answer, 1 to {answers}, not {right}")]
    RightAnswer { right: usize, answers: usize },
}
