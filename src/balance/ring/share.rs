//! The share of an offerer in the article's ring (§7).

/// Returns how many of an owner's `waiting` atoms go to an offerer so that both end together; 0 if that would be fewer
/// than `part`. The owner has traced `own` atoms, the offerer `offerer` atoms.
///
/// Both began together, so these counts tell their speeds: the share is `waiting × offerer / (offerer + own)`, rounded
/// to nearest (a half goes to the offerer). Rounding down would leave the last atom to a slow owner.
///
/// *Ours,* since the article's average is undefined without counts: half of the atoms if neither has traced any; one
/// atom, as a trial, if only the owner has, since an offerer that has traced nothing may still be fast.
pub fn share(waiting: u32, own: u32, offerer: u32, part: u32) -> u32 {
    let (waiting, own, offerer) = (u64::from(waiting), u64::from(own), u64::from(offerer));
    let share = match (own, offerer) {
        (0, 0) => waiting.div_ceil(2),
        (_, 0) => waiting.min(1),
        // The integer nearest to n / d is ⌊(2n + d) / 2d⌋. It fits: a picture has at most 2²⁷ atoms.
        _ => (2 * waiting * offerer + own + offerer) / (2 * (own + offerer)),
    };
    // The cast is exact: the share is at most `waiting`, a u32.
    let share = share as u32;
    if share < part { 0 } else { share }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const MANY: u32 = 1 << 27;

    proptest! {
        #[test]
        fn share_is_at_most_what_waits(waiting in 0..=MANY, own in 0..=MANY, offerer in 0..=MANY) {
            prop_assert!(share(waiting, own, offerer, 1) <= waiting);
        }

        /// From one atom on: a node that has traced none gets its trial.
        #[test]
        fn more_traced_atoms_never_lower_the_share(
            waiting in 0..=MANY, own in 0..=MANY, offerer in 1..MANY, more in 0..1000u32,
        ) {
            prop_assert!(share(waiting, own, offerer, 1) <= share(waiting, own, offerer + more, 1));
        }

        #[test]
        fn share_rounds_to_nearest(waiting in 0..=MANY, own in 0..=MANY, offerer in 1..=MANY) {
            let exact = f64::from(waiting) * f64::from(offerer) / (f64::from(offerer) + f64::from(own));
            let off = f64::from(share(waiting, own, offerer, 1)) - exact;
            prop_assert!(-0.5 - 1e-6 < off && off < 0.5 + 1e-6, "{off} off");
        }

        #[test]
        fn share_below_a_part_is_0(
            waiting in 0..1000u32, own in 0..100u32, offerer in 0..100u32, part in 1..50u32,
        ) {
            let whole = share(waiting, own, offerer, 1);
            prop_assert_eq!(share(waiting, own, offerer, part), if whole >= part { whole } else { 0 });
        }
    }

    #[test]
    fn share_follows_the_speeds() {
        assert_eq!(share(100, 50, 50, 1), 50);
        assert_eq!(share(100, 10, 90, 1), 90);
        assert_eq!(share(100, 90, 10, 1), 10);
        assert_eq!(share(100, 1000, 1, 1), 0);
        assert_eq!(share(1, 1, 99, 1), 1, "the last atom does not stay with the slow owner");
    }

    #[test]
    fn share_without_counts_is_half_or_one_atom() {
        assert_eq!([share(10, 0, 0, 1), share(1, 0, 0, 1), share(0, 0, 0, 1)], [5, 1, 0]);
        assert_eq!([share(10, 7, 0, 1), share(0, 7, 0, 1)], [1, 0]);
        assert_eq!(share(10, 0, 7, 1), 10, "the owner has traced nothing in the same time");
    }
}
