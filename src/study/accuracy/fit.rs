//! Straight lines through points on logarithmic axes.

/// Fits a line by least squares on logarithmic axes and returns its slope: p of y = a xᵖ. `None` for fewer than two
/// different positive points.
pub(super) fn log_slope(points: &[(f64, f64)]) -> Option<f64> {
    let Sums { xx, xy, .. } = Sums::of(points);
    (xx > 0.0).then_some(xy / xx)
}

/// Returns Pearson's correlation of the logarithms, from −1 to 1; `None` if one coordinate does not vary.
pub(super) fn log_correlation(points: &[(f64, f64)]) -> Option<f64> {
    let Sums { xx, xy, yy } = Sums::of(points);
    (xx > 0.0 && yy > 0.0).then(|| xy / (xx * yy).sqrt())
}

/// Returns the x at which the broken line through the points has this y, on logarithmic axes. Each point must have a
/// greater x and a smaller y than the one before. `None` beyond the ends.
pub(super) fn log_crossing(points: &[(f64, f64)], y: f64) -> Option<f64> {
    let (a, b) = points.iter().zip(points.get(1..)?).find(|(a, b)| (b.1..=a.1).contains(&y))?;
    let part = if a.1 > b.1 { (a.1 / y).ln() / (a.1 / b.1).ln() } else { 0.0 };
    Some(a.0 * (b.0 / a.0).powf(part))
}

/// Sums of products of the logarithms' distances from their means, over points with positive coordinates.
struct Sums {
    xx: f64,
    xy: f64,
    yy: f64,
}

impl Sums {
    fn of(points: &[(f64, f64)]) -> Self {
        let seen = points.iter().filter(|(x, y)| *x > 0.0 && *y > 0.0);
        let points: Vec<(f64, f64)> = seen.map(|(x, y)| (x.ln(), y.ln())).collect();
        let count = points.len().max(1) as f64;
        let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / count, y + point.1 / count));
        let sum = |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|point| of(point.0 - x, point.1 - y)).sum();
        Self { xx: sum(&|x, _| x * x), xy: sum(&|x, y| x * y), yy: sum(&|_, y| y * y) }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn slope_is_the_exponent_of_a_power(a in 0.1..10.0_f64, p in -3.0..3.0_f64, from in 0.1..2.0_f64) {
            let points: Vec<(f64, f64)> = (0..5).map(|i| from * 2f64.powi(i)).map(|x| (x, a * x.powf(p))).collect();
            prop_assert!((log_slope(&points).unwrap() - p).abs() < 1e-9);
        }

        #[test]
        fn correlation_ignores_units_and_powers(
            points in prop::collection::vec((0.1..10.0_f64, 0.1..10.0_f64), 3..20), unit in 0.1..10.0_f64,
        ) {
            let scaled: Vec<(f64, f64)> = points.iter().map(|(x, y)| (unit * x.powi(3), y / unit)).collect();
            let (one, other) = (log_correlation(&points).unwrap(), log_correlation(&scaled).unwrap());
            prop_assert!((one - other).abs() < 1e-6 && one.abs() <= 1.0 + 1e-9);
        }

        #[test]
        fn crossing_is_on_the_line(a in 0.1..10.0_f64, p in -3.0..-0.1_f64, part in 0.0..1.0_f64) {
            let points: Vec<(f64, f64)> = (0..5).map(|i| 2f64.powi(i)).map(|x| (x, a * x.powf(p))).collect();
            let x = 16f64.powf(part);
            prop_assert!((log_crossing(&points, a * x.powf(p)).unwrap() / x - 1.0).abs() < 1e-6);
            prop_assert_eq!(log_crossing(&points, 1.1 * points[0].1), None);
            prop_assert_eq!(log_crossing(&points, 0.9 * points[4].1), None);
        }
    }

    #[test]
    fn known_correlations_are_found() {
        let line = |sign: f64| (1..9).map(|i| (f64::from(i), f64::from(i).powf(sign))).collect::<Vec<_>>();
        assert!((log_correlation(&line(2.0)).unwrap() - 1.0).abs() < 1e-12);
        assert!((log_correlation(&line(-0.1)).unwrap() + 1.0).abs() < 1e-12);
        assert!(log_correlation(&[(1.0, 2.0), (2.0, 1.0), (4.0, 2.0)]).unwrap().abs() < 1e-12);
    }

    #[test]
    fn constant_points_have_no_slope_and_no_correlation() {
        assert_eq!([log_slope(&[]), log_slope(&[(2.0, 3.0)]), log_slope(&[(2.0, 0.0), (3.0, 1.0)])], [None; 3]);
        assert_eq!(
            [log_correlation(&[]), log_correlation(&[(1.0, 2.0)]), log_correlation(&[(1.0, 2.0), (2.0, 2.0)])],
            [None; 3]
        );
    }
}
