//! The run on the stage, the settings and the background jobs. This is the only module of `gui` with threads, channels
//! and clocks: those of runs are behind [`RunSource`], all others in [`jobs`].

mod comparing;
mod export_file;
mod export_preview;
mod exporting;
mod failing;
mod files;
mod inspecting;
mod job_result;
mod jobs;
mod loading;
mod measuring;
mod moving;
mod notice;
pub mod opening;
mod preparing;
mod preview;
mod run_source;
mod stage;
mod teaching;
mod timing;
mod tracing;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use super::settings::undo::{Gesture, Step, UndoHistory};
use super::settings::{Settings, milliseconds};
use crate::balance::NodeId;
use crate::driver::PictureCache;
use crate::language::{Language, say, word};
use crate::palette::Rgb;
use crate::parallel::cores;
use crate::runlog::Header;
use crate::scenario::Command;
use crate::scene::{Opened, built_in};
use crate::time::Time;

pub use comparing::ComparisonSubject;
pub use export_file::{Export, PictureExport};
use exporting::ExportJob;
pub use exporting::ExportProgress;
pub use failing::only_live_words;
use inspecting::Inspecting;
use job_result::Ready;
pub use job_result::{
    CameraPreview, CompareResult, ExportPreview, Finding, Growth, GrowthPoint, JobResult, Prepared, PreparedLesson,
    Purpose, Recorded, Thumbnail,
};
use jobs::Jobs;
use loading::Loading;
pub use loading::LoadingProgress;
use moving::CameraMove;
use notice::Notices;
pub use notice::{Notice, NoticeCause, NoticeKind};
use run_source::RunSource;
pub use stage::{Phase, Stage};
pub use teaching::PreparingLesson;
pub use tracing::{TracedShare, TracingProgress};

/// The run on the stage, the settings and the background jobs.
pub struct Session {
    stage: Stage,
    settings: Settings,
    history: UndoHistory,
    /// The scene of live runs; `None` until the first one is compiled.
    prepared: Option<Prepared>,
    /// The recorded run, if one is on the stage.
    recorded: Option<Recorded>,
    loading: Option<Loading>,
    /// The settings of the run on the stage, while the next run is loaded with other settings.
    settings_before: Option<Settings>,
    /// Whether the run on the stage waits while the next one is loaded.
    holds_run: bool,
    /// The pictures that were traced last for virtual time.
    pictures: Arc<PictureCache>,
    inspecting: Inspecting,
    camera_move: Option<CameraMove>,
    /// Number of preview jobs in progress.
    camera_jobs: usize,
    jobs: Jobs,
    /// Runs that were told to stop and whose threads have not all ended.
    ending: Vec<RunSource>,
    runs_begun: usize,
    /// Number of measurements that have not ended, cancelled ones included.
    measurements: usize,
    notices: Notices,
    /// Files that are being written, or wait for that.
    exports: Vec<ExportJob>,
    /// File for the records of each run (`--log`).
    log_path: Option<PathBuf>,
    /// Recently opened files, the latest first.
    recent: Vec<PathBuf>,
    /// The file that could not be opened, and why, until a file is opened or its notice is closed.
    unopened: Option<(PathBuf, String)>,
    /// Whether a changed scene is reloaded without a question.
    always_reload: bool,
    /// Background colour of the picture.
    ground: Rgb,
    /// While the time is dragged: whether it was stopped before.
    dragged_from: Option<bool>,
    /// The language of the window.
    language: Language,
    /// egui's clock, in seconds.
    clock: f64,
}

/// Name of the built-in scene of the demonstration.
pub const DEMONSTRATION: &str = "ten-objects";

impl Session {
    /// Creates a session with an empty stage; the caller has to open a scene.
    pub fn new(settings: Settings, log_path: Option<PathBuf>, ctx: &egui::Context, ground: Rgb) -> Self {
        let header = settings.header("", "", Duration::ZERO, cores());
        Self {
            stage: Stage::new(RunSource::None, header, ground),
            settings,
            history: UndoHistory::default(),
            prepared: None,
            recorded: None,
            loading: None,
            settings_before: None,
            holds_run: false,
            pictures: Arc::default(),
            inspecting: Inspecting::default(),
            camera_move: None,
            camera_jobs: 0,
            jobs: Jobs::new(ctx.clone()),
            ending: Vec::new(),
            runs_begun: 0,
            measurements: 0,
            notices: Notices::default(),
            exports: Vec::new(),
            log_path,
            recent: Vec::new(),
            unopened: None,
            always_reload: false,
            ground,
            dragged_from: None,
            language: Language::default(),
            clock: 0.0,
        }
    }

    /// Returns the language of the window.
    pub fn language(&self) -> Language {
        self.language
    }

    /// Sets the language of the window.
    pub fn set_language(&mut self, language: Language) {
        self.language = language;
    }

    /// Ends the run and starts a new one with the present settings. A recorded run starts again.
    pub fn restart(&mut self) {
        if let Some(recorded) = self.recorded.clone() {
            return self.play(recorded);
        }
        self.restart_live();
    }

    /// Updates the stage and handles the results of jobs since the last call; `clock` is egui's, in seconds. Returns
    /// the results that are for the pages and the save sheet.
    pub fn tick(&mut self, clock: f64) -> Vec<JobResult> {
        self.clock = clock;
        if self.stage.tick(clock) {
            self.write_log();
        }
        self.ending.retain(|source| !source.has_ended());
        self.notices.expire(clock);
        let mut others = Vec::new();
        for result in self.jobs.results() {
            match result {
                JobResult::Ready(job, ready) if self.loading.as_ref().is_some_and(|loading| loading.job == job) => {
                    let file = self.loading.take().and_then(|loading| loading.file);
                    if file.is_some() && ready.is_ok() {
                        self.unopened = None;
                        self.notices.end(NoticeCause::File);
                    }
                    match ready {
                        Ok(Ready::Scene(prepared)) => self.show_scene(prepared),
                        Ok(Ready::Traced(prepared)) => self.begin(prepared),
                        Ok(Ready::Run(recorded)) => self.open_recorded(recorded),
                        Ok(Ready::Lesson(lesson)) => others.push(JobResult::LessonOpened(lesson)),
                        Err(why) => self.report_unopened(file, why),
                    }
                }
                // Another file was opened meanwhile.
                JobResult::Ready(..) => {}
                JobResult::Failed(why) => self.trouble(why),
                JobResult::Progress(job, share) => self.take_progress(job, share),
                JobResult::Exported(job, result) => self.take_exported(job, result),
                JobResult::FileChanged(path, change) => self.file_changed(&path, change),
                JobResult::Found(job, finding) => {
                    self.measurements -= usize::from(matches!(finding, Finding::Over(_)));
                    others.push(JobResult::Found(job, finding));
                }
                JobResult::Inspected(inspected) => self.take_inspected(inspected),
                JobResult::CameraPreview(preview) => self.take_camera_preview(preview),
                result @ (JobResult::Chosen(..)
                | JobResult::Thumbnail(..)
                | JobResult::ExportPreviewed(..)
                | JobResult::Compared(..)
                | JobResult::LessonOpened(..)
                | JobResult::LessonPrepared(..)) => others.push(result),
            }
        }
        others
    }

    /// Changes the settings, and restarts the run if the change needs it. Shows a notice if a value is impossible.
    pub fn change(&mut self, gesture: Gesture, change: impl FnOnce(&mut Settings)) {
        let language = self.language;
        let mut settings = self.settings.clone();
        change(&mut settings);
        if settings == self.settings || self.is_recorded() {
            return;
        }
        if let Err(why) = settings.check(language) {
            return self.trouble(why);
        }
        self.history.push(self.settings.clone(), gesture);
        let before = self.apply(settings);
        if self.settings.needs_restart(&before) {
            let now = self.settings.difference(&before, language);
            self.note(say!(language, "Restarted with: {now}", "Reiniciada com: {now}"));
        }
    }

    /// Ends the present gesture: the next change is undone separately.
    pub fn end_gesture(&mut self) {
        self.history.end_gesture();
    }

    /// Undoes the last change of the settings.
    pub fn undo(&mut self) {
        let language = self.language;
        if let Some(step) = self.history.undo(&self.settings, self.opened_scene()) {
            let before = self.apply_step(step);
            let now = self.settings.difference(&before, language);
            self.note(say!(language, "Undone. Now: {now}", "Desfeito. Agora: {now}"));
        }
    }

    /// Makes the undone change again.
    pub fn redo(&mut self) {
        let language = self.language;
        if let Some(step) = self.history.redo(&self.settings, self.opened_scene()) {
            let before = self.apply_step(step);
            let now = self.settings.difference(&before, language);
            self.note(say!(language, "Redone. Now: {now}", "Refeito. Agora: {now}"));
        }
    }

    /// Brings back the demonstration: the first settings, its scene and its camera, in one change.
    pub fn show_demonstration(&mut self) {
        let (language, settings) = (self.language, Settings::default());
        let Some(present) = self.opened_scene().filter(|_| !self.is_recorded()) else { return };
        let text = built_in(DEMONSTRATION).unwrap_or_default();
        match Opened::from_text(DEMONSTRATION, text) {
            Ok(opened) if present.path.is_some() || present.text != opened.text => {
                self.history.push_scene(self.settings.clone(), present);
                self.apply_step(Step { settings, scene: Some(Arc::new(opened)) });
                self.note(word!(
                    language,
                    "Back to the demonstration; Ctrl Z undoes it",
                    "De volta à demonstração; Ctrl Z desfaz"
                ));
            }
            _ => self.change(Gesture::Once, |now| *now = settings),
        }
    }

    /// Pauses or resumes a machine.
    pub fn toggle_node_pause(&mut self, node: NodeId) {
        if self.stage.phase != Phase::Running {
            return;
        }
        self.return_to_present();
        if let Some(paused) = self.stage.paused_nodes.get_mut(usize::from(node)) {
            *paused = !*paused;
            self.stage.source.command(Command::Pause { node, paused: *paused });
        }
    }

    /// Returns the run on the stage.
    pub fn stage(&self) -> &Stage {
        &self.stage
    }

    /// Returns the run on the stage, to seek in it or to draw its picture.
    pub fn stage_mut(&mut self) -> &mut Stage {
        &mut self.stage
    }

    /// Returns the settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Returns the header of the run on the stage.
    pub fn header(&self) -> &Header {
        &self.stage.log.header
    }

    /// Returns the compiled scene of live runs.
    pub fn prepared(&self) -> Option<&Prepared> {
        self.prepared.as_ref()
    }

    fn opened_scene(&self) -> Option<Arc<Opened>> {
        self.prepared.as_ref().map(|prepared| Arc::clone(&prepared.opened))
    }

    /// Returns the scene of live runs.
    pub fn opened(&self) -> Option<&Opened> {
        self.prepared.as_ref().map(|prepared| &*prepared.opened)
    }

    /// Whether a recorded run is on the stage.
    pub fn is_recorded(&self) -> bool {
        self.recorded.is_some()
    }

    /// Returns the shown time; it does not change within a frame.
    pub fn now(&self) -> Time {
        self.stage.now()
    }

    /// Returns the speed of a machine: in the present of a live run the one that is set, else the recorded one at the
    /// shown time.
    pub fn speed(&self, node: NodeId) -> f64 {
        let index = usize::from(node);
        let recorded = || self.stage.state().nodes().get(index).map_or(0.0, |node| node.speed);
        let shows_past = match self.stage.phase {
            Phase::Running => !self.stage.is_live(),
            _ => !self.stage.shows_end(),
        };
        if self.is_recorded() || shows_past {
            recorded()
        } else {
            self.settings.all_speeds().nth(index).unwrap_or_else(recorded)
        }
    }

    /// Whether a machine is paused: in a live run now, in a recorded one at the shown time.
    pub fn is_node_paused(&self, node: NodeId) -> bool {
        let index = usize::from(node);
        if self.is_recorded() {
            self.stage.state().nodes().get(index).is_some_and(|node| node.paused)
        } else {
            self.stage.paused_nodes.get(index).copied().unwrap_or(false)
        }
    }

    /// Returns the undo history.
    pub fn history(&self) -> &UndoHistory {
        &self.history
    }

    /// Returns the jobs, to start file dialogs and thumbnails.
    pub fn jobs(&self) -> &Jobs {
        &self.jobs
    }

    /// Returns the notice to be read now.
    pub fn notice(&self) -> Option<&Notice> {
        self.notices.shown()
    }

    /// Returns the number of notices that wait behind it.
    pub fn notices_waiting(&self) -> usize {
        self.notices.waiting()
    }

    /// Closes the shown notice. A file that could not be opened is given up with its notice.
    pub fn close_notice(&mut self) {
        self.notices.close();
        if !self.notices.has(NoticeCause::File) && self.unopened.take().is_some() {
            self.watch_file();
        }
    }

    /// Closes the notices about the present run.
    pub fn end_notices(&mut self) {
        self.notices.end(NoticeCause::Run);
    }

    /// Shows a notice that disappears by itself.
    pub fn note(&mut self, text: impl Into<String>) {
        self.notices.add(Notice::new(text, NoticeKind::Note, NoticeCause::Run, self.clock));
    }

    /// Shows an error about the present run, which stays until it is closed.
    pub fn trouble(&mut self, text: impl Into<String>) {
        self.notices.add(Notice::new(text, NoticeKind::Trouble, NoticeCause::Run, self.clock));
    }

    /// Returns how many runs have begun.
    pub fn runs_begun(&self) -> usize {
        self.runs_begun
    }

    /// Returns how many stopped runs still have threads.
    pub fn runs_ending(&self) -> usize {
        self.ending.len()
    }

    /// Returns how many measurements have not ended, cancelled ones included; for tests.
    pub fn measurements(&self) -> usize {
        self.measurements
    }

    /// Applies a step of the undo history. Returns the settings before.
    fn apply_step(&mut self, Step { settings, scene }: Step) -> Settings {
        let Some(scene) = scene else { return self.apply(settings) };
        self.return_to_present();
        let before = std::mem::replace(&mut self.settings, settings);
        self.settings_before.get_or_insert_with(|| before.clone());
        self.camera_move = None;
        self.load_scene(scene);
        before
    }

    /// Applies new settings to the run, restarting it if needed. Returns the settings before.
    fn apply(&mut self, settings: Settings) -> Settings {
        self.return_to_present();
        let before = std::mem::replace(&mut self.settings, settings);
        if self.settings.needs_restart(&before) {
            self.settings_before.get_or_insert_with(|| before.clone());
            self.restart();
        } else {
            self.send_changes(&before);
        }
        before
    }

    /// Sends the changes of the settings that take effect at once to the run.
    fn send_changes(&mut self, before: &Settings) {
        let speeds = self.settings.all_speeds().zip(before.all_speeds());
        for (node, (speed, _)) in (0..).zip(speeds).filter(|(_, (speed, before))| speed != before) {
            self.stage.source.command(Command::Speed { node, speed });
        }
        if self.settings.latency != before.latency {
            self.stage.source.command(Command::Latency(self.settings.latency_time()));
        }
        for party in self.settings.parties() {
            let latency = self.settings.own_link(party).latency;
            if latency != before.own_link(party).latency {
                let latency = latency.map(milliseconds);
                self.stage.source.command(Command::OwnLatency { party, latency });
            }
        }
    }
}
