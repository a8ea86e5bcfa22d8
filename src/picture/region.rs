//! A rectangle of a picture.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use super::{Size, SizeError};

/// A rectangle of pixels of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// The column of its first pixel, from 0.
    pub x: u32,
    /// The row of its first pixel, from 0.
    pub y: u32,
    /// Its width and height.
    pub size: Size,
}

/// Why a rectangle is no region of a picture.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum RegionError {
    /// The text does not have the form of a region.
    #[error("`{0}` is not a region; write it as X,Y,WIDTH,HEIGHT, for example 320,200,64,48")]
    Syntax(String),
    /// No picture can have its size.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// It reaches beyond the picture.
    #[error(
        "the region {region} is not inside the picture of {picture}; X + WIDTH must be at most {}, Y + HEIGHT at most \
         {}",
        picture.width(), picture.height()
    )]
    Outside {
        /// The region.
        region: Region,
        /// The size of the picture.
        picture: Size,
    },
}

impl From<RegionError> for String {
    fn from(error: RegionError) -> Self {
        error.to_string()
    }
}

impl Region {
    /// Checks that the region lies in a picture of this size.
    ///
    /// # Errors
    /// [`RegionError::Outside`], if it does not.
    pub fn check_inside(self, picture: Size) -> Result<(), RegionError> {
        let fits = |first: u32, length: u32, side: u32| u64::from(first) + u64::from(length) <= u64::from(side);
        if fits(self.x, self.size.width(), picture.width()) && fits(self.y, self.size.height(), picture.height()) {
            Ok(())
        } else {
            Err(RegionError::Outside { region: self, picture })
        }
    }
}

impl FromStr for Region {
    type Err = RegionError;

    fn from_str(text: &str) -> Result<Self, RegionError> {
        let numbers: Option<Vec<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[x, y, width, height]) => Ok(Self { x, y, size: Size::new(width, height)? }),
            _ => Err(RegionError::Syntax(text.to_owned())),
        }
    }
}

impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{},{}", self.x, self.y, self.size.width(), self.size.height())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn region_is_parsed_as_it_is_displayed_and_must_lie_in_the_picture() {
        let region: Region = "3, 4,10,20".parse().unwrap();
        assert_eq!(region.to_string(), "3,4,10,20");
        let fits = |width, height| region.check_inside(Size::new(width, height).unwrap()).is_ok();
        assert!(fits(13, 24) && !fits(12, 24) && !fits(13, 23));
        for text in ["", "1,2,3", "1,2,3,4,5", "-1,0,3,4", "1.5,0,3,4", "1,2,3,x"] {
            assert_eq!(text.parse::<Region>(), Err(RegionError::Syntax(text.into())));
        }
        assert!(matches!("0,0,0,4".parse::<Region>(), Err(RegionError::Size(SizeError::Empty { .. }))));
        let far: Region = "4294967295,0,2,2".parse().unwrap();
        assert!(far.check_inside(Size::new(5, 5).unwrap()).is_err());
    }
}
