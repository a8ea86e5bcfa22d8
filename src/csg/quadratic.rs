//! The quadratic inequality along a line.

/// The part of a line on which a quadratic is ≤ 0. Bounds are distances along the line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Intervals {
    /// No part of the line.
    Never,
    /// The whole line.
    Always,
    /// Between the first bound and the second.
    Between(f64, f64),
    /// Up to the first bound, and from the second on.
    Beyond(f64, f64),
}

impl Intervals {
    /// Solves a t² + 2 b t + c ≤ 0 for t.
    ///
    /// The roots come from the form that never subtracts nearly equal numbers (Kahan; Press et al., *Numerical
    /// Recipes*, §5.6): with q = −(b ± √(b² − ac)) they are q / a and c / q, which stay accurate as a goes to 0.
    #[inline(always)]
    pub fn solve(a: f64, b: f64, c: f64) -> Self {
        Self::with_discriminant(a, b, c, b * b - a * c)
    }

    /// Does the same for callers that know b² − ac more accurately.
    #[inline(always)]
    pub fn with_discriminant(a: f64, b: f64, c: f64, discriminant: f64) -> Self {
        if discriminant <= 0.0 || discriminant.is_nan() {
            // A line that only touches the surface has no span on the other side of it.
            return if a < 0.0 || (a == 0.0 && c <= 0.0) { Self::Always } else { Self::Never };
        }
        let root = discriminant.sqrt();
        let q = if b < 0.0 { root - b } else { -root - b };
        if a == 0.0 {
            // Linear: 2 b t + c ≤ 0.
            let t = c / q;
            return if b > 0.0 { Self::Between(f64::NEG_INFINITY, t) } else { Self::Between(t, f64::INFINITY) };
        }
        let (t, u) = (q / a, c / q);
        let (first, last) = if t < u { (t, u) } else { (u, t) };
        if a > 0.0 { Self::Between(first, last) } else { Self::Beyond(first, last) }
    }

    /// Solves a t² + 2 b t ≤ 0: the line starts on the surface, so that one root is exactly 0.
    #[inline(always)]
    pub fn from_surface(a: f64, b: f64) -> Self {
        let other = -2.0 * b / a;
        match a {
            0.0 if b == 0.0 => Self::Never,
            0.0 if b > 0.0 => Self::Between(f64::NEG_INFINITY, 0.0),
            0.0 => Self::Between(0.0, f64::INFINITY),
            _ if a > 0.0 => Self::Between(other.min(0.0), other.max(0.0)),
            _ => Self::Beyond(other.min(0.0), other.max(0.0)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn vanishing_square_term_keeps_linear_root() {
        assert_eq!(Intervals::solve(0.0, 1.0, -4.0), Intervals::Between(f64::NEG_INFINITY, 2.0));
        assert_eq!(Intervals::solve(0.0, -1.0, -4.0), Intervals::Between(-2.0, f64::INFINITY));
        let Intervals::Between(_, root) = Intervals::solve(1e-30, 1.0, -4.0) else { panic!() };
        assert_eq!(root, 2.0);
    }

    #[test]
    fn constant_is_whole_line_or_nothing() {
        assert_eq!(Intervals::solve(0.0, 0.0, -1.0), Intervals::Always);
        assert_eq!(Intervals::solve(0.0, 0.0, 1.0), Intervals::Never);
        assert_eq!(Intervals::solve(-1.0, 0.0, -1.0), Intervals::Always);
    }

    proptest! {
        #[test]
        fn intervals_match_sign_of_quadratic(
            a in -3.0..3.0f64, b in -3.0..3.0f64, c in -3.0..3.0f64, t in -5.0..5.0f64
        ) {
            let value = (a * t + 2.0 * b) * t + c;
            prop_assume!(value.abs() > 1e-9);
            let inside = match Intervals::solve(a, b, c) {
                Intervals::Never => false,
                Intervals::Always => true,
                Intervals::Between(first, last) => first <= t && t <= last,
                Intervals::Beyond(first, last) => t <= first || last <= t,
            };
            prop_assert_eq!(inside, value < 0.0);
        }

        #[test]
        fn from_surface_equals_solve_with_constant_0(a in -3.0..3.0f64, b in -3.0..3.0f64) {
            prop_assume!(a.abs() > 1e-6 && b.abs() > 1e-6);
            prop_assert_eq!(Intervals::from_surface(a, b), Intervals::solve(a, b, 0.0));
        }
    }
}
