//! Pictures without their background: each pixel has the share of it that solids cover.

use std::sync::atomic::{AtomicU32, Ordering};

use super::frame::{Colour, Frame, srgb8};

/// The covered share of each pixel of a picture, 0 to 1; threads fill it together. Pixels that are not traced have 0.
///
/// The colours that belong to it are *premultiplied*: the mean over all samples of a pixel, in which a sample without
/// a solid counts as black. So a pixel over a background is its colour + (1 − share) × the background, in linear light.
#[derive(Debug)]
pub struct Coverage(Vec<AtomicU32>);

impl Coverage {
    /// Creates the coverage of so many pixels.
    pub fn new(pixels: u32) -> Self {
        Self((0..pixels).map(|_| AtomicU32::new(0)).collect())
    }

    /// Sets the share of a pixel.
    pub fn set(&self, pixel: u32, share: f32) {
        // Whoever reads it has waited for the threads.
        self.0[pixel as usize].store(share.to_bits(), Ordering::Relaxed);
    }

    /// Returns the share of each pixel in scan order.
    pub fn shares(&self) -> impl Iterator<Item = f32> {
        self.0.iter().map(|share| f32::from_bits(share.load(Ordering::Relaxed)))
    }

    /// Returns the picture with transparency: [`srgba8`] of each pixel of `colours`, four bytes a pixel in scan order.
    pub fn to_srgba8(&self, colours: &[Colour]) -> Vec<u8> {
        colours.iter().zip(self.shares()).flat_map(|(&colour, share)| srgba8(colour, share)).collect()
    }

    /// Returns the picture over a background.
    pub fn over(&self, frame: &Frame, background: Colour) -> Frame {
        let over = |(colour, share): (&Colour, f32)| {
            std::array::from_fn(|channel| colour[channel] + (1.0 - share) * background[channel])
        };
        let pixels: Vec<Colour> = frame.pixels().iter().zip(self.shares()).map(over).collect();
        Frame::of(frame.size(), &pixels)
    }
}

/// Converts a premultiplied colour in linear light and its covered share to red, green, blue in sRGB and alpha. The
/// colour is that of the covered part alone, as PNG has it; without a covered part all are 0.
pub fn srgba8(colour: Colour, share: f32) -> [u8; 4] {
    if share <= 0.0 {
        return [0; 4];
    }
    let [red, green, blue] = srgb8(colour.map(|channel| channel / share));
    [red, green, blue, (255.0 * share.min(1.0)).round() as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_of_an_edge_is_that_of_its_covered_part() {
        assert_eq!(srgba8([0.125, 0.0, 0.25], 0.25), [188, 0, 255, 64]);
        assert_eq!(srgba8([0.0; 3], 0.0), [0; 4]);
        assert_eq!(srgba8([2.0, 0.5, 0.0], 1.0), [255, 188, 0, 255]);
    }
}
