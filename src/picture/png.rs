//! PNG files.

use std::io::{self, Write};
use std::path::Path;

use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

use super::Size;
use crate::output::{OutputError, write_whole};

/// Writes `rgb` (three bytes a pixel, sRGB, scan order) as a PNG file.
///
/// # Errors
/// The errors of [`write_whole`].
pub fn write_png(path: &Path, size: Size, rgb: &[u8]) -> Result<(), OutputError> {
    write_whole(path, |file| encode_png(file, size, rgb))
}

/// Writes `rgb` (as [`write_png`]) as a PNG to a stream.
///
/// # Errors
/// The errors of `to`.
pub fn encode_png(to: impl Write, size: Size, rgb: &[u8]) -> io::Result<()> {
    PngEncoder::new(to).write_image(rgb, size.width(), size.height(), ExtendedColorType::Rgb8).map_err(io::Error::other)
}
