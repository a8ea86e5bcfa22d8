//! Sentences for a run that hangs because a machine has failed: the reason, and which strategy recovers from it.

use crate::balance::{Condition, NodeId, Party, Remedy, Scheduler, Strategy};
use crate::language::{Language, say, word};
use crate::view::state::atom_state::AtomState;
use crate::view::state::node_state::NodeState;
use crate::view::state::run_state::RunState;
use crate::view::text::format::{atoms_words, names};

/// Returns the scheduler whose ring or farm would have recovered, if a run hangs for ever after a failure.
pub fn recovering_scheduler(state: &RunState) -> Option<Scheduler> {
    if state.has(Remedy::Leases) || deadlock_words(state, Language::English).is_none() {
        return None;
    }
    let strategy = if state.scheduler.is_farm() { Strategy::FarmLeases } else { Strategy::Adaptive };
    Some(Scheduler::Protocol(strategy))
}

/// Explains why a run hangs after a failure; `None` if the run may still go on.
pub(crate) fn deadlock_words(state: &RunState, language: Language) -> Option<String> {
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
    let why = failure_words(state, language)?;
    if state.has(Remedy::Leases) {
        return (!state.nodes().iter().any(|node| node.condition == Condition::Well)).then(|| {
            say!(
                language,
                "{why}: no machine is left; repair one of them",
                "{why}: não resta nenhuma máquina; recupere uma delas"
            )
        });
    }
    let remedy = recovery_words(state, language);
    Some(say!(language, "The run hangs because {why}: {remedy}", "A execução parou porque {why}: {remedy}"))
}

/// Explains why a record ends before the picture is complete, if a failure is the reason.
pub(crate) fn incomplete_reason(state: &RunState, language: Language) -> Option<String> {
    let (why, remedy) = (failure_words(state, language)?, recovery_words(state, language));
    Some(if state.has(Remedy::Leases) { why } else { format!("{why}; {remedy}") })
}

/// Names the machines that have failed, or the lost atoms; `None` if there are none.
pub(crate) fn failure_words(state: &RunState, language: Language) -> Option<String> {
    let failed = |(node, of): (NodeId, &NodeState)| (!of.spare && of.condition != Condition::Well).then_some(node);
    let failed: Vec<NodeId> = (0..).zip(state.nodes()).filter_map(failed).collect();
    let lost = state.atom_states().iter().filter(|place| **place == AtomState::Lost).count() as u32;
    let who = names(&failed, language);
    // With leases the parent hands them out again.
    let is_lost = lost > 0 && !state.has(Remedy::Leases);
    let with_lost = |who: String| {
        let atoms = atoms_words(lost, language);
        match lost {
            _ if !is_lost => who,
            1 => say!(language, "{who} and {atoms} is lost", "{who}, {atoms} perdido"),
            _ => say!(language, "{who} and {atoms} are lost", "{who}, {atoms} perdidos"),
        }
    };
    match *failed {
        [] if lost == 0 => None,
        [] => {
            let atoms = atoms_words(lost, language);
            Some(match lost {
                1 => say!(language, "{atoms} was lost", "{atoms} se perdeu"),
                _ => say!(language, "{atoms} were lost", "{atoms} se perderam"),
            })
        }
        [node] => Some(with_lost(match state.nodes()[usize::from(node)].condition {
            Condition::Hung => say!(language, "{who} hangs", "{who} travou"),
            Condition::CutOff => say!(language, "{who} is cut off", "{who} está isolada"),
            Condition::Off | Condition::Well => say!(language, "{who} is off", "{who} está desligada"),
        })),
        _ => Some(with_lost(say!(language, "{who} have failed", "{who} falharam"))),
    }
}

/// Says which strategy recovers from a failure.
fn recovery_words(state: &RunState, language: Language) -> &'static str {
    if state.scheduler.is_adaptive() {
        word!(language, "without leases this ring cannot recover", "sem prazos este anel não se recupera")
    } else if state.scheduler == Scheduler::Protocol(Strategy::Ring) {
        word!(
            language,
            "the article's ring cannot recover, the adaptive ring can",
            "o anel do artigo não se recupera, o adaptativo sim"
        )
    } else if state.scheduler.is_farm() {
        word!(
            language,
            "this farm cannot recover, the farm with leases can",
            "esta dinâmica não se recupera, a com prazos sim"
        )
    } else {
        word!(
            language,
            "the adaptive ring and the farm with leases can recover",
            "o adaptativo e a dinâmica com prazos se recuperam"
        )
    }
}
