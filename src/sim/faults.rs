//! What is wrong with the network: links that are cut, ways that are held up, and nodes that nothing reaches.

use std::collections::{BTreeMap, BTreeSet};

use crate::balance::{NodeId, Party};
use crate::time::Time;

/// Links that are cut, ways that are held up, and nodes that are cut off from all others.
#[derive(Clone, Debug, Default)]
pub struct Faults {
    /// The lesser party first.
    links: BTreeSet<(Party, Party)>,
    nodes: BTreeSet<NodeId>,
    /// By sender and receiver: what would arrive after the first time arrives no earlier than at the second.
    delays: BTreeMap<(Party, Party), (Time, Time)>,
}

impl Faults {
    /// Cuts the link between two parties, in both directions, or mends it. Whether that changes anything.
    pub fn cut_link(&mut self, one: Party, other: Party, is_cut: bool) -> bool {
        change(&mut self.links, link(one, other), is_cut)
    }

    /// Cuts a node off from all others, or no longer.
    pub fn cut_off(&mut self, node: NodeId, is_cut_off: bool) {
        change(&mut self.nodes, node, is_cut_off);
    }

    /// Whether nothing travels between the two. What a party sends to itself goes no way.
    pub fn is_cut(&self, one: Party, other: Party) -> bool {
        let is_cut_off = |party| matches!(party, Party::Node(node) if self.nodes.contains(&node));
        one != other && (self.links.contains(&link(one, other)) || is_cut_off(one) || is_cut_off(other))
    }

    /// From `now` on nothing arrives from one party at another until `until`; then all of it does. A way that is held up
    /// already stays so at least as long as it was to be. Returns until when it is.
    pub fn delay(&mut self, from: Party, to: Party, now: Time, until: Time) -> Time {
        let (since, until) = match self.delays.get(&(from, to)) {
            Some(&(since, longer)) if longer > now => (since, until.max(longer)),
            _ => (now, until),
        };
        self.delays.insert((from, to), (since, until));
        until
    }

    /// When a message arrives that would do so at `at`.
    pub fn arrival(&self, from: Party, to: Party, at: Time) -> Time {
        match self.delays.get(&(from, to)) {
            Some(&(since, until)) if since < at => at.max(until),
            _ => at,
        }
    }
}

fn link(one: Party, other: Party) -> (Party, Party) {
    (one.min(other), one.max(other))
}

/// Has it among them, or not. Whether that is new.
fn change<T: Ord>(all: &mut BTreeSet<T>, one: T, is_in: bool) -> bool {
    if is_in { all.insert(one) } else { all.remove(&one) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_held_up_is_late_and_what_was_there_before_is_not() {
        let (one, two) = (Party::Node(1), Party::Node(2));
        let mut faults = Faults::default();
        let arrivals = |faults: &Faults| [8, 10, 11, 20, 21].map(|at| faults.arrival(one, two, Time(at)).0);
        assert_eq!(faults.delay(one, two, Time(10), Time(20)), Time(20));
        assert_eq!(arrivals(&faults), [8, 10, 20, 20, 21]);
        assert_eq!(faults.arrival(two, one, Time(11)), Time(11), "only one way");
        assert_eq!(faults.delay(one, two, Time(12), Time(15)), Time(20), "no sooner than it was to be");
        assert_eq!(faults.delay(one, two, Time(14), Time(30)), Time(30));
        assert_eq!(arrivals(&faults), [8, 10, 30, 30, 30]);
        assert_eq!(faults.delay(one, two, Time(40), Time(50)), Time(50));
        assert_eq!(arrivals(&faults), [8, 10, 11, 20, 21], "what was held up has arrived");
    }
}
