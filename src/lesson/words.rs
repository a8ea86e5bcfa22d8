//! Text of a lesson in both languages.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};

use crate::language::Language;

/// A text in English and in Portuguese. A file has `("English", "Português")`, or one text for both languages.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Words {
    english: String,
    portuguese: String,
}

impl Words {
    /// The text in a language.
    pub fn in_language(&self, language: Language) -> &str {
        match language {
            Language::English => &self.english,
            Language::Portuguese => &self.portuguese,
        }
    }
}

impl<'de> Deserialize<'de> for Words {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Texts;
        impl<'de> Visitor<'de> for Texts {
            type Value = Words;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a text, or (\"English\", \"Portuguese\")")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Words, E> {
                Ok(Words { english: text.to_owned(), portuguese: text.to_owned() })
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut texts: A) -> Result<Words, A::Error> {
                let english = texts.next_element()?.ok_or_else(|| A::Error::invalid_length(0, &self))?;
                let portuguese = texts.next_element()?.ok_or_else(|| A::Error::invalid_length(1, &self))?;
                Ok(Words { english, portuguese })
            }
        }
        from.deserialize_any(Texts)
    }
}
