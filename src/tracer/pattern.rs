//! The positions of a pixel's samples.
//!
//! They are points of Sobol's (0, 2)-sequence with Owen's scrambling: each cell of a 2ᵏ × 2ᵏ grid contains one of the
//! first 4ᵏ points, and so does each box of any other division of the square into 4ᵏ equal boxes by halving. So added
//! samples are as well spread as if all had been chosen together, and no pixel has its neighbour's pattern.

/// The sample positions of a pixel: pairs of numbers from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct SamplePattern {
    x_seed: u32,
    y_seed: u32,
}

impl SamplePattern {
    /// The pattern of the pixel in column `x` and row `y`.
    pub fn new(x: u32, y: u32, seed: u32) -> Self {
        let x_seed = hash(x ^ hash(y ^ hash(seed)));
        Self { x_seed, y_seed: hash(x_seed ^ 0x9e37_79b9) }
    }

    /// The position of the sample with this index.
    pub fn sample(self, index: u32) -> [f64; 2] {
        [owen_scramble(index, self.x_seed), owen_scramble(sobol_second_dimension(index).reverse_bits(), self.y_seed)]
            .map(|place| (f64::from(place) + 0.5) / (1_u64 << 32) as f64)
    }
}

/// The second dimension of Sobol's sequence, as 32 binary digits after the point.
fn sobol_second_dimension(mut index: u32) -> u32 {
    let (mut place, mut direction) = (0, 1_u32 << 31);
    while index > 0 {
        if index & 1 == 1 {
            place ^= direction;
        }
        direction ^= direction >> 1;
        index >>= 1;
    }
    place
}

/// Owen's scrambling of a number, given with its bits in reverse: each binary digit is flipped or not depending on the
/// digits before it (Laine and Karras, *Stratified Sampling for Stochastic Transparency*, 2011; Burley, *Practical
/// Hash-based Owen Scrambling*, 2020).
fn owen_scramble(reversed: u32, seed: u32) -> u32 {
    let mut bits = reversed.wrapping_add(seed);
    // Multiplication by an even number carries from low bits to higher ones only.
    for even in [0x6c50_b47c_u32, 0xb82f_1e52, 0xc7af_e638, 0x8d22_f6e6] {
        bits ^= bits.wrapping_mul(even);
    }
    bits.reverse_bits()
}

/// Hashes a number, so that each bit depends on all bits of it (the last steps of Murmur).
fn hash(mut bits: u32) -> u32 {
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x85eb_ca6b);
    bits = (bits ^ (bits >> 13)).wrapping_mul(0xc2b2_ae35);
    bits ^ (bits >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn each_elementary_box_has_one_sample(x in 0_u32..5000, y in 0_u32..5000, seed: u32, halvings in 0_u32..10) {
            let pattern = SamplePattern::new(x, y, seed);
            for across in 0..=halvings {
                let (columns, rows) = (1_u32 << across, 1_u32 << (halvings - across));
                let mut seen = vec![false; (columns * rows) as usize];
                for index in 0..columns * rows {
                    let [u, v] = pattern.sample(index);
                    let cell = (v * f64::from(rows)) as u32 * columns + (u * f64::from(columns)) as u32;
                    prop_assert!(!seen[cell as usize], "{} in {} × {}", index, columns, rows);
                    seen[cell as usize] = true;
                }
            }
        }
    }

    #[test]
    fn first_samples_of_pixels_are_uniform() {
        // Each of 4 × 4 cells contains the first sample of about a sixteenth of all pixels.
        let mut cells = [0_u32; 16];
        for pixel in 0..16_000 {
            let [u, v] = SamplePattern::new(pixel % 160, pixel / 160, 7).sample(0);
            cells[(v * 4.0) as usize * 4 + (u * 4.0) as usize] += 1;
        }
        assert!(cells.iter().all(|&count| (850..1150).contains(&count)), "{cells:?}");
    }
}
