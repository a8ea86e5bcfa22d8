//! Names and hints of schedulers, as the window shows them.

use crate::balance::{Scheduler, Strategy};
use crate::language::{Language, word};

impl Scheduler {
    /// Returns the title in the menu.
    pub fn title(&self, language: Language) -> &'static str {
        match self {
            Self::Protocol(Strategy::Serial) => "Serial",
            Self::Protocol(Strategy::Static) => word!(language, "Equal bands", "Estática"),
            Self::Protocol(Strategy::StaticEstimate) => word!(language, "Estimated bands", "Estática estimada"),
            Self::Protocol(Strategy::Farm) => word!(language, "Farm", "Dinâmica"),
            Self::Protocol(Strategy::FarmBySpeed) => word!(language, "Farm by speed", "Dinâmica por velocidade"),
            Self::Protocol(Strategy::FarmLeases) => word!(language, "Farm with leases", "Dinâmica com prazos"),
            Self::Protocol(Strategy::Ring) => word!(language, "Ring", "Anel"),
            Self::Protocol(Strategy::Adaptive) => word!(language, "Adaptive ring", "Anel adaptativo"),
            Self::WorkStealing => word!(language, "Work stealing (rayon)", "Roubo de trabalho (rayon)"),
        }
    }

    /// Returns the title for narrow places.
    pub fn short_title(&self, language: Language) -> &'static str {
        match self {
            Self::WorkStealing => word!(language, "Work stealing", "Roubo de trabalho"),
            _ => self.title(language),
        }
    }

    /// Returns a short line that says what it does.
    pub fn hint(&self, language: Language) -> &'static str {
        match self {
            Self::Protocol(Strategy::Serial) => {
                word!(language, "The first machine does everything", "A primeira máquina faz tudo")
            }
            Self::Protocol(Strategy::Static) => {
                word!(language, "A band each; all wait for the slowest", "Uma faixa cada; todas esperam a mais lenta")
            }
            Self::Protocol(Strategy::StaticEstimate) => {
                word!(language, "Bands of about the same estimated cost", "Faixas de custo estimado quase igual")
            }
            Self::Protocol(Strategy::Farm) => {
                word!(language, "A machine without atoms asks the parent", "A máquina sem átomos pede ao pai")
            }
            Self::Protocol(Strategy::FarmBySpeed) => {
                word!(language, "A farm; slow machines get smaller parts", "Idem; as lentas recebem partes menores")
            }
            Self::Protocol(Strategy::FarmLeases) => {
                word!(language, "A farm; gives lost parts out again", "Idem; dá de novo as partes perdidas")
            }
            Self::Protocol(Strategy::Ring) => {
                word!(
                    language,
                    "A machine without atoms offers help round the ring",
                    "A máquina sem átomos oferece ajuda pelo anel"
                )
            }
            Self::Protocol(Strategy::Adaptive) => {
                word!(language, "Wakes helpers, survives losses", "Acorda ajudantes, sobrevive a perdas")
            }
            Self::WorkStealing => {
                word!(language, "Threads take atoms from each other", "As threads tomam átomos umas das outras")
            }
        }
    }

    /// Returns the number of machines and how they are organised, for the bar at the top.
    pub fn machines(&self, machines: usize, language: Language) -> String {
        let are = match self {
            _ if machines == 1 => return word!(language, "1 machine", "1 máquina").into(),
            Self::Protocol(Strategy::Serial) => {
                word!(language, "machines, one of which works", "máquinas, das quais uma trabalha")
            }
            Self::Protocol(Strategy::Static) => {
                word!(language, "machines with equal bands", "máquinas com faixas iguais")
            }
            Self::Protocol(Strategy::StaticEstimate) => {
                word!(language, "machines with estimated bands", "máquinas com faixas estimadas")
            }
            Self::Protocol(Strategy::Farm | Strategy::FarmBySpeed) => {
                word!(language, "machines in a farm", "máquinas que pedem ao pai")
            }
            Self::Protocol(Strategy::FarmLeases) => {
                word!(language, "machines in a farm with leases", "máquinas que pedem ao pai, com prazos")
            }
            Self::Protocol(Strategy::Ring) => word!(language, "machines in a ring", "máquinas em anel"),
            Self::Protocol(Strategy::Adaptive) => {
                word!(language, "machines in an adaptive ring", "máquinas em anel adaptativo")
            }
            Self::WorkStealing => word!(language, "threads of rayon", "threads do rayon"),
        };
        format!("{machines} {are}")
    }
}
