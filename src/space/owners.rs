//! Division of the octree's leaves among owners.

/// A method of division.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Partition {
    /// Each owner gets consecutive leaves in Morton order, with about the same work as all others. Neighbours mostly
    /// have one owner.
    Runs,
    /// Leaf after leaf goes to the next owner in turn; for comparison.
    RoundRobin,
}

/// The owner of each leaf, from 0 to `owners` − 1; `owners` must not be 0. `work` is each leaf's work, in any unit.
pub fn assign_owners(how: Partition, work: &[u64], owners: u32) -> Vec<u32> {
    match how {
        Partition::Runs => runs(work, owners),
        Partition::RoundRobin => (0..work.len() as u32).map(|leaf| leaf % owners).collect(),
    }
}

/// Cuts the sequence of all work into equal parts. A leaf belongs to the part that contains its middle, so no owner's
/// work differs from the mean by more than the work of one leaf.
fn runs(work: &[u64], owners: u32) -> Vec<u32> {
    let all = u128::from(work.iter().sum::<u64>().max(1));
    let mut before = 0;
    let mut owner_of = |own: &u64| {
        let twice_middle = u128::from(2 * before + own);
        before += own;
        // The middle of a leaf without work may be the end of the sequence.
        (twice_middle * u128::from(owners) / (2 * all)).min(u128::from(owners) - 1) as u32
    };
    work.iter().map(&mut owner_of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn runs_are_consecutive_and_balanced_within_the_largest_leaf(
            work in prop::collection::vec(prop_oneof![Just(0), 0u64..100, 0u64..10_000], 0..100),
            owners in 1u32..40,
        ) {
            let dealt = assign_owners(Partition::Runs, &work, owners);
            prop_assert_eq!(dealt.len(), work.len());
            prop_assert!(dealt.is_sorted() && dealt.iter().all(|&owner| owner < owners));
            let mean = work.iter().sum::<u64>() as f64 / f64::from(owners);
            let largest = work.iter().max().copied().unwrap_or(0) as f64;
            for owner in 0..owners {
                let own = work.iter().zip(&dealt).filter(|(_, of)| **of == owner).map(|(work, _)| *work).sum::<u64>();
                prop_assert!((own as f64 - mean).abs() <= largest + 1e-9 * mean, "{owner} has {own} of {mean}");
            }
        }
    }
}
