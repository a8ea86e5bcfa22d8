//! Numbers and short texts that all parts of the inspector share.

use crate::language::{Language, comma, decimal, word};
use crate::tracer::RayKind;

/// There are no stays.
pub(super) fn passes_nothing(language: Language) -> &'static str {
    word!(language, "It passes no solid.", "Não passa por nenhum sólido.")
}

/// How a ray came.
pub(super) fn kind_word(kind: RayKind, language: Language) -> &'static str {
    match kind {
        RayKind::Primary => word!(language, "primary", "primário"),
        RayKind::Shadow => word!(language, "to a light", "a uma luz"),
        RayKind::Reflected => word!(language, "reflected", "refletido"),
        RayKind::Refracted => word!(language, "through a surface", "através de uma superfície"),
    }
}

/// A part of a whole, as exactly as it matters: `88 %`, `2.1 %`, `0.03 %`.
pub(super) fn share_words(part: f64, language: Language) -> String {
    let percent = 100.0 * part;
    match percent.abs() {
        0.0 => "0 %".into(),
        0.0..0.005 => word!(language, "< 0.01 %", "< 0,01 %").into(),
        0.005..0.095 => format!("{} %", decimal(language, percent, 2)),
        0.095..9.95 => format!("{} %", decimal(language, percent, 1)),
        _ => format!("{percent:.0} %"),
    }
}

/// A distance to four digits or so.
pub(super) fn number(value: f64, language: Language) -> String {
    match value.abs() {
        f64::INFINITY if value < 0.0 => "−∞".into(),
        f64::INFINITY => "∞".into(),
        0.0 => "0".into(),
        0.001..10.0 => decimal(language, value, 3),
        10.0..100.0 => decimal(language, value, 2),
        100.0..100_000.0 => decimal(language, value, 1),
        _ => comma(language, format!("{value:.2e}")),
    }
    .replace('-', "−")
}
