//! The spans of a line in a torus.
//!
//! The torus lies about the y axis; its ring has radius 1, its tube a radius below 1. The point q(τ) of a line is
//! inside where
//!
//! F = (|q|² + 1 − tube²)² − 4 (x² + z²) ≤ 0,
//!
//! a quartic in τ. Closed forms lose its roots when the origin is far away. Here τ is measured from the line's closest
//! approach to the centre, so that all coefficients are small. A root of the quartic lies between two roots of its
//! derivative, and those lie between the roots of the second derivative: each interval holds one root or none, and
//! Newton's method, kept inside the interval, finds it (C. Yuksel, *High-Performance Polynomial Root Finding for
//! Graphics*, 2022).

use std::ops::Range;

use glam::DVec3;

use super::span::{CURVED, Span, Spans};
use crate::geometry::{fast_max, fast_min};

/// Computes the spans of the line `o + d t` in the torus. If it starts `on_surface`, one root is exactly 0, whatever
/// rounding did to `o`.
pub(super) fn spans(tube: f64, o: DVec3, d: DVec3, on_surface: bool) -> Spans {
    let length = d.length();
    let direction = d / length;
    if on_surface {
        return from_surface(tube, o, direction).spans(0.0, length);
    }
    let shift = -o.dot(direction);
    // From afar, a rounded d · shift would lose the digits that o + d · shift is left with.
    let product = direction * shift;
    let closest = (o + product) + product_error(direction, shift, product);
    from_closest_approach(tube, closest, direction).spans(shift, length)
}

/// The implicit function of the torus: below 0 inside, above 0 outside. It is a factor of F with F's sign, and accurate
/// where F, for a thin tube, is a difference of nearly equal numbers.
pub(super) fn implicit(tube: f64, q: DVec3) -> f64 {
    let from_ring = axis_distance(q) - 1.0;
    from_ring * from_ring + q.y * q.y - tube * tube
}

/// Computes the distance of a point from the y axis.
pub(super) fn axis_distance(q: DVec3) -> f64 {
    (q.x * q.x + q.z * q.z).sqrt()
}

/// The rounding error of `product` = `v` `factor` (Dekker, *A floating-point technique for extending the available
/// precision*, 1971). Not a fused multiplication, which is a slow call where the processor may have none.
fn product_error(v: DVec3, factor: f64, product: DVec3) -> DVec3 {
    const SPLITTER: f64 = 134_217_729.0; // 2²⁷ + 1
    let scaled = v * SPLITTER;
    let v_high = scaled - (scaled - v);
    let v_low = v - v_high;
    let scaled = factor * SPLITTER;
    let high = scaled - (scaled - factor);
    let low = factor - high;
    ((v_high * high - product) + v_high * low + v_low * high) + v_low * low
}

/// Roots along a line, in order. Those of the quartic are even in number.
#[derive(Default)]
struct Roots {
    values: [f64; 4],
    count: usize,
}

impl Roots {
    fn add(&mut self, place: f64) {
        if let Some(free) = self.values.get_mut(self.count) {
            *free = place;
            self.count += 1;
        }
    }

    /// Turns roots into spans, with t = (τ + `shift`) / `length`.
    fn spans(&self, shift: f64, length: f64) -> Spans {
        let span = |first: usize| {
            let [from, to] = [first, first + 1].map(|index| (shift + self.values[index]) / length);
            let is_span = first + 1 < self.count && from < to;
            is_span.then_some(Span { from, from_face: CURVED, to, to_face: CURVED })
        };
        Spans { first: span(0), second: span(2) }
    }
}

/// The roots along the line `p + u τ`, `u` of length 1, whose closest approach to the centre is near τ = 0.
fn from_closest_approach(tube: f64, p: DVec3, u: DVec3) -> Roots {
    let mut roots = Roots::default();
    let Some(range) = bounding_range(tube, p, u) else { return roots };
    // The distance from the axis is greatest at an end: a line that is in the hole at both stays there.
    let hole = (1.0 - tube) * (1.0 - 1e-9);
    if [range.start, range.end].into_iter().all(|end| axis_distance(p + u * end) < hole) {
        return roots;
    }
    // F = τ⁴ + 4 along τ³ + square τ² + …; `along` is 0 up to rounding.
    let along = p.dot(u);
    let k = p.length_squared() + 1.0 - tube * tube;
    let square = 4.0 * along * along + 2.0 * k - 4.0 * (u.x * u.x + u.z * u.z);
    let linear = 4.0 * along * k - 8.0 * (p.x * u.x + p.z * u.z);
    let slope = Cubic([3.0 * along, square / 2.0, linear / 4.0]);
    let extrema = slope.roots(&range, false);
    let value = |place: f64| {
        let q = p + u * place;
        let ring = axis_distance(q);
        let (height, outward) = (implicit(tube, q), q.x * u.x + q.z * u.z);
        // The slope is 2 ((ring − 1) outward / ring + q.y u.y).
        (height, height * ring / (2.0 * ((ring - 1.0) * outward + ring * q.y * u.y)))
    };
    // The ends are outside, whatever rounding says.
    let ends = [range.start, range.end].map(|end| fast_max(value(end).0, f64::MIN_POSITIVE));
    for_each_root(&range, &extrema.values[..extrema.count], ends, value, |place| roots.add(place));
    roots
}

/// The roots along the line `o + u τ`, `u` of length 1, where `o` is on the torus: 0, and those of the cubic F / τ.
fn from_surface(tube: f64, o: DVec3, u: DVec3) -> Roots {
    let mut roots = Roots::default();
    // The range contains the start, whatever rounding says.
    let range = bounding_range(tube, o, u).map_or(0.0..0.0, |range| range.start.min(0.0)..range.end.max(0.0));
    let (along, ring) = (o.dot(u), axis_distance(o));
    // On the torus |o|² + 1 − tube² is twice the distance from the axis.
    let outward = (o.x * u.x + o.z * u.z) / ring;
    let cubic = Cubic([
        4.0 * along,
        4.0 * (along * along + ring - u.x * u.x - u.z * u.z),
        8.0 * ring * ((ring - 1.0) * outward + o.y * u.y),
    ]);
    let others = cubic.roots(&range, true);
    let mut values = [others.values[0], others.values[1], others.values[2], 0.0];
    let count = others.count + 1;
    values[others.count] = 0.0;
    values[..count].sort_unstable_by(f64::total_cmp);
    // An odd number with 0 is even: the cubic changes its sign once or three times.
    values[..count & !1].iter().for_each(|&place| roots.add(place));
    roots
}

/// A range of the line `p + u τ` that contains its part in the torus: the torus lies in a ball and between two planes.
fn bounding_range(tube: f64, p: DVec3, u: DVec3) -> Option<Range<f64>> {
    /// Keeps rounding from cutting off a part of the torus.
    const MARGIN: f64 = 1.0 + 1e-9;
    let along = p.dot(u);
    let reach = (1.0 + tube) * MARGIN;
    let half = (reach * reach - (p - u * along).length_squared()).max(-1.0);
    if half <= 0.0 {
        return None;
    }
    let (mut from, mut to) = (-along - half.sqrt(), half.sqrt() - along);
    let high = tube * MARGIN;
    if u.y == 0.0 {
        return (p.y.abs() < high).then_some(from..to);
    }
    let [a, b] = [(-high - p.y) / u.y, (high - p.y) / u.y];
    (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
    (from < to).then_some(from..to)
}

/// τ³ + `0[0]` τ² + `0[1]` τ + `0[2]`.
struct Cubic([f64; 3]);

impl Cubic {
    /// The roots in `range`. With `beyond` the ends of the range count as beyond all roots, whatever rounding says of
    /// them, so that the number of roots is odd.
    fn roots(&self, range: &Range<f64>, beyond: bool) -> Roots {
        let Self([b, c, e]) = *self;
        let value = |place: f64| {
            let height = ((place + b) * place + c) * place + e;
            (height, height / ((3.0 * place + 2.0 * b) * place + c))
        };
        let ends = if beyond { [-1.0, 1.0] } else { [range.start, range.end].map(|end| value(end).0) };
        // Solves 3 τ² + 2 b τ + c = 0 without subtracting nearly equal numbers.
        let discriminant = b * b - 3.0 * c;
        let mut roots = Roots::default();
        let mut add = |extrema: &[f64]| for_each_root(range, extrema, ends, value, |place| roots.add(place));
        if discriminant > 0.0 {
            let q = -b - discriminant.sqrt().copysign(b);
            let (one, other) = (q / 3.0, c / q);
            add(&[one.min(other), one.max(other)]);
        } else {
            add(&[]);
        }
        roots
    }
}

/// Visits the roots with a change of sign in `range`, in order. Between two neighbouring `extrema` there is at most
/// one. `ends` gives the function's values at the ends of the range, or others of the same sign; `value` returns the
/// function, and the function over its derivative: Newton's step.
fn for_each_root(
    range: &Range<f64>,
    extrema: &[f64],
    ends: [f64; 2],
    value: impl Fn(f64) -> (f64, f64),
    mut each: impl FnMut(f64),
) {
    let mut from = (range.start, ends[0]);
    let inside = extrema.iter().copied().filter(|extremum| range.start < *extremum && *extremum < range.end);
    for (place, given) in inside.map(|extremum| (extremum, None)).chain([(range.end, Some(ends[1]))]) {
        let to = (place, given.unwrap_or_else(|| value(place).0));
        if to.1 == 0.0 {
            // A function that only touches 0 keeps its sign.
            continue;
        }
        if (to.1 < 0.0) != (from.1 < 0.0) {
            each(root_between(from, to, &value));
        }
        from = to;
    }
}

/// Finds the root between two places, given with the function's values, where it changes its sign once.
fn root_between(
    (start, height_at_start): (f64, f64),
    (end, height_at_end): (f64, f64),
    value: &impl Fn(f64) -> (f64, f64),
) -> f64 {
    /// Newton's method needs a few steps; bisection needs as many as there are bits.
    const MAX_STEPS: usize = 64;
    /// A step of at most this part of the distance to the nearest extremum is the last: the next one would be of this
    /// part of the step.
    const LAST_STEP: f64 = 1e-8;
    let (mut from, mut to, rises) = (start, end, height_at_start < 0.0);
    // As on a parabola whose apex is at the end with the lower value.
    let (low, high) = (height_at_start.abs(), height_at_end.abs());
    let mut place = if low < high {
        start + (end - start) * (low / (low + high)).sqrt()
    } else {
        end - (end - start) * (high / (low + high)).sqrt()
    };
    if !(start < place && place < end) {
        place = start.midpoint(end);
    }
    for _ in 0..MAX_STEPS {
        let (height, step) = value(place);
        if height == 0.0 {
            return place;
        }
        if (height < 0.0) == rises {
            from = place;
        } else {
            to = place;
        }
        let newton = place - step;
        let is_inside = from < newton && newton < to;
        if is_inside && (newton - place).abs() <= LAST_STEP * fast_min(newton - start, end - newton) {
            return newton;
        }
        let next = if is_inside { newton } else { from.midpoint(to) };
        if next == place || next <= from || to <= next {
            return next;
        }
        place = next;
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vectors(range: Range<f64>) -> impl Strategy<Value = DVec3> {
        (range.clone(), range.clone(), range).prop_map(DVec3::from)
    }

    fn ends(spans: Spans) -> Vec<f64> {
        [spans.first, spans.second].into_iter().flatten().flat_map(|span| [span.from, span.to]).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]

        #[test]
        fn spans_match_implicit_function(
            tube in 0.001..0.999f64, aim in vectors(-1.5..1.5), from in vectors(-1.0..1.0), away in 0.0..6.0f64,
            values in prop::collection::vec(-3.0..3.0f64, 20),
        ) {
            prop_assume!(from.length() > 0.1);
            // Not of length 1.
            let d = from * 0.7;
            let o = aim - d * 10f64.powf(away);
            let ends = ends(spans(tube, o, d, false));
            prop_assert!(ends.is_sorted());
            let rounding = 1e-15 * o.length() / d.length();
            for place in values {
                let t = (aim - o).dot(d) / d.length_squared() + place;
                if ends.iter().any(|end| (t - end).abs() < 1e-6 + 100.0 * rounding) {
                    continue;
                }
                let (q, is_inside) = (o + d * t, ends.iter().filter(|&&end| end < t).count() % 2 == 1);
                let depth = implicit(tube, q);
                if depth.abs() > 1e-6 + 100.0 * rounding {
                    prop_assert_eq!(is_inside, depth < 0.0, "at {} of {:?}", t, ends);
                }
            }
            for end in ends {
                let off = implicit(tube, o + d * end).abs();
                prop_assert!(off < 1e-13 + 100.0 * rounding, "{off:e} off the surface");
            }
        }

        /// A secondary ray that starts where a ray has hit the torus crosses it at that ray's other roots.
        #[test]
        fn ray_from_surface_finds_other_roots(
            tube in 0.01..0.99f64, aim in vectors(-1.2..1.2), from in vectors(-1.0..1.0),
        ) {
            prop_assume!(from.length() > 0.1);
            let d = from.normalize();
            let o = aim - d * 5.0;
            let ends_from_afar = ends(spans(tube, o, d, false));
            for &start in &ends_from_afar {
                let ends = ends(spans(tube, o + d * start, d, true));
                prop_assert!(ends.contains(&0.0), "{ends:?}");
                prop_assert_eq!(ends.len(), ends_from_afar.len());
                for (end, from_afar) in ends.iter().zip(&ends_from_afar) {
                    // Where a line grazes, two roots lie close and each is uncertain.
                    prop_assert!((end - (from_afar - start)).abs() < 1e-6, "{ends:?} and {ends_from_afar:?}");
                }
            }
        }
    }

    #[test]
    fn lines_along_planes_and_axes_of_symmetry_have_exact_roots() {
        let close = |o: DVec3, d: DVec3, expected: &[f64]| {
            let ends = ends(spans(0.25, o, d, false));
            assert_eq!(ends.len(), expected.len(), "{ends:?}");
            assert!(ends.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14), "{ends:?}");
        };
        close(DVec3::new(-3.0, 0.0, 0.0), DVec3::X, &[1.75, 2.25, 3.75, 4.25]);
        close(DVec3::new(1.0, -3.0, 0.0), DVec3::Y, &[2.75, 3.25]);
        close(DVec3::new(0.0, -3.0, 0.0), DVec3::Y, &[]);
        close(DVec3::new(-3.0, 0.25, 0.0), DVec3::X, &[]);
        // In the plane of symmetry, tangent to the inner circle: through the tube once.
        close(DVec3::new(-3.0, 0.0, 0.75), DVec3::X, &[2.0, 4.0]);
    }

    #[test]
    fn quartic_hard_for_closed_forms_has_two_roots() {
        // u⁴ − 240 u³ + 25449 u² − 1325880 u + 26471900.25, by Horner's rule.
        let value = |u: f64| {
            let height = (((u - 240.0) * u + 25_449.0) * u - 1_325_880.0) * u + 26_471_900.25;
            (height, height / (((4.0 * u - 720.0) * u + 50_898.0) * u - 1_325_880.0))
        };
        let range = 0.0..200.0;
        let extrema = Cubic([-180.0, 50_898.0 / 4.0, -331_470.0]).roots(&range, false);
        let mut roots = Vec::new();
        for_each_root(&range, &extrema.values[..extrema.count], [1.0, 1.0], value, |root| roots.push(root));
        assert_eq!(roots.len(), 2, "{roots:?}");
        // Of (u² − 120 u)² + 11049 (u² − 120 u) + 26471900.25, with u = 60 ± √(3600 + v).
        assert!((roots[0] + roots[1] - 120.0).abs() < 1e-9, "{roots:?}");
    }
}
