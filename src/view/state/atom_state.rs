//! Where each atom stands.

use std::time::Duration;

use crate::balance::NodeId;
use crate::time::Time;

/// Where an atom stands. There are many atoms, so it is small.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AtomState {
    /// No node has got it yet.
    #[default]
    Nowhere,
    /// Nobody has it any more: it was lost with its machine, or with a message.
    Lost,
    /// A node has it in its queue or its pipe, or has given it away to a node that has not got it yet.
    With {
        /// Which node.
        node: NodeId,
        /// When the atom arrived there.
        since: Time,
    },
    /// It is traced.
    Traced {
        /// By which node.
        by: NodeId,
        /// CPU time of this computer, in seconds.
        cost: f32,
        /// When it was done.
        at: Time,
        /// Whether the parent has placed it in the picture.
        placed: bool,
    },
}

impl AtomState {
    /// Who has traced it.
    pub fn owner(self) -> Option<NodeId> {
        match self {
            Self::Traced { by, .. } => Some(by),
            Self::Nowhere | Self::Lost | Self::With { .. } => None,
        }
    }

    /// Who has it, or has traced it.
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

    /// The parent has placed it. Returns whether it was known to be traced.
    pub(crate) fn place(&mut self) -> bool {
        let Self::Traced { placed, .. } = self else { return false };
        *placed = true;
        true
    }

    /// The atom has arrived at `node`. It may have been handed on, or traced, before the record of that comes.
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
    fn a_place_is_small() {
        assert!(size_of::<AtomState>() <= 16);
    }

    #[test]
    fn the_latest_arrival_counts_and_what_is_traced_stays() {
        let mut place = AtomState::default();
        assert_eq!((place.holder(), place.owner()), (None, None));
        place.arrive(4, Time(9));
        place.arrive(2, Time(5));
        assert_eq!((place.holder(), place.owner()), (Some(4), None));
        place = AtomState::traced(4, Duration::from_millis(2), Time(12));
        place.arrive(7, Time(11));
        assert_eq!((place.holder(), place.owner()), (Some(4), Some(4)));
    }
}
