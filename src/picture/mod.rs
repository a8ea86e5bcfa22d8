//! The picture: its size and quality, its division into atoms and bands, its frame in linear light, its PNG, and how far
//! it is from another.

mod compare;
mod division;
mod frame;
mod png;
mod quality;

pub use compare::{Difference, apart};
pub use division::{Atom, Division, atoms_in, push_atom};
pub use frame::{Colour, Frame, srgb8};
pub use png::{encode_png, write_png};
pub use quality::Quality;

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Width and height of a picture in pixels; neither is 0, and there are at most [`Size::MAX_PIXELS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Size {
    width: u32,
    height: u32,
}

impl Size {
    /// 2²⁷ pixels: 11,585 × 11,585, whose frame in linear light takes 1.5 GiB.
    pub const MAX_PIXELS: u64 = 1 << 27;

    /// # Errors
    /// A sentence, if a side is 0 or there are more than [`Size::MAX_PIXELS`].
    pub fn new(width: u32, height: u32) -> Result<Self, String> {
        if width == 0 || height == 0 {
            return Err(format!("a picture of {width}x{height} has no pixels; both sides must be at least 1"));
        }
        if u64::from(width) * u64::from(height) > Self::MAX_PIXELS {
            return Err(format!(
                "a picture of {width}x{height} is too large; at most {} pixels are possible",
                Self::MAX_PIXELS
            ));
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
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides = text.split_once(['x', 'X', '×']);
        match sides.map(|(w, h)| (w.trim().parse(), h.trim().parse())) {
            Some((Ok(width), Ok(height))) => Self::new(width, height),
            _ => Err(format!("`{text}` is not a size; write it as WIDTHxHEIGHT, for example 640x480")),
        }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}
