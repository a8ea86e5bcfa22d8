//! Progress of a lesson: its step, its answers, and the playback to the end of the step.

use super::rate_for;
use crate::gui::session::{PreparedLesson, Session};
use crate::language::Language;
use crate::lesson::{Step, StepView};
use crate::time::Time;
use crate::view::Subject;

/// Progress of a lesson.
pub struct LessonProgress {
    lesson: PreparedLesson,
    step: usize,
    /// The chosen answer of each step.
    answers: Vec<Option<usize>>,
    /// Name of the lesson's run on the stage, and `Session::runs_begun` when it began.
    run: (String, usize),
    /// Number of records at which the playback stops.
    until: Option<usize>,
    /// New selection for the next frame.
    selection: Option<Option<Subject>>,
}

impl LessonProgress {
    /// Begins a lesson with its first step.
    pub fn begin(lesson: PreparedLesson, session: &mut Session) -> Self {
        let answers = vec![None; lesson.lesson.steps.len()];
        let mut progress = Self { lesson, step: 0, answers, run: (String::new(), 0), until: None, selection: None };
        progress.enter(session);
        progress
    }

    /// Returns the lesson with its runs.
    pub fn lesson(&self) -> &PreparedLesson {
        &self.lesson
    }

    /// Returns the name of the lesson.
    pub fn name(&self) -> &str {
        &self.lesson.lesson.name
    }

    /// Returns the title of the lesson.
    pub fn title(&self, language: Language) -> &str {
        self.lesson.lesson.title.in_language(language)
    }

    /// Returns the index of the step.
    pub fn step(&self) -> usize {
        self.step
    }

    /// Returns the number of steps.
    pub fn steps(&self) -> usize {
        self.lesson.lesson.steps.len()
    }

    /// Whether this is the last step.
    pub fn is_last(&self) -> bool {
        self.step + 1 >= self.steps()
    }

    /// Whether the last step is complete.
    pub fn is_over(&self) -> bool {
        self.is_last() && self.until.is_none() && !self.waits()
    }

    /// Returns a step, by its index.
    pub fn at(&self, step: usize) -> &Step {
        &self.lesson.lesson.steps[step]
    }

    /// Returns the chosen answer of a step's question.
    pub fn answer_of(&self, step: usize) -> Option<usize> {
        self.answers[step]
    }

    /// Returns the text of a step's checked claims; it may be shown only after an answer.
    pub fn checked(&self, step: usize, language: Language) -> Option<String> {
        self.at(step).checked_words(&self.lesson.values[step], language)
    }

    /// Returns the number of right answers, of answers and of questions.
    pub fn score(&self) -> [usize; 3] {
        let questions = || {
            self.lesson
                .lesson
                .steps
                .iter()
                .zip(&self.answers)
                .filter_map(|(step, answer)| Some((step.ask.as_ref()?, *answer)))
        };
        let right = questions().filter(|(question, answer)| *answer == Some(question.right)).count();
        [right, questions().filter(|(_, answer)| answer.is_some()).count(), questions().count()]
    }

    /// Whether the question of the step has no answer yet.
    pub fn waits(&self) -> bool {
        self.now().ask.is_some() && self.answers[self.step].is_none()
    }

    /// Whether the step shows the timeline.
    pub fn wants_timeline(&self) -> bool {
        self.now().look == StepView::Timeline
    }

    /// Answers the question with the answer at this index, and plays to the end of the step.
    pub fn answer(&mut self, index: usize, session: &mut Session) {
        if self.waits() && self.now().ask.as_ref().is_some_and(|question| index < question.answers.len()) {
            self.answers[self.step] = Some(index);
            // The notice may say that an answer is missing.
            session.end_notices();
            self.play(session);
        }
    }

    /// Goes to the end of the step, or from there to the next step. Does nothing while a question has no answer.
    pub fn next(&mut self, session: &mut Session) {
        if self.waits() {
            return;
        }
        if let Some(records) = self.until.take() {
            session.stage_mut().show_after(records);
        } else if !self.is_last() {
            self.step += 1;
            self.enter(session);
        }
    }

    /// Goes to the beginning of the previous step.
    pub fn back(&mut self, session: &mut Session) {
        self.step = self.step.saturating_sub(1);
        self.enter(session);
    }

    /// Stops the playback at the end of the step. Returns the new selection, if it changes.
    pub fn tick(&mut self, session: &mut Session) -> Option<Option<Subject>> {
        if let Some(records) = self.until {
            let stage = session.stage_mut();
            // The user has stopped the time, so the lesson leaves it alone.
            if stage.time.is_paused() {
                self.until = None;
            } else if stage.records_shown() >= records {
                stage.show_after(records);
                self.until = None;
            }
        }
        self.selection.take()
    }

    fn now(&self) -> &Step {
        // A lesson has at least one step, and `step` is always an index of one.
        self.at(self.step)
    }

    /// Enters the step: shows its run where the previous step of the same run has ended.
    fn enter(&mut self, session: &mut Session) {
        let run = self.now().run.clone();
        if self.run != (run.clone(), session.runs_begun()) {
            session.show_lesson_run(&self.lesson, &run);
            self.run = (run.clone(), session.runs_begun());
        }
        let before = self.lesson.lesson.steps[..self.step].iter().rev().take_while(|step| step.run == run);
        let before = before.filter_map(|step| step.until).next();
        let stage = session.stage_mut();
        let records = before.and_then(|until| until.of(&stage.log)).map_or(0, |(records, _)| records);
        stage.show_after(records);
        self.until = None;
        self.selection = Some(self.now().machine.map(Subject::Node));
        if !self.waits() {
            self.play(session);
        }
    }

    /// Plays to the end of the step.
    fn play(&mut self, session: &mut Session) {
        let Some(until) = self.now().until else { return };
        let stage = session.stage_mut();
        let Some((records, subject)) = until.of(&stage.log) else { return };
        let end = records.checked_sub(1).map_or(Time::ZERO, |last| stage.log.records()[last].at);
        let now = stage.lasted();
        if end > now {
            stage.set_rate(rate_for(Time(end.0 - now.0)));
            stage.seek(now, false);
            self.until = Some(records);
        } else {
            stage.show_after(records);
        }
        if self.now().machine.is_none() {
            self.selection = Some(subject.filter(|subject| matches!(subject, Subject::Node(_))));
        }
    }
}
