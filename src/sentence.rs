//! What stands in a file, where a sentence about the file repeats it.

/// `text` as it can stand in a sentence: on one line, and cut off after so many characters.
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
    fn what_is_shown_is_on_one_line_and_not_too_long() {
        assert_eq!(shown("a \"wheel\"\nof\tgold", 40), "a \"wheel\"\\nof\\tgold");
        assert_eq!(shown("fünf", 4), "fünf");
        assert_eq!(shown("fünfzehn", 4), "fünf…");
    }
}
