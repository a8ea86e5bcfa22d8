//! The render in the colours of who traced it.

use super::state::RunState;
use crate::balance::NodeId;
use crate::palette::{Rgb, mix};
use crate::picture::{Frame, srgb8};

/// For each node, its colour as 256 levels of light.
#[derive(Clone, Debug)]
pub(super) struct Tones(Vec<[Rgb; 256]>);

impl Tones {
    /// The tones of nodes of these colours.
    pub(super) fn new(colours: &[Rgb]) -> Self {
        Self(colours.iter().map(|&colour| tones(colour)).collect())
    }

    /// A pixel of the render that `owner` has traced: the render (`blend` 0), the owner (1), or between.
    pub(super) fn shown(&self, render: Rgb, owner: Option<NodeId>, blend: f32) -> Rgb {
        match owner.and_then(|owner| self.0.get(usize::from(owner))) {
            Some(tones) if blend > 0.0 => mix(render, tones[light(render)], blend),
            _ => render,
        }
    }
}

/// The picture as it is shown, as 8-bit RGB in scan order: the render (`blend` 0, exactly [`Frame::to_srgb8`]), in the
/// `colours` of the nodes that traced it (1), or between. What is not traced yet is black.
pub fn picture_pixels(frame: &Frame, state: &RunState, colours: &[Rgb], blend: f32) -> Vec<u8> {
    let (tones, division) = (Tones::new(colours), state.division());
    let atoms = (0..).zip(state.places()).map(|(atom, place)| (division.pixels(atom), place.owner()));
    let pixels = atoms.flat_map(|(pixels, owner)| {
        let pixels = &frame.pixels()[pixels.start as usize..pixels.end as usize];
        pixels.iter().map(move |&pixel| (srgb8(pixel), owner))
    });
    pixels.flat_map(|(render, owner)| tones.shown(render, owner, blend)).collect()
}

/// How light a shown pixel looks, 0 to 255 (Rec. 601 luma, which is made for encoded values).
fn light(pixel: Rgb) -> usize {
    let [r, g, b] = pixel.map(usize::from);
    (299 * r + 587 * g + 114 * b) / 1000
}

/// A node's colour at each level of light: dark but still itself in the shadows, full in the middle, towards white
/// in highlights, so that the shapes stay as clear as the owners.
fn tones(colour: Rgb) -> [Rgb; 256] {
    const FULL: f32 = 0.62;
    let dark = mix([0; 3], colour, 0.16);
    std::array::from_fn(|level| {
        let level = level as f32 / 255.0;
        if level <= FULL {
            mix(dark, colour, level / FULL)
        } else {
            mix(colour, [0xff; 3], 0.8 * (level - FULL) / (1.0 - FULL))
        }
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::sample;
    use super::*;
    use crate::picture::Colour;

    const COLOURS: [Rgb; 2] = [[200, 0, 0], [0, 0, 200]];

    /// A run of two nodes after so many of its records, and a frame that holds `pixel` wherever that is traced.
    fn traced(records: usize, pixel: Colour) -> (Frame, RunState) {
        let header = sample::header(&[1.0, 1.0], 20);
        let (mut state, mut frame) = (RunState::new(&header), Frame::new(header.size));
        sample::records(&header).iter().take(records).for_each(|record| state.apply(record));
        for (atom, place) in (0..).zip(state.places()) {
            if place.owner().is_some() {
                frame.place(header.division.pixels(atom), &[pixel; 50]);
            }
        }
        (frame, state)
    }

    proptest! {
        #[test]
        fn without_owners_it_is_the_render_byte_for_byte(records in 0..400usize, pixel in prop::array::uniform3(-0.5..1.5f32)) {
            let (frame, state) = traced(records, pixel);
            prop_assert_eq!(picture_pixels(&frame, &state, &COLOURS, 0.0), frame.to_srgb8());
        }

        #[test]
        fn what_is_not_traced_is_black(records in 0..60usize, blend in 0.0..=1.0f32) {
            let (frame, state) = traced(records, [0.4, 0.5, 0.6]);
            let bytes = picture_pixels(&frame, &state, &COLOURS, blend);
            for (pixel, bytes) in bytes.chunks(3).enumerate() {
                prop_assert_eq!(bytes == [0; 3], state.places()[pixel / 50].owner().is_none());
            }
        }
    }

    #[test]
    fn the_owners_colour_what_they_traced() {
        let (frame, state) = traced(usize::MAX, [0.2; 3]);
        let picture = |blend| picture_pixels(&frame, &state, &COLOURS, blend);
        let (render, between, owners) = (picture(0.0), picture(0.5), picture(1.0));
        let last = owners.len() - 3;
        assert!(owners[0] > 100 && owners[2] < 40, "{:?}", &owners[..3]);
        assert!(owners[last + 2] > 100 && owners[last] < 40, "{:?}", &owners[last..]);
        for ((render, between), owners) in render.iter().zip(&between).zip(&owners) {
            assert!(between.abs_diff(*render).abs_diff(between.abs_diff(*owners)) <= 1);
        }
    }

    #[test]
    fn tones_rise_with_light() {
        let lights: Vec<_> = tones([0x9A, 0x3B, 0x78]).map(light).to_vec();
        assert!(lights.windows(2).all(|pair| pair[0] <= pair[1]));
        assert!(lights[255] > 200 && lights[0] < 40);
    }
}
