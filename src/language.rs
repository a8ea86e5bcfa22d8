//! The language of what people read: English or Portuguese. Both stand beside each other where a sentence is made, so that
//! none can be missing, and the compiler checks the places of both.

use serde::{Deserialize, Serialize};

/// A language that the program speaks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// Portuguese, the article's, as it is written in Brazil.
    Portuguese,
}

impl Language {
    /// The language of a locale: `pt_BR.UTF-8` is Portuguese, and whatever we do not know English.
    pub fn of_locale(locale: &str) -> Self {
        let first = locale.split(['_', '-', '.', '@']).next().unwrap_or_default();
        if first.eq_ignore_ascii_case("pt") { Self::Portuguese } else { Self::English }
    }

    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Self::English => Self::Portuguese,
            Self::Portuguese => Self::English,
        }
    }

    /// Its own name.
    pub fn name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::Portuguese => "Português",
        }
    }

    /// Its name in two letters.
    pub fn short_name(self) -> &'static str {
        match self {
            Self::English => "EN",
            Self::Portuguese => "PT",
        }
    }
}

/// Formats a sentence in a language, with places as in `format!`: `say!(language, "{n} left", "restam {n}")`.
macro_rules! say {
    ($language:expr, $english:literal, $portuguese:literal $(,)?) => {
        match $language {
            $crate::language::Language::English => format!($english),
            $crate::language::Language::Portuguese => format!($portuguese),
        }
    };
}

/// Chooses between two texts without places: `word!(language, "idle", "ociosa")`.
macro_rules! word {
    ($language:expr, $english:expr, $portuguese:expr $(,)?) => {
        match $language {
            $crate::language::Language::English => $english,
            $crate::language::Language::Portuguese => $portuguese,
        }
    };
}

pub(crate) use {say, word};

/// A number with so many digits after the point, or after the comma.
pub fn decimal(language: Language, number: f64, digits: usize) -> String {
    comma(language, format!("{number:.digits$}"))
}

/// A number that is written with a point, as the language that is spoken writes it.
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
    fn locales() {
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
