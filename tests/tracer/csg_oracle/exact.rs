//! Exact crossings of a ray and a surface: parameters (p ± √q) / a of integers.
//!
//! Two parameters are equal if integers prove it. Two others must differ by more than the rounding, or the ray is left
//! out as undecided.

use std::cmp::Ordering;

/// Why a ray is left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GivenUp {
    /// It touches a surface without crossing it, or runs in it: rounding decides about a hit.
    Touches,
    /// Two parameters differ by less than the rounding.
    TooNear,
}

/// `(p + sign √q) / a` with q ≥ 0 and a > 0; the sign is 0 if q is 0.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    p: i128,
    sign: i128,
    q: i128,
    a: i128,
    /// The rounded value.
    pub near: f64,
    /// Upper bound of the rounding error, with a wide margin.
    pub blur: f64,
}

impl Place {
    /// Before all others.
    pub const FIRST: Self = Self { p: 0, sign: 0, q: 0, a: 0, near: f64::NEG_INFINITY, blur: 0.0 };
    /// After all others.
    pub const LAST: Self = Self { p: 0, sign: 0, q: 0, a: 0, near: f64::INFINITY, blur: 0.0 };

    fn new(p: i128, sign: i128, q: i128, a: i128, blur: f64) -> Self {
        let (p, sign, a) = if a < 0 { (-p, -sign, -a) } else { (p, sign, a) };
        let (far, root) = (p as f64, sign as f64 * (q as f64).sqrt());
        // Avoids the difference of rounded numbers that nearly cancel.
        let near = if far * root < 0.0 { (p * p - q) as f64 / (far - root) } else { far + root } / a as f64;
        Self { p, sign, q, a, near, blur }
    }

    /// Compares two parameters; they are equal only if integers prove it.
    pub fn order(&self, other: &Self) -> Result<Ordering, GivenUp> {
        let apart = self.near.is_infinite()
            || other.near.is_infinite()
            || (self.near - other.near).abs() > self.blur + other.blur;
        match apart {
            true => Ok(self.near.total_cmp(&other.near)),
            false if self.equals(other) == Some(true) => Ok(Ordering::Equal),
            false => Err(GivenUp::TooNear),
        }
    }

    /// Whether A + s √B = z √C, where A = p a' − p' a, B = a'² q, C = a² q'; `None` on overflow.
    fn equals(&self, other: &Self) -> Option<bool> {
        if (self.p, self.sign, self.q, self.a) == (other.p, other.sign, other.q, other.a) {
            return Some(true);
        }
        let times = i128::checked_mul;
        let a = times(self.p, other.a)? - times(other.p, self.a)?;
        if self.q == 0 && other.q == 0 {
            return Some(a == 0);
        }
        let b = times(times(other.a, other.a)?, self.q)?;
        let c = times(times(self.a, self.a)?, other.q)?;
        // Squared: 2 A s √B = C − A² − B, and squared once more.
        let squared = times(a, a)?;
        let rest = c.checked_sub(squared)?.checked_sub(b)?;
        let signs = if b == 0 { 0 } else { a.signum() * self.sign };
        let is_root = times(rest, rest)? == times(times(4, squared)?, b)? && rest.signum() == signs;
        // The sign of A + s √B.
        let sum = match signs {
            -1 => a.signum() * (squared - b).signum(),
            _ if a == 0 => self.sign,
            _ => a.signum(),
        };
        Some(is_root && sum == other.sign)
    }
}

/// The spans of a ray inside a leaf, in order.
pub type Spans = Vec<[Place; 2]>;

/// The spans with `a t² + 2 b t + c ≤ 0`; `blur` bounds the rounding error of this value.
pub fn below_zero(a: i128, b: i128, c: i128, blur: f64) -> Result<Spans, GivenUp> {
    let always = vec![[Place::FIRST, Place::LAST]];
    if a == 0 {
        let root = Place::new(-c, 0, 0, 2 * b, blur / (2 * b).unsigned_abs() as f64);
        return match b.signum() {
            1 => Ok(vec![[Place::FIRST, root]]),
            -1 => Ok(vec![[root, Place::LAST]]),
            _ if c == 0 => Err(GivenUp::Touches),
            _ => Ok(if c < 0 { always } else { Vec::new() }),
        };
    }
    let q = b * b - a * c;
    if q == 0 {
        return Err(GivenUp::Touches);
    }
    if q < 0 {
        return Ok(if a < 0 { always } else { Vec::new() });
    }
    let root = |sign: i128| Place::new(-b, sign, q, a, blur / (4.0 * q as f64).sqrt());
    let (less, more) = (root(-a.signum()), root(a.signum()));
    Ok(if a > 0 { vec![[less, more]] } else { vec![[Place::FIRST, less], [more, Place::LAST]] })
}

/// Intersects the spans with `within`. A span of length 0, on an edge, is kept, since faces meet there.
pub fn clipped(spans: &Spans, within: &[Place; 2]) -> Result<Spans, GivenUp> {
    let mut clipped = Vec::new();
    for [from, to] in spans {
        let from = if from.order(&within[0])? == Ordering::Less { within[0] } else { *from };
        let to = if to.order(&within[1])? == Ordering::Greater { within[1] } else { *to };
        if from.order(&to)? != Ordering::Greater {
            clipped.push([from, to]);
        }
    }
    Ok(clipped)
}

#[test]
fn equality_of_parameters_is_exact() {
    let place = |p, sign, q, a| Place::new(p, sign, q, a, 0.0);
    let is_equal = |one: Place, other: Place| {
        assert_eq!(one.equals(&other), other.equals(&one));
        one.equals(&other).expect("small numbers")
    };
    // (1 + √8) / 2 = (2 + √32) / 4, and (1 + √9) / 2 = 2.
    assert!(is_equal(place(1, 1, 8, 2), place(2, 1, 32, 4)));
    assert!(is_equal(place(1, 1, 8, 2), place(-2, -1, 32, -4)));
    assert!(is_equal(place(1, 1, 9, 2), place(2, 0, 0, 1)));
    assert!(is_equal(place(1, -1, 9, 2), place(-1, 0, 0, 1)));
    assert!(!is_equal(place(1, 1, 8, 2), place(2, -1, 32, 4)));
    assert!(!is_equal(place(1, 1, 8, 2), place(2, 1, 33, 4)));
    assert!(!is_equal(place(1, 1, 9, 2), place(-1, 0, 0, 1)));
    assert!(!is_equal(place(1, 1, 8, 2), place(1, -1, 8, 2)));
}
