//! The queue of exports: files that are being written, or wait for that.

use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};

use super::Session;
use super::export_file::{Export, ExportContext};
use super::files::file_name;
use super::job_result::JobResult;
use super::jobs::save_message;
use crate::cancel::CancelOnDrop;
use crate::language::{Language, say};

/// A file that is being written, or waits for that.
pub(super) struct ExportJob {
    job: u64,
    name: String,
    takes_long: bool,
    state: ExportState,
}

enum ExportState {
    /// It is made when the files before it are written.
    Waiting(Box<WriteFile>),
    Writing {
        /// egui's clock at the start, in seconds.
        started: f64,
        /// Share that is done, 0 to 1.
        share: f64,
        /// Dropping it cancels the job.
        _cancel: CancelOnDrop,
    },
}

/// Makes a file of the run as it was when that was asked for. Returns a sentence with its path.
type WriteFile = dyn FnOnce(ExportContext<'_>) -> Result<String, String> + Send;

/// A file that is being written, or waits for that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExportProgress<'a> {
    /// Number of its job.
    pub job: u64,
    /// Name of the file.
    pub name: &'a str,
    /// Whether it needs all cores for long.
    pub takes_long: bool,
    /// Seconds since the start, and the share that is done, 0 to 1; `None` while it waits.
    pub done: Option<(f64, f64)>,
}

impl Session {
    /// Makes the file `path` of the run as it is now. One that takes long waits for others of its kind.
    pub fn export(&mut self, path: PathBuf, export: Export) {
        let (job, name, takes_long) = (self.jobs.number(), file_name(&path), export.takes_long());
        let write = self.write_file(path, export);
        self.exports.push(ExportJob { job, name, takes_long, state: ExportState::Waiting(write) });
        self.start_exports();
    }

    /// Returns what makes the file.
    fn write_file(&self, path: PathBuf, export: Export) -> Box<WriteFile> {
        let language = self.language;
        let source = self.export_source();
        Box::new(move |context| {
            let missing = source.write(&path, export, context);
            let letters = missing.as_ref().map(|letters| letters.iter().collect::<String>()).unwrap_or_default();
            let saved = save_message(&path, missing.map(drop), language);
            saved.map(|saved| with_missing_letters(saved, &letters, language))
        })
    }

    /// Starts all waiting jobs that need not wait for another one.
    fn start_exports(&mut self) {
        let is_writing = |export: &ExportJob| matches!(export.state, ExportState::Writing { .. });
        let mut is_busy = self.exports.iter().any(|export| export.takes_long && is_writing(export));
        for export in self.exports.iter_mut().filter(|export| !is_writing(export)) {
            if export.takes_long && std::mem::replace(&mut is_busy, true) {
                continue;
            }
            let (job, owner) = (export.job, CancelOnDrop::default());
            let cancel = owner.token();
            let writing = ExportState::Writing { started: self.clock, share: 0.0, _cancel: owner };
            let ExportState::Waiting(write) = std::mem::replace(&mut export.state, writing) else { continue };
            let failed = move |why| JobResult::Exported(job, Err(why));
            self.jobs.start_many(self.language, "export", failed, move |send| {
                let percent = AtomicU32::new(0);
                let progress = |share: f64| {
                    let now = (100.0 * share) as u32;
                    // One message for each percent is enough for the window.
                    if percent.fetch_max(now, Ordering::Relaxed) < now {
                        send(JobResult::Progress(job, share));
                    }
                };
                send(JobResult::Exported(job, write(ExportContext { progress: &progress, cancel: &cancel })));
            });
        }
    }

    /// Returns the files that are being written, or wait for that, in the order in which they were asked for.
    pub fn exports(&self) -> impl Iterator<Item = ExportProgress<'_>> {
        self.exports.iter().map(|export| ExportProgress {
            job: export.job,
            name: &export.name,
            takes_long: export.takes_long,
            done: match export.state {
                ExportState::Waiting(_) => None,
                ExportState::Writing { started, share, .. } => Some((self.clock - started, share)),
            },
        })
    }

    /// Cancels an export, of which no part of the file stays.
    pub fn cancel_export(&mut self, job: u64) {
        let language = self.language;
        if let Some(index) = self.exports.iter().position(|export| export.job == job) {
            let ExportJob { name, .. } = self.exports.remove(index);
            self.note(say!(language, "Cancelled: {name} was not saved", "Cancelado: {name} não foi salvo"));
            self.start_exports();
        }
    }

    pub(super) fn take_progress(&mut self, job: u64, done: f64) {
        for export in self.exports.iter_mut().filter(|export| export.job == job) {
            if let ExportState::Writing { share, .. } = &mut export.state {
                *share = done;
            }
        }
    }

    pub(super) fn take_exported(&mut self, job: u64, result: Result<String, String>) {
        // A cancelled job may still report its end.
        let Some(index) = self.exports.iter().position(|export| export.job == job) else { return };
        self.exports.remove(index);
        match result {
            Ok(message) => self.note(message),
            Err(why) => self.trouble(why),
        }
        self.start_exports();
    }
}

/// Adds to the message of a saved drawing that no font has these letters, if there are any.
fn with_missing_letters(saved: String, letters: &str, language: Language) -> String {
    if letters.is_empty() {
        return saved;
    }
    say!(
        language,
        "{saved}. No font of this computer has {letters}; they are drawn as boxes. Save it as .svg instead",
        "{saved}. Nenhuma fonte deste computador tem {letters}; aparecem como caixas. Salve como .svg"
    )
}
