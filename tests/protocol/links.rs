//! Links with a latency and a bandwidth of their own at each end: when messages arrive, in virtual time and on threads.

use std::collections::BTreeMap;
use std::time::Duration;

use anel::balance::{Party, Strategy};
use anel::driver::Run;
use anel::picture::{Colour, Size};
use anel::record::{Record, RecordKind};
use anel::runlog::{Header, LinkSettings, OwnLink};
use anel::scenario::Command;
use anel::time::Time;
use anel::tracer::Scratch;
use fastrand::Rng;

use crate::{virtual_time, watched};

const MS: Duration = Duration::from_millis(1);

/// A run of four machines with these latencies and bandwidths.
fn header(strategy: Strategy, latencies: &[Duration], bandwidths: &[f64]) -> Header {
    let mut header = Header::plain(Size::new(40, 10).expect("a size"), 10, strategy, vec![1.0, 1.0, 0.5, 0.2]);
    header.link.set_latencies(latencies);
    header.link.set_bandwidths(bandwidths);
    header
}

/// Asserts that each message leaves after those before it on its link, at the smaller bandwidth of its two ends, and
/// travels for the larger latency. `latency` and `bandwidth` are those of a party.
fn assert_arrivals(records: &[Record], latency: impl Fn(Party) -> Duration, bandwidth: impl Fn(Party) -> f64) {
    let mut links: BTreeMap<(Party, Party), (Time, Time)> = BTreeMap::new();
    let mut messages = 0;
    for record in records {
        let RecordKind::Sent { from, to, bytes, arrives, .. } = &record.kind else { continue };
        let (free, last) = links.entry((*from, *to)).or_default();
        let seconds = *bytes as f64 / bandwidth(*from).min(bandwidth(*to));
        *free = (*free).max(record.at) + Duration::from_nanos(Time::from_secs(seconds).0);
        let travels = latency(*from).max(latency(*to)).max(Duration::from_nanos(1));
        *last = (*free + travels).max(*last);
        assert_eq!(arrives, last, "{from:?} to {to:?}, {bytes} bytes at {:?}", record.at);
        messages += 1;
    }
    assert!(messages > 20, "{messages}");
}

/// By node; the parent has no latency and no limit.
fn of_node<T: Copy>(values: &[T], party: Party, parent: T) -> T {
    if let Party::Node(node) = party { values[usize::from(node)] } else { parent }
}

#[test]
fn message_takes_the_larger_latency_and_the_smaller_bandwidth_of_its_two_ends() {
    let mut rng = Rng::with_seed(7);
    for strategy in [Strategy::Ring, Strategy::Adaptive, Strategy::Farm, Strategy::FarmLeases] {
        let latencies: Vec<_> = (0..4).map(|_| rng.u32(0..30) * MS).collect();
        let bandwidths: Vec<_> = (0..4).map(|_| f64::from(rng.u32(1000..100_000))).collect();
        let header = header(strategy, &latencies, &bandwidths);
        let log = virtual_time::run(&header, &[], |atom| f64::from(1 + atom % 3) * 1e-3);
        let latency = |party| of_node(&latencies, party, Duration::ZERO);
        assert_arrivals(log.records(), latency, |party| of_node(&bandwidths, party, f64::INFINITY));
    }
}

#[test]
fn parent_can_have_a_latency_and_a_bandwidth_of_its_own() {
    let mut header = header(Strategy::Farm, &[2 * MS, MS, 9 * MS, MS], &[5e4]);
    header.link.parent = OwnLink { latency: Some(5 * MS), bandwidth: Some(2e4) };
    let log = virtual_time::run(&header, &[], |_| 1e-3);
    let latency = |party| of_node(&[2 * MS, MS, 9 * MS, MS], party, 5 * MS);
    assert_arrivals(log.records(), latency, |party| of_node(&[5e4; 4], party, 2e4));
}

#[test]
fn own_links_hold_on_threads_too() {
    let latencies = [MS, Duration::ZERO, 20 * MS, 2 * MS];
    let bandwidths = [1e6, 1e5, 1e7, 1e6];
    let header = header(Strategy::Ring, &latencies, &bandwidths);
    let trace = |pixels: std::ops::Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>| {
        std::thread::sleep(MS / 2);
        out.extend(pixels.map(|_| [0.0; 3]));
    };
    let (frame, records) = watched::picture(&Run::start_with(trace, &header), &header);
    frame.expect("a picture");
    let latency = |party| of_node(&latencies, party, Duration::ZERO);
    assert_arrivals(&records, latency, |party| of_node(&bandwidths, party, f64::INFINITY));
}

#[test]
fn one_number_means_all_nodes() {
    for strategy in Strategy::ALL {
        let run = |header: &Header| virtual_time::run(header, &[], |atom| f64::from(1 + atom % 3) * 1e-3);
        let one = header(strategy.clone(), &[5 * MS], &[1e5]);
        let each = header(strategy.clone(), &[5 * MS; 4], &[1e5; 4]);
        assert_eq!(one.link, LinkSettings { latency: 5 * MS, bandwidth: Some(1e5), ..LinkSettings::default() });
        assert_eq!(run(&one), run(&each), "{strategy}");
    }
}

#[test]
fn own_latency_can_change_during_the_run() {
    let at = Time::ZERO + 20 * MS;
    let far = Command::OwnLatency { party: Party::Node(1), latency: Some(300 * MS) };
    let near = Command::OwnLatency { party: Party::Node(1), latency: None };
    let nobody = Command::OwnLatency { party: Party::Node(9), latency: Some(MS) };
    let script = [(at, far), (at, nobody), (at + 400 * MS, near), (at + 400 * MS, near)];
    let log = virtual_time::run(&header(Strategy::Farm, &[MS], &[]), &script, |_| 20e-3);
    let mut set = Vec::new();
    for record in log.records() {
        match &record.kind {
            RecordKind::OwnLatencySet { party, latency } => set.push((record.at, *party, *latency)),
            RecordKind::Sent { from: Party::Node(1), arrives, .. } if record.at > at + 400 * MS => {
                assert!(arrives.since(record.at) <= 300 * MS);
            }
            RecordKind::Sent { from: Party::Node(1), arrives, .. } if record.at > at => {
                assert_eq!(arrives.since(record.at), 300 * MS);
            }
            _ => {}
        }
    }
    let node = Party::Node(1);
    assert_eq!(set, [(at, node, Some(300 * MS)), (at + 400 * MS, node, None)], "each change has one record");
}
