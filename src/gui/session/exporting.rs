//! The job that makes what takes its time: pictures of another size, films, drawings, tables.

use std::fs::File;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use super::Session;
use super::job_result::JobResult;
use super::jobs::told;
use crate::cancel::{CancelOnDrop, CancelToken};
use crate::driver::{TracedPicture, trace_strips};
use crate::export::{Comparison, Drawing, Film, write_chrome, write_csv};
use crate::language::say;
use crate::output::{OutputError, write_whole};
use crate::picture::{Frame, Quality, Size, write_png};
use crate::runlog::RunLog;
use crate::scene::Scene;
use crate::tracer::Tracer;

/// What is made of what is shown.
#[derive(Clone, Debug, PartialEq)]
pub enum Export {
    /// The picture, traced anew.
    Picture(Size, Quality),
    /// The ring or the timeline: as PNG if the file is named so, else as SVG.
    Drawing(Drawing),
    /// The run as an animation.
    Film(Film),
    /// The records as CSV.
    Table,
    /// The records for Perfetto.
    Chrome,
    /// Where the time of compared runs went: as PNG if the file is named so, else as SVG.
    Bars(Comparison),
    /// Compared runs as CSV.
    Rows(Comparison),
}

/// What is being made.
pub(super) struct ExportJob {
    job: u64,
    name: String,
    since: f64,
    part: f64,
    /// Dropping it ends the job.
    _cancel: CancelOnDrop,
}

/// What the job is made of.
struct ExportSource {
    log: RunLog,
    /// The picture, if all that is known of it is there.
    frame: Option<Frame>,
}

/// What a job needs besides its source: how to tell the part that is done, and whether to end.
#[derive(Clone, Copy)]
struct ExportContext<'a> {
    tell: &'a (dyn Fn(f64) + Sync),
    cancel: &'a CancelToken,
}

impl Session {
    /// Makes it in the background and writes it to `path`.
    pub fn export(&mut self, path: PathBuf, export: Export) {
        let language = self.language;
        if let Some(ExportJob { name, .. }) = &self.making {
            return self.trouble(say!(
                language,
                "{name} is still being made: cancel it first",
                "{name} ainda está sendo feito: cancele antes"
            ));
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // The picture of a recorded run is traced again while it is shown.
        let is_known = !self.is_recorded() || self.stage.performer.has_ended();
        let source = ExportSource { log: self.stage.log.clone(), frame: is_known.then(|| self.stage.frame.clone()) };
        let (job, owner) = (self.jobs.number(), CancelOnDrop::default());
        let cancel = owner.token();
        // What was said of the file before would cover how far this one is.
        self.notice = None;
        self.making = Some(ExportJob { job, name, since: self.clock, part: 0.0, _cancel: owner });
        let failed = move |why| JobResult::Made(job, Err(why));
        self.jobs.start_many(language, "export", failed, move |tell| {
            let percent = AtomicU32::new(0);
            let tell_part = |part: f64| {
                let now = (100.0 * part) as u32;
                // The window need not hear more often.
                if percent.fetch_max(now, Ordering::Relaxed) < now {
                    tell(JobResult::Progress(job, part));
                }
            };
            let made = source.make(&path, export, ExportContext { tell: &tell_part, cancel: &cancel });
            tell(JobResult::Made(job, made.and_then(|written| told(&path, written, language))));
        });
    }

    /// What is being made, how many seconds already, and what part of it is done.
    pub fn making(&self) -> Option<(&str, f64, f64)> {
        self.making.as_ref().map(|making| (&*making.name, self.clock - making.since, making.part))
    }

    /// Gives up what is being made; nothing of it is kept.
    pub fn stop_making(&mut self) {
        let language = self.language;
        if let Some(ExportJob { name, .. }) = self.making.take() {
            self.note(say!(
                language,
                "Cancelled: nothing of {name} was kept",
                "Cancelado: nada de {name} foi guardado"
            ));
        }
    }

    pub(super) fn progress(&mut self, job: u64, part: f64) {
        if let Some(making) = self.making.as_mut().filter(|making| making.job == job) {
            making.part = part;
        }
    }

    pub(super) fn made(&mut self, job: u64, made: Result<String, String>) {
        // What was given up may end later.
        if self.making.take_if(|making| making.job == job).is_some() {
            match made {
                Ok(said) => self.note(said),
                Err(why) => self.trouble(why),
            }
        }
    }
}

impl ExportSource {
    /// Makes it and writes it.
    ///
    /// # Errors
    /// A sentence, if it cannot be made; within it what writing came to.
    fn make(&self, path: &Path, export: Export, context: ExportContext<'_>) -> Result<Result<(), OutputError>, String> {
        let ExportContext { tell, cancel } = context;
        let log = &self.log;
        let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
        let write = |fill: &dyn Fn(&mut BufWriter<&mut File>) -> io::Result<()>| write_whole(path, fill);
        Ok(match export {
            Export::Picture(size, quality) => {
                let tracer = self.tracer(size, quality)?;
                let rgb = trace_strips(&tracer, tell, cancel).map_err(|error| error.to_string())?;
                write_png(path, size, &rgb.ok_or("it was stopped")?)
            }
            Export::Drawing(drawing) => write(&|file| drawing.write(file, log, is_png)),
            Export::Bars(comparison) => write(&|file| comparison.write_bars(file, is_png)),
            Export::Rows(comparison) => write(&|file| comparison.write_csv(file)),
            Export::Film(film) => {
                let frame = match &self.frame {
                    Some(frame) => frame.clone(),
                    None => self.traced(cancel)?,
                };
                write(&|file| {
                    film.write(file, log, &frame, &mut |part| {
                        tell(part);
                        !cancel.is_cancelled()
                    })
                })
            }
            Export::Table => write(&|file| write_csv(file, log)),
            Export::Chrome => write(&|file| write_chrome(file, log)),
        })
    }

    fn tracer(&self, size: Size, quality: Quality) -> Result<Arc<Tracer>, String> {
        // The text has the camera of what is shown.
        let scene = Scene::parse(&self.log.header.scene_text).map_err(|error| error.to_string())?;
        Ok(Arc::new(Tracer::new(&scene, size, quality)))
    }

    fn traced(&self, cancel: &CancelToken) -> Result<Frame, String> {
        let header = &self.log.header;
        let tracer = self.tracer(header.size, header.quality)?;
        let traced = TracedPicture::unless_cancelled(&tracer, header.division, &|_| {}, cancel);
        let picture = traced.map_err(|error| error.to_string())?.ok_or("it was stopped")?;
        Ok(Frame::of(header.size, &picture.pixels))
    }
}
