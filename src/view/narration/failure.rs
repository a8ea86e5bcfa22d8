//! Failures of machines and links, and steps of the recovery, with the facts that their sentences need.

use std::time::Duration;

use crate::balance::{Condition, NodeId, Party, Remedy};
use crate::time::Time;
use crate::view::state::run_state::RunState;

/// A failure, or a step of the recovery from one.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// A machine is switched off while it has `atoms`; `is_recovered` if the parent will hand them out again.
    SwitchedOff { node: NodeId, atoms: u32, is_recovered: bool },
    /// A machine hangs while it has `atoms`; `is_recovered` if the parent will notice.
    Hung { node: NodeId, atoms: u32, is_recovered: bool },
    /// A machine is cut off.
    CutOff(NodeId),
    /// A spare machine joins.
    Joined(NodeId),
    /// A machine that was off starts again and asks to be let in.
    Restarted(NodeId),
    /// A machine that was off starts again, and the ring does not let it in.
    RestartedOutside(NodeId),
    /// A machine that was cut off can be reached again.
    Reachable(NodeId),
    /// A machine that hung continues.
    Continues(NodeId),
    /// The parent has not heard from a node for `silent`.
    Missed { node: NodeId, silent: Duration },
    /// The parent does not hear from several nodes.
    MissedMany(Vec<NodeId>),
    /// The parent hears from nodes again.
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
    /// Describes the change of a machine's condition; `None` for a machine that the run does not have.
    pub(crate) fn condition(state: &RunState, node: NodeId) -> Option<Self> {
        let machine = state.nodes().get(usize::from(node))?;
        let is_recovered = state.has(Remedy::Leases);
        Some(match (machine.condition, machine.previous_condition) {
            (Condition::Off, _) => Self::SwitchedOff { node, atoms: machine.lost_atoms, is_recovered },
            (Condition::Hung, _) => Self::Hung { node, atoms: machine.left(), is_recovered },
            (Condition::CutOff, _) => Self::CutOff(node),
            (Condition::Well, Condition::Off) if !state.scheduler.survives_losses() => Self::RestartedOutside(node),
            (Condition::Well, Condition::Off) if machine.last_heard.is_none() => Self::Joined(node),
            (Condition::Well, Condition::Off) => Self::Restarted(node),
            (Condition::Well, Condition::CutOff) => Self::Reachable(node),
            (Condition::Well, _) => Self::Continues(node),
        })
    }

    /// Describes the parent's list of missing nodes; `None` if it has not changed.
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
