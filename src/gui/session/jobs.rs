//! Background jobs, so that nothing blocks the window. Each job is a named thread that ends by itself.

use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, SystemTime};

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, bounded, unbounded};

use super::job_result::{FileChange, JobResult, Purpose};
use super::preview::thumbnail;
use crate::cancel::CancelOnDrop;
use crate::language::{Language, say, word};
use crate::scene::Opened;
use crate::view::Inspected;

/// Starts jobs and collects their results.
pub struct Jobs {
    ctx: egui::Context,
    sender: Sender<JobResult>,
    receiver: Receiver<JobResult>,
    last_number: u64,
    /// Dropping it ends the watch of the open file.
    watch: Option<Sender<()>>,
    /// Dropping it cancels the measurement.
    pub(super) measuring: Option<CancelOnDrop>,
}

impl Jobs {
    /// Creates the collection of no jobs. A job that sends a result repaints `ctx`.
    pub fn new(ctx: egui::Context) -> Self {
        let (sender, receiver) = unbounded();
        Self { ctx, sender, receiver, last_number: 0, watch: None, measuring: None }
    }

    /// Returns the results since the last call.
    pub fn results(&self) -> Vec<JobResult> {
        self.receiver.try_iter().collect()
    }

    /// Shows the system's file dialog. If there is none, the result is the same as after cancelling.
    pub fn choose_file(&self, purpose: Purpose, at: PathBuf, language: Language) {
        let [scenes, lessons, all] =
            word!(language, ["Scenes and runs", "Lessons", "All"], ["Cenas e execuções", "Lições", "Todos"]);
        self.start(language, "file dialog", move || {
            let mut dialog = rfd::FileDialog::new();
            if let Some(directory) = at.parent().filter(|directory| directory.is_dir()) {
                dialog = dialog.set_directory(directory);
            }
            // The dialogs take text only.
            let name = at.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let chosen = match purpose {
                Purpose::Open => dialog.add_filter(scenes, &["ron", "anel"]).add_filter(all, &["*"]).pick_file(),
                Purpose::Learn => dialog.add_filter(lessons, &["ron"]).add_filter(all, &["*"]).pick_file(),
                Purpose::Save => dialog.set_file_name(name).save_file(),
            };
            JobResult::Chosen(purpose, chosen)
        });
    }

    /// Traces thumbnails of these scenes, one after the other, until the result is dropped.
    pub fn thumbnails(&self, scenes: Vec<PathBuf>, language: Language) -> CancelOnDrop {
        let owner = CancelOnDrop::default();
        let cancel = owner.token();
        self.start_many(language, "thumbnails", JobResult::Failed, move |send| {
            for scene in scenes {
                let opened = Opened::new(&scene).map_err(|error| error.to_string());
                let picture = opened.map(|opened| thumbnail(&opened.scene, &cancel)).transpose();
                let Some(picture) = picture else { return };
                send(JobResult::Thumbnail(scene, picture));
            }
        });
        owner
    }

    /// Traces a pixel for the inspector.
    pub fn inspect(&self, trace: impl FnOnce() -> Option<Inspected> + Send + 'static, language: Language) {
        self.start(language, "inspect", move || JobResult::Inspected(trace().map(Box::new)));
    }

    /// Watches this file instead of the last one.
    pub fn watch(&mut self, path: Option<PathBuf>, language: Language) {
        self.watch = None;
        let Some(path) = path else { return };
        let (stop, stopped) = bounded(0);
        self.watch = Some(stop);
        self.start_many(language, "watch", JobResult::Failed, move |send| {
            let mut last = stamp(&path);
            while stopped.recv_timeout(WATCH_INTERVAL) == Err(RecvTimeoutError::Timeout) {
                let now = stamp(&path);
                if now != last {
                    last = now;
                    let change = if now.is_some() { FileChange::Written } else { FileChange::Gone };
                    send(JobResult::FileChanged(path.clone(), change));
                }
            }
        });
    }

    /// Returns a new job number.
    pub(super) fn number(&mut self) -> u64 {
        self.last_number += 1;
        self.last_number
    }

    /// Starts a job that has one result.
    pub(super) fn start(&self, language: Language, name: &str, job: impl FnOnce() -> JobResult + Send + 'static) {
        self.start_many(language, name, JobResult::Failed, move |send| send(job()));
    }

    /// Starts a job that sends several results. `failed` makes the result if its thread cannot be started.
    pub(super) fn start_many(
        &self,
        language: Language,
        name: &str,
        failed: impl FnOnce(String) -> JobResult,
        job: impl FnOnce(&(dyn Fn(JobResult) + Sync)) + Send + 'static,
    ) {
        let (sender, ctx) = (self.sender.clone(), self.ctx.clone());
        let send = move |result| {
            // The window may have closed meanwhile.
            let _ = sender.send(result);
            ctx.request_repaint();
        };
        if let Err(error) = thread::Builder::new().name(name.into()).spawn(move || job(&send)) {
            let why = say!(
                language,
                "No thread could be started ({error}). Close other programs and try again",
                "Nenhuma thread pôde ser iniciada ({error}). Feche outros programas e tente de novo"
            );
            let _ = self.sender.send(failed(why));
        }
    }
}

/// Interval at which a watched file is checked.
const WATCH_INTERVAL: Duration = Duration::from_millis(700);

/// Returns the modification time and the length of a file; `None` if it does not exist.
fn stamp(path: &Path) -> Option<(Option<SystemTime>, u64)> {
    fs::metadata(path).ok().map(|data| (data.modified().ok(), data.len()))
}

/// Turns the result of saving into a sentence.
pub(super) fn save_message(
    path: &Path,
    result: Result<(), impl ToString>,
    language: Language,
) -> Result<String, String> {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let path = path.display();
    result.map(|()| say!(language, "Saved to {path}", "Salvo em {path}")).map_err(|error| error.to_string())
}
