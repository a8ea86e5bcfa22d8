//! Two hundred runs on threads whose machines hang, are cut off, are switched off and restart, and whose links are cut:
//! the picture is byte for byte the one that a single node traces, and no thread is left behind.

use std::sync::Arc;
use std::time::Duration;

use anel::balance::{Condition, Message, NodeId, Party, Rules, Strategy};
use anel::driver::Run;
use anel::picture::{Colour, Frame, Quality, Size};
use anel::record::{Record, RecordKind};
use anel::runlog::{Header, LinkSettings};
use anel::scenario::Command;
use anel::scene::{Scene, built_in};
use anel::tracer::{Scratch, Tracer};
use fastrand::Rng;

use crate::{threads, turn, watched};

const MS: Duration = Duration::from_millis(1);

/// How often each failure happened; each must happen in some run, or the test shows nothing.
#[derive(Debug, Default)]
struct Failures {
    hung: u32,
    cut_off: u32,
    off: u32,
    restarted: u32,
    links_cut: u32,
    delayed: u32,
    stopped: u32,
    lost: u32,
    given_out_again: u32,
    /// Runs at whose end a machine was unreachable.
    unreachable_at_end: u32,
}

#[test]
fn failing_machines_and_links_do_not_change_the_picture() {
    let _turn = turn();
    let before = threads().len();
    let size = Size::new(40, 25).expect("a size");
    let scene = Scene::parse(built_in("ten-objects").expect("a built-in scene")).expect("a scene");
    let tracer = Arc::new(Tracer::new(&scene, size, Quality::default()));
    let mut plain = Vec::new();
    tracer.trace(0..size.pixels(), &mut Scratch::default(), &mut plain);
    let mut failures = Failures::default();
    for seed in 0..200 {
        // Half of the runs each.
        let strategy = [Strategy::Adaptive, Strategy::FarmLeases][seed as usize % 2].clone();
        let frame = run_with_failures(&tracer, strategy, &mut Rng::with_seed(seed), &mut failures)
            .unwrap_or_else(|why| panic!("seed {seed}: {why}"));
        assert!(bits(frame.pixels()).eq(bits(&plain)), "seed {seed}: the picture differs");
    }
    let Failures {
        hung,
        cut_off,
        off,
        restarted,
        links_cut,
        delayed,
        stopped,
        lost,
        given_out_again,
        unreachable_at_end,
    } = failures;
    let all = [hung, cut_off, off, restarted, links_cut, delayed, stopped, lost, given_out_again, unreachable_at_end];
    assert!(all.iter().all(|&times| times > 0), "{failures:?}");
    // The system lists an ended thread for a moment.
    for _ in 0..3000 {
        if threads().len() <= before {
            return;
        }
        std::thread::sleep(10 * MS);
    }
    panic!("{before} threads before, {:?} after", threads());
}

/// Executes a run whose machines and links fail at random; its first node stays well.
fn run_with_failures(
    tracer: &Arc<Tracer>,
    strategy: Strategy,
    rng: &mut Rng,
    failures: &mut Failures,
) -> Result<Frame, String> {
    let nodes: NodeId = rng.u16(2..=6);
    let speeds = (0..nodes).map(|_| [1.0, 1.0, 0.5, 0.2][rng.usize(0..4)]).collect();
    let spares = rng.u16(0..=nodes / 3);
    let has_joins = strategy == Strategy::FarmLeases;
    let plain = Header::plain(tracer.size(), rng.u32(4..=40), strategy, speeds);
    let header = Header {
        // Leases are short, so that lost atoms are soon given out again.
        rules: Rules { beat: 3 * MS, batch: [None, Some(MS)][rng.usize(0..2)], ..plain.rules },
        pace: [1.0, 0.3, 0.1][rng.usize(0..3)],
        link: LinkSettings { latency: [0, 0, 200, 1000][rng.usize(0..4)] * Duration::from_micros(1), ..plain.link },
        spares,
        ..plain
    };
    let run = Run::start(Arc::clone(tracer), &header);
    for _ in 0..rng.u32(2..12) {
        std::thread::sleep(rng.u32(0..3000) * Duration::from_micros(1));
        run.command(random_command(rng, nodes));
    }
    let (frame, records) = watched::picture(&run, &header);
    let frame = frame?;
    count_failures(&records, nodes, has_joins, failures);
    Ok(frame)
}

/// A change to a machine or a link, the first node's machine excepted.
fn random_command(rng: &mut Rng, nodes: NodeId) -> Command {
    let node = rng.u16(1..nodes);
    let conditions = [Condition::Off, Condition::Hung, Condition::CutOff, Condition::Well, Condition::Well];
    match rng.u32(0..7) {
        0 => {
            // The link between the first node and the parent is never cut.
            let other = [Party::Parent, Party::Node(0), Party::Node(rng.u16(0..nodes))][rng.usize(0..3)];
            Command::Link { one: Party::Node(node), other, cut: rng.u32(0..3) > 0 }
        }
        1 => {
            let (one, other) = (Party::Node(node), [Party::Parent, Party::Node(0)][rng.usize(0..2)]);
            let (from, to) = if rng.bool() { (one, other) } else { (other, one) };
            Command::Delay { from, to, by: rng.u32(0..100) * MS }
        }
        2 => match rng.u32(0..3) {
            0 => Command::Pause { node, paused: rng.bool() },
            _ => Command::Speed { node, speed: [0.0, 0.0, 0.01, 1.0][rng.usize(0..4)] },
        },
        _ => Command::Condition { node, condition: conditions[rng.usize(0..conditions.len())] },
    }
}

/// Counts the failures; in the farm with leases a machine that starts afresh sends a join.
fn count_failures(records: &[Record], nodes: NodeId, has_joins: bool, failures: &mut Failures) {
    let mut last_conditions = vec![Condition::Well; usize::from(nodes)];
    for record in records {
        match &record.kind {
            RecordKind::Condition { node, condition } => {
                last_conditions[usize::from(*node)] = *condition;
                match condition {
                    Condition::Hung => failures.hung += 1,
                    Condition::CutOff => failures.cut_off += 1,
                    Condition::Off => failures.off += 1,
                    Condition::Well => {}
                }
            }
            RecordKind::Link { cut: true, .. } => failures.links_cut += 1,
            RecordKind::Delayed { .. } => failures.delayed += 1,
            RecordKind::Paused { .. } | RecordKind::SpeedSet { speed: 0.0, .. } => failures.stopped += 1,
            RecordKind::Lost { .. } => failures.lost += 1,
            RecordKind::Sent { message: Message::Join, .. } => failures.restarted += 1,
            RecordKind::Sent { message: Message::Request, .. } if !has_joins => failures.restarted += 1,
            RecordKind::Sent { from: Party::Parent, message: Message::Again(_), .. } => failures.given_out_again += 1,
            _ => {}
        }
    }
    failures.unreachable_at_end += u32::from(last_conditions.iter().any(|&condition| condition != Condition::Well));
}

/// The bits of all channels; NaN is not equal to itself, but its bits are.
fn bits(pixels: &[Colour]) -> impl Iterator<Item = u32> {
    pixels.iter().flatten().map(|channel| channel.to_bits())
}
