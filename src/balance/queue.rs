//! A node's queue of atoms.

use std::collections::VecDeque;
use std::ops::Range;

use crate::picture::Atom;

/// Waiting atoms in the order in which they will be traced, as non-empty ranges.
#[derive(Debug, Default)]
pub(super) struct Queue {
    ranges: VecDeque<Range<Atom>>,
}

impl Queue {
    /// Returns the number of atoms.
    pub fn len(&self) -> u32 {
        self.ranges.iter().map(|range| range.end - range.start).sum()
    }

    /// Appends atoms at the back.
    pub fn push(&mut self, range: Range<Atom>) {
        if !range.is_empty() {
            self.ranges.push_back(range);
        }
    }

    /// Removes and returns the atom at the front.
    pub fn pop(&mut self) -> Option<Atom> {
        let front = self.ranges.front_mut()?;
        let atom = front.next();
        if front.start == front.end {
            self.ranges.pop_front();
        }
        atom
    }

    /// Returns the ranges in their order.
    pub fn ranges(&self) -> impl Iterator<Item = &Range<Atom>> {
        self.ranges.iter()
    }

    /// Removes these atoms, as far as they are in the queue.
    pub fn remove(&mut self, atoms: &Range<Atom>) {
        if atoms.is_empty() {
            return;
        }
        let remainder = |range: &Range<Atom>| {
            let before = range.start..range.end.min(atoms.start);
            let after = range.start.max(atoms.end)..range.end;
            [before, after].into_iter().filter(|rest| rest.start < rest.end)
        };
        self.ranges = self.ranges.iter().flat_map(remainder).collect();
    }

    /// Removes and returns the last `count` atoms in their order, or all if there are fewer.
    pub fn split_off(&mut self, mut count: u32) -> Vec<Range<Atom>> {
        let mut taken = VecDeque::new();
        while count > 0
            && let Some(last) = self.ranges.pop_back()
        {
            let cut = last.end - count.min(last.end - last.start);
            count -= last.end - cut;
            self.push(last.start..cut);
            taken.push_front(cut..last.end);
        }
        taken.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn atoms(ranges: impl IntoIterator<Item = Range<Atom>>) -> Vec<Atom> {
        ranges.into_iter().flatten().collect()
    }

    proptest! {
        #[test]
        fn split_off_moves_the_last_atoms_and_loses_none(
            ranges in prop::collection::vec((0u32..1000, 0u32..20).prop_map(|(start, len)| start..start + len), 0..6),
            count in 0u32..80,
        ) {
            let all = atoms(ranges.clone());
            let mut queue = Queue::default();
            ranges.into_iter().for_each(|range| queue.push(range));
            prop_assert_eq!(queue.len() as usize, all.len());
            let taken = atoms(queue.split_off(count));
            prop_assert_eq!(taken.len(), all.len().min(count as usize));
            let kept: Vec<Atom> = std::iter::from_fn(|| queue.pop()).collect();
            prop_assert_eq!([kept, taken].concat(), all);
        }

        #[test]
        fn remove_takes_out_these_atoms_and_no_others(
            ranges in prop::collection::vec((0u32..100, 0u32..20).prop_map(|(start, len)| start..start + len), 0..6),
            (start, len) in (0u32..100, 0u32..40),
        ) {
            let mut queue = Queue::default();
            ranges.iter().for_each(|range| queue.push(range.clone()));
            queue.remove(&(start..start + len));
            let kept: Vec<Atom> = std::iter::from_fn(|| queue.pop()).collect();
            let expected: Vec<Atom> =
                ranges.into_iter().flatten().filter(|atom| !(start..start + len).contains(atom)).collect();
            prop_assert_eq!(kept, expected);
        }
    }
}
