//! The finished pixels, in linear light.

use std::ops::Range;

use super::Size;

/// Red, green and blue in linear light; 1 is the brightest that a PNG can show.
pub type Colour = [f32; 3];

/// A picture's pixels in scan order, in linear light; what has not arrived yet is black.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    size: Size,
    pixels: Vec<Colour>,
}

impl Frame {
    /// A frame in which nothing has arrived yet.
    pub fn new(size: Size) -> Self {
        Self { size, pixels: vec![[0.0; 3]; size.pixels() as usize] }
    }

    /// A frame whose pixels are all there.
    ///
    /// # Panics
    /// If the pixels are not as many as the picture has.
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

    /// Puts traced pixels in their place.
    ///
    /// # Panics
    /// If `range` is not inside the picture or not as long as `pixels`: the protocol never sends such.
    pub fn place(&mut self, range: Range<u32>, pixels: &[Colour]) {
        self.pixels[range.start as usize..range.end as usize].copy_from_slice(pixels);
    }

    /// The picture as it is shown and saved: [`srgb8`] of each pixel, three bytes a pixel in scan order.
    pub fn to_srgb8(&self) -> Vec<u8> {
        self.pixels.iter().flat_map(|&pixel| srgb8(pixel)).collect()
    }
}

/// A colour in linear light as 8-bit sRGB (IEC 61966-2-1); what is outside 0…1 is clipped, NaN is black.
pub fn srgb8(colour: Colour) -> [u8; 3] {
    colour.map(|linear| {
        let linear = linear.clamp(0.0, 1.0);
        let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
        (encoded * 255.0).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_has_its_fixed_points_and_clips() {
        assert_eq!(srgb8([0.0, 0.5, 1.0]), [0, 188, 255]);
        assert_eq!(srgb8([-1.0, f32::NAN, 7.0]), [0, 0, 255]);
    }
}
