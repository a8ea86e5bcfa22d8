//! The scheduler of a run, and its name in words.

use crate::balance::Strategy;
use crate::language::{Language, word};
use crate::runlog::{Driver, Header};

/// How a run's atoms are shared: by a strategy of `balance`, or by rayon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// A strategy of `balance`.
    By(Strategy),
    /// Work stealing of rayon.
    Stealing,
}

impl Sharing {
    /// All of them, in the order of the menu: from no sharing to the article's ring, then newer ones.
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

    /// Returns the scheduler that a header asks for.
    pub fn of(header: &Header) -> Self {
        if header.driver == Driver::WorkStealing { Self::Stealing } else { Self::By(header.rules.strategy) }
    }

    /// Returns its name.
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

    /// Returns its name for narrow places.
    pub fn short_name(self, language: Language) -> &'static str {
        match self {
            Self::Stealing => word!(language, "Work stealing", "Roubo de trabalho"),
            _ => self.name(language),
        }
    }

    /// Returns a short line that says what it does.
    pub fn hint(self, language: Language) -> &'static str {
        match self {
            Self::By(Strategy::Serial) => {
                word!(language, "The first machine does everything", "A primeira máquina faz tudo")
            }
            Self::By(Strategy::Static) => {
                word!(language, "A band each; all wait for the slowest", "Uma faixa cada; todas esperam a mais lenta")
            }
            Self::By(Strategy::StaticEstimate) => {
                word!(language, "Bands of about the same estimated cost", "Faixas de custo estimado quase igual")
            }
            Self::By(Strategy::Farm) => {
                word!(language, "A machine without atoms asks the parent", "A máquina sem átomos pede ao pai")
            }
            Self::By(Strategy::FarmBySpeed) => {
                word!(language, "A farm; slow machines get smaller parts", "Idem; as lentas recebem partes menores")
            }
            Self::By(Strategy::Ring) => {
                word!(
                    language,
                    "A machine without atoms offers help round the ring",
                    "A máquina sem átomos oferece ajuda pelo anel"
                )
            }
            Self::By(Strategy::Adaptive) => {
                word!(language, "Wakes helpers, survives losses", "Acorda ajudantes, sobrevive a perdas")
            }
            Self::Stealing => {
                word!(language, "Threads take atoms from each other", "As threads tomam átomos umas das outras")
            }
        }
    }

    /// Returns the number of machines and how they are organised, for the bar at the top.
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

    /// Whether machines offer help round a ring.
    pub(crate) fn is_ring(self) -> bool {
        matches!(self, Self::By(strategy) if strategy.is_ring())
    }

    /// Whether it is the adaptive ring.
    pub(crate) fn is_adaptive(self) -> bool {
        self == Self::By(Strategy::Adaptive)
    }

    /// Whether machines ask the parent for atoms.
    pub(crate) fn is_farm(self) -> bool {
        matches!(self, Self::By(strategy) if strategy.is_farm())
    }

    /// Whether each machine keeps its first atoms.
    pub(crate) fn is_fixed(self) -> bool {
        matches!(self, Self::By(Strategy::Serial | Strategy::Static | Strategy::StaticEstimate))
    }
}
