//! Rayon's work stealing on emulated machines: its records follow the same rules as those of other runs.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::time::Duration;

use anel::balance::{Message, NodeId, Party, Strategy};
use anel::driver::{Run, Update};
use anel::picture::{Atom, Colour, Size};
use anel::record::RecordKind;
use anel::runlog::{Driver, Header, LinkSettings, Metrics, RunLog};
use anel::scenario::Command;
use anel::time::Time;
use anel::tracer::Scratch;

const MS: Duration = Duration::from_millis(1);

/// 500 atoms of 10 pixels.
fn header(speeds: &[f64], pace: f64) -> Header {
    let plain = Header::plain(Size::new(100, 50).unwrap(), 10, Strategy::Ring, speeds.to_vec());
    // Links and handling do not apply to work stealing and must have no effect.
    let link = LinkSettings { latency: 3_600_000 * MS, bandwidth: Some(1.0), shared: true, ..LinkSettings::default() };
    Header { driver: Driver::WorkStealing, pace, link, handling: 1000 * MS, ..plain }
}

/// Traces pixels that cost some microseconds each.
fn trace(pixels: Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>) {
    for pixel in pixels {
        let x = (0..500).fold(pixel as f32, |x, _| (x + 1.3).sin());
        out.push([x, pixel as f32, 0.0]);
    }
}

/// The records of the run, which must finish.
fn log_of(run: &Run, header: &Header) -> RunLog {
    let mut log = RunLog::new(header.clone());
    for update in run.updates() {
        match update {
            Update::Records(records) => _ = log.add(records),
            Update::Finished => return log,
            Update::Failed(why) => panic!("{why}"),
            Update::Placed { .. } | Update::Rays(_) => {}
        }
    }
    panic!("the run ended without a last update");
}

#[test]
fn atom_takes_its_cost_over_speed_and_pace() {
    let header = header(&[0.5, 0.1, 1.0], 0.5);
    let log = log_of(&Run::start_with(trace, &header), &header);
    let mut started = [Time::ZERO; 3];
    for record in log.records() {
        match record.kind {
            RecordKind::AtomStarted { node, .. } => {
                assert!(record.at >= started[usize::from(node)]);
                started[usize::from(node)] = record.at;
            }
            RecordKind::AtomDone { node, cost, .. } => {
                let rate = header.speeds[usize::from(node)] * header.pace;
                let took = record.at.since(started[usize::from(node)]);
                assert!(took.abs_diff(cost.div_f64(rate)) <= Duration::from_nanos(1), "{took:?} for {cost:?}");
            }
            _ => {}
        }
    }
    assert_eq!(Metrics::of(&log).atoms_by_node().iter().sum::<u32>(), header.division.atoms());
}

/// Causes come before effects: only the owner of an atom starts it, which is the node that stole it last.
#[test]
fn records_show_the_owner_of_each_atom() {
    for pace in [1.0, 0.3] {
        let header = header(&[1.0, 1.0, 1.0, 1.0], pace);
        let log = log_of(&Run::start_with(trace, &header), &header);
        let mut owner: Vec<Option<NodeId>> = vec![None; header.division.atoms() as usize];
        let (mut in_flight, mut ids) = (BTreeMap::new(), BTreeSet::new());
        let (mut bands, mut shutdowns) = (0, 0);
        for record in log.records() {
            match &record.kind {
                RecordKind::Sent { id, from, to, message, arrives, .. } => {
                    assert!(ids.insert(*id) && *arrives > record.at);
                    in_flight.insert(*id, (*from, *to, message.clone(), *arrives));
                }
                RecordKind::Received { id, by } => {
                    let (from, to, message, arrives) = in_flight.remove(id).expect("a received message was sent");
                    assert!(to == *by && arrives <= record.at);
                    match (from, to, message) {
                        (Party::Parent, Party::Node(node), Message::Band(atoms)) => {
                            bands += 1;
                            set(&mut owner, atoms, None, node);
                        }
                        (Party::Node(from), Party::Node(to), Message::Transfer(ranges)) => {
                            ranges.into_iter().for_each(|atoms| set(&mut owner, atoms, Some(from), to));
                        }
                        (Party::Parent, _, Message::Shutdown) => shutdowns += 1,
                        (_, Party::Parent, Message::Results(_)) => {}
                        other => panic!("{other:?}"),
                    }
                }
                RecordKind::AtomStarted { node, atom } => assert_eq!(owner[*atom as usize], Some(*node)),
                _ => {}
            }
        }
        assert_eq!((bands, shutdowns, in_flight.len()), (4, 4, 0));
        assert!(Metrics::of(&log).messages().transfers >= 3);
    }
}

fn set(owner: &mut [Option<NodeId>], atoms: Range<Atom>, from: Option<NodeId>, to: NodeId) {
    for owner in &mut owner[atoms.start as usize..atoms.end as usize] {
        assert_eq!(*owner, from);
        *owner = Some(to);
    }
}

/// One of three machines is paused; the other two go on until nothing is left to steal, and their atoms are placed.
#[test]
fn paused_machine_keeps_one_atom_at_most() {
    for speed in [1.0, 0.4] {
        let header = header(&[speed, 1.0, 1.0], 1.0);
        let run = Run::start_with(trace, &header);
        run.command(Command::Pause { node: 0, paused: true });
        let mut placed = 0;
        // The paused machine holds one atom at most, and perhaps some results that it has not sent.
        while placed < header.division.atoms() * 9 / 10 {
            match run.updates().recv_timeout(Duration::from_secs(60)).expect("the other machines go on") {
                Update::Placed { atoms, .. } => placed += atoms.iter().map(|atoms| atoms.len() as u32).sum::<u32>(),
                Update::Finished => {
                    return assert!(placed == header.division.atoms(), "a finished run has placed all atoms");
                }
                Update::Failed(why) => panic!("{why}"),
                Update::Records(_) | Update::Rays(_) => {}
            }
        }
        run.command(Command::Pause { node: 0, paused: false });
        log_of(&run, &header);
    }
}

#[test]
fn saved_run_can_be_loaded() {
    let header = header(&[1.0, 0.5], 1.0);
    let log = log_of(&Run::start_with(trace, &header), &header);
    let directory = tempfile::TempDir::new().expect("a temporary directory");
    let path = directory.path().join("run.anel");
    log.save(&path).expect("it can be written");
    assert_eq!(RunLog::load(&path).expect("it can be read"), log);
}
