//! Sentences for atoms that go from one machine to another.

use super::happening::Giver;
use super::share::Share;
use super::unreached::Unreached;
use crate::balance::NodeId;
use crate::language::{Language, say, word};
use crate::view::text::format::{atoms_words, count, fraction, names, node_name};

/// Says that a thread stole atoms.
pub(super) fn theft(language: Language, thief: NodeId, from: NodeId, atoms: u32) -> String {
    let (thief, atoms, from) = (node_name(thief), atoms_words(atoms, language), node_name(from));
    say!(language, "{thief} steals {atoms} from {from}", "{thief} rouba {atoms} de {from}")
}

/// A transfer of atoms to a machine that offered help.
pub(super) struct Transfer {
    pub(super) from: NodeId,
    pub(super) to: NodeId,
    /// Atoms in it.
    pub(super) atoms: u32,
    /// Atoms that waited with the giver, these included.
    pub(super) waiting: u32,
}

impl Transfer {
    /// Names the atoms: `3 of 8 atoms`, `all 8 atoms`.
    fn some(&self, language: Language) -> String {
        let all = atoms_words(self.waiting, language);
        match count(self.atoms) {
            _ if self.waiting == 1 => word!(language, "the only waiting atom", "o único átomo que espera").into(),
            _ if self.atoms == self.waiting => {
                say!(language, "all {all} that wait", "todos os {all} que esperam")
            }
            some => say!(language, "{some} of {all}", "{some} de {all}"),
        }
    }

    /// Says that the machine takes over atoms, and why this number.
    pub(super) fn takeover(&self, giver: Giver, share: Option<Share>, is_early: bool, language: Language) -> String {
        let state = match giver {
            Giver::Paused => word!(language, " (paused)", " (em pausa)").into(),
            Giver::Stopped => word!(language, " (stopped)", " (parada)").into(),
            Giver::Slow(speed) => {
                let speed = fraction(speed);
                say!(language, " (slow, {speed})", " (lenta, {speed})")
            }
            Giver::Busy => String::new(),
        };
        let (giver, offerer, some) = (node_name(self.from), node_name(self.to), self.some(language));
        let why = share.map(|share| share.reason(self.to, language));
        let why = why.map(|why| format!(": {why}")).unwrap_or_default();
        let has_finished = if is_early {
            word!(language, "has nearly finished", "está quase pronta")
        } else {
            word!(language, "has finished", "terminou")
        };
        say!(
            language,
            "{offerer} {has_finished} and takes {some} from {giver}{state}{why}",
            "{offerer} {has_finished} e assume {some} de {giver}{state}{why}"
        )
    }

    /// Says that the machine takes over atoms, so that its offer does not reach a machine that stands still.
    pub(super) fn before(&self, unreached: Unreached, language: Language) -> String {
        let (giver, offerer, some) = (node_name(self.from), node_name(self.to), self.some(language));
        let other = node_name(unreached.node);
        let is = unreached.is_stopped_words(language);
        say!(
            language,
            "{offerer} takes {some} from {giver}, so its offer does not reach {other}, {is}",
            "{offerer} assume {some} de {giver}, e sua oferta não chega a {other}, {is}"
        )
    }

    /// Says that the machine was given atoms.
    pub(super) fn gift(&self, slow_at: Option<f64>, language: Language) -> String {
        let some = if self.atoms == self.waiting { atoms_words(self.atoms, language) } else { self.some(language) };
        let (giver, to) = (node_name(self.from), node_name(self.to));
        let giver = slow_at.map_or(giver.to_string(), |speed| {
            let speed = fraction(speed);
            say!(language, "{giver}, slow at {speed},", "{giver}, lenta a {speed},")
        });
        say!(
            language,
            "{giver} gave {some} to {to}, which had finished",
            "{giver} deu {some} a {to}, que tinha terminado"
        )
    }
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
