//! The nodes' colours, and what is not coloured on a light ground.
//!
//! Eight hues after Okabe and Ito, with two changes: their black is lost on a dark ground and their yellow on a
//! light one, so a wine red (after Tol) and a deeper yellow stand in. They are ordered so that neighbours on the
//! ring are far apart for people with any common kind of colour blindness; further nodes take the same hues
//! lighter, darker and greyer. From the 33rd node on the colours repeat; the node's number is always beside them.

/// 8-bit sRGB.
pub type Rgb = [u8; 3];

/// So many nodes have colours of their own.
pub const DISTINCT: usize = 32;

/// Nodes, in a ring of [`DISTINCT`], whose colours can be told apart wherever they meet in a chart, on a light ground
/// and on a dark one, for people with any common kind of colour blindness.
pub const CHART: [u16; 8] = [0, 3, 2, 4, 7, 1, 19, 12];

/// What has no colour of its own.
#[derive(Clone, Copy, Debug)]
pub struct Neutral {
    /// What everything lies on.
    pub ground: Rgb,
    /// What to press first, and what was chosen.
    pub accent: Rgb,
    /// Lines that order.
    pub hairline: Rgb,
    /// Text.
    pub text: Rgb,
    /// Text that explains.
    pub quiet: Rgb,
}

/// On a light screen.
pub const LIGHT: Neutral = Neutral {
    ground: [0xfa, 0xfb, 0xfc],
    accent: [0x5a, 0x46, 0xd6],
    hairline: [0xd5, 0xda, 0xe1],
    text: [0x16, 0x1b, 0x22],
    quiet: [0x5b, 0x66, 0x75],
};

/// On white paper.
pub const PRINT: Neutral = Neutral { ground: [0xff; 3], ..LIGHT };

/// The colour of node `node` (from 0) in a ring of `nodes`.
pub fn node_colour(node: usize, nodes: usize) -> Rgb {
    let last = nodes.saturating_sub(1);
    // The last node is the first one's neighbour: where both would have the same hue, it changes places with
    // the one four before it.
    let place = match node {
        _ if nodes % HUES != 1 || nodes == 1 => node,
        _ if node == last => last - HUES / 2,
        _ if node == last - HUES / 2 => last,
        _ => node,
    };
    COLOURS[place / HUES % COLOURS.len()][place % HUES]
}

/// The colours of all nodes of a ring of so many.
pub fn node_colours(nodes: usize) -> Vec<Rgb> {
    (0..nodes).map(|node| node_colour(node, nodes)).collect()
}

/// Black or white, whichever can be read better on `ground`.
pub fn text_on(ground: Rgb) -> Rgb {
    const BLACK: Rgb = [0x10, 0x12, 0x16];
    const WHITE: Rgb = [0xff; 3];
    if contrast(ground, WHITE) >= 3.4 { WHITE } else { BLACK }
}

/// The colour, only so much darker or lighter that text in it can be read on `ground`.
pub fn readable(colour: Rgb, ground: Rgb) -> Rgb {
    let ink = text_on(ground);
    let mut towards = (0..20).map(|i| mix(colour, ink, i as f32 / 20.0));
    towards.find(|&mixed| contrast(mixed, ground) >= 4.5).unwrap_or(ink)
}

/// The contrast of two colours, from 1 (none) to 21 (WCAG 2).
pub fn contrast(one: Rgb, other: Rgb) -> f32 {
    let (one, other) = (luminance(one) + 0.05, luminance(other) + 0.05);
    one.max(other) / one.min(other)
}

/// `share` of the way from `from` to `to`, in sRGB as screens blend.
pub fn mix(from: Rgb, to: Rgb, share: f32) -> Rgb {
    let share = share.clamp(0.0, 1.0);
    // None is negative, so that this rounds to nearest, and needs no call for each of a picture's pixels.
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

    /// How people see: in full colour, and without red or green cones (Machado et al. 2009, severity 1).
    const EYES: [Matrix; 3] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.152_286, 1.052_583, -0.204_868], [0.114_503, 0.786_281, 0.099_216], [-0.003_882, -0.048_116, 1.051_998]],
        [[0.367_322, 0.860_646, -0.227_968], [0.280_085, 0.672_501, 0.047_413], [-0.011_82, 0.042_94, 0.968_881]],
    ];

    fn times(matrix: Matrix, vector: [f32; 3]) -> [f32; 3] {
        matrix.map(|row| row.iter().zip(vector).map(|(m, v)| m * v).sum())
    }

    /// Oklab (Ottosson 2020), in which equal distances look about equal; white is 1 away from black.
    fn oklab(colour: Rgb, eye: Matrix) -> [f32; 3] {
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
        let seen = times(eye, linear(colour)).map(|v| v.clamp(0.0, 1.0));
        times(LAB, times(LMS, seen).map(f32::cbrt))
    }

    /// The distance as the eye that tells them apart worst sees it.
    fn distance(one: Rgb, other: Rgb) -> f32 {
        let apart = |eye| {
            let pairs = oklab(one, eye).into_iter().zip(oklab(other, eye));
            pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f32>().sqrt()
        };
        EYES.map(apart).into_iter().fold(f32::INFINITY, f32::min)
    }

    #[test]
    fn neighbours_are_far_apart_for_every_eye() {
        for nodes in 2..=100 {
            let least = if nodes == 8 { 0.15 } else { 0.08 };
            for node in 0..nodes {
                let (one, other) = (node_colour(node, nodes), node_colour((node + 1) % nodes, nodes));
                let found = distance(one, other);
                assert!(found >= least, "nodes {node} and its neighbour of {nodes}: {one:?} {other:?} {found}");
            }
        }
    }

    #[test]
    fn lines_in_a_chart_are_told_apart() {
        let colours = CHART.map(|node| node_colour(usize::from(node), DISTINCT));
        for (i, &one) in colours.iter().enumerate() {
            let seen = [contrast(one, PRINT.ground), contrast(one, [0x11, 0x14, 0x19])];
            assert!(seen.into_iter().all(|contrast| contrast >= 2.2), "{one:?} {seen:?}");
            for &other in &colours[..i] {
                assert!(distance(one, other) >= 0.08, "{one:?} {other:?} {}", distance(one, other));
            }
        }
    }

    #[test]
    fn names_can_be_read_in_every_colour() {
        for colour in COLOURS.into_iter().flatten() {
            for ground in [PRINT.ground, LIGHT.ground, [0x11, 0x14, 0x19]] {
                let found = readable(colour, ground);
                assert!(contrast(found, ground) >= 4.5, "{colour:?} on {ground:?}: {found:?}");
                assert!(contrast(colour, ground) < 4.5 || found == colour, "{colour:?} needs no change");
            }
        }
    }

    #[test]
    fn so_many_nodes_have_colours_of_their_own() {
        for nodes in 1..=DISTINCT {
            let mut colours = node_colours(nodes);
            colours.sort_unstable();
            colours.dedup();
            assert_eq!(colours.len(), nodes);
        }
    }

    #[test]
    fn numbers_can_be_read_on_every_colour() {
        for colour in COLOURS.into_iter().flatten() {
            let found = contrast(colour, text_on(colour));
            assert!(found >= 3.4, "{colour:?} {found}");
        }
    }

    #[test]
    fn a_mix_keeps_its_ends() {
        let (one, other) = ([0, 10, 255], [255, 20, 1]);
        assert_eq!((mix(one, other, 0.0), mix(one, other, 1.0), mix(one, other, 7.0)), (one, other, other));
    }
}
