//! What one event is called in a sentence, whether it is said large or kept in the list.

use std::cmp::Ordering;
use std::ops::Range;
use std::time::Duration;

use super::node::NodeState;
use super::standing::PIPE;
use super::state::RunState;
use super::words::{atoms_words, duration, fraction, node_name};
use crate::balance::NodeId;
use crate::picture::Atom;

/// The last event of a run that came to its end.
pub(super) const COMPLETE: &str = "The picture is complete";

/// The parent hands out the bands, of which this is the first.
pub(super) fn bands(state: &RunState, first: &Range<Atom>) -> String {
    match state.nodes().len() {
        1 => "The parent gives the only machine the whole picture".into(),
        _ if first.len() as u32 == state.atoms() => "The parent gives one machine the whole picture".into(),
        machines => format!("The parent gives each of {machines} machines an equal band of the picture"),
    }
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
    match speed.total_cmp(&before) {
        Ordering::Less if others_run(state, node) => format!("{runs}: the others will make up for it"),
        Ordering::Less | Ordering::Equal => runs,
        Ordering::Greater => format!("{runs}: it can take more work"),
    }
}

/// A machine was paused.
pub(super) fn paused(state: &RunState, node: NodeId) -> String {
    let paused = format!("Machine {} is paused", node_name(node));
    let Some(machine) = state.nodes().get(usize::from(node)) else { return paused };
    match machine.left() {
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
pub(super) fn latency(latency: Duration) -> String {
    if latency.is_zero() { "A hop takes no time now".into() } else { format!("A hop takes {} now", duration(latency)) }
}

fn others_run(state: &RunState, node: NodeId) -> bool {
    (0..).zip(state.nodes()).any(|(other, machine)| other != node && machine.runs())
}
