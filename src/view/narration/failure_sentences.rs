//! The sentence for each failure and each step of the recovery.

use std::time::Duration;

use super::failure::Failure;
use crate::balance::{NodeId, Party};
use crate::language::{Language, say, word};
use crate::view::text::format::{atoms_words, duration, names, node_name};

impl Failure {
    /// One sentence without a full stop.
    pub(crate) fn sentence(&self, language: Language) -> String {
        match self {
            &Self::SwitchedOff { node, atoms, is_recovered } => switched_off(language, node, atoms, is_recovered),
            &Self::Hung { node, atoms, is_recovered } => hung(language, node, atoms, is_recovered),
            &Self::CutOff(node) => {
                let name = node_name(node);
                say!(
                    language,
                    "Machine {name} is cut off: it traces on, but nothing comes from it or to it",
                    "A máquina {name} está isolada: calcula, mas nada sai dela nem chega a ela"
                )
            }
            &Self::Joined(node) => {
                let name = node_name(node);
                say!(
                    language,
                    "Machine {name} joins: it asks the parent to be let in",
                    "A máquina {name} chega e pede ao pai para entrar"
                )
            }
            &Self::Restarted(node) => {
                let name = node_name(node);
                say!(
                    language,
                    "Machine {name} begins anew and asks the parent to be let in",
                    "A máquina {name} recomeça e pede ao pai para entrar"
                )
            }
            &Self::RestartedOutside(node) => {
                let name = node_name(node);
                say!(
                    language,
                    "Machine {name} is on again, but has forgotten all, and nobody lets it in",
                    "A máquina {name} voltou, mas esqueceu tudo, e ninguém a deixa entrar"
                )
            }
            &Self::Reachable(node) => {
                let name = node_name(node);
                say!(language, "Machine {name} can be reached again", "A máquina {name} voltou a ser alcançável")
            }
            &Self::Continues(node) => {
                let name = node_name(node);
                say!(language, "Machine {name} goes on where it was", "A máquina {name} continua de onde estava")
            }
            Self::Missed { node, silent } => {
                let (name, silent) = (node_name(*node), duration(*silent, language));
                say!(
                    language,
                    "The parent has not heard of machine {name} for {silent}: the ring closes round it",
                    "O pai não ouve a máquina {name} há {silent}: o anel se fecha sem ela"
                )
            }
            Self::MissedMany(nodes) => {
                let who = names(nodes, language);
                say!(
                    language,
                    "The parent does not hear of machines {who}: the ring closes round them",
                    "O pai não ouve as máquinas {who}: o anel se fecha sem elas"
                )
            }
            Self::Returned(nodes) => {
                let who = names(nodes, language);
                match **nodes {
                    [_] => say!(
                        language,
                        "The parent hears of machine {who}: the ring opens for it",
                        "O pai ouve a máquina {who}: o anel se abre para ela"
                    ),
                    _ => say!(
                        language,
                        "The parent hears of machines {who}: the ring opens for them",
                        "O pai ouve as máquinas {who}: o anel se abre para elas"
                    ),
                }
            }
            &Self::Delayed { from, to, by } => delayed(language, (from, to), by),
            Self::HandedOutAgain { to, atoms } => handed_out_again(language, to, *atoms),
            Self::Copies { from, to, atoms } => copies(language, *from, to, *atoms),
            Self::Wakes { from, to } => wakes(language, *from, to),
        }
    }
}

fn hung(language: Language, node: NodeId, atoms: u32, is_recovered: bool) -> String {
    let (name, left) = (node_name(node), atoms_words(atoms, language));
    if is_recovered {
        say!(
            language,
            "Machine {name} hangs, neither traces nor answers: the parent will miss it",
            "A máquina {name} travou, não calcula nem responde: o pai vai notar"
        )
    } else {
        say!(
            language,
            "Machine {name} hangs with {left}: messages to it wait, offers too",
            "A máquina {name} travou com {left}: as mensagens para ela esperam, as ofertas também"
        )
    }
}

fn delayed(language: Language, (from, to): (Party, Party), by: Duration) -> String {
    let by = duration(by, language);
    match (from, to) {
        (Party::Node(from), Party::Node(to)) => {
            let (from, to) = (node_name(from), node_name(to));
            say!(
                language,
                "What machine {from} sends to machine {to} is held up for {by}",
                "O que a máquina {from} manda à máquina {to} fica retido por {by}"
            )
        }
        (Party::Node(from), Party::Parent) => {
            let from = node_name(from);
            say!(
                language,
                "What machine {from} sends to the parent is held up for {by}",
                "O que a máquina {from} manda ao pai fica retido por {by}"
            )
        }
        (Party::Parent, Party::Node(to)) => {
            let to = node_name(to);
            say!(
                language,
                "What the parent sends to machine {to} is held up for {by}",
                "O que o pai manda à máquina {to} fica retido por {by}"
            )
        }
        (Party::Parent, Party::Parent) => String::new(),
    }
}

fn handed_out_again(language: Language, to: &[NodeId], atoms: u32) -> String {
    let (who, what) = (names(to, language), atoms_words(atoms, language));
    let machine = if let [_] = to {
        word!(language, "machine", "à máquina")
    } else {
        word!(language, "machines", "às máquinas")
    };
    match atoms {
        1 => say!(
            language,
            "{what} that nobody has is given out again to {machine} {who}",
            "{what} que ninguém tem é dado de novo {machine} {who}"
        ),
        _ => say!(
            language,
            "{what} that nobody has are given out again to {machine} {who}",
            "{what} que ninguém tem são dados de novo {machine} {who}"
        ),
    }
}

fn copies(language: Language, from: NodeId, to: &[NodeId], atoms: u32) -> String {
    let (late, who) = (node_name(from), names(to, language));
    match (to, atoms) {
        ([_], 1) => say!(
            language,
            "Machine {who} traces an atom again that is late at machine {late}",
            "A máquina {who} calcula de novo um átomo que tarda na máquina {late}"
        ),
        ([_], _) => say!(
            language,
            "Machine {who} traces {atoms} atoms again that are late at machine {late}",
            "A máquina {who} calcula de novo {atoms} átomos que tardam na máquina {late}"
        ),
        _ => say!(
            language,
            "Machines {who} trace {atoms} atoms again that are late at machine {late}",
            "As máquinas {who} calculam de novo {atoms} átomos que tardam na máquina {late}"
        ),
    }
}

fn wakes(language: Language, from: NodeId, to: &[NodeId]) -> String {
    let (from, who) = (node_name(from), names(to, language));
    match to {
        [_] => say!(
            language,
            "Machine {from} needs help and wakes machine {who}",
            "A máquina {from} precisa de ajuda e acorda a máquina {who}"
        ),
        _ => say!(
            language,
            "Machine {from} needs help and wakes machines {who}",
            "A máquina {from} precisa de ajuda e acorda as máquinas {who}"
        ),
    }
}

fn switched_off(language: Language, node: NodeId, atoms: u32, is_recovered: bool) -> String {
    let (name, took) = (node_name(node), atoms_words(atoms, language));
    match atoms {
        0 => {
            say!(
                language,
                "Machine {name} is switched off; it had no atoms",
                "A máquina {name} foi desligada; não tinha átomos"
            )
        }
        _ if is_recovered => say!(
            language,
            "Machine {name} is switched off with {took}, until the parent misses them",
            "A máquina {name} foi desligada com {took}, até que o pai dê por falta"
        ),
        _ => say!(
            language,
            "Machine {name} is switched off with {took}, which nobody has now",
            "A máquina {name} foi desligada com {took}, que agora ninguém tem"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::super::narrator::Narrator;
    use super::*;
    use crate::balance::{Condition, Strategy};
    use crate::scenario::Command;
    use crate::sim::Sim;
    use crate::time::Time;
    use crate::view::state::run_state::RunState;
    use crate::view::tests::sample_runs;

    /// What the list of events has told in all of a run of four machines to which this was done.
    fn story(strategy: Strategy, speeds: &[f64], script: &[(f64, Command)]) -> Vec<String> {
        let mut header = sample_runs::header(speeds, 900);
        header.rules.strategy = strategy;
        let script: Vec<_> = script.iter().map(|&(at, command)| (Time::from_secs(at), command)).collect();
        let (mut state, mut narrator, mut told) = (RunState::new(&header), Narrator::default(), Vec::new());
        Sim::new(&header, &script, |_| sample_runs::COST).run(&mut |record| {
            state.apply(&record);
            narrator.apply(&record, &state);
            for (_, event) in narrator.events() {
                let sentence = event.sentence(Language::English);
                if !told.contains(&sentence) {
                    told.push(sentence);
                }
            }
        });
        told
    }

    fn has(told: &[String], begins: &str, ends: &str) {
        let is_it = |sentence: &String| sentence.starts_with(begins) && sentence.ends_with(ends);
        assert!(told.iter().any(is_it), "{begins} … {ends}: {told:#?}");
    }

    const OFF: Command = Command::Condition { node: 2, condition: Condition::Off };
    const WELL: Command = Command::Condition { node: 2, condition: Condition::Well };

    #[test]
    fn the_ring_that_adapts_tells_how_it_mends_a_loss() {
        let told = story(Strategy::Adaptive, &[1.0; 4], &[(1.0, OFF), (2.3, WELL)]);
        has(&told, "Machine 3 is switched off with ", ", until the parent misses them");
        has(&told, "The parent has not heard of machine 3 for ", ": the ring closes round it");
        has(&told, "", "that nobody has are given out again to machine 1");
        has(&told, "Machine 3 begins anew and asks the parent to be let in", "");
        has(&told, "The parent hears of machine 3: the ring opens for it", "");
        let bands = told.iter().filter(|sentence| sentence.contains("band of the picture")).count();
        assert_eq!(bands, 1, "whoever is let in gets no band: {told:#?}");
    }

    #[test]
    fn the_ring_that_adapts_tells_whom_it_wakes_and_what_it_copies() {
        let slow = Command::Speed { node: 3, speed: 0.01 };
        let told = story(Strategy::Adaptive, &[1.0; 4], &[(2.25, slow)]);
        has(&told, "Machine ", " traces an atom again that is late at machine 4");
        has(&told, "", "until somebody needs it");
    }

    #[test]
    fn the_articles_ring_tells_what_it_cannot_mend() {
        let told = story(Strategy::Ring, &[1.0; 4], &[(1.0, OFF), (1.5, WELL)]);
        has(&told, "Machine 3 is switched off with ", "which nobody has now");
        has(&told, "Machine 3 is on again, but has forgotten all, and nobody lets it in", "");
        let hung = Command::Condition { node: 2, condition: Condition::Hung };
        let told = story(Strategy::Ring, &[1.0; 4], &[(1.0, hung), (1.5, WELL)]);
        has(&told, "Machine 3 hangs with ", "messages to it wait, offers too");
        has(&told, "Machine 3 goes on where it was", "");
    }
}
