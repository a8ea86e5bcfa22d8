//! Sentence for a record that ends before the picture is complete.

use super::deadlock::incomplete_reason;
use super::phrases::Machine;
use super::stopped::{atoms_in_queues, machines_stand_still};
use crate::language::{Language, say};
use crate::view::state::run_state::RunState;
use crate::view::text::format::percent;

/// Says that a record ends before the picture is complete, and why: a failure, or missing atoms that lie in the pipes
/// of machines that stand still.
pub fn unfinished_words(state: &RunState, language: Language) -> String {
    let done = percent(state.done(), state.atoms());
    let ends = say!(
        language,
        "The record ends here, with {done} of the picture",
        "O registro acaba aqui, com {done} da imagem"
    );
    let keepers: Vec<Machine<'_>> = (0..).zip(state.nodes()).filter(|(_, node)| node.left() > 0).collect();
    let missing: u32 = keepers.iter().map(|(_, node)| node.left()).sum();
    let is_kept = !keepers.is_empty()
        && state.done() + missing == state.atoms()
        && keepers.iter().all(|(_, node)| !node.runs())
        && atoms_in_queues(&keepers) == 0;
    if let Some(why) = incomplete_reason(state, language) {
        return format!("{ends}: {why}");
    }
    if is_kept { format!("{ends}: {}", machines_stand_still(&keepers, language)) } else { ends }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Record, RecordKind};
    use crate::time::Time;
    use crate::view::tests::sample_runs;

    #[test]
    fn machine_that_keeps_the_last_atoms_is_named() {
        let language = Language::English;
        let header = sample_runs::header(&[1.0, 1.0, 1.0], 900);
        let mut state = RunState::new(&header);
        let records = sample_runs::records(&header);
        let until = records.iter().rposition(|record| matches!(record.kind, RecordKind::AtomDone { .. }));
        records[..until.expect("atoms")].iter().for_each(|record| state.apply(record));
        assert_eq!(
            unfinished_words(&state, language),
            "The record ends here, with 99 % of the picture",
            "somebody computes"
        );
        let at = Time::from_secs(9e3);
        (0..3).for_each(|node| state.apply(&Record { at, kind: RecordKind::Paused { node } }));
        let words = unfinished_words(&state, language);
        assert!(words.ends_with(" is paused and keeps the atom in its pipe"), "{words}");
    }
}
