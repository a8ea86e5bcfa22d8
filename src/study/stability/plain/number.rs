//! Numbers that the plain tracer can compute with: f64, and sums of two f64 with some 31 digits.

use std::cmp::Ordering;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number of some precision.
pub trait Number:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The number equal to an f64.
    fn from_f64(number: f64) -> Self;

    /// The nearest f64.
    fn to_f64(self) -> f64;

    /// The square root; 0 for a negative number.
    fn sqrt(self) -> Self;

    /// The absolute value.
    fn abs(self) -> Self {
        if self < Self::from_f64(0.0) { -self } else { self }
    }
}

impl Number for f64 {
    fn from_f64(number: f64) -> Self {
        number
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn sqrt(self) -> Self {
        f64::sqrt(self.max(0.0))
    }
}

/// The sum of two f64, of which the second is at most half a unit in the last place of the first (T. J. Dekker, *A
/// Floating-Point Technique for Extending the Available Precision*, 1971).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wide(f64, f64);

/// Returns the sum and its rounding error (Knuth, *The Art of Computer Programming*, vol. 2, §4.2.2).
fn exact_sum(a: f64, b: f64) -> Wide {
    let sum = a + b;
    let of_b = sum - a;
    Wide(sum, (a - (sum - of_b)) + (b - of_b))
}

/// Returns the product and its rounding error.
fn exact_product(a: f64, b: f64) -> Wide {
    let product = a * b;
    Wide(product, a.mul_add(b, -product))
}

impl Add for Wide {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, low) = (exact_sum(self.0, other.0), exact_sum(self.1, other.1));
        let first = exact_sum(high.0, high.1 + low.0);
        exact_sum(first.0, first.1 + low.1)
    }
}

impl Neg for Wide {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Sub for Wide {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Wide {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let high = exact_product(self.0, other.0);
        exact_sum(high.0, high.1 + (self.0 * other.1 + self.1 * other.0))
    }
}

impl Div for Wide {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        // Long division: each digit is an f64.
        let first = self.0 / other.0;
        let rest = self - other * Self(first, 0.0);
        let second = rest.0 / other.0;
        let rest = rest - other * Self(second, 0.0);
        exact_sum(first, second) + Self(rest.0 / other.0, 0.0)
    }
}

impl PartialOrd for Wide {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.0.partial_cmp(&other.0) {
            Some(Ordering::Equal) => self.1.partial_cmp(&other.1),
            order => order,
        }
    }
}

impl Number for Wide {
    fn from_f64(number: f64) -> Self {
        Self(number, 0.0)
    }

    fn to_f64(self) -> f64 {
        self.0 + self.1
    }

    fn sqrt(self) -> Self {
        if self.0 <= 0.0 {
            return Self(0.0, 0.0);
        }
        // Two steps of Newton's from an f64 double its digits twice over.
        let half = Self(0.5, 0.0);
        let mut root = Self(self.0.sqrt(), 0.0);
        for _ in 0..2 {
            root = (root + self / root) * half;
        }
        root
    }
}

#[test]
fn wide_numbers_have_30_digits() {
    let wide = |number| Wide::from_f64(number);
    let third = wide(1.0) / wide(3.0);
    assert!((third + third + third - wide(1.0)).abs() < wide(1e-30));
    let root = wide(2.0).sqrt();
    assert!((root * root - wide(2.0)).abs() < wide(1e-30));
    assert_eq!((wide(1.0) + wide(1e-20) - wide(1.0)).to_f64(), 1e-20);
}
