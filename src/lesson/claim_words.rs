//! Texts of checked claims, which the window shows below the answer of a step.

use std::time::Duration;

use super::{Claim, ClaimFigure, Step};
use crate::language::{Language, decimal, say, word};
use crate::view::{count, duration, fraction};

impl Step {
    /// The text of the step's claims with their values; `None` if there is no claim to show.
    pub fn checked_words(&self, values: &[Option<f64>], language: Language) -> Option<String> {
        let claims: Vec<_> = self
            .holds
            .iter()
            .zip(values)
            .filter_map(|(claim, value)| claim.words(&self.run, (*value)?, language))
            .collect();
        let claims = claims.join(" · ");
        (!claims.is_empty())
            .then(|| say!(language, "Checked on these runs: {claims}", "Conferido nestas execuções: {claims}"))
    }
}

impl Claim {
    /// The text of the claim with its value; `run` is the run that the step shows. `None` for
    /// [`ClaimFigure::Ends`], which the picture itself shows.
    fn words(&self, run: &str, value: f64, language: Language) -> Option<String> {
        let (name, of) = (self.figure.name(language)?, self.of.as_deref().unwrap_or(run));
        Some(match (&self.over, &self.of) {
            (Some(over), _) => format!("{name}, {of} ÷ {over}: {}", decimal(language, value, 2)),
            (None, Some(of)) => format!("{name}, {of}: {}", self.figure.shown(value, language)),
            (None, None) => format!("{name}: {}", self.figure.shown(value, language)),
        })
    }
}

impl ClaimFigure {
    /// The name of the figure; `None` for [`Self::Ends`].
    fn name(self, language: Language) -> Option<&'static str> {
        Some(match self {
            Self::Seconds => word!(language, "time", "tempo"),
            Self::Efficiency => word!(language, "efficiency", "eficiência"),
            Self::Waiting => word!(language, "waiting for others", "espera pelas outras"),
            Self::Asking => word!(language, "waiting between atoms", "espera entre átomos"),
            Self::Starting => word!(language, "waiting for the first atom", "espera pelo primeiro átomo"),
            Self::Alone => word!(language, "one machine alone", "uma máquina sozinha"),
            Self::Last => word!(language, "last machine", "última máquina"),
            Self::Offers => word!(language, "offers", "ofertas"),
            Self::Hops => word!(language, "offers passed on", "ofertas passadas adiante"),
            Self::Transfers => word!(language, "transfers", "transferências"),
            Self::Moved => word!(language, "atoms moved", "átomos transferidos"),
            Self::Largest => word!(language, "atoms in the largest transfer", "átomos na maior transferência"),
            Self::Messages => word!(language, "messages", "mensagens"),
            Self::Atoms => word!(language, "atoms", "átomos"),
            Self::Dearest => word!(language, "dearest atom over the mean", "átomo mais caro sobre a média"),
            Self::Ends => return None,
        })
    }

    /// The value with its unit.
    fn shown(self, value: f64, language: Language) -> String {
        match self {
            Self::Seconds => duration(Duration::try_from_secs_f64(value).unwrap_or_default(), language),
            Self::Efficiency | Self::Waiting | Self::Asking | Self::Starting | Self::Alone => fraction(value),
            Self::Dearest => decimal(language, value, 1),
            // The other figures are counts.
            _ => count(value as u64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Lesson;
    use crate::language::Language;

    #[test]
    fn claims_are_shown_with_their_values() {
        let text = "Lesson(title: \"A\", about: \"B\", runs: {\"bands\": (), \"ring\": ()}, steps: [(say: \"C\", \
                    run: \"ring\", holds: [(figure: Seconds, over: \"bands\", at_most: 0.6), (figure: Efficiency, \
                    of: \"bands\", at_least: 0.1), (figure: Ends, at_least: 1), (figure: Offers, at_least: 1)])])";
        let lesson = Lesson::parse("mine", text).expect("a lesson");
        let words_in = |language| lesson.steps[0].checked_words(&[Some(0.517), Some(0.5), Some(1.0), None], language);
        let english = "Checked on these runs: time, ring ÷ bands: 0.52 · efficiency, bands: 50 %";
        assert_eq!(words_in(Language::English).as_deref(), Some(english));
        let portuguese = "Conferido nestas execuções: tempo, ring ÷ bands: 0,52 · eficiência, bands: 50 %";
        assert_eq!(words_in(Language::Portuguese).as_deref(), Some(portuguese));
        assert_eq!(lesson.steps[0].checked_words(&[None; 4], Language::English), None);
    }
}
