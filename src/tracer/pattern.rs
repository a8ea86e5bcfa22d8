//! Where the samples of a pixel lie.
//!
//! They are points of Sobol's (0, 2)-sequence, scrambled as Owen proposed: of its first 4ᵏ points one lies in each cell
//! of a 2ᵏ × 2ᵏ grid, and in each other division of the square into as many equal boxes by halving. So samples that are
//! added are as well spread as if all had been chosen together, and no pixel has the pattern of its neighbour.

/// A pixel's samples, each with its place in the pixel: two numbers from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct SamplePattern {
    x_seed: u32,
    y_seed: u32,
}

impl SamplePattern {
    /// The pattern of the pixel at this place of the picture.
    pub fn new(x: u32, y: u32, seed: u32) -> Self {
        let x_seed = hash(x ^ hash(y ^ hash(seed)));
        Self { x_seed, y_seed: hash(x_seed ^ 0x9e37_79b9) }
    }

    /// The sample with this number.
    pub fn sample(self, index: u32) -> [f64; 2] {
        [owen_scramble(index, self.x_seed), owen_scramble(sobol_second_dimension(index).reverse_bits(), self.y_seed)]
            .map(|place| (f64::from(place) + 0.5) / (1_u64 << 32) as f64)
    }
}

/// The second dimension of Sobol's sequence, as 32 binary places.
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

/// Owen's scrambling of a number whose binary places are those of `reversed` from the last to the first: each place is
/// flipped or not by what stands before it (Laine and Karras, *Stratified Sampling for Stochastic Transparency*, 2011;
/// Burley, *Practical Hash-based Owen Scrambling*, 2020).
fn owen_scramble(reversed: u32, seed: u32) -> u32 {
    let mut bits = reversed.wrapping_add(seed);
    // To multiply by an even number carries from low places to high ones only.
    for even in [0x6c50_b47c_u32, 0xb82f_1e52, 0xc7af_e638, 0x8d22_f6e6] {
        bits ^= bits.wrapping_mul(even);
    }
    bits.reverse_bits()
}

/// A number that depends on every bit of another (Murmur's last steps).
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
        fn of_the_first_samples_one_lies_in_each_box(x in 0_u32..5000, y in 0_u32..5000, seed: u32, halvings in 0_u32..10) {
            let pattern = SamplePattern::new(x, y, seed);
            for across in 0..=halvings {
                let (columns, rows) = (1_u32 << across, 1_u32 << (halvings - across));
                let mut seen = vec![false; (columns * rows) as usize];
                for index in 0..columns * rows {
                    let [u, v] = pattern.sample(index);
                    let place = (v * f64::from(rows)) as u32 * columns + (u * f64::from(columns)) as u32;
                    prop_assert!(!seen[place as usize], "{} in {} × {}", index, columns, rows);
                    seen[place as usize] = true;
                }
            }
        }
    }

    #[test]
    fn over_many_pixels_the_samples_lie_everywhere() {
        // Of 4 × 4 cells each holds the first sample of about a sixteenth of all pixels.
        let mut cells = [0_u32; 16];
        for pixel in 0..16_000 {
            let [u, v] = SamplePattern::new(pixel % 160, pixel / 160, 7).sample(0);
            cells[(v * 4.0) as usize * 4 + (u * 4.0) as usize] += 1;
        }
        assert!(cells.iter().all(|&count| (850..1150).contains(&count)), "{cells:?}");
    }
}
