//! Network faults: cut links, delays, and nodes that are cut off.

use std::collections::{BTreeMap, BTreeSet};

use crate::balance::{NodeId, Party};
use crate::time::Time;

/// The present faults of the network: cut links, delays, and nodes that are cut off from all others.
#[derive(Clone, Debug, Default)]
pub struct Faults {
    /// Cut links; the lesser party first.
    links: BTreeSet<(Party, Party)>,
    /// Nodes that are cut off.
    nodes: BTreeSet<NodeId>,
    /// By sender and receiver: messages that would arrive after the first time arrive no earlier than the second.
    delays: BTreeMap<(Party, Party), (Time, Time)>,
}

impl Faults {
    /// Cuts or restores the link between two parties, in both directions. Returns whether that changes anything.
    pub fn cut_link(&mut self, one: Party, other: Party, is_cut: bool) -> bool {
        set_member(&mut self.links, link(one, other), is_cut)
    }

    /// Cuts a node off from all others, or reconnects it.
    pub fn cut_off(&mut self, node: NodeId, is_cut_off: bool) {
        set_member(&mut self.nodes, node, is_cut_off);
    }

    /// Returns whether no message can pass between two parties. A party's messages to itself always pass.
    pub fn is_cut(&self, one: Party, other: Party) -> bool {
        let is_cut_off = |party| matches!(party, Party::Node(node) if self.nodes.contains(&node));
        one != other && (self.links.contains(&link(one, other)) || is_cut_off(one) || is_cut_off(other))
    }

    /// Delays the messages from one party to another: from `now` on none arrives before `until`. A longer delay that is
    /// in force stays. Returns when the delay ends.
    pub fn delay(&mut self, from: Party, to: Party, now: Time, until: Time) -> Time {
        let (since, until) = match self.delays.get(&(from, to)) {
            Some(&(since, longer)) if longer > now => (since, until.max(longer)),
            _ => (now, until),
        };
        self.delays.insert((from, to), (since, until));
        until
    }

    /// Returns when a message arrives that would arrive at `at` without delays.
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

/// Inserts or removes an element. Returns whether that changes the set.
fn set_member<T: Ord>(set: &mut BTreeSet<T>, element: T, is_in: bool) -> bool {
    if is_in { set.insert(element) } else { set.remove(&element) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_messages_of_the_delay_are_late() {
        let (one, two) = (Party::Node(1), Party::Node(2));
        let mut faults = Faults::default();
        let arrivals = |faults: &Faults| [8, 10, 11, 20, 21].map(|at| faults.arrival(one, two, Time(at)).0);
        assert_eq!(faults.delay(one, two, Time(10), Time(20)), Time(20));
        assert_eq!(arrivals(&faults), [8, 10, 20, 20, 21]);
        assert_eq!(faults.arrival(two, one, Time(11)), Time(11), "only one direction");
        assert_eq!(faults.delay(one, two, Time(12), Time(15)), Time(20), "the longer delay stays");
        assert_eq!(faults.delay(one, two, Time(14), Time(30)), Time(30));
        assert_eq!(arrivals(&faults), [8, 10, 30, 30, 30]);
        assert_eq!(faults.delay(one, two, Time(40), Time(50)), Time(50));
        assert_eq!(arrivals(&faults), [8, 10, 11, 20, 21], "the first delay is over");
    }
}
