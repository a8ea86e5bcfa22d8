//! The members of the ring, and the stops of an offer on its way round it.

use std::collections::BTreeSet;

use crate::balance::message::NodeId;

/// The ring as a node knows it: all nodes except those that are gone.
#[derive(Clone, Debug)]
pub struct RingMembers {
    nodes: NodeId,
    gone: BTreeSet<NodeId>,
    shortcuts: bool,
}

impl RingMembers {
    /// Creates a ring of `nodes` nodes (at least one), none of which is gone. With `shortcuts` the distances of an
    /// offer's stops grow like powers of two; without, an offer stops at every node.
    pub fn new(nodes: NodeId, shortcuts: bool) -> Self {
        Self { nodes: nodes.max(1), gone: BTreeSet::new(), shortcuts }
    }

    /// Replaces the set of nodes that are gone.
    pub fn set_gone(&mut self, gone: impl IntoIterator<Item = NodeId>) {
        self.gone = gone.into_iter().collect();
    }

    /// Returns whether this node is gone.
    pub fn is_gone(&self, node: NodeId) -> bool {
        self.gone.contains(&node)
    }

    /// Returns how many stops an offer has: with shortcuts one for each of up to 8 other nodes, then two for each
    /// doubling of the ring.
    pub fn stops(&self) -> u16 {
        let others = self.nodes - 1;
        if !self.shortcuts || others <= 8 {
            return others;
        }
        (0..).take_while(|&stop| distance(stop) < self.nodes).count() as u16
    }

    /// Returns stop number `stop` (from 0) of an offer of `who`: the node at that stop's distance to its left, or the
    /// next one there that is not gone; `who` itself if no other node is left.
    pub fn stop(&self, who: NodeId, stop: u16) -> NodeId {
        let first = if self.shortcuts { distance(stop) } else { stop + 1 };
        let left =
            |by: NodeId| ((u32::from(who) + u32::from(self.nodes) - u32::from(by)) % u32::from(self.nodes)) as NodeId;
        (first..self.nodes).map(left).find(|node| !self.is_gone(*node)).unwrap_or(who)
    }
}

/// Returns the distance of a stop with shortcuts: 1 to 8 one by one, then 12, 16, 24, 32, 48, …
fn distance(stop: u16) -> u16 {
    if stop < 8 {
        return stop + 1;
    }
    let doubling = (stop - 8) / 2;
    let base: u32 = if (stop - 8).is_multiple_of(2) { 12 } else { 16 };
    (base << doubling.min(16)).min(u32::from(u16::MAX)) as u16
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn small_ring_has_every_node_as_a_stop() {
        for shortcuts in [false, true] {
            let ring = RingMembers::new(5, shortcuts);
            let stops: Vec<_> = (0..ring.stops()).map(|stop| ring.stop(2, stop)).collect();
            assert_eq!(stops, [1, 0, 4, 3]);
        }
    }

    #[test]
    fn stops_grow_like_the_logarithm() {
        let stops = [9, 16, 17, 64, 256, 1024].map(|nodes| RingMembers::new(nodes, true).stops());
        assert_eq!(stops, [8, 9, 10, 13, 17, 21]);
        let ring = RingMembers::new(40, true);
        let far: Vec<_> = (0..ring.stops()).map(|stop| ring.stop(39, stop)).collect();
        assert_eq!(far, [38, 37, 36, 35, 34, 33, 32, 31, 27, 23, 15, 7]);
    }

    proptest! {
        #[test]
        fn no_stop_is_a_node_that_is_gone(
            nodes in 1u16..80, gone in prop::collection::btree_set(0u16..80, 0..80), shortcuts in any::<bool>(),
        ) {
            let mut ring = RingMembers::new(nodes, shortcuts);
            ring.set_gone(gone.iter().copied());
            for who in (0..nodes).filter(|who| !gone.contains(who)) {
                for stop in 0..ring.stops() {
                    let at = ring.stop(who, stop);
                    prop_assert!(at < nodes && !gone.contains(&at));
                }
            }
        }
    }
}
