//! Status of the farm with leases: as of any farm, and in addition what happens to the atoms of machines that fail.

use super::deadlock::deadlock_words;
use super::phrases::{Machine, computing, last_computing, unreachable_atoms};
use super::stopped::stop_reason;
use super::without_ring::status_without_ring;
use crate::balance::{Condition, NodeId};
use crate::language::{Language, say, word};
use crate::view::state::run_state::RunState;
use crate::view::text::format::{names, node_name};

/// Describes the status of the farm with leases.
pub(crate) fn farm_leases_status(state: &RunState, language: Language) -> String {
    if let Some(words) = deadlock_words(state, language) {
        return words;
    }
    let there: Vec<Machine<'_>> = (0..).zip(state.nodes()).filter(|(_, node)| !node.spare).collect();
    let busy: Vec<Machine<'_>> = there.iter().copied().filter(|(_, node)| node.computes()).collect();
    let compute = match *busy {
        [] => {
            return unreachable_atoms(state, &there, language).unwrap_or_else(|| status_without_ring(state, language));
        }
        [last] if there.len() > 1 => last_computing(last, language),
        _ => computing(busy.len(), there.len(), word!(language, "machines", "máquinas"), language),
    };
    match others(&there, language) {
        Some(more) => format!("{compute}; {more}"),
        None => status_without_ring(state, language),
    }
}

/// Describes the machines that have failed, or else a machine that stands still with atoms.
fn others(there: &[Machine<'_>], language: Language) -> Option<String> {
    let failed: Vec<NodeId> =
        there.iter().filter(|(_, node)| node.condition != Condition::Well).map(|(node, _)| *node).collect();
    match *failed {
        [] => {}
        [node] => {
            let name = node_name(node);
            return Some(say!(
                language,
                "{name} has failed: the parent gives its atoms out again",
                "{name} falhou: o pai dá de novo seus átomos"
            ));
        }
        [..] => {
            let who = names(&failed, language);
            return Some(say!(
                language,
                "{who} have failed: the parent gives their atoms out again",
                "{who} falharam: o pai dá de novo seus átomos"
            ));
        }
    }
    let (node, machine) = there.iter().find(|(_, node)| node.left() > 0 && !node.runs())?;
    let (name, why) = (node_name(*node), stop_reason(machine, language));
    Some(say!(
        language,
        "{name} {why}: after a long time the parent gives its atoms out again",
        "{name} {why}: depois de muito tempo o pai dá de novo seus átomos"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::Strategy;
    use crate::record::{Record, RecordKind};
    use crate::scenario::Command;
    use crate::sim::Sim;
    use crate::time::Time;
    use crate::view::tests::sample_runs;

    /// The sentences of a run of three machines in which the second gets this command at 0.5 s.
    fn sentences(command: Command) -> Vec<String> {
        let mut header = sample_runs::header(&[1.0; 3], 300);
        header.rules.strategy = Strategy::FarmLeases;
        header.rules.part = 10;
        let mut state = RunState::new(&header);
        let mut said: Vec<String> = Vec::new();
        let script = [(Time::from_secs(0.5), command)];
        Sim::new(&header, &script, |_| sample_runs::COST).run(&mut |record: Record| {
            state.apply(&record);
            if record.kind != RecordKind::Finished {
                said.push(farm_leases_status(&state, Language::English));
            }
        });
        assert!(state.finished().is_some());
        said
    }

    #[test]
    fn atoms_of_failed_and_stopped_machines_are_given_out_again() {
        let condition = |condition| Command::Condition { node: 1, condition };
        for (command, expected) in [
            (condition(Condition::Off), "; 2 has failed: the parent gives its atoms out again"),
            (condition(Condition::Hung), "; 2 has failed: the parent gives its atoms out again"),
            (Command::Pause { node: 1, paused: true }, "; 2 is paused: after a long time the parent gives its atoms"),
        ] {
            let said = sentences(command);
            assert!(said.iter().any(|sentence| sentence.contains(expected)), "{said:#?}");
            assert!(said.iter().all(|sentence| !sentence.contains("nobody takes over")));
        }
    }
}
