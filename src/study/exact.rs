//! Exact numbers without rounding: the truth about the very numbers that a method gets.

use std::borrow::Borrow;
use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

use glam::DVec3;
use num_bigint::{BigInt, Sign};

/// `mantissa` · 2^`exponent`. Every finite f64 is such a number, and so are their sums and products.
#[derive(Clone, Debug)]
pub(super) struct Exact {
    mantissa: BigInt,
    exponent: i64,
}

/// Three exact numbers: a point or a direction.
pub(super) type Vector = [Exact; 3];

impl Exact {
    /// Compares the number with 0.
    pub fn sign(&self) -> Ordering {
        match self.mantissa.sign() {
            Sign::Minus => Ordering::Less,
            Sign::NoSign => Ordering::Equal,
            Sign::Plus => Ordering::Greater,
        }
    }

    pub fn is_positive(&self) -> bool {
        self.sign().is_gt()
    }

    pub fn is_negative(&self) -> bool {
        self.sign().is_lt()
    }

    /// Returns the nearest f64 or a neighbour of it; 0 or infinity out of range.
    pub fn to_f64(&self) -> f64 {
        let more = self.mantissa.bits().saturating_sub(100);
        let leading = i128::try_from(&self.mantissa >> more).unwrap_or_else(|_| unreachable!("100 bits fit"));
        // In two steps, since the power alone may be out of range.
        let power = (self.exponent + more as i64).clamp(-2000, 2000) as i32;
        leading as f64 * 2f64.powi(power / 2) * 2f64.powi(power - power / 2)
    }

    fn aligned(&self, exponent: i64) -> BigInt {
        &self.mantissa << (self.exponent - exponent)
    }

    fn sum(&self, other: &Self, combine: impl Fn(BigInt, BigInt) -> BigInt) -> Self {
        let exponent = self.exponent.min(other.exponent);
        Self { mantissa: combine(self.aligned(exponent), other.aligned(exponent)), exponent }
    }
}

impl From<f64> for Exact {
    /// Converts a finite number exactly.
    fn from(number: f64) -> Self {
        let bits = number.to_bits();
        let (biased, fraction) = ((bits >> 52 & 0x7ff) as i64, bits & ((1 << 52) - 1));
        let leading = if biased == 0 { fraction } else { fraction | 1 << 52 };
        let mantissa = BigInt::from(if number < 0.0 { -(leading as i64) } else { leading as i64 });
        Self { mantissa, exponent: biased.max(1) - 1075 }
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $body:expr) => {
        impl<B: Borrow<Exact>> $trait<B> for &Exact {
            type Output = Exact;
            fn $method(self, other: B) -> Exact {
                $body(self, other.borrow())
            }
        }
        impl<B: Borrow<Exact>> $trait<B> for Exact {
            type Output = Exact;
            fn $method(self, other: B) -> Exact {
                $body(&self, other.borrow())
            }
        }
    };
}

operator!(Add, add, |a: &Exact, b: &Exact| a.sum(b, |a, b| a + b));
operator!(Sub, sub, |a: &Exact, b: &Exact| a.sum(b, |a, b| a - b));
operator!(Mul, mul, |a: &Exact, b: &Exact| Exact {
    mantissa: &a.mantissa * &b.mantissa,
    exponent: a.exponent + b.exponent,
});

/// Converts a vector with finite components exactly.
pub(super) fn vector(v: DVec3) -> Vector {
    v.to_array().map(Exact::from)
}

pub(super) fn dot([a, b, c]: &Vector, [x, y, z]: &Vector) -> Exact {
    a * x + b * y + c * z
}

pub(super) fn cross([a, b, c]: &Vector, [x, y, z]: &Vector) -> Vector {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn conversion_is_exact(number in any::<f64>()) {
            prop_assume!(number.is_finite());
            prop_assert_eq!(Exact::from(number).to_f64(), number);
        }

        /// (a + b)(a − b) = a² − b², which no rounded arithmetic satisfies.
        #[test]
        fn arithmetic_is_exact(a in any::<f64>(), b in any::<f64>()) {
            prop_assume!(a.is_finite() && b.is_finite());
            let (a, b) = (Exact::from(a), Exact::from(b));
            let difference = (&a + &b) * (&a - &b) - (&a * &a - &b * &b);
            prop_assert_eq!(difference.sign(), Ordering::Equal);
        }
    }

    #[test]
    fn differences_below_f64_precision_have_a_sign() {
        let one = Exact::from(1.0);
        let more = &one + Exact::from(1e-30);
        assert!((more - one).is_positive());
        let across = cross(&vector(DVec3::new(1.0, 1e-30, 0.0)), &vector(DVec3::X));
        assert!(across[2].is_negative());
        assert_eq!(dot(&vector(DVec3::new(1e20, 1.0, -1e20)), &vector(DVec3::ONE)).to_f64(), 1.0);
    }
}
