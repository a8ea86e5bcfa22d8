//! Runs of one scene beside each other, in virtual time: pictures that fill in, and why one takes longer than another.

mod adding;
mod columns;
mod findings;
mod growth;
mod head;
mod lanes;

use std::sync::Arc;
use std::time::Duration;

use egui::{RichText, Ui, UiBuilder};

use crate::balance::Strategy;
use crate::export::{Comparison, ComparisonEntry};
use crate::gui::input::keys::UserCommand;
use crate::gui::session::{
    CompareResult, ComparisonSubject, Growth, Phase, PictureSource, Session, TracedOnce, TracingProgress,
};
use crate::gui::widgets::canvas_texture::CanvasTexture;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, word};
use crate::sim::{Change, Trial};
use crate::time::Time;
use crate::view::{ComparedRun, Playback, RATES, Timeline, trial_name};
use findings::Findings;

/// More runs than these nobody can follow, and fewer are no comparison.
const MOST: usize = 6;

/// The page.
pub struct Compare {
    open: bool,
    /// Which run was on the stage when it was last asked what is to be compared.
    seen: Option<usize>,
    subject: Option<ComparisonSubject>,
    tracing: Arc<TracingProgress>,
    pictured: Option<Arc<TracedOnce>>,
    entries: Vec<CompareColumn>,
    /// The next entry's number.
    next: u64,
    /// What is waited for.
    job: Option<u64>,
    growth: Option<(u64, Option<Growth>)>,
    trouble: Option<String>,
    time: Playback,
    /// Whether the rate suits the first runs: those that are added change it no more.
    is_paced: bool,
    findings: Findings,
    /// Whether the run on the stage stands still because of this.
    holds_run: bool,
}

/// One of the runs.
struct CompareColumn {
    id: u64,
    trial: Trial,
    changes: Vec<Change>,
    /// Until the run is known there is none.
    contender: Option<Box<ComparedRun>>,
    texture: CanvasTexture,
    lanes: Option<(egui::Vec2, Time, Timeline)>,
}

impl Default for Compare {
    fn default() -> Self {
        Self {
            open: false,
            seen: None,
            subject: None,
            tracing: Arc::default(),
            pictured: None,
            entries: Vec::new(),
            next: 0,
            job: None,
            growth: None,
            trouble: None,
            time: Playback::from_start(),
            is_paced: false,
            findings: Findings::default(),
            holds_run: false,
        }
    }
}

impl CompareColumn {
    fn name(&self, language: Language) -> String {
        trial_name(self.trial.header.rules.strategy, &self.changes, language)
    }

    /// Whether more is changed of it than who shares.
    fn is_fork(&self) -> bool {
        !self.changes.iter().all(|change| matches!(change, Change::Strategy(_)))
    }

    /// When it parts from the run that it is a fork of.
    fn parts(&self) -> impl Iterator<Item = Time> {
        self.changes.iter().filter_map(|change| if let Change::SpeedAt(at, ..) = change { Some(*at) } else { None })
    }
}

impl Compare {
    /// Opens the page, or closes it.
    pub fn toggle(&mut self, session: &mut Session) {
        if self.open {
            return self.close(session);
        }
        (self.open, self.seen) = (true, None);
        if session.stage().phase == Phase::Running && !session.stage().paused {
            session.set_run_paused(true);
            self.holds_run = true;
        }
    }

    /// Whether the page is to be shown.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Closes it; the run on the stage goes on.
    pub fn close(&mut self, session: &mut Session) {
        self.open = false;
        if self.pictured.is_none() {
            self.tracing.give_up();
            self.subject = None;
        }
        if std::mem::take(&mut self.holds_run) && session.stage().paused {
            session.set_run_paused(false);
        }
    }

    /// Names and makespans of the runs that are known, for tests.
    pub fn runs(&self) -> Vec<(String, Option<Duration>)> {
        let known = self.entries.iter().filter_map(|entry| entry.contender.as_ref());
        known.map(|known| (known.name.clone(), known.budget.as_ref().map(|account| account.makespan))).collect()
    }

    /// The runs that are known, for a file; nothing until there is one.
    pub fn comparison(&self) -> Option<Comparison> {
        let header = &self.subject.as_ref()?.trial.header;
        let run = |entry: &CompareColumn| {
            let header = &entry.trial.header;
            let (strategy, machines) = (header.rules.strategy, header.speeds.len());
            let account = entry.contender.as_ref()?.budget.clone();
            Some(ComparisonEntry { strategy, changes: entry.changes.clone(), machines, account })
        };
        let (title, size) = (header.title().to_owned(), header.size);
        let runs: Vec<_> = self.entries.iter().filter_map(run).collect();
        (!runs.is_empty()).then_some(Comparison { title, size, runs })
    }

    /// Takes in what a job has come to.
    pub fn take(&mut self, job: u64, compared: CompareResult) {
        match compared {
            CompareResult::Growth(growth) => {
                if let Some((_, known)) = self.growth.as_mut().filter(|(asked, _)| *asked == job) {
                    *known = Some(growth);
                }
            }
            // Another comparison was begun meanwhile.
            _ if self.job != Some(job) => {}
            CompareResult::Picture(pictured) => self.pictured = Some(pictured),
            CompareResult::Run(id, contender) => {
                if let Some(entry) = self.entries.iter_mut().find(|entry| entry.id == id) {
                    entry.contender = Some(contender);
                    if !self.is_paced {
                        self.time.set_rate(usual_rate(self.length()));
                        self.is_paced = self.entries.iter().all(|entry| entry.contender.is_some());
                    }
                }
            }
            CompareResult::Failed(why) => self.trouble = Some(why),
        }
    }

    /// Does what a key asks for, if it is meant for this page.
    pub fn handle_command(&mut self, command: UserCommand) -> bool {
        match command {
            UserCommand::Pause if self.time.now() >= self.length() => self.time.seek(Time::ZERO, false),
            UserCommand::Pause => self.time.set_paused(!self.time.is_paused()),
            UserCommand::Rate(faster) => self.time.change_rate(if faster { 1 } else { -1 }),
            UserCommand::SetRate(index) => self.time.set_rate(index),
            UserCommand::Beginning => self.time.seek(Time::ZERO, true),
            UserCommand::Live => self.time.seek(self.length(), true),
            _ => return false,
        }
        true
    }

    /// Shows the page.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let language = session.language();
        let look = Look::of(ui.ctx());
        self.keep_up(session);
        let length = self.length();
        if !self.time.is_paused() && length > Time::ZERO && self.time.now() < length {
            let passed = Duration::from_secs_f32(ui.input(|input| input.stable_dt).min(0.1));
            self.time.advance(passed, length, false);
            ui.ctx().request_repaint_after(Duration::from_millis(33));
        }
        self.heading(ui, session, look);
        ui.add_space(GRID);
        if self.subject.is_none() {
            note(
                ui,
                word!(language, "The scene is being read and compiled …", "A cena está sendo lida e compilada …"),
                look,
            );
            return;
        }
        let now = self.time.now();
        for contender in self.entries.iter_mut().filter_map(|entry| entry.contender.as_mut()) {
            contender.show(now);
        }
        if let Some(asked) = {
            let below = 2.0 * GRID + Findings::height(ui.available_height());
            columns::show(ui, &mut self.entries, now, length, (&mut self.findings.pair, below), look, language)
        } {
            self.do_with(asked, session);
        }
        ui.add_space(2.0 * GRID);
        let area = ui.available_rect_before_wrap();
        ui.scope_builder(UiBuilder::new().max_rect(area), |ui| {
            let growth = self.growth.as_ref().and_then(|(_, growth)| growth.as_ref());
            if let Some(time) = self.findings.show(ui, &mut self.entries, growth, now, length, look, language) {
                self.time.seek(time, true);
            }
        });
        if self.findings.wants_growth() && self.growth.is_none() {
            self.ask_for_growth(session);
        }
    }

    /// When the last run is over.
    fn length(&self) -> Time {
        let known = self.entries.iter().filter_map(|entry| entry.contender.as_ref());
        known.map(|contender| contender.length()).max().unwrap_or(Time::ZERO)
    }

    /// Compares what is on the stage, unless that is what is compared.
    fn keep_up(&mut self, session: &mut Session) {
        // Nothing else changes what is on the stage while this page lies over it.
        if self.seen == Some(session.runs_begun()) {
            return;
        }
        let Some(subject) = session.subject() else { return };
        self.seen = Some(session.runs_begun());
        if self.subject.as_ref().is_some_and(|known| known.is_like(&subject)) {
            return;
        }
        let same_picture = self.subject.as_ref().is_some_and(|known| known.has_picture_of(&subject));
        self.pictured = self.pictured.take().filter(|_| same_picture);
        let base = subject.trial.header.rules.strategy;
        let mut strategies = vec![Strategy::Static, Strategy::Farm, Strategy::Ring];
        if !strategies.contains(&base) {
            strategies.insert(0, base);
        }
        self.subject = Some(subject);
        (self.entries, self.growth, self.trouble) = (Vec::new(), None, None);
        let bare = |strategy| if strategy == base { Vec::new() } else { vec![Change::Strategy(strategy)] };
        for changes in strategies.into_iter().map(bare) {
            self.add(changes);
        }
        self.findings.pair = [0, self.entries.len() - 1];
        (self.time, self.is_paced) = (Playback::from_start(), false);
        self.run(session);
    }

    /// One more run, which is the subject with these changes.
    fn add(&mut self, changes: Vec<Change>) {
        let Some(subject) = &self.subject else { return };
        let trial = changes.iter().fold(subject.trial.clone(), |trial, &change| trial.with(change));
        self.next += 1;
        let (texture, lanes) = (CanvasTexture::default(), None);
        self.entries.push(CompareColumn { id: self.next, trial, changes, contender: None, texture, lanes });
    }

    /// Runs what has not been run.
    fn run(&mut self, session: &mut Session) {
        let language = session.language();
        let Some(subject) = &self.subject else { return };
        let missing = self.entries.iter().filter(|entry| entry.contender.is_none());
        let missing = missing.map(|entry| (entry.id, entry.name(language), entry.trial.clone())).collect();
        let known = match &self.pictured {
            Some(pictured) => PictureSource::Picture(Arc::clone(pictured)),
            None => {
                self.tracing.give_up();
                self.tracing = Arc::default();
                PictureSource::Nothing(Arc::clone(&self.tracing))
            }
        };
        self.job = Some(session.compare(subject, known, missing));
    }

    fn ask_for_growth(&mut self, session: &mut Session) {
        if let (Some(subject), Some(pictured)) = (&self.subject, &self.pictured) {
            self.growth = Some((session.grow(subject, Arc::clone(pictured)), None));
        }
    }

    fn do_with(&mut self, asked: columns::ColumnAction, session: &mut Session) {
        match asked {
            columns::ColumnAction::Remove(place) => {
                self.entries.remove(place);
                let last = self.entries.len() - 1;
                self.findings.pair = self.findings.pair.map(|at| if at > place { at - 1 } else { at }.min(last));
                if self.findings.pair[0] == self.findings.pair[1] {
                    self.findings.pair = [0, last];
                }
            }
            columns::ColumnAction::Fork(place, change) => {
                let mut changes = self.entries[place].changes.clone();
                changes.push(change);
                self.add(changes);
                self.findings.pair = [place, self.entries.len() - 1];
                self.run(session);
            }
        }
    }
}

/// How fast so long a comparison is shown at first: no slower than time goes, and in some twenty seconds.
fn usual_rate(length: Time) -> usize {
    let fits = |&rate: &f64| rate >= 1.0 && length.secs() / rate <= 25.0;
    RATES.iter().position(fits).unwrap_or(RATES.len() - 2).min(RATES.len() - 2)
}

fn note(ui: &mut Ui, text: &str, look: Look) {
    ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet));
}
