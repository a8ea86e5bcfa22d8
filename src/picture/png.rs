//! The picture as a PNG file.

use std::io;
use std::path::Path;

use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

use super::Size;
use crate::output::{OutputError, write_whole};

/// Writes `rgb` (three bytes a pixel, sRGB, scan order) as a PNG.
///
/// # Errors
/// Those of [`write_whole`].
pub fn write_png(path: &Path, size: Size, rgb: &[u8]) -> Result<(), OutputError> {
    write_whole(path, |file| {
        PngEncoder::new(file)
            .write_image(rgb, size.width(), size.height(), ExtendedColorType::Rgb8)
            .map_err(io::Error::other)
    })
}
