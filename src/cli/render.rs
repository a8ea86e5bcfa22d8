//! `anel render`: a run without a window. A signal ends it early; the picture so far and its records are then written.

use std::io::{self, Write};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use indicatif::ProgressBar;

use super::args::RenderArgs;
use super::layers::LayerArgs;
use super::report::Report;
use super::run_header;
use super::{Failure, check_outputs, check_picture_and_log, load_run, open, print, print_path, progress, tell};
use crate::cancel::CancelToken;
use crate::driver::{PartialPicture, Run, RunError, TracedPicture, Update, probe};
use crate::interrupt::EndsEarly;
use crate::picture::{Colour, Coverage, Frame, Region, Size, atoms_in, write_png, write_png_with_alpha};
use crate::runlog::{Driver, Header, Metrics, RunLog};
use crate::sim::Sim;
use crate::tracer::{RayCounts, Scratch, Tracer};

/// The destinations of a run's results, and the form of its picture.
pub(super) struct Outputs<'a> {
    pub out: &'a Path,
    pub log: Option<&'a Path>,
    pub layers: LayerArgs,
    /// The scene's background, if the picture is to be transparent where it is seen.
    pub transparent_on: Option<Colour>,
    /// The whole picture's size and the region, if only a region is traced.
    pub region: Option<(Size, Region)>,
    pub json: bool,
}

impl<'a> Outputs<'a> {
    /// The whole picture, and the records if `log` is given.
    pub fn of_run(out: &'a Path, log: Option<&'a Path>) -> Self {
        Self { out, log, layers: LayerArgs::default(), transparent_on: None, region: None, json: false }
    }
}

/// The results of a run, or of its part before a signal.
struct RenderResult {
    frame: Frame,
    /// The pixels' coverage, if the picture has no background; its colours are then premultiplied.
    coverage: Option<Arc<Coverage>>,
    /// The number of atoms in the frame.
    placed: u32,
    log: RunLog,
    rays: RayCounts,
    wall: Duration,
}

pub(super) fn render(args: &RenderArgs) -> Result<(), Failure> {
    let opened = open(&args.scene)?;
    let header = run_header::header(args, &opened).map_err(Failure::Refused)?;
    let mut outputs: Vec<&Path> = vec![&args.out];
    outputs.extend(args.log.as_deref());
    outputs.extend(args.layers.outputs());
    check_outputs(&args.scene, &outputs)?;
    check_picture_and_log(Some(&args.out), args.log.as_deref())?;
    let measured = args.costs.as_deref().map(|path| measured(path, &header)).transpose()?;
    let tracer = Tracer::new(&opened.scene, args.size, header.quality);
    let tracer = Arc::new(match args.region {
        Some(region) => tracer.of_region(region),
        None => tracer,
    });
    let to = Outputs {
        layers: args.layers.clone(),
        transparent_on: args.transparent.then(|| opened.scene.background.as_vec3().to_array()),
        region: args.region.map(|region| (args.size, region)),
        json: args.json,
        ..Outputs::of_run(&args.out, args.log.as_deref())
    };
    run_and_save(&tracer, &header, measured, &to)
}

/// Does the run that `header` describes, saves its results, and prints its report. In virtual time it uses `measured`,
/// if that is given.
pub(super) fn run_and_save(
    tracer: &Arc<Tracer>,
    header: &Header,
    measured: Option<Sim>,
    to: &Outputs<'_>,
) -> Result<(), Failure> {
    let interrupted = CancelToken::default();
    let ends_early = {
        let interrupted = interrupted.clone();
        EndsEarly::new(move || interrupted.cancel())
    };
    let coverage = to.transparent_on.map(|_| Arc::new(Coverage::new(header.size.pixels())));
    let outcome = match header.driver {
        Driver::Sim => simulate(tracer, header, measured, coverage, &interrupted)?,
        Driver::Threads | Driver::Pairs | Driver::WorkStealing => run(tracer, header, coverage, &interrupted)?,
    };
    save(&outcome, to)?;
    drop(ends_early);
    let is_interrupted = interrupted.is_cancelled();
    if is_interrupted {
        tell(&interruption(&outcome, header, to));
    }
    let overhead = match header.driver {
        _ if is_interrupted => None,
        // In virtual time threads do not compete for cores and caches.
        Driver::Sim => Some(1.0),
        Driver::Threads | Driver::Pairs | Driver::WorkStealing => overhead(tracer, &outcome.log),
    };
    let mut report = Report::new(&outcome.log, outcome.rays, outcome.wall, overhead, tracer);
    report.interrupted = is_interrupted;
    report.set_region(to.region);
    if to.json {
        if !is_interrupted {
            report.levels = tracer.levels();
        }
        return print(&report.json());
    }
    if !is_interrupted {
        // The picture is saved; if standard error is closed, the report is not needed.
        let _ = write!(io::stderr(), "{report}");
    }
    print_path(to.out)
}

/// Says what an interrupted run has written.
fn interruption(outcome: &RenderResult, header: &Header, to: &Outputs<'_>) -> String {
    let (out, placed, atoms) = (to.out.display(), outcome.placed, header.division.atoms());
    let picture = if placed == atoms {
        format!("{out} is complete")
    } else {
        format!("{out} has {placed} of {atoms} atoms; the rest is black")
    };
    let records = to.log.map(|log| format!(", and {} the records so far", log.display())).unwrap_or_default();
    format!("the run was interrupted: {picture}{records}")
}

/// Saves the picture, its layers and the records.
fn save(outcome: &RenderResult, to: &Outputs<'_>) -> Result<(), Failure> {
    let failed = |error: &dyn std::error::Error| Failure::Failed(error.to_string());
    let RenderResult { frame, coverage, log, .. } = outcome;
    match (coverage, to.transparent_on) {
        (Some(coverage), Some(background)) => {
            let rgba = coverage.to_srgba8(frame.pixels());
            write_png_with_alpha(to.out, frame.size(), &rgba).map_err(|error| failed(&error))?;
            to.layers.write(log, &coverage.over(frame, background))?;
        }
        _ => {
            write_png(to.out, frame.size(), &frame.to_srgb8()).map_err(|error| failed(&error))?;
            to.layers.write(log, frame)?;
        }
    }
    to.log.map_or(Ok(()), |path| log.save(path).map_err(|error| failed(&error)))
}

/// The function that traces pixels: without the background, if there is a `coverage` to fill.
fn tracing(
    tracer: &Arc<Tracer>,
    coverage: &Option<Arc<Coverage>>,
) -> impl Fn(Range<u32>, &mut Scratch, &mut Vec<Colour>) + Send + Sync + 'static {
    let (tracer, coverage) = (Arc::clone(tracer), coverage.clone());
    move |pixels, scratch, out| match &coverage {
        Some(coverage) => tracer.trace_transparent(pixels, scratch, out, |pixel, share| coverage.set(pixel, share)),
        None => tracer.trace(pixels, scratch, out),
    }
}

#[expect(clippy::disallowed_methods, reason = "measures the wall time of the whole run")]
fn run(
    tracer: &Arc<Tracer>,
    header: &Header,
    coverage: Option<Arc<Coverage>>,
    interrupted: &CancelToken,
) -> Result<RenderResult, Failure> {
    /// How long a signal may stay unnoticed.
    const INTERRUPT_INTERVAL: Duration = Duration::from_millis(50);
    let begun = Instant::now();
    let run = Run::start_with(tracing(tracer, &coverage), header);
    let bar = atoms_bar(header);
    let mut frame = Frame::new(header.size);
    // The log gets all records at once; otherwise it would sort its end for the batch of each party.
    let mut all_records = Vec::new();
    let (mut rays, mut placed) = (RayCounts::default(), 0);
    let failure = loop {
        if interrupted.is_cancelled() {
            // The last update follows once all threads have ended.
            run.stop();
        }
        match run.updates().recv_timeout(INTERRUPT_INTERVAL) {
            Ok(Update::Records(records)) => all_records.extend(records),
            Ok(Update::Placed { atoms, pixels }) => {
                for (place, colours) in header.division.placed(&atoms, &pixels) {
                    frame.place(place, colours);
                }
                placed += atoms_in(&atoms);
                bar.set_position(placed.into());
            }
            Ok(Update::Rays(more)) => rays += more,
            Ok(Update::Finished) => break None,
            Ok(Update::Failed(RunError::Stopped)) if interrupted.is_cancelled() => break None,
            Ok(Update::Failed(error)) => break Some(error),
            Err(error) if error.is_timeout() => {}
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
            Ok(RenderResult { frame, coverage, placed, log, rays, wall })
        }
    }
}

/// Traces the picture, then executes the run in virtual time, as fast as this computer can.
#[expect(clippy::disallowed_methods, reason = "measures the wall time of the whole run")]
fn simulate(
    tracer: &Arc<Tracer>,
    header: &Header,
    measured: Option<Sim>,
    coverage: Option<Arc<Coverage>>,
    interrupted: &CancelToken,
) -> Result<RenderResult, Failure> {
    let begun = Instant::now();
    let bar = atoms_bar(header);
    let (trace, done) = (tracing(tracer, &coverage), |atoms: u32| bar.inc(atoms.into()));
    let traced = TracedPicture::or_part(header.size, header.division, &trace, &done, interrupted)
        .map_err(|error| Failure::Failed(error.to_string()))?;
    bar.finish_and_clear();
    let mut log = RunLog::new(header.clone());
    let whole = match traced {
        Ok(whole) => whole,
        // The run in virtual time has not begun, so it has no records.
        Err(PartialPicture { frame, atoms, counts }) => {
            return Ok(RenderResult { frame, coverage, placed: atoms, log, rays: counts, wall: begun.elapsed() });
        }
    };
    let frame = Frame::of(header.size, &whole.pixels);
    let mut sim = measured.unwrap_or_else(|| {
        let costs = whole.costs();
        Sim::new(header, &[], move |atom| costs[atom as usize])
    });
    let mut records = Vec::new();
    sim.run_unless_cancelled(interrupted, &mut |record| records.push(record));
    log.add(records);
    let placed = header.division.atoms();
    Ok(RenderResult { frame, coverage, placed, log, rays: whole.counts, wall: begun.elapsed() })
}

/// Prepares a run in virtual time with the costs of a recorded run of the same picture.
fn measured(path: &Path, header: &Header) -> Result<Sim, Failure> {
    let log = load_run(path)?;
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
