//! What background jobs return to the window.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use super::super::settings::Settings;
use crate::balance::Strategy;
use crate::lesson::Lesson;
use crate::palette::Rgb;
use crate::picture::{Colour, Frame, Quality, Size};
use crate::runlog::{Driver, RunLog};
use crate::scene::Opened;
use crate::sim::PixelCosts;
use crate::study::accuracy::{Point, Reference};
use crate::tracer::{SceneStats, Tracer};
use crate::view::{ComparedRun, Inspected, RunView};

/// What a job has come to.
pub enum JobResult {
    /// The job of this number has read and compiled what was asked for, or says why not.
    Ready(u64, Result<Ready, String>),
    /// A file is written: a sentence says where, or why not.
    Saved(Result<String, String>),
    /// What the job of this number makes is done to this part, 0 to 1.
    Progress(u64, f64),
    /// What the job of this number makes is made: a sentence says where, or why not.
    Made(u64, Result<String, String>),
    /// The user has chosen a file in the system's dialog; `None` if not.
    Chosen(Purpose, Option<PathBuf>),
    /// A small picture of a scene, by the scene's name or path; or why there is none.
    Thumbnail(String, Result<Thumbnail, String>),
    /// The job of this number has found out something about speed and accuracy.
    Found(u64, Finding),
    /// What has come of a comparison, and the number of its job.
    CompareResult(u64, CompareResult),
    /// A lesson that was opened, to be prepared.
    ToTeach(Arc<Lesson>),
    /// A lesson, or a sentence that says why it cannot be shown, and the number of its job.
    Lesson(u64, Result<PreparedLesson, String>),
    /// A pixel, with all that is known of it; nothing if there is no such pixel.
    Inspected(Option<Box<Inspected>>),
    /// What is about seen by a camera that was moved.
    CameraPreview(CameraPreview),
    /// The file that is open has changed, or is gone.
    FileChanged(PathBuf, FileChange),
}

/// What a path is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// To be opened.
    Open,
    /// A lesson, to be taken.
    Learn,
    /// To be written.
    Save,
}

/// What happened to a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileChange {
    /// Somebody has written to it.
    Written,
    /// It is not there any more.
    Gone,
}

/// What can be shown at once.
pub enum Ready {
    /// A scene, compiled.
    Scene(Prepared),
    /// A recorded run, and what traces its picture again.
    Run(Recorded),
    /// A lesson, to be prepared.
    Lesson(Arc<Lesson>),
}

/// A scene, compiled for a picture.
#[derive(Clone)]
pub struct Prepared {
    /// The scene.
    pub opened: Arc<Opened>,
    /// What traces it.
    pub tracer: Arc<Tracer>,
    /// What its picture will about look like.
    pub preview: Arc<[Rgb]>,
    /// Of the picture that it is compiled for.
    pub size: Size,
    /// Of the picture that it is compiled for.
    pub quality: Quality,
    /// The estimated CPU time of the whole picture, traced by threads that rest after each atom.
    pub(super) cpu: Duration,
    /// The estimated time of the whole picture in virtual time.
    pub(super) virtual_time: Duration,
}

/// A recorded run.
#[derive(Clone)]
pub struct Recorded {
    /// Its records.
    pub log: Arc<RunLog>,
    /// Its scene.
    pub opened: Arc<Opened>,
    /// What traces its picture again.
    pub tracer: Arc<Tracer>,
    /// What its picture will about look like.
    pub preview: Arc<[Rgb]>,
    /// What is known of all of it.
    pub known: Arc<RunView>,
}

impl Prepared {
    /// Whether it is compiled for the picture that is set.
    pub fn is_for(&self, settings: &Settings) -> bool {
        (self.size, self.quality) == (settings.size, settings.quality)
    }

    /// The estimated time of the whole picture on the reference machine at full pace.
    pub fn work(&self, driver: Driver) -> Duration {
        if driver == Driver::Sim { self.virtual_time } else { self.cpu }
    }
}

/// A small picture.
pub struct Thumbnail {
    /// Its size.
    pub size: Size,
    /// Its pixels, three bytes each.
    pub rgb: Vec<u8>,
}

/// A picture that is traced once for all trials of it.
pub struct TracedOnce {
    /// All pixels in scan order.
    pub pixels: Vec<Colour>,
    /// What each costs the reference machine, by its rays.
    pub costs: PixelCosts,
}

/// How well strategies do with more and more machines.
pub struct Growth {
    /// By strategy: what comes of more and more machines.
    pub of: Vec<(Strategy, Vec<GrowthPoint>)>,
    /// How long one machine at full speed takes.
    pub alone: Duration,
    /// The last machine is a slow one.
    pub slow: Option<f64>,
}

/// A run of so many machines.
#[derive(Clone, Copy, Debug)]
pub struct GrowthPoint {
    /// How many.
    pub machines: usize,
    /// How many times as long one machine at full speed would take.
    pub speedup: f64,
    /// The ideal makespan over this one.
    pub efficiency: f64,
}

/// What has come of a comparison.
pub enum CompareResult {
    /// The traced picture.
    Picture(Arc<TracedOnce>),
    /// A trial, by its number.
    Run(u64, Box<ComparedRun>),
    /// How strategies do with more machines.
    Growth(Growth),
    /// Nothing comes, for this reason.
    Failed(String),
}

/// What has been found out about speed and accuracy.
pub enum Finding {
    /// What the scene needs, and how many rays there are on each level of its trees of rays.
    Needs(SceneStats, Vec<u64>),
    /// So many of the [`Reference::STEPS`] pictures of the reference have been begun.
    Begun(usize),
    /// What pictures are compared with.
    Reference(Reference),
    /// The quality at this place is measured; its picture comes only the first time.
    Point(usize, Point, Option<Frame>),
    /// Nothing more comes; a sentence says why, if that is too soon.
    Over(Result<(), String>),
}

/// A lesson whose runs have been run.
pub struct PreparedLesson {
    /// What it says.
    pub lesson: Arc<Lesson>,
    /// Its runs, by name.
    pub(super) runs: Vec<(String, Recorded)>,
    /// By step: what its claims came to.
    pub values: Vec<Vec<Option<f64>>>,
}

/// What is about seen by a camera that moves.
pub struct CameraPreview {
    /// Width and height.
    pub size: Size,
    /// All pixels in scan order.
    pub pixels: Arc<[Rgb]>,
}
