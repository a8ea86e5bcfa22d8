//! Sentences for failures and for the steps of the recovery.

use std::time::Duration;

use super::failure::Failure;
use crate::balance::{NodeId, Party};
use crate::language::{Language, say, word};
use crate::view::text::format::{atoms_words, duration, machines, node_name};

impl Failure {
    /// Puts it into one sentence without a full stop.
    pub(crate) fn sentence(&self, language: Language) -> String {
        match self {
            &Self::SwitchedOff { node, atoms, is_recovered } => switched_off(language, node, atoms, is_recovered),
            &Self::Hung { node, atoms, is_recovered } => hung(language, node, atoms, is_recovered),
            &Self::CutOff(node) => {
                let name = node_name(node);
                say!(
                    language,
                    "Machine {name} is cut off: it still traces, but no message leaves it or reaches it",
                    "A máquina {name} está isolada: ainda calcula, mas nenhuma mensagem sai dela ou chega a ela"
                )
            }
            &Self::Joined(node) => {
                let name = node_name(node);
                say!(
                    language,
                    "Machine {name} joins: it asks the parent to let it in",
                    "A máquina {name} chega e pede ao pai para entrar"
                )
            }
            &Self::Restarted(node) => {
                let name = node_name(node);
                say!(
                    language,
                    "Machine {name} starts again and asks the parent to let it in",
                    "A máquina {name} recomeça e pede ao pai para entrar"
                )
            }
            &Self::RestartedOutside(node) => {
                let name = node_name(node);
                say!(
                    language,
                    "Machine {name} starts again, but it has forgotten everything, and nobody lets it in",
                    "A máquina {name} recomeça, mas esqueceu tudo, e ninguém a deixa entrar"
                )
            }
            &Self::Reachable(node) => {
                let name = node_name(node);
                say!(language, "Machine {name} can be reached again", "A máquina {name} voltou a ser alcançável")
            }
            &Self::Continues(node) => {
                let name = node_name(node);
                say!(language, "Machine {name} continues where it stopped", "A máquina {name} continua de onde parou")
            }
            Self::Missed { node, silent } => {
                let (name, silent) = (node_name(*node), duration(*silent, language));
                say!(
                    language,
                    "The parent has not heard from machine {name} for {silent}: the ring closes round it",
                    "O pai não recebe nada da máquina {name} há {silent}: o anel se fecha sem ela"
                )
            }
            Self::MissedMany(nodes) => {
                let from = from_machines(nodes, language);
                say!(
                    language,
                    "The parent does not hear from {from}: the ring closes round them",
                    "O pai não recebe nada {from}: o anel se fecha sem elas"
                )
            }
            Self::Returned(nodes) => {
                let from = from_machines(nodes, language);
                match **nodes {
                    [_] => say!(
                        language,
                        "The parent hears from {from} again: the ring opens for it",
                        "O pai volta a receber {from}: o anel se abre para ela"
                    ),
                    _ => say!(
                        language,
                        "The parent hears from {from} again: the ring opens for them",
                        "O pai volta a receber {from}: o anel se abre para elas"
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

/// Names the machines that the parent hears from; in Portuguese with its preposition.
fn from_machines(nodes: &[NodeId], language: Language) -> String {
    let before = word!(language, ["machine ", "machines ", ""], ["da máquina ", "das máquinas ", "de "]);
    machines(nodes, before, language)
}

fn hung(language: Language, node: NodeId, atoms: u32, is_recovered: bool) -> String {
    let (name, left) = (node_name(node), atoms_words(atoms, language));
    if is_recovered {
        say!(
            language,
            "Machine {name} hangs: it neither traces nor answers, and the parent will notice",
            "A máquina {name} travou: não calcula nem responde, e o pai vai notar"
        )
    } else {
        say!(
            language,
            "Machine {name} hangs with {left}: messages to it wait, and offers too",
            "A máquina {name} travou com {left}: as mensagens para ela esperam, e as ofertas também"
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
                "Messages from machine {from} to machine {to} are held up for {by}",
                "As mensagens da máquina {from} à máquina {to} ficam retidas por {by}"
            )
        }
        (Party::Node(from), Party::Parent) => {
            let from = node_name(from);
            say!(
                language,
                "Messages from machine {from} to the parent are held up for {by}",
                "As mensagens da máquina {from} ao pai ficam retidas por {by}"
            )
        }
        (Party::Parent, Party::Node(to)) => {
            let to = node_name(to);
            say!(
                language,
                "Messages from the parent to machine {to} are held up for {by}",
                "As mensagens do pai à máquina {to} ficam retidas por {by}"
            )
        }
        (Party::Parent, Party::Parent) => String::new(),
    }
}

fn handed_out_again(language: Language, to: &[NodeId], atoms: u32) -> String {
    let what = atoms_words(atoms, language);
    let before = word!(language, ["machine ", "machines ", ""], ["à máquina ", "às máquinas ", "a "]);
    let to = machines(to, before, language);
    match atoms {
        1 => say!(
            language,
            "{what} is missing: the parent hands it out again to {to}",
            "Falta {what}: o pai o dá de novo {to}"
        ),
        _ => say!(
            language,
            "{what} are missing: the parent hands them out again to {to}",
            "Faltam {what}: o pai os dá de novo {to}"
        ),
    }
}

fn copies(language: Language, from: NodeId, to: &[NodeId], atoms: u32) -> String {
    let late = node_name(from);
    let before = word!(language, ["Machine ", "Machines ", ""], ["A máquina ", "As máquinas ", ""]);
    let who = machines(to, before, language);
    match (to, atoms) {
        ([_], 1) => say!(
            language,
            "{who} traces a copy of an atom that is late at machine {late}",
            "{who} calcula uma cópia de um átomo atrasado na máquina {late}"
        ),
        ([_], _) => say!(
            language,
            "{who} traces copies of {atoms} atoms that are late at machine {late}",
            "{who} calcula cópias de {atoms} átomos atrasados na máquina {late}"
        ),
        _ => say!(
            language,
            "{who} trace copies of {atoms} atoms that are late at machine {late}",
            "{who} calculam cópias de {atoms} átomos atrasados na máquina {late}"
        ),
    }
}

fn wakes(language: Language, from: NodeId, to: &[NodeId]) -> String {
    let before = word!(language, ["machine ", "machines ", ""], ["a máquina ", "as máquinas ", ""]);
    let (from, whom) = (node_name(from), machines(to, before, language));
    say!(language, "Machine {from} needs help and wakes {whom}", "A máquina {from} precisa de ajuda e acorda {whom}")
}

fn switched_off(language: Language, node: NodeId, atoms: u32, is_recovered: bool) -> String {
    let (name, took) = (node_name(node), atoms_words(atoms, language));
    let (them, los) = if atoms == 1 { ("it", "lo") } else { ("them", "los") };
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
            "Machine {name} is switched off with {took}: the parent will hand {them} out again",
            "A máquina {name} foi desligada com {took}: o pai vai dá-{los} de novo"
        ),
        _ => say!(
            language,
            "Machine {name} is switched off with {took}, and nobody will trace {them}",
            "A máquina {name} foi desligada com {took}, e ninguém vai calculá-{los}"
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

    /// All sentences of the list of events, in a run of four machines with `script`.
    fn story(strategy: Strategy, speeds: &[f64], script: &[(f64, Command)]) -> Vec<String> {
        let mut header = sample_runs::header(speeds, 900);
        header.rules.part = strategy.usual_part(header.division, speeds.len());
        header.rules.strategy = strategy;
        let script: Vec<_> = script.iter().map(|&(at, command)| (Time::from_secs(at), command)).collect();
        let (mut state, mut narrator, mut sentences) = (RunState::new(&header), Narrator::default(), Vec::new());
        Sim::new(&header, &script, |_| sample_runs::COST).run(&mut |record| {
            state.apply(&record);
            narrator.apply(&record, &state);
            for (_, event) in narrator.events() {
                let sentence = event.sentence(Language::English);
                if !sentences.contains(&sentence) {
                    sentences.push(sentence);
                }
            }
        });
        sentences
    }

    fn has(sentences: &[String], begins: &str, ends: &str) {
        let is_it = |sentence: &String| sentence.starts_with(begins) && sentence.ends_with(ends);
        assert!(sentences.iter().any(is_it), "{begins} … {ends}: {sentences:#?}");
    }

    const OFF: Command = Command::Condition { node: 2, condition: Condition::Off };
    const WELL: Command = Command::Condition { node: 2, condition: Condition::Well };

    #[test]
    fn adaptive_ring_tells_how_it_recovers() {
        let sentences = story(Strategy::Adaptive, &[1.0; 4], &[(1.0, OFF), (2.3, WELL)]);
        has(&sentences, "Machine 3 is switched off with ", " out again");
        has(&sentences, "The parent has not heard from machine 3 for ", ": the ring closes round it");
        has(&sentences, "", " are missing: the parent hands them out again to machine 1");
        has(&sentences, "Machine 3 starts again and asks the parent to let it in", "");
        has(&sentences, "The parent hears from machine 3 again: the ring opens for it", "");
        let bands = sentences.iter().filter(|sentence| sentence.contains("band of the picture")).count();
        assert_eq!(bands, 1, "a machine that is let in gets no band: {sentences:#?}");
    }

    #[test]
    fn farm_with_leases_tells_how_it_recovers() {
        let sentences = story(Strategy::FarmLeases, &[1.0; 4], &[(1.0, OFF), (2.0, WELL)]);
        has(&sentences, "Machine 3 is switched off with ", " out again");
        has(&sentences, "Machine 3 starts again and asks the parent to let it in", "");
        let bands = sentences.iter().filter(|sentence| sentence.contains("a first part")).count();
        assert_eq!(bands, 1, "a machine that is let in gets no first part: {sentences:#?}");
        assert!(sentences.iter().any(|sentence| sentence.contains("out again to machine")), "{sentences:#?}");
    }

    #[test]
    fn adaptive_ring_tells_of_sleepers_and_copies() {
        let slow = Command::Speed { node: 3, speed: 0.01 };
        let sentences = story(Strategy::Adaptive, &[1.0; 4], &[(2.25, slow)]);
        has(&sentences, "Machine ", " traces a copy of an atom that is late at machine 4");
        has(&sentences, "", " sleeps until it is needed");
    }

    #[test]
    fn articles_ring_tells_what_it_cannot_recover() {
        let sentences = story(Strategy::Ring, &[1.0; 4], &[(1.0, OFF), (1.5, WELL)]);
        has(&sentences, "Machine 3 is switched off with ", ", and nobody will trace them");
        has(&sentences, "Machine 3 starts again, but it has forgotten everything, and nobody lets it in", "");
        let hung = Command::Condition { node: 2, condition: Condition::Hung };
        let sentences = story(Strategy::Ring, &[1.0; 4], &[(1.0, hung), (1.5, WELL)]);
        has(&sentences, "Machine 3 hangs with ", "messages to it wait, and offers too");
        has(&sentences, "Machine 3 continues where it stopped", "");
    }
}
