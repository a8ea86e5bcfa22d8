//! What the remedies of the ring that adapts are called, and what they do.

use crate::balance::{Remedies, Remedy};
use crate::language::{Language, say, word};

/// What a remedy is called.
pub fn remedy_name(remedy: Remedy, language: Language) -> &'static str {
    match remedy {
        Remedy::Speed => word!(language, "shares by speed", "partes por velocidade"),
        Remedy::Floor => word!(language, "a floor", "um piso"),
        Remedy::Early => word!(language, "early offers", "ofertas antecipadas"),
        Remedy::Wake => word!(language, "waking", "despertar"),
        Remedy::Copies => word!(language, "copies", "cópias"),
        Remedy::Shortcuts => word!(language, "shortcuts", "atalhos"),
        Remedy::Leases => word!(language, "leases", "prazos"),
    }
}

/// What it does.
pub fn remedy_hint(remedy: Remedy, language: Language) -> &'static str {
    match remedy {
        Remedy::Speed => word!(
            language,
            "Shares follow how fast machines are now, not their atoms since the start",
            "As partes seguem a velocidade de agora, não os átomos desde o início"
        ),
        Remedy::Floor => word!(
            language,
            "Nothing is given that would take longer to travel than it saves",
            "Não se dá o que levaria mais tempo viajando do que poupa"
        ),
        Remedy::Early => word!(
            language,
            "A machine offers help before it is out of atoms, so that it never waits",
            "A máquina oferece ajuda antes de ficar sem átomos, e não espera"
        ),
        Remedy::Wake => word!(
            language,
            "Who is done sleeps, and whoever comes to need help wakes it",
            "Quem termina dorme, e quem vem a precisar de ajuda o acorda"
        ),
        Remedy::Copies => word!(
            language,
            "An idle machine traces again what is late at a slow one",
            "Uma máquina ociosa calcula de novo o que tarda em outra"
        ),
        Remedy::Shortcuts => word!(
            language,
            "In a large ring an offer stops at few machines, near and far",
            "Num anel grande a oferta para em poucas máquinas, perto e longe"
        ),
        Remedy::Leases => word!(
            language,
            "What a lost machine had is given out again, and the ring closes round it",
            "O que uma máquina perdida tinha é dado de novo, e o anel se fecha sem ela"
        ),
    }
}

/// Which of them a ring has, in a few words.
pub fn remedies_words(remedies: Remedies, language: Language) -> String {
    let missing: Vec<_> = Remedy::ALL.into_iter().filter(|&remedy| !remedies.has(remedy)).collect();
    match missing[..] {
        [] => word!(language, "all remedies", "todos os remédios").to_owned(),
        [one] => without(one, language),
        _ if remedies == Remedies::NONE => word!(language, "no remedy", "nenhum remédio").to_owned(),
        _ => {
            let (has, all) = (remedies.iter().count(), Remedy::ALL.len());
            say!(language, "{has} of {all} remedies", "{has} de {all} remédios")
        }
    }
}

/// A ring that lacks one.
pub fn without(remedy: Remedy, language: Language) -> String {
    let name = remedy_name(remedy, language);
    say!(language, "without {name}", "sem {name}")
}
