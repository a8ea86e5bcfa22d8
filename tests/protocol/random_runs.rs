//! A thousand random runs, most of them in virtual time and some on threads: each ends, and every atom is placed,
//! exactly once except in the adaptive ring. And the user's commands to a run: pauses, speeds, latencies, stops.

use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use anel::balance::{NodeId, Party, Rules, Strategy};
use anel::driver::{Run, Update};
use anel::picture::{Atom, Colour, Division, Size};
use anel::record::RecordKind;
use anel::runlog::{Driver, Header, LinkSettings, Metrics, OwnLink, RunLog};
use anel::scenario::Command;
use anel::time::Time;
use anel::tracer::Scratch;

use crate::virtual_time;

const MS: Duration = Duration::from_millis(1);

/// The drivers that trace in real time, and the prefix of the names of their tracing threads.
const REAL: [(Driver, &str); 3] =
    [(Driver::Threads, "node "), (Driver::Pairs, "worker "), (Driver::WorkStealing, "node ")];

/// Random numbers from a seed: SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, end: u64) -> u64 {
        self.next() % end
    }

    fn one_of<T: Clone>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len() as u64) as usize].clone()
    }

    fn speed(&mut self) -> f64 {
        self.one_of(&[1.0, 1.0, 0.5, 0.2, 0.05])
    }
}

/// Calls `test` with each seed; prints the seed of a failure.
fn with_seeds(seeds: Range<u64>, test: impl Fn(&mut Random)) {
    struct Named(u64);
    impl Drop for Named {
        fn drop(&mut self) {
            if std::thread::panicking() {
                eprintln!("failed with seed {}", self.0);
            }
        }
    }
    for seed in seeds {
        let _named = Named(seed);
        test(&mut Random(seed));
    }
}

#[test]
fn nine_hundred_random_runs_in_virtual_time() {
    with_seeds(0..900, |random| {
        let nodes = random.one_of(&[1, 2, 3, 4, 7, 8, 16, 32]);
        let mut script = Vec::new();
        for _ in 0..random.below(8) {
            let (at, node) = (random.below(3000) as f64 * 1e-3, random.below(nodes) as NodeId);
            // Every stopped node resumes later.
            script.push((Time::from_secs(at), Command::Speed { node, speed: random.one_of(&[0.0, 0.1, 1.0]) }));
            script.push((Time::from_secs(3.0 + at), Command::Speed { node, speed: random.speed() }));
            script.push((Time::from_secs(at), Command::Pause { node, paused: random.below(2) == 0 }));
            script.push((Time::from_secs(4.0 + at), Command::Pause { node, paused: false }));
            script.push((Time::from_secs(at), Command::Latency(random.one_of(&[0, 2, 300]) * MS)));
            let latency = random.one_of(&[None, Some(3 * MS)]);
            script.push((Time::from_secs(at), Command::OwnLatency { party: Party::Node(node), latency }));
        }
        let costs: [fn(Atom) -> f64; 3] =
            [|_| 1e-3, |atom| if atom < 20 { 0.05 } else { 1e-5 }, |atom| f64::from(atom % 7) * 1e-3];
        // Often fewer atoms than nodes.
        let size = Size::new(1 + random.below(50) as u32, 1 + random.below(10) as u32).unwrap();
        let speeds: Vec<f64> = (0..nodes).map(|_| random.speed()).collect();
        let plain = Header::plain(size, 1 + random.below(50) as u32, random.one_of(&Strategy::ALL), speeds);
        let handling = random.one_of(&[0, 0, 1, 20]) * MS;
        let header = Header {
            rules: Rules {
                part: random.one_of(&[0, 1, 1, 5, plain.rules.part]),
                batch: random.one_of(&[None, Some(Duration::ZERO), Some(Rules::BATCH)]),
                beat: Rules::beat_for(handling, nodes as usize),
                ..plain.rules
            },
            pace: random.one_of(&[1.0, 0.3]),
            link: LinkSettings {
                latency: random.one_of(&[0, 1, 40, 1000]) * MS,
                bandwidth: random.one_of(&[None, Some(1e4), Some(1e6)]),
                shared: random.below(2) == 0,
                nodes: own_links(random, nodes),
                parent: OwnLink { latency: random.one_of(&[None, None, Some(5 * MS)]), bandwidth: None },
            },
            handling,
            ..plain
        };
        let cost = random.one_of(&costs);
        let log = virtual_time::run(&header, &script, cost);
        assert_stopped_machines_trace_nothing(&log);
        assert_eq!(virtual_time::run(&header, &script, cost), log, "the same run has other records");
    });
}

#[test]
fn one_hundred_random_runs_on_threads() {
    with_seeds(0..100, |random| {
        let size = Size::new(1 + random.below(40) as u32, 1 + random.below(20) as u32).unwrap();
        let driver =
            random.one_of(&[Driver::Threads, Driver::Threads, Driver::Sim, Driver::WorkStealing, Driver::Pairs]);
        // Pairs run at full speed only.
        let throttled = driver != Driver::Pairs;
        let speed = |random: &mut Random| if throttled { random.speed() } else { 1.0 };
        let speeds = (0..random.one_of(&[1, 2, 3, 5, 8, 20])).map(|_| speed(random)).collect();
        let plain = Header::plain(size, random.one_of(&[1, 10, 50, 1000]), random.one_of(&Strategy::ALL), speeds);
        let header = Header {
            driver,
            rules: Rules { part: random.one_of(&[1, 3, plain.rules.part]), ..plain.rules },
            pace: if throttled { random.one_of(&[1.0, 0.5]) } else { 1.0 },
            link: LinkSettings {
                latency: random.one_of(&[0, 0, 1, 5]) * MS,
                bandwidth: random.one_of(&[None, None, Some(1e7)]),
                shared: random.below(2) == 0,
                nodes: own_links(random, 1),
                parent: OwnLink::default(),
            },
            handling: random.one_of(&[0, 0, 100]) * Duration::from_micros(1),
            ..plain
        };
        // One corner of the picture costs most.
        let run =
            Run::start_with(|pixels, _, out| trace(pixels, out, |pixel| if pixel < 50 { 2000 } else { 10 }), &header);
        let nodes = header.speeds.len() as u64;
        let mut set = vec![header.link.latency];
        for _ in 0..random.below(6) {
            std::thread::sleep(random.below(3) as u32 * MS);
            run.command(Command::Speed { node: random.below(nodes) as NodeId, speed: speed(random) });
            run.command(Command::Pause { node: random.below(nodes) as NodeId, paused: random.below(2) == 0 });
            set.push(random.below(5) as u32 * MS);
            run.command(Command::Latency(set[set.len() - 1]));
        }
        set.dedup();
        (0..nodes as NodeId).for_each(|node| run.command(Command::Pause { node, paused: false }));
        let log = finish(&run, &header);
        assert_stopped_machines_trace_nothing(&log);
        // A latency set after the end is not in the records.
        assert!(set[1..].starts_with(&latencies(&log)), "{set:?}");
    });
}

/// What some of `nodes` nodes have of their own.
fn own_links(random: &mut Random, nodes: u64) -> Vec<OwnLink> {
    let mut own = |_| OwnLink {
        latency: random.one_of(&[None, None, Some(2 * MS)]),
        bandwidth: random.one_of(&[None, None, Some(1e6)]),
    };
    (0..nodes).map(&mut own).collect()
}

#[test]
fn paused_run_stops_its_clock_and_resumes() {
    for (driver, _) in REAL {
        let header = Header { driver, ..header(Size::new(100, 50).unwrap(), 10, vec![0.5, 1.0, 0.1]) };
        let run = Run::start_with(|pixels, _, out| trace(pixels, out, |_| 300), &header);
        std::thread::sleep(3 * MS);
        run.pause();
        let paused = run.now();
        std::thread::sleep(60 * MS);
        assert_eq!(run.now(), paused);
        run.resume();
        let log = finish(&run, &header);
        // No record is dated beyond the clock, neither before the pause nor after it.
        assert!(log.records().iter().all(|record| record.at <= run.now() + 2 * MS));
    }
}

#[test]
fn machine_of_speed_0_answers_messages_but_traces_nothing() {
    stop_the_second(1.0, |run, stopped| {
        run.command(Command::Speed { node: 1, speed: if stopped { 0.0 } else { 1.0 } })
    });
}

#[test]
fn paused_machine_answers_messages_but_traces_nothing_at_any_speed() {
    for pace in [1.0, 0.5] {
        stop_the_second(pace, |run, paused| {
            run.command(Command::Pause { node: 1, paused });
            run.command(Command::Speed { node: 1, speed: 0.75 });
        });
    }
}

/// Stops the second of three machines until the other two have no work left.
fn stop_the_second(pace: f64, stop: fn(&Run, bool)) {
    let header = Header { pace, ..header(Size::new(60, 50).unwrap(), 10, vec![1.0, 1.0, 1.0]) };
    let run = Run::start_with(|pixels, _, out| trace(pixels, out, |_| 500), &header);
    stop(&run, true);
    let mut log = RunLog::new(header.clone());
    let mut placed = Vec::new();
    let retired =
        |log: &RunLog| log.records().iter().filter(|record| matches!(record.kind, RecordKind::Retired { .. })).count();
    // The offers of the others pass through the stopped machine and return.
    while retired(&log) < 2 {
        take(run.updates().recv().unwrap(), &mut log, &mut placed);
    }
    stop(&run, false);
    while !take(run.updates().recv().unwrap(), &mut log, &mut placed) {}
    assert_each_once(placed.into_iter(), header.division);
    assert_stopped_machines_trace_nothing(&log);
}

#[test]
fn only_changes_of_pause_and_latency_are_recorded() {
    // The second node cannot finish while its speed is 0.
    let header = header(Size::new(100, 50).unwrap(), 10, vec![0.5, 0.0]);
    let run = Run::start_with(|pixels, _, out| trace(pixels, out, |_| 300), &header);
    for (node, paused) in [(1, false), (1, true), (1, true), (2, true), (1, false), (1, false), (0, false)] {
        run.command(Command::Pause { node, paused });
    }
    [0, 3, 3, 0, 1].into_iter().for_each(|ms| run.command(Command::Latency(ms * MS)));
    run.command(Command::Speed { node: 1, speed: 0.5 });
    let log = finish(&run, &header);
    let pauses: Vec<_> = log
        .records()
        .iter()
        .map(|record| &record.kind)
        .filter(|kind| matches!(kind, RecordKind::Paused { .. } | RecordKind::Resumed { .. }))
        .collect();
    assert_eq!(pauses, [&RecordKind::Paused { node: 1 }, &RecordKind::Resumed { node: 1 }]);
    assert_eq!(latencies(&log), [3 * MS, Duration::ZERO, MS]);
}

#[test]
fn dropped_run_ends_its_threads_within_an_atom() {
    // One atom, the whole picture, would take a quarter of an hour.
    let plain = header(Size::new(10_000, 1000).unwrap(), u32::MAX, vec![1.0, 1.0]);
    for (driver, paused) in REAL.iter().flat_map(|(driver, _)| [(*driver, false), (*driver, true)]) {
        let header = Header { driver, ..plain.clone() };
        let traced = Arc::new(AtomicU32::new(0));
        let count = traced.clone();
        let run = Run::start_with(
            move |pixels: Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>| {
                count.fetch_add(pixels.len() as u32, Ordering::Relaxed);
                std::thread::sleep(pixels.len() as u32 * Duration::from_micros(100));
                out.extend(pixels.map(|_| [0.0; 3]));
            },
            &header,
        );
        while traced.load(Ordering::Relaxed) == 0 {
            std::thread::yield_now();
        }
        if paused {
            run.pause();
        }
        drop(run);
        // Each thread held the tracing function with the counter: all threads have ended.
        assert_eq!(Arc::strong_count(&traced), 1);
    }
}

#[test]
fn panic_of_a_worker_fails_the_run() {
    for (driver, name) in REAL {
        let header = Header { driver, ..header(Size::new(100, 10).unwrap(), 10, vec![1.0, 0.3, 1.0]) };
        let run = Run::start_with(
            |pixels, _, out| {
                assert!(pixels.start < 500, "no way to trace pixel {}", pixels.start);
                trace(pixels, out, |_| 10);
            },
            &header,
        );
        let last = run.updates().iter().find_map(|update| match update {
            Update::Failed(why) => Some(why.to_string()),
            Update::Finished => panic!("the run finished without half of its pixels"),
            _ => None,
        });
        let why = last.unwrap();
        assert!(why.starts_with(name) && why.contains(" failed: no way to trace pixel "), "{why}");
    }
}

/// Adds colours that cost about `steps(pixel)` times 10 ns each.
fn trace(pixels: Range<u32>, out: &mut Vec<Colour>, steps: fn(u32) -> u32) {
    for pixel in pixels {
        let x = (0..steps(pixel)).fold(pixel as f32, |x, _| (x + 1.3).sin());
        out.push([x, pixel as f32, 0.0]);
    }
}

/// Waits for the end of the run. Every atom is placed with its own pixels, exactly once except in the adaptive ring,
/// and the log counts the same.
fn finish(run: &Run, header: &Header) -> RunLog {
    let mut log = RunLog::new(header.clone());
    let mut placed = Vec::new();
    while !take(run.updates().recv().unwrap(), &mut log, &mut placed) {}
    let metrics = Metrics::of(&log);
    let (traced, atoms) = (metrics.atoms_by_node().iter().sum::<u32>(), header.division.atoms());
    if header.scheduler().name() == Strategy::Adaptive.name() {
        // Other nodes may trace a late atom too.
        assert!(placed.into_iter().flatten().collect::<BTreeSet<_>>().into_iter().eq(0..atoms) && traced >= atoms);
    } else {
        assert_each_once(placed.into_iter(), header.division);
        assert_eq!(traced, atoms);
    }
    assert!(metrics.makespan().is_some());
    log
}

/// Adds an update to the log and the placed atoms. Returns whether it was the last.
fn take(update: Update, log: &mut RunLog, placed: &mut Vec<Range<Atom>>) -> bool {
    match update {
        Update::Records(records) => {
            assert!(records.is_sorted_by_key(|record| record.at), "the time of a party went back");
            log.add(records);
        }
        Update::Placed { atoms, pixels } => {
            let division = log.header.division;
            let expected = atoms.iter().cloned().flatten().flat_map(|atom| division.pixels(atom));
            assert!(expected.eq(pixels.iter().map(|pixel| pixel[1] as u32)), "pixels of other atoms");
            placed.extend(atoms);
        }
        Update::Rays(_) => {}
        Update::Finished => return true,
        Update::Failed(why) => panic!("{why}"),
    }
    false
}

/// Checks that no worker traces while its machine is paused or has speed 0, and that only changes of a pause are
/// recorded. A worker may finish an atom at the very moment of the change.
fn assert_stopped_machines_trace_nothing(log: &RunLog) {
    let mut speeds = log.header.speeds.clone();
    let mut paused = vec![false; speeds.len()];
    let mut changed = vec![Time::ZERO; speeds.len()];
    for record in log.records() {
        if let RecordKind::SpeedSet { node, .. } | RecordKind::Paused { node } = record.kind {
            changed[usize::from(node)] = record.at;
        }
        match record.kind {
            RecordKind::AtomDone { node, .. } if changed[usize::from(node)] == record.at => {}
            RecordKind::SpeedSet { node, speed } => speeds[usize::from(node)] = speed,
            RecordKind::Paused { node } => assert!(!std::mem::replace(&mut paused[usize::from(node)], true)),
            RecordKind::Resumed { node } => assert!(std::mem::replace(&mut paused[usize::from(node)], false)),
            RecordKind::AtomStarted { node, atom } | RecordKind::AtomDone { node, atom, .. } => {
                let node = usize::from(node);
                assert!(speeds[node] > 0.0 && !paused[node], "atom {atom} was traced by node {node}, which is stopped");
            }
            _ => {}
        }
    }
}

/// The latencies set during the run.
fn latencies(log: &RunLog) -> Vec<Duration> {
    let latency = |kind: &RecordKind| if let RecordKind::LatencySet { latency } = kind { Some(*latency) } else { None };
    log.records().iter().filter_map(|record| latency(&record.kind)).collect()
}

fn assert_each_once(ranges: impl Iterator<Item = Range<Atom>>, division: Division) {
    let mut atoms: Vec<Atom> = ranges.flatten().collect();
    atoms.sort_unstable();
    assert!(atoms.into_iter().eq(0..division.atoms()));
}

/// The ring on machines of these speeds at full pace, on links without latency.
fn header(size: Size, atom_pixels: u32, speeds: Vec<f64>) -> Header {
    Header::plain(size, atom_pixels, Strategy::Ring, speeds)
}
