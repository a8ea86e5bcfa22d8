//! A preview of the whole picture: every 16th pixel of every 16th row, then every 8th of every 8th, and so on.
//!
//! Its pixels are pixels of the final picture and are not traced again, so that the preview costs nothing.

use super::observer::NoObserver;
use super::{RayCounts, Scratch, Tracer};
use crate::parallel::map_on_threads;
use crate::picture::{Colour, Size};

/// Evenly spread pixels of a picture.
#[derive(Clone, Debug)]
pub struct Preview {
    size: Size,
    step: u32,
    /// Colours by row, with the number of rays that each took.
    known: Vec<(Colour, RayCounts)>,
}

impl Preview {
    /// The first step: every 16th pixel of every 16th row.
    pub const COARSEST: u32 = 16;

    /// The distance between known pixels, in columns and in rows.
    pub fn step(&self) -> u32 {
        self.step
    }

    /// Estimates the colour of any pixel, by bilinear interpolation between the known ones.
    pub fn interpolate(&self, x: u32, y: u32) -> Colour {
        let (column, row) = (x / self.step, y / self.step);
        let part = |place: u32| (place % self.step) as f32 / self.step as f32;
        let (across, along) = (part(x), part(y));
        let (columns, rows) = self.shape();
        let (right, below) = ((column + 1).min(columns - 1), (row + 1).min(rows - 1));
        let at = |column: u32, row: u32| self.known[(row * columns + column) as usize].0;
        let corners = [at(column, row), at(right, row), at(column, below), at(right, below)];
        std::array::from_fn(|channel| {
            let [a, b, c, d] = corners.map(|colour| colour[channel]);
            let (above, below) = (a + (b - a) * across, c + (d - c) * across);
            above + (below - above) * along
        })
    }

    /// The pixel at this position in scan order, if it is known.
    fn get(&self, pixel: u32) -> Option<&(Colour, RayCounts)> {
        let (x, y) = (pixel % self.size.width(), pixel / self.size.width());
        let is_known = x.is_multiple_of(self.step) && y.is_multiple_of(self.step);
        is_known.then(|| &self.known[(y / self.step * self.shape().0 + x / self.step) as usize])
    }

    /// The known colours in scan order.
    pub fn colours(&self) -> impl Iterator<Item = Colour> {
        self.known.iter().map(|(colour, _)| *colour)
    }

    /// The numbers of columns and of rows with known pixels.
    pub fn shape(&self) -> (u32, u32) {
        (self.size.width().div_ceil(self.step), self.size.height().div_ceil(self.step))
    }
}

impl Tracer {
    /// The preview, if there is one.
    pub fn preview(&self) -> Option<&Preview> {
        self.preview.as_ref()
    }

    /// Begins a preview, or halves its step, down to the whole picture, on `threads` threads. The rays are counted when
    /// the picture is traced.
    pub fn refine(&mut self, threads: usize) {
        let step = self.preview.as_ref().map_or(Preview::COARSEST, |preview| (preview.step / 2).max(1));
        let rows: Vec<u32> = (0..self.size.height()).step_by(step as usize).collect();
        let known = map_on_threads(threads, &rows, |&y| {
            let mut scratch = Scratch::default();
            let trace = |x: u32| {
                let pixel = y * self.size.width() + x;
                let known = self.preview.as_ref().and_then(|coarser| coarser.get(pixel)).copied();
                known.unwrap_or_else(|| {
                    scratch.rays = RayCounts::default();
                    (self.pixel(pixel, &mut scratch, &mut NoObserver), scratch.rays)
                })
            };
            (0..self.size.width()).step_by(step as usize).map(trace).collect::<Vec<_>>()
        });
        self.preview = Some(Preview { size: self.size, step, known: known.concat() });
    }

    /// The colour of the pixel at this position in scan order, from the preview or traced now.
    #[inline(always)]
    pub(super) fn previewed_or_traced(&self, pixel: u32, scratch: &mut Scratch) -> Colour {
        match self.preview.as_ref().and_then(|preview| preview.get(pixel)) {
            Some((colour, rays)) => {
                scratch.rays += *rays;
                *colour
            }
            None => self.pixel(pixel, scratch, &mut NoObserver),
        }
    }
}
