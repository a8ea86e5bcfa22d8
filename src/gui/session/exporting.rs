//! The job that exports what takes long: pictures of another size, animations, drawings, tables.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use super::Session;
use super::files::file_name;
use super::job_result::JobResult;
use super::jobs::save_message;
use crate::cancel::{CancelOnDrop, CancelToken};
use crate::driver::{TracedPicture, trace_strips};
use crate::export::{Comparison, Drawing, Film, write_chrome, write_csv};
use crate::language::{Language, say};
use crate::output::write_whole;
use crate::picture::{Frame, Quality, Region, Size, write_png, write_png_with_alpha};
use crate::runlog::RunLog;
use crate::scene::Scene;
use crate::tracer::Tracer;

/// A file to make from the run on the stage or from compared runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Export {
    /// The picture, traced again.
    Picture(PictureExport),
    /// The ring or the timeline: PNG if the file name says so, else SVG.
    Drawing(Drawing),
    /// The run as an animation.
    Film(Film),
    /// The records as CSV.
    Table,
    /// The records for Perfetto.
    Chrome,
    /// The time budgets of compared runs as bars: PNG if the file name says so, else SVG.
    Bars(Comparison),
    /// Compared runs as CSV.
    Rows(Comparison),
}

/// A picture that is traced again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureExport {
    /// The size of the whole picture.
    pub size: Size,
    /// Its quality.
    pub quality: Quality,
    /// The part of it that is traced and saved; `None` is the whole picture.
    pub region: Option<Region>,
    /// Whether it is transparent where no solid is.
    pub transparent: bool,
}

/// The export in progress.
pub(super) struct ExportJob {
    job: u64,
    name: String,
    /// egui's clock at the start, in seconds.
    started: f64,
    /// Share that is done, 0 to 1.
    share: f64,
    /// Dropping it cancels the job.
    _cancel: CancelOnDrop,
}

/// An export that waits until the one before it is written.
pub(super) struct PendingExport {
    path: PathBuf,
    export: Export,
    /// The run as it was when the export was asked for.
    source: ExportSource,
}

/// Error of a cancelled job. The session ignores its result, so nobody reads it.
const CANCELLED: &str = "cancelled";

/// Progress of an export.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExportProgress<'a> {
    /// Name of the file.
    pub name: &'a str,
    /// Seconds since the start.
    pub elapsed_s: f64,
    /// Share that is done, 0 to 1.
    pub share: f64,
    /// Number of exports that wait.
    pub waiting: usize,
}

/// Input of the job.
struct ExportSource {
    log: RunLog,
    /// The picture as far as it is traced; `None` if it has to be traced for the export.
    frame: Option<Frame>,
}

/// Progress and cancellation of an export.
#[derive(Clone, Copy)]
struct ExportContext<'a> {
    /// Takes the share that is done, 0 to 1.
    progress: &'a (dyn Fn(f64) + Sync),
    cancel: &'a CancelToken,
}

impl Session {
    /// Makes the file `path` of the run as it is now, as soon as the exports before it are written.
    pub fn export(&mut self, path: PathBuf, export: Export) {
        // The picture of a recorded run may still be being traced.
        let has_picture = !self.is_recorded() || self.stage.source.has_ended();
        let source = ExportSource { log: self.stage.log.clone(), frame: has_picture.then(|| self.stage.frame.clone()) };
        self.exports_waiting.push_back(PendingExport { path, export, source });
        self.start_next_export();
    }

    /// Starts the job of the next export, unless one is in progress.
    fn start_next_export(&mut self) {
        if self.export_job.is_some() {
            return;
        }
        let Some(PendingExport { path, export, source }) = self.exports_waiting.pop_front() else { return };
        let language = self.language;
        let name = file_name(&path);
        let (job, owner) = (self.jobs.number(), CancelOnDrop::default());
        let cancel = owner.token();
        self.export_job = Some(ExportJob { job, name, started: self.clock, share: 0.0, _cancel: owner });
        let failed = move |why| JobResult::Exported(job, Err(why));
        self.jobs.start_many(language, "export", failed, move |send| {
            let percent = AtomicU32::new(0);
            let progress = |share: f64| {
                let now = (100.0 * share) as u32;
                // One message for each percent is enough for the window.
                if percent.fetch_max(now, Ordering::Relaxed) < now {
                    send(JobResult::Progress(job, share));
                }
            };
            let missing = source.write(&path, export, ExportContext { progress: &progress, cancel: &cancel });
            let letters = missing.as_ref().map(|letters| letters.iter().collect::<String>()).unwrap_or_default();
            let saved = save_message(&path, missing.map(drop), language);
            send(JobResult::Exported(job, saved.map(|saved| with_missing_letters(saved, &letters, language))));
        });
    }

    /// Returns the progress of the file that is being exported.
    pub fn export_progress(&self) -> Option<ExportProgress<'_>> {
        self.export_job.as_ref().map(|export| ExportProgress {
            name: &export.name,
            elapsed_s: self.clock - export.started,
            share: export.share,
            waiting: self.exports_waiting.len(),
        })
    }

    /// Returns the names of the files whose exports wait.
    pub(super) fn exports_waiting(&self) -> impl Iterator<Item = String> {
        self.exports_waiting.iter().map(|export| file_name(&export.path))
    }

    /// Cancels the export in progress, of which no part of the file stays, and starts the next.
    pub fn cancel_export(&mut self) {
        let language = self.language;
        if let Some(ExportJob { name, .. }) = self.export_job.take() {
            self.note(say!(language, "Cancelled: {name} was not saved", "Cancelado: {name} não foi salvo"));
            self.start_next_export();
        }
    }

    pub(super) fn take_progress(&mut self, job: u64, share: f64) {
        if let Some(export) = self.export_job.as_mut().filter(|export| export.job == job) {
            export.share = share;
        }
    }

    pub(super) fn take_exported(&mut self, job: u64, result: Result<String, String>) {
        // A cancelled job may still report its end.
        if self.export_job.take_if(|export| export.job == job).is_some() {
            match result {
                Ok(message) => self.note(message),
                Err(why) => self.trouble(why),
            }
            self.start_next_export();
        }
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

impl ExportSource {
    /// Makes the file. Returns the letters that no font of this computer has.
    ///
    /// # Errors
    /// A sentence, if the picture cannot be traced or the file cannot be written.
    fn write(&self, path: &Path, export: Export, context: ExportContext<'_>) -> Result<BTreeSet<char>, String> {
        let ExportContext { progress, cancel } = context;
        let log = &self.log;
        let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
        let mut missing = BTreeSet::new();
        let write = |fill: &mut dyn FnMut(&mut BufWriter<&mut File>) -> io::Result<()>| write_whole(path, fill);
        let written = match export {
            Export::Picture(PictureExport { size, quality, region, transparent }) => {
                let tracer = self.tracer(size, quality)?;
                let tracer = Arc::new(match region {
                    Some(region) => tracer.of_region(region),
                    None => tracer,
                });
                let bytes = trace_strips(&tracer, transparent, progress, cancel).map_err(|error| error.to_string())?;
                let write = if transparent { write_png_with_alpha } else { write_png };
                write(path, tracer.size(), &bytes.ok_or(CANCELLED)?)
            }
            Export::Drawing(drawing) => {
                write(&mut |file| drawing.write(file, log, is_png).map(|letters| missing = letters))
            }
            Export::Bars(comparison) => {
                write(&mut |file| comparison.write_bars(file, is_png).map(|letters| missing = letters))
            }
            Export::Rows(comparison) => write(&mut |file| comparison.write_csv(file)),
            Export::Film(film) => {
                let frame = match &self.frame {
                    Some(frame) => frame.clone(),
                    None => self.trace(cancel)?,
                };
                write(&mut |file| {
                    film.write(file, log, &frame, &mut |share| {
                        progress(share);
                        !cancel.is_cancelled()
                    })
                })
            }
            Export::Table => write(&mut |file| write_csv(file, log)),
            Export::Chrome => write(&mut |file| write_chrome(file, log)),
        };
        written.map(|()| missing).map_err(|error| error.to_string())
    }

    fn tracer(&self, size: Size, quality: Quality) -> Result<Tracer, String> {
        // The header's scene text has the camera of the shown picture.
        let scene = Scene::parse(&self.log.header.scene_text).map_err(|error| error.to_string())?;
        Ok(Tracer::new(&scene, size, quality))
    }

    fn trace(&self, cancel: &CancelToken) -> Result<Frame, String> {
        let header = &self.log.header;
        let tracer = Arc::new(self.tracer(header.size, header.quality)?);
        let traced = TracedPicture::unless_cancelled(&tracer, header.division, &|_| {}, cancel);
        let picture = traced.map_err(|error| error.to_string())?.ok_or(CANCELLED)?;
        Ok(Frame::of(header.size, &picture.pixels))
    }
}
