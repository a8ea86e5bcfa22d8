//! Previews: what a file will show, before it is saved.

use std::sync::Arc;

use image::RgbImage;
use image::imageops::thumbnail;

use super::Session;
use super::export_file::{Export, ExportSource, PictureExport};
use super::job_result::{ExportPreview, JobResult};
use crate::cancel::{CancelOnDrop, CancelToken};
use crate::driver::trace_strips;
use crate::export::Raster;
use crate::picture::{Quality, Region, Size};
use crate::time::Time;

impl Session {
    /// Starts the job that makes the preview of a file, neither side of it longer than `max_side` pixels. Returns the
    /// job's number; dropping the other value cancels it.
    pub fn preview_export(&mut self, export: Export, max_side: u32) -> (u64, CancelOnDrop) {
        let (job, owner) = (self.jobs.number(), CancelOnDrop::default());
        let (source, at, cancel) = (self.export_source(), self.now(), owner.token());
        let failed = move |why| JobResult::ExportPreviewed(job, Err(why));
        self.jobs.start_many(self.language, "preview", failed, move |send| {
            send(JobResult::ExportPreviewed(job, source.preview(export, at, max_side, &cancel)));
        });
        (job, owner)
    }
}

impl ExportSource {
    /// Makes the preview of a file; `at` is the shown time. `None` if the file is no picture, or if it is cancelled.
    fn preview(
        self,
        export: Export,
        at: Time,
        max_side: u32,
        cancel: &CancelToken,
    ) -> Result<Option<ExportPreview>, String> {
        let (size, rgb) = match export {
            Export::Shown(look) => (self.log.header.size, self.shown_pixels(look)),
            Export::Picture(picture) => return self.traced_preview(picture, max_side, cancel),
            Export::Drawing(drawing) => drawn(&drawing.svg(&self.log))?,
            Export::Bars(comparison) => drawn(&comparison.bars_svg())?,
            Export::Film(film) => film.still(&self.log, &self.frame, at).map_err(|error| error.to_string())?,
            Export::Run | Export::Table | Export::Chrome | Export::Rows(_) => return Ok(None),
        };
        let whole = [size.width(), size.height()];
        Ok(shrunk(size, rgb, max_side).map(|(size, rgb)| ExportPreview { size, rgb, whole }))
    }

    /// Traces a picture, or its region, with few pixels. A checkerboard shows where it is transparent.
    fn traced_preview(
        &self,
        picture: PictureExport,
        max_side: u32,
        cancel: &CancelToken,
    ) -> Result<Option<ExportPreview>, String> {
        let PictureExport { size, quality, region, transparent } = picture;
        let of_file = region.map_or(size, |region| region.size);
        let scale = f64::from(max_side) / f64::from(of_file.width().max(of_file.height()));
        let scaled = |pixels: u32| ((f64::from(pixels) * scale.min(1.0)) as u32).max(1);
        let scaled_size = |size: Size| Size::new(scaled(size.width()), scaled(size.height()));
        let quality = Quality { samples: quality.samples.min(2), ..quality };
        let tracer = self.tracer(scaled_size(size).map_err(|error| error.to_string())?, quality)?;
        let tracer = Arc::new(match region {
            Some(Region { x, y, size }) => {
                let [x, y] = [x, y].map(|side| (f64::from(side) * scale.min(1.0)) as u32);
                tracer.of_region(Region { x, y, size: scaled_size(size).map_err(|error| error.to_string())? })
            }
            None => tracer,
        });
        let bytes = trace_strips(&tracer, transparent, &|_| {}, cancel).map_err(|error| error.to_string())?;
        let whole = [of_file.width(), of_file.height()];
        let size = tracer.size();
        let over = |bytes: Vec<u8>| if transparent { over_checkerboard(&bytes, size.width()) } else { bytes };
        Ok(bytes.map(|bytes| ExportPreview { size, rgb: over(bytes), whole }))
    }
}

/// Draws an SVG text in its own size.
fn drawn(svg: &str) -> Result<(Size, Vec<u8>), String> {
    Raster::new(svg).draw(svg, 1.0).map_err(|error| error.to_string())
}

/// Returns a picture with fewer pixels, neither side longer than `max_side`; `None` if there are no pixels.
fn shrunk(size: Size, rgb: Vec<u8>, max_side: u32) -> Option<(Size, Vec<u8>)> {
    let longer = size.width().max(size.height());
    if longer <= max_side {
        return Some((size, rgb));
    }
    let image = RgbImage::from_raw(size.width(), size.height(), rgb)?;
    let side = |pixels: u32| (u64::from(pixels) * u64::from(max_side) / u64::from(longer)).max(1) as u32;
    let small = thumbnail(&image, side(size.width()), side(size.height()));
    Some((Size::new(small.width(), small.height()).ok()?, small.into_raw()))
}

/// Lays a picture with alpha, four bytes a pixel, over a checkerboard. Returns three bytes a pixel.
fn over_checkerboard(rgba: &[u8], width: u32) -> Vec<u8> {
    const SQUARE_PX: usize = 8;
    let width = width.max(1) as usize;
    let pixels = rgba.chunks_exact(4).enumerate();
    let pixel = |(index, pixel): (usize, &[u8])| {
        let is_light = (index % width / SQUARE_PX + index / width / SQUARE_PX).is_multiple_of(2);
        let (ground, alpha) = (if is_light { 0xcc } else { 0x99 }, u32::from(pixel[3]));
        [0, 1, 2].map(|channel| ((u32::from(pixel[channel]) * alpha + ground * (255 - alpha)) / 255) as u8)
    };
    pixels.flat_map(pixel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shrunk_picture_keeps_its_shape_and_its_colours() {
        let size = Size::new(60, 20).expect("a size");
        let (small, rgb) = shrunk(size, [10, 20, 30].repeat(1200), 15).expect("pixels");
        assert_eq!((small.width(), small.height(), rgb), (15, 5, [10, 20, 30].repeat(75)));
        assert_eq!(shrunk(size, vec![0; 3600], 60).map(|(size, _)| size), Some(size));
    }

    #[test]
    fn checkerboard_shows_through() {
        let rgb = over_checkerboard(&[[200, 100, 0, 255], [0, 0, 0, 0]].concat().repeat(8), 16);
        assert_eq!((&rgb[..6], &rgb[27..30]), (&[200, 100, 0, 0xcc, 0xcc, 0xcc][..], &[0x99; 3][..]));
    }
}
