//! The third way (§5): dividing the scene's space, counted on one render.

use super::article::NETWORK;
use crate::space::{Partition, Traffic, traffic};
use crate::tracer::Tracer;

/// Among how many machines the space is divided.
const OWNERS: [u32; 3] = [2, 4, 16];

/// One pixel in so many is looked at: few enough to be quick, and a prime.
const EVERY: u32 = 7;

/// What dividing the space means, and among whom.
pub(super) struct SpaceDivision {
    pub traffic: Traffic,
    /// Whether neighbouring cells mostly have one owner.
    pub runs: bool,
}

/// The counts, by how many owners there are and how the cells are dealt.
pub(super) fn count(tracer: &Tracer) -> Vec<SpaceDivision> {
    let of = |owners, how| SpaceDivision { traffic: traffic(tracer, owners, how, EVERY), runs: how == Partition::Runs };
    OWNERS.into_iter().flat_map(|owners| [of(owners, Partition::Runs), of(owners, Partition::RoundRobin)]).collect()
}

impl SpaceDivision {
    /// Seconds for which the modelled network's wire is busy with the rays and their results.
    pub fn wire_s(&self) -> f64 {
        (self.traffic.ray_bytes() + self.traffic.answer_bytes()) as f64 / NETWORK.bandwidth
    }

    /// Seconds of travel, if each message is waited for by itself.
    pub fn travel_s(&self) -> f64 {
        (self.traffic.messages + self.traffic.answers) as f64 * NETWORK.latency
    }
}
