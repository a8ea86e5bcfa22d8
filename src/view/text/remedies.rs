//! Names and explanations of the adaptive ring's remedies.

use crate::balance::{Remedies, Remedy};
use crate::language::{Language, say, word};

/// Returns a remedy's name.
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

/// Returns a sentence that says what a remedy does.
pub fn remedy_hint(remedy: Remedy, language: Language) -> &'static str {
    match remedy {
        Remedy::Speed => word!(
            language,
            "Shares follow the machines' present speed, not their atoms since the start",
            "As partes seguem a velocidade atual, não os átomos desde o início"
        ),
        Remedy::Floor => word!(
            language,
            "Atoms are not given away if their way takes longer than they save",
            "Átomos não são dados se a viagem leva mais tempo do que eles poupam"
        ),
        Remedy::Early => word!(
            language,
            "A machine offers help before it has no atoms left, so that it does not wait",
            "A máquina oferece ajuda antes de ficar sem átomos, e assim não espera"
        ),
        Remedy::Wake => word!(
            language,
            "A machine that is not needed sleeps; a machine that needs help later wakes it",
            "A máquina dispensada dorme; outra que depois precisa de ajuda a acorda"
        ),
        Remedy::Copies => word!(
            language,
            "An idle machine traces once more the atoms that are late at a slow one",
            "Uma máquina ociosa calcula de novo os átomos atrasados em outra, lenta"
        ),
        Remedy::Shortcuts => word!(
            language,
            "In a large ring an offer visits only some machines, near and far ones",
            "Num anel grande a oferta visita só algumas máquinas, próximas e distantes"
        ),
        Remedy::Leases => word!(
            language,
            "Atoms of a lost machine are given out again, and the ring closes without it",
            "Átomos de uma máquina perdida são dados de novo, e o anel se fecha sem ela"
        ),
    }
}

/// Says in a few words which remedies a ring has.
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

/// Names a ring without one remedy.
pub fn without(remedy: Remedy, language: Language) -> String {
    let name = remedy_name(remedy, language);
    say!(language, "without {name}", "sem {name}")
}
