//! The typeface of the window and of exported drawings, and the computer's fonts for letters that it lacks.

mod system;

pub use system::{SystemFont, system_font};

use std::collections::BTreeSet;

use skrifa::{FontRef, MetadataProvider};

/// IBM Plex Sans (SIL Open Font License 1.1): one variable font of all weights.
pub const PLEX: &[u8] = include_bytes!("../assets/fonts/IBMPlexSans.ttf");

/// The name of the font's family.
pub const PLEX_NAME: &str = "IBM Plex Sans";

/// Returns the letters of a text that [`PLEX`] lacks. Characters without a shape of their own are not among them.
pub fn missing_letters(text: &str) -> BTreeSet<char> {
    // It is part of the program, and a font.
    let font = FontRef::new(PLEX).ok();
    let charmap = font.as_ref().map(|font| font.charmap());
    let is_missing = |&letter: &char| charmap.as_ref().is_some_and(|charmap| charmap.map(letter).is_none());
    text.chars().filter(|&letter| has_shape(letter)).filter(is_missing).collect()
}

/// Whether a character is drawn by itself: it is no space, no control, and no mark that only changes its neighbours.
fn has_shape(letter: char) -> bool {
    let only_changes_others = matches!(letter, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
            | '\u{fe00}'..='\u{fe0f}' | '\u{feff}' | '\u{e0000}'..='\u{e0fff}');
    !(letter.is_whitespace() || letter.is_control() || only_changes_others)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_other_scripts_are_missing() {
        assert!(missing_letters("Divisão dinâmica → × … µ Ωж 10\u{a0}% \u{200b}\n").is_empty());
        assert_eq!(missing_letters("a 日本 b 日"), BTreeSet::from(['日', '本']));
    }
}
