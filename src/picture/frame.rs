//! The pixels of a picture, in linear light.

use std::ops::Range;
use std::sync::LazyLock;

use super::Size;

/// Red, green and blue in linear light; 1 is the brightest value of a PNG.
pub type Colour = [f32; 3];

/// The pixels of a picture in scan order, in linear light; pixels that have not arrived are black.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    size: Size,
    pixels: Vec<Colour>,
}

impl Frame {
    /// A black frame.
    pub fn new(size: Size) -> Self {
        Self { size, pixels: vec![[0.0; 3]; size.pixels() as usize] }
    }

    /// A frame with all its pixels.
    ///
    /// # Panics
    /// If the number of pixels is not that of the picture.
    pub fn of(size: Size, pixels: &[Colour]) -> Self {
        let mut frame = Self::new(size);
        frame.place(0..size.pixels(), pixels);
        frame
    }

    /// Width and height.
    pub fn size(&self) -> Size {
        self.size
    }

    /// All pixels in scan order.
    pub fn pixels(&self) -> &[Colour] {
        &self.pixels
    }

    /// Writes traced pixels to their positions in scan order.
    ///
    /// # Panics
    /// If `range` is not inside the picture or not as long as `pixels`. The protocol sends no such range.
    pub fn place(&mut self, range: Range<u32>, pixels: &[Colour]) {
        self.pixels[range.start as usize..range.end as usize].copy_from_slice(pixels);
    }

    /// The picture as it is shown and saved: [`srgb8`] of each pixel, three bytes a pixel in scan order.
    pub fn to_srgb8(&self) -> Vec<u8> {
        self.pixels.iter().flat_map(|&pixel| srgb8(pixel)).collect()
    }
}

/// Converts linear light to 8-bit sRGB (IEC 61966-2-1). Values outside 0…1 are clipped; NaN becomes black.
pub fn srgb8(colour: Colour) -> [u8; 3] {
    // A search needs no power for each pixel.
    static LEAST: LazyLock<[f32; 255]> = LazyLock::new(|| std::array::from_fn(least_of_step));
    colour.map(|linear| LEAST.partition_point(|&least| least <= linear) as u8)
}

/// The least linear value of step `index` + 1 of 255.
fn least_of_step(index: usize) -> f32 {
    let encoded = (index as f64 + 0.5) / 255.0;
    let linear = if encoded <= 0.040_45 { encoded / 12.92 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) };
    linear as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb8_has_fixed_points_and_clips() {
        assert_eq!(srgb8([0.0, 0.5, 1.0]), [0, 188, 255]);
        assert_eq!(srgb8([-1.0, f32::NAN, 7.0]), [0, 0, 255]);
    }
}
