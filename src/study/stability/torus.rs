//! Tori, whose crossings are the roots of a quartic.

use std::f64::consts::TAU;

use fastrand::Rng;
use glam::{DAffine3, DVec3};

use super::super::exact::{Exact, dot, vector};
use super::super::random::{perpendicular, uniform, unit_vector};
use super::placed_primitive::PlacedPrimitive;
use super::{MethodResult, ResultCounter, StabilityCase, powers_of_10};
use crate::csg::Primitive;
use crate::geometry::Ray;
use crate::view::Scale;

pub(super) fn cases() -> [StabilityCase; 2] {
    let torus = |name, title, about, parameter, values, required, attempt| StabilityCase {
        name,
        title,
        about,
        parameter,
        values,
        required,
        scale: Scale::Log10,
        methods: &["closed form", "ours"],
        measured_figure: None,
        tries: 5000,
        attempt,
    };
    [
        torus(
            "far-torus",
            "A far torus",
            "Rays towards a torus (radius 1, tube 0.25): how often do they cross it? The closed form of the quartic \
             (Ferrari, Cardano) uses the coefficients unchanged, and those grow with the fourth power of the \
             distance. Ours starts from the line's closest point, and finds the roots between those of the \
             derivatives (Yuksel 2022). Truth: the changes of sign in Sturm's chain, without rounding.",
            "distance, radii",
            powers_of_10(0, 10),
            1e8,
            far as fn(f64, u32, &mut Rng) -> Vec<MethodResult>,
        ),
        torus(
            "thin-torus",
            "A thin torus",
            "Rays from a distance of 10 towards a torus of radius 1 with a thin tube, which pass the middle of the \
             tube within two of its radii; otherwise as for the far torus. There the quartic is a difference of \
             nearly equal numbers; ours takes its sign from the factor that changes sign.",
            "radius of the tube",
            powers_of_10(-1, -9),
            1e-6,
            thin,
        ),
    ]
}

fn far(distance: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    count(tries, rng, |rng| {
        let (outward, target) = (unit_vector(rng), unit_vector(rng) * uniform(rng, 0.0, 1.5));
        // All of the torus lies in front of the origin.
        (0.25, target + outward * (3.0 + distance), target)
    })
}

fn thin(tube: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    count(tries, rng, |rng| {
        let (sine, cosine) = uniform(rng, 0.0, TAU).sin_cos();
        let outward = unit_vector(rng);
        let target = DVec3::new(cosine, 0.0, sine) + perpendicular(rng, outward) * uniform(rng, 0.0, 2.0 * tube);
        (tube, target + outward * 10.0, target)
    })
}

/// Tries lines; `line` returns the tube's radius, the origin and the target.
fn count(tries: u32, rng: &mut Rng, line: impl Fn(&mut Rng) -> (f64, DVec3, DVec3)) -> Vec<MethodResult> {
    let mut count = ResultCounter::<2>::new();
    for _ in 0..tries {
        let (tube, origin, target) = line(rng);
        let torus = PlacedPrimitive::new(Primitive::Torus { tube }, DAffine3::IDENTITY);
        let ray = Ray::new(origin, (target - origin).normalize());
        let truth = distinct_roots(&quartic(tube, &ray));
        count.add([closed_form(tube, &ray) != truth, torus.ours(&ray).len() != truth]);
    }
    count.results()
}

/// Returns the torus's quartic along a ray, the highest power first: (|p|² + 1 − tube²)² − 4 (x² + z²).
pub(in crate::study) fn quartic(tube: f64, ray: &Ray) -> Vec<Exact> {
    let (o, d, tube) = (vector(ray.origin), vector(ray.direction), Exact::from(tube));
    let (two, four) = (Exact::from(2.0), Exact::from(4.0));
    let round = |p: &[Exact; 3], q: &[Exact; 3]| (&p[0] * &q[0] + &p[2] * &q[2]) * &four;
    let (a, b) = (dot(&d, &d), dot(&o, &d) * &two);
    let c = dot(&o, &o) + Exact::from(1.0) - &tube * &tube;
    vec![
        &a * &a,
        &a * &b * &two,
        &b * &b + &a * &c * &two - round(&d, &d),
        &b * &c * &two - round(&o, &d) * &two,
        &c * &c - round(&o, &o),
    ]
}

/// Counts the distinct real roots of a polynomial (Sturm 1829).
pub(in crate::study) fn distinct_roots(polynomial: &[Exact]) -> usize {
    let degree = polynomial.len() - 1;
    let exponents = (1..=degree).rev().map(|power| Exact::from(power as f64));
    let derivative: Vec<Exact> =
        polynomial.iter().zip(exponents).map(|(coefficient, power)| coefficient * power).collect();
    let mut chain = vec![polynomial.to_vec(), derivative];
    while let [.., a, b] = &chain[..]
        && let Some(next) = negative_remainder(a, b)
    {
        chain.push(next);
    }
    // At −∞ odd powers have the opposite sign.
    let changes = |odd: bool| {
        let random_sign =
            |polynomial: &Vec<Exact>| polynomial[0].is_positive() != (odd && polynomial.len().is_multiple_of(2));
        chain.windows(2).filter(|two| random_sign(&two[0]) != random_sign(&two[1])).count()
    };
    changes(true) - changes(false)
}

/// Returns a positive multiple of −(a mod b) without leading zeros; `None` if it is 0.
fn negative_remainder(a: &[Exact], b: &[Exact]) -> Option<Vec<Exact>> {
    let mut rest = a.to_vec();
    while rest.len() >= b.len() {
        let (first, divisor) = (rest[0].clone(), &b[0]);
        // Times the divisor's square, which is positive, so that nothing has to be divided.
        for (place, coefficient) in rest.iter_mut().enumerate() {
            let scaled = &*coefficient * divisor * divisor;
            *coefficient = b.get(place).map_or(scaled.clone(), |other| scaled - other * &first * divisor);
        }
        rest.remove(0);
    }
    let zeros = rest.iter().take_while(|coefficient| coefficient.sign().is_eq()).count();
    rest.drain(..zeros);
    let negative: Vec<Exact> = rest.iter().map(|coefficient| Exact::from(0.0) - coefficient).collect();
    (!negative.is_empty()).then_some(negative)
}

/// Counts the real roots that Ferrari's closed form finds, as in textbooks.
pub(in crate::study) fn closed_form(tube: f64, ray: &Ray) -> usize {
    let (o, d) = (ray.origin, ray.direction);
    let round = |p: DVec3, q: DVec3| 4.0 * (p.x * q.x + p.z * q.z);
    let (half, k) = (o.dot(d), o.dot(o) + 1.0 - tube * tube);
    // d has length 1: t⁴ + a t³ + b t² + c t + e.
    let (a, b) = (4.0 * half, 4.0 * half * half + 2.0 * k - round(d, d));
    let (c, e) = (4.0 * half * k - 2.0 * round(o, d), k * k - round(o, o));
    // Without the cube: y⁴ + p y² + q y + r.
    let p = b - 3.0 * a * a / 8.0;
    let q = c - a * b / 2.0 + a * a * a / 8.0;
    let r = e - a * c / 4.0 + a * a * b / 16.0 - 3.0 * a.powi(4) / 256.0;
    let z = root_of_cubic(-p / 2.0, -r, r * p / 2.0 - q * q / 8.0);
    let (u, v) = (z * z - r, 2.0 * z - p);
    if u < 0.0 || v < 0.0 {
        return 0;
    }
    let (u, v) = (u.sqrt(), v.sqrt().copysign(q));
    let roots = |linear: f64, constant: f64| if linear * linear - 4.0 * constant > 0.0 { 2 } else { 0 };
    roots(v, z - u) + roots(-v, z + u)
}

/// Returns a real root of x³ + a x² + b x + c (Cardano).
fn root_of_cubic(a: f64, b: f64, c: f64) -> f64 {
    let (p, q) = (b / 3.0 - a * a / 9.0, a * a * a / 27.0 - a * b / 6.0 + c / 2.0);
    let discriminant = q * q + p * p * p;
    let y = if discriminant < 0.0 {
        2.0 * (-p).sqrt() * ((-q / (-p * p * p).sqrt()).acos() / 3.0).cos()
    } else {
        let root = discriminant.sqrt();
        (root - q).cbrt() - (root + q).cbrt()
    };
    y - a / 3.0
}

#[cfg(test)]
mod tests {
    use super::super::check;
    use super::*;

    #[test]
    fn torus_crossings_match_the_number_of_roots() {
        cases().iter().for_each(|case| check(case, 300));
    }

    #[test]
    fn distinct_roots_of_quartics_are_counted() {
        let roots = |coefficients: [f64; 5]| distinct_roots(&coefficients.map(Exact::from));
        // (t² − 1)(t² − 4), (t² + 1)(t² − 4), (t² + 1)², (t − 1)²(t + 2)², t⁴
        assert_eq!(roots([1.0, 0.0, -5.0, 0.0, 4.0]), 4);
        assert_eq!(roots([1.0, 0.0, -3.0, 0.0, -4.0]), 2);
        assert_eq!(roots([1.0, 0.0, 2.0, 0.0, 1.0]), 0);
        assert_eq!(roots([1.0, 2.0, -3.0, -4.0, 4.0]), 2);
        assert_eq!(roots([1.0, 0.0, 0.0, 0.0, 0.0]), 1);
        assert_eq!(roots([1.0, -240.0, 25_449.0, -1_325_880.0, 26_471_900.25]), 2);
    }

    /// Where the roots are well separated, both methods agree with the truth.
    #[test]
    fn closed_form_is_right_close_to_the_torus() {
        let rng = &mut Rng::with_seed(3);
        let wrong = count(1000, rng, |rng| (0.5, unit_vector(rng) * 2.0, unit_vector(rng) * 0.5))[0].wrong;
        assert!(wrong < 20, "{wrong}");
    }
}
