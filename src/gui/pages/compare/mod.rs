//! The Compare page: runs of one scene side by side in virtual time, and why one takes longer than another.

mod adding;
mod columns;
mod findings;
mod growth;
mod head;
mod lanes;

use std::time::Duration;

use egui::{RichText, Ui, UiBuilder};

use crate::balance::Strategy;
use crate::export::{Comparison, ComparisonEntry};
use crate::gui::input::keys::UserCommand;
use crate::gui::session::{CompareResult, ComparisonSubject, Growth, Phase, Session, TracingProgress};
use crate::gui::widgets::canvas_texture::CanvasTexture;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, word};
use crate::sim::{Change, Trial};
use crate::time::Time;
use crate::view::{ComparedRun, Playback, RATES, TimeWindow, Timeline, trial_name};
use columns::ColumnAction;
use findings::Findings;

/// Most runs of a comparison; more have no room.
const MAX_RUNS: usize = 6;

/// The Compare page.
pub struct Compare {
    open: bool,
    /// `Session::runs_begun` when the subject was taken last.
    run_seen: Option<usize>,
    subject: Option<ComparisonSubject>,
    /// Progress of the job that runs the trials; dropping it cancels the job.
    tracing: Option<TracingProgress>,
    /// Whether the picture of the subject is traced.
    is_traced: bool,
    columns: Vec<CompareColumn>,
    last_id: u64,
    /// Number of the job that runs the trials.
    job: Option<u64>,
    growth: Option<GrowthJob>,
    trouble: Option<String>,
    time: Playback,
    /// Whether the playback rate is set. It depends on the first runs only; added runs do not change it.
    is_paced: bool,
    findings: Findings,
    /// Whether the page has paused the run on the stage.
    holds_run: bool,
}

/// The job that runs the growth curves, and its result.
struct GrowthJob {
    number: u64,
    /// Dropping it cancels the job.
    _tracing: TracingProgress,
    result: Option<Growth>,
}

/// A run of the comparison.
struct CompareColumn {
    id: u64,
    trial: Trial,
    /// Changes of the trial relative to the subject.
    changes: Vec<Change>,
    /// The run of the trial; `None` until it has ended.
    run: Option<Box<ComparedRun>>,
    texture: CanvasTexture,
    /// Cached drawing of the lanes, with its size and its time window.
    lanes: Option<(egui::Vec2, TimeWindow, Timeline)>,
}

impl Default for Compare {
    fn default() -> Self {
        Self {
            open: false,
            run_seen: None,
            subject: None,
            tracing: None,
            is_traced: false,
            columns: Vec::new(),
            last_id: 0,
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
    /// Returns the name of the run.
    fn name(&self, language: Language) -> String {
        trial_name(&self.trial.header.rules.strategy, &self.changes, language)
    }

    /// Whether the run differs from the subject by more than its strategy.
    fn is_fork(&self) -> bool {
        !self.changes.iter().all(|change| matches!(change, Change::Strategy(_)))
    }

    /// Returns the times at which a speed changes.
    fn change_times(&self) -> impl Iterator<Item = Time> {
        self.changes.iter().filter_map(|change| if let Change::SpeedAt(at, ..) = change { Some(*at) } else { None })
    }
}

impl Compare {
    /// Opens or closes the page. While it is open, the run on the stage is paused.
    pub fn toggle(&mut self, session: &mut Session) {
        if self.open {
            return self.close(session);
        }
        (self.open, self.run_seen) = (true, None);
        if session.stage().phase == Phase::Running && !session.stage().paused {
            session.set_run_paused(true);
            self.holds_run = true;
        }
    }

    /// Whether the page is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Closes the page and resumes the run on the stage.
    pub fn close(&mut self, session: &mut Session) {
        self.open = false;
        if !self.is_traced {
            (self.tracing, self.subject) = (None, None);
        }
        if std::mem::take(&mut self.holds_run) && session.stage().paused {
            session.set_run_paused(false);
        }
    }

    /// Returns names and makespans of the finished runs, for tests.
    pub fn runs(&self) -> Vec<(String, Option<Duration>)> {
        let runs = self.columns.iter().filter_map(|column| column.run.as_ref());
        let language = Language::English;
        runs.map(|run| (run.name(language), run.budget.as_ref().map(|budget| budget.makespan))).collect()
    }

    /// Returns the finished runs for an export; `None` until there is one.
    pub fn comparison(&self) -> Option<Comparison> {
        let header = &self.subject.as_ref()?.trial.header;
        let entry = |column: &CompareColumn| {
            let header = &column.trial.header;
            let (strategy, machines) = (header.rules.strategy.clone(), header.speeds.len());
            let account = column.run.as_ref()?.budget.clone();
            Some(ComparisonEntry { strategy, changes: column.changes.clone(), machines, account })
        };
        let (title, size) = (header.title().to_owned(), header.size);
        let runs: Vec<_> = self.columns.iter().filter_map(entry).collect();
        (!runs.is_empty()).then_some(Comparison { title, size, runs })
    }

    /// Takes a result of a job.
    pub fn take(&mut self, job: u64, result: CompareResult) {
        match result {
            CompareResult::Growth(growth) => {
                if let Some(of) = self.growth.as_mut().filter(|of| of.number == job) {
                    of.result = Some(growth);
                }
            }
            // Another comparison was begun meanwhile.
            _ if self.job != Some(job) => {}
            CompareResult::Traced => self.is_traced = true,
            CompareResult::Run(id, run) => {
                if let Some(column) = self.columns.iter_mut().find(|column| column.id == id) {
                    column.run = Some(run);
                    if !self.is_paced {
                        self.time.set_rate(initial_rate(self.length()));
                        self.is_paced = self.columns.iter().all(|column| column.run.is_some());
                    }
                }
            }
            CompareResult::Failed(why) => self.trouble = Some(why),
        }
    }

    /// Executes a command of the playback. Returns whether the command is one.
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
        self.update_subject(session);
        let length = self.length();
        if !self.time.is_paused() && length > Time::ZERO && self.time.now() < length {
            let passed = Duration::from_secs_f32(ui.input(|input| input.stable_dt).min(0.1));
            self.time.advance(passed, length, false);
            ui.ctx().request_repaint_after(Duration::from_millis(33));
        }
        self.heading(ui, session, look);
        ui.add_space(GRID);
        if self.subject.is_none() {
            let is_traced_for_run = session.loading().is_some_and(|loading| loading.traced.share > 0.0);
            let text = if is_traced_for_run {
                word!(
                    language,
                    "The comparison begins when the picture is traced",
                    "A comparação começa quando a imagem está calculada"
                )
            } else {
                word!(language, "Reading and compiling the scene …", "Lendo e compilando a cena …")
            };
            return note(ui, text, look);
        }
        let now = self.time.now();
        for run in self.columns.iter_mut().filter_map(|column| column.run.as_mut()) {
            run.show(now);
        }
        let below = 2.0 * GRID + Findings::height(ui.available_height());
        let pair = &mut self.findings.pair;
        if let Some(action) = columns::show(ui, &mut self.columns, now, length, (pair, below), look, language) {
            self.handle_action(action, session);
        }
        ui.add_space(2.0 * GRID);
        let area = ui.available_rect_before_wrap();
        ui.scope_builder(UiBuilder::new().max_rect(area), |ui| {
            let growth = self.growth.as_ref().and_then(|growth| growth.result.as_ref());
            if let Some(time) = self.findings.show(ui, &mut self.columns, growth, now, length, language) {
                self.time.seek(time, true);
            }
        });
        if self.findings.wants_growth() && self.growth.is_none() {
            self.start_growth(session);
        }
    }

    /// Returns the end of the longest run.
    fn length(&self) -> Time {
        let runs = self.columns.iter().filter_map(|column| column.run.as_ref());
        runs.map(|run| run.length()).max().unwrap_or(Time::ZERO)
    }

    /// Starts a new comparison if the run on the stage is not the present subject.
    fn update_subject(&mut self, session: &mut Session) {
        // While this page is open, the subject can change only with a new run.
        // The run that is being loaded would replace it at once.
        if self.run_seen == Some(session.runs_begun()) || session.loading().is_some() {
            return;
        }
        let Some(subject) = session.subject() else { return };
        self.run_seen = Some(session.runs_begun());
        if self.subject.as_ref().is_some_and(|known| known.is_same_as(&subject)) {
            return;
        }
        let same_picture = self.subject.as_ref().is_some_and(|known| known.has_picture_of(&subject));
        self.is_traced &= same_picture;
        let base = subject.trial.header.rules.strategy.clone();
        let mut strategies = vec![Strategy::Static, Strategy::Farm, Strategy::Ring];
        if !strategies.contains(&base) {
            strategies.insert(0, base.clone());
        }
        self.subject = Some(subject);
        (self.columns, self.growth, self.trouble) = (Vec::new(), None, None);
        let bare = |strategy| if strategy == base { Vec::new() } else { vec![Change::Strategy(strategy)] };
        for changes in strategies.into_iter().map(bare) {
            self.add(changes);
        }
        (self.findings.pair, self.findings.window) = ([0, self.columns.len() - 1], TimeWindow::default());
        (self.time, self.is_paced) = (Playback::from_start(), false);
        self.run(session);
    }

    /// Adds a column: the subject with these changes.
    fn add(&mut self, changes: Vec<Change>) {
        let Some(subject) = &self.subject else { return };
        let trial = changes.iter().fold(subject.trial.clone(), |trial, change| trial.with(change.clone()));
        self.last_id += 1;
        let (texture, lanes) = (CanvasTexture::default(), None);
        self.columns.push(CompareColumn { id: self.last_id, trial, changes, run: None, texture, lanes });
    }

    /// Starts the job that runs the trials without a run.
    fn run(&mut self, session: &mut Session) {
        let Some(subject) = &self.subject else { return };
        let missing = self.columns.iter().filter(|column| column.run.is_none());
        let missing = missing.map(|column| (column.id, column.changes.clone(), column.trial.clone())).collect();
        let (job, tracing) = session.compare(subject, missing);
        (self.job, self.tracing) = (Some(job), Some(tracing));
    }

    /// Starts the job that runs the growth curves, once the picture is traced.
    fn start_growth(&mut self, session: &mut Session) {
        if let Some(subject) = self.subject.as_ref().filter(|_| self.is_traced) {
            let (number, tracing) = session.grow(subject);
            self.growth = Some(GrowthJob { number, _tracing: tracing, result: None });
        }
    }

    /// Executes the action of a column's button.
    fn handle_action(&mut self, action: ColumnAction, session: &mut Session) {
        match action {
            ColumnAction::Remove(index) => {
                self.columns.remove(index);
                let last = self.columns.len() - 1;
                self.findings.pair = self.findings.pair.map(|at| if at > index { at - 1 } else { at }.min(last));
                if self.findings.pair[0] == self.findings.pair[1] {
                    self.findings.pair = [0, last];
                }
            }
            ColumnAction::Fork(index, change) => {
                let mut changes = self.columns[index].changes.clone();
                changes.push(change);
                self.add(changes);
                self.findings.pair = [index, self.columns.len() - 1];
                self.run(session);
            }
        }
    }
}

/// Returns the index of the initial playback rate: at least 1, and fast enough to show the comparison in 25 s.
fn initial_rate(length: Time) -> usize {
    let fits = |&rate: &f64| rate >= 1.0 && length.secs() / rate <= 25.0;
    RATES.iter().position(fits).unwrap_or(RATES.len() - 2).min(RATES.len() - 2)
}

fn note(ui: &mut Ui, text: &str, look: Look) {
    ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet));
}
