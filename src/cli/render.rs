//! A run without a window.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use super::args::RenderArgs;
use super::report::Report;
use super::{Failure, check_outputs, open, print};
use crate::driver::{Run, Update, cores, probe};
use crate::picture::{Division, Frame, write_png};
use crate::record::What;
use crate::runlog::{Header, Link, RunLog, metrics};
use crate::tracer::{Quality, RayCounts, Tracer};

/// The records of more atoms than this would not fit the memory of a usual computer: they take about 250 bytes each.
const MAX_ATOMS: u32 = 1 << 24;

/// Where a run's results go.
pub(super) struct Outputs<'a> {
    pub out: &'a Path,
    pub log: Option<&'a Path>,
    pub json: bool,
}

/// What a run leaves behind.
struct Outcome {
    frame: Frame,
    log: RunLog,
    rays: RayCounts,
    wall: Duration,
}

pub(super) fn render(args: &RenderArgs) -> Result<(), Failure> {
    let opened = open(&args.scene)?;
    let speeds = args.node_speeds().map_err(Failure::Refused)?;
    let outputs: Vec<&Path> =
        [Some(&args.out), args.log.as_ref()].into_iter().flatten().map(PathBuf::as_path).collect();
    check_outputs(&args.scene, &outputs)?;
    let division = Division::new(args.size.pixels(), args.atom);
    if division.atoms() > MAX_ATOMS {
        return Err(Failure::Refused(format!(
            "{} atoms of {} pixels are too many; at most {MAX_ATOMS} are possible (--atom makes them larger)",
            division.atoms(),
            args.atom
        )));
    }
    let cores = cores();
    let header = Header {
        scene: opened.name,
        scene_text: opened.text,
        size: args.size,
        samples: args.samples,
        division,
        strategy: args.strategy,
        pace: args.pace_of(&speeds, cores),
        speeds,
        link: Link { latency: args.latency, bandwidth: args.bandwidth },
        handling: args.handling,
        part: args.part,
        cores,
    };
    let quality = Quality { samples: args.samples, ..Quality::default() };
    let tracer = Arc::new(Tracer::new(&opened.scene, args.size, quality));
    run_and_save(&tracer, &header, &Outputs { out: &args.out, log: args.log.as_deref(), json: args.json })
}

/// Does the run that `header` describes, and says how it was.
pub(super) fn run_and_save(tracer: &Arc<Tracer>, header: &Header, to: &Outputs<'_>) -> Result<(), Failure> {
    let outcome = run(tracer, header)?;
    write_png(to.out, header.size, &outcome.frame.to_srgb8()).map_err(|error| Failure::Failed(error.to_string()))?;
    if let Some(log) = to.log {
        outcome.log.save(log).map_err(|error| Failure::Failed(error.to_string()))?;
    }
    let report = Report::new(&outcome.log, outcome.rays, outcome.wall, overhead(tracer, &outcome.log), tracer);
    if to.json {
        return print(&report.json());
    }
    // The picture is what was asked for; where standard error is closed the figures are not missed.
    let _ = write!(io::stderr(), "{report}");
    print(&to.out.display().to_string())
}

#[expect(clippy::disallowed_methods, reason = "the wall time of the whole run, as its user feels it")]
fn run(tracer: &Arc<Tracer>, header: &Header) -> Result<Outcome, Failure> {
    let begun = Instant::now();
    let run = Run::start(Arc::clone(tracer), header);
    let bar = ProgressBar::new(u64::from(header.division.atoms()));
    let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {pos}/{len} atoms  {elapsed} ({eta} left)");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    let mut frame = Frame::new(header.size);
    // One batch for the log, which would else sort its end for each party's.
    let mut told = Vec::new();
    let mut rays = RayCounts::default();
    let failure = loop {
        match run.updates().recv() {
            Ok(Update::Records(records)) => told.extend(records),
            Ok(Update::Placed { atoms, pixels }) => {
                for (place, colours) in header.division.placed(&atoms, &pixels) {
                    frame.place(place, colours);
                }
                bar.inc(atoms.iter().map(|range| range.len() as u64).sum());
            }
            Ok(Update::Rays(more)) => rays += more,
            Ok(Update::Finished) => break None,
            Ok(Update::Failed(why)) => break Some(why),
            Err(_) => break Some("the run ended without a result".into()),
        }
    };
    let wall = begun.elapsed();
    bar.finish_and_clear();
    match failure {
        Some(why) => Err(Failure::Failed(why)),
        None => {
            let mut log = RunLog::new(header.clone());
            log.add(told);
            Ok(Outcome { frame, log, rays, wall })
        }
    }
}

/// How much dearer atoms were in the run than one after another on one thread, from a sample of them: contention for
/// caches and cores hides in an atom's cost, and so in the efficiency.
fn overhead(tracer: &Tracer, log: &RunLog) -> Option<f64> {
    let mut costs = vec![Duration::ZERO; log.header.division.atoms() as usize];
    for record in log.records() {
        if let What::AtomDone { atom, cost, .. } = record.what {
            costs[atom as usize] = cost;
        }
    }
    let budget = (metrics::work(log.records()) / 10).min(Duration::from_secs(1));
    let serial = probe(tracer, log.header.division, budget).atoms;
    let in_run: Duration = serial.iter().map(|(atom, _)| costs[*atom as usize]).sum();
    let alone: Duration = serial.iter().map(|(_, cost)| *cost).sum();
    (!alone.is_zero()).then(|| in_run.as_secs_f64() / alone.as_secs_f64())
}
