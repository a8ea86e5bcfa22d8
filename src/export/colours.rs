//! The few colours of a frame that has many.

use std::cmp::Reverse;

use quantette::deps::palette::Srgb;
use quantette::{Image, PaletteSize, Pipeline};

use crate::palette::Rgb;

/// A palette of at most 255 colours, and which of them stands for each colour that was there; one more place is for none.
pub(super) struct Colours {
    palette: Vec<u8>,
    /// By colour.
    indices: Vec<(Rgb, u8)>,
}

/// A palette has 256 places, of which one is for none.
const MOST: usize = 255;

/// If colours are too many, those of whole areas are kept as they are, one in so many pixels or more: areas stay flat, and meet
/// without a seam what was shown before.
const AREA: usize = 100;

impl Colours {
    /// For these pixels.
    pub fn of(pixels: impl Iterator<Item = Rgb>) -> Self {
        let mut pixels: Vec<Rgb> = pixels.collect();
        pixels.sort_unstable();
        let count = |same: &[Rgb]| (same[0], same.len());
        let mut colours: Vec<(Rgb, usize)> = pixels.chunk_by(Rgb::eq).map(count).collect();
        colours.sort_unstable_by_key(|&(colour, count)| (Reverse(count), colour));
        let is_area = |(_, count): &(Rgb, usize)| count * AREA >= pixels.len();
        let areas = colours.iter().take_while(|of| is_area(of)).count();
        let (kept, others) = colours.split_at(if colours.len() <= MOST { colours.len() } else { areas });
        let mut palette: Vec<u8> = kept.iter().flat_map(|(colour, _)| *colour).collect();
        // At most 255 in all.
        let mut indices: Vec<(Rgb, u8)> = (0..).zip(kept).map(|(index, (colour, _))| (*colour, index)).collect();
        if !others.is_empty() {
            // As often as they are seen.
            let rest = others.iter().flat_map(|&(colour, count)| std::iter::repeat_n(Srgb::from(colour), count));
            let (found, chosen) = chosen(&rest.clone().collect::<Vec<_>>(), MOST - kept.len());
            palette.extend(found.into_iter().flat_map(<[u8; 3]>::from));
            indices.extend(rest.map(Rgb::from).zip(chosen.into_iter().map(|place| kept.len() as u8 + place)));
        }
        indices.sort_unstable();
        indices.dedup();
        Self { palette, indices }
    }

    /// Three bytes a colour, the place for none included.
    pub fn palette(&self) -> Vec<u8> {
        [&self.palette[..], &[0; 3]].concat()
    }

    /// The place for none.
    pub fn none(&self) -> u8 {
        // There are at most 255 before it.
        (self.palette.len() / 3) as u8
    }

    /// The place of what stands for a colour that was there.
    pub fn index(&self, colour: Rgb) -> u8 {
        let place = self.indices.binary_search_by_key(&colour, |(known, _)| *known);
        place.map_or(0, |place| self.indices[place].1)
    }
}

/// At most so many colours that stand for those of many pixels, and by pixel which of them.
fn chosen(pixels: &[Srgb<u8>], most: usize) -> (Vec<Srgb<u8>>, Vec<u8>) {
    let row = u32::try_from(pixels.len()).ok().and_then(|width| Image::new(width, 1, pixels).ok());
    // No picture of this program has so many pixels that they cannot be counted.
    let Some(row) = row else { return Default::default() };
    let size = PaletteSize::from_usize_clamped(most);
    Pipeline::new().palette_size(size).ditherer(None).input_image(row).output_srgb8_indexed_image().into_parts()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn few_colours_are_kept_and_many_are_never_none(
            colours in prop::collection::vec(any::<Rgb>(), 1..600), frequent in any::<Rgb>(),
        ) {
            let pixels = colours.iter().copied().chain(std::iter::repeat_n(frequent, 50));
            let chosen = Colours::of(pixels.clone());
            let palette = chosen.palette();
            let of = |colour| {
                let index = usize::from(chosen.index(colour));
                [0, 1, 2].map(|channel| palette[3 * index + channel])
            };
            prop_assert!(pixels.clone().all(|colour| chosen.index(colour) < chosen.none()));
            prop_assert_eq!(of(frequent), frequent);
            if colours.len() < MOST {
                prop_assert!(colours.iter().all(|&colour| of(colour) == colour));
            }
        }
    }
}
