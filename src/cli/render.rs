//! `anel render`: a run without a window.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use indicatif::ProgressBar;

use super::args::RenderArgs;
use super::report::Report;
use super::run_header;
use super::{Failure, check_outputs, open, print, progress};
use crate::driver::{Run, RunError, TracedPicture, Update, probe};
use crate::picture::{Frame, write_png};
use crate::runlog::{Driver, Header, Metrics, RunLog};
use crate::sim::Sim;
use crate::tracer::{RayCounts, Tracer};

/// The destinations of a run's results.
pub(super) struct Outputs<'a> {
    pub out: &'a Path,
    pub log: Option<&'a Path>,
    pub json: bool,
}

/// The results of a run.
struct RenderResult {
    frame: Frame,
    log: RunLog,
    rays: RayCounts,
    wall: Duration,
}

pub(super) fn render(args: &RenderArgs) -> Result<(), Failure> {
    let opened = open(&args.scene)?;
    let header = run_header::header(args, &opened).map_err(Failure::Refused)?;
    let outputs: Vec<&Path> =
        [Some(&args.out), args.log.as_ref()].into_iter().flatten().map(PathBuf::as_path).collect();
    check_outputs(&args.scene, &outputs)?;
    let measured = args.costs.as_deref().map(|path| measured(path, &header)).transpose()?;
    let tracer = Arc::new(Tracer::new(&opened.scene, header.size, header.quality));
    run_and_save(&tracer, &header, measured, &Outputs { out: &args.out, log: args.log.as_deref(), json: args.json })
}

/// Does the run that `header` describes, saves its results, and prints its report. In virtual time it uses `measured`,
/// if that is given.
pub(super) fn run_and_save(
    tracer: &Arc<Tracer>,
    header: &Header,
    measured: Option<Sim>,
    to: &Outputs<'_>,
) -> Result<(), Failure> {
    let outcome = if header.driver == Driver::Sim { simulate(tracer, header, measured)? } else { run(tracer, header)? };
    write_png(to.out, header.size, &outcome.frame.to_srgb8()).map_err(|error| Failure::Failed(error.to_string()))?;
    if let Some(log) = to.log {
        outcome.log.save(log).map_err(|error| Failure::Failed(error.to_string()))?;
    }
    // In virtual time threads do not compete for cores and caches.
    let overhead = if header.driver == Driver::Sim { Some(1.0) } else { overhead(tracer, &outcome.log) };
    let mut report = Report::new(&outcome.log, outcome.rays, outcome.wall, overhead, tracer);
    if to.json {
        report.levels = tracer.levels();
        return print(&report.json());
    }
    // The picture is saved; if standard error is closed, the report is not needed.
    let _ = write!(io::stderr(), "{report}");
    print(&to.out.display().to_string())
}

#[expect(clippy::disallowed_methods, reason = "measures the wall time of the whole run")]
fn run(tracer: &Arc<Tracer>, header: &Header) -> Result<RenderResult, Failure> {
    let begun = Instant::now();
    let run = Run::start(Arc::clone(tracer), header);
    let bar = atoms_bar(header);
    let mut frame = Frame::new(header.size);
    // The log gets all records at once; otherwise it would sort its end for the batch of each party.
    let mut all_records = Vec::new();
    let mut rays = RayCounts::default();
    let failure = loop {
        match run.updates().recv() {
            Ok(Update::Records(records)) => all_records.extend(records),
            Ok(Update::Placed { atoms, pixels }) => {
                for (place, colours) in header.division.placed(&atoms, &pixels) {
                    frame.place(place, colours);
                }
                bar.inc(atoms.iter().map(|range| range.len() as u64).sum());
            }
            Ok(Update::Rays(more)) => rays += more,
            Ok(Update::Finished) => break None,
            Ok(Update::Failed(error)) => break Some(error),
            Err(_) => break Some(RunError::NoResult),
        }
    };
    let wall = begun.elapsed();
    bar.finish_and_clear();
    match failure {
        Some(error) => Err(Failure::Failed(error.to_string())),
        None => {
            let mut log = RunLog::new(header.clone());
            log.add(all_records);
            Ok(RenderResult { frame, log, rays, wall })
        }
    }
}

/// Traces the picture, then executes the run in virtual time, as fast as this computer can.
#[expect(clippy::disallowed_methods, reason = "measures the wall time of the whole run")]
fn simulate(tracer: &Arc<Tracer>, header: &Header, measured: Option<Sim>) -> Result<RenderResult, Failure> {
    let begun = Instant::now();
    let bar = atoms_bar(header);
    let whole = TracedPicture::of(tracer, header.division, &|atoms| bar.inc(atoms.into()))
        .map_err(|error| Failure::Failed(error.to_string()))?;
    bar.finish_and_clear();
    let frame = Frame::of(header.size, &whole.pixels);
    let mut sim = measured.unwrap_or_else(|| {
        let costs = whole.costs();
        Sim::new(header, &[], move |atom| costs[atom as usize])
    });
    let mut records = Vec::new();
    sim.run(&mut |record| records.push(record));
    let mut log = RunLog::new(header.clone());
    log.add(records);
    Ok(RenderResult { frame, log, rays: whole.counts, wall: begun.elapsed() })
}

/// Prepares a run in virtual time with the costs of a recorded run of the same picture.
fn measured(path: &Path, header: &Header) -> Result<Sim, Failure> {
    let log = RunLog::load(path).map_err(|error| Failure::Refused(error.to_string()))?;
    Sim::measured(header, &log)
        .map_err(|why| Failure::Refused(format!("the costs in {} cannot be used: {why}", path.display())))
}

/// A progress bar that counts atoms.
fn atoms_bar(header: &Header) -> ProgressBar {
    progress(header.division.atoms().into(), "{percent:>3} %  {pos}/{len} atoms  {elapsed} ({eta} left)")
}

/// Returns the cost of atoms in the run divided by their cost on one thread, measured on a sample; `None` if the sample
/// is empty. Contention for caches and cores raises the cost of an atom, so the efficiency does not show it.
fn overhead(tracer: &Tracer, log: &RunLog) -> Option<f64> {
    let costs = log.costs();
    let budget = (Metrics::of(log).work() / 10).min(Duration::from_secs(1));
    let serial = probe(tracer, log.header.division, budget).atoms;
    let in_run: Duration = serial.iter().map(|(atom, _)| costs[*atom as usize].unwrap_or_default()).sum();
    let alone: Duration = serial.iter().map(|(_, cost)| *cost).sum();
    (!alone.is_zero()).then(|| in_run.as_secs_f64() / alone.as_secs_f64())
}
