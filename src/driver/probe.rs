//! Estimates the cost of the whole picture from a sample, before it is traced.

use std::thread;
use std::time::Duration;

use super::meter::Meter;
use crate::picture::{Atom, Division};
use crate::tracer::{Scratch, Tracer};

/// Pixels between two checks of the budget.
const PIECE_PIXELS: usize = 64;

/// The measured costs of a sample of atoms, and estimates for the whole picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// The atoms that were traced completely, spread evenly over the picture, with their CPU times.
    pub atoms: Vec<(Atom, Duration)>,
    /// The estimated CPU time of the whole picture.
    pub whole: Duration,
    /// The estimated number of rays of the whole picture, of all kinds; they are its cost in virtual time.
    pub rays: u64,
}

/// Traces atoms spread evenly over the picture on this thread, until the CPU time `budget` is used or all atoms are
/// traced. It traces a few pixels in any case.
pub fn probe(tracer: &Tracer, division: Division, budget: Duration) -> Probe {
    let (mut meter, mut scratch, mut pixels) = (Meter::new(), Scratch::default(), Vec::new());
    let (mut atoms, mut used, mut traced) = (Vec::new(), Duration::ZERO, 0u64);
    'atoms: for atom in spread(division.atoms()) {
        let range = division.pixels(atom);
        let mut cost = Duration::ZERO;
        for start in range.clone().step_by(PIECE_PIXELS) {
            if traced > 0 && used >= budget {
                break 'atoms;
            }
            pixels.clear();
            meter.lap();
            tracer.trace(start..range.end.min(start + PIECE_PIXELS as u32), &mut scratch, &mut pixels);
            let piece = meter.lap();
            (cost, used, traced) = (cost + piece, used + piece, traced + pixels.len() as u64);
        }
        atoms.push((atom, cost));
    }
    let all = division.pixels_in(&(0..division.atoms()));
    let scale = if traced == 0 { 0.0 } else { f64::from(all) / traced as f64 };
    let rays = (scratch.rays.total() as f64 * scale).round() as u64;
    Probe { atoms, whole: used.mul_f64(scale), rays }
}

impl Probe {
    /// Estimates the cost of the whole picture for threads that sleep after each atom, as those of slow machines do:
    /// their caches are cold and the processor has slowed down. Traces some of the probe's atoms once more, with a
    /// sleep before each.
    pub fn whole_with_rests(&self, tracer: &Tracer, division: Division) -> Duration {
        const ATOMS: usize = 63;
        const REST: Duration = Duration::from_millis(2);
        let (mut meter, mut scratch, mut pixels) = (Meter::new(), Scratch::default(), Vec::new());
        let rested = |&(atom, at_once): &(Atom, Duration)| {
            thread::sleep(REST);
            pixels.clear();
            meter.lap();
            tracer.trace(division.pixels(atom), &mut scratch, &mut pixels);
            meter.lap().div_duration_f64(at_once)
        };
        let mut times: Vec<f64> =
            self.atoms.iter().filter(|(_, cost)| !cost.is_zero()).take(ATOMS).map(rested).collect();
        times.sort_by(f64::total_cmp);
        // The median, since other programs use the processor too.
        let middle = times.get(times.len() / 2).copied().unwrap_or(1.0);
        self.whole.mul_f64(middle.clamp(1.0, 4.0))
    }
}

/// Returns every atom once, in van der Corput's order: any number of first atoms is spread evenly.
fn spread(atoms: u32) -> impl Iterator<Item = Atom> {
    let bits = atoms.next_power_of_two().trailing_zeros();
    // With 0 bits there is one atom at most, and the shift by 32 would overflow.
    (0..1u64 << bits)
        .map(move |k| (k as u32).reverse_bits().checked_shr(32 - bits).unwrap_or(0))
        .filter(move |&atom| atom < atoms)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Quality, Size};
    use crate::scene::{Scene, built_in};

    fn tracer(size: Size) -> Tracer {
        let scene = Scene::parse(built_in("ten-objects").unwrap()).unwrap();
        Tracer::new(&scene, size, Quality::default())
    }

    #[test]
    fn every_atom_comes_once_and_any_prefix_is_spread_evenly() {
        for atoms in [0, 1, 2, 3, 100, 1000] {
            let mut order: Vec<_> = spread(atoms).collect();
            order.sort_unstable();
            assert!(order.into_iter().eq(0..atoms));
        }
        for part in 1..64 {
            let upper = spread(1024).take(part).filter(|&atom| atom >= 512).count();
            assert!(upper.abs_diff(part - upper) <= 1);
        }
    }

    #[test]
    fn estimate_without_budget_is_the_sum() {
        let size = Size::new(40, 30).unwrap();
        let found = probe(&tracer(size), Division::new(size.pixels(), 50), Duration::MAX);
        assert_eq!(found.atoms.len(), 24);
        let sum: Duration = found.atoms.iter().map(|(_, cost)| *cost).sum();
        assert!(sum > Duration::ZERO && found.whole.abs_diff(sum) < Duration::from_nanos(100));
        let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
        tracer(size).trace(0..size.pixels(), &mut scratch, &mut pixels);
        assert_eq!(found.rays, scratch.rays.total());
    }

    #[test]
    fn rests_never_lower_the_cost() {
        let size = Size::new(40, 30).unwrap();
        let (tracer, division) = (tracer(size), Division::new(size.pixels(), 50));
        let found = probe(&tracer, division, Duration::MAX);
        let rested = found.whole_with_rests(&tracer, division);
        assert!(rested >= found.whole && rested <= 4 * found.whole);
        let none = Probe { atoms: Vec::new(), ..found.clone() };
        assert_eq!(none.whole_with_rests(&tracer, division), found.whole);
    }

    #[test]
    fn budget_ends_a_large_atom_early() {
        let size = Size::new(400, 300).unwrap();
        let found = probe(&tracer(size), Division::new(size.pixels(), u32::MAX), Duration::ZERO);
        assert!(found.atoms.is_empty() && found.whole > Duration::ZERO && found.rays > 0);
    }
}
