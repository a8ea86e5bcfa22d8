//! The quality of a picture.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The quality of a picture: each knob bounds the cost or the error. Fields that a run file lacks have their defaults.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Quality {
    /// The greatest number of samples a pixel is n × n, with n from 1 to [`Quality::MAX_SAMPLES`].
    pub samples: u32,
    /// A pixel gets no more samples when all its samples, corners included, agree within this threshold, or when the
    /// estimated error of their mean is at most the threshold; in linear light, for every channel. At 0 every pixel
    /// gets all samples.
    pub threshold: f64,
    /// The greatest depth of the tree of rays, from 1 to [`Quality::MAX_DEPTH`] (§3: "for example 10 levels"). A
    /// primary ray has level 1.
    pub max_depth: u32,
    /// The greatest total weight of the rays of a sample that are left out because they are too weak (§3:
    /// "irrelevant"); at least 0 and less than 1. The error of the depth limit is not part of it.
    pub cutoff: f64,
    /// The seed of the sample pattern. All patterns are equally good.
    pub pattern: u32,
}

impl Quality {
    /// The greatest n of n × n samples.
    pub const MAX_SAMPLES: u32 = 64;
    /// The greatest depth of the tree of rays.
    pub const MAX_DEPTH: u32 = 100;

    /// # Errors
    /// The first knob that is out of its range.
    pub fn check(&self) -> Result<(), QualityError> {
        if !(1..=Self::MAX_SAMPLES).contains(&self.samples) {
            return Err(QualityError::Samples(self.samples));
        }
        if !(0.0..1.0).contains(&self.threshold) {
            return Err(QualityError::Threshold(self.threshold));
        }
        if !(1..=Self::MAX_DEPTH).contains(&self.max_depth) {
            return Err(QualityError::Depth(self.max_depth));
        }
        if !(0.0..1.0).contains(&self.cutoff) {
            return Err(QualityError::Cutoff(self.cutoff));
        }
        Ok(())
    }
}

/// The knob that is out of its range, and its value.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum QualityError {
    /// [`Quality::samples`].
    #[error("samples is {0}; it must be 1 to {max}", max = Quality::MAX_SAMPLES)]
    Samples(u32),
    /// [`Quality::threshold`].
    #[error("threshold is {0}; it must be at least 0 and less than 1")]
    Threshold(f64),
    /// [`Quality::max_depth`].
    #[error("max_depth is {0}; it must be 1 to {max}", max = Quality::MAX_DEPTH)]
    Depth(u32),
    /// [`Quality::cutoff`].
    #[error("cutoff is {0}; it must be at least 0 and less than 1")]
    Cutoff(f64),
}

impl From<QualityError> for String {
    fn from(error: QualityError) -> Self {
        error.to_string()
    }
}

impl Default for Quality {
    fn default() -> Self {
        Self { samples: 1, threshold: 0.0, max_depth: 10, cutoff: 1.0 / 255.0, pattern: 0 }
    }
}
