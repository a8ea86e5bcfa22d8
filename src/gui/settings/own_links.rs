//! What machines and the parent have of their own at their ends of the links.

use serde::{Deserialize, Serialize};

use super::Settings;
use crate::balance::{NodeId, Party};

/// Latency and bandwidth that a machine or the parent has of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct OwnLinkSetting {
    /// Milliseconds, at most [`Settings::MAX_LATENCY_MS`].
    pub latency: Option<f64>,
    /// kB/s, from 1 to [`Settings::MAX_BANDWIDTH_KB_S`].
    pub bandwidth: Option<u32>,
}

impl OwnLinkSetting {
    fn is_empty(self) -> bool {
        self == Self::default()
    }
}

impl Settings {
    /// Returns what a party has of its own.
    pub fn own_link(&self, party: Party) -> OwnLinkSetting {
        match party {
            Party::Parent => self.parent_link,
            Party::Node(node) => self.own_links.get(usize::from(node)).copied().unwrap_or_default(),
        }
    }

    /// Sets what a party has of its own.
    pub fn set_own_link(&mut self, party: Party, own: OwnLinkSetting) {
        match party {
            Party::Parent => self.parent_link = own,
            Party::Node(node) => {
                let place = usize::from(node);
                if self.own_links.len() <= place {
                    self.own_links.resize(place + 1, OwnLinkSetting::default());
                }
                self.own_links[place] = own;
                self.trim_links();
            }
        }
    }

    /// Iterates over the parent and all machines, spare ones last.
    pub fn parties(&self) -> impl Iterator<Item = Party> + use<> {
        // At most 32 machines.
        let machines = (self.speeds.len() + self.spares.len()) as NodeId;
        std::iter::once(Party::Parent).chain((0..machines).map(Party::Node))
    }

    /// Returns the number of parties that have something of their own.
    pub fn own_link_count(&self) -> usize {
        self.parties().filter(|&party| !self.own_link(party).is_empty()).count()
    }

    /// Forgets all own latencies, but not the bandwidths.
    pub(super) fn clear_own_latencies(&mut self) {
        self.own_links.iter_mut().chain([&mut self.parent_link]).for_each(|own| own.latency = None);
        self.trim_links();
    }

    /// Keeps the spare machines' own links after the number of other machines has changed from `before`.
    pub(super) fn move_spare_links(&mut self, before: usize) {
        let of_spares = self.own_links.split_off(before.min(self.own_links.len()));
        self.own_links.resize(self.speeds.len(), OwnLinkSetting::default());
        self.own_links.extend(of_spares);
        self.trim_links();
    }

    /// Drops the links of machines that are not there, and entries without meaning at the end.
    pub(super) fn trim_links(&mut self) {
        self.own_links.truncate(self.speeds.len() + self.spares.len());
        while self.own_links.last().is_some_and(|own| own.is_empty()) {
            self.own_links.pop();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn own_links_follow_their_machines() {
        let own = |ms| OwnLinkSetting { latency: Some(ms), bandwidth: None };
        let mut settings = Settings { speeds: vec![1.0; 4], spares: vec![1.0; 2], ..Settings::default() };
        settings.set_own_link(Party::Node(1), own(5.0));
        settings.set_own_link(Party::Node(5), own(9.0));
        let links =
            |settings: &Settings| settings.parties().map(|of| settings.own_link(of).latency).collect::<Vec<_>>();
        assert_eq!(links(&settings), [None, None, Some(5.0), None, None, None, Some(9.0)]);
        settings.set_nodes(3);
        assert_eq!(links(&settings), [None, None, Some(5.0), None, None, Some(9.0)]);
        settings.set_nodes(5);
        assert_eq!(links(&settings), [None, None, Some(5.0), None, None, None, None, Some(9.0)]);
        settings.set_spares(1);
        assert_eq!((settings.own_links.len(), settings.own_link_count()), (2, 1));
        settings.set_own_link(Party::Node(1), OwnLinkSetting::default());
        assert!(settings.own_links.is_empty());
    }
}
