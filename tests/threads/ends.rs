//! Runs and retraces end when they are stopped, in any state, and leave no thread behind.

use std::iter::once;
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use anel::balance::{Condition, Message, NodeId, Party, Strategy};
use anel::driver::{Retrace, Run, RunError, Update};
use anel::picture::{Colour, Size};
use anel::record::{Record, RecordKind};
use anel::runlog::{Driver, Header, LinkSettings, RunLog};
use anel::scenario::Command;
use anel::time::Time;
use anel::tracer::Scratch;

use crate::{threads, turn};

const MS: Duration = Duration::from_millis(1);
const NODES: NodeId = 32;

#[test]
fn fifty_stopped_runs_and_retraces_leave_no_thread_behind() {
    let _turn = turn();
    let before = threads().len();
    let retraces: Vec<Retrace> = (0..50).map(retrace_and_stop).collect();
    assert!(comes_true(|| retraces.iter().all(Retrace::has_ended)), "a stopped retrace goes on");
    let runs: Vec<Run> = (0..50).map(begin_and_stop).collect();
    assert!(comes_true(|| runs.iter().all(Run::has_ended)), "a stopped run goes on");
    for run in &runs {
        let last = run.updates().try_iter().last();
        assert!(matches!(last, Some(Update::Failed(RunError::Stopped))));
    }
    // The system lists an ended thread for a moment.
    assert!(comes_true(|| threads().len() <= before), "{before} threads before, {:?} after", threads());
}

fn header(number: u32) -> Header {
    let size = Size::new(1000, 100).expect("a size");
    // Every third node has speed 0 from the start.
    let speeds = (0..NODES).map(|node| if node % 3 == 0 { 0.0 } else { 0.5 }).collect();
    let strategy = [Strategy::Ring, Strategy::Adaptive][number as usize / 6 % 2].clone();
    let plain = Header::plain(size, [10, 50_000][number as usize % 2], strategy, speeds);
    let driver = [Driver::Threads, Driver::WorkStealing, Driver::Pairs][number as usize / 2 % 3];
    Header {
        driver,
        link: LinkSettings { latency: [0, 1, 3_600_000][number as usize % 3] * MS, ..plain.link },
        ..plain
    }
}

/// Takes 2 ms for each pixel: over three minutes for the picture.
fn trace(pixels: Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>) {
    std::thread::sleep(pixels.len() as u32 * 2 * MS);
    out.extend(pixels.map(|_| [0.0; 3]));
}

/// Stops a run in one of seven states.
fn begin_and_stop(number: u32) -> Run {
    let run = Run::start_with(trace, &header(number));
    std::thread::sleep(number % 5 * MS);
    let set_all = |condition| (0..NODES).for_each(|node| run.command(Command::Condition { node, condition }));
    match number % 7 {
        0 => run.pause(),
        1 => (0..NODES).for_each(|node| run.command(Command::Pause { node, paused: true })),
        2 => (0..NODES).for_each(|node| run.command(Command::Speed { node, speed: 0.0 })),
        3 => set_all(Condition::Hung),
        4 => set_all(Condition::CutOff),
        5 => set_all(Condition::Off),
        _ => {}
    }
    run.stop();
    // Commands to a stopped run do nothing.
    run.pause();
    run.command(Command::Speed { node: 0, speed: 1.0 });
    run
}

/// Stops the retrace of a run whose parent has received the whole picture.
fn retrace_and_stop(number: u32) -> Retrace {
    let mut log = RunLog::new(header(number));
    let (id, from, to) = (0, Party::Node(0), Party::Parent);
    let message = Message::Results(once(0..log.header.division.atoms()).collect());
    let at = Time(1);
    log.add(vec![Record { at: Time::ZERO, kind: RecordKind::Sent { id, from, to, message, bytes: 0, arrives: at } }]);
    log.add(vec![Record { at, kind: RecordKind::Received { id, by: to } }]);
    let retrace = Retrace::start_with(trace, Arc::new(log));
    std::thread::sleep(number % 5 * MS);
    retrace.stop();
    retrace
}

/// Whether the condition becomes true within half a minute; a busy computer is slow to end threads.
fn comes_true(condition: impl Fn() -> bool) -> bool {
    (0..3000).any(|_| {
        std::thread::sleep(10 * MS);
        condition()
    })
}
