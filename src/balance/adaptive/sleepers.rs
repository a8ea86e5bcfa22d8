//! Who has said that it sleeps, and who was woken and is expected to offer.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::balance::message::NodeId;
use crate::time::Time;

/// The sleeping nodes that a node knows of.
#[derive(Debug, Default)]
pub(super) struct Sleepers {
    nodes: BTreeMap<NodeId, Sleeper>,
}

#[derive(Clone, Copy, Debug)]
struct Sleeper {
    helper: Helper,
    woken: Option<Time>,
}

/// What is known of a node that helps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Helper {
    /// As a fraction of the reference machine; 0 if it is not known.
    pub speed: f64,
    /// Atoms that it has traced since the start.
    pub done: u32,
}

impl Sleepers {
    /// This node sleeps.
    pub fn add(&mut self, node: NodeId, helper: Helper) {
        self.nodes.insert(node, Sleeper { helper, woken: None });
    }

    /// This node offers, or is gone: it does not sleep. Whether it was woken from here.
    pub fn remove(&mut self, node: NodeId) -> bool {
        self.nodes.remove(&node).is_some_and(|sleeper| sleeper.woken.is_some())
    }

    /// Only these may be there still.
    pub fn retain(&mut self, is_there: impl Fn(NodeId) -> bool) {
        self.nodes.retain(|&node, _| is_there(node));
    }

    /// The fastest that sleeps and was not woken.
    pub fn fastest(&self) -> Option<(NodeId, Helper)> {
        let asleep = self.nodes.iter().filter(|(_, sleeper)| sleeper.woken.is_none());
        let helpers = asleep.map(|(&node, sleeper)| (node, sleeper.helper));
        helpers.max_by(|one, other| one.1.speed.total_cmp(&other.1.speed))
    }

    /// This node is woken now.
    pub fn wake(&mut self, node: NodeId, now: Time) {
        if let Some(sleeper) = self.nodes.get_mut(&node) {
            sleeper.woken = Some(now);
        }
    }

    /// How fast those are together that were woken and have not offered yet, one of unknown speed as fast as `unknown`; whoever takes longer than `patience` is forgotten, since it did not sleep any more.
    pub fn expected(&mut self, now: Time, patience: Duration, unknown: f64) -> f64 {
        self.nodes.retain(|_, sleeper| sleeper.woken.is_none_or(|woken| now.since(woken) <= patience));
        let speed = |sleeper: &Sleeper| if sleeper.helper.speed > 0.0 { sleeper.helper.speed } else { unknown };
        self.nodes.values().filter(|sleeper| sleeper.woken.is_some()).map(speed).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fastest_is_woken_first_and_then_expected_for_a_while() {
        let mut sleepers = Sleepers::default();
        let helper = |speed| Helper { speed, done: 7 };
        [(4, 0.5), (1, 1.0), (2, 0.25)].into_iter().for_each(|(node, speed)| sleepers.add(node, helper(speed)));
        assert_eq!(sleepers.fastest(), Some((1, helper(1.0))));
        sleepers.wake(1, Time(10));
        sleepers.wake(9, Time(10));
        assert_eq!(sleepers.fastest(), Some((4, helper(0.5))));
        let patience = Duration::from_nanos(5);
        assert_eq!(sleepers.expected(Time(15), patience, 1.0), 1.0);
        assert_eq!(sleepers.expected(Time(16), patience, 1.0), 0.0);
        sleepers.add(1, helper(0.75));
        assert_eq!(sleepers.fastest(), Some((1, helper(0.75))), "it went to sleep again");
        assert!(!sleepers.remove(1));
        sleepers.wake(4, Time(20));
        assert!(sleepers.remove(4));
        sleepers.add(4, helper(0.5));
        sleepers.retain(|node| node != 4);
        assert_eq!(sleepers.fastest(), Some((2, helper(0.25))));
    }
}
