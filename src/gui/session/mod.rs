//! One run after the other, as the window sees them. Here, and nowhere else in `gui`, are threads, channels and clocks:
//! those of runs behind [`RunSource`], those of everything else in [`jobs`].

mod comparing;
mod exporting;
mod failing;
mod files;
mod inspecting;
mod job_result;
mod jobs;
mod measuring;
mod moving;
mod notice;
pub mod opening;
mod performer;
mod preparing;
mod preview;
mod stage;
mod teaching;
mod timing;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use super::settings::Settings;
use super::settings::undo::{Gesture, UndoHistory};
use crate::balance::NodeId;
use crate::driver::{Run, cores};
use crate::language::{Language, say};
use crate::palette::Rgb;
use crate::runlog::Header;
use crate::scenario::Command;
use crate::scene::{Camera, Opened};
use crate::time::Time;
use opening::Opening;

pub use comparing::{ComparisonSubject, PictureSource, TracingProgress};
pub use exporting::Export;
use exporting::ExportJob;
use inspecting::Inspecting;
use job_result::Ready;
pub use job_result::{
    CameraPreview, CompareResult, Finding, Growth, GrowthPoint, JobResult, Prepared, PreparedLesson, Purpose, Recorded,
    Thumbnail, TracedOnce,
};
use jobs::Jobs;
use moving::CameraMove;
pub use notice::{Notice, NoticeKind};
use performer::RunSource;
pub use stage::{Phase, Stage};
pub use teaching::PreparingLesson;

/// What the window shows, what is set, and what goes on in the background.
pub struct Session {
    stage: Stage,
    settings: Settings,
    history: UndoHistory,
    /// The scene that live runs trace, once there is one.
    prepared: Option<Prepared>,
    /// The run that is played again, if that is what is shown.
    recorded: Option<Recorded>,
    loading: Option<Loading>,
    inspecting: Inspecting,
    /// The scene's own camera.
    home: Option<Camera>,
    moving: Option<CameraMove>,
    /// Looks from a moved camera that have not come back.
    camera_jobs: usize,
    jobs: Jobs,
    /// Runs that were asked to end and have threads that have not.
    ending: Vec<RunSource>,
    begun: usize,
    /// Measurements that have not ended, although they may have been asked to.
    measurements: usize,
    notice: Option<Notice>,
    making: Option<ExportJob>,
    /// Where each run's records are written when it ends.
    log_path: Option<PathBuf>,
    /// The files that were opened last, the latest first.
    recent: Vec<String>,
    ground: Rgb,
    /// While a hand drags the run's time: whether that stood still before.
    dragged_from: Option<bool>,
    /// The language of the window.
    language: Language,
    /// egui's clock, in seconds.
    clock: f64,
}

/// Something that is being read and compiled.
struct Loading {
    job: u64,
    name: String,
    since: f64,
}

impl Session {
    /// An empty stage; something has to be opened.
    pub fn new(settings: Settings, log_path: Option<PathBuf>, ctx: &egui::Context, ground: Rgb) -> Self {
        let header = settings.header("", "", Duration::ZERO, cores());
        Self {
            stage: Stage::new(RunSource::Nobody, header, ground),
            settings,
            history: UndoHistory::default(),
            prepared: None,
            recorded: None,
            loading: None,
            inspecting: Inspecting::default(),
            home: None,
            moving: None,
            camera_jobs: 0,
            jobs: Jobs::new(ctx.clone()),
            ending: Vec::new(),
            begun: 0,
            measurements: 0,
            notice: None,
            making: None,
            log_path,
            recent: Vec::new(),
            ground,
            dragged_from: None,
            language: Language::default(),
            clock: 0.0,
        }
    }

    /// The language of the window.
    pub fn language(&self) -> Language {
        self.language
    }

    /// Sets the language of the window.
    pub fn set_language(&mut self, language: Language) {
        self.language = language;
    }

    /// Ends the run and starts it anew with what is set now; a recorded run begins again.
    pub fn restart(&mut self) {
        if let Some(recorded) = self.recorded.clone() {
            return self.play(recorded);
        }
        match &self.prepared {
            Some(prepared) if prepared.is_for(&self.settings) => self.begin(prepared.clone()),
            Some(prepared) => self.show(Opening::Scene(Arc::clone(&prepared.opened))),
            // The first scene is still being prepared; what is set then counts.
            None => {}
        }
    }

    /// Takes in what has happened since the last call; `clock` is egui's, in seconds. Returns what the user has chosen in
    /// the system's dialogs, small pictures, and what was measured.
    pub fn tick(&mut self, clock: f64) -> Vec<JobResult> {
        self.clock = clock;
        if self.stage.tick(clock) {
            self.write_log();
        }
        self.ending.retain(|performer| !performer.has_ended());
        if self.notice.as_ref().and_then(|notice| notice.remains(clock)) == Some(0.0) {
            self.notice = None;
        }
        let mut others = Vec::new();
        for done in self.jobs.done() {
            match done {
                JobResult::Ready(job, ready) if self.loading.as_ref().is_some_and(|loading| loading.job == job) => {
                    self.loading = None;
                    match ready {
                        Ok(Ready::Scene(prepared)) => self.show_scene(prepared),
                        Ok(Ready::Run(recorded)) => self.play(recorded),
                        Ok(Ready::Lesson(lesson)) => others.push(JobResult::ToTeach(lesson)),
                        Err(why) => self.could_not_open(why),
                    }
                }
                // Something else was asked for meanwhile.
                JobResult::Ready(..) => {}
                JobResult::Saved(Ok(said)) => self.note(said),
                JobResult::Saved(Err(why)) => self.trouble(why),
                JobResult::Progress(job, part) => self.progress(job, part),
                JobResult::Made(job, made) => self.made(job, made),
                JobResult::FileChanged(path, change) => self.file_changed(&path, change),
                JobResult::Found(job, finding) => {
                    self.measurements -= usize::from(matches!(finding, Finding::Over(_)));
                    others.push(JobResult::Found(job, finding));
                }
                JobResult::Inspected(inspected) => self.take_inspected(inspected),
                JobResult::CameraPreview(moved) => self.take_moved(moved),
                done @ (JobResult::Chosen(..)
                | JobResult::Thumbnail(..)
                | JobResult::CompareResult(..)
                | JobResult::ToTeach(..)
                | JobResult::Lesson(..)) => others.push(done),
            }
        }
        others
    }

    /// Changes what is set: at once, or by starting the run anew if that is needed. What is impossible is said in words.
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
        self.history.keep(self.settings.clone(), gesture);
        let before = self.apply(settings);
        if self.settings.needs_restart(&before) {
            let now = self.settings.difference(&before, language);
            self.note(say!(language, "Started anew: {now}", "Reiniciada: {now}"));
        }
    }

    /// The hand has let go of what it changed.
    pub fn let_go(&mut self) {
        self.history.let_go();
    }

    /// Takes the last change back.
    pub fn undo(&mut self) {
        let language = self.language;
        if let Some(settings) = self.history.undo(&self.settings) {
            let before = self.apply(settings);
            let now = self.settings.difference(&before, language);
            self.note(say!(language, "Undone; now {now}", "Desfeito; agora {now}"));
        }
    }

    /// Makes the change that was taken back.
    pub fn redo(&mut self) {
        let language = self.language;
        if let Some(settings) = self.history.redo(&self.settings) {
            let before = self.apply(settings);
            let now = self.settings.difference(&before, language);
            self.note(say!(language, "Done again; now {now}", "Refeito; agora {now}"));
        }
    }

    /// Lets a machine go on or stand still.
    pub fn toggle_node_pause(&mut self, node: NodeId) {
        self.return_to_present();
        if let Some(paused) = self.stage.paused_nodes.get_mut(usize::from(node))
            && self.stage.phase == Phase::Running
        {
            *paused = !*paused;
            self.stage.performer.command(Command::Pause { node, paused: *paused });
        }
    }

    /// What is shown.
    pub fn stage(&self) -> &Stage {
        &self.stage
    }

    /// What is shown, to draw it.
    pub fn stage_mut(&mut self) -> &mut Stage {
        &mut self.stage
    }

    /// What is set.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// What the run was asked to do.
    pub fn header(&self) -> &Header {
        &self.stage.log.header
    }

    /// The scene that live runs trace, compiled.
    pub fn prepared(&self) -> Option<&Prepared> {
        self.prepared.as_ref()
    }

    /// The scene that live runs trace.
    pub fn opened(&self) -> Option<&Opened> {
        self.prepared.as_ref().map(|prepared| &*prepared.opened)
    }

    /// Whether what is shown is a recorded run.
    pub fn is_recorded(&self) -> bool {
        self.recorded.is_some()
    }

    /// The run's clock, the same for a whole frame.
    pub fn now(&self) -> Time {
        self.stage.now()
    }

    /// The speed that a node has or is about to have.
    pub fn speed(&self, node: NodeId) -> f64 {
        let index = usize::from(node);
        let recorded = || self.stage.state().nodes().get(index).map_or(0.0, |node| node.speed);
        if self.is_recorded() || !self.stage.is_live() && self.stage.phase == Phase::Running {
            recorded()
        } else {
            self.settings.all_speeds().nth(index).unwrap_or_else(recorded)
        }
    }

    /// Whether a node stands still, or is about to.
    pub fn is_node_paused(&self, node: NodeId) -> bool {
        let index = usize::from(node);
        if self.is_recorded() {
            self.stage.state().nodes().get(index).is_some_and(|node| node.paused)
        } else {
            self.stage.paused_nodes.get(index).copied().unwrap_or(false)
        }
    }

    /// What was set before, and after.
    pub fn history(&self) -> &UndoHistory {
        &self.history
    }

    /// Jobs, for dialogs and small pictures.
    pub fn jobs(&self) -> &Jobs {
        &self.jobs
    }

    /// What is being read and compiled, and for how many seconds.
    pub fn loading(&self) -> Option<(&str, f64)> {
        self.loading.as_ref().map(|loading| (&*loading.name, self.clock - loading.since))
    }

    /// What is to be read below the top bar.
    pub fn notice(&self) -> Option<&Notice> {
        self.notice.as_ref()
    }

    /// Away with it.
    pub fn close_notice(&mut self) {
        self.notice = None;
    }

    /// Closes it, unless it asks something that goes for the next run as well.
    pub fn end_notice(&mut self) {
        self.notice.take_if(|notice| notice.is_of_the_run());
    }

    /// Something was done.
    pub fn note(&mut self, text: impl Into<String>) {
        self.notice = Some(Notice::note(text, self.clock));
    }

    /// Something cannot be done.
    pub fn trouble(&mut self, text: impl Into<String>) {
        self.notice = Some(Notice::trouble(text, self.clock));
    }

    /// How many runs have begun, for tests.
    pub fn runs_begun(&self) -> usize {
        self.begun
    }

    /// How many runs were asked to end and have not, for tests.
    pub fn runs_ending(&self) -> usize {
        self.ending.len()
    }

    /// How many measurements have not ended, although they may have been asked to, for tests.
    pub fn measurements(&self) -> usize {
        self.measurements
    }

    /// Sets everything that differs, and returns what was set before.
    fn apply(&mut self, settings: Settings) -> Settings {
        self.return_to_present();
        let before = std::mem::replace(&mut self.settings, settings);
        if self.settings.needs_restart(&before) {
            self.restart();
            return before;
        }
        let speeds = self.settings.all_speeds().zip(before.all_speeds());
        for (node, (speed, _)) in (0..).zip(speeds).filter(|(_, (speed, before))| speed != before) {
            self.stage.performer.command(Command::Speed { node, speed });
        }
        if self.settings.latency != before.latency {
            self.stage.performer.command(Command::Latency(self.settings.latency_time()));
        }
        before
    }

    fn begin(&mut self, prepared: Prepared) {
        if self.stage.phase == Phase::Running {
            self.write_log();
        }
        let opened = &prepared.opened;
        let work = prepared.work(self.settings.driver);
        let header = self.settings.header(&opened.name, &opened.text, work, cores());
        let run = Run::start(Arc::clone(&prepared.tracer), &header);
        self.set_stage(Stage::new(RunSource::Live(run), header, self.ground), prepared.preview.clone());
    }

    fn set_stage(&mut self, stage: Stage, preview: Arc<[Rgb]>) {
        self.retire();
        self.begun += 1;
        self.stage = stage;
        self.stage.show_preview(preview);
        self.look_again();
        self.camera_has_settled();
    }

    /// Lets whoever performs end in their own time.
    fn retire(&mut self) {
        let last = std::mem::replace(&mut self.stage.performer, RunSource::Nobody);
        last.stop();
        if !last.has_ended() {
            self.ending.push(last);
        }
    }
}
