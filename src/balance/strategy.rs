//! The strategies, as variants of one enum. All of them handle the same events, so that every driver and chart works
//! with all of them.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::message::{Action, Event, NodeId};
use super::remedy::Remedies;
use super::work::Work;
use super::{adaptive, farm, farm_leases, ring, static_node};
use crate::picture::Division;
use crate::time::Time;

/// A way to share the atoms among the nodes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Strategy {
    /// The first node traces all atoms; the others do nothing.
    Serial,
    /// A band of equal size for each node, and no help (§6.1).
    Static,
    /// A band of about equal cost for each node, by an estimate that takes time itself (§6.1).
    StaticEstimate,
    /// Many equal parts; a node without atoms asks the parent for the next part (§6.2).
    Farm,
    /// A farm with smaller parts for slower nodes (§6.2).
    FarmBySpeed,
    /// A farm in which the parts of a lost machine are given out again ([`farm_leases`]).
    FarmLeases,
    /// The article's ring (§7).
    Ring,
    /// The adaptive ring: the article's ring with [`Remedies`] for its weaknesses.
    Adaptive,
}

/// Beats in a lease: a node that is silent for a lease counts as gone, and an atom that no node vouches for counts as
/// lost.
pub(super) const LEASE_BEATS: u32 = 4;

/// The strategy of a run and its parameters.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rules {
    /// The strategy.
    pub strategy: Strategy,
    /// In a ring, the least number of atoms that are worth a transfer. In a farm, the number of atoms in a part.
    pub part: u32,
    /// Longest time that a traced atom waits for others, to travel to the parent with them; `None`: until its node has
    /// no atoms left, as in the article (§7).
    pub batch: Option<Duration>,
    /// Interval of a node's heartbeat in the adaptive ring and in the farm with leases.
    #[serde(default = "usual_beat")]
    pub beat: Duration,
    /// The remedies of the adaptive ring.
    #[serde(default)]
    pub remedies: Remedies,
}

fn usual_beat() -> Duration {
    Rules::BEAT
}

impl Strategy {
    /// All strategies, in the order in which the user sees them.
    pub const ALL: [Self; 8] = [
        Self::Serial,
        Self::Static,
        Self::StaticEstimate,
        Self::Farm,
        Self::FarmBySpeed,
        Self::FarmLeases,
        Self::Ring,
        Self::Adaptive,
    ];

    /// Returns the name on the command line and in files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Serial => "serial",
            Self::Static => "static",
            Self::StaticEstimate => "static-estimate",
            Self::Farm => "farm",
            Self::FarmBySpeed => "farm-by-speed",
            Self::FarmLeases => "farm-leases",
            Self::Ring => "ring",
            Self::Adaptive => "adaptive",
        }
    }

    /// Returns whether nodes ask the parent for parts.
    pub fn is_farm(&self) -> bool {
        matches!(self, Self::Farm | Self::FarmBySpeed | Self::FarmLeases)
    }

    /// Returns whether nodes offer help along a ring.
    pub fn is_ring(&self) -> bool {
        matches!(self, Self::Ring | Self::Adaptive)
    }

    /// Returns whether a machine that starts afresh is let in, and a worker that fails does not end the run. Lost atoms
    /// are handed out again as well, unless the adaptive ring runs without [`Leases`](super::Remedy::Leases).
    pub fn survives_losses(&self) -> bool {
        matches!(self, Self::FarmLeases | Self::Adaptive)
    }

    /// Returns the default of [`Rules::part`]: 1 in a ring; in a farm the size that makes about 16 parts for each node.
    pub fn usual_part(&self, division: Division, nodes: usize) -> u32 {
        let parts = 16 * nodes.max(1) as u64;
        // The cast is exact: the result is at most the number of atoms, a u32.
        if self.is_farm() { (u64::from(division.atoms()) / parts).max(1) as u32 } else { 1 }
    }
}

impl Rules {
    /// Default of [`Rules::batch`]. *Ours:* with small batches the picture fills in while one watches.
    pub const BATCH: Duration = Duration::from_millis(15);
    /// Default of [`Rules::beat`].
    pub const BEAT: Duration = Duration::from_millis(60);

    /// Returns the batch time for a parent that is busy for `handling` with each message: long enough that the results
    /// of all `nodes` take at most half of its time.
    pub fn batch_for(handling: Duration, nodes: usize) -> Duration {
        Self::BATCH.max(handling * 2 * nodes as u32)
    }

    /// Returns the beat for a parent that is busy for `handling` with each message: long enough that the beats of all
    /// `nodes` take at most an eighth of its time, and that there is at least half a millisecond from one to the next.
    pub fn beat_for(handling: Duration, nodes: usize) -> Duration {
        Self::BEAT.max((handling * 8).max(Duration::from_micros(500)) * nodes as u32)
    }

    /// Returns the default rules of a strategy.
    pub fn usual(strategy: Strategy, division: Division, nodes: usize) -> Self {
        let (part, beat) = (strategy.usual_part(division, nodes), Self::beat_for(Duration::ZERO, nodes));
        Self { strategy, part, batch: Some(Self::BATCH), beat, remedies: Remedies::ALL }
    }
}

/// A name that is not the name of a strategy.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no strategy `{0}`; there are: {known}", known = Strategy::ALL.map(|strategy| strategy.name()).join(", "))]
pub struct UnknownStrategy(String);

impl fmt::Display for Strategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Strategy {
    type Err = UnknownStrategy;

    fn from_str(text: &str) -> Result<Self, UnknownStrategy> {
        Self::ALL.into_iter().find(|strategy| strategy.name() == text).ok_or_else(|| UnknownStrategy(text.to_owned()))
    }
}

/// A node's side of the protocol, by strategy.
#[derive(Debug)]
pub struct Node {
    role: Role,
}

#[derive(Debug)]
enum Role {
    Static(static_node::StaticNode),
    Farm(farm::FarmNode),
    FarmLeases(Box<farm_leases::LeasedFarmNode>),
    Ring(ring::RingNode),
    Adaptive(Box<adaptive::AdaptiveNode>),
}

impl Node {
    /// Creates node `id` of `nodes`.
    pub fn new(rules: &Rules, id: NodeId, nodes: NodeId) -> Self {
        let work = Work::new(rules.batch);
        let role = match rules.strategy {
            Strategy::Serial | Strategy::Static | Strategy::StaticEstimate => {
                Role::Static(static_node::StaticNode::new(work))
            }
            Strategy::Farm | Strategy::FarmBySpeed => Role::Farm(farm::FarmNode::new(work)),
            Strategy::FarmLeases => Role::FarmLeases(Box::new(farm_leases::LeasedFarmNode::new(rules))),
            Strategy::Ring => Role::Ring(ring::RingNode::new(id, nodes, rules.part, work)),
            Strategy::Adaptive => Role::Adaptive(Box::new(adaptive::AdaptiveNode::new(id, nodes, rules))),
        };
        Self { role }
    }

    /// Handles `event` at the time `now` and appends its answer to `actions`.
    ///
    /// # Panics
    /// If the event is impossible: no parent or node of the same run can have sent it.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        match &mut self.role {
            // The other strategies do not let a machine in that has started afresh.
            Role::Static(_) | Role::Farm(_) | Role::Ring(_) if event == Event::Started => {}
            Role::Static(node) => node.handle(now, event, actions),
            Role::Farm(node) => node.handle(now, event, actions),
            Role::FarmLeases(node) => node.handle(now, event, actions),
            Role::Ring(node) => node.handle(now, event, actions),
            Role::Adaptive(node) => node.handle(now, event, actions),
        }
    }
}
