//! Of an atom that is traced twice, only the first result counts: the picture takes each atom once.

use std::ops::Range;

use crate::picture::{Atom, Division, push_atom};

/// Which atoms are in the picture.
#[derive(Debug)]
pub(super) struct PlacedOnce {
    placed: Vec<bool>,
}

impl PlacedOnce {
    /// Of a picture that is cut so; none is in it.
    pub fn new(division: Division) -> Self {
        Self { placed: vec![false; division.atoms() as usize] }
    }

    /// Those of these atoms that come for the first time, in as few ranges as possible.
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
    fn each_atom_comes_once() {
        let mut firsts = PlacedOnce::new(Division::new(100, 10));
        assert_eq!(firsts.take(2..4), [2..4]);
        assert_eq!(firsts.take(0..6), [0..2, 4..6]);
        assert_eq!(firsts.take(1..6), []);
        assert_eq!(firsts.take(5..10), [6..10]);
    }
}
