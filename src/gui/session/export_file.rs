//! What is made of a run: pictures, animations, drawings, tables, the run file.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;
use std::sync::Arc;

use super::Session;
use crate::cancel::CancelToken;
use crate::driver::{TracedPicture, trace_strips};
use crate::export::{Comparison, Drawing, Film, write_chrome, write_csv};
use crate::output::write_whole;
use crate::palette::Rgb;
use crate::picture::{Frame, Quality, Region, Size, write_png, write_png_with_alpha};
use crate::runlog::RunLog;
use crate::scene::Scene;
use crate::tracer::Tracer;
use crate::view::{Layer, RunState, picture_pixels};

/// A file to make from the run on the stage or from compared runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Export {
    /// The picture as far as it is traced, with a layer of this share: 0 (the render alone) to 1 (the layer alone).
    Shown((Layer, f32)),
    /// The picture, traced again.
    Picture(PictureExport),
    /// The ring or the timeline: PNG if the file name says so, else SVG.
    Drawing(Drawing),
    /// The run as an animation.
    Film(Film),
    /// The records, to be played again.
    Run,
    /// The records as CSV.
    Table,
    /// The records for Perfetto.
    Chrome,
    /// The time budgets of compared runs as bars: PNG if the file name says so, else SVG.
    Bars(Comparison),
    /// Compared runs as CSV.
    Rows(Comparison),
}

impl Export {
    /// Whether it needs all cores for long, so that such files are made one after the other.
    pub(super) fn takes_long(&self) -> bool {
        matches!(self, Self::Picture(_) | Self::Film(_))
    }
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

/// Error of a cancelled job. The session ignores its result, so nobody reads it.
const CANCELLED: &str = "cancelled";

/// The run from which a file is made.
pub(super) struct ExportSource {
    /// Header and records.
    pub log: RunLog,
    /// The picture as far as it is traced.
    pub frame: Frame,
    /// Whether no other part of the picture can be traced for the file.
    is_frame_whole: bool,
    state: RunState,
    colours: Vec<Rgb>,
}

/// Progress and cancellation of an export.
#[derive(Clone, Copy)]
pub(super) struct ExportContext<'a> {
    /// Takes the share that is done, 0 to 1.
    pub progress: &'a (dyn Fn(f64) + Sync),
    /// Cancels the work.
    pub cancel: &'a CancelToken,
}

impl Session {
    /// Returns the run as it is now.
    pub(super) fn export_source(&self) -> ExportSource {
        let stage = &self.stage;
        ExportSource {
            log: stage.log.clone(),
            frame: stage.frame.clone(),
            // The picture of a recorded run may still be being traced.
            is_frame_whole: !self.is_recorded() || stage.source.has_ended(),
            state: stage.latest().clone(),
            colours: stage.colours.clone(),
        }
    }
}

impl ExportSource {
    /// Makes the file. Returns the letters that no font of this computer has.
    ///
    /// # Errors
    /// A sentence, if the picture cannot be traced or the file cannot be written.
    pub fn write(self, path: &Path, export: Export, context: ExportContext<'_>) -> Result<BTreeSet<char>, String> {
        let ExportContext { progress, cancel } = context;
        let log = &self.log;
        let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
        let mut missing = BTreeSet::new();
        let write = |fill: &mut dyn FnMut(&mut BufWriter<&mut File>) -> io::Result<()>| write_whole(path, fill);
        let written = match export {
            Export::Shown(look) => write_png(path, log.header.size, &self.shown_pixels(look)),
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
                let frame = self.picture(cancel)?;
                write(&mut |file| {
                    film.write(file, log, &frame, &mut |share| {
                        progress(share);
                        !cancel.is_cancelled()
                    })
                })
            }
            Export::Run => log.save(path),
            Export::Table => write(&mut |file| write_csv(file, log)),
            Export::Chrome => write(&mut |file| write_chrome(file, log)),
        };
        written.map(|()| missing).map_err(|error| error.to_string())
    }

    /// Returns the tracer of the picture at another size and quality.
    ///
    /// # Errors
    /// A sentence, if the scene of the run cannot be read.
    pub fn tracer(&self, size: Size, quality: Quality) -> Result<Tracer, String> {
        // The header's scene text has the camera of the shown picture.
        let scene = Scene::parse(&self.log.header.scene_text).map_err(|error| error.to_string())?;
        Ok(Tracer::new(&scene, size, quality))
    }

    /// Returns the picture with a layer, as it is saved.
    pub fn shown_pixels(&self, look: (Layer, f32)) -> Vec<u8> {
        picture_pixels(&self.frame, &self.state, &self.colours, look)
    }

    /// Returns the picture, traced first where that is needed.
    fn picture(&self, cancel: &CancelToken) -> Result<Frame, String> {
        if self.is_frame_whole {
            return Ok(self.frame.clone());
        }
        let header = &self.log.header;
        let tracer = Arc::new(self.tracer(header.size, header.quality)?);
        let traced = TracedPicture::unless_cancelled(&tracer, header.division, &|_| {}, cancel);
        let picture = traced.map_err(|error| error.to_string())?.ok_or(CANCELLED)?;
        Ok(Frame::of(header.size, &picture.pixels))
    }
}
