//! Straight lines through points.

/// The slope of the straight line of least squares through points on logarithmic axes: p of y = a xᵖ. `None` where fewer
/// than two different points are on such axes.
pub(super) fn log_slope(points: &[(f64, f64)]) -> Option<f64> {
    let seen = points.iter().filter(|(x, y)| *x > 0.0 && *y > 0.0);
    let Sums { xx, xy, .. } = Sums::of(&seen.map(|(x, y)| (x.ln(), y.ln())).collect::<Vec<_>>());
    (xx > 0.0).then_some(xy / xx)
}

/// Pearson's coefficient of correlation, from −1 to 1; `None` where one of both does not vary.
pub(super) fn correlation(points: &[(f64, f64)]) -> Option<f64> {
    let Sums { xx, xy, yy } = Sums::of(points);
    (xx > 0.0 && yy > 0.0).then(|| xy / (xx * yy).sqrt())
}

/// Sums of products of distances from the means.
struct Sums {
    xx: f64,
    xy: f64,
    yy: f64,
}

impl Sums {
    fn of(points: &[(f64, f64)]) -> Self {
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
        fn a_power_is_found(a in 0.1..10.0_f64, p in -3.0..3.0_f64, from in 0.1..2.0_f64) {
            let points: Vec<(f64, f64)> = (0..5).map(|i| from * 2f64.powi(i)).map(|x| (x, a * x.powf(p))).collect();
            prop_assert!((log_slope(&points).unwrap() - p).abs() < 1e-9);
        }

        #[test]
        fn units_do_not_matter(points in prop::collection::vec((0.1..10.0_f64, 0.1..10.0_f64), 3..20), unit in 0.1..10.0_f64) {
            let scaled: Vec<(f64, f64)> = points.iter().map(|(x, y)| (unit * x + 1.0, y / unit)).collect();
            let (one, other) = (correlation(&points).unwrap(), correlation(&scaled).unwrap());
            prop_assert!((one - other).abs() < 1e-6 && one.abs() <= 1.0 + 1e-9);
        }
    }

    #[test]
    fn some_correlations_are_known() {
        let line = |sign: f64| (0..9).map(|i| (f64::from(i), sign * f64::from(i))).collect::<Vec<_>>();
        assert!((correlation(&line(2.0)).unwrap() - 1.0).abs() < 1e-12);
        assert!((correlation(&line(-0.1)).unwrap() + 1.0).abs() < 1e-12);
        assert!(correlation(&[(-1.0, 1.0), (0.0, -2.0), (1.0, 1.0)]).unwrap().abs() < 1e-12);
    }

    #[test]
    fn where_nothing_varies_there_is_no_line() {
        assert_eq!([log_slope(&[]), log_slope(&[(2.0, 3.0)]), log_slope(&[(2.0, 0.0), (3.0, 1.0)])], [None; 3]);
        assert_eq!([correlation(&[]), correlation(&[(1.0, 2.0)]), correlation(&[(1.0, 2.0), (2.0, 2.0)])], [None; 3]);
    }
}
