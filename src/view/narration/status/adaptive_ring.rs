//! Status of the adaptive ring: who computes, who sleeps, who has failed.

use super::deadlock::deadlock_words;
use super::phrases::{
    Machine, atoms_on_their_way, computing, last_computing, machines_wait_for_parent, single_machine, unreachable_atoms,
};
use super::stopped::{all_stand_still, stop_reason};
use crate::balance::{Condition, NodeId, Remedy};
use crate::language::{Language, say, word};
use crate::view::narration::happening::Happening;
use crate::view::state::node_state::NodeState;
use crate::view::state::run_state::RunState;
use crate::view::text::format::{atoms_words, names, node_name};

/// Describes the status of the adaptive ring.
pub(crate) fn adaptive_ring_status(state: &RunState, language: Language) -> String {
    let there: Vec<Machine<'_>> = (0..).zip(state.nodes()).filter(|(_, node)| !node.spare).collect();
    let busy: Vec<Machine<'_>> = there.iter().copied().filter(|(_, node)| node.computes()).collect();
    let compute = match *busy {
        [] => return nobody_computes(state, &there, language),
        [last] if there.len() == 1 => single_machine(last.1, language),
        [last] => last_computing(last, language),
        _ => computing(busy.len(), there.len(), word!(language, "machines", "máquinas"), language),
    };
    match others(state, &there, language) {
        Some(more) => format!("{compute}; {more}"),
        None => compute,
    }
}

/// Describes the machines that do not compute: failures first, then machines that stand still, then sleepers.
fn others(state: &RunState, there: &[Machine<'_>], language: Language) -> Option<String> {
    let those = |is_so: &dyn Fn(&NodeState) -> bool| -> Vec<NodeId> {
        there.iter().filter(|(_, node)| is_so(node)).map(|(node, _)| *node).collect()
    };
    let failed = those(&|node| node.condition != Condition::Well);
    let still = those(&|node| node.left() > 0 && !node.runs());
    let asleep = those(&|node| node.retired && node.left() == 0);
    Some(match (&*failed, &*still, &*asleep) {
        ([], [], []) => return None,
        ([], [], [one]) if !state.has(Remedy::Wake) => {
            let who = node_name(*one);
            say!(language, "{who} has retired", "{who} foi dispensada")
        }
        ([], [], many) if !state.has(Remedy::Wake) => {
            let who = names(many, language);
            say!(language, "{who} have retired", "{who} foram dispensadas")
        }
        ([], [], asleep) => Happening::retired(state, asleep.to_vec()).sentence(language),
        ([], [node, ..], _) => {
            let (name, why) = (node_name(*node), stop_reason(&state.nodes()[usize::from(*node)], language));
            if state.has(Remedy::Copies) {
                say!(
                    language,
                    "{name} {why}: the others take over its atoms and copy the last ones",
                    "{name} {why}: as outras assumem seus átomos e copiam os últimos"
                )
            } else {
                say!(
                    language,
                    "{name} {why}: the others take over the atoms in its queue, but not in its pipe",
                    "{name} {why}: as outras assumem os átomos em sua fila, mas não em seu pipe"
                )
            }
        }
        ([node], ..) => {
            let (name, is_known) = (node_name(*node), state.gone.contains(node));
            if !state.has(Remedy::Leases) {
                say!(language, "{name} has failed, and nobody will notice", "{name} falhou, e ninguém vai notar")
            } else if is_known {
                say!(language, "the ring has closed round {name}", "o anel se fechou sem {name}")
            } else {
                say!(language, "{name} has failed, and nobody has noticed yet", "{name} falhou, e ninguém notou ainda")
            }
        }
        (many, ..) => {
            let who = names(many, language);
            say!(language, "{who} have failed", "{who} falharam")
        }
    })
}

/// Nobody computes, and the picture is not complete.
fn nobody_computes(state: &RunState, there: &[Machine<'_>], language: Language) -> String {
    if let Some(words) = deadlock_words(state, language) {
        return words;
    }
    if let Some(words) = unreachable_atoms(state, there, language) {
        return words;
    }
    let still: Vec<Machine<'_>> = there.iter().copied().filter(|(_, node)| node.left() > 0).collect();
    match *still {
        [] if state.has_atoms_under_way() => atoms_on_their_way(language),
        [] => machines_wait_for_parent(language),
        [..] if still.len() == there.len() => all_stand_still(&still, language),
        [(node, machine), ..] if !state.has(Remedy::Wake) => {
            let (name, why, left) =
                (node_name(node), stop_reason(machine, language), atoms_words(machine.left(), language));
            say!(language, "{name} {why}, with {left}", "{name} {why}, com {left}")
        }
        [(node, machine), ..] => {
            let (name, why) = (node_name(node), stop_reason(machine, language));
            say!(
                language,
                "{name} {why}: it wakes others for its atoms",
                "{name} {why}: ela acorda outras para seus átomos"
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::{Message, Party, Remedies, Strategy};
    use crate::record::{Record, RecordKind};
    use crate::time::Time;
    use crate::view::tests::sample_runs;

    /// The status of a run in which machines have these atoms left, and some sleep or have some condition.
    fn status(left: &[u32], asleep: &[NodeId], conditions: &[(NodeId, Condition)], language: Language) -> String {
        status_with(Remedies::ALL, left, asleep, conditions, language)
    }

    fn status_with(
        remedies: Remedies,
        left: &[u32],
        asleep: &[NodeId],
        conditions: &[(NodeId, Condition)],
        language: Language,
    ) -> String {
        let mut header = sample_runs::header(&vec![1.0; left.len()], 900);
        (header.rules.strategy, header.rules.remedies) = (Strategy::Adaptive, remedies);
        let mut state = RunState::new(&header);
        let mut apply = |kind| state.apply(&Record { at: Time::ZERO, kind });
        for ((id, node), &left) in (0..).zip(0..).zip(left) {
            let (to, message) = (Party::Node(node), Message::Band(100 * id as u32..100 * id as u32 + left));
            apply(RecordKind::Sent { id, from: Party::Parent, to, message, bytes: 0, arrives: Time::ZERO });
            apply(RecordKind::Received { id, by: to });
        }
        asleep.iter().for_each(|&node| apply(RecordKind::Retired { node }));
        conditions.iter().for_each(|&(node, condition)| apply(RecordKind::Condition { node, condition }));
        adaptive_ring_status(&state, language)
    }

    #[test]
    fn sleepers_and_failures_are_told_of() {
        let language = Language::English;
        assert_eq!(status(&[9, 9, 9], &[], &[], language), "All 3 machines compute");
        assert_eq!(status(&[0, 9, 9], &[0], &[], language), "2 of 3 machines compute; 1 sleeps until it is needed");
        assert_eq!(
            status(&[0, 0, 9], &[0, 1], &[], language),
            "Only 3 still computes: 9 atoms left; 1 and 2 sleep until they are needed"
        );
        assert_eq!(
            status(&[9, 9, 9], &[], &[(1, Condition::Hung)], language),
            "2 of 3 machines compute; 2 has failed, and nobody has noticed yet"
        );
        assert_eq!(
            status(&[0, 7, 0], &[0, 2], &[(1, Condition::Off)], language),
            "7 atoms are on unreachable machines; the parent will hand them out again"
        );
        assert_eq!(
            status(&[5, 5], &[], &[(0, Condition::Off), (1, Condition::Hung)], language),
            "1 and 2 have failed: no machine is left; repair one of them"
        );
    }

    #[test]
    fn remedies_that_are_switched_off_are_not_mentioned() {
        let language = Language::English;
        let without = |remedy| Remedies::ALL.without(remedy);
        assert_eq!(
            status_with(without(Remedy::Wake), &[0, 9, 9], &[0], &[], language),
            "2 of 3 machines compute; 1 has retired"
        );
        let off = (1, Condition::Off);
        assert_eq!(
            status_with(without(Remedy::Leases), &[9, 9, 9], &[], &[off], language),
            "2 of 3 machines compute; 2 has failed, and nobody will notice"
        );
        assert_eq!(
            status_with(without(Remedy::Leases), &[0, 9, 0], &[0, 2], &[off], language),
            "The run hangs because 2 is off and 9 atoms are lost: without leases this ring cannot recover"
        );
    }
}
