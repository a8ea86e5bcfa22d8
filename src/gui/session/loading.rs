//! What is read, compiled and traced before its run begins, and the beginning of that run.

use std::path::PathBuf;
use std::sync::Arc;

use super::job_result::{Prepared, Ready};
use super::opening::Opening;
use super::run_source::RunSource;
use super::stage::{Phase, Stage};
use super::tracing::{TracedShare, TracingJob, TracingProgress};
use super::{JobResult, Jobs, Session};
use crate::driver::{PictureCache, Run};
use crate::language::{Language, word};
use crate::palette::Rgb;
use crate::parallel::cores;
use crate::picture::{Quality, Size};
use crate::runlog::Driver;
use crate::scene::Opened;

/// The scene, run or lesson that is being read and compiled. For a run in virtual time its picture is traced too.
pub(super) struct Loading {
    pub job: u64,
    name: String,
    /// The file or built-in scene that the user has opened. With it notices about files end.
    pub file: Option<PathBuf>,
    progress: TracingProgress,
    /// The picture, if the scene was read before.
    picture: Option<Picture>,
}

/// The picture of a scene, and what is done before its run begins.
struct Picture {
    opened: Arc<Opened>,
    size: Size,
    quality: Quality,
    is_virtual: bool,
}

impl Picture {
    fn is_same_as(&self, other: &Self) -> bool {
        let same_scene = Arc::ptr_eq(&self.opened, &other.opened);
        same_scene && (self.size, self.quality, self.is_virtual) == (other.size, other.quality, other.is_virtual)
    }
}

/// Progress of what is being loaded.
pub struct LoadingProgress<'a> {
    /// Name of the scene, run or lesson.
    pub name: &'a str,
    /// Share of the picture that is traced for virtual time; 0 while the file is read and compiled.
    pub traced: TracedShare,
    /// Whether it can be cancelled.
    pub can_cancel: bool,
}

impl Session {
    /// Returns the progress of what is being loaded.
    pub fn loading(&self) -> Option<LoadingProgress<'_>> {
        let loading = self.loading.as_ref()?;
        let traced = self.traced_share(&loading.progress);
        // Before the first run there is nothing to go back to, but real time needs no traced picture.
        let can_cancel = self.stage.phase != Phase::Preparing || traced.share > 0.0;
        Some(LoadingProgress { name: &loading.name, traced, can_cancel })
    }

    /// Cancels what is being loaded: run, settings and camera stay as they were before. The first run begins in real
    /// time instead.
    pub fn cancel_loading(&mut self) {
        let language = self.language;
        if self.stage.phase == Phase::Preparing {
            self.settings.driver = Driver::Threads;
            if let Some(loading) = &self.loading {
                loading.progress.cancel();
            }
            return self.note(word!(
                language,
                "The run is in real time. For virtual time open Set up (E)",
                "A execução é em tempo real. Para tempo virtual, abra Ajustar (E)"
            ));
        }
        (self.loading, self.camera_move) = (None, None);
        self.release_run();
        if let Some(before) = self.settings_before.take() {
            let cancelled = std::mem::replace(&mut self.settings, before);
            self.history.undo_to(&self.settings, &cancelled);
            self.send_changes(&cancelled);
        }
    }

    /// Starts the job that reads with `read` and compiles. If the user has opened a `file` and it succeeds, notices
    /// about files end.
    pub(super) fn load(
        &mut self,
        name: String,
        file: Option<PathBuf>,
        read: impl FnOnce() -> Result<Opening, String> + Send + 'static,
    ) {
        let progress = TracingProgress::new(self.settings.size.pixels(), self.clock);
        let tracing = (Arc::clone(&self.pictures), progress.job());
        let job = self.jobs.prepare(read, &self.settings, tracing, self.language);
        self.loading = Some(Loading { job, name, file, progress, picture: None });
    }

    /// Compiles the scene for the settings, and traces its picture if they are for virtual time. Does nothing if that
    /// is in progress. The run on the stage waits if it would take the cores from the tracing.
    pub(super) fn load_scene(&mut self, opened: Arc<Opened>) {
        let picture = self.picture_of(Arc::clone(&opened));
        if self.is_loading(&picture) {
            return;
        }
        self.load(opened.name.clone(), None, move || Ok(Opening::Scene(opened)));
        self.wait_for(picture);
    }

    /// Begins a live run of the compiled scene, or compiles it for the settings first.
    pub(super) fn restart_live(&mut self) {
        match &self.prepared {
            Some(prepared) if prepared.is_for(&self.settings) => self.begin(prepared.clone()),
            Some(prepared) => self.load_scene(Arc::clone(&prepared.opened)),
            // The first scene is still being compiled; its run will start with the settings of that time.
            None => {}
        }
    }

    /// Begins a live run of a compiled scene. In virtual time its picture is traced first, unless it is kept.
    pub(super) fn begin(&mut self, prepared: Prepared) {
        let opened = &prepared.opened;
        let picture = if self.settings.driver == Driver::Sim {
            let Some(picture) = self.pictures.get(&opened.text, &prepared.tracer) else {
                return self.trace_picture(prepared);
            };
            Some(picture)
        } else {
            None
        };
        // What was loaded for the settings of before is of no use now.
        self.loading.take_if(|loading| {
            loading.picture.as_ref().is_some_and(|picture| Arc::ptr_eq(&picture.opened, &prepared.opened))
        });
        if self.stage.phase == Phase::Running {
            self.write_log();
        }
        if self.recorded.take().is_some() {
            self.watch_file();
        }
        let work = prepared.work(self.settings.driver);
        let header = self.settings.header(&opened.name, &opened.text, work, cores());
        let run = match picture {
            Some(picture) => Run::start_traced(picture, &header),
            None => Run::start(Arc::clone(&prepared.tracer), &header),
        };
        self.set_stage(Stage::new(RunSource::Live(run), header, self.ground), prepared.preview.clone());
    }

    /// Replaces the run on the stage.
    pub(super) fn set_stage(&mut self, stage: Stage, preview: Arc<[Rgb]>) {
        self.stop_run();
        (self.holds_run, self.settings_before) = (false, None);
        self.runs_begun += 1;
        self.stage = stage;
        self.stage.show_preview(preview);
        self.inspect_again();
        self.end_camera_move();
    }

    /// Lets the run on the stage continue that has waited for the tracing.
    pub(super) fn release_run(&mut self) {
        if std::mem::take(&mut self.holds_run) && self.stage.paused {
            self.set_run_paused(false);
        }
    }

    /// Starts the job that traces the picture of a compiled scene, unless that is in progress.
    fn trace_picture(&mut self, prepared: Prepared) {
        let picture = self.picture_of(Arc::clone(&prepared.opened));
        if self.is_loading(&picture) {
            return;
        }
        let progress = TracingProgress::new(prepared.size.pixels(), self.clock);
        let (name, tracing) = (prepared.opened.name.clone(), (Arc::clone(&self.pictures), progress.job()));
        let job = self.jobs.trace(prepared, tracing, self.language);
        self.loading = Some(Loading { job, name, file: None, progress, picture: None });
        self.wait_for(picture);
    }

    fn picture_of(&self, opened: Arc<Opened>) -> Picture {
        let (size, quality) = (self.settings.size, self.settings.quality);
        Picture { opened, size, quality, is_virtual: self.settings.driver == Driver::Sim }
    }

    fn is_loading(&self, picture: &Picture) -> bool {
        let loading = self.loading.as_ref().and_then(|loading| loading.picture.as_ref());
        loading.is_some_and(|loading| loading.is_same_as(picture))
    }

    /// Notes which picture is being loaded, and lets the run on the stage wait if the picture is traced.
    fn wait_for(&mut self, picture: Picture) {
        if picture.is_virtual && self.stage.phase == Phase::Running && !self.stage.paused {
            self.set_run_paused(true);
            self.holds_run = true;
        }
        if let Some(loading) = &mut self.loading {
            loading.picture = Some(picture);
        }
    }

    /// Stops the run on the stage without waiting for its threads.
    fn stop_run(&mut self) {
        let last = std::mem::replace(&mut self.stage.source, RunSource::None);
        last.stop();
        if !last.has_ended() {
            self.ending.push(last);
        }
    }
}

impl Jobs {
    /// Traces the picture of a compiled scene for virtual time. Returns the job's number.
    fn trace(
        &mut self,
        prepared: Prepared,
        (kept, tracing): (Arc<PictureCache>, TracingJob),
        language: Language,
    ) -> u64 {
        let number = self.number();
        self.start(language, "trace", move || {
            let done = |more| tracing.add(more);
            let traced = kept.get_or_trace(&prepared.opened.text, &prepared.tracer, &done, &tracing.cancel);
            JobResult::Ready(number, traced.map(|_| Ready::Traced(prepared)).map_err(|error| error.to_string()))
        });
        number
    }
}
