//! Numbers that the user types: as a whole or not at all, with the decimal mark of either language.

use egui::{Context, Id};

use crate::language::{Language, comma, say};

/// Why a typed text is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberError {
    /// It is no number.
    NotANumber,
    /// It is a fraction, and the field takes whole numbers only.
    NotWhole,
    /// Its mark may be that of decimals or of thousands.
    Ambiguous,
}

/// A text that a number field has refused.
#[derive(Clone, Debug)]
pub struct RefusedNumber {
    /// The accessible name of the field.
    pub field: String,
    /// The text.
    pub text: String,
    /// The reason.
    pub why: NumberError,
}

impl RefusedNumber {
    /// Notes that a field has refused a text, for [`RefusedNumber::take`].
    pub fn report(self, ctx: &Context) {
        ctx.data_mut(|data| data.insert_temp(Self::id(), Some(self)));
    }

    /// Takes the text that was refused in this frame, if there is one.
    pub fn take(ctx: &Context) -> Option<Self> {
        ctx.data_mut(|data| data.remove_temp::<Option<Self>>(Self::id())).flatten()
    }

    /// Says why the text was refused.
    pub fn sentence(&self, language: Language) -> String {
        let Self { field, text, why } = self;
        match why {
            NumberError::NotANumber => say!(
                language,
                "“{text}” is not a number. The value of “{field}” stays as it was",
                "“{text}” não é um número. O valor de “{field}” fica como estava"
            ),
            NumberError::NotWhole => say!(
                language,
                "“{text}” is not a whole number. The value of “{field}” stays as it was",
                "“{text}” não é um número inteiro. O valor de “{field}” fica como estava"
            ),
            NumberError::Ambiguous => say!(
                language,
                "“{text}”: type thousands without a mark, and decimals with a point. The value of “{field}” stays as it was",
                "“{text}”: digite os milhares sem sinal, e os decimais com vírgula. O valor de “{field}” fica como estava"
            ),
        }
    }

    fn id() -> Id {
        Id::unique("refused number")
    }
}

/// Parses a typed number. A space may stand between digits, and the unit of the field after the number. The decimal
/// mark is that of the language; that of the other language serves too, unless three digits follow it.
///
/// # Errors
/// If the text is not as a whole such a number.
pub fn parse(text: &str, unit: &str, is_whole: bool, language: Language) -> Result<f64, NumberError> {
    let text = text.trim();
    let text = text.strip_suffix(unit.trim()).unwrap_or(text);
    let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let digits = text.trim_start_matches(['-', '−', '+']);
    let is_negative = match text.strip_suffix(digits) {
        Some("" | "+") => false,
        Some("-" | "−") => true,
        _ => return Err(NumberError::NotANumber),
    };
    let (whole, decimals) = digits.split_at(digits.find(['.', ',']).unwrap_or(digits.len()));
    let (mark, decimals) = decimals.split_at(decimals.len().min(1));
    let are_digits = |digits: &str| digits.chars().all(|c| c.is_ascii_digit());
    if whole.len() + decimals.len() == 0 || !are_digits(whole) || !are_digits(decimals) {
        let has_digits_and_marks = digits.starts_with(|c: char| c.is_ascii_digit())
            && digits.chars().all(|c| c.is_ascii_digit() || ".,".contains(c));
        return Err(if has_digits_and_marks { NumberError::Ambiguous } else { NumberError::NotANumber });
    }
    if mark != comma(language, ".".into()) && !mark.is_empty() && decimals.len() == 3 {
        return Err(NumberError::Ambiguous);
    }
    let number: f64 = format!("{whole}.{decimals}0").parse().map_err(|_| NumberError::NotANumber)?;
    if is_whole && number.fract() != 0.0 {
        return Err(NumberError::NotWhole);
    }
    Ok(if is_negative { -number } else { number })
}

/// Formats a number for a field: up to three decimals, as few as possible.
pub fn format(number: f64, language: Language) -> String {
    let text = format!("{number:.3}");
    comma(language, text.trim_end_matches('0').trim_end_matches('.').to_owned())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::NumberError::{Ambiguous, NotANumber, NotWhole};
    use super::*;

    #[test]
    fn text_is_a_number_as_a_whole_or_not_at_all() {
        let [english, portuguese] = [Language::English, Language::Portuguese];
        let fraction = |text: &str, language| parse(text, " ms", false, language);
        for text in ["12,5", "12.5", " 12.5 ", "12,50", "+12.5", "1 2,5", "12.5 ms", "12,5ms"] {
            assert_eq!([fraction(text, english), fraction(text, portuguese)], [Ok(12.5); 2], "{text}");
        }
        assert_eq!([fraction("1.234", english), fraction("1,234", portuguese)], [Ok(1.234); 2]);
        assert_eq!([fraction("1,234", english), fraction("1.234", portuguese)], [Err(Ambiguous); 2]);
        assert_eq!([fraction("−5", english), fraction("-,5", portuguese)], [Ok(-5.0), Ok(-0.5)]);
        for text in ["12x", "x", "12 kg", "--5", "5-", "inf", "NaN", "1e3", "0x10", "", ",", "12 s", "٣"] {
            assert_eq!(fraction(text, english), Err(NotANumber), "{text}");
        }
        for text in ["1.234,5", "1,2,3", "1..2"] {
            assert_eq!(fraction(text, portuguese), Err(Ambiguous), "{text}");
        }
        let whole = |text: &str| parse(text, "", true, english);
        assert_eq!(["640", "640.0", "6\u{a0}144"].map(whole), [Ok(640.0), Ok(640.0), Ok(6144.0)]);
        assert_eq!([whole("12,5"), whole("1,280")], [Err(NotWhole), Err(Ambiguous)]);
    }

    proptest! {
        #[test]
        fn field_reads_what_it_shows(thousandths in -2_000_000..2_000_000i32) {
            let number = f64::from(thousandths) / 1000.0;
            for language in [Language::English, Language::Portuguese] {
                prop_assert_eq!(parse(&format(number, language), "", false, language), Ok(number));
            }
        }
    }
}
