//! The state of each atom.

use std::time::Duration;

use crate::balance::NodeId;
use crate::time::Time;

/// State of an atom. It is small, since there are many atoms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AtomState {
    /// The atom is still with the parent.
    #[default]
    Nowhere,
    /// The atom was lost with a machine, or with a message.
    Lost,
    /// The atom is in a node's queue or pipe, or on its way from this node to another one.
    With {
        /// The node.
        node: NodeId,
        /// When the atom arrived there.
        since: Time,
    },
    /// The atom is traced.
    Traced {
        /// The node that traced it.
        by: NodeId,
        /// CPU time of this computer, in seconds.
        cost: f32,
        /// When the node had traced it.
        at: Time,
        /// Whether the parent has placed it in the picture.
        placed: bool,
    },
}

impl AtomState {
    /// The node that has traced it.
    pub fn owner(self) -> Option<NodeId> {
        match self {
            Self::Traced { by, .. } => Some(by),
            Self::Nowhere | Self::Lost | Self::With { .. } => None,
        }
    }

    /// The node that has it, or has traced it.
    pub fn holder(self) -> Option<NodeId> {
        match self {
            Self::Nowhere | Self::Lost => None,
            Self::With { node, .. } | Self::Traced { by: node, .. } => Some(node),
        }
    }

    /// Whether it is in the picture.
    pub fn is_placed(self) -> bool {
        matches!(self, Self::Traced { placed: true, .. })
    }

    pub(crate) fn traced(by: NodeId, cost: Duration, at: Time) -> Self {
        Self::Traced { by, cost: cost.as_secs_f32(), at, placed: false }
    }

    /// Marks the atom as placed by the parent. Returns `false` if its tracing is not recorded yet.
    pub(crate) fn place(&mut self) -> bool {
        let Self::Traced { placed, .. } = self else { return false };
        *placed = true;
        true
    }

    /// Notes the atom's arrival at `node`. Records of its tracing, or of a later arrival elsewhere, may have come
    /// before.
    pub(crate) fn arrive(&mut self, node: NodeId, at: Time) {
        match *self {
            Self::Traced { .. } => {}
            Self::With { since, .. } if since > at => {}
            Self::Nowhere | Self::Lost | Self::With { .. } => *self = Self::With { node, since: at },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn atom_state_is_small() {
        assert!(size_of::<AtomState>() <= 16);
    }

    #[test]
    fn latest_arrival_counts_and_traced_is_final() {
        let mut atom = AtomState::default();
        assert_eq!((atom.holder(), atom.owner()), (None, None));
        atom.arrive(4, Time(9));
        atom.arrive(2, Time(5));
        assert_eq!((atom.holder(), atom.owner()), (Some(4), None));
        atom = AtomState::traced(4, Duration::from_millis(2), Time(12));
        atom.arrive(7, Time(11));
        assert_eq!((atom.holder(), atom.owner()), (Some(4), Some(4)));
    }
}
