//! The job that prepares the runs of a lesson, and the change between them.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use super::Session;
use super::job_result::{JobResult, PreparedLesson, Recorded};
use super::jobs::Jobs;
use super::preview::preview_pixels;
use crate::cancel::CancelToken;
use crate::language::{Language, say};
use crate::lesson::{Lesson, LessonError};
use crate::view::RunView;

/// A lesson that is being prepared.
pub struct PreparingLesson {
    /// The job's number.
    pub job: u64,
    /// Number of traced pixels.
    traced: Arc<AtomicU32>,
    pixels: u32,
}

impl PreparingLesson {
    /// Returns the share that is done, 0 to 1.
    pub fn share(&self) -> f32 {
        self.traced.load(Ordering::Relaxed) as f32 / self.pixels.max(1) as f32
    }
}

impl Session {
    /// Starts the job that runs the runs of a lesson.
    pub fn prepare_lesson(&mut self, lesson: Arc<Lesson>) -> PreparingLesson {
        let language = self.language;
        let (traced, pixels) = (Arc::new(AtomicU32::new(0)), lesson.pixels());
        let job = self.jobs.prepare_lesson(lesson, Arc::clone(&traced), language);
        PreparingLesson { job, traced, pixels }
    }

    /// Shows a run of a lesson from its beginning.
    pub fn show_lesson_run(&mut self, lesson: &PreparedLesson, name: &str) {
        if let Some((_, recorded)) = lesson.runs.iter().find(|(other, _)| other == name) {
            // Cancels what would replace it on the stage.
            (self.loading, self.camera_move) = (None, None);
            self.play(recorded.clone());
        }
    }

    /// Returns the recorded run on the stage, if there is one.
    pub fn recorded(&self) -> Option<Recorded> {
        self.recorded.clone()
    }

    /// After a lesson, shows the recorded run `before` it, or a new run with the settings. A run that was opened during
    /// the lesson stays.
    pub fn end_lesson(&mut self, lesson: &PreparedLesson, before: Option<Recorded>) {
        let is_of_lesson =
            |shown: &Recorded| lesson.runs.iter().any(|(_, run)| Arc::ptr_eq(&run.tracer, &shown.tracer));
        if !self.recorded.as_ref().is_some_and(is_of_lesson) {
            return;
        }
        match before {
            Some(recorded) => self.play(recorded),
            None if self.prepared.is_some() => {
                self.recorded = None;
                self.restart();
            }
            None => self.open("ten-objects"),
        }
    }
}

impl Jobs {
    fn prepare_lesson(&mut self, lesson: Arc<Lesson>, traced: Arc<AtomicU32>, language: Language) -> u64 {
        let number = self.number();
        self.start(language, "lesson", move || {
            let done = |more| _ = traced.fetch_add(more, Ordering::Relaxed);
            // The pictures of a lesson are small, so the job cannot be cancelled.
            let performed = lesson.perform(&done, &CancelToken::default());
            let prepared = performed.and_then(|performed| {
                let performed = performed.unwrap_or_default();
                lesson.check_moments(&performed)?;
                let values = lesson.values(&performed);
                let recorded = performed.into_iter().map(|(name, run)| {
                    let view = Arc::new(RunView::of(&run.log));
                    let preview = preview_pixels(&run.tracer);
                    (name, Recorded { log: run.log, opened: run.opened, tracer: run.tracer, preview, view })
                });
                Ok(PreparedLesson { runs: recorded.collect(), lesson, values })
            });
            let error = |why: LessonError| {
                say!(
                    language,
                    "The lesson cannot be shown. Correct its file: {why}",
                    "A lição não pode ser mostrada. Corrija seu arquivo: {why}"
                )
            };
            JobResult::LessonPrepared(number, prepared.map_err(error))
        });
        number
    }
}
