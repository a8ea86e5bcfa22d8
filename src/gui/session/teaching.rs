//! The job that runs a lesson's runs, and what shows them.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use super::Session;
use super::job_result::{JobResult, PreparedLesson, Recorded};
use super::jobs::Jobs;
use super::preview::guess;
use crate::cancel::CancelToken;
use crate::language::{Language, say};
use crate::lesson::{Lesson, LessonError};
use crate::view::RunView;

/// A lesson that is being prepared.
pub struct PreparingLesson {
    /// The job's number.
    pub job: u64,
    /// How many pixels are traced.
    traced: Arc<AtomicU32>,
    pixels: u32,
}

impl PreparingLesson {
    /// How far it is, 0 to 1.
    pub fn share(&self) -> f32 {
        self.traced.load(Ordering::Relaxed) as f32 / self.pixels.max(1) as f32
    }
}

impl Session {
    /// Runs a lesson's runs in the background.
    pub fn prepare_lesson(&mut self, lesson: Arc<Lesson>) -> PreparingLesson {
        let language = self.language;
        let (traced, pixels) = (Arc::new(AtomicU32::new(0)), lesson.pixels());
        let job = self.jobs.prepare_lesson(lesson, Arc::clone(&traced), language);
        PreparingLesson { job, traced, pixels }
    }

    /// Shows a run of a lesson from its beginning.
    pub fn show_run_of(&mut self, taught: &PreparedLesson, name: &str) {
        if let Some((_, recorded)) = taught.runs.iter().find(|(other, _)| other == name) {
            // Whatever else was on its way to the stage comes too late.
            (self.loading, self.moving) = (None, None);
            self.play(recorded.clone());
        }
    }

    /// The recorded run on the stage, if it is one.
    pub fn recorded(&self) -> Option<Recorded> {
        self.recorded.clone()
    }

    /// After a lesson: this recorded run, or what is set, from the beginning. What was opened meanwhile stays.
    pub fn end_lesson(&mut self, taught: &PreparedLesson, before: Option<Recorded>) {
        let is_taught = |shown: &Recorded| taught.runs.iter().any(|(_, run)| Arc::ptr_eq(&run.tracer, &shown.tracer));
        if !self.recorded.as_ref().is_some_and(is_taught) {
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
            // A lesson's pictures are small, and soon traced.
            let performed = lesson.perform(&done, &CancelToken::default());
            let taught = performed.and_then(|performed| {
                let performed = performed.unwrap_or_default();
                lesson.check_moments(&performed)?;
                let values = lesson.values(&performed);
                let recorded = performed.into_iter().map(|(name, run)| {
                    let known = Arc::new(RunView::of(&run.log));
                    let preview = guess(&run.tracer);
                    (name, Recorded { log: run.log, opened: run.opened, tracer: run.tracer, preview, known })
                });
                Ok(PreparedLesson { runs: recorded.collect(), lesson, values })
            });
            let unshown = |why: LessonError| {
                say!(language, "The lesson cannot be shown: {why}", "A lição não pode ser mostrada: {why}")
            };
            JobResult::Lesson(number, taught.map_err(unshown))
        });
        number
    }
}
