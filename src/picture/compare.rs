//! The difference between two pictures.
//!
//! A mean hides speckle, hence three numbers. ꟻLIP (Andersson et al. 2020) follows human sight best, but is left out:
//! every library of it needs a C++ compiler.

use super::frame::{Colour, Frame, srgb8};

/// The difference between a picture and its reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// The root of the mean squared error over all pixels and channels, in linear light; at least 0.
    pub rmse: f64,
    /// The number of pixels with a channel that differs by more than [`Difference::TOLERANCE`], in 8-bit sRGB.
    pub wrong_pixels: u32,
    /// The smallest structural similarity of a block of 8 × 8 pixels, from −1 to 1 (equal), by luminance in 8-bit sRGB
    /// (Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, *Image quality assessment: from error visibility to
    /// structural similarity*, 2004, equation 13).
    pub worst_ssim: f64,
}

impl Difference {
    /// The greatest difference between 8-bit sRGB values that counts as equal.
    pub const TOLERANCE: u8 = 2;

    /// # Panics
    /// If the pictures differ in size.
    pub fn of(picture: &Frame, reference: &Frame) -> Self {
        assert_eq!(picture.size(), reference.size(), "only pictures of one size are compared");
        Self {
            rmse: rmse(picture.pixels(), reference.pixels()),
            wrong_pixels: wrong_pixels(picture, reference),
            worst_ssim: worst_ssim(picture, reference),
        }
    }
}

/// The difference of the channel that differs most.
pub fn max_channel_difference(a: [u8; 3], b: [u8; 3]) -> u8 {
    a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
}

/// The root of the mean squared difference of all channels.
fn rmse(pixels: &[Colour], reference: &[Colour]) -> f64 {
    let channels = pixels.as_flattened().iter().zip(reference.as_flattened());
    let squares = channels.map(|(&a, &b)| (f64::from(a) - f64::from(b)).powi(2));
    (squares.sum::<f64>() / (3 * pixels.len()) as f64).sqrt()
}

fn wrong_pixels(picture: &Frame, reference: &Frame) -> u32 {
    let is_wrong = |(&a, &b): (&Colour, &Colour)| max_channel_difference(srgb8(a), srgb8(b)) > Difference::TOLERANCE;
    picture.pixels().iter().zip(reference.pixels()).filter(|&pair| is_wrong(pair)).count() as u32
}

/// The side of a block.
const BLOCK_SIDE_PX: u32 = 8;

fn worst_ssim(picture: &Frame, reference: &Frame) -> f64 {
    let (size, pixels) = (picture.size(), [luminances(picture), luminances(reference)]);
    let block = |x: u32, y: u32| {
        let (columns, rows) = (x..(x + BLOCK_SIDE_PX).min(size.width()), y..(y + BLOCK_SIDE_PX).min(size.height()));
        let places = rows.flat_map(|y| columns.clone().map(move |x| (y * size.width() + x) as usize));
        ssim(places.map(|place| (pixels[0][place], pixels[1][place])))
    };
    let corners = block_starts(size.height()).flat_map(|y| block_starts(size.width()).map(move |x| (x, y)));
    corners.map(|(x, y)| block(x, y)).fold(1.0, f64::min)
}

/// The first pixels of the blocks along a side. Blocks follow one another, but the last one ends with the picture.
fn block_starts(side: u32) -> impl Iterator<Item = u32> + Clone {
    (0..side.div_ceil(BLOCK_SIDE_PX)).map(move |block| (block * BLOCK_SIDE_PX).min(side.saturating_sub(BLOCK_SIDE_PX)))
}

/// The luminance of the 8-bit sRGB picture, 0 to 255 (the weights of Rec. ITU-R BT.709).
fn luminances(frame: &Frame) -> Vec<f64> {
    let luminance = |&pixel: &Colour| {
        let [red, green, blue] = srgb8(pixel).map(f64::from);
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    };
    frame.pixels().iter().map(luminance).collect()
}

/// The structural similarity of pairs of values from 0 to 255.
fn ssim(pairs: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    const C1: f64 = (0.01 * 255.0) * (0.01 * 255.0);
    const C2: f64 = (0.03 * 255.0) * (0.03 * 255.0);
    let count = pairs.clone().count() as f64;
    let mean = |of: &dyn Fn(f64, f64) -> f64| pairs.clone().map(|(a, b)| of(a, b)).sum::<f64>() / count;
    let (a_mean, b_mean) = (mean(&|a, _| a), mean(&|_, b| b));
    let a_variance = mean(&|a, _| (a - a_mean).powi(2));
    let b_variance = mean(&|_, b| (b - b_mean).powi(2));
    let covariance = mean(&|a, b| (a - a_mean) * (b - b_mean));
    let luminance = (2.0 * a_mean * b_mean + C1) / (a_mean * a_mean + b_mean * b_mean + C1);
    luminance * (2.0 * covariance + C2) / (a_variance + b_variance + C2)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::Size;
    use super::*;

    fn frame(width: u32, height: u32, pixels: &[Colour]) -> Frame {
        Frame::of(Size::new(width, height).unwrap(), pixels)
    }

    fn pictures() -> impl Strategy<Value = (Frame, Frame)> {
        (1..30_u32, 1..30_u32).prop_flat_map(|(width, height)| {
            let pixels = || prop::collection::vec(prop::array::uniform3(0.0..1.0_f32), (width * height) as usize);
            (pixels(), pixels()).prop_map(move |(a, b)| (frame(width, height, &a), frame(width, height, &b)))
        })
    }

    proptest! {
        #[test]
        fn picture_equals_itself((a, _) in pictures()) {
            let Difference { rmse, wrong_pixels, worst_ssim } = Difference::of(&a, &a);
            prop_assert!(rmse == 0.0 && wrong_pixels == 0 && (worst_ssim - 1.0).abs() < 1e-9);
        }

        #[test]
        fn difference_is_symmetric((a, b) in pictures()) {
            let (there, back) = (Difference::of(&a, &b), Difference::of(&b, &a));
            prop_assert!((there.worst_ssim - back.worst_ssim).abs() < 1e-12);
            prop_assert_eq!((there.rmse, there.wrong_pixels), (back.rmse, back.wrong_pixels));
            prop_assert!((-1.0..=1.0).contains(&there.worst_ssim) && there.wrong_pixels <= a.size().pixels());
        }

        #[test]
        fn rmse_is_linear((a, b) in pictures()) {
            let middle: Vec<Colour> =
                a.pixels().iter().zip(b.pixels()).map(|(a, b)| [0, 1, 2].map(|i| (a[i] + b[i]) / 2.0)).collect();
            let middle = frame(a.size().width(), a.size().height(), &middle);
            let error = |picture| Difference::of(picture, &b).rmse;
            prop_assert!((error(&middle) - error(&a) / 2.0).abs() < 1e-6);
        }

        #[test]
        fn one_wrong_pixel_is_found_anywhere(width in 1..40_u32, height in 1..40_u32, place: prop::sample::Index) {
            let mut pixels = vec![[0.5; 3]; (width * height) as usize];
            let even = frame(width, height, &pixels);
            pixels[place.index((width * height) as usize)] = [0.0; 3];
            let found = Difference::of(&frame(width, height, &pixels), &even);
            prop_assert_eq!(found.wrong_pixels, 1);
            prop_assert!(found.worst_ssim < 0.3, "{}", found.worst_ssim);
            prop_assert!((found.rmse - 0.5 / f64::from(width * height).sqrt()).abs() < 1e-9);
        }
    }

    #[test]
    fn inverted_and_dimmed_pictures_have_known_ssim() {
        // Half the values are 0 and half 255: means of 127.5, variances of 127.5², covariance −127.5².
        let stripes: Vec<(f64, f64)> = (0..64).map(|i| f64::from(i % 2) * 255.0).map(|a| (a, 255.0 - a)).collect();
        let (variance, c2) = (127.5 * 127.5, 7.65 * 7.65);
        assert!((ssim(stripes.into_iter()) - (c2 - 2.0 * variance) / (c2 + 2.0 * variance)).abs() < 1e-12);
        // Of uniform pictures only the means differ.
        let (even, c1) = ((0..64).map(|_| (100.0, 50.0)), 2.55 * 2.55);
        assert!((ssim(even) - (10_000.0 + c1) / (12_500.0 + c1)).abs() < 1e-12);
    }

    #[test]
    fn difference_of_2_is_tolerated_and_3_is_not() {
        let linear = |value: f32| ((value / 255.0 + 0.055) / 1.055).powf(2.4);
        let apart = |steps: f32| {
            let step = |value: f32| frame(1, 1, &[[linear(value), 0.5, 0.5]]);
            Difference::of(&step(100.0 + steps), &step(100.0)).wrong_pixels
        };
        assert_eq!([-3.0, -2.0, 0.0, 2.0, 3.0].map(apart), [1, 0, 0, 0, 1]);
    }
}
