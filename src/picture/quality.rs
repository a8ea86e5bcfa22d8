//! How good a picture is to be: few knobs, each with a bound or a limit that can be said.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// How good a picture is to be. What a run file does not say is as by default.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Quality {
    /// At most n × n samples a pixel, from 1 to [`Quality::MAX_SAMPLES`].
    pub samples: u32,
    /// A pixel gets no more samples once they are the same within this, its corners among them, or once the error of
    /// their mean is estimated as no more than this; in linear light and in every channel. At 0 every pixel gets all.
    pub threshold: f64,
    /// The limit of the tree of rays, from 1 to [`Quality::MAX_DEPTH`] (§3: "for example 10 levels"); a primary ray is level 1.
    pub max_depth: u32,
    /// What rays that are too weak to be followed (§3: "irrelevant") would count, all those of a sample together, at
    /// most: at least 0 and less than 1. The limit of the tree of rays comes on top.
    pub cutoff: f64,
    /// Which of many equally good patterns of samples is taken.
    pub pattern: u32,
}

impl Quality {
    /// n × n samples at most.
    pub const MAX_SAMPLES: u32 = 64;
    /// The deepest tree of rays.
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
