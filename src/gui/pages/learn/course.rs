//! A lesson that is being taken: which step, what was answered, and how far time has come.

use super::rate_for;
use crate::gui::session::{PreparedLesson, Session};
use crate::language::Language;
use crate::lesson::{LowerView, Question, Step};
use crate::time::Time;
use crate::view::Subject;

/// A lesson that is being taken.
pub struct LessonProgress {
    taught: PreparedLesson,
    step: usize,
    /// By step: what was answered.
    answers: Vec<Option<usize>>,
    /// Which run is on the stage, and how often runs were begun when it came there.
    run: (String, usize),
    /// Time goes on until so many records have happened.
    until: Option<usize>,
    /// What stands out from now on.
    points: Option<Option<Subject>>,
}

impl LessonProgress {
    /// Begins with the first step.
    pub fn begin(taught: PreparedLesson, session: &mut Session) -> Self {
        let answers = vec![None; taught.lesson.steps.len()];
        let mut course = Self { taught, step: 0, answers, run: (String::new(), 0), until: None, points: None };
        course.enter(session);
        course
    }

    /// The lesson, with its runs.
    pub fn taught(&self) -> &PreparedLesson {
        &self.taught
    }

    /// The lesson's name.
    pub fn name(&self) -> &str {
        &self.taught.lesson.name
    }

    /// What it is called.
    pub fn title(&self, language: Language) -> &str {
        self.taught.lesson.title.in_language(language)
    }

    /// Which step, from 0, and how many there are.
    pub fn step(&self) -> usize {
        self.step
    }

    /// How many steps there are.
    pub fn steps(&self) -> usize {
        self.taught.lesson.steps.len()
    }

    /// Whether no step follows.
    pub fn is_last(&self) -> bool {
        self.step + 1 >= self.steps()
    }

    /// Whether all is seen.
    pub fn is_over(&self) -> bool {
        self.is_last() && self.until.is_none() && !self.waits()
    }

    /// What is said.
    pub fn say(&self, language: Language) -> &str {
        self.now().say.in_language(language)
    }

    /// What is asked, and what was answered.
    pub fn question(&self) -> Option<(&Question, Option<usize>)> {
        self.now().ask.as_ref().map(|question| (question, self.answers[self.step]))
    }

    /// What its claims came to, which is told only after an answer.
    pub fn checked(&self, language: Language) -> Option<String> {
        self.now().checked_words(&self.taught.values[self.step], language)
    }

    /// Whether an answer is waited for.
    pub fn waits(&self) -> bool {
        self.question().is_some_and(|(_, answer)| answer.is_none())
    }

    /// Whether this step wants the timeline.
    pub fn wants_timeline(&self) -> bool {
        self.now().look == LowerView::Timeline
    }

    /// Answers the question; then one sees.
    pub fn answer(&mut self, place: usize, session: &mut Session) {
        if self.question().is_some_and(|(question, answer)| answer.is_none() && place < question.answers.len()) {
            self.answers[self.step] = Some(place);
            // That an answer was waited for, for instance.
            session.end_notice();
            self.go(session);
        }
    }

    /// The next step; whoever is in a hurry first comes to the end of this one. A question is to be answered before.
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

    /// The step before, from its beginning.
    pub fn back(&mut self, session: &mut Session) {
        self.step = self.step.saturating_sub(1);
        self.enter(session);
    }

    /// Lets time come to where it is to stand still.
    pub fn tick(&mut self, session: &mut Session) -> Option<Option<Subject>> {
        if let Some(records) = self.until {
            let stage = session.stage_mut();
            // Whoever takes time in his own hand is not hindered.
            if stage.time.is_paused() {
                self.until = None;
            } else if stage.records_shown() >= records {
                stage.show_after(records);
                self.until = None;
            }
        }
        self.points.take()
    }

    fn now(&self) -> &Step {
        // There is at least one, and the step is one of them.
        &self.taught.lesson.steps[self.step]
    }

    /// Comes to a step: its run, and where the step before has led to in it.
    fn enter(&mut self, session: &mut Session) {
        let run = self.now().run.clone();
        if self.run != (run.clone(), session.runs_begun()) {
            session.show_run_of(&self.taught, &run);
            self.run = (run.clone(), session.runs_begun());
        }
        let before = self.taught.lesson.steps[..self.step].iter().rev().take_while(|step| step.run == run);
        let before = before.filter_map(|step| step.until).next();
        let stage = session.stage_mut();
        let records = before.and_then(|until| until.of(&stage.log)).map_or(0, |(records, _)| records);
        stage.show_after(records);
        self.until = None;
        self.points = Some(self.now().machine.map(Subject::Node));
        if !self.waits() {
            self.go(session);
        }
    }

    /// Time goes on to where the step leads.
    fn go(&mut self, session: &mut Session) {
        let Some(until) = self.now().until else { return };
        let stage = session.stage_mut();
        let Some((records, about)) = until.of(&stage.log) else { return };
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
            self.points = Some(about.filter(|about| matches!(about, Subject::Node(_))));
        }
    }
}
