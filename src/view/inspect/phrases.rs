//! Short texts that several parts of the inspector share.

use crate::language::{Language, word};
use crate::tracer::RayKind;

/// Returns the sentence for a ray that enters no solid.
pub(super) fn passes_nothing(language: Language) -> &'static str {
    word!(language, "It passes no solid.", "Não passa por nenhum sólido.")
}

/// Returns the words for a kind of ray.
pub(super) fn kind_word(kind: RayKind, language: Language) -> &'static str {
    match kind {
        RayKind::Primary => word!(language, "primary", "primário"),
        RayKind::Shadow => word!(language, "to a light", "a uma luz"),
        RayKind::Reflected => word!(language, "reflected", "refletido"),
        RayKind::Refracted => word!(language, "through a surface", "através de uma superfície"),
    }
}
