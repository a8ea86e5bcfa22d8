//! The article's division (§7): a picture is a sequence of atoms in scan order, and a band is a range of atoms.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::Colour;

/// The number of an atom in scan order. An atom is the unit of work that is never divided.
pub type Atom = u32;

/// Appends an atom to a list of ranges. It extends the last range if it follows it.
pub fn push_atom(ranges: &mut Vec<Range<Atom>>, atom: Atom) {
    match ranges.last_mut() {
        Some(last) if last.end == atom => last.end += 1,
        _ => ranges.push(atom..atom + 1),
    }
}

/// The number of atoms in these ranges.
pub fn atoms_in(ranges: &[Range<Atom>]) -> u32 {
    ranges.iter().map(|range| range.len() as u32).sum()
}

/// Division of a picture into atoms: runs of `atom_pixels` pixels in scan order. Only the last may be shorter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Division {
    pixels: u32,
    atom_pixels: u32,
}

impl Division {
    /// With more atoms the records, about 250 bytes for each atom, would not fit the memory of a usual computer.
    pub const MAX_ATOMS: u32 = 1 << 24;

    /// `pixels` is the number of pixels of the picture. An atom has at least one pixel, even if `atom_pixels` is 0.
    pub fn new(pixels: u32, atom_pixels: u32) -> Self {
        Self { pixels, atom_pixels: atom_pixels.max(1) }
    }

    /// The number of atoms.
    pub fn atoms(self) -> u32 {
        self.pixels.div_ceil(self.atom_pixels)
    }

    /// The number of pixels of every atom but the last.
    pub fn atom_pixels(self) -> u32 {
        self.atom_pixels
    }

    /// The pixels of `atom`, as positions in scan order.
    pub fn pixels(self, atom: Atom) -> Range<u32> {
        // u64, since the end of the last atom may lie beyond u32::MAX.
        let start = u64::from(atom) * u64::from(self.atom_pixels);
        let end = start + u64::from(self.atom_pixels);
        let clip = |pixel: u64| pixel.min(u64::from(self.pixels)) as u32;
        clip(start)..clip(end)
    }

    /// The pixels of the atoms of `range`, as positions in scan order.
    pub fn pixels_of(self, range: &Range<Atom>) -> Range<u32> {
        if range.is_empty() { 0..0 } else { self.pixels(range.start).start..self.pixels(range.end - 1).end }
    }

    /// The number of pixels of the atoms of `range`.
    pub fn pixels_in(self, range: &Range<Atom>) -> u32 {
        self.pixels_of(range).len() as u32
    }

    /// Splits the colours of atoms that were traced together: for each range of `atoms`, in this order, its pixels
    /// (positions in scan order) and their colours.
    ///
    /// # Panics
    /// If there are fewer `colours` than pixels in the atoms.
    pub fn placed<'a>(
        self,
        atoms: &'a [Range<Atom>],
        colours: &'a [Colour],
    ) -> impl Iterator<Item = (Range<u32>, &'a [Colour])> {
        let mut rest = colours;
        atoms.iter().map(move |atoms| {
            let start = self.pixels(atoms.start).start;
            let (these, others) = rest.split_at(self.pixels_in(atoms) as usize);
            rest = others;
            (start..start + these.len() as u32, these)
        })
    }

    /// The first share of each of `nodes` nodes: consecutive bands whose sizes differ by at most one atom, the longer
    /// ones first. With more nodes than atoms the last bands are empty.
    pub fn bands(self, nodes: usize) -> impl Iterator<Item = Range<Atom>> {
        let (atoms, nodes) = (u64::from(self.atoms()), nodes as u64);
        let (share, longer) = (atoms / nodes.max(1), atoms % nodes.max(1));
        let start = move |node: u64| (node * share + node.min(longer)) as Atom;
        (0..nodes).map(move |node| start(node)..start(node + 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_last_atom_may_be_shorter() {
        let division = Division::new(130, 50);
        assert_eq!(division.atoms(), 3);
        assert_eq!([0, 1, 2].map(|atom| division.pixels(atom)), [0..50, 50..100, 100..130]);
        assert_eq!(division.pixels_in(&(1..3)), 80);
        assert_eq!(division.pixels_in(&(3..3)), 0);
    }

    #[test]
    fn placed_splits_colours_by_range() {
        let colours: Vec<_> = (0..80u8).map(|shade| [f32::from(shade); 3]).collect();
        let atoms = [2..3, 0..1];
        let placed: Vec<_> = Division::new(130, 50).placed(&atoms, &colours).collect();
        assert_eq!(placed, [(100..130, &colours[..30]), (0..50, &colours[30..])]);
    }

    #[test]
    fn atom_may_be_larger_than_picture() {
        let division = Division::new(7, u32::MAX);
        assert_eq!((division.atoms(), division.pixels(0)), (1, 0..7));
    }
}
