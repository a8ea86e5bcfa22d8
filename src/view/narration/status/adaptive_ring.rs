//! How things stand in the ring that adapts: who computes, who sleeps, who is not there.

use super::deadlock::hangs;
use super::stopped::{all_still, why};
use super::{Machine, computing, only, under_way};
use crate::balance::{Condition, NodeId, Remedy};
use crate::language::{Language, say, word};
use crate::view::narration::happening::Happening;
use crate::view::state::atom_state::AtomState;
use crate::view::state::node_state::NodeState;
use crate::view::state::run_state::RunState;
use crate::view::text::format::{atoms_words, names, node_name};

/// How things stand.
pub(crate) fn standing_adaptive(state: &RunState, language: Language) -> String {
    let there: Vec<Machine<'_>> = (0..).zip(state.nodes()).filter(|(_, node)| !node.spare).collect();
    let busy: Vec<Machine<'_>> = there.iter().copied().filter(|(_, node)| node.computes()).collect();
    let told = match *busy {
        [] => return nobody_computes(state, &there, language),
        [last] if there.len() == 1 => super::only_one(last.1, language),
        [last] => only(last, language),
        _ => computing(busy.len(), there.len(), word!(language, "machines", "máquinas"), language),
    };
    match besides(state, &there, language) {
        Some(more) => format!("{told}; {more}"),
        None => told,
    }
}

/// What there is to say of those that do not compute: what is amiss first.
fn besides(state: &RunState, there: &[Machine<'_>], language: Language) -> Option<String> {
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
            let (name, why) = (node_name(*node), why(&state.nodes()[usize::from(*node)], language));
            if state.has(Remedy::Copies) {
                say!(
                    language,
                    "{name} {why}: others take its atoms, and copy the last",
                    "{name} {why}: outras assumem seus átomos e copiam o último"
                )
            } else {
                say!(
                    language,
                    "{name} {why}: others take what waits with it, but not what is in its pipe",
                    "{name} {why}: outras assumem o que espera nela, mas não o que está no pipe"
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
                say!(language, "{name} has failed, and nobody knows it yet", "{name} falhou, e ninguém sabe ainda")
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
    if let Some(words) = hangs(state, language) {
        return words;
    }
    let lost = state.atom_states().iter().filter(|place| **place == AtomState::Lost).count() as u32;
    let with_failed = |(_, node): &&Machine<'_>| node.condition != Condition::Well;
    let kept: u32 = there.iter().filter(with_failed).map(|(_, node)| node.left()).sum();
    if lost + kept > 0 && state.has(Remedy::Leases) {
        let atoms = atoms_words(lost + kept, language);
        return say!(
            language,
            "{atoms} are with nobody who answers: the parent gives them out again",
            "{atoms} não estão com quem responda: o pai os dará de novo"
        );
    }
    let still: Vec<Machine<'_>> = there.iter().copied().filter(|(_, node)| node.left() > 0).collect();
    match *still {
        [] if state.has_atoms_under_way() => under_way(language),
        [] => super::waiting_for_the_parent(language),
        [..] if still.len() == there.len() => all_still(&still, language),
        [(node, machine), ..] if !state.has(Remedy::Wake) => {
            let (name, why, left) = (node_name(node), why(machine, language), atoms_words(machine.left(), language));
            say!(language, "{name} {why}, with {left}", "{name} {why}, com {left}")
        }
        [(node, machine), ..] => {
            let (name, why) = (node_name(node), why(machine, language));
            say!(
                language,
                "{name} {why}: it wakes others for its atoms",
                "{name} {why}: acorda outras para seus átomos"
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::standing;
    use super::*;
    use crate::balance::{Message, Party, Remedies, Strategy};
    use crate::record::{Record, RecordKind};
    use crate::time::Time;
    use crate::view::tests::sample_runs;

    /// How things stand where machines have so many atoms left, of which some sleep or are in some condition.
    fn stands(left: &[u32], asleep: &[NodeId], conditions: &[(NodeId, Condition)], language: Language) -> String {
        stands_with(Remedies::ALL, left, asleep, conditions, language)
    }

    fn stands_with(
        remedies: Remedies,
        left: &[u32],
        asleep: &[NodeId],
        conditions: &[(NodeId, Condition)],
        language: Language,
    ) -> String {
        let mut header = sample_runs::header(&vec![1.0; left.len()], 900);
        (header.rules.strategy, header.rules.remedies) = (Strategy::Adaptive, remedies);
        let mut state = RunState::new(&header);
        let mut apply = |what| state.apply(&Record { at: Time::ZERO, what });
        for ((id, node), &left) in (0..).zip(0..).zip(left) {
            let (to, message) = (Party::Node(node), Message::Band(100 * id as u32..100 * id as u32 + left));
            apply(RecordKind::Sent { id, from: Party::Parent, to, message, bytes: 0, arrives: Time::ZERO });
            apply(RecordKind::Received { id, by: to });
        }
        asleep.iter().for_each(|&node| apply(RecordKind::Retired { node }));
        conditions.iter().for_each(|&(node, condition)| apply(RecordKind::Condition { node, condition }));
        standing(&state, language)
    }

    #[test]
    fn sleepers_and_failures_are_told() {
        let language = Language::English;
        assert_eq!(stands(&[9, 9, 9], &[], &[], language), "All 3 machines compute");
        assert_eq!(
            stands(&[0, 9, 9], &[0], &[], language),
            "2 of 3 machines compute; 1 sleeps until somebody needs it"
        );
        assert_eq!(
            stands(&[0, 0, 9], &[0, 1], &[], language),
            "Only 3 still computes: 9 atoms left; 1 and 2 sleep until somebody needs them"
        );
        assert_eq!(
            stands(&[9, 9, 9], &[], &[(1, Condition::Hung)], language),
            "2 of 3 machines compute; 2 has failed, and nobody knows it yet"
        );
        assert_eq!(
            stands(&[0, 7, 0], &[0, 2], &[(1, Condition::Off)], language),
            "7 atoms are with nobody who answers: the parent gives them out again"
        );
        assert_eq!(
            stands(&[5, 5], &[], &[(0, Condition::Off), (1, Condition::Hung)], language),
            "1 and 2 have failed: nobody is left; make one well again"
        );
    }

    #[test]
    fn nothing_is_told_of_remedies_that_are_left_out() {
        let language = Language::English;
        let without = |remedy| Remedies::ALL.without(remedy);
        assert_eq!(
            stands_with(without(Remedy::Wake), &[0, 9, 9], &[0], &[], language),
            "2 of 3 machines compute; 1 has retired"
        );
        let off = (1, Condition::Off);
        assert_eq!(
            stands_with(without(Remedy::Leases), &[9, 9, 9], &[], &[off], language),
            "2 of 3 machines compute; 2 has failed, and nobody will notice"
        );
        assert_eq!(
            stands_with(without(Remedy::Leases), &[0, 9, 0], &[0, 2], &[off], language),
            "The run hangs, since 2 is off: without leases this ring has no remedy"
        );
    }
}
