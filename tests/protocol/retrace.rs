//! A retrace traces the picture of a recorded run again: the same pixels, each once, and no others.

use std::iter::once;
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use anel::balance::{Message, Party, Strategy};
use anel::driver::{Retrace, Run, Update};
use anel::picture::{Atom, Colour, Division, Frame, Quality, Size};
use anel::record::{Record, RecordKind};
use anel::runlog::{Driver, Header, LinkSettings, RunLog};
use anel::scenario::Command;
use anel::scene::{Scene, built_in};
use anel::time::Time;
use anel::tracer::{Scratch, Tracer};

const MS: Duration = Duration::from_millis(1);

/// The updates of a run or a retrace, collected.
struct Collected {
    log: RunLog,
    frame: Frame,
    /// By atom: the number of times it was placed.
    placed: Vec<u32>,
    /// `None` before the last update; then success or the error message.
    end: Option<Result<(), String>>,
}

impl Collected {
    fn new(header: &Header) -> Self {
        let placed = vec![0; header.division.atoms() as usize];
        Self { log: RunLog::new(header.clone()), frame: Frame::new(header.size), placed, end: None }
    }

    fn take(&mut self, update: Update) {
        assert!(self.end.is_none(), "an update after the last one: {update:?}");
        match update {
            Update::Records(records) => _ = self.log.add(records),
            Update::Placed { atoms, pixels } => {
                for (place, colours) in self.log.header.division.placed(&atoms, &pixels) {
                    self.frame.place(place, colours);
                }
                atoms.into_iter().flatten().for_each(|atom| self.placed[atom as usize] += 1);
            }
            Update::Rays(_) => {}
            Update::Finished => self.end = Some(Ok(())),
            Update::Failed(why) => self.end = Some(Err(why.to_string())),
        }
    }

    /// Collects the updates of a retrace until its end.
    fn take_all(&mut self, retrace: &Retrace) {
        retrace.updates().iter().for_each(|update| self.take(update));
    }

    fn placed_atoms(&self) -> Vec<Atom> {
        (0..).zip(&self.placed).filter(|(_, placed)| **placed > 0).map(|(atom, _)| atom).collect()
    }
}

/// The atoms that the parent has received, by the log.
fn received(log: &RunLog) -> Vec<Atom> {
    let mut atoms = Vec::new();
    for (index, record) in log.records().iter().enumerate() {
        let RecordKind::Received { id: got, by: Party::Parent } = record.kind else { continue };
        for earlier in &log.records()[..index] {
            if let RecordKind::Sent { id, message: Message::Results(ranges), .. } = &earlier.kind
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
    Header { scene: "csg-primer".into(), link: LinkSettings { latency: MS, ..plain.link }, ..plain }
}

fn tracer(header: &Header) -> Arc<Tracer> {
    let scene = Scene::parse(built_in("csg-primer").unwrap()).unwrap();
    Arc::new(Tracer::new(&scene, header.size, Quality::default()))
}

/// Executes a run of three machines, one of which the user pauses.
fn recorded(tracer: &Arc<Tracer>, header: &Header) -> Collected {
    let run = Run::start(Arc::clone(tracer), header);
    run.command(Command::Pause { node: 1, paused: true });
    run.command(Command::Latency(2 * MS));
    std::thread::sleep(5 * MS);
    run.command(Command::Pause { node: 1, paused: false });
    let mut collected = Collected::new(header);
    run.updates().iter().for_each(|update| collected.take(update));
    assert_eq!(collected.end, Some(Ok(())));
    collected
}

/// A log in which the parent receives atom k, k = 0…9, at `step` × (k + 1), each in a message of its own.
fn one_by_one(step: Duration) -> RunLog {
    let mut log = RunLog::new(header(&[1.0]));
    for atom in 0..10 {
        let at = Time::ZERO + step * atom;
        let (id, message) = (atom.into(), Message::Results(once(atom..atom + 1).collect()));
        let sent =
            RecordKind::Sent { id, from: Party::Node(0), to: Party::Parent, message, bytes: 0, arrives: at + step };
        let received = RecordKind::Received { id, by: Party::Parent };
        log.add(vec![Record { at, kind: sent }, Record { at: at + step, kind: received }]);
    }
    log
}

fn black(pixels: Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>) {
    out.extend(pixels.map(|_| [0.0; 3]));
}

/// The bits of all channels; NaN is not equal to itself, but its bits are.
fn bits(frame: &Frame) -> Vec<[u32; 3]> {
    frame.pixels().iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

#[test]
fn retrace_gives_the_same_pixels() {
    for driver in [Driver::Threads, Driver::WorkStealing, Driver::Pairs] {
        let header = Header { driver, ..header(&[0.4, 0.2, 0.05]) };
        let tracer = tracer(&header);
        let run = recorded(&tracer, &header);
        let retrace = Retrace::start(tracer, Arc::new(run.log.clone()));
        let mut collected = Collected::new(&header);
        collected.take_all(&retrace);
        assert_eq!(collected.end, Some(Ok(())));
        assert!(collected.log.records().is_empty() && collected.placed.iter().all(|&placed| placed == 1));
        assert_eq!(bits(&collected.frame), bits(&run.frame));
    }
}

#[test]
fn retrace_of_an_incomplete_log_traces_the_received_atoms() {
    let header = header(&[1.0, 1.0]);
    let tracer = tracer(&header);
    let whole = recorded(&tracer, &header).log;
    let mut part = RunLog::new(header.clone());
    part.add(whole.records()[..whole.records().len() / 2].to_vec());
    let mut expected = received(&part);
    expected.sort_unstable();
    let retrace = Retrace::start(tracer, Arc::new(part));
    let mut collected = Collected::new(&header);
    collected.take_all(&retrace);
    assert_eq!((collected.end.clone(), collected.placed_atoms()), (Some(Ok(())), expected));
}

#[test]
fn atom_in_two_messages_is_traced_once() {
    let mut log = one_by_one(MS);
    log.add(one_by_one(2 * MS).records().to_vec());
    let retrace = Retrace::start_with(black, Arc::new(log.clone()));
    let mut collected = Collected::new(&log.header);
    collected.take_all(&retrace);
    assert_eq!((collected.end.clone(), collected.placed_atoms()), (Some(Ok(())), (0..10).collect()));
    assert!(collected.placed.iter().all(|&placed| placed <= 1));
}

#[test]
fn retrace_of_an_empty_log_ends_at_once() {
    let log = RunLog::new(header(&[1.0]));
    let mut collected = Collected::new(&log.header);
    collected.take_all(&Retrace::start_with(black, Arc::new(log)));
    assert_eq!(collected.end, Some(Ok(())));
}

#[test]
fn dropped_retrace_ends_within_an_atom() {
    let mut log = one_by_one(MS);
    // The only atom is the whole picture and would take over a minute.
    log.header.division = Division::new(log.header.size.pixels(), u32::MAX);
    let held = Arc::new(());
    let holder = Arc::clone(&held);
    let slow = move |pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>| {
        let _held = &holder;
        std::thread::sleep(pixels.len() as u32 * 20 * MS / 64);
        black(pixels, scratch, out);
    };
    let retrace = Retrace::start_with(slow, Arc::new(log));
    std::thread::sleep(10 * MS);
    drop(retrace);
    assert_eq!(Arc::strong_count(&held), 1, "a thread still runs");
}

#[test]
fn panic_of_the_tracer_fails_the_retrace() {
    let log = one_by_one(MS);
    let panicking = |pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>| {
        assert!(pixels.start < 160, "no way to trace pixel {}", pixels.start);
        black(pixels, scratch, out);
    };
    let mut collected = Collected::new(&log.header);
    collected.take_all(&Retrace::start_with(panicking, Arc::new(log)));
    let why = collected.end.unwrap().unwrap_err();
    assert!(why.starts_with("tracer ") && why.contains(" failed: no way to trace pixel "), "{why}");
}
