//! Opening and saving.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::super::settings::Settings;
use super::export_file::Export;
use super::job_result::{FileChange, Prepared, Recorded};
use super::opening::{Opening, unreadable_scene};
use super::run_source::RunSource;
use super::stage::{Phase, Stage};
use super::{DEMONSTRATION, Notice, NoticeCause, NoticeKind, Session};
use crate::driver::Retrace;
use crate::language::{say, word};
use crate::output::is_same_file;
use crate::runlog::{RunLog, text_lines};
use crate::scene::Opened;
use crate::sentence::shown;
use crate::view::{Layer, RunView, note_on_media, picture_pixels};

impl Session {
    /// Shows a scene, run or lesson that is already read.
    pub fn show(&mut self, opening: Opening) {
        let name = match &opening {
            Opening::Scene(opened) => return self.load_scene(Arc::clone(opened)),
            Opening::Run(log) => log.header.scene.clone(),
            Opening::Lesson(lesson) => lesson.name.clone(),
        };
        self.load(name, None, move || Ok(opening));
    }

    /// Reads a file or a built-in scene and shows it. Until then, and if that fails, the present run stays.
    pub fn open(&mut self, argument: impl AsRef<Path>) {
        let language = self.language;
        let path = argument.as_ref().to_owned();
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        if let Some(log) = self.log_path.as_deref().filter(|log| is_same_file(log, &path)) {
            let log = log.display();
            return self.trouble_with_file(say!(
                language,
                "Not opened: the option --log will overwrite {log}. Open another file",
                "Não aberto: a opção --log vai sobrescrever {log}. Abra outro arquivo"
            ));
        }
        self.camera_move = None;
        self.load(name, Some(path.clone()), move || Opening::read(path));
    }

    /// Reads the file again that could not be opened, else that of the scene. What is said of it stays until it is
    /// read.
    pub fn reload(&mut self) {
        let language = self.language;
        match self.file_at_work() {
            Some(path) => self.open(path),
            None => self.note(word!(
                language,
                "There is no file to reload: the scene is built in, or the run is recorded",
                "Não há arquivo a recarregar: a cena é interna, ou a execução é gravada"
            )),
        }
    }

    /// Returns the file that the user is at work on: the one that could not be opened, else that of the scene.
    fn file_at_work(&self) -> Option<PathBuf> {
        let scene = || self.opened().filter(|_| !self.is_recorded()).and_then(|opened| opened.path.clone());
        self.unopened.as_ref().map(|(path, _)| path.clone()).or_else(scene)
    }

    /// Watches the file that the user is at work on.
    pub(super) fn watch_file(&mut self) {
        self.jobs.watch(self.file_at_work(), self.language);
    }

    /// Starts a live run with the scene and the settings of the recorded one.
    pub fn make_live(&mut self) {
        let language = self.language;
        let header = &self.stage.log.header;
        let settings = Settings::of(header, self.settings.pace);
        if let Err(why) = settings.check(language) {
            return self.trouble(say!(
                language,
                "The window cannot make this run live. {why}",
                "A janela não pode executar isto ao vivo. {why}"
            ));
        }
        match Opened::from_text(&header.scene, &header.scene_text) {
            Ok(opened) => {
                self.settings_before = Some(std::mem::replace(&mut self.settings, settings));
                self.show(Opening::Scene(Arc::new(opened)));
            }
            Err(error) => self.trouble(unreadable_scene(&error, language)),
        }
    }

    /// Returns the picture, as far as it is traced, for the clipboard.
    pub fn copied_picture(&self, look: (Layer, f32)) -> egui::ColorImage {
        let Stage { frame, colours, .. } = &self.stage;
        let size = [frame.size().width() as usize, frame.size().height() as usize];
        egui::ColorImage::from_rgb(size, &picture_pixels(frame, self.stage.latest(), colours, look))
    }

    /// Writes the run so far in the background, with a title and a memo.
    pub fn save_run(&mut self, path: PathBuf, title: &str, memo: &str) {
        let caption = &mut self.stage.log.header.caption;
        (caption.title, caption.memo) = (title.trim().to_owned(), memo.trim().to_owned());
        // The recorded run keeps them when it starts again.
        if let Some(recorded) = &mut self.recorded {
            Arc::make_mut(&mut recorded.log).header.caption = caption.clone();
        }
        self.remember(path.clone());
        self.export(path, Export::Run);
    }

    /// Writes the run's records to the file of `--log`, if given, before the window closes. Reports a failure on
    /// standard error, since the window is gone.
    pub fn save_log_on_exit(&self) {
        if let (Some(path), RunSource::Live(_)) = (&self.log_path, &self.stage.source)
            && let Err(error) = self.stage.log.save(path)
        {
            eprintln!("anel: {error}");
        }
    }

    /// Shows a recorded run that was read from a file. If the file is cut off, says so.
    pub(super) fn open_recorded(&mut self, recorded: Recorded) {
        let language = self.language;
        let cut_off_at = recorded.log.cut_off_at();
        self.play(recorded);
        if let Some(line) = cut_off_at {
            self.trouble(say!(
                language,
                "The run file is cut off in line {line}. The run is shown up to there",
                "O arquivo da execução está cortado na linha {line}. A execução é mostrada até ali"
            ));
        }
    }

    /// Shows a recorded run from its beginning.
    pub(super) fn play(&mut self, recorded: Recorded) {
        let caption = &recorded.log.header.caption;
        let texts: Vec<String> = text_lines(&caption.title).chain(text_lines(&caption.memo)).collect();
        if !texts.is_empty() {
            self.note(shown(&texts.join(" — "), 400));
        }
        let retrace = Retrace::start(Arc::clone(&recorded.tracer), Arc::clone(&recorded.log));
        let (log, view) = (RunLog::clone(&recorded.log), RunView::clone(&recorded.view));
        let stage = Stage::recorded(RunSource::Recorded(retrace), log, view, self.ground);
        self.set_stage(stage, recorded.preview.clone());
        self.recorded = Some(recorded);
        self.watch_file();
    }

    /// Writes the records in the background to the file of `--log`, if given.
    pub(super) fn write_log(&mut self) {
        if let (Some(path), RunSource::Live(_)) = (&self.log_path, &self.stage.source) {
            self.export(path.clone(), Export::Run);
        }
    }

    /// Starts a run of a compiled scene.
    pub(super) fn show_scene(&mut self, prepared: Prepared) {
        let language = self.language;
        if let Some(path) = &prepared.opened.path {
            self.remember(path.clone());
        }
        self.prepared = Some(prepared);
        self.recorded = None;
        self.watch_file();
        self.restart();
        let opened = self.opened().filter(|opened| opened.path.is_some());
        if let Some(note) = opened.and_then(|opened| note_on_media(&opened.scene, language)) {
            self.note(note);
        }
    }

    /// Shows the error of a file that could not be opened, and watches it. At the start of the program a built-in scene
    /// opens instead.
    pub(super) fn report_unopened(&mut self, file: Option<PathBuf>, why: String) {
        let language = self.language;
        self.camera_move = None;
        self.release_run();
        if self.stage.phase == Phase::Preparing {
            // The error is still to be read.
            self.load(DEMONSTRATION.into(), None, || Opening::read(DEMONSTRATION));
        }
        let Some(path) = file else {
            return self.trouble_with_file(say!(language, "Not opened. {why}", "Não aberto. {why}"));
        };
        let is_again = self.unopened.replace((path.clone(), why.clone())).is_some_and(|(before, _)| before == path);
        let text = if is_again {
            say!(language, "Still not opened. {why}", "Ainda não aberto. {why}")
        } else {
            say!(language, "Not opened. {why}", "Não aberto. {why}")
        };
        self.watch_file();
        self.replace_file_notice(text, NoticeKind::Unopened);
    }

    fn trouble_with_file(&mut self, text: String) {
        self.notices.add(Notice::new(text, NoticeKind::Trouble, NoticeCause::File, self.clock));
    }

    /// Reloads the open file, which has changed, or shows the notice that it has changed or was deleted.
    pub(super) fn file_changed(&mut self, path: &Path, change: FileChange) {
        if self.file_at_work().as_deref() != Some(path) {
            return;
        }
        if self.always_reload && change == FileChange::Written {
            return self.reload();
        }
        let language = self.language;
        let name = file_name(path);
        let unopened = self.unopened.as_ref().filter(|(unopened, _)| unopened == path);
        let (text, kind) = match (change, unopened) {
            (FileChange::Written, Some((_, why))) => {
                let text =
                    say!(language, "{name} has changed on disk. Before: {why}", "{name} mudou no disco. Antes: {why}");
                (text, NoticeKind::Changed)
            }
            (FileChange::Written, None) => {
                (say!(language, "{name} has changed on disk", "{name} mudou no disco"), NoticeKind::Changed)
            }
            (FileChange::Gone, _) => {
                let text = say!(
                    language,
                    "{name} was deleted or moved; the open scene stays as it is",
                    "{name} foi apagado ou movido; a cena aberta fica como está"
                );
                (text, NoticeKind::Trouble)
            }
        };
        self.replace_file_notice(text, kind);
    }

    /// Shows a notice about a file in place of what was said of it before, which is no longer true.
    fn replace_file_notice(&mut self, text: String, kind: NoticeKind) {
        self.notices.end(NoticeCause::File);
        self.notices.add(Notice::new(text, kind, NoticeCause::File, self.clock));
    }

    /// Whether a changed scene is reloaded without a question.
    pub fn always_reloads(&self) -> bool {
        self.always_reload
    }

    /// Sets whether a changed scene is reloaded without a question.
    pub fn set_always_reload(&mut self, always: bool) {
        self.always_reload = always;
    }

    /// Returns the files that were opened last, the latest first.
    pub fn recent(&self) -> &[PathBuf] {
        &self.recent
    }

    /// Sets the files that were opened in earlier windows.
    pub fn set_recent(&mut self, recent: Vec<PathBuf>) {
        self.recent = recent;
    }

    /// Puts the file first among the recent ones.
    fn remember(&mut self, file: PathBuf) {
        const MAX_RECENT: usize = 8;
        self.recent.retain(|other| *other != file);
        self.recent.insert(0, file);
        self.recent.truncate(MAX_RECENT);
    }
}

/// Returns the name of a file as text.
pub(super) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
