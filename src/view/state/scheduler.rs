//! How a run's atoms are shared, in plain words.

use crate::balance::Strategy;
use crate::language::{Language, word};
use crate::runlog::{Driver, Header};

/// How a run's atoms are shared: by a strategy of ours, or by a library of today.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// By this strategy.
    By(Strategy),
    /// By rayon's work stealing.
    Stealing,
}

impl Sharing {
    /// All of them, in the order in which they are offered: from no sharing to the article's, and what came after it.
    pub const ALL: [Self; 8] = [
        Self::By(Strategy::Serial),
        Self::By(Strategy::Static),
        Self::By(Strategy::StaticEstimate),
        Self::By(Strategy::Farm),
        Self::By(Strategy::FarmBySpeed),
        Self::By(Strategy::Ring),
        Self::By(Strategy::Adaptive),
        Self::Stealing,
    ];

    /// How the run is shared that `header` describes.
    pub fn of(header: &Header) -> Self {
        if header.driver == Driver::WorkStealing { Self::Stealing } else { Self::By(header.rules.strategy) }
    }

    /// What it is called.
    pub fn name(self, language: Language) -> &'static str {
        match self {
            Self::By(Strategy::Serial) => "Serial",
            Self::By(Strategy::Static) => word!(language, "Equal bands", "Estática"),
            Self::By(Strategy::StaticEstimate) => word!(language, "Estimated bands", "Estática estimada"),
            Self::By(Strategy::Farm) => word!(language, "Farm", "Dinâmica"),
            Self::By(Strategy::FarmBySpeed) => word!(language, "Farm by speed", "Dinâmica por velocidade"),
            Self::By(Strategy::Ring) => word!(language, "Ring", "Anel"),
            Self::By(Strategy::Adaptive) => word!(language, "Adaptive ring", "Anel adaptativo"),
            Self::Stealing => word!(language, "Work stealing (rayon)", "Roubo de trabalho (rayon)"),
        }
    }

    /// The same where there is little room.
    pub fn short_name(self, language: Language) -> &'static str {
        match self {
            Self::Stealing => word!(language, "Work stealing", "Roubo de trabalho"),
            _ => self.name(language),
        }
    }

    /// What happens, in one short line.
    pub fn hint(self, language: Language) -> &'static str {
        match self {
            Self::By(Strategy::Serial) => {
                word!(language, "The first machine does everything", "A primeira máquina faz tudo")
            }
            Self::By(Strategy::Static) => {
                word!(language, "A band each; all wait for the slowest", "Uma faixa cada; todas esperam a mais lenta")
            }
            Self::By(Strategy::StaticEstimate) => {
                word!(language, "Bands by what they seem to cost", "Faixas pelo que parecem custar")
            }
            Self::By(Strategy::Farm) => {
                word!(language, "Whoever is done asks the parent", "Quem termina pede mais ao pai")
            }
            Self::By(Strategy::FarmBySpeed) => {
                word!(language, "The same; the slow get smaller parts", "Idem; as lentas recebem partes menores")
            }
            Self::By(Strategy::Ring) => {
                word!(language, "Whoever is done offers help round the ring", "Quem termina oferece ajuda pelo anel")
            }
            Self::By(Strategy::Adaptive) => {
                word!(language, "Wakes helpers, survives losses", "Acorda quem ajuda, sobrevive a perdas")
            }
            Self::Stealing => {
                word!(language, "Threads take atoms from each other", "As threads tomam átomos umas das outras")
            }
        }
    }

    /// What those are called that do the work, beside what they are organised in.
    pub fn machines(self, machines: usize, language: Language) -> String {
        let are = match self {
            _ if machines == 1 => return word!(language, "1 machine", "1 máquina").into(),
            Self::By(Strategy::Serial) => {
                word!(language, "machines, one of which works", "máquinas, das quais uma trabalha")
            }
            Self::By(Strategy::Static) => word!(language, "machines with equal bands", "máquinas com faixas iguais"),
            Self::By(Strategy::StaticEstimate) => {
                word!(language, "machines with estimated bands", "máquinas com faixas estimadas")
            }
            Self::By(Strategy::Farm | Strategy::FarmBySpeed) => {
                word!(language, "machines in a farm", "máquinas que pedem ao pai")
            }
            Self::By(Strategy::Ring) => word!(language, "machines in a ring", "máquinas em anel"),
            Self::By(Strategy::Adaptive) => {
                word!(language, "machines in an adaptive ring", "máquinas em anel adaptativo")
            }
            Self::Stealing => word!(language, "threads of rayon", "threads do rayon"),
        };
        format!("{machines} {are}")
    }

    /// Whether whoever is done offers help round the ring.
    pub(crate) fn is_ring(self) -> bool {
        matches!(self, Self::By(strategy) if strategy.is_ring())
    }

    /// Whether it is the ring that wakes sleepers, and mends losses.
    pub(crate) fn is_adaptive(self) -> bool {
        self == Self::By(Strategy::Adaptive)
    }

    /// Whether whoever is done asks the parent for more.
    pub(crate) fn is_farm(self) -> bool {
        matches!(self, Self::By(strategy) if strategy.is_farm())
    }

    /// Whether everyone keeps what they are given at first.
    pub(crate) fn is_fixed(self) -> bool {
        matches!(self, Self::By(Strategy::Serial | Strategy::Static | Strategy::StaticEstimate))
    }
}
