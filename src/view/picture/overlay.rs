//! Layers of colour on the render: owners, costs, or order of arrival.

use super::false_colour::ramp;
use crate::language::{Language, word};
use crate::palette::{Rgb, mix};
use crate::picture::{Atom, Frame, srgb8};
use crate::view::state::atom_state::AtomState;
use crate::view::state::run_state::RunState;

/// Layer of colour on the render.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layer {
    /// The machine that traced each atom.
    #[default]
    Owners,
    /// Cost of each atom: from an eighth of the mean cost to eight times as much.
    Costs,
    /// Order in which atoms were traced, the first dark, the last light.
    Arrival,
}

impl Layer {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Owners, Self::Costs, Self::Arrival];

    /// Returns its name.
    pub fn name(self, language: Language) -> &'static str {
        match self {
            Self::Owners => word!(language, "Who traced it", "Quem calculou"),
            Self::Costs => word!(language, "What it cost", "Quanto custou"),
            Self::Arrival => word!(language, "When it came", "Quando chegou"),
        }
    }

    /// Returns the colour at a position, 0 to 1, of a layer with two ends: neither black nor white.
    pub fn ramp(position: f64) -> Rgb {
        ramp(0.12 + 0.8 * position)
    }

    /// Meanings of its darkest and its lightest colour; `None` for a layer without ends.
    pub fn ends(self, language: Language) -> Option<[&'static str; 2]> {
        match self {
            Self::Owners => None,
            Self::Costs => Some(word!(language, ["cheap", "dear"], ["barato", "caro"])),
            Self::Arrival => Some(word!(language, ["first", "last"], ["antes", "depois"])),
        }
    }
}

/// Number of colours of a ramp.
const RAMP_STEPS: usize = 48;

/// Colours of a layer, each with 256 levels of light.
#[derive(Clone, Debug)]
pub(crate) struct Shades {
    layer: Layer,
    tones: Vec<[Rgb; 256]>,
}

impl Shades {
    /// Computes the tones of a layer for nodes with these colours.
    pub(crate) fn new(layer: Layer, colours: &[Rgb]) -> Self {
        let tones = match layer {
            Layer::Owners => colours.iter().map(|&colour| tones(colour)).collect(),
            Layer::Costs | Layer::Arrival => {
                (0..RAMP_STEPS).map(|step| tones(Layer::ramp(step as f64 / (RAMP_STEPS - 1) as f64))).collect()
            }
        };
        Self { layer, tones }
    }

    /// The layer.
    pub(crate) fn layer(&self) -> Layer {
        self.layer
    }

    /// Returns the index of an atom's tone; `mean` is the mean cost of an atom. `None` if the atom is not traced.
    pub(crate) fn of(&self, atom: Atom, state: &RunState, mean: f64) -> Option<u16> {
        let AtomState::Traced { by, cost, .. } = state.atom_states()[atom as usize] else { return None };
        let step = |share: f64| (share.clamp(0.0, 1.0) * (RAMP_STEPS - 1) as f64).round() as u16;
        Some(match self.layer {
            Layer::Owners => by,
            Layer::Costs if mean > 0.0 => step(0.5 + (f64::from(cost) / mean).log2() / 6.0),
            Layer::Costs => step(0.5),
            Layer::Arrival => step(f64::from(state.order(atom)) / f64::from(state.atoms().max(1))),
        })
    }

    /// Mixes a pixel of the render (`blend` 0) with its tone (1).
    pub(crate) fn shown(&self, render: Rgb, tone: Option<u16>, blend: f32) -> Rgb {
        match tone.and_then(|tone| self.tones.get(usize::from(tone))) {
            Some(tones) if blend > 0.0 => mix(render, tones[light(render)], blend),
            _ => render,
        }
    }
}

/// Returns the shown picture as 8-bit RGB in scan order: the render (`blend` 0, exactly [`Frame::to_srgb8`]), the layer
/// (1), or a mixture. Untraced pixels are black. `colours` are those of the nodes.
pub fn picture_pixels(frame: &Frame, state: &RunState, colours: &[Rgb], (layer, blend): (Layer, f32)) -> Vec<u8> {
    let (tones, division, mean) = (Shades::new(layer, colours), state.division(), state.mean_cost());
    let atoms = (0..state.atoms()).map(|atom| (division.pixels(atom), tones.of(atom, state, mean)));
    let pixels = atoms.flat_map(|(pixels, tone)| {
        let pixels = &frame.pixels()[pixels.start as usize..pixels.end as usize];
        pixels.iter().map(move |&pixel| (srgb8(pixel), tone))
    });
    pixels.flat_map(|(render, tone)| tones.shown(render, tone, blend)).collect()
}

/// Luma of a shown pixel, 0 to 255 (Rec. 601, which is made for encoded values).
fn light(pixel: Rgb) -> usize {
    let [r, g, b] = pixel.map(usize::from);
    (299 * r + 587 * g + 114 * b) / 1000
}

/// Returns a colour at each level of light: dark in shadows, full in the middle, towards white in highlights, so that
/// shapes stay as clear as owners.
fn tones(colour: Rgb) -> [Rgb; 256] {
    const FULL_COLOUR_LEVEL: f32 = 0.62;
    let dark = mix([0; 3], colour, 0.16);
    std::array::from_fn(|level| {
        let level = level as f32 / 255.0;
        if level <= FULL_COLOUR_LEVEL {
            mix(dark, colour, level / FULL_COLOUR_LEVEL)
        } else {
            mix(colour, [0xff; 3], 0.8 * (level - FULL_COLOUR_LEVEL) / (1.0 - FULL_COLOUR_LEVEL))
        }
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::picture::Colour;
    use crate::view::tests::sample_runs;

    const COLOURS: [Rgb; 2] = [[200, 0, 0], [0, 0, 200]];

    /// Runs two nodes for a number of records; all traced pixels of the frame are `pixel`.
    fn traced(records: usize, pixel: Colour) -> (Frame, RunState) {
        let header = sample_runs::header(&[1.0, 1.0], 20);
        let (mut state, mut frame) = (RunState::new(&header), Frame::new(header.size));
        sample_runs::records(&header).iter().take(records).for_each(|record| state.apply(record));
        for (atom, place) in (0..).zip(state.atom_states()) {
            if place.owner().is_some() {
                frame.place(header.division.pixels(atom), &[pixel; 50]);
            }
        }
        (frame, state)
    }

    proptest! {
        #[test]
        fn picture_without_a_layer_is_the_render_byte_for_byte(
            records in 0..400usize, pixel in prop::array::uniform3(-0.5..1.5f32), layer in prop::sample::select(&Layer::ALL),
        ) {
            let (frame, state) = traced(records, pixel);
            prop_assert_eq!(picture_pixels(&frame, &state, &COLOURS, (layer, 0.0)), frame.to_srgb8());
        }

        #[test]
        fn untraced_pixels_are_black(records in 0..60usize, blend in 0.0..=1.0f32) {
            let (frame, state) = traced(records, [0.4, 0.5, 0.6]);
            let bytes = picture_pixels(&frame, &state, &COLOURS, (Layer::Owners, blend));
            for (pixel, bytes) in bytes.chunks(3).enumerate() {
                prop_assert_eq!(bytes == [0; 3], state.atom_states()[pixel / 50].owner().is_none());
            }
        }
    }

    #[test]
    fn owners_colour_their_atoms() {
        let (frame, state) = traced(usize::MAX, [0.2; 3]);
        let picture = |blend| picture_pixels(&frame, &state, &COLOURS, (Layer::Owners, blend));
        let (render, between, owners) = (picture(0.0), picture(0.5), picture(1.0));
        let last = owners.len() - 3;
        assert!(owners[0] > 100 && owners[2] < 40, "{:?}", &owners[..3]);
        assert!(owners[last + 2] > 100 && owners[last] < 40, "{:?}", &owners[last..]);
        for ((render, between), owners) in render.iter().zip(&between).zip(&owners) {
            assert!(between.abs_diff(*render).abs_diff(between.abs_diff(*owners)) <= 1);
        }
    }

    #[test]
    fn last_atom_is_lighter_than_the_first() {
        let (_, state) = traced(usize::MAX, [0.2; 3]);
        let tones = Shades::new(Layer::Arrival, &COLOURS);
        let of =
            |order: u32| (0..20).find(|&atom| state.order(atom) == order).and_then(|atom| tones.of(atom, &state, 0.0));
        let shown = |order| light(tones.shown([120; 3], of(order), 1.0));
        assert!(shown(0) + 40 < shown(10) && shown(10) + 40 < shown(19), "{} {} {}", shown(0), shown(10), shown(19));
    }

    #[test]
    fn cost_above_the_mean_is_lighter() {
        let (_, state) = traced(usize::MAX, [0.2; 3]);
        let tones = Shades::new(Layer::Costs, &COLOURS);
        let mean = state.mean_cost();
        assert!((mean - sample_runs::COST.as_secs_f64()).abs() < 1e-9);
        let of = |mean| tones.of(3, &state, mean);
        assert!(of(mean / 2.0) > of(mean) && of(mean) > of(mean * 2.0));
        assert_eq!([of(mean / 100.0), of(mean * 100.0)], [Some(RAMP_STEPS as u16 - 1), Some(0)]);
    }

    #[test]
    fn tones_rise_with_light() {
        let lights: Vec<_> = tones([0x9A, 0x3B, 0x78]).map(light).to_vec();
        assert!(lights.windows(2).all(|pair| pair[0] <= pair[1]));
        assert!(lights[255] > 200 && lights[0] < 40);
    }
}
