//! What befalls machines and messages in a sentence, and what the ring that adapts does about it.

use std::time::Duration;

use crate::balance::{Condition, NodeId, Party, Remedy};
use crate::language::{say, word};
use crate::time::Time;
use crate::view::state::node_state::NodeState;
use crate::view::state::run_state::RunState;
use crate::view::text::format::{atoms_words, duration, names, node_name};

/// What has become of a machine, and what that means where atoms are shared so.
pub(crate) fn condition(state: &RunState, node: NodeId) -> String {
    let name = node_name(node);
    let Some(machine) = state.nodes().get(usize::from(node)) else { return String::new() };
    let is_mended = state.has(Remedy::Leases);
    match (machine.condition, machine.condition_before) {
        (Condition::Off, _) => switched_off(machine, name, is_mended),
        (Condition::Hung, _) if is_mended => say!(
            "Machine {name} hangs, neither traces nor answers: the parent will miss it",
            "A máquina {name} travou, não calcula nem responde: o pai vai notar"
        ),
        (Condition::Hung, _) => {
            let left = atoms_words(machine.left());
            say!(
                "Machine {name} hangs with {left}: what is sent to it waits, offers too",
                "A máquina {name} travou com {left}: o que chega a ela espera, ofertas também"
            )
        }
        (Condition::CutOff, _) => say!(
            "Machine {name} is cut off: it traces on, but nothing comes from it or to it",
            "A máquina {name} está isolada: calcula, mas nada sai dela nem chega a ela"
        ),
        (Condition::Well, Condition::Off) if state.sharing.is_adaptive() && machine.heard.is_none() => {
            say!(
                "Machine {name} joins: it asks the parent to be let in",
                "A máquina {name} chega e pede ao pai para entrar"
            )
        }
        (Condition::Well, Condition::Off) if state.sharing.is_adaptive() => say!(
            "Machine {name} begins anew and asks the parent to be let in",
            "A máquina {name} recomeça e pede ao pai para entrar"
        ),
        (Condition::Well, Condition::Off) => say!(
            "Machine {name} is on again, but has forgotten all, and nobody lets it in",
            "A máquina {name} voltou, mas esqueceu tudo, e ninguém a deixa entrar"
        ),
        (Condition::Well, Condition::CutOff) => {
            say!("Machine {name} can be reached again", "A máquina {name} voltou a ser alcançável")
        }
        (Condition::Well, _) => say!("Machine {name} goes on where it was", "A máquina {name} continua de onde estava"),
    }
}

/// The parent says that others are gone than before; `None` if it says the same again.
pub(crate) fn ring_changed(state: &RunState, now: Time) -> Option<String> {
    let unlike = |all: &[NodeId], others: &[NodeId]| -> Vec<NodeId> {
        all.iter().copied().filter(|node| !others.contains(node)).collect()
    };
    let (gone, back) = (unlike(&state.gone, &state.gone_before), unlike(&state.gone_before, &state.gone));
    let who = names(if gone.is_empty() { &back } else { &gone });
    Some(match (&*gone, &*back) {
        ([], []) => return None,
        ([node], _) => {
            let heard = state.nodes().get(usize::from(*node)).and_then(|of| of.heard).unwrap_or_default();
            let silent = duration(now.since(heard));
            say!(
                "The parent has not heard of machine {who} for {silent}: the ring closes round it",
                "O pai não ouve a máquina {who} há {silent}: o anel se fecha sem ela"
            )
        }
        ([_, ..], _) => say!(
            "The parent does not hear of machines {who}: the ring closes round them",
            "O pai não ouve as máquinas {who}: o anel se fecha sem elas"
        ),
        ([], [_]) => say!(
            "The parent hears of machine {who}: the ring opens for it",
            "O pai ouve a máquina {who}: o anel se abre para ela"
        ),
        ([], _) => say!(
            "The parent hears of machines {who}: the ring opens for them",
            "O pai ouve as máquinas {who}: o anel se abre para elas"
        ),
    })
}

/// The way from one party to another is held up.
pub(crate) fn delayed((from, to): (Party, Party), by: Duration) -> String {
    let by = duration(by);
    match (from, to) {
        (Party::Node(from), Party::Node(to)) => {
            let (from, to) = (node_name(from), node_name(to));
            say!(
                "What machine {from} sends to machine {to} is held up for {by}",
                "O que a máquina {from} manda à máquina {to} fica retido por {by}"
            )
        }
        (Party::Node(from), Party::Parent) => {
            let from = node_name(from);
            say!(
                "What machine {from} sends to the parent is held up for {by}",
                "O que a máquina {from} manda ao pai fica retido por {by}"
            )
        }
        (Party::Parent, Party::Node(to)) => {
            let to = node_name(to);
            say!(
                "What the parent sends to machine {to} is held up for {by}",
                "O que o pai manda à máquina {to} fica retido por {by}"
            )
        }
        (Party::Parent, Party::Parent) => String::new(),
    }
}

/// The parent gives atoms out again that nobody has.
pub(crate) fn given_out(to: &[NodeId], atoms: u32) -> String {
    let (who, what) = (names(to), atoms_words(atoms));
    let machine = if let [_] = to { word!("machine", "à máquina") } else { word!("machines", "às máquinas") };
    match atoms {
        1 => say!(
            "{what} that nobody has is given out again to {machine} {who}",
            "{what} que ninguém tem é dado de novo {machine} {who}"
        ),
        _ => say!(
            "{what} that nobody has are given out again to {machine} {who}",
            "{what} que ninguém tem são dados de novo {machine} {who}"
        ),
    }
}

/// Atoms are late at a machine, and others trace them as well.
pub(crate) fn copies(from: NodeId, to: &[NodeId], atoms: u32) -> String {
    let (late, who) = (node_name(from), names(to));
    match (to, atoms) {
        ([_], 1) => say!(
            "Machine {who} traces an atom again that is late at machine {late}",
            "A máquina {who} calcula de novo um átomo que tarda na máquina {late}"
        ),
        ([_], _) => say!(
            "Machine {who} traces {atoms} atoms again that are late at machine {late}",
            "A máquina {who} calcula de novo {atoms} átomos que tardam na máquina {late}"
        ),
        _ => say!(
            "Machines {who} trace {atoms} atoms again that are late at machine {late}",
            "As máquinas {who} calculam de novo {atoms} átomos que tardam na máquina {late}"
        ),
    }
}

/// A machine has atoms to give, and wakes others that sleep.
pub(crate) fn wakes(from: NodeId, to: &[NodeId]) -> String {
    let (from, who) = (node_name(from), names(to));
    match to {
        [_] => say!(
            "Machine {from} needs help and wakes machine {who}",
            "A máquina {from} precisa de ajuda e acorda a máquina {who}"
        ),
        _ => say!(
            "Machine {from} needs help and wakes machines {who}",
            "A máquina {from} precisa de ajuda e acorda as máquinas {who}"
        ),
    }
}

fn switched_off(machine: &NodeState, name: u32, is_mended: bool) -> String {
    let took = atoms_words(machine.took);
    match machine.took {
        0 => {
            say!("Machine {name} is switched off; it had no atoms", "A máquina {name} foi desligada; não tinha átomos")
        }
        _ if is_mended => say!(
            "Machine {name} is switched off with {took}, until the parent misses them",
            "A máquina {name} foi desligada com {took}, até que o pai dê por falta"
        ),
        _ => say!(
            "Machine {name} is switched off with {took}, which nobody has now",
            "A máquina {name} foi desligada com {took}, que agora ninguém tem"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::super::narrator::Narrator;
    use super::*;
    use crate::balance::Strategy;
    use crate::scenario::Command;
    use crate::sim::Sim;
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
            for (_, sentence) in narrator.events() {
                if !told.iter().any(|other| other == sentence) {
                    told.push(sentence.to_owned());
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
        has(&told, "Machine 3 hangs with ", "what is sent to it waits, offers too");
        has(&told, "Machine 3 goes on where it was", "");
    }
}
