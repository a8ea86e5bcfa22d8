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

/// Writes `rgba` (four bytes a pixel, as of [`srgba8`](super::srgba8)) as a PNG file with transparency.
///
/// # Errors
/// The errors of [`write_whole`].
pub fn write_png_with_alpha(path: &Path, size: Size, rgba: &[u8]) -> Result<(), OutputError> {
    write_whole(path, |file| encode(file, size, rgba, ExtendedColorType::Rgba8))
}

/// Writes `rgb` (as [`write_png`]) as a PNG to a stream.
///
/// # Errors
/// The errors of `to`.
pub fn encode_png(to: impl Write, size: Size, rgb: &[u8]) -> io::Result<()> {
    encode(to, size, rgb, ExtendedColorType::Rgb8)
}

fn encode(to: impl Write, size: Size, bytes: &[u8], kind: ExtendedColorType) -> io::Result<()> {
    PngEncoder::new(to).write_image(bytes, size.width(), size.height(), kind).map_err(io::Error::other)
}
