//! Sample runs for tests, in virtual time; all atoms have the same cost.

use std::time::Duration;

use crate::balance::Strategy;
use crate::picture::Size;
use crate::record::Record;
use crate::runlog::{Driver, Header, LinkSettings, RunLog};
use crate::sim::Sim;

/// Cost of an atom on this computer; a node of speed 1 at pace 0.1 needs ten times as long.
pub const COST: Duration = Duration::from_millis(1);

/// Header of a run with these speeds on a picture of `atoms` atoms.
pub fn header(speeds: &[f64], atoms: u32) -> Header {
    let size = Size::new(50, atoms).expect("a small picture");
    let plain = Header::plain(size, 50, Strategy::Ring, speeds.to_vec());
    let link = LinkSettings { latency: Duration::from_millis(40), ..plain.link };
    Header { scene: "sample".into(), driver: Driver::Sim, pace: 0.1, link, cores: 2, ..plain }
}

/// Records of a whole run, in the order of their times.
pub fn records(header: &Header) -> Vec<Record> {
    let mut records = Vec::new();
    Sim::new(header, &[], |_| COST).run(&mut |record| records.push(record));
    records
}

/// A whole run with these speeds on a picture of `atoms` atoms.
pub fn log(speeds: &[f64], atoms: u32) -> RunLog {
    let header = header(speeds, atoms);
    let mut log = RunLog::new(header.clone());
    log.add(records(&header));
    log
}
