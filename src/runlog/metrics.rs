//! What a run amounts to: pure functions of its header and records, which are in the order of time.

use std::time::Duration;

use serde::Serialize;

use super::Header;
use crate::balance::{Message, Party};
use crate::record::{Record, What};
use crate::time::Time;

/// From the first band sent to the last atom placed; `None` while the picture is incomplete.
pub fn makespan(records: &[Record]) -> Option<Duration> {
    let start = start(records)?;
    let end = records.iter().rev().find(|record| record.what == What::Finished)?;
    Some(end.at.since(start))
}

/// Σ of the atoms' costs: CPU time of this computer in the tracer.
pub fn work(records: &[Record]) -> Duration {
    atoms_done(records).map(|done| done.cost).sum()
}

/// How long the work would have taken, had it been shared perfectly: the least T for which the emulated machines,
/// never more than the computer's cores, do all the work in T: ∫ min(Σ speed × pace, cores) dt = [`work`]. Speeds
/// that change count from then on, and a paused machine does nothing. `None` if the machines stand still before the
/// work is done.
pub fn ideal(header: &Header, records: &[Record]) -> Option<Duration> {
    let start = start(records)?;
    let mut machines: Vec<_> = header.speeds.iter().map(|&speed| Machine { speed, paused: false }).collect();
    let mut left = work(records).as_secs_f64();
    let mut since = start;
    for record in records {
        let (node, speed, paused) = match record.what {
            What::SpeedSet { node, speed } => (node, Some(speed), None),
            What::Paused { node } => (node, None, Some(true)),
            What::Resumed { node } => (node, None, Some(false)),
            _ => continue,
        };
        let span = record.at.since(since).as_secs_f64();
        let rate = rate(header, &machines);
        if left <= span * rate {
            break;
        }
        left -= span * rate;
        since = since.max(record.at);
        if let Some(machine) = machines.get_mut(usize::from(node)) {
            machine.speed = speed.unwrap_or(machine.speed);
            machine.paused = paused.unwrap_or(machine.paused);
        }
    }
    let rest = Duration::try_from_secs_f64(left / rate(header, &machines)).ok()?;
    Some(since.since(start) + rest)
}

/// [`ideal`] / [`makespan`]: 1 is perfect; `None` while either is unknown.
pub fn efficiency(header: &Header, records: &[Record]) -> Option<f64> {
    let (ideal, makespan) = (ideal(header, records)?, makespan(records)?);
    (!makespan.is_zero()).then(|| ideal.div_duration_f64(makespan))
}

/// From the moment at which the first node is done with its last atom to that at which the last is; nodes that traced
/// nothing do not count.
pub fn finish_spread(records: &[Record]) -> Duration {
    let mut ends: Vec<Option<Time>> = Vec::new();
    for done in atoms_done(records) {
        if ends.len() <= done.node {
            ends.resize(done.node + 1, None);
        }
        ends[done.node] = Some(done.at);
    }
    let ends = || ends.iter().flatten();
    ends().max().zip(ends().min()).map_or(Duration::ZERO, |(last, first)| last.since(*first))
}

/// How many atoms each node has traced.
pub fn atoms_by_node(header: &Header, records: &[Record]) -> Vec<u32> {
    let mut atoms = vec![0; header.speeds.len()];
    for done in atoms_done(records) {
        if let Some(count) = atoms.get_mut(done.node) {
            *count += 1;
        }
    }
    atoms
}

/// How much was said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Messages {
    /// Requests for work to the parent: a ring makes none.
    pub requests: u64,
    /// Offers that a node made.
    pub offers: u64,
    /// Offers passed on.
    pub hops: u64,
    /// Offers taken.
    pub transfers: u64,
    /// Atoms in the transfers.
    pub atoms_moved: u64,
    /// Batches of results.
    pub results: u64,
    /// Messages of every kind.
    pub total: u64,
    /// Their weight ([`Message::bytes`]).
    pub bytes: u64,
}

/// Counts the messages sent.
pub fn messages(records: &[Record]) -> Messages {
    let mut count = Messages::default();
    for record in records {
        let What::Sent { from, message, bytes, .. } = &record.what else { continue };
        count.total += 1;
        count.bytes += bytes;
        match message {
            Message::Offer { who, .. } if Party::Node(*who) == *from => count.offers += 1,
            Message::Offer { .. } => count.hops += 1,
            Message::Transfer(ranges) => {
                count.transfers += 1;
                count.atoms_moved += ranges.iter().map(|range| range.len() as u64).sum::<u64>();
            }
            Message::Results(_) => count.results += 1,
            Message::Band(_) | Message::Shutdown => {}
        }
    }
    count
}

struct Done {
    at: Time,
    node: usize,
    cost: Duration,
}

fn atoms_done(records: &[Record]) -> impl Iterator<Item = Done> {
    records.iter().filter_map(|record| match record.what {
        What::AtomDone { node, cost, .. } => Some(Done { at: record.at, node: usize::from(node), cost }),
        _ => None,
    })
}

/// When the first band left.
fn start(records: &[Record]) -> Option<Time> {
    let band = |record: &&Record| matches!(record.what, What::Sent { message: Message::Band(_), .. });
    records.iter().find(band).map(|record| record.at)
}

struct Machine {
    speed: f64,
    paused: bool,
}

/// CPU seconds of this computer that all machines together do in a second.
fn rate(header: &Header, machines: &[Machine]) -> f64 {
    let speeds = machines.iter().map(|machine| if machine.paused { 0.0 } else { machine.speed });
    (speeds.sum::<f64>() * header.pace).min(header.cores as f64)
}

#[cfg(test)]
mod tests {
    use super::super::examples::{at, done, header, sent};
    use super::*;

    const PARENT: Party = Party::Parent;

    fn node(node: u16) -> Party {
        Party::Node(node)
    }

    /// Two nodes, 20 CPU seconds, from second 1 to second 13.
    fn run() -> Vec<Record> {
        vec![
            sent(1, PARENT, node(0), Message::Band(0..10)),
            sent(1, PARENT, node(1), Message::Band(10..20)),
            done(6, 0, 0, 5),
            sent(6, node(0), node(1), Message::Offer { who: 0, done: 1 }),
            sent(7, node(1), node(0), Message::Transfer(vec![15..17, 18..20])),
            done(9, 1, 10, 7),
            sent(9, node(1), node(0), Message::Offer { who: 1, done: 1 }),
            sent(10, node(0), node(1), Message::Offer { who: 1, done: 1 }),
            done(12, 0, 15, 8),
            sent(12, node(0), PARENT, Message::Results(vec![0..1, 15..16])),
            at(13, What::Finished),
            sent(13, PARENT, node(0), Message::Shutdown),
        ]
    }

    fn secs(secs: u64) -> Option<Duration> {
        Some(Duration::from_secs(secs))
    }

    #[test]
    fn the_work_and_its_end() {
        let run = run();
        assert_eq!((makespan(&run), work(&run)), (secs(12), Duration::from_secs(20)));
        assert_eq!(makespan(&run[..10]), None, "before the end");
        assert_eq!(finish_spread(&run), Duration::from_secs(3));
        assert_eq!(finish_spread(&[]), Duration::ZERO);
        assert_eq!(atoms_by_node(&header(&[1.0; 3]), &run), [2, 1, 0]);
    }

    #[test]
    fn the_ideal_is_bounded_by_machines_and_by_cores() {
        let run = run();
        assert_eq!(ideal(&header(&[1.0, 1.0]), &run), secs(10));
        assert_eq!(ideal(&header(&[0.25, 0.25]), &run), secs(40));
        assert_eq!(ideal(&header(&[1.0; 8]), &run), secs(10), "eight machines on two cores");
        assert_eq!(ideal(&Header { pace: 0.1, ..header(&[1.0, 1.0]) }, &run), secs(100));
        assert_eq!(efficiency(&header(&[1.0, 1.0]), &run), Some(10.0 / 12.0));
    }

    #[test]
    fn the_ideal_knows_when_speeds_changed() {
        let header = header(&[1.0, 1.0]);
        let mut run = run();
        // Two a second for 3 s, from then on one a second for the 14 that are left.
        run.insert(2, at(4, What::SpeedSet { node: 1, speed: 0.0 }));
        assert_eq!(ideal(&header, &run), secs(17));
        run.insert(3, at(5, What::SpeedSet { node: 0, speed: 0.0 }));
        assert_eq!(ideal(&header, &run), None, "nobody works any more");
        run.insert(6, at(8, What::SpeedSet { node: 0, speed: 0.5 }));
        assert_eq!(ideal(&header, &run), secs(7 + 26));
    }

    #[test]
    fn a_paused_machine_counts_as_one_that_stands_still() {
        let header = header(&[1.0, 1.0]);
        let mut run = run();
        // Two a second for 3 s, one a second for 5, and again two a second for the 9 that are left.
        run.insert(2, at(4, What::Paused { node: 1 }));
        assert_eq!(ideal(&header, &run), secs(17), "until the end");
        run.insert(6, at(9, What::Resumed { node: 1 }));
        assert_eq!(ideal(&header, &run), Some(Duration::from_millis(12_500)));
        // A speed that is set meanwhile counts from then on.
        run.insert(3, at(5, What::SpeedSet { node: 1, speed: 0.5 }));
        assert_eq!(ideal(&header, &run), secs(8 + 6));
    }

    #[test]
    fn a_change_after_the_ideal_end_does_not_matter() {
        let mut run = run();
        run.push(at(14, What::SpeedSet { node: 0, speed: 0.0 }));
        assert_eq!(ideal(&header(&[1.0, 1.0]), &run), secs(10));
    }

    #[test]
    fn messages_are_told_apart() {
        let expected =
            Messages { requests: 0, offers: 2, hops: 1, transfers: 1, atoms_moved: 4, results: 1, total: 8, bytes: 80 };
        assert_eq!(messages(&run()), expected);
    }
}
