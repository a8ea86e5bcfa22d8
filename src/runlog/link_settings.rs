//! The network of a run: latency and bandwidth of all links, and what a party has of its own.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::balance::{NodeId, Party};

/// Latency and bandwidth of the links between any two parties, the parent included.
///
/// Each party has a latency and a bandwidth at its end of every link: its own, or else a node has those of all nodes,
/// and the parent has none. A message takes the larger latency and the smaller bandwidth of its two ends.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LinkSettings {
    /// Travel time of a message's last byte, for each node that has none of its own.
    pub latency: Duration,
    /// Bytes per second, for each node that has none of its own; `None` is unlimited.
    pub bandwidth: Option<f64>,
    /// Whether all parties share one wire, as on an Ethernet of 1997; else each pair has its own.
    pub shared: bool,
    /// By node: what it has of its own. Nodes after the last one have nothing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub nodes: Vec<OwnLink>,
    /// What the parent has of its own.
    #[serde(default, skip_serializing_if = "OwnLink::is_empty")]
    pub parent: OwnLink,
}

/// Latency and bandwidth that a party has of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OwnLink {
    /// Travel time of the last byte of a message from or to the party.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub latency: Option<Duration>,
    /// Bytes per second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bandwidth: Option<f64>,
}

impl OwnLink {
    /// Returns whether the party has nothing of its own.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl LinkSettings {
    /// Returns the latency and the bandwidth of a message between two parties, in either direction.
    pub fn between(&self, one: Party, other: Party) -> (Duration, Option<f64>) {
        let latency = self.latency_of(one).max(self.latency_of(other));
        let bandwidths = [self.bandwidth_of(one), self.bandwidth_of(other)];
        (latency, bandwidths.into_iter().flatten().reduce(f64::min))
    }

    /// Returns the latency at a party's end of its links.
    pub fn latency_of(&self, party: Party) -> Duration {
        let usual = if party == Party::Parent { Duration::ZERO } else { self.latency };
        self.own(party).latency.unwrap_or(usual)
    }

    /// Returns the bandwidth at a party's end of its links; `None` is unlimited.
    pub fn bandwidth_of(&self, party: Party) -> Option<f64> {
        let usual = if party == Party::Parent { None } else { self.bandwidth };
        self.own(party).bandwidth.or(usual)
    }

    /// Returns what a party has of its own.
    pub fn own(&self, party: Party) -> OwnLink {
        match party {
            Party::Parent => self.parent,
            Party::Node(node) => self.nodes.get(usize::from(node)).copied().unwrap_or_default(),
        }
    }

    /// Sets what a party has of its own.
    pub fn set_own(&mut self, party: Party, own: OwnLink) {
        match party {
            Party::Parent => self.parent = own,
            Party::Node(node) => {
                let node = usize::from(node);
                if self.nodes.len() <= node {
                    self.nodes.resize(node + 1, OwnLink::default());
                }
                self.nodes[node] = own;
                self.trim(usize::MAX);
            }
        }
    }

    /// Sets the latency of each node, or with one value of all nodes. The most frequent one becomes that of all, and
    /// the others are nodes' own.
    pub fn set_latencies(&mut self, latencies: &[Duration]) {
        self.latency = most_frequent(latencies).unwrap_or_default();
        for (node, &latency) in (0..).zip(latencies) {
            let own = OwnLink { latency: (latency != self.latency).then_some(latency), ..self.own(Party::Node(node)) };
            self.set_own(Party::Node(node), own);
        }
    }

    /// Sets the bandwidth of each node, or with one value of all nodes, in the same way; with none it is unlimited.
    pub fn set_bandwidths(&mut self, bandwidths: &[f64]) {
        self.bandwidth = most_frequent(bandwidths);
        for (node, &bandwidth) in (0..).zip(bandwidths) {
            let own = (Some(bandwidth) != self.bandwidth).then_some(bandwidth);
            self.set_own(Party::Node(node), OwnLink { bandwidth: own, ..self.own(Party::Node(node)) });
        }
    }

    /// Forgets what nodes from this number on have of their own.
    pub fn trim(&mut self, nodes: usize) {
        self.nodes.truncate(nodes);
        while self.nodes.last().is_some_and(OwnLink::is_empty) {
            self.nodes.pop();
        }
    }

    /// Iterates over the parties that have something of their own among the parent and these nodes.
    pub fn owners(&self, nodes: NodeId) -> impl Iterator<Item = Party> + '_ {
        let parties = std::iter::once(Party::Parent).chain((0..nodes).map(Party::Node));
        parties.filter(|&party| !self.own(party).is_empty())
    }
}

/// Returns the most frequent value, of equally frequent ones the first; `None` if there is no value.
fn most_frequent<T: Copy + PartialEq>(values: &[T]) -> Option<T> {
    let count = |value: &T| values.iter().filter(|other| *other == value).count();
    values.iter().rev().max_by_key(|value| count(value)).copied()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const MS: Duration = Duration::from_millis(1);

    proptest! {
        #[test]
        fn message_takes_the_larger_latency_and_the_smaller_bandwidth_of_its_two_ends(
            latencies in prop::collection::vec(0u32..5, 1..6), bandwidths in prop::collection::vec(1u32..5, 1..6),
            parent in (prop::option::of(0u32..5), prop::option::of(1u32..5)),
        ) {
            let latencies: Vec<_> = latencies.into_iter().map(|ms| ms * MS).collect();
            let bandwidths: Vec<_> = bandwidths.into_iter().map(f64::from).collect();
            let mut link = LinkSettings::default();
            link.set_latencies(&latencies);
            link.set_bandwidths(&bandwidths);
            link.parent = OwnLink { latency: parent.0.map(|ms| ms * MS), bandwidth: parent.1.map(f64::from) };
            // Lists of different lengths: nodes after the last one have those of all.
            let latency = |node: NodeId| latencies.get(usize::from(node)).copied().unwrap_or(link.latency);
            let bandwidth = |node: NodeId| bandwidths.get(usize::from(node)).copied().or(link.bandwidth);
            for one in 0..6 {
                let of_parent = (link.parent.latency.unwrap_or_default(), link.parent.bandwidth.unwrap_or(f64::MAX));
                let slower = bandwidth(one).map(|bandwidth| bandwidth.min(of_parent.1));
                let expected = (latency(one).max(of_parent.0), slower);
                prop_assert_eq!(link.between(Party::Parent, Party::Node(one)), expected);
                prop_assert_eq!(link.between(Party::Node(one), Party::Parent), expected);
                for other in 0..6 {
                    let narrower = bandwidth(one).into_iter().chain(bandwidth(other)).reduce(f64::min);
                    let expected = (latency(one).max(latency(other)), narrower);
                    prop_assert_eq!(link.between(Party::Node(one), Party::Node(other)), expected);
                }
            }
        }

        #[test]
        fn equal_values_are_written_as_one_number_means_all(values in 1usize..6, ms in 0u32..9) {
            let (mut one, mut all) = (LinkSettings::default(), LinkSettings::default());
            one.set_latencies(&[ms * MS]);
            all.set_latencies(&vec![ms * MS; values]);
            prop_assert_eq!(&one, &all);
            prop_assert!(all.nodes.is_empty() && all.latency == ms * MS);
        }
    }

    #[test]
    fn links_without_their_own_are_written_as_before() {
        let plain = LinkSettings { latency: MS, ..LinkSettings::default() };
        let written = serde_json::to_string(&plain).expect("it has a JSON form");
        assert_eq!(written, r#"{"latency":{"secs":0,"nanos":1000000},"bandwidth":null,"shared":false}"#);
        let mut far = plain.clone();
        far.set_latencies(&[MS, MS, 50 * MS, MS]);
        assert_eq!((far.latency, far.nodes.len(), far.latency_of(Party::Node(2))), (MS, 3, 50 * MS));
        assert_eq!(far.owners(4).collect::<Vec<_>>(), [Party::Node(2)]);
        let written = serde_json::to_string(&far).expect("it has a JSON form");
        assert_eq!(serde_json::from_str::<LinkSettings>(&written).expect("it is read back"), far);
        far.trim(2);
        assert_eq!(far, plain);
    }
}
