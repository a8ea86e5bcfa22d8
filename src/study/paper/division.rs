//! The third way (§5): division of space, counted on one render.

use super::article::NETWORK;
use crate::space::{Partition, Traffic, traffic};
use crate::tracer::Tracer;

/// Numbers of machines among which the space is divided.
const OWNER_COUNTS: [u32; 3] = [2, 4, 16];

/// One pixel in seven is traced: few enough to be quick, and a prime.
const PIXEL_STRIDE: u32 = 7;

/// Traffic of a division of space.
pub(super) struct SpaceDivision {
    pub traffic: Traffic,
    /// Whether cells are dealt in runs, so that neighbouring cells mostly have one owner.
    pub runs: bool,
}

/// Counts the traffic for each number of owners and each way to deal cells.
pub(super) fn count(tracer: &Tracer) -> Vec<SpaceDivision> {
    let of = |owners, how| SpaceDivision {
        traffic: traffic(tracer, owners, how, PIXEL_STRIDE),
        runs: how == Partition::Runs,
    };
    OWNER_COUNTS
        .into_iter()
        .flat_map(|owners| [of(owners, Partition::Runs), of(owners, Partition::RoundRobin)])
        .collect()
}

impl SpaceDivision {
    /// Seconds for which the modelled network's wire is busy with rays and results.
    pub fn wire_s(&self) -> f64 {
        (self.traffic.ray_bytes() + self.traffic.answer_bytes()) as f64 / NETWORK.bandwidth
    }

    /// Seconds that all messages travel, one after the other.
    pub fn travel_s(&self) -> f64 {
        (self.traffic.messages + self.traffic.answers) as f64 * NETWORK.latency
    }
}
