//! What is done in the background, so that nothing ever blocks the window. Each job is a thread of its own, with a name,
//! and ends by itself.

use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, SystemTime};

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, bounded, unbounded};

use super::job_result::{FileChange, JobResult, Purpose};
use super::preview::thumbnail;
use crate::cancel::CancelOnDrop;
use crate::language::{Language, say, word};
use crate::output::OutputError;
use crate::picture::{Size, write_png};
use crate::runlog::RunLog;
use crate::scene::Opened;
use crate::view::Inspected;

/// Starts jobs and gets what they come to.
pub struct Jobs {
    ctx: egui::Context,
    sender: Sender<JobResult>,
    receiver: Receiver<JobResult>,
    next: u64,
    /// Dropping it ends the watch.
    watch: Option<Sender<()>>,
    /// Dropping it ends the measurement.
    pub(super) measuring: Option<CancelOnDrop>,
}

impl Jobs {
    /// No job yet; `ctx` is woken by those that end.
    pub fn new(ctx: egui::Context) -> Self {
        let (sender, receiver) = unbounded();
        Self { ctx, sender, receiver, next: 0, watch: None, measuring: None }
    }

    /// What jobs have come to since.
    pub fn done(&self) -> Vec<JobResult> {
        self.receiver.try_iter().collect()
    }

    /// Writes a picture of these pixels.
    pub fn save_picture(
        &self,
        path: PathBuf,
        size: Size,
        pixels: impl FnOnce() -> Vec<u8> + Send + 'static,
        language: Language,
    ) {
        self.start(language, "save", move || {
            JobResult::Saved(told(&path, write_png(&path, size, &pixels()), language))
        });
    }

    /// Writes a run file.
    pub fn save_run(&self, path: PathBuf, log: RunLog, language: Language) {
        self.start(language, "save", move || JobResult::Saved(told(&path, log.save(&path), language)));
    }

    /// Asks with the system's own dialog. Without such a dialog the answer is the same as cancelling.
    pub fn choose(&self, purpose: Purpose, at: PathBuf, language: Language) {
        let [scenes, lessons, all] =
            word!(language, ["Scenes and runs", "Lessons", "All"], ["Cenas e execuções", "Lições", "Todos"]);
        self.start(language, "file dialog", move || {
            let mut dialog = rfd::FileDialog::new();
            if let Some(directory) = at.parent().filter(|directory| directory.is_dir()) {
                dialog = dialog.set_directory(directory);
            }
            let name = at.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let chosen = match purpose {
                Purpose::Open => dialog.add_filter(scenes, &["ron", "anel"]).add_filter(all, &["*"]).pick_file(),
                Purpose::Learn => dialog.add_filter(lessons, &["ron"]).add_filter(all, &["*"]).pick_file(),
                Purpose::Save => dialog.set_file_name(name).save_file(),
            };
            JobResult::Chosen(purpose, chosen)
        });
    }

    /// Makes small pictures of these scenes, one after the other.
    pub fn thumbnails(&self, scenes: Vec<String>, language: Language) {
        self.start_many(
            language,
            "thumbnails",
            |why| JobResult::Saved(Err(why)),
            move |tell| {
                for scene in scenes {
                    let made =
                        Opened::new(&scene).map(|opened| thumbnail(&opened.scene)).map_err(|error| error.to_string());
                    tell(JobResult::Thumbnail(scene, made));
                }
            },
        );
    }

    /// Traces a pixel once more, to be looked at.
    pub fn inspect(&self, look: impl FnOnce() -> Option<Inspected> + Send + 'static, language: Language) {
        self.start(language, "inspect", move || JobResult::Inspected(look().map(Box::new)));
    }

    /// Watches this file instead of the one before.
    pub fn watch(&mut self, path: Option<PathBuf>, language: Language) {
        self.watch = None;
        let Some(path) = path else { return };
        let (stop, stopped) = bounded(0);
        self.watch = Some(stop);
        self.start_many(
            language,
            "watch",
            |why| JobResult::Saved(Err(why)),
            move |tell| {
                let mut known = stamp(&path);
                while stopped.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                    let now = stamp(&path);
                    if now != known {
                        known = now;
                        let change = if now.is_some() { FileChange::Written } else { FileChange::Gone };
                        tell(JobResult::FileChanged(path.clone(), change));
                    }
                }
            },
        );
    }

    /// A number that no job had before.
    pub(super) fn number(&mut self) -> u64 {
        self.next += 1;
        self.next
    }

    pub(super) fn start(&self, language: Language, name: &str, job: impl FnOnce() -> JobResult + Send + 'static) {
        self.start_many(language, name, |why| JobResult::Saved(Err(why)), move |tell| tell(job()));
    }

    /// Starts a thread for a job that tells several things, or tells what it `failed` with.
    pub(super) fn start_many(
        &self,
        language: Language,
        name: &str,
        failed: impl FnOnce(String) -> JobResult,
        job: impl FnOnce(&(dyn Fn(JobResult) + Sync)) + Send + 'static,
    ) {
        let (sender, ctx) = (self.sender.clone(), self.ctx.clone());
        let tell = move |done| {
            // The window may have closed meanwhile.
            let _ = sender.send(done);
            ctx.request_repaint();
        };
        if let Err(error) = thread::Builder::new().name(name.into()).spawn(move || job(&tell)) {
            let why =
                say!(language, "No thread could be started: {error}", "Nenhuma thread pôde ser iniciada: {error}");
            let _ = self.sender.send(failed(why));
        }
    }
}

/// How often a file that is watched is looked at.
const LOOK: Duration = Duration::from_millis(700);

/// What a file looked like; `None` if there is none.
fn stamp(path: &Path) -> Option<(Option<SystemTime>, u64)> {
    fs::metadata(path).ok().map(|data| (data.modified().ok(), data.len()))
}

/// Puts into a sentence how saving went.
pub(super) fn told(path: &Path, saved: Result<(), OutputError>, language: Language) -> Result<String, String> {
    let shown = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let shown = shown.display();
    saved.map(|()| say!(language, "Saved to {shown}", "Salvo em {shown}")).map_err(|error| error.to_string())
}
