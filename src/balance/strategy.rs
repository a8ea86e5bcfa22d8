//! The strategies, as arms of one enum: all answer the same events, so that every driver and chart serves them all.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::message::{Action, Event, NodeId};
use super::{ring, serial};
use crate::picture::{Atom, Division};
use crate::time::Time;

/// How the atoms are shared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Strategy {
    /// The first node traces all; the others, if there are any, do nothing.
    Serial,
    /// The article's ring (§7).
    Ring,
}

impl Strategy {
    /// Every strategy, in the order in which they are named to the user.
    pub const ALL: [Self; 2] = [Self::Serial, Self::Ring];

    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Serial => "serial",
            Self::Ring => "ring",
        }
    }

    /// What the parent gives each of `nodes` nodes first.
    pub(super) fn bands(self, division: Division, nodes: NodeId) -> Vec<Range<Atom>> {
        match self {
            Self::Serial => {
                let all = division.atoms();
                (0..nodes).map(|node| if node == 0 { 0..all } else { all..all }).collect()
            }
            Self::Ring => division.bands(usize::from(nodes)).collect(),
        }
    }
}

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Strategy {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|strategy| strategy.name() == text).ok_or_else(|| {
            let known = Self::ALL.map(Self::name).join(", ");
            format!("there is no strategy `{text}`; there are: {known}")
        })
    }
}

/// One machine's part in sharing, as its strategy has it.
#[derive(Debug)]
pub struct Node {
    role: Role,
}

#[derive(Debug)]
enum Role {
    Serial(serial::Node),
    Ring(ring::Node),
}

impl Node {
    /// Node `id` of `nodes`. An offer is worth taking if it moves at least `part` atoms (0 counts as 1).
    pub fn new(strategy: Strategy, id: NodeId, nodes: NodeId, part: u32) -> Self {
        let role = match strategy {
            Strategy::Serial => Role::Serial(serial::Node::default()),
            Strategy::Ring => Role::Ring(ring::Node::new(id, nodes, part)),
        };
        Self { role }
    }

    /// Answers `event`, which happens at `now`, by appending to `actions`.
    ///
    /// # Panics
    /// If the event is impossible: something that no parent or node of the same run can have sent.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        match &mut self.role {
            Role::Serial(node) => node.handle(now, event, actions),
            Role::Ring(node) => node.handle(now, event, actions),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back_and_unknown_ones_list_the_known() {
        for strategy in Strategy::ALL {
            assert_eq!(strategy.to_string().parse(), Ok(strategy));
        }
        let error = "round".parse::<Strategy>().unwrap_err();
        assert_eq!(error, "there is no strategy `round`; there are: serial, ring");
    }

    #[test]
    fn bands_of_every_strategy_hold_each_atom_once() {
        for strategy in Strategy::ALL {
            let bands = strategy.bands(Division::new(1000, 7), 5);
            assert_eq!(bands.len(), 5);
            assert!(bands.into_iter().flatten().eq(0..143), "{strategy}");
        }
    }
}
