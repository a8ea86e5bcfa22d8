//! Encodes an animated GIF. Each frame has only the changed pixels, with a palette of its own, so that a picture that
//! fills in has many more than a frame's 256 colours.

use std::io::{self, Write};

use gif::{DisposalMethod, Encoder, Frame, Repeat};
use image::RgbImage;

use super::ExportError;
use super::frame_palette::FramePalette;
use crate::palette::Rgb;

/// Encoder of an animation. Frames are encoded as they come, so that at most two are in memory.
pub(super) struct Animation<W: Write> {
    encoder: Encoder<W>,
    /// The image shown so far; `None` before the first frame.
    seen: Option<RgbImage>,
}

impl<W: Write> Animation<W> {
    /// Begins an endlessly repeating animation of this width and height.
    pub fn begin(to: W, [width, height]: [u32; 2]) -> io::Result<Self> {
        let mut encoder = Encoder::new(to, side(width)?, side(height)?, &[]).map_err(io::Error::other)?;
        encoder.set_repeat(Repeat::Infinite).map_err(io::Error::other)?;
        Ok(Self { encoder, seen: None })
    }

    /// Appends an image that is shown for `hundredths` of a second.
    pub fn show(&mut self, image: &RgbImage, hundredths: u16) -> io::Result<()> {
        let [left, top, right, bottom] = self.changed(image);
        let new = |x, y| {
            let (pixel, seen) = (image.get_pixel(x, y), self.seen.as_ref().map(|seen| seen.get_pixel(x, y)));
            (seen != Some(pixel)).then_some(pixel.0)
        };
        let pixels: Vec<Option<Rgb>> = (top..bottom).flat_map(|y| (left..right).map(move |x| new(x, y))).collect();
        let palette = FramePalette::of(pixels.iter().flatten().copied());
        let index = |pixel: &Option<Rgb>| pixel.map_or(palette.transparent(), |colour| palette.index(colour));
        let frame = Frame {
            delay: hundredths,
            // Unchanged pixels are transparent.
            dispose: DisposalMethod::Keep,
            transparent: Some(palette.transparent()),
            left: side(left)?,
            top: side(top)?,
            width: side(right - left)?,
            height: side(bottom - top)?,
            buffer: pixels.iter().map(index).collect::<Vec<u8>>().into(),
            palette: Some(palette.palette()),
            ..Frame::default()
        };
        self.encoder.write_frame(&frame).map_err(io::Error::other)?;
        self.seen = Some(image.clone());
        Ok(())
    }

    /// Finishes the file.
    pub fn end(self) -> io::Result<()> {
        self.encoder.into_inner().map_err(io::Error::other)?.flush()
    }

    /// Returns left, top, right and bottom of the changed pixels; one pixel if none changed, since a frame cannot be
    /// empty.
    fn changed(&self, image: &RgbImage) -> [u32; 4] {
        let Some(seen) = &self.seen else { return [0, 0, image.width(), image.height()] };
        let pairs = image.enumerate_pixels().zip(seen.pixels());
        let mut new = pairs.filter(|((_, _, pixel), seen)| pixel != seen).map(|((x, y, _), _)| (x, y));
        let Some((x, y)) = new.next() else { return [0, 0, 1, 1] };
        new.fold([x, y, x + 1, y + 1], |[left, top, right, bottom], (x, y)| {
            [left.min(x), top.min(y), right.max(x + 1), bottom.max(y + 1)]
        })
    }
}

fn side(pixels: u32) -> io::Result<u16> {
    u16::try_from(pixels).map_err(|_| io::Error::other(ExportError::GifSide(pixels)))
}

#[cfg(test)]
mod tests {
    use image::codecs::gif::GifDecoder;
    use image::{AnimationDecoder, Rgb as Pixel};
    use proptest::prelude::*;

    use super::*;

    /// Decodes the frames, with the milliseconds for which each is shown.
    fn decoded(bytes: &[u8]) -> Vec<(RgbImage, u32)> {
        let frames = GifDecoder::new(io::Cursor::new(bytes)).expect("a GIF").into_frames();
        let frame = |frame: image::Frame| {
            let (millis, of) = frame.delay().numer_denom_ms();
            (image::DynamicImage::from(frame.into_buffer()).to_rgb8(), millis / of)
        };
        frames.map(|read| frame(read.expect("a frame"))).collect()
    }

    fn encoded(images: &[RgbImage]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let (width, height) = images[0].dimensions();
        let mut animation = Animation::begin(&mut bytes, [width, height]).expect("writing to memory cannot fail");
        (7..).zip(images).for_each(|(hundredths, image)| animation.show(image, hundredths).expect("a frame"));
        animation.end().expect("writing to memory cannot fail");
        bytes
    }

    proptest! {
        #[test]
        fn frames_decode_as_they_were_shown(
            images in (1..12u32, 1..12u32).prop_flat_map(|(width, height)| {
                let image = prop::collection::vec(0..4u8, 3 * (width * height) as usize);
                let image = image.prop_map(move |bytes| {
                    RgbImage::from_raw(width, height, bytes.into_iter().map(|byte| 60 * byte).collect()).expect("pixels")
                });
                prop::collection::vec(image, 1..5)
            }),
        ) {
            let seen = decoded(&encoded(&images));
            prop_assert_eq!(seen.len(), images.len());
            for (number, (image, (frame, millis))) in (7..).zip(images.iter().zip(&seen)) {
                prop_assert_eq!(image, frame);
                prop_assert_eq!(*millis, 10 * number);
            }
        }
    }

    #[test]
    fn palette_of_many_colours_stays_close() {
        let image = RgbImage::from_fn(200, 150, |x, y| Pixel([x as u8, y as u8, (x + y) as u8 / 2]));
        let seen = decoded(&encoded(std::slice::from_ref(&image)));
        let apart = image.iter().zip(seen[0].0.iter()).map(|(one, other)| u64::from(one.abs_diff(*other)));
        let mean = apart.sum::<u64>() as f64 / image.len() as f64;
        assert!(mean < 5.0, "{mean}");
    }

    #[test]
    fn unchanged_frame_takes_little_space() {
        let image = RgbImage::from_fn(200, 150, |x, y| Pixel([x as u8, y as u8, 0]));
        let (once, twice) = (encoded(std::slice::from_ref(&image)), encoded(&[image.clone(), image]));
        assert!(twice.len() < once.len() + 60, "{} {}", once.len(), twice.len());
    }
}
