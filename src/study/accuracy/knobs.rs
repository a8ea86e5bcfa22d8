//! The knobs of quality: their values, and their combinations.

use crate::picture::{Quality, Size};
use crate::scene::Scene;
use crate::tracer::{Scratch, Tracer};

/// A knob that is turned alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Knob {
    Samples,
    Threshold,
    Depth,
    Cutoff,
}

/// Most samples per side of a pixel in measured pictures.
pub const MAX_SAMPLES_PER_SIDE: u32 = 8;

/// Samples per side of a pixel while depth or cutoff is turned: enough to make their effect visible.
const FIXED_SAMPLES_PER_SIDE: u32 = 4;

impl Knob {
    pub const ALL: [Self; 4] = [Self::Samples, Self::Threshold, Self::Depth, Self::Cutoff];

    pub fn name(self) -> &'static str {
        match self {
            Self::Samples => "samples",
            Self::Threshold => "threshold",
            Self::Depth => "depth",
            Self::Cutoff => "cutoff",
        }
    }

    /// Returns whether the knob limits samples, not the depth to which rays are followed.
    pub fn limits_samples(self) -> bool {
        matches!(self, Self::Samples | Self::Threshold)
    }

    /// Returns the knob's values, the best last. The last values of depth and cutoff stand for no limit.
    pub fn values(self) -> &'static [f64] {
        match self {
            Self::Samples => &[1.0, 2.0, 3.0, 4.0, 6.0, MAX_SAMPLES_PER_SIDE as f64],
            Self::Threshold => &[0.1, 0.05, 0.02, 0.01, 0.005, 0.002],
            Self::Depth => &[1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 15.0, 20.0, 50.0],
            Self::Cutoff => &[0.3, 0.1, 0.03, 0.01, 1.0 / 255.0, 1e-3, 1e-4, 1e-5],
        }
    }

    /// Returns the quality with the knob at a value and the others at their defaults; a threshold has many samples to
    /// save.
    pub fn quality(self, value: f64) -> Quality {
        let fixed = Quality { samples: FIXED_SAMPLES_PER_SIDE, ..Quality::default() };
        match self {
            Self::Samples => Quality { samples: value as u32, ..fixed },
            Self::Threshold => Quality { samples: MAX_SAMPLES_PER_SIDE, threshold: value, ..fixed },
            Self::Depth => Quality { max_depth: value as u32, ..fixed },
            Self::Cutoff => Quality { cutoff: value, ..fixed },
        }
    }
}

/// Returns sensible combinations of all knobs, with at most [`MAX_SAMPLES_PER_SIDE`] × [`MAX_SAMPLES_PER_SIDE`]
/// samples a pixel.
pub fn combinations() -> Vec<Quality> {
    const LIMITS: [(u32, f64); 3] = [(4, 0.03), (10, 1.0 / 255.0), (20, 1e-3)];
    // With this few samples a threshold would only add some.
    let even = [1, 2].map(|samples| (samples, 0.0));
    let adaptive =
        [4, MAX_SAMPLES_PER_SIDE].into_iter().flat_map(|samples| [0.03, 0.01, 0.0].map(|error| (samples, error)));
    let samplings = even.into_iter().chain(adaptive);
    let combined = samplings.flat_map(|(samples, threshold)| {
        let quality = Quality { samples, threshold, ..Quality::default() };
        LIMITS.map(|(max_depth, cutoff)| Quality { max_depth, cutoff, ..quality })
    });
    combined.collect()
}

/// Most rays of all kinds in a picture of one sample a pixel.
const MAX_RAYS: f64 = 80_000.0;

/// Returns the largest size within `most` at which a picture of one sample a pixel takes about 80,000 rays or fewer, so
/// that scenes with large trees of rays take about as long as others.
pub fn size_for(scene: &Scene, most: Size) -> Size {
    // Neither side of `most` is 0, and no side chosen here is longer: every such size is possible.
    let size = |width: u32, height: u32| Size::new(width, height).unwrap_or(most);
    let small = size(most.width().min(64), most.height().min(48));
    let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
    Tracer::new(scene, small, Quality::default()).trace(0..small.pixels(), &mut scratch, &mut pixels);
    let a_pixel = scratch.rays.total() as f64 / f64::from(small.pixels());
    let part = (MAX_RAYS / (a_pixel * f64::from(most.pixels()))).sqrt();
    if part >= 1.0 {
        return most;
    }
    // Whole blocks of 8 × 8 pixels, as the similarity compares them.
    let side = |most: u32| ((f64::from(most) * part / 8.0).round() as u32 * 8).clamp(1, most);
    size(side(most.width()), side(most.height()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Opened, SMALL_BUILT_IN};

    #[test]
    fn qualities_are_valid_and_distinct() {
        for knob in Knob::ALL {
            let qualities: Vec<Quality> = knob.values().iter().map(|&value| knob.quality(value)).collect();
            assert!(qualities.iter().all(|quality| quality.check().is_ok()), "{}", knob.name());
            assert!(qualities.windows(2).all(|pair| pair[0] != pair[1]), "{}", knob.name());
            // The default is among the values.
            assert!(
                knob == Knob::Threshold
                    || qualities.contains(&Quality { samples: FIXED_SAMPLES_PER_SIDE, ..Quality::default() })
            );
        }
        let combined = combinations();
        for (place, quality) in combined.iter().enumerate() {
            assert!(quality.check().is_ok() && !combined[..place].contains(quality), "{quality:?}");
        }
    }

    #[test]
    fn scenes_with_more_rays_get_smaller_pictures() {
        let most = Size::new(320, 240).unwrap();
        let size = |name: &str| size_for(&Opened::new(name).unwrap().scene, most);
        assert!(size("glass").pixels() < size("ten-objects").pixels());
        for (name, _) in SMALL_BUILT_IN {
            let size = size(name);
            assert!(size.width() <= 320 && size.height() <= 240 && size.pixels() > 2000, "{name}: {size}");
            let ratio = f64::from(size.width()) / f64::from(size.height());
            assert!((ratio - 4.0 / 3.0).abs() < 0.1, "{name}: {size}");
        }
        let few = Size::new(3, 5).unwrap();
        assert_eq!(size_for(&Opened::new("glass").unwrap().scene, few), few);
    }
}
