//! Machines that stand still because they are paused, stopped or hung: the reason, their atoms, and how to continue.

use super::phrases::Machine;
use crate::balance::{Condition, PIPE_ATOMS};
use crate::language::{Language, say, word};
use crate::view::state::node_state::NodeState;
use crate::view::text::format::{atoms_words, names, node_name};

/// All machines stand still, and all have atoms.
pub(crate) fn all_stand_still(still: &[Machine<'_>], language: Language) -> String {
    match still.iter().filter(|(_, node)| node.paused).count() {
        _ if still.len() == 1 => {
            let (why, remedy) = (stop_reason(still[0].1, language), restart_words(still, language));
            say!(language, "The only machine {why}: {remedy}", "A única máquina {why}: {remedy}")
        }
        0 => word!(
            language,
            "All machines are stopped (0 %): raise a speed, and the work continues",
            "Todas as máquinas estão paradas (0 %): aumente uma velocidade, e o trabalho continua"
        )
        .into(),
        paused if paused == still.len() => word!(
            language,
            "All machines are paused: resume one, and the work continues",
            "Todas as máquinas estão em pausa: retome uma, e o trabalho continua"
        )
        .into(),
        _ => word!(
            language,
            "All machines stand still: raise a speed or resume one, and the work continues",
            "Todas as máquinas estão paradas: aumente uma velocidade ou retome uma, e o trabalho continua"
        )
        .into(),
    }
}

/// Says why a machine stands still.
pub(crate) fn stop_reason(node: &NodeState, language: Language) -> &'static str {
    match node.condition {
        Condition::Hung => word!(language, "hangs", "travou"),
        _ if node.paused => word!(language, "is paused", "está em pausa"),
        _ => word!(language, "is stopped (0 %)", "está parada (0 %)"),
    }
}

/// Says how machines that stand still can continue.
pub(crate) fn restart_words(still: &[Machine<'_>], language: Language) -> &'static str {
    match (still.len(), still.iter().filter(|(_, node)| node.paused).count()) {
        (1, 0) => word!(language, "raise its speed", "aumente sua velocidade"),
        (1, _) => word!(language, "resume it", "retome-a"),
        (_, 0) => word!(language, "raise their speeds", "aumente suas velocidades"),
        (all, paused) if all == paused => word!(language, "resume them", "retome-as"),
        _ => word!(language, "resume them, or raise their speeds", "retome-as, ou aumente suas velocidades"),
    }
}

/// Says what happens to the atoms of machines that stand still, while others compute or at the end of a record.
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
                    "{name} {why}: its {left} go to machines that offer help",
                    "{name} {why}: seus {left} vão para máquinas que oferecem ajuda"
                ),
            }
        }
        _ => {
            let nodes: Vec<_> = still.iter().map(|(node, _)| *node).collect();
            let (who, left) = (names(&nodes, language), atoms_words(atoms_left(still), language));
            if in_queues == 0 {
                say!(
                    language,
                    "{who} stand still and keep the atoms in their pipes",
                    "{who} estão paradas e ficam com os átomos em seus pipes"
                )
            } else {
                say!(
                    language,
                    "{who} stand still: their {left} go to machines that offer help",
                    "{who} estão paradas: seus {left} vão para máquinas que oferecem ajuda"
                )
            }
        }
    }
}

/// Returns how many atoms machines have together.
pub(crate) fn atoms_left(machines: &[Machine<'_>]) -> u32 {
    machines.iter().map(|(_, node)| node.left()).sum()
}

/// Returns how many of their atoms are in queues and could be given away.
pub(crate) fn atoms_in_queues(machines: &[Machine<'_>]) -> u32 {
    machines.iter().map(|(_, node)| node.left().saturating_sub(PIPE_ATOMS)).sum()
}
