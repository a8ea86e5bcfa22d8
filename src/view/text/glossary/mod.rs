//! The glossary: one definition of each word and each figure of the window, in both languages. Tooltips and the list of
//! words show it. `docs/figures.md` has the same words, and the exact formulas of the figures.

mod figures;
mod words;

use crate::language::{Language, word};
use crate::view::state::node_state::Activity;

/// A word or a figure of the window, and what it means. The associated constants are its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Definition {
    name: [&'static str; 2],
    text: [&'static str; 2],
}

impl Definition {
    /// Returns the word or the caption of the figure, as the window writes it.
    pub fn name(&self, language: Language) -> &'static str {
        word!(language, self.name[0], self.name[1])
    }

    /// Returns what it means, in one to three sentences.
    pub fn text(&self, language: Language) -> &'static str {
        word!(language, self.text[0], self.text[1])
    }

    /// Returns the definition of the word for what a machine does now.
    pub fn of_activity(activity: Activity) -> Self {
        match activity {
            Activity::NoBand => Self::NOW_NO_BAND,
            Activity::Tracing => Self::NOW_TRACING,
            Activity::SpeedZero => Self::NOW_AT_0,
            Activity::Paused => Self::NOW_PAUSED,
            Activity::Offering => Self::NOW_OFFERS_HELP,
            Activity::Asking => Self::NOW_ASKING,
            Activity::InLine => Self::NOW_IN_LINE,
            Activity::Receiving => Self::NOW_RECEIVING,
            Activity::Idle => Self::NOW_IDLE,
            Activity::Retired => Self::NOW_RETIRED,
            Activity::Asleep => Self::NOW_ASLEEP,
            Activity::NoMore => Self::NOW_NO_MORE,
            Activity::Hung => Self::NOW_HUNG,
            Activity::CutOff => Self::NOW_CUT_OFF,
            Activity::Off => Self::NOW_OFF,
            Activity::Spare => Self::NOW_SPARE,
            Activity::Done => Self::NOW_DONE,
        }
    }
}

/// Definitions that belong together.
pub struct DefinitionGroup {
    title: [&'static str; 2],
    /// The definitions, in the order of the list of words.
    pub definitions: &'static [Definition],
}

impl DefinitionGroup {
    /// All groups, in the order of the list of words.
    pub const ALL: [Self; 6] = [
        Self { title: ["Words of a run", "Palavras de uma execução"], definitions: &Definition::WORDS },
        Self { title: ["Speeds and network", "Velocidades e rede"], definitions: &Definition::SETTINGS },
        Self { title: ["Table and timeline", "Tabela e linha do tempo"], definitions: &Definition::TABLE },
        Self { title: ["What a machine does now", "O que uma máquina faz agora"], definitions: &Definition::NOW },
        Self { title: ["Result and comparison", "Resultado e comparação"], definitions: &Definition::RESULT },
        Self { title: ["Where the time went", "Para onde foi o tempo"], definitions: &Definition::TIME_BUDGET },
    ];

    /// Returns the title of the group.
    pub fn title(&self, language: Language) -> &'static str {
        word!(language, self.title[0], self.title[1])
    }
}

/// Declares constants of [`Definition`] and the list of them. A constant is documented by its English text.
macro_rules! definitions {
    ($(#[$doc:meta])* $list:ident; $($id:ident $name:expr => $english:literal, $portuguese:literal;)*) => {
        impl Definition {
            $(#[$doc])*
            pub const $list: [Self; [$(stringify!($id)),*].len()] = [$(Self::$id),*];
            $(
                #[doc = $english]
                pub const $id: Self = Self { name: $name, text: [$english, $portuguese] };
            )*
        }
    };
}

use definitions;

#[cfg(test)]
mod tests;
