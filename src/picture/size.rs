//! The size of a picture.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Width and height of a picture in pixels: both at least 1, and together at most [`Size::MAX_PIXELS`] pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Size {
    width: u32,
    height: u32,
}

/// Why a picture cannot have a size.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum SizeError {
    /// The text does not have the form of a size.
    #[error("`{0}` is not a size; write it as WIDTHxHEIGHT, for example 640x480")]
    Syntax(String),
    /// A side is 0.
    #[error("a picture of {width}x{height} has no pixels; both sides must be at least 1")]
    Empty {
        /// In pixels.
        width: u32,
        /// In pixels.
        height: u32,
    },
    /// There are more than [`Size::MAX_PIXELS`].
    #[error("a picture of {width}x{height} is too large; at most {max} pixels are possible", max = Size::MAX_PIXELS)]
    TooLarge {
        /// In pixels.
        width: u32,
        /// In pixels.
        height: u32,
    },
}

impl From<SizeError> for String {
    fn from(error: SizeError) -> Self {
        error.to_string()
    }
}

impl Size {
    /// 2²⁷ pixels: 11,585 × 11,585, whose frame in linear light takes 1.5 GiB.
    pub const MAX_PIXELS: u64 = 1 << 27;

    /// # Errors
    /// [`SizeError::Empty`] if a side is 0, [`SizeError::TooLarge`] above [`Size::MAX_PIXELS`].
    pub fn new(width: u32, height: u32) -> Result<Self, SizeError> {
        if width == 0 || height == 0 {
            return Err(SizeError::Empty { width, height });
        }
        if u64::from(width) * u64::from(height) > Self::MAX_PIXELS {
            return Err(SizeError::TooLarge { width, height });
        }
        Ok(Self { width, height })
    }

    /// Pixels from left to right.
    pub fn width(self) -> u32 {
        self.width
    }

    /// Pixels from top to bottom.
    pub fn height(self) -> u32 {
        self.height
    }

    /// Width × height; it fits `u32` because of [`Size::MAX_PIXELS`].
    pub fn pixels(self) -> u32 {
        self.width * self.height
    }
}

impl FromStr for Size {
    type Err = SizeError;

    fn from_str(text: &str) -> Result<Self, SizeError> {
        let sides = text.split_once(['x', 'X', '×']);
        match sides.map(|(w, h)| (w.trim().parse(), h.trim().parse())) {
            Some((Ok(width), Ok(height))) => Self::new(width, height),
            _ => Err(SizeError::Syntax(text.to_owned())),
        }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}
