//! The sleeping nodes that a node knows: those that left a notice, and those that it has woken and whose offers it
//! expects.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::balance::message::NodeId;
use crate::time::Time;

/// The sleeping nodes that a node knows.
#[derive(Debug, Default)]
pub(super) struct Sleepers {
    nodes: BTreeMap<NodeId, Sleeper>,
    /// Number of atoms traced when the node last turned away a node that it had woken.
    turned_away_at: Option<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Sleeper {
    offerer: Offerer,
    /// When this node has woken it; `None` while it sleeps.
    woken: Option<Time>,
}

/// The node that made an offer, as the offer describes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Offerer {
    /// Fraction of the reference machine's speed; 0 if unknown.
    pub speed: f64,
    /// Atoms traced since the start.
    pub done: u32,
}

impl Sleepers {
    /// Notes that `node` sleeps.
    pub fn add(&mut self, node: NodeId, offerer: Offerer) {
        self.nodes.insert(node, Sleeper { offerer, woken: None });
    }

    /// Notes that `node` has made an offer, so it does not sleep. Returns whether this node has woken it.
    pub fn remove(&mut self, node: NodeId) -> bool {
        self.nodes.remove(&node).is_some_and(|sleeper| sleeper.woken.is_some())
    }

    /// Forgets the nodes that are not in the ring any more.
    pub fn retain(&mut self, is_in_ring: impl Fn(NodeId) -> bool) {
        self.nodes.retain(|&node, _| is_in_ring(node));
    }

    /// Returns the fastest node that sleeps.
    pub fn fastest(&self) -> Option<(NodeId, Offerer)> {
        let asleep = self.nodes.iter().filter(|(_, sleeper)| sleeper.woken.is_none());
        let offerers = asleep.map(|(&node, sleeper)| (node, sleeper.offerer));
        offerers.max_by(|one, other| one.1.speed.total_cmp(&other.1.speed))
    }

    /// Returns the node to wake next: the fastest that sleeps; `None` if this node, which has traced `traced` atoms,
    /// has turned one away since its last atom.
    pub fn next_to_wake(&self, traced: u32) -> Option<(NodeId, Offerer)> {
        self.fastest().filter(|_| self.turned_away_at != Some(traced))
    }

    /// Notes that this node, which has traced `traced` atoms, has turned away a node that it had woken: it wakes no
    /// other before its next atom or [`Sleepers::allow_waking`].
    pub fn turn_away(&mut self, traced: u32) {
        self.turned_away_at = Some(traced);
    }

    /// Allows the next wake-up in any case, since an atom is late.
    pub fn allow_waking(&mut self) {
        self.turned_away_at = None;
    }

    /// Notes that this node wakes `node` at `now`.
    pub fn wake(&mut self, node: NodeId, now: Time) {
        if let Some(sleeper) = self.nodes.get_mut(&node) {
            sleeper.woken = Some(now);
        }
    }

    /// Returns the summed speed of the woken nodes whose offers are still expected; an unknown speed counts as
    /// `unknown`. Forgets those that were woken more than `patience` ago: they did not sleep any more.
    pub fn expected_speed(&mut self, now: Time, patience: Duration, unknown: f64) -> f64 {
        self.nodes.retain(|_, sleeper| sleeper.woken.is_none_or(|woken| now.since(woken) <= patience));
        let speed = |sleeper: &Sleeper| if sleeper.offerer.speed > 0.0 { sleeper.offerer.speed } else { unknown };
        self.nodes.values().filter(|sleeper| sleeper.woken.is_some()).map(speed).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn offerer(speed: f64) -> Offerer {
        Offerer { speed, done: 7 }
    }

    #[test]
    fn fastest_sleeper_is_woken_first_and_then_expected_for_a_while() {
        let mut sleepers = Sleepers::default();
        [(4, 0.5), (1, 1.0), (2, 0.25)].into_iter().for_each(|(node, speed)| sleepers.add(node, offerer(speed)));
        assert_eq!(sleepers.fastest(), Some((1, offerer(1.0))));
        sleepers.wake(1, Time(10));
        sleepers.wake(9, Time(10));
        assert_eq!(sleepers.fastest(), Some((4, offerer(0.5))));
        let patience = Duration::from_nanos(5);
        assert_eq!(sleepers.expected_speed(Time(15), patience, 1.0), 1.0);
        assert_eq!(sleepers.expected_speed(Time(16), patience, 1.0), 0.0);
        sleepers.add(1, offerer(0.75));
        assert_eq!(sleepers.fastest(), Some((1, offerer(0.75))), "it went to sleep again");
        assert!(!sleepers.remove(1));
        sleepers.wake(4, Time(20));
        assert!(sleepers.remove(4));
        sleepers.add(4, offerer(0.5));
        sleepers.retain(|node| node != 4);
        assert_eq!(sleepers.fastest(), Some((2, offerer(0.25))));
    }

    #[test]
    fn turning_one_away_stops_waking_until_the_next_atom() {
        let mut sleepers = Sleepers::default();
        sleepers.add(3, offerer(1.0));
        let next = |sleepers: &Sleepers, traced| sleepers.next_to_wake(traced).map(|(node, _)| node);
        assert_eq!(next(&sleepers, 8), Some(3));
        sleepers.turn_away(8);
        assert_eq!([8, 9].map(|traced| next(&sleepers, traced)), [None, Some(3)]);
        sleepers.allow_waking();
        assert_eq!(next(&sleepers, 8), Some(3));
    }
}
