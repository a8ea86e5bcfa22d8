//! Overhead of distributing work at full speed, with a node per core: the ring, the ring with two threads a node (§10),
//! and rayon's work stealing.

use std::time::{Duration, Instant};

use serde::Serialize;

use super::fixture::{Fixture, estimate_cost};
use super::format::or_dash;
use super::markdown::Report;
use super::progress::Progress;
use super::{ProgressSink, Study, StudyError, median};
use crate::balance::Strategy;
use crate::driver::run_to_end;
use crate::parallel::cores;
use crate::picture::Size;
use crate::runlog::{Driver, Header, Metrics};
use crate::scene::Opened;

/// Runs of each rival.
const TURNS: usize = 9;

/// The rivals; the others are compared with the first.
const RIVALS: [Driver; 3] = [Driver::Threads, Driver::Pairs, Driver::WorkStealing];

/// Result of one rival for a scene's picture: medians of its runs.
#[derive(Clone, Debug, Serialize)]
pub(super) struct RivalRow {
    pub scene: String,
    pub driver: &'static str,
    pub nodes: usize,
    /// Time from the start of its threads to their end.
    pub wall_s: f64,
    pub makespan_s: f64,
    /// Wall time over that of the ring in the same turn.
    pub wall_over_ring: f64,
    pub makespan_over_ring: f64,
    /// Context switches of all its threads; `None` where the system does not count them.
    pub context_switches: Option<u64>,
}

/// Runs the rivals on each of the scenes.
///
/// # Errors
/// A [`StudyError`], if a run fails.
pub fn rivals(scenes: &[Opened], tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let mut progress = Progress::new(scenes.len() * STEPS, tell);
    let size = Size::new(640, 480).map_err(StudyError::size)?;
    let mut rows = Vec::new();
    for scene in scenes {
        // Long enough that starting threads has no visible cost.
        let least = Duration::from_millis(500) * cores() as u32;
        let samples = (1..8).find(|&samples| estimate_cost(scene, size, samples) >= least).unwrap_or(8);
        rows.extend(run_rivals(&Fixture::new(scene, size, samples)?, &mut progress)?);
    }
    let mut study = Study::new("rivals");
    study.add_rows(&rows)?;
    study.add_report(report(&rows));
    Ok(study)
}

/// Number of steps that [`run_rivals`] takes.
pub(super) const STEPS: usize = TURNS * RIVALS.len();

/// Runs the rivals in turn on the fixture's picture, so that a disturbance of the computer affects all alike.
///
/// # Errors
/// [`StudyError::Run`], if a run fails.
pub(super) fn run_rivals(fixture: &Fixture, progress: &mut Progress<'_>) -> Result<[RivalRow; 3], StudyError> {
    let header = fixture.header(50, Strategy::Ring, vec![1.0; cores()]);
    let mut turns = Vec::new();
    for _ in 0..TURNS {
        let mut turn = [RivalRun::default(); RIVALS.len()];
        for (driver, run) in RIVALS.into_iter().zip(&mut turn) {
            progress.next(&format!("{} at full speed: {}", fixture.scene.name, driver.name()));
            *run = RivalRun::measure(fixture, &Header { driver, ..header.clone() })?;
        }
        turns.push(turn);
    }
    let row = |rival: usize| {
        let of_turns = |of: &dyn Fn(&[RivalRun; 3]) -> f64| median(&mut turns.iter().map(of).collect::<Vec<f64>>());
        let switches = turns.iter().all(|turn| turn[rival].switches.is_some());
        RivalRow {
            scene: fixture.scene.name.clone(),
            driver: RIVALS[rival].name(),
            nodes: header.speeds.len(),
            wall_s: of_turns(&|turn| turn[rival].wall),
            makespan_s: of_turns(&|turn| turn[rival].makespan),
            wall_over_ring: of_turns(&|turn| turn[rival].wall / turn[0].wall),
            makespan_over_ring: of_turns(&|turn| turn[rival].makespan / turn[0].makespan),
            context_switches: switches.then(|| of_turns(&|turn| turn[rival].switches.unwrap_or(0) as f64) as u64),
        }
    };
    Ok([row(0), row(1), row(2)])
}

/// Measured times of one run.
#[derive(Clone, Copy, Default)]
struct RivalRun {
    wall: f64,
    makespan: f64,
    switches: Option<u64>,
}

impl RivalRun {
    #[expect(clippy::disallowed_methods, reason = "the wall time of the whole run, as the user experiences it")]
    fn measure(fixture: &Fixture, header: &Header) -> Result<Self, StudyError> {
        let (begun, before) = (Instant::now(), context_switches());
        let log = run_to_end(&fixture.tracer, header, &[]).map_err(StudyError::run)?;
        let wall = begun.elapsed().as_secs_f64();
        let switches = context_switches().zip(before).map(|(after, before)| after - before);
        let makespan = Metrics::of(&log).makespan().unwrap_or_default().as_secs_f64();
        Ok(Self { wall, makespan, switches })
    }
}

/// Returns the number of context switches of the program's threads so far; `None` where the system does not count them.
#[cfg(unix)]
fn context_switches() -> Option<u64> {
    use nix::sys::resource::{UsageWho, getrusage};
    let usage = getrusage(UsageWho::RUSAGE_SELF).ok()?;
    u64::try_from(usage.voluntary_context_switches() + usage.involuntary_context_switches()).ok()
}

#[cfg(not(unix))]
fn context_switches() -> Option<u64> {
    None
}

#[cfg(test)]
impl RivalRow {
    /// Returns an example row.
    pub fn example() -> Self {
        Self {
            scene: "an example".into(),
            driver: Driver::Threads.name(),
            nodes: 2,
            wall_s: 1.0,
            makespan_s: 0.9,
            wall_over_ring: 1.0,
            makespan_over_ring: 1.0,
            context_switches: Some(100),
        }
    }
}

fn report(rows: &[RivalRow]) -> Report {
    let mut report = Report::titled("Overhead at full speed");
    report.line(format!(
        "Each scene's picture of 640 × 480 pixels in atoms of 50 pixels, on {} nodes at full speed, one per core, \
         without a network: the ring, the ring with two threads a node (one answers, one traces, as in the article), \
         and rayon's work stealing. Medians of {TURNS} turns in one warm process; ratios are within a turn. The \
         makespan is from the first band to the last pixel, the wall time from the start of the threads to their \
         end.\n",
        cores()
    ));
    report.line(
        "| scene | ring, s | ring / rayon | makespans: ring / rayon | two threads / one | context switches: ring | \
         two threads | rayon |\n",
    );
    report.line("|---|---:|---:|---:|---:|---:|---:|---:|");
    for scene in rows.chunks_exact(RIVALS.len()) {
        let [ring, pairs, rayon] = scene else { continue };
        report.line(format!(
            "| {} | {:.3} | {:.3} | {:.3} | {:.3} | {} | {} | {} |",
            ring.scene,
            ring.wall_s,
            1.0 / rayon.wall_over_ring,
            1.0 / rayon.makespan_over_ring,
            pairs.wall_over_ring,
            or_dash(ring.context_switches),
            or_dash(pairs.context_switches),
            or_dash(rayon.context_switches)
        ));
    }
    report
}
