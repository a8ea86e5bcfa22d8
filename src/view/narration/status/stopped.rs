//! Machines that stand still: why they do, with how many atoms, and what makes them go on.

use super::phrases::Machine;
use crate::balance::Condition;
use crate::language::{Language, say, word};
use crate::view::narration::happening::PIPE_ATOMS;
use crate::view::state::node_state::NodeState;
use crate::view::text::format::{atoms_words, names, node_name};

/// Every machine stands still, and has atoms.
pub(crate) fn all_stand_still(still: &[Machine<'_>], language: Language) -> String {
    match still.iter().filter(|(_, node)| node.paused).count() {
        _ if still.len() == 1 => {
            let (why, remedy) = (stop_reason(still[0].1, language), restart_words(still, language));
            say!(language, "The only machine {why}: {remedy}", "A única máquina {why}: {remedy}")
        }
        0 => word!(
            language,
            "All machines stand still at 0 %: raise a speed and the work goes on",
            "Todas as máquinas estão paradas a 0 %: basta aumentar uma velocidade"
        )
        .into(),
        paused if paused == still.len() => word!(
            language,
            "All machines are paused: let one go on, and so does the work",
            "Todas as máquinas estão em pausa: basta uma continuar"
        )
        .into(),
        _ => word!(
            language,
            "All machines stand still: raise a speed or let one go on, and so does the work",
            "Todas as máquinas estão paradas: basta aumentar uma velocidade ou uma continuar"
        )
        .into(),
    }
}

/// Why a machine stands still.
pub(crate) fn stop_reason(node: &NodeState, language: Language) -> &'static str {
    match node.condition {
        Condition::Hung => word!(language, "hangs", "travou"),
        _ if node.paused => word!(language, "is paused", "está em pausa"),
        _ => word!(language, "stands still at 0 %", "está parada a 0 %"),
    }
}

/// What makes machines that stand still go on.
pub(crate) fn restart_words(still: &[Machine<'_>], language: Language) -> &'static str {
    match (still.len(), still.iter().filter(|(_, node)| node.paused).count()) {
        (1, 0) => word!(language, "raise its speed", "basta aumentar sua velocidade"),
        (1, _) => word!(language, "let it go on", "basta retomá-la"),
        (_, 0) => word!(language, "raise their speed", "basta aumentar sua velocidade"),
        (all, paused) if all == paused => word!(language, "let them go on", "basta retomá-las"),
        _ => word!(language, "let them go on, or raise their speed", "basta retomá-las, ou aumentar sua velocidade"),
    }
}

/// Machines stand still while others compute, or when nobody does any more.
pub(crate) fn machines_stand_still(still: &[Machine<'_>], language: Language) -> String {
    let in_queues = atoms_in_queues(still);
    match still {
        [(node, machine)] => {
            let (name, why, left) =
                (node_name(*node), stop_reason(machine, language), atoms_words(machine.left(), language));
            match machine.left() {
                1 => say!(
                    language,
                    "{name} {why} and keeps the atom in its pipe",
                    "{name} {why} e fica com o átomo em seu pipe"
                ),
                _ if in_queues == 0 => {
                    say!(
                        language,
                        "{name} {why} and keeps the {left} in its pipe",
                        "{name} {why} e fica com os {left} em seu pipe"
                    )
                }
                _ => say!(
                    language,
                    "{name} {why}: its {left} go to whoever offers help",
                    "{name} {why}: seus {left} vão para quem oferecer ajuda"
                ),
            }
        }
        _ => {
            let nodes: Vec<_> = still.iter().map(|(node, _)| *node).collect();
            let (who, left) = (names(&nodes, language), atoms_words(atoms_left(still), language));
            if in_queues == 0 {
                say!(
                    language,
                    "{who} stand still and keep what is in their pipes",
                    "{who} estão paradas e ficam com o que está em seus pipes"
                )
            } else {
                say!(
                    language,
                    "{who} stand still: their {left} go to whoever offers help",
                    "{who} estão paradas: seus {left} vão para quem oferecer ajuda"
                )
            }
        }
    }
}

/// How many atoms machines have together.
pub(crate) fn atoms_left(machines: &[Machine<'_>]) -> u32 {
    machines.iter().map(|(_, node)| node.left()).sum()
}

/// How many of their atoms could be given away.
pub(crate) fn atoms_in_queues(machines: &[Machine<'_>]) -> u32 {
    machines.iter().map(|(_, node)| node.left().saturating_sub(PIPE_ATOMS)).sum()
}
