//! The share of an offerer in the adaptive ring, by the present speeds of both nodes.

/// Returns how many of the owner's `waiting` atoms go to an offerer so that both end together.
///
/// Speeds are work per time; `own` is the owner's, `offerer` the offerer's, and `others` the sum of those that are
/// expected to offer too. `cost` is the work in an atom, `ahead` the atoms that the owner traces before the waiting
/// ones (a fraction), and `latency` the time that a transfer travels. In a time τ from now the owner does the work `own
/// · τ` and the offerer `offerer · (τ − latency)`; the sum of both is all the work there is. The result is rounded to
/// nearest, a half in favour of the offerer.
pub fn share_by_speed(waiting: u32, ahead: f64, own: f64, offerer: f64, others: f64, latency: f64, cost: f64) -> u32 {
    let all = own + offerer + others;
    if waiting == 0 || !(all > 0.0 && cost > 0.0) {
        return 0;
    }
    let work = (f64::from(waiting) + ahead) * cost;
    let fair = offerer * (work - (own + others) * latency) / (all * cost);
    // The cast turns a negative number and NaN into 0.
    ((fair + 0.5) as u32).min(waiting)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn equal_speeds_halve_the_work_of_both() {
        assert_eq!(share_by_speed(99, 1.0, 1.0, 1.0, 0.0, 0.0, 1e-3), 50);
        assert_eq!(share_by_speed(100, 0.0, 0.1, 0.9, 0.0, 0.0, 1e-3), 90);
        assert_eq!(share_by_speed(100, 0.0, 0.25, 0.25, 0.5, 0.0, 1e-3), 25, "two more are to come");
    }

    #[test]
    fn no_transfer_that_travels_longer_than_it_saves() {
        let share = |latency| share_by_speed(10, 0.0, 1.0, 1.0, 0.0, latency, 1e-3);
        assert_eq!([share(0.0), share(4e-3), share(8e-3), share(11e-3)], [5, 3, 1, 0]);
    }

    proptest! {
        /// One atom more or less would not make both end earlier.
        #[test]
        fn both_end_together(
            waiting in 1u32..1000, ahead in 0.0..1.0, own in 0.01..1.0, offerer in 0.01..1.0, latency in 0.0..0.1,
        ) {
            let cost = 1e-3;
            let given = share_by_speed(waiting, ahead, own, offerer, 0.0, latency, cost);
            let end = |given: u32| {
                let kept = f64::from(waiting - given) + ahead;
                let helper = if given > 0 { latency + f64::from(given) * cost / offerer } else { 0.0 };
                (kept * cost / own).max(helper)
            };
            // An atom's time on the slower of both is what rounding may cost.
            let atom = cost / own.min(offerer);
            for other in [given.saturating_sub(1), (given + 1).min(waiting)] {
                prop_assert!(end(given) <= end(other) + atom + 1e-9, "{given}: {} {other}: {}", end(given), end(other));
            }
        }
    }
}
