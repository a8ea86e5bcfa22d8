//! Numbers in reports.

use std::fmt::Display;

/// Formats an optional value; an en dash stands for `None`.
pub(super) fn or_dash(value: Option<impl Display>) -> String {
    value.map_or("–".into(), |value| value.to_string())
}

/// Formats an optional number with this many decimals; an en dash stands for `None`.
pub(super) fn optional(value: Option<f64>, decimals: usize) -> String {
    or_dash(value.map(|value| format!("{value:.decimals$}")))
}

/// Rounds a number to this many significant digits, at least one.
pub(super) fn significant(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_values_are_dashes() {
        assert_eq!([optional(Some(0.12345), 3), optional(None, 3), or_dash(Some(7))], ["0.123", "–", "7"]);
    }

    #[test]
    fn numbers_are_rounded_to_significant_digits() {
        assert_eq!(
            [significant(0.0039215, 3), significant(12_345.6, 4), significant(0.0, 3)],
            [0.00392, 12_350.0, 0.0]
        );
    }
}
