//! The automatic choice among measured points.

use super::Point;

/// Returns the Pareto front, the fastest point first: no other point is at least as fast and at least as good. Of
/// several equal points it has one.
pub fn front(points: &[Point]) -> Vec<&Point> {
    let mut sorted: Vec<&Point> = points.iter().collect();
    sorted.sort_by(|a, b| a.cpu_s.total_cmp(&b.cpu_s).then(a.rmse().total_cmp(&b.rmse())));
    let mut least = f64::INFINITY;
    sorted.retain(|point| {
        let is_better = point.rmse() < least;
        least = least.min(point.rmse());
        is_better
    });
    sorted
}

/// Returns the fastest point with an error of at most `error` (see [`Point::rmse`]); `None` if there is none.
pub fn fastest_within(points: &[Point], error: f64) -> Option<&Point> {
    front(points).into_iter().find(|point| point.rmse() <= error)
}

/// Returns the best point that takes at most `seconds` of CPU time; `None` if there is none.
pub fn best_within(points: &[Point], seconds: f64) -> Option<&Point> {
    front(points).into_iter().rfind(|point| point.cpu_s <= seconds)
}

#[cfg(test)]
pub(super) mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::picture::{Difference, Quality};

    /// Makes a point with this time and error.
    pub fn point(cpu_s: f64, rmse: f64) -> Point {
        let difference = Difference { rmse, wrong_pixels: 0, worst_ssim: 1.0 };
        Point { quality: Quality::default(), cpu_s, rays: 1, difference }
    }

    fn clouds() -> impl Strategy<Value = Vec<Point>> {
        // Few values, so that many points are equal.
        let number = || (1..12_u32).prop_map(f64::from);
        prop::collection::vec((number(), number()).prop_map(|(cpu_s, rmse)| point(cpu_s, rmse)), 0..40)
    }

    fn is_as_good(one: &Point, other: &Point) -> bool {
        one.cpu_s <= other.cpu_s && one.rmse() <= other.rmse()
    }

    proptest! {
        #[test]
        fn front_dominates_all_points_and_is_dominated_by_none(points in clouds()) {
            let front = front(&points);
            prop_assert!(front.is_sorted_by(|a, b| a.cpu_s < b.cpu_s && a.rmse() > b.rmse()));
            for point in &points {
                prop_assert!(front.iter().any(|best| is_as_good(best, point)));
                prop_assert!(front.iter().all(|best| *best == point || !is_as_good(point, best)));
            }
        }

        #[test]
        fn choice_is_best_within_limit(points in clouds(), limit in 0.5..13.0_f64) {
            let within: Vec<&Point> = points.iter().filter(|point| point.rmse() <= limit).collect();
            match fastest_within(&points, limit) {
                Some(fastest) => {
                    prop_assert!(fastest.rmse() <= limit && within.iter().all(|point| fastest.cpu_s <= point.cpu_s));
                }
                None => prop_assert!(within.is_empty()),
            }
            let within: Vec<&Point> = points.iter().filter(|point| point.cpu_s <= limit).collect();
            match best_within(&points, limit) {
                Some(best) => {
                    prop_assert!(best.cpu_s <= limit && within.iter().all(|point| best.rmse() <= point.rmse()));
                }
                None => prop_assert!(within.is_empty()),
            }
        }

        #[test]
        fn milder_limit_gives_no_worse_choice(points in clouds(), limit in 0.5..13.0_f64, more in 0.0..5.0_f64) {
            if let (Some(strict), Some(mild)) = (fastest_within(&points, limit), fastest_within(&points, limit + more)) {
                prop_assert!(mild.cpu_s <= strict.cpu_s);
            }
            if let (Some(short), Some(long)) = (best_within(&points, limit), best_within(&points, limit + more)) {
                prop_assert!(long.rmse() <= short.rmse());
            }
        }
    }
}
