//! Results of the background jobs.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use super::super::settings::Settings;
use crate::balance::Strategy;
use crate::lesson::Lesson;
use crate::palette::Rgb;
use crate::picture::{Frame, Quality, Size};
use crate::runlog::{Driver, RunLog};
use crate::scene::Opened;
use crate::study::accuracy::{Point, Reference};
use crate::tracer::{SceneStats, Tracer};
use crate::view::{ComparedRun, Inspected, RunView};

/// Result of a job; the number is the job's.
pub enum JobResult {
    /// A scene, run or lesson is read and compiled, or a sentence says why not.
    Ready(u64, Result<Ready, String>),
    /// A job without a number could not begin, for this reason.
    Failed(String),
    /// Share of an export that is done, 0 to 1.
    Progress(u64, f64),
    /// An export has ended: a sentence with the file's path, or the reason why it failed.
    Exported(u64, Result<String, String>),
    /// The preview of a file, `None` if it is no picture, or the reason why there is none.
    ExportPreviewed(u64, Result<Option<ExportPreview>, String>),
    /// The file dialog has closed; `None` if it was cancelled or is not available.
    Chosen(Purpose, Option<PathBuf>),
    /// The thumbnail of a scene, by the scene's name or path, or the reason why there is none.
    Thumbnail(PathBuf, Result<Thumbnail, String>),
    /// A part of the measurement of speed and accuracy.
    Found(u64, Finding),
    /// A part of a comparison.
    Compared(u64, CompareResult),
    /// A lesson was opened; its runs still have to be prepared.
    LessonOpened(Arc<Lesson>),
    /// A lesson is prepared, or a sentence says why it cannot be shown.
    LessonPrepared(u64, Result<PreparedLesson, String>),
    /// The inspected pixel; `None` if the picture has no such pixel.
    Inspected(Option<Box<Inspected>>),
    /// A coarse picture from a moved camera.
    CameraPreview(CameraPreview),
    /// The open file has changed or was deleted.
    FileChanged(PathBuf, FileChange),
}

/// Purpose of a file dialog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Open a scene, a run or a lesson.
    Open,
    /// Open a lesson.
    Learn,
    /// Choose the file to write.
    Save,
}

/// Change of a watched file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileChange {
    /// Its content has changed.
    Written,
    /// The file was deleted or moved.
    Gone,
}

/// What a job has read and compiled.
pub enum Ready {
    /// A compiled scene; its picture is traced if the run will be in virtual time.
    Scene(Prepared),
    /// The same compiled scene as before, whose picture is traced now.
    Traced(Prepared),
    /// A recorded run and its tracer.
    Run(Recorded),
    /// A lesson.
    Lesson(Arc<Lesson>),
}

/// A scene compiled for a picture.
#[derive(Clone)]
pub struct Prepared {
    /// The scene.
    pub opened: Arc<Opened>,
    /// Its tracer.
    pub tracer: Arc<Tracer>,
    /// Coarse picture, all pixels in scan order.
    pub preview: Arc<[Rgb]>,
    /// Size of the picture that it is compiled for.
    pub size: Size,
    /// Quality of the picture that it is compiled for.
    pub quality: Quality,
    /// Estimated CPU time of the whole picture, traced by threads that sleep after each atom.
    pub(super) cpu: Duration,
    /// Estimated time of the whole picture in virtual time.
    pub(super) virtual_time: Duration,
}

/// A recorded run.
#[derive(Clone)]
pub struct Recorded {
    /// Its records.
    pub log: Arc<RunLog>,
    /// Its scene.
    pub opened: Arc<Opened>,
    /// Tracer of its picture.
    pub tracer: Arc<Tracer>,
    /// Coarse picture, all pixels in scan order.
    pub preview: Arc<[Rgb]>,
    /// The view of the complete run.
    pub view: Arc<RunView>,
}

impl Prepared {
    /// Whether it is compiled for the picture of these settings.
    pub fn is_for(&self, settings: &Settings) -> bool {
        (self.size, self.quality) == (settings.size, settings.quality)
    }

    /// Returns the estimated time of the whole picture on the reference machine at full pace.
    pub fn work(&self, driver: Driver) -> Duration {
        if driver == Driver::Sim { self.virtual_time } else { self.cpu }
    }
}

/// Small picture of a scene.
pub struct Thumbnail {
    /// Its size.
    pub size: Size,
    /// Its pixels, three bytes each.
    pub rgb: Vec<u8>,
}

/// What a file will show, with fewer pixels.
pub struct ExportPreview {
    /// Its size.
    pub size: Size,
    /// Its pixels, three bytes each, in scan order.
    pub rgb: Vec<u8>,
    /// Width and height of the file: in pixels, or in the units of a drawing.
    pub whole: [u32; 2],
}

/// Speedup and efficiency of the strategies over the number of machines.
pub struct Growth {
    /// For each strategy its points by number of machines.
    pub curves: Vec<(Strategy, Vec<GrowthPoint>)>,
    /// Makespan of one machine at full speed.
    pub alone: Duration,
    /// Speed of the last machine, if it is slow.
    pub slow: Option<f64>,
}

/// Result of one run.
#[derive(Clone, Copy, Debug)]
pub struct GrowthPoint {
    /// Number of machines.
    pub machines: usize,
    /// Makespan of one machine at full speed / makespan of this run.
    pub speedup: f64,
    /// Ideal makespan / makespan.
    pub efficiency: f64,
}

/// A part of a comparison.
pub enum CompareResult {
    /// The picture is traced.
    Traced,
    /// The run of a trial, by the number of its column.
    Run(u64, Box<ComparedRun>),
    /// Speedup and efficiency over the number of machines.
    Growth(Growth),
    /// The job failed for this reason.
    Failed(String),
}

/// A part of the measurement of speed and accuracy.
pub enum Finding {
    /// Statistics of the compiled scene, and the number of rays on each level of the trees of rays.
    Needs(SceneStats, Vec<u64>),
    /// Number of the reference's [`Reference::STEPS`] pictures that have been begun.
    Begun(usize),
    /// The reference picture.
    Reference(Reference),
    /// The quality at this index is measured. Its picture comes only with its first measurement.
    Point(usize, Point, Option<Frame>),
    /// The measurement has ended; a sentence gives the reason, if it failed.
    Over(Result<(), String>),
}

/// A lesson with its runs.
pub struct PreparedLesson {
    /// The text of the lesson.
    pub lesson: Arc<Lesson>,
    /// Its runs by name.
    pub(super) runs: Vec<(String, Recorded)>,
    /// For each step the values of its claims.
    pub values: Vec<Vec<Option<f64>>>,
}

/// A coarse picture from a moved camera: every `step`-th pixel of every `step`-th row.
pub struct CameraPreview {
    /// Width and height of the whole picture.
    pub size: Size,
    /// The distance between traced pixels.
    pub step: u32,
    /// The numbers of columns and of rows with traced pixels.
    pub shape: (u32, u32),
    /// The traced pixels in scan order.
    pub pixels: Vec<Rgb>,
}
