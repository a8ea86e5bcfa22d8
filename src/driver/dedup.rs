//! Drops results of atoms that are placed already: only the first result of an atom counts.

use std::ops::Range;

use crate::picture::{Atom, Division, push_atom};

/// The set of atoms that are in the picture.
#[derive(Debug)]
pub(super) struct PlacedOnce {
    placed: Vec<bool>,
}

impl PlacedOnce {
    /// Creates an empty set for a picture with this division.
    pub fn new(division: Division) -> Self {
        Self { placed: vec![false; division.atoms() as usize] }
    }

    /// Inserts these atoms. Returns those that are new, in as few ranges as possible.
    pub fn take(&mut self, atoms: Range<Atom>) -> Vec<Range<Atom>> {
        let mut new = Vec::new();
        for atom in atoms {
            if !std::mem::replace(&mut self.placed[atom as usize], true) {
                push_atom(&mut new, atom);
            }
        }
        new
    }
}

#[cfg(test)]
#[expect(clippy::single_range_in_vec_init, reason = "results are ranges")]
mod tests {
    use super::*;

    #[test]
    fn each_atom_is_new_only_once() {
        let mut placed_once = PlacedOnce::new(Division::new(100, 10));
        assert_eq!(placed_once.take(2..4), [2..4]);
        assert_eq!(placed_once.take(0..6), [0..2, 4..6]);
        assert_eq!(placed_once.take(1..6), []);
        assert_eq!(placed_once.take(5..10), [6..10]);
    }
}
