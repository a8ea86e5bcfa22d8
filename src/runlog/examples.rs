//! Small headers and records for tests.

use std::time::Duration;

use super::{Header, Link};
use crate::balance::{Message, NodeId, Party, Strategy};
use crate::picture::{Atom, Division, Size};
use crate::record::{Record, What};
use crate::time::Time;

/// A run of 10 × 10 pixels in atoms of 5 on nodes of these speeds, at full pace on 2 cores.
pub fn header(speeds: &[f64]) -> Header {
    Header {
        scene: "test".into(),
        scene_text: "x".repeat(100),
        // Neither side is 0.
        size: Size::new(10, 10).unwrap(),
        samples: 1,
        division: Division::new(100, 5),
        strategy: Strategy::Ring,
        speeds: speeds.to_vec(),
        pace: 1.0,
        link: Link { latency: Duration::ZERO, bandwidth: None },
        handling: Duration::ZERO,
        part: 1,
        cores: 2,
    }
}

/// `what` at `at` seconds.
pub fn at(at: u64, what: What) -> Record {
    Record { at: Time::ZERO + Duration::from_secs(at), what }
}

/// At `at` seconds, `node` is done with `atom`, at a cost of `cost` seconds.
pub fn done(at: u64, node: NodeId, atom: Atom, cost: u64) -> Record {
    self::at(at, What::AtomDone { node, atom, cost: Duration::from_secs(cost) })
}

/// At `at` seconds a message of 10 bytes leaves.
pub fn sent(at: u64, from: Party, to: Party, message: Message) -> Record {
    let arrives = Time::ZERO + Duration::from_secs(at + 1);
    self::at(at, What::Sent { id: 0, from, to, message, bytes: 10, arrives })
}
