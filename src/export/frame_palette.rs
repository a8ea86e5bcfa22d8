//! Reduces the colours of a frame to a palette.

use std::cmp::Reverse;

use quantette::deps::palette::Srgb;
use quantette::{Image, PaletteSize, Pipeline};

use crate::palette::Rgb;

/// A palette of at most 255 colours and a transparent entry, with the entry that represents each original colour.
pub(super) struct FramePalette {
    palette: Vec<u8>,
    /// Entry of the palette by original colour.
    indices: Vec<(Rgb, u8)>,
}

/// Most colours in a palette of 256 entries, of which one is transparent.
const MAX_COLOURS: usize = 255;

/// With too many colours, a colour that covers at least this fraction of the pixels (1 / `AREA_DIVISOR`) is kept
/// exactly: areas stay flat and meet earlier frames without a seam.
const AREA_DIVISOR: usize = 100;

impl FramePalette {
    /// Chooses a palette for these pixels.
    pub fn of(pixels: impl Iterator<Item = Rgb>) -> Self {
        let mut pixels: Vec<Rgb> = pixels.collect();
        pixels.sort_unstable();
        let count = |same: &[Rgb]| (same[0], same.len());
        let mut colours: Vec<(Rgb, usize)> = pixels.chunk_by(Rgb::eq).map(count).collect();
        colours.sort_unstable_by_key(|&(colour, count)| (Reverse(count), colour));
        let is_area = |(_, count): &(Rgb, usize)| count * AREA_DIVISOR >= pixels.len();
        let areas = colours.iter().take_while(|of| is_area(of)).count();
        let (kept, others) = colours.split_at(if colours.len() <= MAX_COLOURS { colours.len() } else { areas });
        let mut palette: Vec<u8> = kept.iter().flat_map(|(colour, _)| *colour).collect();
        // At most 255 in all.
        let mut indices: Vec<(Rgb, u8)> = (0..).zip(kept).map(|(index, (colour, _))| (*colour, index)).collect();
        if !others.is_empty() {
            // Each colour as often as it occurs.
            let rest = others.iter().flat_map(|&(colour, count)| std::iter::repeat_n(Srgb::from(colour), count));
            let (found, entries) = quantize(&rest.clone().collect::<Vec<_>>(), MAX_COLOURS - kept.len());
            palette.extend(found.into_iter().flat_map(<[u8; 3]>::from));
            indices.extend(rest.map(Rgb::from).zip(entries.into_iter().map(|place| kept.len() as u8 + place)));
        }
        indices.sort_unstable();
        indices.dedup();
        Self { palette, indices }
    }

    /// Returns the palette, three bytes per colour, with the transparent entry last.
    pub fn palette(&self) -> Vec<u8> {
        [&self.palette[..], &[0; 3]].concat()
    }

    /// Returns the transparent entry.
    pub fn transparent(&self) -> u8 {
        // At most 255 colours come before it.
        (self.palette.len() / 3) as u8
    }

    /// Returns the entry that represents an original colour.
    pub fn index(&self, colour: Rgb) -> u8 {
        let place = self.indices.binary_search_by_key(&colour, |(known, _)| *known);
        place.map_or(0, |place| self.indices[place].1)
    }
}

/// Chooses at most `most` colours that represent the pixels, and returns the colours and the entry of each pixel.
fn quantize(pixels: &[Srgb<u8>], most: usize) -> (Vec<Srgb<u8>>, Vec<u8>) {
    let row = u32::try_from(pixels.len()).ok().and_then(|width| Image::new(width, 1, pixels).ok());
    // A picture of this program always has few enough pixels.
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
        fn few_colours_are_exact_and_none_is_transparent(
            colours in prop::collection::vec(any::<Rgb>(), 1..600), frequent in any::<Rgb>(),
        ) {
            let pixels = colours.iter().copied().chain(std::iter::repeat_n(frequent, 50));
            let chosen = FramePalette::of(pixels.clone());
            let palette = chosen.palette();
            let of = |colour| {
                let index = usize::from(chosen.index(colour));
                [0, 1, 2].map(|channel| palette[3 * index + channel])
            };
            prop_assert!(pixels.clone().all(|colour| chosen.index(colour) < chosen.transparent()));
            prop_assert_eq!(of(frequent), frequent);
            if colours.len() < MAX_COLOURS {
                prop_assert!(colours.iter().all(|&colour| of(colour) == colour));
            }
        }
    }
}
