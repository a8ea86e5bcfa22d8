//! Small headers and records for tests.

use std::time::Duration;

use super::Header;
use crate::balance::{Message, NodeId, Party, Strategy};
use crate::picture::{Atom, Size};
use crate::record::{Record, RecordKind};
use crate::time::Time;

/// Returns the header of a run of 10 × 10 pixels in atoms of 5, on nodes of these speeds, at full pace on 2 cores.
pub fn header(speeds: &[f64]) -> Header {
    // Neither side is 0.
    let size = Size::new(10, 10).unwrap();
    let plain = Header::plain(size, 5, Strategy::Ring, speeds.to_vec());
    Header { scene: "test".into(), scene_text: "x".repeat(100), cores: 2, ..plain }
}

/// Returns a record at `at` seconds.
pub fn at(at: u64, kind: RecordKind) -> Record {
    Record { at: Time::ZERO + Duration::from_secs(at), kind }
}

/// Returns a record that `node` has traced `atom` at `at` seconds, at a cost of `cost` seconds.
pub fn done(at: u64, node: NodeId, atom: Atom, cost: u64) -> Record {
    self::at(at, RecordKind::AtomDone { node, atom, cost: Duration::from_secs(cost) })
}

/// Returns a record that a message of 10 bytes leaves at `at` seconds.
pub fn sent(at: u64, from: Party, to: Party, message: Message) -> Record {
    let arrives = Time::ZERO + Duration::from_secs(at + 1);
    self::at(at, RecordKind::Sent { id: 0, from, to, message, bytes: 10, arrives })
}
