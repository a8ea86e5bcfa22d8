//! Text of a file, quoted in a sentence.

/// Makes `text` fit for a sentence: escapes control characters, and cuts it off after `longest` characters.
pub fn shown(text: &str, longest: usize) -> String {
    let mut shown = String::new();
    for c in text.chars().take(longest) {
        if c.is_control() { shown.extend(c.escape_debug()) } else { shown.push(c) }
    }
    if text.chars().nth(longest).is_some() {
        shown.push('…');
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shown_text_is_on_one_line_and_cut_off() {
        assert_eq!(shown("a \"wheel\"\nof\tgold", 40), "a \"wheel\"\\nof\\tgold");
        assert_eq!(shown("fünf", 4), "fünf");
        assert_eq!(shown("fünfzehn", 4), "fünf…");
    }
}
