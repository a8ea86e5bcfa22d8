//! What one event is called in a sentence, whether it is said large or kept in the list.

use std::cmp::Ordering;
use std::ops::Range;
use std::time::Duration;

use super::node::NodeState;
use super::sharing::Sharing;
use super::standing::PIPE;
use super::state::RunState;
use super::words::{atoms_words, duration, fraction, names, node_name};
use crate::balance::{NodeId, Strategy};
use crate::picture::Atom;

/// The last event of a run that came to its end.
pub(super) const COMPLETE: &str = "The picture is complete";

/// In virtual time every atom's cost is known when the run begins.
pub(super) const BEFORE_VIRTUAL_TIME: &str = "Virtual time begins once the picture is traced, and its costs are known";

/// The parent hands out the bands, of which this is the first.
pub(super) fn bands(state: &RunState, first: &Range<Atom>) -> String {
    match state.nodes().len() {
        machines if state.sharing == Sharing::Stealing => {
            format!("{machines} threads trace the picture: whoever is idle steals from another")
        }
        machines if state.sharing.is_farm() => {
            format!("The parent gives each of {machines} machines a first part: {}", atoms_words(first.len() as u32))
        }
        1 => "The parent gives the only machine the whole picture".into(),
        _ if first.len() as u32 == state.atoms() => "The parent gives one machine the whole picture".into(),
        machines if state.sharing == Sharing::By(Strategy::StaticEstimate) => {
            format!("The parent gives each of {machines} machines a band that should cost the same")
        }
        machines => format!("The parent gives each of {machines} machines an equal band of the picture"),
    }
}

/// The parent learns what the picture costs before it hands out bands.
pub(super) const ESTIMATING: &str = "The parent samples the picture to guess what each part costs";

/// The parent of a farm has answered a node that asked.
pub(super) fn part(to: NodeId, atoms: u32) -> String {
    let name = node_name(to);
    match atoms {
        0 => format!("{name} asks the parent for more, but all is given away: it is no longer needed"),
        _ => format!("{name} asks the parent for more and gets {}", atoms_words(atoms)),
    }
}

/// So many messages wait at the parent.
pub(super) fn jam(state: &RunState, most: usize) -> String {
    format!("{most} messages wait at the parent, which needs {} for each", duration(state.handling))
}

/// Machines are done with their bands, and not all are.
pub(super) fn done(nodes: &[NodeId]) -> String {
    match nodes {
        [node] => format!("{} is done and waits: nobody shares with it", node_name(*node)),
        _ => format!("{} are done and wait: nobody shares with them", names(nodes)),
    }
}

/// Machines are no longer needed.
pub(super) fn retired(state: &RunState, nodes: &[NodeId]) -> String {
    match (nodes, state.sharing.is_farm()) {
        ([node], true) => format!("{} asked for more, but all is given away", node_name(*node)),
        (_, true) => format!("{} asked for more, but all is given away", names(nodes)),
        ([node], false) => format!("{}'s offer came back, nobody needs its help: it retires", node_name(*node)),
        (_, false) => format!("{} retire: their offers came back, nobody needs their help", names(nodes)),
    }
}

/// A thread has stolen atoms.
pub(super) fn theft(thief: NodeId, from: NodeId, atoms: u32) -> String {
    format!("{} steals {} from {}", node_name(thief), atoms_words(atoms), node_name(from))
}

/// A machine that has nothing left to trace offers help; `whole` if it has traced its whole band itself.
pub(super) fn offer(who: NodeId, whole: bool, done: u32) -> String {
    let name = node_name(who);
    match (whole, done) {
        (_, 0) => format!("{name} has nothing to trace and offers help round the ring"),
        (true, _) => format!("{name} has finished its band and offers help round the ring"),
        (false, _) => format!("{name} has no atoms left and offers help round the ring"),
    }
}

/// A machine has given atoms to one that offered help.
pub(super) fn transfer(state: &RunState, from: NodeId, to: NodeId, atoms: u32) -> String {
    if state.sharing == Sharing::Stealing {
        return theft(to, from, atoms);
    }
    let (giver, offerer) = (node_name(from), node_name(to));
    let busy = match state.nodes().get(usize::from(from)) {
        Some(node) if node.paused => "is paused".into(),
        Some(node) if node.speed == 0.0 => "stands still".into(),
        Some(node) if is_slow(node) => format!("is slow ({})", fraction(node.speed)),
        _ => "is still busy".into(),
    };
    let atoms = if atoms == 1 { "one atom".into() } else { atoms_words(atoms) };
    format!("{offerer} has finished and takes over {atoms} from {giver}, which {busy}")
}

/// So slow that the others notice.
pub(super) fn is_slow(node: &NodeState) -> bool {
    node.speed < 0.5
}

/// What a new speed means; `before` is the one before somebody began to change it.
pub(super) fn speed(state: &RunState, node: NodeId, before: f64, speed: f64) -> String {
    let name = node_name(node);
    if state.nodes().get(usize::from(node)).is_some_and(|node| node.paused) {
        return format!("Machine {name} is paused; it will go on at {}", fraction(speed));
    }
    let runs = if speed == 0.0 { "is stopped".into() } else { format!("now runs at {}", fraction(speed)) };
    let runs = format!("Machine {name} {runs}");
    let than_before = speed.total_cmp(&before);
    let then = match than_before {
        Ordering::Equal => None,
        _ if state.sharing.is_fixed() => {
            let has_atoms = state.nodes().get(usize::from(node)).is_some_and(|machine| machine.left() > 0);
            let then = if than_before.is_lt() { "nobody will make up for it" } else { "its band is done sooner" };
            has_atoms.then_some(then)
        }
        _ if state.sharing.is_farm() && speed > 0.0 => {
            Some(if than_before.is_lt() { "it will ask less often" } else { "it will ask more often" })
        }
        _ if state.sharing.is_farm() => Some("what it has stays with it"),
        Ordering::Less => others_run(state, node).then_some("the others will make up for it"),
        Ordering::Greater => Some("it can take more work"),
    };
    then.map_or_else(|| runs.clone(), |then| format!("{runs}: {then}"))
}

/// A machine was paused.
pub(super) fn paused(state: &RunState, node: NodeId) -> String {
    let paused = format!("Machine {} is paused", node_name(node));
    let Some(machine) = state.nodes().get(usize::from(node)) else { return paused };
    match machine.left() {
        0 if !state.sharing.is_ring() && state.sharing != Sharing::Stealing => paused,
        left if state.sharing.is_farm() => format!("{paused} and keeps the {} of its part", atoms_words(left)),
        left if state.sharing.is_fixed() => {
            format!("{paused}: its {} wait, nobody will make up for it", atoms_words(left))
        }
        1 => format!("{paused} and keeps the atom in its pipe"),
        2..=PIPE => format!("{paused} and keeps the {PIPE} atoms in its pipe"),
        left if (left > 0 || machine.band_at.is_none()) && others_run(state, node) => {
            format!("{paused}: the others will make up for it")
        }
        _ => paused,
    }
}

/// A paused machine goes on.
pub(super) fn resumed(state: &RunState, node: NodeId) -> String {
    let name = node_name(node);
    match state.nodes().get(usize::from(node)) {
        Some(machine) if machine.speed == 0.0 => format!("Machine {name} is no longer paused, but its speed is 0 %"),
        _ => format!("Machine {name} goes on"),
    }
}

/// All links have a new latency.
pub(super) fn latency(state: &RunState, latency: Duration) -> String {
    let what = if state.sharing.is_ring() { "A hop" } else { "A message" };
    if latency.is_zero() {
        format!("{what} takes no time now")
    } else {
        format!("{what} takes {} now", duration(latency))
    }
}

fn others_run(state: &RunState, node: NodeId) -> bool {
    (0..).zip(state.nodes()).any(|(other, machine)| other != node && machine.runs())
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;
    use crate::balance::{Message, Party};
    use crate::record::{Record, What};
    use crate::time::Time;

    /// A run by this strategy in which each of two machines has nine atoms.
    fn run(strategy: Strategy) -> RunState {
        let mut header = sample::header(&[1.0, 1.0], 90);
        header.rules.strategy = strategy;
        let mut state = RunState::new(&header);
        for (id, node) in [(0, 0), (1, 1)] {
            let (from, to, message) = (Party::Parent, Party::Node(node), Message::Band(9 * id..9 * id + 9));
            let (at, id) = (Time::ZERO, u64::from(id));
            state.apply(&Record { at, what: What::Sent { id, from, to, message, bytes: 0, arrives: at } });
            state.apply(&Record { at, what: What::Received { id, by: to } });
        }
        state
    }

    #[test]
    fn what_a_change_means_depends_on_how_atoms_are_shared() {
        let said = |strategy| {
            let state = run(strategy);
            let set = |before, now| speed(&state, 1, before, now).split_once(": ").expect("a meaning").1.to_owned();
            [set(1.0, 0.5), set(0.5, 1.0), set(1.0, 0.0)]
        };
        assert_eq!(
            said(Strategy::Static),
            ["nobody will make up for it", "its band is done sooner", "nobody will make up for it"]
        );
        assert_eq!(
            said(Strategy::Farm),
            ["it will ask less often", "it will ask more often", "what it has stays with it"]
        );
        let others = "the others will make up for it";
        assert_eq!(said(Strategy::Ring), [others, "it can take more work", others]);
        assert_eq!(paused(&run(Strategy::Farm), 1), "Machine 2 is paused and keeps the 9 atoms of its part");
        assert_eq!(
            paused(&run(Strategy::Static), 1),
            "Machine 2 is paused: its 9 atoms wait, nobody will make up for it"
        );
        let ms = Duration::from_millis(90);
        assert_eq!(latency(&run(Strategy::Farm), ms), "A message takes 90 ms now");
    }
}
