//! Status of the article's ring: who computes, who is slow, and why the ring cannot help.

use super::deadlock::failure_words;
use super::phrases::{
    Machine, atoms_on_their_way, computing, has_most_atoms, last_computing, machines_wait_for_parent, single_machine,
};
use super::stopped::{all_stand_still, atoms_in_queues, atoms_left, machines_stand_still, restart_words, stop_reason};
use crate::balance::{NodeId, PIPE_ATOMS};
use crate::language::{Language, say, word};
use crate::view::narration::unreached::Unreached;
use crate::view::state::run_state::RunState;
use crate::view::text::format::{atoms_words, fraction, names, node_name};

/// Describes the status of the article's ring.
pub(crate) fn ring_status(state: &RunState, language: Language) -> String {
    let with_atoms = (0..).zip(state.nodes()).filter(|(_, node)| node.left() > 0);
    let (busy, still): (Vec<Machine<'_>>, Vec<Machine<'_>>) = with_atoms.partition(|(_, node)| node.computes());
    if let Some(why) = failure_words(state, language).filter(|_| !busy.is_empty()) {
        let compute = computing(busy.len(), state.nodes().len(), word!(language, "machines", "máquinas"), language);
        return say!(language, "{compute}; {why}, and nobody notices", "{compute}; {why}, e ninguém percebe");
    }
    if let Some(unreached) = Unreached::of(state).filter(|_| !busy.is_empty()) {
        return unreached.sentence(language);
    }
    match *busy {
        [] if state.has_atoms_under_way() => atoms_on_their_way(language),
        [] if still.is_empty() => machines_wait_for_parent(language),
        [] if still.len() == state.nodes().len() => all_stand_still(&still, language),
        [] => stuck(state, &still, language),
        [last] if still.is_empty() => alone(state, last, language),
        [(node, _)] => {
            let (name, waiting) = (node_name(node), machines_stand_still(&still, language));
            say!(language, "Only {name} computes; {waiting}", "Só {name} calcula; {waiting}")
        }
        _ => several(state, &busy, &still, language),
    }
}

/// One machine has all atoms that are left, and computes.
fn alone(state: &RunState, (node, last): Machine<'_>, language: Language) -> String {
    let (name, left) = (node_name(node), atoms_words(last.left(), language));
    let retired = retired(state);
    let who = names(&retired, language);
    match last.left() {
        _ if state.nodes().len() == 1 => single_machine(last, language),
        1 => say!(
            language,
            "Only {name} still computes, its last atom: atoms in a pipe are never given away",
            "Só {name} ainda calcula, seu último átomo: átomos num pipe nunca são cedidos"
        ),
        2..=PIPE_ATOMS => say!(
            language,
            "Only {name} still computes: its last {left} are in its pipe, and atoms in a pipe are never given away",
            "Só {name} ainda calcula: seus últimos {left} estão no pipe, e átomos num pipe nunca são cedidos"
        ),
        _ if retired.len() == state.nodes().len() - 1 => match &*retired {
            [_] => say!(
                language,
                "{name} still has {left}, but {who} has retired: a retired machine offers no more help",
                "{name} ainda tem {left}, mas {who} foi dispensada: máquina dispensada não oferece mais ajuda"
            ),
            _ => say!(
                language,
                "{name} still has {left}, but {who} have retired: a retired machine offers no more help",
                "{name} ainda tem {left}, mas {who} foram dispensadas: máquina dispensada não oferece mais ajuda"
            ),
        },
        _ => last_computing((node, last), language),
    }
}

/// Several machines compute.
fn several(state: &RunState, busy: &[Machine<'_>], still: &[Machine<'_>], language: Language) -> String {
    let machines = state.nodes().len();
    let compute = computing(busy.len(), machines, word!(language, "machines", "máquinas"), language);
    // Among equals, the first.
    let Some((node, last)) = busy.iter().rev().max_by_key(|(_, node)| node.left()) else { return compute };
    let (name, left) = (node_name(*node), atoms_words(last.left(), language));
    let retired = retired(state);
    if !still.is_empty() {
        format!("{compute}; {}", machines_stand_still(still, language))
    } else if !retired.is_empty() && retired.len() == machines - busy.len() && last.left() > PIPE_ATOMS {
        let who = names(&retired, language);
        match &*retired {
            [_] => say!(
                language,
                "{compute}; {name} has the most left, {left}, but {who} has retired and will not help",
                "{compute}; {name} tem mais, {left}, mas {who} foi dispensada e não vai ajudar"
            ),
            _ => say!(
                language,
                "{compute}; {name} has the most left, {left}, but {who} have retired and will not help",
                "{compute}; {name} tem mais, {left}, mas {who} foram dispensadas e não vão ajudar"
            ),
        }
    } else if last.speed < 0.5 {
        let speed = fraction(last.speed);
        say!(
            language,
            "{compute}; {name} is slow ({speed}) and has the most left: {left}",
            "{compute}; {name} é lenta ({speed}) e é a que mais tem: {left}"
        )
    } else if busy.len() == machines && busy.iter().all(|(_, node)| node.got.count == 0) {
        say!(language, "{compute} their own atoms", "{compute} seus próprios átomos")
    } else {
        has_most_atoms(&compute, name, language)
    }
}

/// Nobody computes: the machines `still` have all atoms that are left; others could compute, but have none.
fn stuck(state: &RunState, still: &[Machine<'_>], language: Language) -> String {
    let nobody_offers = retired(state).len() + still.len() == state.nodes().len();
    let (left, in_queues) = (atoms_left(still), atoms_in_queues(still));
    let atoms = atoms_words(left, language);
    let remedy = restart_words(still, language);
    if let [(node, machine)] = still {
        let (name, why) = (node_name(*node), stop_reason(machine, language));
        return match left {
            1 => say!(
                language,
                "Machine {name} {why}; its last atom is in its pipe and stays there: {remedy}",
                "A máquina {name} {why}; seu último átomo está no pipe e fica lá: {remedy}"
            ),
            _ if in_queues == 0 => say!(
                language,
                "Machine {name} {why}; its last {atoms} are in its pipe and stay there: {remedy}",
                "A máquina {name} {why}; seus últimos {atoms} estão no pipe e ficam lá: {remedy}"
            ),
            _ if nobody_offers => say!(
                language,
                "Machine {name} {why} with {atoms}, and nobody offers help any more: {remedy}",
                "A máquina {name} {why} com {atoms}, e ninguém mais oferece ajuda: {remedy}"
            ),
            _ => say!(
                language,
                "Machine {name} {why} with {atoms}: the others offer to take them",
                "A máquina {name} {why} com {atoms}: as outras se oferecem para assumi-los"
            ),
        };
    }
    let machines = still.len();
    if in_queues == 0 || nobody_offers {
        say!(
            language,
            "{machines} machines stand still with {atoms}, and nobody can take them: {remedy}",
            "{machines} máquinas estão paradas com {atoms}, e ninguém pode assumi-los: {remedy}"
        )
    } else {
        say!(
            language,
            "{machines} machines stand still with {atoms}: the others offer to take them",
            "{machines} máquinas estão paradas com {atoms}: as outras se oferecem para assumi-los"
        )
    }
}

/// Returns the nodes that have retired.
fn retired(state: &RunState) -> Vec<NodeId> {
    (0..).zip(state.nodes()).filter(|(_, node)| node.retired).map(|(node, _)| node).collect()
}
