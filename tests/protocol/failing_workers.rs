//! A worker panics while it traces an atom: the adaptive ring and the farm with leases try the atom on other nodes,
//! until too many have failed.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use anel::balance::Strategy;
use anel::driver::Run;
use anel::picture::{Colour, Frame, Size};
use anel::record::{Record, RecordKind};
use anel::runlog::{Driver, Header};
use anel::tracer::Scratch;

use crate::watched;

/// Strategies that try the atom again, and drivers whose workers trace pixels during the run.
const WAYS: [(Strategy, Driver); 3] = [
    (Strategy::Adaptive, Driver::Threads),
    (Strategy::Adaptive, Driver::Pairs),
    (Strategy::FarmLeases, Driver::Threads),
];

/// Pixels of an atom; wide, so that a later piece of it fails.
const ATOM_PIXELS: u32 = 90;

/// In the middle of the sixth atom, which begins at column 50 of row 4.
const BAD_PIXEL: u32 = 5 * ATOM_PIXELS + 80;

/// Executes a run whose bad pixel fails the first `times`. Returns its picture or the reason of its failure, and its
/// records.
fn run(strategy: Strategy, driver: Driver, times: u32) -> (Result<Frame, String>, Vec<Record>) {
    let size = Size::new(100, 20).expect("a size");
    let header = Header { driver, ..Header::plain(size, ATOM_PIXELS, strategy, vec![1.0; 3]) };
    let failed = AtomicU32::new(0);
    let trace = move |pixels: Range<u32>, _: &mut Scratch, out: &mut Vec<Colour>| {
        for pixel in pixels {
            let fails = pixel == BAD_PIXEL && failed.fetch_add(1, Ordering::SeqCst) < times;
            assert!(!fails, "this pixel is bad");
            out.push(colour(pixel));
        }
    };
    let run = Run::start_with(trace, &header);
    watched::picture(&run, &header)
}

fn colour(pixel: u32) -> Colour {
    [pixel as f32, 1.0, 0.0]
}

fn count(records: &[Record], kind: fn(&RecordKind) -> bool) -> usize {
    records.iter().filter(|record| kind(&record.kind)).count()
}

fn has_failed(kind: &RecordKind) -> bool {
    matches!(kind, RecordKind::AtomFailed { atom: 5, .. })
}

#[test]
fn one_or_two_failures_leave_the_picture_complete() {
    for (strategy, driver) in WAYS {
        for times in [1, 2] {
            let (frame, records) = run(strategy.clone(), driver, times);
            let frame = frame.expect("a picture");
            assert!((0..2000).map(colour).eq(frame.pixels().iter().copied()), "after {times} failures");
            assert_eq!(count(&records, has_failed), times as usize);
        }
    }
}

#[test]
fn three_failures_end_the_run_and_name_the_atom() {
    for (strategy, driver) in WAYS {
        let (frame, records) = run(strategy, driver, u32::MAX);
        let why = frame.expect_err("the run fails");
        assert_eq!(why, "no worker could trace atom 5, whose first pixel is at 50,4");
        assert!(count(&records, has_failed) >= 3);
        assert_eq!(count(&records, |kind| matches!(kind, RecordKind::GivenUp { atom: 5 })), 1);
        assert_eq!(count(&records, |kind| matches!(kind, RecordKind::Finished)), 0);
    }
}
