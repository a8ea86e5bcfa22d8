//! The strategies, as arms of one enum: all answer the same events, so that every driver and chart serves them all.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::message::{Action, Event, NodeId};
use super::remedy::Remedies;
use super::work::Work;
use super::{adaptive, farm, ring, static_node};
use crate::picture::Division;
use crate::time::Time;

/// How the atoms are shared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Strategy {
    /// The first node traces all; the others, if there are any, do nothing.
    Serial,
    /// A band for each node, as equal as can be, and no help (§6.1).
    Static,
    /// A band for each node that costs about the same, by an estimate that costs time itself (§6.1).
    StaticEstimate,
    /// Many equal parts; a free node asks the parent for the next (§6.2).
    Farm,
    /// A farm whose parts are smaller for nodes that prove slow (§6.2).
    FarmBySpeed,
    /// The article's ring (§7).
    Ring,
    /// The ring as one would build it today: what [`Remedies`] says.
    Adaptive,
}

/// After so many beats whoever is silent counts as gone, and what nobody vouches for as lost.
pub(super) const LEASE_BEATS: u32 = 4;

/// The rules by which a run's atoms are shared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rules {
    /// How the atoms are shared.
    pub strategy: Strategy,
    /// In a ring, an offer is worth taking if it moves at least this many atoms. In a farm, the atoms of a part.
    pub part: u32,
    /// How long a traced atom waits at most for others to travel to the parent with; `None`: until its node has no atoms
    /// left, as in the article (§7).
    pub batch: Option<Duration>,
    /// How often a node tells the parent what it has, in the ring that adapts.
    #[serde(default = "usual_beat")]
    pub beat: Duration,
    /// What the ring that adapts does otherwise than the article's.
    #[serde(default)]
    pub remedies: Remedies,
}

fn usual_beat() -> Duration {
    Rules::BEAT
}

impl Strategy {
    /// Every strategy, in the order in which they are named to the user.
    pub const ALL: [Self; 7] =
        [Self::Serial, Self::Static, Self::StaticEstimate, Self::Farm, Self::FarmBySpeed, Self::Ring, Self::Adaptive];

    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Serial => "serial",
            Self::Static => "static",
            Self::StaticEstimate => "static-estimate",
            Self::Farm => "farm",
            Self::FarmBySpeed => "farm-by-speed",
            Self::Ring => "ring",
            Self::Adaptive => "adaptive",
        }
    }

    /// Whether the parent is asked for parts of the picture.
    pub fn is_farm(self) -> bool {
        matches!(self, Self::Farm | Self::FarmBySpeed)
    }

    /// Whether nodes that are done offer help round a ring.
    pub fn is_ring(self) -> bool {
        matches!(self, Self::Ring | Self::Adaptive)
    }

    /// What [`Rules::part`] is unless somebody wants otherwise: 1 in a ring; in a farm what makes about 16 parts a node.
    pub fn usual_part(self, division: Division, nodes: usize) -> u32 {
        let parts = 16 * nodes.max(1) as u64;
        // No more than there are atoms, whose number is a u32.
        if self.is_farm() { (u64::from(division.atoms()) / parts).max(1) as u32 } else { 1 }
    }
}

impl Rules {
    /// How long a traced atom usually waits. *Ours:* in small batches the picture fills in while one watches.
    pub const BATCH: Duration = Duration::from_millis(15);
    /// How often a node usually tells the parent what it has.
    pub const BEAT: Duration = Duration::from_millis(60);

    /// How long a traced atom waits for others, where somebody looks on. A parent that takes so long for a message is sent
    /// fewer of them: all nodes' results take at most half of its time.
    pub fn batch_for(handling: Duration, nodes: usize) -> Duration {
        Self::BATCH.max(handling * 2 * nodes as u32)
    }

    /// How often a node tells the parent what it has. A parent that takes so long for a message, or has many nodes, hears of
    /// each less often: all of them take at most an eighth of its time, and half a millisecond is between two.
    pub fn beat_for(handling: Duration, nodes: usize) -> Duration {
        Self::BEAT.max((handling * 8).max(Duration::from_micros(500)) * nodes as u32)
    }

    /// The rules of a strategy, unless somebody wants otherwise.
    pub fn usual(strategy: Strategy, division: Division, nodes: usize) -> Self {
        let (part, beat) = (strategy.usual_part(division, nodes), Self::beat_for(Duration::ZERO, nodes));
        Self { strategy, part, batch: Some(Self::BATCH), beat, remedies: Remedies::ALL }
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
    Solo(static_node::StaticNode),
    Farm(farm::FarmNode),
    Ring(ring::RingNode),
    Adaptive(Box<adaptive::AdaptiveNode>),
}

impl Node {
    /// Node `id` of `nodes`.
    pub fn new(rules: &Rules, id: NodeId, nodes: NodeId) -> Self {
        let work = Work::new(rules.batch);
        let role = match rules.strategy {
            Strategy::Serial | Strategy::Static | Strategy::StaticEstimate => {
                Role::Solo(static_node::StaticNode::new(work))
            }
            Strategy::Farm | Strategy::FarmBySpeed => Role::Farm(farm::FarmNode::new(work)),
            Strategy::Ring => Role::Ring(ring::RingNode::new(id, nodes, rules.part, work)),
            Strategy::Adaptive => Role::Adaptive(Box::new(adaptive::AdaptiveNode::new(id, nodes, rules))),
        };
        Self { role }
    }

    /// Answers `event`, which happens at `now`, by appending to `actions`.
    ///
    /// # Panics
    /// If the event is impossible: something that no parent or node of the same run can have sent.
    pub fn handle(&mut self, now: Time, event: Event, actions: &mut Vec<Action>) {
        match &mut self.role {
            // Nobody else expects a machine that begins anew, and it has nothing to say.
            Role::Solo(_) | Role::Farm(_) | Role::Ring(_) if event == Event::Started => {}
            Role::Solo(node) => node.handle(now, event, actions),
            Role::Farm(node) => node.handle(now, event, actions),
            Role::Ring(node) => node.handle(now, event, actions),
            Role::Adaptive(node) => node.handle(now, event, actions),
        }
    }
}
