//! The jobs of the Compare page: they run trials in virtual time.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use super::super::settings::Settings;
use super::Session;
use super::job_result::{CompareResult, Growth, GrowthPoint, JobResult, TracedOnce};
use super::jobs::Jobs;
use crate::balance::Strategy;
use crate::cancel::CancelToken;
use crate::driver::TracedPicture;
use crate::language::Language;
use crate::palette::Rgb;
use crate::runlog::{Driver, Metrics};
use crate::sim::{Change, PixelCosts, Trial};
use crate::tracer::Tracer;
use crate::view::ComparedRun;

/// The subject of a comparison: the run on the stage as a trial.
#[derive(Clone)]
pub struct ComparisonSubject {
    tracer: Arc<Tracer>,
    /// The run on the stage, to be run in virtual time.
    pub trial: Trial,
    /// The settings, if the run's pace is that of this computer's threads and has to be computed anew for virtual time.
    settings: Option<Settings>,
}

impl ComparisonSubject {
    /// Whether both have the same picture and the same trial.
    pub fn is_same_as(&self, other: &Self) -> bool {
        self.has_picture_of(other) && self.trial == other.trial
    }

    /// Whether a picture that was traced for this subject can be used for the other.
    pub fn has_picture_of(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.tracer, &other.tracer)
    }

    /// Returns the trial at the pace at which it lasts in virtual time as long as set.
    fn paced(&self, mut trial: Trial, costs: &PixelCosts) -> Trial {
        if let Some(settings) = &self.settings {
            trial.header.pace = settings.header("", "", costs.whole(), 1).pace;
        }
        trial
    }
}

/// Progress of tracing the picture of a comparison.
#[derive(Default)]
pub struct TracingProgress {
    done: AtomicU32,
    cancel: CancelToken,
}

impl TracingProgress {
    /// Returns the number of traced pixels.
    pub fn done(&self) -> u32 {
        self.done.load(Ordering::Relaxed)
    }

    /// Cancels the tracing.
    pub fn cancel(&self) {
        self.cancel.cancel();
    }
}

/// Source of a comparison's picture.
pub enum PictureSource {
    /// The job traces the picture, and reports its progress here.
    Untraced(Arc<TracingProgress>),
    /// The picture is traced already.
    Traced(Arc<TracedOnce>),
}

/// A trial to run, with the number of its column and its changes.
pub type NumberedTrial = (u64, Vec<Change>, Trial);

impl Session {
    /// Returns the run on the stage as a subject of comparison: in virtual time, with all changes that the user has
    /// made to it so far. `None` until the scene is compiled.
    pub fn subject(&self) -> Option<ComparisonSubject> {
        let recorded = self.recorded.as_ref().map(|recorded| Arc::clone(&recorded.tracer));
        let tracer = recorded.or_else(|| self.prepared.as_ref().map(|prepared| Arc::clone(&prepared.tracer)))?;
        let mut trial = Trial::of(&self.stage.log);
        let has_own_pace = self.recorded.is_some() || self.header().driver == Driver::Sim;
        let settings = (!has_own_pace).then(|| Settings { driver: Driver::Sim, ..self.settings.clone() });
        // A trial cannot share with rayon, so the ring takes its place.
        if self.header().driver == Driver::WorkStealing {
            trial = trial.with(Change::Strategy(Strategy::Ring));
        }
        (tracer.size() == trial.header.size).then_some(ComparisonSubject { tracer, trial, settings })
    }

    /// Starts the job that traces the picture, unless it is traced, and runs the trials. Returns the job's number.
    pub fn compare(&mut self, subject: &ComparisonSubject, picture: PictureSource, trials: Vec<NumberedTrial>) -> u64 {
        let language = self.language;
        self.jobs.compare(subject.clone(), picture, trials, self.ground, language)
    }

    /// Starts the job that runs the subject by each strategy with one to eight machines. Returns the job's number.
    pub fn grow(&mut self, subject: &ComparisonSubject, picture: Arc<TracedOnce>) -> u64 {
        let language = self.language;
        self.jobs.grow(subject.clone(), picture, language)
    }
}

impl Jobs {
    fn compare(
        &mut self,
        subject: ComparisonSubject,
        picture: PictureSource,
        trials: Vec<NumberedTrial>,
        ground: Rgb,
        language: Language,
    ) -> u64 {
        let number = self.number();
        let failed = move |why| JobResult::Compared(number, CompareResult::Failed(why));
        self.start_many(language, "compare", failed, move |send| {
            let send = |result| send(JobResult::Compared(number, result));
            let picture = match picture {
                PictureSource::Traced(picture) => picture,
                PictureSource::Untraced(progress) => match trace_once(&subject.tracer, &progress) {
                    Ok(None) => return,
                    Ok(Some(picture)) => picture,
                    Err(why) => return send(CompareResult::Failed(why)),
                },
            };
            send(CompareResult::Picture(Arc::clone(&picture)));
            for (id, changes, trial) in trials {
                let log = Arc::new(subject.paced(trial, &picture.costs).run(&picture.costs));
                send(CompareResult::Run(id, Box::new(ComparedRun::new(changes, log, &picture.pixels, ground))));
            }
        });
        number
    }

    fn grow(&mut self, subject: ComparisonSubject, picture: Arc<TracedOnce>, language: Language) -> u64 {
        let number = self.number();
        let failed = move |why| JobResult::Compared(number, CompareResult::Failed(why));
        self.start_many(language, "grow", failed, move |send| {
            let trial = subject.paced(subject.trial.clone(), &picture.costs);
            send(JobResult::Compared(number, CompareResult::Growth(growth_of(&trial, &picture.costs))));
        });
        number
    }
}

/// Traces the picture on all cores; `None` if that is cancelled.
fn trace_once(tracer: &Arc<Tracer>, progress: &TracingProgress) -> Result<Option<Arc<TracedOnce>>, String> {
    let done = |more| _ = progress.done.fetch_add(more, Ordering::Relaxed);
    let traced = TracedPicture::by_pixel(tracer, &done, &progress.cancel).map_err(|error| error.to_string())?;
    Ok(traced.map(|(pixels, costs)| Arc::new(TracedOnce { pixels, costs })))
}

/// Runs the trial by each strategy with one to eight machines. The last machine is slow if one of the trial's is.
fn growth_of(trial: &Trial, costs: &PixelCosts) -> Growth {
    const MAX_MACHINES: usize = 8;
    let slowest = trial.header.speeds.iter().copied().fold(1.0, f64::min);
    let slow = (0.0 < slowest && slowest < 0.5).then_some(slowest);
    // The script is about the trial's own machines.
    let mut bare = Trial { script: Vec::new(), ..trial.clone() };
    bare.header.spares = 0;
    let one = bare.with(Change::Nodes(1)).with(Change::Equal).with(Change::Strategy(Strategy::Serial));
    let alone = Metrics::of(&one.run(costs)).makespan().unwrap_or_default();
    let points_of = |strategy: Strategy| {
        let run = |machines: usize| {
            let equal = bare.with(Change::Nodes(machines)).with(Change::Equal).with(Change::Strategy(strategy.clone()));
            let trial = match slow {
                Some(speed) if machines > 1 => equal.with(Change::Speed(machines as u16 - 1, speed)),
                _ => equal,
            };
            let metrics = Metrics::of(&trial.run(costs));
            let (makespan, efficiency) = (metrics.makespan()?, metrics.efficiency()?);
            Some(GrowthPoint { machines, speedup: alone.div_duration_f64(makespan), efficiency })
        };
        let points = (1..=MAX_MACHINES).filter_map(run).collect();
        (strategy, points)
    };
    let strategies = [Strategy::Static, Strategy::Farm, Strategy::FarmLeases, Strategy::Ring, Strategy::Adaptive];
    let curves = strategies.map(points_of).into();
    Growth { curves, alone, slow }
}
