//! How things stand while nothing happens: who computes, who is slow, and where the ring cannot help, why not.

use super::node::NodeState;
use super::state::RunState;
use super::without_ring::without_ring;
use super::words::{atoms_words, fraction, names, node_name};
use crate::balance::NodeId;

/// What a machine's pipe holds at most: more than that lies in its queue. What is in a pipe is never given away.
pub(super) const PIPE: u32 = 2;

/// A node and what is known of it.
pub(super) type Machine<'a> = (NodeId, &'a NodeState);

/// How things stand.
pub(super) fn standing(state: &RunState) -> String {
    if !state.sharing.is_ring() {
        return without_ring(state);
    }
    let with_atoms = (0..).zip(state.nodes()).filter(|(_, node)| node.left() > 0);
    let (busy, still): (Vec<Machine<'_>>, Vec<Machine<'_>>) = with_atoms.partition(|(_, node)| node.computes());
    match *busy {
        [] if state.has_atoms_under_way() => "Atoms are on their way".into(),
        [] if still.is_empty() => "Waiting for the parent".into(),
        [] if still.len() == state.nodes().len() => all_still(&still),
        [] => stuck(state, &still),
        [last] if still.is_empty() => alone(state, last),
        [(node, _)] => format!("Only {} computes; {}", node_name(node), waiting(&still)),
        _ => several(state, &busy, &still),
    }
}

/// One machine has all atoms that are left.
fn alone(state: &RunState, (node, last): Machine<'_>) -> String {
    let (name, left) = (node_name(node), atoms_words(last.left()));
    let retired = retired(state);
    match last.left() {
        _ if state.nodes().len() == 1 => format!("The only machine computes: {left} left"),
        1 => format!("Only {name} still computes its last atom: what is in a pipe is not given away"),
        2..=PIPE => {
            format!(
                "Only {name} still computes: its last {left} are in its pipe, and what is in a pipe is not given away"
            )
        }
        _ if retired.len() == state.nodes().len() - 1 => format!(
            "{name} still has {left}, but {} {} retired: an offer that came round unused is not made again",
            names(&retired),
            if retired.len() == 1 { "has" } else { "have" },
        ),
        _ => format!("Only {name} still computes: {left} left"),
    }
}

/// Several machines compute.
fn several(state: &RunState, busy: &[Machine<'_>], still: &[Machine<'_>]) -> String {
    let machines = state.nodes().len();
    let compute = match busy.len() {
        all if all == machines => format!("All {machines} machines compute"),
        some => format!("{some} of {machines} machines compute"),
    };
    // Of equals the first is named.
    let Some((node, last)) = busy.iter().rev().max_by_key(|(_, node)| node.left()) else { return compute };
    let (name, left) = (node_name(*node), atoms_words(last.left()));
    let retired = retired(state);
    if !still.is_empty() {
        format!("{compute}; {}", waiting(still))
    } else if !retired.is_empty() && retired.len() == machines - busy.len() && last.left() > PIPE {
        let (who, help) = (names(&retired), if retired.len() == 1 { "has retired" } else { "have retired" });
        format!("{compute}; {name} has most left, {left}, but {who} {help} and will not help")
    } else if last.speed < 0.5 {
        format!("{compute}; {name} is slow ({}) and has most left: {left}", fraction(last.speed))
    } else if busy.len() == machines && busy.iter().all(|(_, node)| node.got.count == 0) {
        format!("{compute} their own atoms")
    } else {
        format!("{compute}; {name} has most left")
    }
}

/// Machines stand still while others compute.
fn waiting(still: &[Machine<'_>]) -> String {
    let in_queues = in_queues(still);
    match still {
        [(node, machine)] => {
            let (name, why) = (node_name(*node), why(machine));
            match machine.left() {
                1 => format!("{name} {why} and keeps the atom in its pipe"),
                left if in_queues == 0 => format!("{name} {why} and keeps the {} in its pipe", atoms_words(left)),
                left => format!("{name} {why}: its {} go to whoever offers help", atoms_words(left)),
            }
        }
        _ => {
            let nodes: Vec<_> = still.iter().map(|(node, _)| *node).collect();
            let who = names(&nodes);
            if in_queues == 0 {
                format!("{who} stand still and keep what is in their pipes")
            } else {
                format!("{who} stand still: their {} go to whoever offers help", atoms_words(all_left(still)))
            }
        }
    }
}

/// Nobody computes, but some could if they had atoms; `still` have all that are left.
fn stuck(state: &RunState, still: &[Machine<'_>]) -> String {
    let nobody_asks = retired(state).len() + still.len() == state.nodes().len();
    let (left, in_queues) = (all_left(still), in_queues(still));
    let atoms = atoms_words(left);
    let remedy = remedy(still);
    if let [(node, machine)] = still {
        let (name, why) = (node_name(*node), why(machine));
        return match left {
            1 => format!("Machine {name} {why}; its last atom is in its pipe and stays there: {remedy}"),
            _ if in_queues == 0 => {
                format!("Machine {name} {why}; its last {atoms} are in its pipe and stay there: {remedy}")
            }
            _ if nobody_asks => {
                format!("Machine {name} {why} with {atoms}, and nobody asks for them any more: {remedy}")
            }
            _ => format!("Machine {name} {why} with {atoms}: the others offer to take them"),
        };
    }
    let machines = still.len();
    if in_queues == 0 || nobody_asks {
        format!("{machines} machines stand still with {atoms}, and nobody can take them: {remedy}")
    } else {
        format!("{machines} machines stand still with {atoms}: the others offer to take them")
    }
}

/// Every machine stands still, and has atoms.
pub(super) fn all_still(still: &[Machine<'_>]) -> String {
    match still.iter().filter(|(_, node)| node.paused).count() {
        _ if still.len() == 1 => format!("The only machine {}: {}", why(still[0].1), remedy(still)),
        0 => "All machines stand still at 0 %: raise a speed and the work goes on".into(),
        paused if paused == still.len() => "All machines are paused: let one go on, and so does the work".into(),
        _ => "All machines stand still: raise a speed or let one go on, and so does the work".into(),
    }
}

/// Why a machine stands still.
pub(super) fn why(node: &NodeState) -> &'static str {
    if node.paused { "is paused" } else { "stands still at 0 %" }
}

/// What makes machines that stand still go on.
pub(super) fn remedy(still: &[Machine<'_>]) -> &'static str {
    match (still.len(), still.iter().filter(|(_, node)| node.paused).count()) {
        (1, 0) => "raise its speed",
        (1, _) => "let it go on",
        (_, 0) => "raise their speed",
        (all, paused) if all == paused => "let them go on",
        _ => "let them go on, or raise their speed",
    }
}

fn retired(state: &RunState) -> Vec<NodeId> {
    (0..).zip(state.nodes()).filter(|(_, node)| node.retired).map(|(node, _)| node).collect()
}

/// How many atoms machines have together.
pub(super) fn all_left(machines: &[Machine<'_>]) -> u32 {
    machines.iter().map(|(_, node)| node.left()).sum()
}

/// How many of their atoms could be given away.
fn in_queues(machines: &[Machine<'_>]) -> u32 {
    machines.iter().map(|(_, node)| node.left().saturating_sub(PIPE)).sum()
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;
    use crate::balance::{Message, Party};
    use crate::record::{Record, What};
    use crate::time::Time;

    /// Atoms left, and speed.
    type Left = (u32, f64);
    const PAUSED: f64 = -1.0;

    /// A run in which machines have so many atoms left, at these speeds.
    fn run(machines: &[Left], retired: &[NodeId]) -> RunState {
        let mut state = RunState::new(&sample::header(&vec![1.0; machines.len()], 900));
        let mut apply = |what| state.apply(&Record { at: Time::ZERO, what });
        for ((id, node), &(left, speed)) in (0..).zip(0..).zip(machines) {
            let (to, message) = (Party::Node(node), Message::Band(100 * id as u32..100 * id as u32 + left));
            let (from, at) = (Party::Parent, Time::ZERO);
            apply(What::Sent { id, from, to, message, bytes: 0, arrives: at });
            apply(What::Received { id, by: to });
            apply(if speed == PAUSED { What::Paused { node } } else { What::SpeedSet { node, speed } });
        }
        retired.iter().for_each(|&node| apply(What::Retired { node }));
        state
    }

    /// How things stand there.
    fn stands(machines: &[Left], retired: &[NodeId]) -> String {
        let words = standing(&run(machines, retired));
        assert!(words.chars().count() <= 105, "{} characters: {words}", words.chars().count());
        words
    }

    #[test]
    fn only_those_that_compute_are_counted() {
        assert_eq!(stands(&[(5, 1.0), (5, 1.0), (5, 1.0)], &[]), "All 3 machines compute their own atoms");
        assert_eq!(stands(&[(0, 1.0), (5, 1.0), (9, 1.0)], &[]), "2 of 3 machines compute; 3 has most left");
        assert_eq!(stands(&[(9, 1.0), (0, 1.0), (0, 1.0)], &[]), "Only 1 still computes: 9 atoms left");
        assert_eq!(stands(&[(9, 1.0)], &[]), "The only machine computes: 9 atoms left");
        assert_eq!(stands(&[(0, 1.0), (0, 1.0)], &[]), "Waiting for the parent");
        assert_eq!(
            stands(&[(5, 1.0), (5, 1.0), (9, 0.1)], &[]),
            "All 3 machines compute; 3 is slow (10 %) and has most left: 9 atoms"
        );
    }

    #[test]
    fn a_machine_that_stands_still_gives_away_its_queue_but_not_its_pipe() {
        let others = [(5, 1.0), (5, 1.0)];
        let stands = |left, speed| stands(&[others[0], others[1], (left, speed)], &[]);
        let two = "2 of 3 machines compute; 3";
        assert_eq!(stands(50, PAUSED), format!("{two} is paused: its 50 atoms go to whoever offers help"));
        assert_eq!(stands(50, 0.0), format!("{two} stands still at 0 %: its 50 atoms go to whoever offers help"));
        assert_eq!(stands(2, PAUSED), format!("{two} is paused and keeps the 2 atoms in its pipe"));
        assert_eq!(stands(1, 0.0), format!("{two} stands still at 0 % and keeps the atom in its pipe"));
    }

    #[test]
    fn several_that_stand_still_are_named_together() {
        let stands = |left| stands(&[(5, 1.0), (left, PAUSED), (left, 0.0)], &[]);
        assert_eq!(stands(40), "Only 1 computes; 2 and 3 stand still: their 80 atoms go to whoever offers help");
        assert_eq!(stands(2), "Only 1 computes; 2 and 3 stand still and keep what is in their pipes");
    }

    #[test]
    fn whoever_has_retired_does_not_help() {
        assert_eq!(
            stands(&[(0, 1.0), (0, 1.0), (0, 1.0), (0, 1.0), (40, 0.05)], &[0, 1, 2, 3]),
            "5 still has 40 atoms, but 1, 2, 3 and 4 have retired: an offer that came round unused is not made again"
        );
        assert_eq!(
            stands(&[(0, 1.0), (40, 1.0)], &[0]),
            "2 still has 40 atoms, but 1 has retired: an offer that came round unused is not made again"
        );
        assert_eq!(stands(&[(0, 1.0), (0, 1.0), (40, 1.0)], &[0]), "Only 3 still computes: 40 atoms left");
        assert_eq!(
            stands(&[(0, 1.0), (3, 1.0), (40, 0.1)], &[0]),
            "2 of 3 machines compute; 3 has most left, 40 atoms, but 1 has retired and will not help"
        );
    }

    #[test]
    fn the_last_atoms_are_in_a_pipe() {
        let why = "what is in a pipe is not given away";
        for retired in [&[][..], &[0]] {
            let stands = |left| stands(&[(0, 1.0), (left, 0.01)], retired);
            assert_eq!(stands(2), format!("Only 2 still computes: its last 2 atoms are in its pipe, and {why}"));
            assert_eq!(stands(1), format!("Only 2 still computes its last atom: {why}"));
        }
    }

    #[test]
    fn a_ring_that_stands_still_says_why_and_what_helps() {
        let alone = |left, speed, retired: &[NodeId]| stands(&[(left, speed), (0, 1.0), (0, 1.0)], retired);
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
            stands(&[(2, 0.0), (1, PAUSED), (0, 1.0)], &[2]),
            "2 machines stand still with 3 atoms, and nobody can take them: let them go on, or raise their speed"
        );
        assert_eq!(
            stands(&[(20, 0.0), (2, 0.0), (0, 1.0)], &[]),
            "2 machines stand still with 22 atoms: the others offer to take them"
        );
    }

    #[test]
    fn all_stand_still() {
        assert!(stands(&[(5, 0.0), (5, 0.0)], &[]).starts_with("All machines stand still at 0 %: raise a speed"));
        assert!(stands(&[(5, PAUSED), (5, PAUSED)], &[]).starts_with("All machines are paused: let one go on"));
        assert!(stands(&[(5, PAUSED), (5, 0.0)], &[]).starts_with("All machines stand still: raise a speed or let"));
        assert_eq!(stands(&[(5, PAUSED)], &[]), "The only machine is paused: let it go on");
    }
}
