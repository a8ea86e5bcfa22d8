//! Range checks of numbers while they are read, so that an error can give the position.

use std::fmt;

use glam::DVec3;
use serde::de::{self, Deserialize, Deserializer, Error, SeqAccess, Visitor};

/// The greatest number of leaves after named solids and copies are put in; a scene with more is a mistake.
pub(super) const MAX_LEAVES: usize = 200_000;
/// The greatest absolute coordinate. Squares and products of a few coordinates stay finite.
const MAX_COORDINATE: f64 = 1e12;

pub(super) fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    check(f64::deserialize(from)?, |x| x.abs() <= MAX_COORDINATE, "a number between -1e12 and 1e12")
}

pub(super) fn positive<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    check(f64::deserialize(from)?, |x| (1e-12..=MAX_COORDINATE).contains(&x), "greater than 0 (from 1e-12 to 1e12)")
}

/// Reads the radius of a cone at `from`. Who writes 0 here has given the tip first.
pub(super) fn base_radius<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    let radius = f64::deserialize(from)?;
    if radius == 0.0 {
        return Err(D::Error::custom(
            "is the radius at `from` and must be greater than 0; the tip of a cone is at `to`: swap `from` and `to`",
        ));
    }
    check(radius, |x| (1e-12..=MAX_COORDINATE).contains(&x), "greater than 0 (from 1e-12 to 1e12)")
}

/// Reads a number of copies. Each has at least one primitive.
pub(super) fn count<'de, D: Deserializer<'de>>(from: D) -> Result<usize, D::Error> {
    let is_valid = |x: f64| x.fract() == 0.0 && (1.0..=MAX_LEAVES as f64).contains(&x);
    check(f64::deserialize(from)?, is_valid, &format!("a whole number from 1 to {MAX_LEAVES}")).map(|x| x as usize)
}

pub(super) fn fraction<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    check(f64::deserialize(from)?, |x| (0.0..=1.0).contains(&x), "between 0 and 1")
}

/// Reads one number for red, green and blue, or three.
pub(super) fn fractions<'de, D: Deserializer<'de>>(from: D) -> Result<DVec3, D::Error> {
    struct OneOrThree;
    impl<'de> Visitor<'de> for OneOrThree {
        type Value = DVec3;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("a number between 0 and 1, or three for red, green and blue")
        }

        fn visit_f64<E: Error>(self, number: f64) -> Result<DVec3, E> {
            Ok(DVec3::splat(number))
        }

        fn visit_u64<E: Error>(self, number: u64) -> Result<DVec3, E> {
            Ok(DVec3::splat(number as f64))
        }

        fn visit_i64<E: Error>(self, number: i64) -> Result<DVec3, E> {
            Ok(DVec3::splat(number as f64))
        }

        fn visit_seq<A: SeqAccess<'de>>(self, numbers: A) -> Result<DVec3, A::Error> {
            <(f64, f64, f64)>::deserialize(de::value::SeqAccessDeserializer::new(numbers)).map(DVec3::from)
        }
    }
    let fractions = from.deserialize_any(OneOrThree)?;
    let is_valid = |x: f64| (0.0..=1.0).contains(&x);
    if fractions.to_array().iter().all(|&x| x == fractions.x) {
        return check(fractions.x, is_valid, "between 0 and 1").map(DVec3::splat);
    }
    check_each(fractions, is_valid, "three numbers between 0 and 1")
}

pub(super) fn exponent<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    check(f64::deserialize(from)?, |x| (0.0..=1e6).contains(&x), "between 0 and 1e6")
}

pub(super) fn index_of_refraction<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    check(f64::deserialize(from)?, |x| (0.1..=10.0).contains(&x), "between 0.1 and 10")
}

pub(super) fn angle_of_view<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    check(f64::deserialize(from)?, |x| (0.001..180.0).contains(&x), "an angle between 0.001 and 180 degrees")
}

pub(super) fn vector<'de, D: Deserializer<'de>>(from: D) -> Result<DVec3, D::Error> {
    each(from, |x| x.abs() <= MAX_COORDINATE, "three numbers between -1e12 and 1e12")
}

pub(super) fn direction<'de, D: Deserializer<'de>>(from: D) -> Result<DVec3, D::Error> {
    let vector = vector(from)?;
    // The square of a shorter vector may vanish.
    if vector.length() < 1e-12 {
        return Err(D::Error::custom("must not be of length 0"));
    }
    Ok(vector.normalize())
}

pub(super) fn colour<'de, D: Deserializer<'de>>(from: D) -> Result<DVec3, D::Error> {
    each(from, |x| (0.0..=1.0).contains(&x), "three numbers between 0 and 1")
}

pub(super) fn light<'de, D: Deserializer<'de>>(from: D) -> Result<DVec3, D::Error> {
    each(from, |x| (0.0..=1e6).contains(&x), "three numbers between 0 and 1e6")
}

/// Reads the factors of a scaling; negative ones mirror.
pub(super) fn factors<'de, D: Deserializer<'de>>(from: D) -> Result<DVec3, D::Error> {
    each(from, |x| (1e-6..=1e6).contains(&x.abs()), "three factors other than 0 (from 1e-6 to 1e6, or negative)")
}

fn each<'de, D: Deserializer<'de>>(from: D, valid: impl Fn(f64) -> bool, what: &str) -> Result<DVec3, D::Error> {
    check_each(DVec3::from(<(f64, f64, f64)>::deserialize(from)?), valid, what)
}

fn check_each<E: Error>(vector: DVec3, valid: impl Fn(f64) -> bool, what: &str) -> Result<DVec3, E> {
    if vector.to_array().into_iter().all(valid) {
        Ok(vector)
    } else {
        Err(E::custom(format_args!("must be {what}, not ({})", vector.to_array().map(shown).join(", "))))
    }
}

fn check<E: Error>(number: f64, valid: impl Fn(f64) -> bool, what: &str) -> Result<f64, E> {
    if valid(number) { Ok(number) } else { Err(E::custom(format_args!("must be {what}, not {}", shown(number)))) }
}

/// Formats a number for an error text.
fn shown(number: f64) -> String {
    let plain = number == 0.0 || !number.is_finite() || (1e-6..1e15).contains(&number.abs());
    if plain { number.to_string() } else { format!("{number:e}") }
}
