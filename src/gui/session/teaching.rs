//! The job that prepares the runs of a lesson, and the change between them.

use std::sync::Arc;

use super::job_result::{JobResult, PreparedLesson, Recorded};
use super::jobs::Jobs;
use super::preview::preview_pixels;
use super::tracing::{TracingJob, TracingProgress};
use super::{DEMONSTRATION, Session};
use crate::driver::PictureCache;
use crate::language::{Language, say};
use crate::lesson::{Lesson, LessonError};
use crate::view::RunView;

/// A lesson that is being prepared; dropping it cancels that.
pub struct PreparingLesson {
    /// The job's number.
    pub job: u64,
    /// How far its pictures are traced.
    pub progress: TracingProgress,
}

impl Session {
    /// Starts the job that runs the runs of a lesson.
    pub fn prepare_lesson(&mut self, lesson: Arc<Lesson>) -> PreparingLesson {
        let progress = TracingProgress::new(lesson.pixels(), self.clock);
        let job = self.jobs.prepare_lesson(lesson, Arc::clone(&self.pictures), progress.job(), self.language);
        PreparingLesson { job, progress }
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
            None if self.prepared.is_some() => self.restart_live(),
            None => self.open(DEMONSTRATION),
        }
    }
}

impl Jobs {
    fn prepare_lesson(
        &mut self,
        lesson: Arc<Lesson>,
        kept: Arc<PictureCache>,
        job: TracingJob,
        language: Language,
    ) -> u64 {
        let number = self.number();
        self.start(language, "lesson", move || {
            let performed = lesson.perform(&kept, &|more| job.add(more), &job.cancel);
            let prepared = performed.and_then(|performed| {
                // If cancelled, nobody waits for the result.
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
