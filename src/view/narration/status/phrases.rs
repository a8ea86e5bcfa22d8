//! Phrases that the sentences of several strategies share.

use crate::balance::{Condition, NodeId, Remedy};
use crate::language::{Language, say, word};
use crate::view::state::atom_state::AtomState;
use crate::view::state::node_state::NodeState;
use crate::view::state::run_state::RunState;
use crate::view::text::format::{atoms_words, left_words, node_name};

/// A node and its state.
pub(crate) type Machine<'a> = (NodeId, &'a NodeState);

/// Nobody has atoms; some are on their way.
pub(crate) fn atoms_on_their_way(language: Language) -> String {
    word!(language, "Atoms are on their way", "Há átomos a caminho").into()
}

/// Nobody has atoms; none are on their way.
pub(crate) fn machines_wait_for_parent(language: Language) -> String {
    word!(language, "The machines wait for the parent", "As máquinas esperam pelo pai").into()
}

/// The run has only one machine.
pub(crate) fn single_machine(machine: &NodeState, language: Language) -> String {
    let left = left_words(machine.left(), language);
    say!(language, "The only machine computes: {left}", "A única máquina calcula: {left}")
}

/// Only one of several machines still computes.
pub(crate) fn last_computing((node, last): Machine<'_>, language: Language) -> String {
    let (name, left) = (node_name(node), left_words(last.left(), language));
    say!(language, "Only {name} still computes: {left}", "Só {name} ainda calcula: {left}")
}

/// Says how many of all machines or threads compute.
pub(crate) fn computing(some: usize, all: usize, what: &str, language: Language) -> String {
    match some {
        1 if all == 1 => word!(language, "The only one computes", "A única calcula").into(),
        _ if some == all => say!(language, "All {all} {what} compute", "Todas as {all} {what} calculam"),
        1 => say!(language, "1 of {all} {what} computes", "1 de {all} {what} calcula"),
        _ => say!(language, "{some} of {all} {what} compute", "{some} de {all} {what} calculam"),
    }
}

/// Says that nobody computes because the missing atoms are on machines that have failed, of those in the run; `None`
/// if that is not so, or if the parent will not hand them out again.
pub(crate) fn unreachable_atoms(state: &RunState, there: &[Machine<'_>], language: Language) -> Option<String> {
    let lost = state.atom_states().iter().filter(|place| **place == AtomState::Lost).count() as u32;
    let with_failed = |(_, node): &&Machine<'_>| node.condition != Condition::Well;
    let kept: u32 = there.iter().filter(with_failed).map(|(_, node)| node.left()).sum();
    if lost + kept == 0 || !state.has(Remedy::Leases) {
        return None;
    }
    let atoms = atoms_words(lost + kept, language);
    Some(match lost + kept {
        1 => say!(
            language,
            "{atoms} is on an unreachable machine; the parent will hand it out again",
            "{atoms} está numa máquina inacessível; o pai vai dá-lo de novo"
        ),
        _ => say!(
            language,
            "{atoms} are on unreachable machines; the parent will hand them out again",
            "{atoms} estão em máquinas inacessíveis; o pai vai dá-los de novo"
        ),
    })
}

/// Adds to `compute` the machine that has the most atoms left.
pub(crate) fn has_most_atoms(compute: &str, name: u32, language: Language) -> String {
    say!(language, "{compute}; {name} has the most left", "{compute}; {name} é a que mais tem")
}
