//! How things stand while nothing happens: who computes, who is slow, and where the ring cannot help, why not.

mod adaptive_ring;
mod deadlock;
pub mod incomplete;
mod stopped;
mod without_ring;

use crate::balance::{NodeId, PIPE_ATOMS};
use crate::language::{Language, say, word};
use crate::view::state::node_state::NodeState;
use crate::view::state::run_state::RunState;
use crate::view::text::format::{atoms_words, fraction, left_words, names, node_name};
use adaptive_ring::standing_adaptive;
use deadlock::{hangs, why as amiss};
use stopped::{all_left, all_still, in_queues, remedy, why};
use without_ring::without_ring;

/// A node and what is known of it.
pub(crate) type Machine<'a> = (NodeId, &'a NodeState);

/// How things stand.
pub(crate) fn standing(state: &RunState, language: Language) -> String {
    if state.sharing.is_adaptive() {
        return standing_adaptive(state, language);
    }
    if let Some(words) = hangs(state, language) {
        return words;
    }
    if !state.sharing.is_ring() {
        return without_ring(state, language);
    }
    let with_atoms = (0..).zip(state.nodes()).filter(|(_, node)| node.left() > 0);
    let (busy, still): (Vec<Machine<'_>>, Vec<Machine<'_>>) = with_atoms.partition(|(_, node)| node.computes());
    if let Some(why) = amiss(state, language).filter(|_| !busy.is_empty()) {
        let compute = computing(busy.len(), state.nodes().len(), word!(language, "machines", "máquinas"), language);
        return say!(language, "{compute}; {why}, and nobody knows it", "{compute}; {why}, e ninguém sabe disso");
    }
    match *busy {
        [] if state.has_atoms_under_way() => under_way(language),
        [] if still.is_empty() => waiting_for_the_parent(language),
        [] if still.len() == state.nodes().len() => all_still(&still, language),
        [] => stuck(state, &still, language),
        [last] if still.is_empty() => alone(state, last, language),
        [(node, _)] => {
            let (name, waiting) = (node_name(node), waiting(&still, language));
            say!(language, "Only {name} computes; {waiting}", "Só {name} calcula; {waiting}")
        }
        _ => several(state, &busy, &still, language),
    }
}

/// Nobody has atoms, but some are on their way.
pub(crate) fn under_way(language: Language) -> String {
    word!(language, "Atoms are on their way", "Há átomos a caminho").into()
}

/// Nobody has atoms, and none are on their way.
pub(crate) fn waiting_for_the_parent(language: Language) -> String {
    word!(language, "Waiting for the parent", "Esperando pelo pai").into()
}

/// There is but one machine.
pub(crate) fn only_one(machine: &NodeState, language: Language) -> String {
    let left = left_words(machine.left(), language);
    say!(language, "The only machine computes: {left}", "A única máquina calcula: {left}")
}

/// Of several machines one still computes.
pub(crate) fn only((node, last): Machine<'_>, language: Language) -> String {
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

/// One machine has all atoms that are left.
fn alone(state: &RunState, (node, last): Machine<'_>, language: Language) -> String {
    let (name, left) = (node_name(node), atoms_words(last.left(), language));
    let retired = retired(state);
    let who = names(&retired, language);
    match last.left() {
        _ if state.nodes().len() == 1 => only_one(last, language),
        1 => say!(
            language,
            "Only {name} still computes its last atom: what is in a pipe is not given away",
            "Só {name} ainda calcula seu último átomo: o que está num pipe não se cede"
        ),
        2..=PIPE_ATOMS => say!(
            language,
            "Only {name} still computes: its last {left} are in its pipe, and what is in a pipe is not given away",
            "Só {name} ainda calcula: seus últimos {left} estão no pipe, e o que está num pipe não se cede"
        ),
        _ if retired.len() == state.nodes().len() - 1 => match &*retired {
            [_] => say!(
                language,
                "{name} still has {left}, but {who} has retired: an offer that came round unused is not made again",
                "{name} ainda tem {left}, mas {who} foi dispensada: oferta que dá a volta sem uso não se repete"
            ),
            _ => say!(
                language,
                "{name} still has {left}, but {who} have retired: an offer that came round unused is not made again",
                "{name} ainda tem {left}, mas {who} foram dispensadas: oferta que dá a volta sem uso não se repete"
            ),
        },
        _ => only((node, last), language),
    }
}

/// Several machines compute.
fn several(state: &RunState, busy: &[Machine<'_>], still: &[Machine<'_>], language: Language) -> String {
    let machines = state.nodes().len();
    let compute = computing(busy.len(), machines, word!(language, "machines", "máquinas"), language);
    // Of equals the first is named.
    let Some((node, last)) = busy.iter().rev().max_by_key(|(_, node)| node.left()) else { return compute };
    let (name, left) = (node_name(*node), atoms_words(last.left(), language));
    let retired = retired(state);
    if !still.is_empty() {
        format!("{compute}; {}", waiting(still, language))
    } else if !retired.is_empty() && retired.len() == machines - busy.len() && last.left() > PIPE_ATOMS {
        let who = names(&retired, language);
        match &*retired {
            [_] => say!(
                language,
                "{compute}; {name} has most left, {left}, but {who} has retired and will not help",
                "{compute}; {name} tem mais, {left}, mas {who} foi dispensada e não vai ajudar"
            ),
            _ => say!(
                language,
                "{compute}; {name} has most left, {left}, but {who} have retired and will not help",
                "{compute}; {name} tem mais, {left}, mas {who} foram dispensadas e não vão ajudar"
            ),
        }
    } else if last.speed < 0.5 {
        let speed = fraction(last.speed);
        say!(
            language,
            "{compute}; {name} is slow ({speed}) and has most left: {left}",
            "{compute}; {name} é lenta ({speed}) e é a que mais tem: {left}"
        )
    } else if busy.len() == machines && busy.iter().all(|(_, node)| node.got.count == 0) {
        say!(language, "{compute} their own atoms", "{compute} seus próprios átomos")
    } else {
        has_most(&compute, name, language)
    }
}

/// Of those that compute one has most left.
pub(crate) fn has_most(compute: &str, name: u32, language: Language) -> String {
    say!(language, "{compute}; {name} has most left", "{compute}; {name} é a que mais tem")
}

/// Machines stand still while others compute, or when nobody does any more.
pub(crate) fn waiting(still: &[Machine<'_>], language: Language) -> String {
    let in_queues = in_queues(still);
    match still {
        [(node, machine)] => {
            let (name, why, left) = (node_name(*node), why(machine, language), atoms_words(machine.left(), language));
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
            let (who, left) = (names(&nodes, language), atoms_words(all_left(still), language));
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

/// Nobody computes, but some could if they had atoms; `still` have all that are left.
fn stuck(state: &RunState, still: &[Machine<'_>], language: Language) -> String {
    let nobody_asks = retired(state).len() + still.len() == state.nodes().len();
    let (left, in_queues) = (all_left(still), in_queues(still));
    let atoms = atoms_words(left, language);
    let remedy = remedy(still, language);
    if let [(node, machine)] = still {
        let (name, why) = (node_name(*node), why(machine, language));
        return match left {
            1 => say!(
                language,
                "Machine {name} {why}; its last atom is in its pipe and stays there: {remedy}",
                "A máquina {name} {why}; seu último átomo está no pipe e fica lá: {remedy}"
            ),
            _ if in_queues == 0 => say!(
                language,
                "Machine {name} {why}; its last {atoms} are in its pipe and stay there: {remedy}",
                "A máquina {name} {why}; seus últimos {atoms} estão no pipe e ficam lá: {remedy}"
            ),
            _ if nobody_asks => say!(
                language,
                "Machine {name} {why} with {atoms}, and nobody asks for them any more: {remedy}",
                "A máquina {name} {why} com {atoms}, e ninguém mais os pede: {remedy}"
            ),
            _ => say!(
                language,
                "Machine {name} {why} with {atoms}: the others offer to take them",
                "A máquina {name} {why} com {atoms}: as outras se oferecem para assumi-los"
            ),
        };
    }
    let machines = still.len();
    if in_queues == 0 || nobody_asks {
        say!(
            language,
            "{machines} machines stand still with {atoms}, and nobody can take them: {remedy}",
            "{machines} máquinas estão paradas com {atoms}, e ninguém pode assumi-los: {remedy}"
        )
    } else {
        say!(
            language,
            "{machines} machines stand still with {atoms}: the others offer to take them",
            "{machines} máquinas estão paradas com {atoms}: as outras se oferecem para assumi-los"
        )
    }
}

fn retired(state: &RunState) -> Vec<NodeId> {
    (0..).zip(state.nodes()).filter(|(_, node)| node.retired).map(|(node, _)| node).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::{Message, Party};
    use crate::record::{Record, RecordKind};
    use crate::time::Time;
    use crate::view::tests::sample_runs;

    /// Atoms left, and speed.
    type Left = (u32, f64);
    const PAUSED: f64 = -1.0;

    /// A run in which machines have so many atoms left, at these speeds.
    fn run(machines: &[Left], retired: &[NodeId]) -> RunState {
        let mut state = RunState::new(&sample_runs::header(&vec![1.0; machines.len()], 900));
        let mut apply = |what| state.apply(&Record { at: Time::ZERO, what });
        for ((id, node), &(left, speed)) in (0..).zip(0..).zip(machines) {
            let (to, message) = (Party::Node(node), Message::Band(100 * id as u32..100 * id as u32 + left));
            let (from, at) = (Party::Parent, Time::ZERO);
            apply(RecordKind::Sent { id, from, to, message, bytes: 0, arrives: at });
            apply(RecordKind::Received { id, by: to });
            apply(if speed == PAUSED { RecordKind::Paused { node } } else { RecordKind::SpeedSet { node, speed } });
        }
        retired.iter().for_each(|&node| apply(RecordKind::Retired { node }));
        state
    }

    /// How things stand there.
    fn stands(machines: &[Left], retired: &[NodeId], language: Language) -> String {
        let words = standing(&run(machines, retired), language);
        assert!(words.chars().count() <= 105, "{} characters: {words}", words.chars().count());
        words
    }

    #[test]
    fn only_those_that_compute_are_counted() {
        let language = Language::English;
        assert_eq!(stands(&[(5, 1.0), (5, 1.0), (5, 1.0)], &[], language), "All 3 machines compute their own atoms");
        assert_eq!(stands(&[(0, 1.0), (5, 1.0), (9, 1.0)], &[], language), "2 of 3 machines compute; 3 has most left");
        assert_eq!(stands(&[(9, 1.0), (0, 1.0), (0, 1.0)], &[], language), "Only 1 still computes: 9 atoms left");
        assert_eq!(stands(&[(9, 1.0)], &[], language), "The only machine computes: 9 atoms left");
        assert_eq!(stands(&[(0, 1.0), (0, 1.0)], &[], language), "Waiting for the parent");
        assert_eq!(
            stands(&[(5, 1.0), (5, 1.0), (9, 0.1)], &[], language),
            "All 3 machines compute; 3 is slow (10 %) and has most left: 9 atoms"
        );
    }

    #[test]
    fn a_machine_that_stands_still_gives_away_its_queue_but_not_its_pipe() {
        let language = Language::English;
        let others = [(5, 1.0), (5, 1.0)];
        let stands = |left, speed| stands(&[others[0], others[1], (left, speed)], &[], language);
        let two = "2 of 3 machines compute; 3";
        assert_eq!(stands(50, PAUSED), format!("{two} is paused: its 50 atoms go to whoever offers help"));
        assert_eq!(stands(50, 0.0), format!("{two} stands still at 0 %: its 50 atoms go to whoever offers help"));
        assert_eq!(stands(2, PAUSED), format!("{two} is paused and keeps the 2 atoms in its pipe"));
        assert_eq!(stands(1, 0.0), format!("{two} stands still at 0 % and keeps the atom in its pipe"));
    }

    #[test]
    fn several_that_stand_still_are_named_together() {
        let language = Language::English;
        let stands = |left| stands(&[(5, 1.0), (left, PAUSED), (left, 0.0)], &[], language);
        assert_eq!(stands(40), "Only 1 computes; 2 and 3 stand still: their 80 atoms go to whoever offers help");
        assert_eq!(stands(2), "Only 1 computes; 2 and 3 stand still and keep what is in their pipes");
    }

    #[test]
    fn whoever_has_retired_does_not_help() {
        let language = Language::English;
        assert_eq!(
            stands(&[(0, 1.0), (0, 1.0), (0, 1.0), (0, 1.0), (40, 0.05)], &[0, 1, 2, 3], language),
            "5 still has 40 atoms, but 1, 2, 3 and 4 have retired: an offer that came round unused is not made again"
        );
        assert_eq!(
            stands(&[(0, 1.0), (40, 1.0)], &[0], language),
            "2 still has 40 atoms, but 1 has retired: an offer that came round unused is not made again"
        );
        assert_eq!(stands(&[(0, 1.0), (0, 1.0), (40, 1.0)], &[0], language), "Only 3 still computes: 40 atoms left");
        assert_eq!(
            stands(&[(0, 1.0), (3, 1.0), (40, 0.1)], &[0], language),
            "2 of 3 machines compute; 3 has most left, 40 atoms, but 1 has retired and will not help"
        );
    }

    #[test]
    fn the_last_atoms_are_in_a_pipe() {
        let language = Language::English;
        let why = "what is in a pipe is not given away";
        for retired in [&[][..], &[0]] {
            let stands = |left| stands(&[(0, 1.0), (left, 0.01)], retired, language);
            assert_eq!(stands(2), format!("Only 2 still computes: its last 2 atoms are in its pipe, and {why}"));
            assert_eq!(stands(1), format!("Only 2 still computes its last atom: {why}"));
        }
    }

    #[test]
    fn a_ring_that_stands_still_says_why_and_what_helps() {
        let language = Language::English;
        let alone = |left, speed, retired: &[NodeId]| stands(&[(left, speed), (0, 1.0), (0, 1.0)], retired, language);
        let pipe = "are in its pipe and stay there";
        assert_eq!(
            alone(2, 0.0, &[]),
            format!("Machine 1 stands still at 0 %; its last 2 atoms {pipe}: raise its speed")
        );
        assert_eq!(alone(2, PAUSED, &[1, 2]), format!("Machine 1 is paused; its last 2 atoms {pipe}: let it go on"));
        assert!(alone(1, PAUSED, &[]).starts_with("Machine 1 is paused; its last atom is in its pipe"));
        assert_eq!(
            alone(90, 0.0, &[1, 2]),
            "Machine 1 stands still at 0 % with 90 atoms, and nobody asks for them any more: raise its speed"
        );
        assert_eq!(alone(90, PAUSED, &[1]), "Machine 1 is paused with 90 atoms: the others offer to take them");
        assert_eq!(
            stands(&[(2, 0.0), (1, PAUSED), (0, 1.0)], &[2], language),
            "2 machines stand still with 3 atoms, and nobody can take them: let them go on, or raise their speed"
        );
        assert_eq!(
            stands(&[(20, 0.0), (2, 0.0), (0, 1.0)], &[], language),
            "2 machines stand still with 22 atoms: the others offer to take them"
        );
    }

    #[test]
    fn all_stand_still() {
        let language = Language::English;
        assert!(
            stands(&[(5, 0.0), (5, 0.0)], &[], language).starts_with("All machines stand still at 0 %: raise a speed")
        );
        assert!(
            stands(&[(5, PAUSED), (5, PAUSED)], &[], language).starts_with("All machines are paused: let one go on")
        );
        assert!(
            stands(&[(5, PAUSED), (5, 0.0)], &[], language)
                .starts_with("All machines stand still: raise a speed or let")
        );
        assert_eq!(stands(&[(5, PAUSED)], &[], language), "The only machine is paused: let it go on");
    }
}
