//! Phrases that the sentences on several strategies share.

use crate::balance::NodeId;
use crate::language::{Language, say, word};
use crate::view::state::node_state::NodeState;
use crate::view::text::format::{left_words, node_name};

/// A node and what is known of it.
pub(crate) type Machine<'a> = (NodeId, &'a NodeState);

/// Nobody has atoms, but some are on their way.
pub(crate) fn atoms_on_their_way(language: Language) -> String {
    word!(language, "Atoms are on their way", "Há átomos a caminho").into()
}

/// Nobody has atoms, and none are on their way.
pub(crate) fn machines_wait_for_parent(language: Language) -> String {
    word!(language, "Waiting for the parent", "Esperando pelo pai").into()
}

/// There is but one machine.
pub(crate) fn single_machine(machine: &NodeState, language: Language) -> String {
    let left = left_words(machine.left(), language);
    say!(language, "The only machine computes: {left}", "A única máquina calcula: {left}")
}

/// Of several machines one still computes.
pub(crate) fn last_computing((node, last): Machine<'_>, language: Language) -> String {
    let (name, left) = (node_name(node), left_words(last.left(), language));
    say!(language, "Only {name} still computes: {left}", "Só {name} ainda calcula: {left}")
}

/// So many of all machines or threads compute.
pub(crate) fn computing(some: usize, all: usize, what: &str, language: Language) -> String {
    match some {
        _ if some == all => say!(language, "All {all} {what} compute", "Todas as {all} {what} calculam"),
        1 => say!(language, "1 of {all} {what} computes", "1 de {all} {what} calcula"),
        _ => say!(language, "{some} of {all} {what} compute", "{some} de {all} {what} calculam"),
    }
}

/// Of those that compute one has most left.
pub(crate) fn has_most_atoms(compute: &str, name: u32, language: Language) -> String {
    say!(language, "{compute}; {name} has most left", "{compute}; {name} é a que mais tem")
}
