//! A recorded run is told again: the same records in the same order, the same pixels, each when it is time.

use std::iter::once;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use anel::balance::{Message, Party, Strategy};
use anel::driver::{Replay, Run, Update};
use anel::picture::{Atom, Colour, Division, Frame, Quality, Size};
use anel::record::{Record, What};
use anel::runlog::{Driver, Header, Link, RunLog};
use anel::scene::{Scene, built_in};
use anel::time::Time;
use anel::tracer::{Scratch, Tracer};

const MS: Duration = Duration::from_millis(1);

/// What was told, and what it makes together.
struct Told {
    log: RunLog,
    frame: Frame,
    /// By atom: how often it was placed.
    placed: Vec<u32>,
    /// `None` while it goes on; the sentence of a failure.
    end: Option<Result<(), String>>,
}

impl Told {
    fn new(header: &Header) -> Self {
        let placed = vec![0; header.division.atoms() as usize];
        Self { log: RunLog::new(header.clone()), frame: Frame::new(header.size), placed, end: None }
    }

    fn take(&mut self, update: Update) {
        assert!(self.end.is_none(), "something follows the last update: {update:?}");
        match update {
            Update::Records(records) => self.log.add(records),
            Update::Placed { atoms, pixels } => {
                for (place, colours) in self.log.header.division.placed(&atoms, &pixels) {
                    self.frame.place(place, colours);
                }
                atoms.into_iter().flatten().for_each(|atom| self.placed[atom as usize] += 1);
            }
            Update::Rays(_) => {}
            Update::Finished => self.end = Some(Ok(())),
            Update::Failed(why) => self.end = Some(Err(why)),
        }
    }

    /// Takes in what a replay tells until its end, and checks that nothing is told before its time.
    fn take_all(&mut self, replay: &Replay) {
        for update in replay.updates() {
            match &update {
                Update::Records(records) => {
                    assert!(!records.is_empty() && records.iter().all(|record| record.at <= replay.now()));
                }
                Update::Placed { atoms, .. } => {
                    let received = received(&self.log);
                    assert!(atoms.iter().cloned().flatten().all(|atom| received.contains(&atom)), "{atoms:?}");
                }
                _ => {}
            }
            self.take(update);
        }
    }

    fn placed_atoms(&self) -> Vec<Atom> {
        (0..).zip(&self.placed).filter(|(_, placed)| **placed > 0).map(|(atom, _)| atom).collect()
    }
}

/// The atoms that the parent has received.
fn received(log: &RunLog) -> Vec<Atom> {
    let mut atoms = Vec::new();
    for (index, record) in log.records().iter().enumerate() {
        let What::Received { id: got, by: Party::Parent } = record.what else { continue };
        for earlier in &log.records()[..index] {
            if let What::Sent { id, message: Message::Results(ranges), .. } = &earlier.what
                && *id == got
            {
                atoms.extend(ranges.iter().cloned().flatten());
            }
        }
    }
    atoms
}

fn header(speeds: &[f64]) -> Header {
    let size = Size::new(80, 50).unwrap();
    let plain = Header::plain(size, 40, Strategy::Ring, speeds.to_vec());
    Header { scene: "csg-primer".into(), link: Link { latency: MS, ..plain.link }, ..plain }
}

fn tracer(header: &Header) -> Arc<Tracer> {
    let scene = Scene::parse(built_in("csg-primer").unwrap()).unwrap();
    Arc::new(Tracer::new(&scene, header.size, Quality::default()))
}

/// A run of three machines, of which the user pauses one.
fn recorded(tracer: &Arc<Tracer>, header: &Header) -> Told {
    let run = Run::start(Arc::clone(tracer), header);
    run.set_paused(1, true);
    run.set_latency(2 * MS);
    std::thread::sleep(5 * MS);
    run.set_paused(1, false);
    let mut told = Told::new(header);
    run.updates().iter().for_each(|update| told.take(update));
    assert_eq!(told.end, Some(Ok(())));
    told
}

/// Atom k, k = 0…9, is received at `step` × (k + 1); each with a message of its own.
fn one_by_one(step: Duration) -> RunLog {
    let mut log = RunLog::new(header(&[1.0]));
    for atom in 0..10 {
        let at = Time::ZERO + step * atom;
        let (id, message) = (atom.into(), Message::Results(once(atom..atom + 1).collect()));
        let sent = What::Sent { id, from: Party::Node(0), to: Party::Parent, message, bytes: 0, arrives: at + step };
        let received = What::Received { id, by: Party::Parent };
        log.add(vec![Record { at, what: sent }, Record { at: at + step, what: received }]);
    }
    log
}

fn black(pixels: Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>) {
    out.extend(pixels.map(|_| [0.0; 3]));
}

/// Compared as bits, since NaN is not equal to itself.
fn bits(frame: &Frame) -> Vec<[u32; 3]> {
    frame.pixels().iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

#[test]
fn the_same_records_and_the_same_pixels() {
    for driver in [Driver::Threads, Driver::WorkStealing, Driver::Pairs] {
        let header = Header { driver, ..header(&[0.4, 0.2, 0.05]) };
        let tracer = tracer(&header);
        let run = recorded(&tracer, &header);
        let replay = Replay::start(tracer, Arc::new(run.log.clone()));
        let mut told = Told::new(&header);
        told.take_all(&replay);
        assert_eq!(told.end, Some(Ok(())));
        assert_eq!(told.log, run.log);
        assert!(told.placed.iter().all(|&placed| placed == 1));
        assert_eq!(bits(&told.frame), bits(&run.frame));
    }
}

#[test]
fn an_incomplete_log_is_told_as_far_as_it_goes() {
    let header = header(&[1.0, 1.0]);
    let tracer = tracer(&header);
    let whole = recorded(&tracer, &header).log;
    let mut part = RunLog::new(header.clone());
    part.add(whole.records()[..whole.records().len() / 2].to_vec());
    let mut expected = received(&part);
    expected.sort_unstable();
    let replay = Replay::start(tracer, Arc::new(part.clone()));
    let mut told = Told::new(&header);
    told.take_all(&replay);
    assert_eq!((told.end.clone(), &told.log), (Some(Ok(())), &part));
    assert_eq!(told.placed_atoms(), expected);
}

#[test]
fn atoms_of_two_messages_are_placed_once() {
    let mut log = one_by_one(MS);
    log.add(one_by_one(2 * MS).records().to_vec());
    let replay = Replay::start_with(black, Arc::new(log.clone()));
    let mut told = Told::new(&log.header);
    told.take_all(&replay);
    assert_eq!((told.end.clone(), told.log.records()), (Some(Ok(())), log.records()));
    assert_eq!(told.placed_atoms(), (0..10).collect::<Vec<_>>());
    assert!(told.placed.iter().all(|&placed| placed <= 1));
}

#[test]
fn an_empty_log_is_over_at_once() {
    let log = RunLog::new(header(&[1.0]));
    let mut told = Told::new(&log.header);
    told.take_all(&Replay::start_with(black, Arc::new(log)));
    assert_eq!(told.end, Some(Ok(())));
}

#[test]
fn a_paused_replay_stands_still_and_goes_on() {
    let log = one_by_one(20 * MS);
    let replay = Replay::start_with(black, Arc::new(log.clone()));
    std::thread::sleep(30 * MS);
    replay.pause();
    let paused = replay.now();
    let mut told = Told::new(&log.header);
    // Until then everything is told, but nothing later.
    let due = log.records().partition_point(|record| record.at <= paused);
    while told.log.records().len() < due {
        told.take(replay.updates().recv().unwrap());
    }
    std::thread::sleep(60 * MS);
    replay.updates().try_iter().for_each(|update| told.take(update));
    assert_eq!((replay.now(), told.log.records()), (paused, &log.records()[..due]));
    replay.resume();
    told.take_all(&replay);
    assert_eq!((told.end.clone(), told.log.records()), (Some(Ok(())), log.records()));
    assert_eq!(told.placed_atoms(), (0..10).collect::<Vec<_>>());
}

#[test]
fn pixels_that_are_late_come_during_a_pause_too() {
    let (log, may_trace) = (one_by_one(MS), Arc::new(AtomicBool::new(false)));
    let gate = Arc::clone(&may_trace);
    let gated = move |pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>| {
        while !gate.load(Ordering::SeqCst) {
            std::thread::sleep(MS);
        }
        black(pixels, scratch, out);
    };
    let replay = Replay::start_with(gated, Arc::new(log.clone()));
    let mut told = Told::new(&log.header);
    while told.log != log {
        told.take(replay.updates().recv().unwrap());
    }
    replay.pause();
    may_trace.store(true, Ordering::SeqCst);
    told.take_all(&replay);
    assert_eq!((told.end.clone(), told.placed_atoms()), (Some(Ok(())), (0..10).collect()));
}

#[test]
fn a_replay_that_waits_for_years_can_be_stopped() {
    for paused in [false, true] {
        let mut log = one_by_one(Duration::from_secs(3600));
        log.add(vec![Record { at: Time(u64::MAX), what: What::Finished }]);
        let replay = Replay::start_with(black, Arc::new(log.clone()));
        assert!(!replay.has_ended());
        if paused {
            replay.pause();
        }
        std::thread::sleep(20 * MS);
        replay.stop();
        let mut told = Told::new(&log.header);
        told.take_all(&replay);
        assert_eq!(told.end, Some(Err("the replay was stopped".into())));
        assert!(told.log.records().len() <= 1 && told.placed_atoms().is_empty());
    }
}

#[test]
fn dropping_a_replay_ends_it_in_the_middle_of_an_atom() {
    let mut log = one_by_one(MS);
    // One atom, the whole picture, would take a minute or more.
    log.header.division = Division::new(log.header.size.pixels(), u32::MAX);
    let held = Arc::new(());
    let holder = Arc::clone(&held);
    let slow = move |pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>| {
        let _held = &holder;
        std::thread::sleep(pixels.len() as u32 * 20 * MS / 64);
        black(pixels, scratch, out);
    };
    let replay = Replay::start_with(slow, Arc::new(log));
    std::thread::sleep(10 * MS);
    drop(replay);
    assert_eq!(Arc::strong_count(&held), 1, "a thread goes on");
}

#[test]
fn a_panicking_tracer_fails_the_replay() {
    let log = one_by_one(MS);
    let panicking = |pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>| {
        assert!(pixels.start < 160, "no way to trace pixel {}", pixels.start);
        black(pixels, scratch, out);
    };
    let mut told = Told::new(&log.header);
    told.take_all(&Replay::start_with(panicking, Arc::new(log)));
    let why = told.end.unwrap().unwrap_err();
    assert!(why.starts_with("tracer ") && why.contains(" failed: no way to trace pixel "), "{why}");
}
