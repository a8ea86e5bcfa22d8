//! What is said where a run hangs, since a machine has failed: which rings have no remedy, and which has.

use crate::balance::{Condition, NodeId, Party, Remedy, Strategy};
use crate::language::{Language, say, word};
use crate::view::state::atom_state::AtomState;
use crate::view::state::node_state::NodeState;
use crate::view::state::run_state::RunState;
use crate::view::state::scheduler::Sharing;
use crate::view::text::format::{atoms_words, names};

/// Why nothing happens any more, if a machine that failed is why; `None` if something may happen still.
pub(crate) fn hangs(state: &RunState, language: Language) -> Option<String> {
    let answers = |party: Party| match party {
        Party::Parent => true,
        Party::Node(node) => state.nodes().get(usize::from(node)).is_some_and(|of| of.condition == Condition::Well),
    };
    let goes_on = state.finished().is_some()
        || state.nodes().iter().any(|node| node.computes() || node.condition == Condition::Well && node.left() > 0)
        || state.pending.values().any(|flight| answers(flight.to));
    if goes_on {
        return None;
    }
    let why = why(state, language)?;
    if state.has(Remedy::Leases) {
        return (!state.nodes().iter().any(|node| node.condition == Condition::Well)).then(|| {
            say!(
                language,
                "{why}: nobody is left; make one well again",
                "{why}: não resta ninguém; basta recuperar uma"
            )
        });
    }
    let remedy = remedy(state, language);
    Some(say!(language, "The run hangs, since {why}: {remedy}", "A execução parou, pois {why}: {remedy}"))
}

/// The same of a record that ends before the picture is complete.
pub(crate) fn hung(state: &RunState, language: Language) -> Option<String> {
    let (why, remedy) = (why(state, language)?, remedy(state, language));
    Some(if state.has(Remedy::Leases) { why } else { format!("{why}; {remedy}") })
}

/// Who has failed, or what is lost.
pub(crate) fn why(state: &RunState, language: Language) -> Option<String> {
    let failed = |(node, of): (NodeId, &NodeState)| (!of.spare && of.condition != Condition::Well).then_some(node);
    let failed: Vec<NodeId> = (0..).zip(state.nodes()).filter_map(failed).collect();
    let lost = state.atom_states().iter().filter(|place| **place == AtomState::Lost).count() as u32;
    let who = names(&failed, language);
    match *failed {
        [] if lost == 0 => None,
        [] => {
            let atoms = atoms_words(lost, language);
            Some(say!(language, "{atoms} were lost", "{atoms} se perderam"))
        }
        [node] => Some(match state.nodes()[usize::from(node)].condition {
            Condition::Hung => say!(language, "{who} hangs", "{who} travou"),
            Condition::CutOff => say!(language, "{who} is cut off", "{who} está isolada"),
            Condition::Off | Condition::Well => say!(language, "{who} is off", "{who} está desligada"),
        }),
        _ => Some(say!(language, "{who} have failed", "{who} falharam")),
    }
}

/// Who has a remedy for it.
fn remedy(state: &RunState, language: Language) -> &'static str {
    if state.sharing.is_adaptive() {
        word!(language, "without leases this ring has no remedy", "sem prazos este anel não tem remédio")
    } else if state.sharing == Sharing::By(Strategy::Ring) {
        word!(
            language,
            "the article's ring has no remedy, the adaptive ring has",
            "o anel do artigo não tem remédio, o adaptativo tem"
        )
    } else {
        word!(language, "only the adaptive ring has a remedy", "só o anel adaptativo tem remédio")
    }
}

#[cfg(test)]
mod tests {
    use super::super::incomplete::unfinished_words;
    use super::super::standing;
    use super::*;
    use crate::scenario::Command;
    use crate::sim::Sim;
    use crate::time::Time;
    use crate::view::tests::sample_runs;

    /// Where a run by this strategy comes to, of which a machine becomes this after a second.
    fn end(strategy: Strategy, condition: Condition, language: Language) -> RunState {
        let mut header = sample_runs::header(&[1.0; 3], 300);
        header.rules.strategy = strategy;
        let script = [(Time::from_secs(0.5), Command::Condition { node: 1, condition })];
        let mut state = RunState::new(&header);
        let mut before = 0;
        Sim::new(&header, &script, |_| sample_runs::COST).run(&mut |record| {
            state.apply(&record);
            before += usize::from(record.at.secs() < 0.7 && hangs(&state, language).is_some());
        });
        assert_eq!(before, 0, "others go on: {strategy} {condition:?}");
        state
    }

    #[test]
    fn a_ring_that_hangs_says_why_and_who_has_a_remedy() {
        let language = Language::English;
        let remedy = "the article's ring has no remedy, the adaptive ring has";
        for (condition, why) in
            [(Condition::Off, "2 is off"), (Condition::Hung, "2 hangs"), (Condition::CutOff, "2 is cut off")]
        {
            let state = end(Strategy::Ring, condition, language);
            assert_eq!(standing(&state, language), format!("The run hangs, since {why}: {remedy}"));
            let told = unfinished_words(&state, language);
            assert!(
                told.starts_with("The record ends here, with ") && told.ends_with(&format!("{why}; {remedy}")),
                "{told}"
            );
        }
        let told = standing(&end(Strategy::Static, Condition::Off, language), language);
        assert_eq!(told, "The run hangs, since 2 is off: only the adaptive ring has a remedy");
        assert!(end(Strategy::Adaptive, Condition::Off, language).finished().is_some());
    }
}
