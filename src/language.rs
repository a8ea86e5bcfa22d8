//! English and Portuguese texts. Both versions of a sentence stand side by side in the code, so neither can be missing,
//! and the compiler checks the placeholders of both.

use serde::{Deserialize, Serialize};

/// Language of the texts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// Brazilian Portuguese, the language of the article.
    Portuguese,
}

impl Language {
    /// Returns the language of a locale: Portuguese for `pt_BR.UTF-8` and the like, else English.
    pub fn of_locale(locale: &str) -> Self {
        let first = locale.split(['_', '-', '.', '@']).next().unwrap_or_default();
        if first.eq_ignore_ascii_case("pt") { Self::Portuguese } else { Self::English }
    }

    /// Returns the other language.
    pub fn other(self) -> Self {
        match self {
            Self::English => Self::Portuguese,
            Self::Portuguese => Self::English,
        }
    }

    /// Returns the name of the language in that language.
    pub fn name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::Portuguese => "Português",
        }
    }

    /// Returns the two-letter name.
    pub fn short_name(self) -> &'static str {
        match self {
            Self::English => "EN",
            Self::Portuguese => "PT",
        }
    }
}

/// Formats a sentence in a language, with placeholders as in `format!`: `say!(language, "{n} left", "restam {n}")`.
macro_rules! say {
    ($language:expr, $english:literal, $portuguese:literal $(,)?) => {
        match $language {
            $crate::language::Language::English => format!($english),
            $crate::language::Language::Portuguese => format!($portuguese),
        }
    };
}

/// Chooses between two values without placeholders: `word!(language, "idle", "ociosa")`.
macro_rules! word {
    ($language:expr, $english:expr, $portuguese:expr $(,)?) => {
        match $language {
            $crate::language::Language::English => $english,
            $crate::language::Language::Portuguese => $portuguese,
        }
    };
}

pub(crate) use {say, word};

/// Formats a number with `digits` decimals and the decimal mark of the language.
pub fn decimal(language: Language, number: f64, digits: usize) -> String {
    comma(language, format!("{number:.digits$}"))
}

/// Replaces the decimal point of a formatted number by the decimal mark of the language.
pub fn comma(language: Language, number: String) -> String {
    match language {
        Language::English => number,
        Language::Portuguese => number.replace('.', ","),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_language_has_its_own_text_and_decimal_mark() {
        let left = 3;
        let said = |language| {
            (
                say!(language, "{left} left", "restam {left}"),
                word!(language, "idle", "ociosa"),
                decimal(language, 1.25, 1),
            )
        };
        assert_eq!(said(Language::English), ("3 left".to_owned(), "idle", "1.2".to_owned()));
        assert_eq!(said(Language::Portuguese), ("restam 3".to_owned(), "ociosa", "1,2".to_owned()));
    }

    #[test]
    fn locale_gives_language() {
        for (locale, language) in [
            ("pt_BR.UTF-8", Language::Portuguese),
            ("pt", Language::Portuguese),
            ("PT-pt", Language::Portuguese),
            ("de_DE", Language::English),
            ("C", Language::English),
            ("", Language::English),
        ] {
            assert_eq!(Language::of_locale(locale), language);
        }
    }
}
