//! Status of a run without offers: fixed bands, a farm, or threads that steal.

use super::phrases::{
    Machine, atoms_on_their_way, computing, has_most_atoms, last_computing, machines_wait_for_parent, single_machine,
};
use super::stopped::{all_stand_still, atoms_left, restart_words, stop_reason};
use crate::balance::{NodeId, Scheduler};
use crate::language::{Language, say, word};
use crate::view::narration::happening::{Happening, is_slow};
use crate::view::state::run_state::RunState;
use crate::view::text::format::{atoms_words, fraction, left_words, names, node_name};

/// Describes the status of a run without offers.
pub(crate) fn status_without_ring(state: &RunState, language: Language) -> String {
    let with_atoms = (0..).zip(state.nodes()).filter(|(_, node)| node.left() > 0);
    let (busy, still): (Vec<Machine<'_>>, Vec<Machine<'_>>) = with_atoms.partition(|(_, node)| node.computes());
    let machines = state.nodes().len();
    let asking: Vec<NodeId> =
        (0..).zip(state.nodes()).filter(|(_, node)| node.awaits_answer).map(|(id, _)| id).collect();
    match (&*busy, &*still) {
        _ if state.is_estimating => Happening::Estimating.sentence(language),
        ([], []) if !asking.is_empty() => requests_wait(&asking, machines, language),
        ([], []) if state.has_atoms_under_way() => atoms_on_their_way(language),
        ([], []) => machines_wait_for_parent(language),
        ([], still) if still.len() == machines => all_stand_still(still, language),
        ([], still) => nobody_computes(still, language),
        ([only], []) if machines == 1 => single_machine(only.1, language),
        ([last], []) if asking.is_empty() && all_is_given_away(state) => all_wait_for(state, *last, language),
        (busy, still) => several(state, busy, still, &asking, language),
    }
}

/// Whether no machine can get more atoms.
fn all_is_given_away(state: &RunState) -> bool {
    !state.scheduler.is_farm() || state.nodes().iter().any(|node| node.retired)
}

/// One machine has all atoms that are left; the others wait.
fn all_wait_for(state: &RunState, (node, last): Machine<'_>, language: Language) -> String {
    let (name, left, speed) = (node_name(node), left_words(last.left(), language), fraction(last.speed));
    if state.scheduler == Scheduler::WorkStealing {
        return last_computing((node, last), language);
    }
    if last.done + last.left() == state.atoms() {
        return say!(
            language,
            "{name} computes alone: {left}; the others have nothing to do",
            "{name} calcula sozinha: {left}; as outras não têm o que fazer"
        );
    }
    let name = if is_slow(last) {
        say!(language, "{name}, which is slow ({speed})", "{name}, que é lenta ({speed})")
    } else {
        name.to_string()
    };
    say!(language, "All wait for {name}: {left}", "Todas esperam por {name}: {left}")
}

/// Some machines compute; `still` stand still with atoms, `asking` have asked for atoms.
fn several(
    state: &RunState,
    busy: &[Machine<'_>],
    still: &[Machine<'_>],
    asking: &[NodeId],
    language: Language,
) -> String {
    let machines = state.nodes().len();
    let what =
        if state.scheduler == Scheduler::WorkStealing { "threads" } else { word!(language, "machines", "máquinas") };
    let compute = computing(busy.len(), machines, what, language);
    if let [(_, machine), ..] = still {
        let (is, they) = match still.len() {
            1 => (stop_reason(machine, language), "its"),
            _ => (word!(language, "stand still", "estão paradas"), "their"),
        };
        let who = names(&still.iter().map(|(node, _)| *node).collect::<Vec<_>>(), language);
        let left = atoms_words(atoms_left(still), language);
        return match &state.scheduler {
            Scheduler::WorkStealing => say!(
                language,
                "{compute}; {who} {is}: {they} {left} can be stolen",
                "{compute}; {who} {is}: as outras podem roubar {left}"
            ),
            _ => say!(
                language,
                "{compute}; {who} {is}, and nobody takes over {they} {left}",
                "{compute}; {who} {is} com {left}, e ninguém os assume"
            ),
        };
    }
    // Among equals, the first.
    let most = busy.iter().rev().max_by_key(|(_, node)| node.left());
    let Some((name, last)) = most.map(|(node, last)| (node_name(*node), last)) else { return compute };
    let (left, speed) = (atoms_words(last.left(), language), fraction(last.speed));
    match &state.scheduler {
        Scheduler::WorkStealing if busy.len() == machines => {
            say!(language, "{compute} their own atoms", "{compute} seus próprios átomos")
        }
        Scheduler::WorkStealing => has_most_atoms(&compute, name, language),
        scheduler if scheduler.is_farm() => match asking {
            [] if !all_is_given_away(state) => {
                say!(
                    language,
                    "{compute}; a machine that has finished asks the parent for more",
                    "{compute}; a máquina que termina pede mais ao pai"
                )
            }
            [] => say!(
                language,
                "{compute} the last atoms; the parent has no more",
                "{compute} seus últimos átomos; o pai não tem mais"
            ),
            some => format!("{compute}; {}", some_wait(some, language)),
        },
        _ if is_slow(last) => say!(
            language,
            "{compute}; {name} is slow ({speed}) and has the most left: {left}, which nobody takes over",
            "{compute}; {name} é lenta ({speed}) e é a que mais tem: {left}, que ninguém assume"
        ),
        _ if busy.len() == machines => say!(
            language,
            "{compute} their own bands; a costly band takes longer",
            "{compute} suas próprias faixas; uma faixa cara demora mais"
        ),
        _ => say!(
            language,
            "{compute}; the others have finished, and nobody shares with them",
            "{compute}; as outras terminaram, e ninguém divide com elas"
        ),
    }
}

/// Nobody computes; machines that stand still have all atoms that are left.
fn nobody_computes(still: &[Machine<'_>], language: Language) -> String {
    let (left, remedy, machines) =
        (atoms_words(atoms_left(still), language), restart_words(still, language), still.len());
    match still {
        [(node, machine)] => {
            let (name, why) = (node_name(*node), stop_reason(machine, language));
            say!(
                language,
                "All wait for {name}, which {why} with {left}: {remedy}",
                "Todas esperam por {name}, que {why} com {left}: {remedy}"
            )
        }
        _ => say!(
            language,
            "All wait for {machines} machines that stand still with {left}: {remedy}",
            "Todas esperam por {machines} máquinas paradas com {left}: {remedy}"
        ),
    }
}

/// Nobody has atoms; some machines have asked for them.
fn requests_wait(asking: &[NodeId], machines: usize, language: Language) -> String {
    match asking {
        _ if machines == 1 => {
            word!(language, "The only machine waits for the parent", "A única máquina espera pelo pai").into()
        }
        all if all.len() == machines => {
            say!(
                language,
                "All {machines} machines wait for the parent",
                "Todas as {machines} máquinas esperam pelo pai"
            )
        }
        some => some_wait(some, language),
    }
}

/// Says that `some` wait for atoms that they have asked for.
fn some_wait(some: &[NodeId], language: Language) -> String {
    let who = names(some, language);
    match some {
        [_] => say!(language, "{who} waits for the parent", "{who} espera pelo pai"),
        _ => say!(language, "{who} wait for the parent", "{who} esperam pelo pai"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::{Message, Party, Strategy};
    use crate::record::{Record, RecordKind};
    use crate::runlog::{Driver, Header};
    use crate::time::Time;
    use crate::view::tests::sample_runs;

    const STATIC: Scheduler = Scheduler::Protocol(Strategy::Static);
    const FARM: Scheduler = Scheduler::Protocol(Strategy::Farm);

    /// The status of a run in which machines have these atoms left at these speeds; some have asked or have retired.
    fn status(
        scheduler: Scheduler,
        machines: &[(u32, f64)],
        asking: &[NodeId],
        retired: &[NodeId],
        language: Language,
    ) -> String {
        let mut header = sample_runs::header(&vec![1.0; machines.len()], 900);
        match scheduler {
            Scheduler::Protocol(strategy) => header.rules.strategy = strategy,
            Scheduler::WorkStealing => header = Header { driver: Driver::WorkStealing, ..header },
        }
        let mut state = RunState::new(&header);
        let mut apply = |kind| state.apply(&Record { at: Time::ZERO, kind });
        let mut send = |id, from, to, message| {
            apply(RecordKind::Sent { id, from, to, message, bytes: 0, arrives: Time::ZERO });
            apply(RecordKind::Received { id, by: to });
        };
        for ((id, node), &(left, _)) in (0..).zip(0..).zip(machines) {
            send(id, Party::Parent, Party::Node(node), Message::Band(100 * id as u32..100 * id as u32 + left));
        }
        (90..).zip(asking).for_each(|(id, &node)| send(id, Party::Node(node), Party::Parent, Message::Request));
        for (node, &(_, speed)) in (0..).zip(machines) {
            apply(RecordKind::SpeedSet { node, speed });
        }
        retired.iter().for_each(|&node| apply(RecordKind::Retired { node }));
        status_without_ring(&state, language)
    }

    #[test]
    fn nobody_takes_over_atoms_of_a_fixed_band() {
        let language = Language::English;
        let status = |machines: &[(u32, f64)]| status(STATIC, machines, &[], &[], language);
        assert_eq!(status(&[(5, 1.0), (5, 1.0)]), "All 2 machines compute their own bands; a costly band takes longer");
        assert_eq!(
            status(&[(0, 1.0), (9, 1.0), (64, 0.1)]),
            "2 of 3 machines compute; 3 is slow (10 %) and has the most left: 64 atoms, which nobody takes over"
        );
        assert_eq!(
            status(&[(0, 1.0), (9, 1.0), (9, 1.0)]),
            "2 of 3 machines compute; the others have finished, and nobody shares with them"
        );
        assert_eq!(status(&[(0, 1.0), (64, 0.1)]), "All wait for 2, which is slow (10 %): 64 atoms left");
        assert_eq!(status(&[(0, 1.0), (64, 1.0)]), "All wait for 2: 64 atoms left");
        assert_eq!(
            status(&[(0, 1.0), (64, 0.0)]),
            "All wait for 2, which is stopped (0 %) with 64 atoms: raise its speed"
        );
        assert_eq!(
            status(&[(9, 1.0), (64, 0.0)]),
            "1 of 2 machines computes; 2 is stopped (0 %), and nobody takes over its 64 atoms"
        );
        assert!(status(&[(9, 0.0), (9, 0.0)]).starts_with("All machines are stopped (0 %)"));
    }

    #[test]
    fn in_a_farm_machines_ask_the_parent() {
        let language = Language::English;
        let busy = [(5, 1.0), (5, 1.0), (5, 1.0)];
        assert_eq!(
            status(FARM, &busy, &[], &[], language),
            "All 3 machines compute; a machine that has finished asks the parent for more"
        );
        let one = [(5, 1.0), (5, 1.0), (0, 1.0)];
        assert_eq!(status(FARM, &one, &[2], &[], language), "2 of 3 machines compute; 3 waits for the parent");
        assert_eq!(
            status(FARM, &one, &[], &[2], language),
            "2 of 3 machines compute the last atoms; the parent has no more"
        );
        let none = [(0, 1.0), (0, 1.0), (0, 1.0)];
        assert_eq!(status(FARM, &none, &[0, 1, 2], &[], language), "All 3 machines wait for the parent");
        assert_eq!(
            status(FARM, &[(0, 1.0), (0, 1.0), (7, 0.1)], &[], &[0, 1], language),
            "All wait for 3, which is slow (10 %): 7 atoms left"
        );
    }

    #[test]
    fn threads_steal_from_stopped_threads_too() {
        let language = Language::English;
        let status = |machines: &[(u32, f64)]| status(Scheduler::WorkStealing, machines, &[], &[], language);
        assert_eq!(status(&[(5, 1.0), (5, 1.0)]), "All 2 threads compute their own atoms");
        assert_eq!(status(&[(0, 1.0), (5, 1.0)]), "Only 2 still computes: 5 atoms left");
        assert_eq!(
            status(&[(5, 1.0), (5, 0.0)]),
            "1 of 2 threads computes; 2 is stopped (0 %): its 5 atoms can be stolen"
        );
    }
}
