//! The ring or the timeline of a run as a file, SVG or PNG.

use std::collections::BTreeSet;
use std::io::{self, Write};

use super::{Raster, to_hatched_svg};
use crate::language::Language;
use crate::picture::encode_png;
use crate::runlog::RunLog;
use crate::time::Time;
use crate::view::PrintedDrawing;

/// A drawing of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawing {
    /// The ring at a time.
    Ring(Time),
    /// The timeline of the whole run.
    Timeline,
}

impl Drawing {
    /// Pixels of a PNG in a unit of the SVG.
    pub const PNG_SCALE: f32 = 2.0;

    /// Returns the drawing as SVG.
    pub fn svg(self, log: &RunLog) -> String {
        let PrintedDrawing { marks, size } = match self {
            Self::Ring(at) => PrintedDrawing::ring(log, at, Language::English),
            Self::Timeline => PrintedDrawing::timeline(log, Language::English),
        };
        to_hatched_svg(&marks, size)
    }

    /// Writes the drawing: as PNG if `is_png`, else as SVG. Returns the letters that no font of this computer has, and
    /// that are drawn as boxes.
    ///
    /// # Errors
    /// The error of writing to `to`; an [`ExportError`](super::ExportError), if the drawing cannot become pixels.
    pub fn write(self, to: impl Write, log: &RunLog, is_png: bool) -> io::Result<BTreeSet<char>> {
        write_drawing(to, &self.svg(log), is_png)
    }
}

/// Writes an SVG text, as pixels in PNG if `is_png`. Returns the letters that cannot be drawn.
pub(super) fn write_drawing(mut to: impl Write, svg: &str, is_png: bool) -> io::Result<BTreeSet<char>> {
    if !is_png {
        to.write_all(svg.as_bytes())?;
        // The program that shows it has fonts of its own.
        return Ok(BTreeSet::new());
    }
    let raster = Raster::new(svg);
    let (size, rgb) = raster.draw(svg, Drawing::PNG_SCALE).map_err(io::Error::other)?;
    encode_png(to, size, &rgb)?;
    Ok(raster.missing().clone())
}
