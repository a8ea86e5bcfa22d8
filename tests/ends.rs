//! Runs and retraces end when they are told to, whatever they were doing, and leave no thread behind. This is a test program of its
//! own, so that all its threads but one are theirs.

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

const MS: Duration = Duration::from_millis(1);
const NODES: NodeId = 32;

#[test]
fn fifty_of_each_in_a_row_leave_nothing_running() {
    let before = threads();
    let retraces: Vec<Retrace> = (0..50).map(retrace_and_stop).collect();
    assert!(comes_true(|| retraces.iter().all(Retrace::has_ended)), "a retrace goes on");
    let runs: Vec<Run> = (0..50).map(begin_and_stop).collect();
    assert!(comes_true(|| runs.iter().all(Run::has_ended)), "a run goes on");
    for run in &runs {
        let last = run.updates().try_iter().last();
        assert!(matches!(last, Some(Update::Failed(RunError::Stopped))));
    }
    // The system may still be clearing away what has ended.
    assert!(comes_true(|| threads() <= before), "{before} threads before, {} after", threads());
}

fn header(number: u32) -> Header {
    let size = Size::new(1000, 100).expect("a size");
    // Every third node stands still from the start.
    let speeds = (0..NODES).map(|node| if node % 3 == 0 { 0.0 } else { 0.5 }).collect();
    let strategy = [Strategy::Ring, Strategy::Adaptive][number as usize / 6 % 2];
    let plain = Header::plain(size, [10, 50_000][number as usize % 2], strategy, speeds);
    let driver = [Driver::Threads, Driver::WorkStealing, Driver::Pairs][number as usize / 2 % 3];
    Header {
        driver,
        link: LinkSettings { latency: [0, 1, 3_600_000][number as usize % 3] * MS, ..plain.link },
        ..plain
    }
}

/// The whole picture would take three minutes.
fn trace(pixels: Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>) {
    std::thread::sleep(pixels.len() as u32 * 2 * MS);
    out.extend(pixels.map(|_| [0.0; 3]));
}

/// Each of the runs is in another state when it is stopped.
fn begin_and_stop(number: u32) -> Run {
    let run = Run::start_with(trace, &header(number));
    std::thread::sleep(number % 5 * MS);
    let put_all = |condition| (0..NODES).for_each(|node| run.command(Command::Condition { node, condition }));
    match number % 7 {
        0 => run.pause(),
        1 => (0..NODES).for_each(|node| run.command(Command::Pause { node, paused: true })),
        2 => (0..NODES).for_each(|node| run.command(Command::Speed { node, speed: 0.0 })),
        3 => put_all(Condition::Hung),
        4 => put_all(Condition::CutOff),
        5 => put_all(Condition::Off),
        _ => {}
    }
    run.stop();
    // Nothing is to be done to a run that has been told to end.
    run.pause();
    run.command(Command::Speed { node: 0, speed: 1.0 });
    run
}

/// The parent has received the whole picture.
fn retrace_and_stop(number: u32) -> Retrace {
    let mut log = RunLog::new(header(number));
    let (id, from, to) = (0, Party::Node(0), Party::Parent);
    let message = Message::Results(once(0..log.header.division.atoms()).collect());
    let at = Time(1);
    log.add(vec![Record { at: Time::ZERO, what: RecordKind::Sent { id, from, to, message, bytes: 0, arrives: at } }]);
    log.add(vec![Record { at, what: RecordKind::Received { id, by: to } }]);
    let retrace = Retrace::start_with(trace, Arc::new(log));
    std::thread::sleep(number % 5 * MS);
    retrace.stop();
    retrace
}

/// Whether something comes true before one gives up; on a busy computer that takes a while.
fn comes_true(condition: impl Fn() -> bool) -> bool {
    (0..3000).any(|_| {
        std::thread::sleep(10 * MS);
        condition()
    })
}

/// The threads of this process, where the system tells.
fn threads() -> usize {
    std::fs::read_dir("/proc/self/task").map_or(0, Iterator::count)
}
