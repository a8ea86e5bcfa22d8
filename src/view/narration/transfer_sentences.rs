//! Sentences for atoms that go from one machine to another.

use super::happening::Giver;
use crate::balance::NodeId;
use crate::language::{Language, say, word};
use crate::view::text::format::{atoms_words, fraction, names, node_name};

/// Says that a thread stole atoms.
pub(super) fn theft(language: Language, thief: NodeId, from: NodeId, atoms: u32) -> String {
    let (thief, atoms, from) = (node_name(thief), atoms_words(atoms, language), node_name(from));
    say!(language, "{thief} steals {atoms} from {from}", "{thief} rouba {atoms} de {from}")
}

/// Says that a node that made an offer takes over atoms.
pub(super) fn takeover(language: Language, from: NodeId, to: NodeId, atoms: u32, giver: Giver) -> String {
    let state = match giver {
        Giver::Paused => word!(language, "is paused", "está em pausa").into(),
        Giver::Stopped => word!(language, "is stopped", "está parada").into(),
        Giver::Slow(speed) => {
            let speed = fraction(speed);
            say!(language, "is slow ({speed})", "é lenta ({speed})")
        }
        Giver::Busy => word!(language, "is still busy", "ainda está ocupada").into(),
    };
    let (giver, offerer) = (node_name(from), node_name(to));
    let atoms = if atoms == 1 { word!(language, "one atom", "um átomo").into() } else { atoms_words(atoms, language) };
    say!(
        language,
        "{offerer} has finished and takes over {atoms} from {giver}, which {state}",
        "{offerer} terminou e assume {atoms} de {giver}, que {state}"
    )
}

/// Says that a node that made an offer was given atoms.
pub(super) fn gift(language: Language, from: NodeId, to: NodeId, atoms: u32, slow_at: Option<f64>) -> String {
    let (giver, atoms, to) = (node_name(from), atoms_words(atoms, language), node_name(to));
    let giver = slow_at.map_or(giver.to_string(), |speed| {
        let speed = fraction(speed);
        say!(language, "{giver}, slow at {speed},", "{giver}, lenta a {speed},")
    });
    say!(
        language,
        "{giver} gave {atoms} to {to}, which had finished",
        "{giver} deu {atoms} a {to}, que tinha terminado"
    )
}

/// Says that several small transfers came from one giver.
pub(super) fn small_transfers(
    language: Language,
    (from, to): (NodeId, &[NodeId]),
    (transfers, all): (u32, u32),
    is_theft: bool,
) -> String {
    let (giver, takers, words) = (node_name(from), names(to, language), atoms_words(all, language));
    if is_theft && to.len() == 1 {
        say!(
            language,
            "{takers} steals few atoms at a time from {giver}: {words}",
            "{takers} rouba poucos átomos por vez de {giver}: {words}"
        )
    } else if is_theft {
        say!(
            language,
            "{takers} steal few atoms at a time from {giver}: {words}",
            "{takers} roubam poucos átomos por vez de {giver}: {words}"
        )
    } else if to.len() == 1 {
        say!(language, "{giver} gave {words} to {takers}", "{giver} deu {words} a {takers}")
    } else if all as usize == to.len() {
        say!(language, "{giver} gave 1 atom to {takers}", "{giver} deu 1 átomo a {takers}")
    } else {
        say!(
            language,
            "{giver} gave few atoms at a time to {takers}: {all} in {transfers} parcels",
            "{giver} deu poucos átomos por vez a {takers}: {all} em {transfers} pacotes"
        )
    }
}
