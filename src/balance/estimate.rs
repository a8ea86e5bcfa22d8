//! Static bands by an estimate (§6.1): the parent samples the cost of the picture, and divides it into bands of about
//! equal cost.
//!
//! The picture is divided into up to 64 equal stretches in scan order; in each, every 199th pixel is sampled. That is
//! half a per cent of the whole work. The parent does it alone while all nodes wait: more pixels would make the
//! estimate better and the wait longer.

use std::mem;
use std::ops::Range;
use std::time::Duration;

use crate::picture::{Atom, Division};

/// Pixels from one sample to the next. A prime; otherwise the samples of a picture might all lie in a few of its
/// columns.
const SAMPLE_STEP_PIXELS: u32 = 199;
const MAX_STRETCHES: u32 = 64;

/// Returns the pixels to sample (positions in scan order), by stretch. Each stretch has at least one, unless the
/// picture is empty.
pub fn samples(division: Division) -> impl ExactSizeIterator<Item = impl Iterator<Item = u32> + Clone> {
    let pixels = division.pixels_in(&(0..division.atoms()));
    let stretches = (pixels / (2 * SAMPLE_STEP_PIXELS)).clamp(1, MAX_STRETCHES);
    let start = move |stretch: u32| (u64::from(pixels) * u64::from(stretch) / u64::from(stretches)) as u32;
    (0..stretches).map(move |stretch| (start(stretch)..start(stretch + 1)).step_by(SAMPLE_STEP_PIXELS as usize))
}

/// Returns a band for each of `nodes` nodes, of about equal cost by the sampled `costs` of the stretches. The bands are
/// consecutive and together hold all atoms. If all costs are 0, the bands have equal sizes.
pub(super) fn bands(costs: &[Duration], division: Division, nodes: usize) -> Vec<Range<Atom>> {
    let total: Duration = costs.iter().sum();
    if total.is_zero() {
        return division.bands(nodes).collect();
    }
    let a_stretch = f64::from(division.atoms()) / costs.len() as f64;
    let (mut stretch, mut before) = (0, 0.0);
    let mut end_of = |node: usize| {
        if node + 1 == nodes {
            return division.atoms();
        }
        let wanted = total.as_secs_f64() * (node + 1) as f64 / nodes as f64;
        while stretch + 1 < costs.len() && before + costs[stretch].as_secs_f64() < wanted {
            before += costs[stretch].as_secs_f64();
            stretch += 1;
        }
        let into = ((wanted - before) / costs[stretch].as_secs_f64().max(1e-12)).clamp(0.0, 1.0);
        ((stretch as f64 + into) * a_stretch).round() as Atom
    };
    let mut start = 0;
    let mut next = |node| {
        let end = end_of(node).max(start);
        mem::replace(&mut start, end)..end
    };
    (0..nodes).map(&mut next).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn each_stretch_is_sampled_and_no_pixel_twice(pixels in 1u32..200_000, atom in 1u32..100) {
            let all: Vec<Vec<u32>> = samples(Division::new(pixels, atom)).map(Iterator::collect).collect();
            prop_assert!(all.iter().all(|stretch| !stretch.is_empty()));
            let flat = all.concat();
            prop_assert!(flat.is_sorted_by(|a, b| a < b) && flat.iter().all(|&pixel| pixel < pixels));
            prop_assert!(flat.len() as u32 <= pixels / SAMPLE_STEP_PIXELS + 64 + 1);
        }

        #[test]
        fn bands_hold_every_atom_once_and_have_about_equal_cost(
            costs in prop::collection::vec(0u64..1000, 1..64), nodes in 1usize..40, pixels in 1u32..100_000,
        ) {
            let division = Division::new(pixels, 50);
            let costs: Vec<_> = costs.into_iter().map(Duration::from_micros).collect();
            let bands = bands(&costs, division, nodes);
            prop_assert_eq!(bands.len(), nodes);
            prop_assert_eq!((bands[0].start, bands[nodes - 1].end), (0, division.atoms()));
            prop_assert!(bands.windows(2).all(|pair| pair[0].end == pair[1].start));
            // The cost of a band, if all atoms of a stretch cost the same.
            let total: f64 = costs.iter().map(Duration::as_secs_f64).sum();
            let a_stretch = f64::from(division.atoms()) / costs.len() as f64;
            let dearest = costs.iter().max().unwrap().as_secs_f64() / a_stretch;
            let until = |atom: u32| -> f64 {
                let place = f64::from(atom) / a_stretch;
                let whole = (place as usize).min(costs.len());
                let part = costs.get(whole).map_or(0.0, |cost| cost.as_secs_f64() * (place - whole as f64));
                costs[..whole].iter().map(Duration::as_secs_f64).sum::<f64>() + part
            };
            if total > 0.0 {
                for band in bands {
                    let cost = until(band.end) - until(band.start);
                    prop_assert!((cost - total / nodes as f64).abs() <= dearest + 1e-9, "{cost} of {total}");
                }
            }
        }
    }
}
