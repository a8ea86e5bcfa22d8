//! Failures of machines and links, and what the adaptive ring does about them, with the facts that the sentence needs.

use std::time::Duration;

use crate::balance::{Condition, NodeId, Party, Remedy};
use crate::time::Time;
use crate::view::state::run_state::RunState;

/// A failure, or a step of the recovery from one.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// A machine is switched off with this many atoms; `is_recovered` if the parent will notice.
    SwitchedOff { node: NodeId, atoms: u32, is_recovered: bool },
    /// A machine hangs with this many atoms; `is_recovered` if the parent will notice.
    Hung { node: NodeId, atoms: u32, is_recovered: bool },
    /// A machine is cut off.
    CutOff(NodeId),
    /// A spare machine joins.
    Joined(NodeId),
    /// A machine that was off starts anew and asks to be let in.
    Restarted(NodeId),
    /// A machine that was off starts anew, and the ring does not let it in.
    RestartedOutside(NodeId),
    /// A machine that was cut off can be reached.
    Reachable(NodeId),
    /// A machine that hung goes on.
    Continues(NodeId),
    /// The parent misses one node, not heard of for `silent`.
    Missed { node: NodeId, silent: Duration },
    /// The parent misses several nodes.
    MissedMany(Vec<NodeId>),
    /// The parent hears of nodes again.
    Returned(Vec<NodeId>),
    /// Messages from one party to another are held up.
    Delayed { from: Party, to: Party, by: Duration },
    /// The parent hands out lost atoms again.
    HandedOutAgain { to: Vec<NodeId>, atoms: u32 },
    /// Nodes trace copies of atoms that are late at `from`.
    Copies { from: NodeId, to: Vec<NodeId>, atoms: u32 },
    /// A node wakes others.
    Wakes { from: NodeId, to: Vec<NodeId> },
}

impl Failure {
    /// A machine's condition has changed; `None` for a machine that the run does not have.
    pub(crate) fn condition(state: &RunState, node: NodeId) -> Option<Self> {
        let machine = state.nodes().get(usize::from(node))?;
        let is_recovered = state.has(Remedy::Leases);
        Some(match (machine.condition, machine.previous_condition) {
            (Condition::Off, _) => Self::SwitchedOff { node, atoms: machine.lost_atoms, is_recovered },
            (Condition::Hung, _) => Self::Hung { node, atoms: machine.left(), is_recovered },
            (Condition::CutOff, _) => Self::CutOff(node),
            (Condition::Well, Condition::Off) if !state.sharing.is_adaptive() => Self::RestartedOutside(node),
            (Condition::Well, Condition::Off) if machine.last_heard.is_none() => Self::Joined(node),
            (Condition::Well, Condition::Off) => Self::Restarted(node),
            (Condition::Well, Condition::CutOff) => Self::Reachable(node),
            (Condition::Well, _) => Self::Continues(node),
        })
    }

    /// The parent tells who is gone; `None` if it tells the same again.
    pub(crate) fn ring_changed(state: &RunState, now: Time) -> Option<Self> {
        let without = |all: &[NodeId], others: &[NodeId]| -> Vec<NodeId> {
            all.iter().copied().filter(|node| !others.contains(node)).collect()
        };
        let (gone, back) = (without(&state.gone, &state.previous_gone), without(&state.previous_gone, &state.gone));
        match *gone {
            [] if back.is_empty() => None,
            [] => Some(Self::Returned(back)),
            [node] => {
                let heard = state.nodes().get(usize::from(node)).and_then(|of| of.last_heard).unwrap_or_default();
                Some(Self::Missed { node, silent: now.since(heard) })
            }
            _ => Some(Self::MissedMany(gone)),
        }
    }
}
