//! The few colours of a frame that has many.

use std::cmp::Reverse;
use std::collections::HashMap;

use color_quant::NeuQuant;

use crate::palette::Rgb;

/// A palette of at most 255 colours, and which of them stands for each colour that was there; one more place is for none.
pub(super) struct Colours {
    palette: Vec<u8>,
    indices: HashMap<Rgb, u8>,
}

/// A palette has 256 places, of which one is for none.
const MOST: usize = 255;

/// If colours are too many, so many of the most frequent are kept as they are: flat areas stay flat, and meet without a seam
/// what was shown before.
const KEPT: usize = 64;

impl Colours {
    /// For these pixels.
    pub fn of(pixels: impl Iterator<Item = Rgb> + Clone) -> Self {
        let mut counts: HashMap<Rgb, u32> = HashMap::new();
        pixels.clone().for_each(|colour| *counts.entry(colour).or_default() += 1);
        let mut colours: Vec<(Rgb, u32)> = counts.into_iter().collect();
        colours.sort_unstable_by_key(|&(colour, count)| (Reverse(count), colour));
        let kept = if colours.len() <= MOST { colours.len() } else { KEPT };
        let (kept, others) = colours.split_at(kept);
        let mut palette: Vec<u8> = kept.iter().flat_map(|(colour, _)| *colour).collect();
        let mut indices: HashMap<Rgb, u8> = (0..).zip(kept).map(|(index, (colour, _))| (*colour, index)).collect();
        if !others.is_empty() {
            let rgba = |[r, g, b]: Rgb| [r, g, b, 0xff];
            let rest: Vec<u8> = pixels.filter(|colour| !indices.contains_key(colour)).flat_map(rgba).collect();
            // Of many pixels a part shows what colours there are.
            let one_in = if rest.len() > 1 << 18 { 5 } else { 1 };
            let learned = NeuQuant::new(one_in, MOST - KEPT, &rest);
            palette.extend(learned.color_map_rgb());
            // No more than 255 in all.
            indices.extend(others.iter().map(|(colour, _)| (*colour, (KEPT + learned.index_of(&rgba(*colour))) as u8)));
        }
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
        self.indices.get(&colour).copied().unwrap_or_default()
    }
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
