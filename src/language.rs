//! The language of what people read: English or Portuguese. Both stand beside each other where a sentence is made, so that
//! none can be missing, and the compiler checks the places of both.

use std::cell::Cell;

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

thread_local! {
    static SPOKEN: Cell<Language> = const { Cell::new(Language::English) };
}

impl Language {
    /// The language that this thread speaks: English, until [`Language::speak`] says otherwise. Files, reports and the
    /// command line are written by threads that speak English.
    pub fn spoken() -> Self {
        SPOKEN.get()
    }

    /// From now on this thread speaks it.
    pub fn speak(self) {
        SPOKEN.set(self);
    }

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

/// A sentence in the language that is spoken, with places as in `format!`: `say!("{n} left", "restam {n}")`.
macro_rules! say {
    ($english:literal, $portuguese:literal $(,)?) => {
        match $crate::language::Language::spoken() {
            $crate::language::Language::English => format!($english),
            $crate::language::Language::Portuguese => format!($portuguese),
        }
    };
}

/// Words without places in the language that is spoken: `word!("idle", "ociosa")`.
macro_rules! word {
    ($english:expr, $portuguese:expr $(,)?) => {
        match $crate::language::Language::spoken() {
            $crate::language::Language::English => $english,
            $crate::language::Language::Portuguese => $portuguese,
        }
    };
}

pub(crate) use {say, word};

/// A number with so many digits after the point, or after the comma.
pub fn decimal(number: f64, digits: usize) -> String {
    comma(format!("{number:.digits$}"))
}

/// A number that is written with a point, as the language that is spoken writes it.
pub fn comma(number: String) -> String {
    match Language::spoken() {
        Language::English => number,
        Language::Portuguese => number.replace('.', ","),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn english_is_spoken_until_somebody_says_otherwise() {
        let left = 3;
        let said = || (say!("{left} left", "restam {left}"), word!("idle", "ociosa"), decimal(1.25, 1));
        assert_eq!(said(), ("3 left".to_owned(), "idle", "1.2".to_owned()));
        Language::Portuguese.speak();
        assert_eq!(said(), ("restam 3".to_owned(), "ociosa", "1,2".to_owned()));
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
