//! Opening and saving.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::super::settings::Settings;
use super::Notice;
use super::job_result::{FileChange, Prepared, Recorded};
use super::opening::Opening;
use super::performer::RunSource;
use super::stage::{Phase, Stage};
use super::{Loading, Session};
use crate::driver::Retrace;
use crate::language::say;
use crate::output::is_same_file;
use crate::runlog::RunLog;
use crate::scene::Opened;
use crate::sentence::shown;
use crate::view::{Layer, RunView, picture_pixels};

impl Session {
    /// Shows what has been read already.
    pub fn show(&mut self, opening: Opening) {
        let name = match &opening {
            Opening::Scene(opened) => opened.name.clone(),
            Opening::Run(log) => log.header.scene.clone(),
            Opening::Lesson(lesson) => lesson.name.clone(),
        };
        self.load(name, move || Ok(opening));
    }

    /// Reads a file, or a built-in scene, and shows it; what is shown now stays until then, or if it cannot be read.
    pub fn open(&mut self, argument: &str) {
        let language = self.language;
        let name =
            Path::new(argument).file_name().map_or_else(|| argument.into(), |name| name.to_string_lossy().into());
        if let Some(log) = self.log_path.as_deref().filter(|log| is_same_file(log, Path::new(argument))) {
            let log = log.display();
            return self.trouble(say!(
                language,
                "Not opened. The run's records will be written to {log} (--log)",
                "Não aberto. Os registros da execução serão escritos em {log} (--log)"
            ));
        }
        self.moving = None;
        let argument = argument.to_owned();
        self.load(name, move || Opening::read(&argument));
    }

    /// Reads the scene's file again.
    pub fn reload(&mut self) {
        self.notice = None;
        if !self.is_recorded()
            && let Some(path) = self.opened().and_then(|opened| opened.path.clone())
        {
            self.open(&path.to_string_lossy());
        }
    }

    /// Traces a recorded run's picture anew, by living nodes.
    pub fn make_live(&mut self) {
        let language = self.language;
        let header = &self.stage.log.header;
        let settings = Settings::of(header, self.settings.tempo);
        if let Err(why) = settings.check(language) {
            return self.trouble(say!(
                language,
                "This run cannot be made live here: {why}",
                "Esta execução não pode tornar-se ao vivo aqui: {why}"
            ));
        }
        match Opened::from_text(&header.scene, &header.scene_text) {
            Ok(opened) => {
                self.settings = settings;
                self.show(Opening::Scene(Arc::new(opened)));
            }
            Err(error) => self.trouble(say!(
                language,
                "The run's own scene cannot be read: {error}",
                "A cena da própria execução não pode ser lida: {error}"
            )),
        }
    }

    /// Writes the picture, as far as it is, in the background: the render (`blend` 0), a layer (1) or a blend.
    pub fn save_picture(&mut self, path: PathBuf, look: (Layer, f32)) {
        let language = self.language;
        self.note_saving(&path);
        let Stage { frame, colours, .. } = &self.stage;
        let (frame, state, colours) = (frame.clone(), self.stage.latest().clone(), colours.clone());
        self.jobs.save_picture(path, frame.size(), move || picture_pixels(&frame, &state, &colours, look), language);
    }

    /// The picture, as far as it is, as it can be put elsewhere at once.
    pub fn copied_picture(&self, look: (Layer, f32)) -> egui::ColorImage {
        let Stage { frame, colours, .. } = &self.stage;
        let size = [frame.size().width() as usize, frame.size().height() as usize];
        egui::ColorImage::from_rgb(size, &picture_pixels(frame, self.stage.latest(), colours, look))
    }

    /// Writes the run, as far as it is, in the background, under this title and with this memo.
    pub fn save_run(&mut self, path: PathBuf, title: &str, memo: &str) {
        let language = self.language;
        self.note_saving(&path);
        let caption = &mut self.stage.log.header.caption;
        (caption.title, caption.memo) = (title.trim().to_owned(), memo.trim().to_owned());
        // A recorded run that begins again is called so, too.
        if let Some(recorded) = &mut self.recorded {
            Arc::make_mut(&mut recorded.log).header.caption = caption.clone();
        }
        self.remember(path.to_string_lossy().into_owned());
        self.jobs.save_run(path, self.stage.log.clone(), language);
    }

    fn note_saving(&mut self, path: &Path) {
        let language = self.language;
        let path = path.display();
        self.note(say!(language, "Saving {path} …", "Salvando {path} …"));
    }

    /// Writes the run's records to where the user asked for them, if so, before the window closes. A failure is told on
    /// standard error, since there is no other place for it any more.
    pub fn keep_log(&self) {
        if let (Some(path), RunSource::Live(_)) = (&self.log_path, &self.stage.performer)
            && let Err(error) = self.stage.log.save(path)
        {
            eprintln!("anel: {error}");
        }
    }

    /// Plays a recorded run from its beginning.
    pub(super) fn play(&mut self, recorded: Recorded) {
        let language = self.language;
        let caption = &recorded.log.header.caption;
        let said: Vec<&str> = [&*caption.title, &*caption.memo].into_iter().filter(|said| !said.is_empty()).collect();
        if !said.is_empty() {
            self.note(shown(&said.join(" — "), 400));
        }
        self.jobs.watch(None, language);
        let retrace = Retrace::start(Arc::clone(&recorded.tracer), Arc::clone(&recorded.log));
        let (log, known) = (RunLog::clone(&recorded.log), RunView::clone(&recorded.known));
        let stage = Stage::recorded(RunSource::Recorded(retrace), log, known, self.ground);
        self.set_stage(stage, recorded.preview.clone());
        self.recorded = Some(recorded);
    }

    /// Writes the records in the background to where the user asked for them, if so.
    pub(super) fn write_log(&self) {
        let language = self.language;
        if let (Some(path), RunSource::Live(_)) = (&self.log_path, &self.stage.performer) {
            self.jobs.save_run(path.clone(), self.stage.log.clone(), language);
        }
    }

    fn load(&mut self, name: String, read: impl FnOnce() -> Result<Opening, String> + Send + 'static) {
        let language = self.language;
        let job = self.jobs.prepare(read, &self.settings, language);
        self.loading = Some(Loading { job, name, since: self.clock });
    }

    pub(super) fn show_scene(&mut self, prepared: Prepared) {
        let language = self.language;
        let path = prepared.opened.path.clone();
        if let Some(path) = &path {
            self.remember(path.to_string_lossy().into_owned());
        }
        self.jobs.watch(path, language);
        if !self.is_moving() {
            self.home = Some(prepared.opened.scene.camera);
        }
        self.prepared = Some(prepared);
        self.recorded = None;
        self.restart();
    }

    pub(super) fn could_not_open(&mut self, why: String) {
        let language = self.language;
        self.moving = None;
        if self.stage.phase == Phase::Preparing {
            self.open("ten-objects");
        }
        self.trouble(say!(language, "Not opened. {why}", "Não aberto. {why}"));
    }

    pub(super) fn file_changed(&mut self, path: &Path, change: FileChange) {
        let language = self.language;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        self.notice = Some(match change {
            FileChange::Written => {
                let text = say!(language, "{name} has changed on the disk", "{name} mudou no disco");
                Notice::changed(text, self.clock)
            }
            FileChange::Gone => {
                let text = say!(
                    language,
                    "{name} is gone from the disk; what is open stays as it is",
                    "{name} sumiu do disco; o que está aberto fica como está"
                );
                Notice::trouble(text, self.clock)
            }
        });
    }

    /// The files that were opened last.
    pub fn recent(&self) -> &[String] {
        &self.recent
    }

    /// The files that were opened in an earlier window.
    pub fn set_recent(&mut self, recent: Vec<String>) {
        self.recent = recent;
    }

    /// The file was opened last.
    fn remember(&mut self, file: String) {
        const MOST: usize = 8;
        self.recent.retain(|other| *other != file);
        self.recent.insert(0, file);
        self.recent.truncate(MOST);
    }
}
