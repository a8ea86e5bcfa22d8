//! Runs in virtual time, and the rules that hold for each of them.

use std::collections::BTreeSet;
use std::time::Duration;

use anel::balance::{Message, Party, Remedies, Strategy};
use anel::picture::Atom;
use anel::record::RecordKind;
use anel::runlog::{Header, RunLog};
use anel::scenario::Command;
use anel::sim::Sim;
use anel::time::Time;

/// Executes the run that `header` describes, with the commands of `script`; `cost` gives an atom's CPU seconds.
///
/// # Panics
/// If the run gets stuck, if time goes back, if a worker traces two atoms at once, if a node has two offers under way,
/// or if an atom is not traced and placed exactly once (at least once in the adaptive ring).
pub fn run(header: &Header, script: &[(Time, Command)], cost: fn(Atom) -> f64) -> RunLog {
    let mut sim = Sim::new(header, script, move |atom| Duration::from_secs_f64(cost(atom)));
    let mut records = Vec::new();
    sim.run(&mut |record| records.push(record));
    assert!(sim.is_finished(), "the run is stuck: no event is left");
    assert!(records.is_sorted_by_key(|record| record.at), "time went back");
    let mut log = RunLog::new(header.clone());
    log.add(records);
    check_atoms(&log);
    check_offers(&log);
    log
}

fn check_atoms(log: &RunLog) {
    let atoms = log.header.division.atoms() as usize;
    let (mut traced, mut placed) = (vec![0; atoms], vec![0; atoms]);
    let mut in_hand = BTreeSet::new();
    for record in log.records() {
        match &record.kind {
            RecordKind::AtomStarted { node, .. } => assert!(in_hand.insert(*node), "node {node} traces two atoms"),
            RecordKind::AtomDone { node, atom, .. } => {
                assert!(in_hand.remove(node), "node {node} finishes an atom that it has not started");
                traced[*atom as usize] += 1;
            }
            RecordKind::Sent { to: Party::Parent, message: Message::Results(ranges), .. } => {
                ranges.iter().cloned().flatten().for_each(|atom| placed[atom as usize] += 1);
            }
            _ => {}
        }
    }
    // The adaptive ring and the farm with leases may trace an atom more than once; the first result counts.
    let most = if may_repeat(log) { u32::MAX } else { 1 };
    let right = |times: &u32| (1..=most).contains(times);
    assert!(traced.iter().chain(&placed).all(right), "an atom is missing or repeated: {:?}", log.header);
}

fn may_repeat(log: &RunLog) -> bool {
    let rules = log.header.rules.clone();
    rules.strategy == Strategy::FarmLeases || rules.strategy == Strategy::Adaptive && rules.remedies != Remedies::NONE
}

fn check_offers(log: &RunLog) {
    if may_repeat(log) {
        return;
    }
    let mut under_way = vec![false; log.header.speeds.len()];
    for record in log.records() {
        match &record.kind {
            RecordKind::Sent { from, message: Message::Offer { who, .. }, .. } if *from == Party::Node(*who) => {
                let offers = std::mem::replace(&mut under_way[usize::from(*who)], true);
                assert!(!offers, "node {who} has two offers under way");
            }
            RecordKind::Sent { to: Party::Node(to), message: Message::Transfer(_), .. } => {
                under_way[usize::from(*to)] = false;
            }
            _ => {}
        }
    }
    if !log.header.rules.strategy.is_ring() {
        assert!(!under_way.contains(&true), "only a ring has offers");
    }
}
