//! False colours for the error of each pixel against a reference.

use crate::palette::Rgb;
use crate::picture::{Colour, Frame, srgb8};

/// Errors written beside the ramp of colours, ascending. The ramp is logarithmic: it begins with the first and ends
/// with the last, and errors beyond have the colour of its end.
pub const RAMP_ERRORS: [f64; 4] = [1e-3, 1e-2, 1e-1, 1.0];

/// Returns a colour for each pixel by its error: the root of the mean squared error of its channels in linear light, so
/// that the mean square of all pixels is that of the picture.
pub fn false_colours(picture: &Frame, reference: &Frame) -> Vec<Rgb> {
    let pairs = picture.pixels().iter().zip(reference.pixels());
    pairs.map(|(&one, &other)| ramp(ramp_position(error(one, other)))).collect()
}

/// Position of an error on the ramp, 0 to 1.
pub fn ramp_position(error: f64) -> f64 {
    let [least, .., most] = RAMP_ERRORS;
    ((error.max(f64::MIN_POSITIVE) / least).log10() / (most / least).log10()).clamp(0.0, 1.0)
}

/// Returns the colour at a position of the ramp, 0 to 1. Equal steps look about equal, and each is lighter than the one
/// before, also for colour-blind people (in Oklab: B. Ottosson, *A perceptual color space for image processing*, 2020).
pub fn ramp(place: f64) -> Rgb {
    let place = place.clamp(0.0, 1.0);
    let lightness = 0.22 + 0.74 * place;
    // From violet over red to yellow, and grey at both ends.
    let hue = (-70.0 + 175.0 * place).to_radians();
    let chroma = 0.16 * (std::f64::consts::PI * (0.06 + 0.84 * place)).sin();
    let [a, b] = [chroma * hue.cos(), chroma * hue.sin()];
    let l = (lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let m = (lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let s = (lightness - 0.089_484_177_5 * a - 1.291_485_548 * b).powi(3);
    let linear = [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701 * s,
    ];
    srgb8(linear.map(|channel| channel as f32))
}

/// Root of the mean squared error of the channels.
fn error(one: Colour, other: Colour) -> f64 {
    let squares = one.iter().zip(other).map(|(&a, b)| (f64::from(a) - f64::from(b)).powi(2));
    (squares.sum::<f64>() / 3.0).sqrt()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::palette::luminance;
    use crate::picture::{Difference, Size};

    fn frame(pixels: &[Colour]) -> Frame {
        Frame::of(Size::new(pixels.len() as u32, 1).unwrap(), pixels)
    }

    proptest! {
        #[test]
        fn greater_error_is_lighter(one in 1e-3..1.0f64, more in 1.02..3.0f64) {
            let at = |error| luminance(ramp(ramp_position(error)));
            prop_assert!(one * more > 1.0 || at(one * more) > at(one));
        }

        #[test]
        fn mean_square_of_pixel_errors_is_that_of_the_picture(
            pixels in prop::collection::vec((prop::array::uniform3(0.0..1.0f32), prop::array::uniform3(0.0..1.0f32)), 1..40)
        ) {
            let (one, other): (Vec<Colour>, Vec<Colour>) = pixels.iter().copied().unzip();
            let mean = pixels.iter().map(|&(a, b)| error(a, b).powi(2)).sum::<f64>() / pixels.len() as f64;
            let whole = Difference::of(&frame(&one), &frame(&other)).rmse;
            prop_assert!((mean.sqrt() - whole).abs() < 1e-9);
        }
    }

    #[test]
    fn ramp_begins_at_no_error_and_ends_at_the_greatest() {
        let (black, white) = ([0.0; 3], [1.0; 3]);
        let found = false_colours(&frame(&[black, black, [0.01; 3]]), &frame(&[black, white, black]));
        assert_eq!(found, [ramp(0.0), ramp(1.0), ramp(1.0 / 3.0)]);
        assert_eq!([ramp_position(0.0), ramp_position(9.0), ramp_position(f64::NAN)], [0.0, 1.0, 0.0]);
    }

    #[test]
    fn steps_of_the_ramp_are_about_equally_light() {
        // Perceived lightness, 0 to 100 (CIE 1976).
        let lightness = |place: f64| 116.0 * luminance(ramp(place)).max(0.0089).cbrt() - 16.0;
        let steps: Vec<f32> =
            (0..16).map(|i| f64::from(i) / 16.0).map(|at| lightness(at + 1.0 / 16.0) - lightness(at)).collect();
        assert!(steps.iter().all(|step| (2.0..9.0).contains(step)), "{steps:?}");
    }
}
