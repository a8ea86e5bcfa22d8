//! The colours of the nodes, and the neutral colours of light backgrounds.
//!
//! The eight hues follow Okabe and Ito, with two changes: their black is invisible on a dark background and their
//! yellow on a light one, so a wine red (after Tol) and a deeper yellow replace them. The order keeps neighbours on the
//! ring distinct for people with any common kind of colour blindness. Further nodes have the same hues, lighter, darker
//! and greyer. From the 33rd node on the colours repeat; the node's number is always shown too.

/// 8-bit sRGB.
pub type Rgb = [u8; 3];

/// The number of distinct node colours.
pub const DISTINCT_COLOURS: usize = 32;

/// Nodes whose colours are distinct wherever they meet in a chart, on a light and
/// on a dark background, for people with any common kind of colour blindness.
pub const CHART_NODES: [u16; 8] = [0, 3, 2, 4, 7, 1, 19, 12];

/// The neutral colours, and the accent, of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Neutral {
    /// The background.
    pub ground: Rgb,
    /// The main button, and selected items.
    pub accent: Rgb,
    /// Separating lines and axes.
    pub hairline: Rgb,
    /// Usual text.
    pub text: Rgb,
    /// Explaining text.
    pub quiet: Rgb,
}

/// A light screen.
pub const LIGHT: Neutral = Neutral {
    ground: [0xfa, 0xfb, 0xfc],
    accent: [0x5a, 0x46, 0xd6],
    hairline: [0xd5, 0xda, 0xe1],
    text: [0x16, 0x1b, 0x22],
    quiet: [0x5b, 0x66, 0x75],
};

/// White paper.
pub const PRINT: Neutral = Neutral { ground: [0xff; 3], ..LIGHT };

/// The colour of node `node` (from 0). It does not depend on the number of nodes, so a machine keeps its colour when
/// others are added.
pub fn node_colour(node: usize) -> Rgb {
    // The first node's colour does not repeat: any node may be the last one, which is the first one's neighbour.
    let place = if node < DISTINCT_COLOURS { node } else { 1 + (node - DISTINCT_COLOURS) % (DISTINCT_COLOURS - 1) };
    COLOURS[place / HUES][place % HUES]
}

/// The colours of all nodes of a ring of `nodes`.
pub fn node_colours(nodes: usize) -> Vec<Rgb> {
    (0..nodes).map(node_colour).collect()
}

/// Black or white, whichever is easier to read on `ground`.
pub fn text_on(ground: Rgb) -> Rgb {
    const BLACK: Rgb = [0x10, 0x12, 0x16];
    const WHITE: Rgb = [0xff; 3];
    if contrast(ground, WHITE) >= 3.4 { WHITE } else { BLACK }
}

/// The colour, made darker or lighter until text in it is easy to read on `ground`.
pub fn readable(colour: Rgb, ground: Rgb) -> Rgb {
    let ink = text_on(ground);
    let mut towards = (0..20).map(|i| mix(colour, ink, i as f32 / 20.0));
    towards.find(|&mixed| contrast(mixed, ground) >= 4.5).unwrap_or(ink)
}

/// The contrast ratio of two colours, from 1 (none) to 21 (WCAG 2).
pub fn contrast(one: Rgb, other: Rgb) -> f32 {
    let (one, other) = (luminance(one) + 0.05, luminance(other) + 0.05);
    one.max(other) / one.min(other)
}

/// Blends two colours in sRGB, as screens do: `share` is the part of `to`, 0 to 1.
pub fn mix(from: Rgb, to: Rgb, share: f32) -> Rgb {
    let share = share.clamp(0.0, 1.0);
    // No value is negative, so this rounds to nearest. It needs no function call for each pixel of a picture.
    std::array::from_fn(|i| (f32::from(from[i]) + (f32::from(to[i]) - f32::from(from[i])) * share + 0.5) as u8)
}

/// Relative luminance, 0 to 1.
pub fn luminance(colour: Rgb) -> f32 {
    let [r, g, b] = linear(colour);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

const HUES: usize = 8;

const COLOURS: [[Rgb; HUES]; 4] = [
    rgb([0x2F7DD1, 0x009E73, 0x56B4E9, 0xD55E00, 0x9A3B78, 0xE8D43A, 0xCC79A7, 0xE69F00]),
    rgb([0x81B9FB, 0x7ACFAC, 0xA5E0F2, 0xFDA070, 0xD98CB9, 0xF2E480, 0xF7B9C9, 0xFCC573]),
    rgb([0x075BA7, 0x047252, 0x2A90A3, 0x9B4201, 0x7F2660, 0x978802, 0xB05F78, 0x9C6A00]),
    rgb([0x7797BD, 0x7AA994, 0x99BFD6, 0xC58F74, 0x9E728B, 0xE2DBA2, 0xC59EB2, 0xD7B88A]),
];

const fn rgb(hex: [u32; HUES]) -> [Rgb; HUES] {
    let mut colours = [[0; 3]; HUES];
    let mut i = 0;
    while i < HUES {
        let [_, r, g, b] = hex[i].to_be_bytes();
        colours[i] = [r, g, b];
        i += 1;
    }
    colours
}

fn linear(colour: Rgb) -> [f32; 3] {
    colour.map(|byte| {
        let encoded = f32::from(byte) / 255.0;
        if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    type Matrix = [[f32; 3]; 3];

    /// Colour vision: normal, without red cones, and without green cones (Machado et al. 2009, severity 1).
    const VISIONS: [Matrix; 3] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.152_286, 1.052_583, -0.204_868], [0.114_503, 0.786_281, 0.099_216], [-0.003_882, -0.048_116, 1.051_998]],
        [[0.367_322, 0.860_646, -0.227_968], [0.280_085, 0.672_501, 0.047_413], [-0.011_82, 0.042_94, 0.968_881]],
    ];

    fn times(matrix: Matrix, vector: [f32; 3]) -> [f32; 3] {
        matrix.map(|row| row.iter().zip(vector).map(|(m, v)| m * v).sum())
    }

    /// Oklab (Ottosson 2020), in which equal distances look about equal; white is at distance 1 from black.
    fn oklab(colour: Rgb, vision: Matrix) -> [f32; 3] {
        const LMS: Matrix = [
            [0.412_221_46, 0.536_332_55, 0.051_445_995],
            [0.211_903_5, 0.680_699_5, 0.107_396_96],
            [0.088_302_46, 0.281_718_85, 0.629_978_7],
        ];
        const LAB: Matrix = [
            [0.210_454_26, 0.793_617_8, -0.004_072_047],
            [1.977_998_5, -2.428_592_2, 0.450_593_7],
            [0.025_904_037, 0.782_771_77, -0.808_675_77],
        ];
        let seen = times(vision, linear(colour)).map(|v| v.clamp(0.0, 1.0));
        times(LAB, times(LMS, seen).map(f32::cbrt))
    }

    /// The distance of two colours for the kind of vision that distinguishes them worst.
    fn distance(one: Rgb, other: Rgb) -> f32 {
        let difference = |vision| {
            let pairs = oklab(one, vision).into_iter().zip(oklab(other, vision));
            pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f32>().sqrt()
        };
        VISIONS.map(difference).into_iter().fold(f32::INFINITY, f32::min)
    }

    #[test]
    fn neighbours_are_distinct_for_all_vision() {
        for nodes in 2..=100 {
            let least = if nodes == 8 { 0.15 } else { 0.08 };
            for node in 0..nodes {
                let (one, other) = (node_colour(node), node_colour((node + 1) % nodes));
                let found = distance(one, other);
                assert!(found >= least, "nodes {node} and its neighbour of {nodes}: {one:?} {other:?} {found}");
            }
        }
    }

    #[test]
    fn chart_lines_are_distinct() {
        let colours = CHART_NODES.map(|node| node_colour(usize::from(node)));
        for (i, &one) in colours.iter().enumerate() {
            let seen = [contrast(one, PRINT.ground), contrast(one, [0x11, 0x14, 0x19])];
            assert!(seen.into_iter().all(|contrast| contrast >= 2.2), "{one:?} {seen:?}");
            for &other in &colours[..i] {
                assert!(distance(one, other) >= 0.08, "{one:?} {other:?} {}", distance(one, other));
            }
        }
    }

    #[test]
    fn readable_text_has_contrast() {
        for colour in COLOURS.into_iter().flatten() {
            for ground in [PRINT.ground, LIGHT.ground, [0x11, 0x14, 0x19]] {
                let found = readable(colour, ground);
                assert!(contrast(found, ground) >= 4.5, "{colour:?} on {ground:?}: {found:?}");
                assert!(contrast(colour, ground) < 4.5 || found == colour, "{colour:?} needs no change");
            }
        }
    }

    #[test]
    fn first_32_nodes_have_distinct_colours() {
        for nodes in 1..=DISTINCT_COLOURS {
            let mut colours = node_colours(nodes);
            colours.sort_unstable();
            colours.dedup();
            assert_eq!(colours.len(), nodes);
        }
    }

    #[test]
    fn text_on_every_colour_has_contrast() {
        for colour in COLOURS.into_iter().flatten() {
            let found = contrast(colour, text_on(colour));
            assert!(found >= 3.4, "{colour:?} {found}");
        }
    }

    #[test]
    fn mix_has_exact_ends() {
        let (one, other) = ([0, 10, 255], [255, 20, 1]);
        assert_eq!((mix(one, other, 0.0), mix(one, other, 1.0), mix(one, other, 7.0)), (one, other, other));
    }
}
