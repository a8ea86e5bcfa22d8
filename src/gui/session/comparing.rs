//! The jobs that run trials beside each other, in virtual time.

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

/// What a comparison is of.
#[derive(Clone)]
pub struct ComparisonSubject {
    tracer: Arc<Tracer>,
    /// The run on the stage, in virtual time.
    pub trial: Trial,
    /// What is set, if the run's own pace is that of this computer's threads.
    settings: Option<Settings>,
}

impl ComparisonSubject {
    /// Whether it is the same.
    pub fn is_like(&self, other: &Self) -> bool {
        self.has_picture_of(other) && self.trial == other.trial
    }

    /// Whether what was traced for this subject serves the other, too.
    pub fn has_picture_of(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.tracer, &other.tracer)
    }

    /// A trial of it, at the pace at which all lasts in virtual time as long as is set.
    fn paced(&self, mut trial: Trial, costs: &PixelCosts) -> Trial {
        if let Some(settings) = &self.settings {
            trial.header.pace = settings.header("", "", costs.whole(), 1).pace;
        }
        trial
    }
}

/// How far the picture of a comparison is.
#[derive(Default)]
pub struct TracingProgress {
    done: AtomicU32,
    cancel: CancelToken,
}

impl TracingProgress {
    /// How many pixels are traced.
    pub fn done(&self) -> u32 {
        self.done.load(Ordering::Relaxed)
    }

    /// Nobody waits for it any more.
    pub fn give_up(&self) {
        self.cancel.cancel();
    }
}

/// What is known of the picture beforehand.
pub enum PictureSource {
    /// It is to be traced.
    Nothing(Arc<TracingProgress>),
    /// All of it.
    Picture(Arc<TracedOnce>),
}

/// A trial that is to be run, its number and its name.
pub type NumberedTrial = (u64, String, Trial);

impl Session {
    /// What can be compared now: the run on the stage, as it would be in virtual time, with all that was done to it so
    /// far. Nothing until the scene is compiled.
    pub fn subject(&self) -> Option<ComparisonSubject> {
        let recorded = self.recorded.as_ref().map(|recorded| Arc::clone(&recorded.tracer));
        let tracer = recorded.or_else(|| self.prepared.as_ref().map(|prepared| Arc::clone(&prepared.tracer)))?;
        let mut trial = Trial::of(&self.stage.log);
        let has_own_pace = self.recorded.is_some() || self.header().driver == Driver::Sim;
        let settings = (!has_own_pace).then(|| Settings { driver: Driver::Sim, ..self.settings.clone() });
        // rayon shares by no rules of ours.
        if self.header().driver == Driver::WorkStealing {
            trial = trial.with(Change::Strategy(Strategy::Ring));
        }
        (tracer.size() == trial.header.size).then_some(ComparisonSubject { tracer, trial, settings })
    }

    /// Traces the picture, if it is not known, and runs trials of it; returns the job's number.
    pub fn compare(&mut self, subject: &ComparisonSubject, known: PictureSource, entries: Vec<NumberedTrial>) -> u64 {
        let language = self.language;
        self.jobs.compare(subject.clone(), known, entries, self.ground, language)
    }

    /// Runs the subject by each strategy with more and more machines; returns the job's number.
    pub fn grow(&mut self, subject: &ComparisonSubject, pictured: Arc<TracedOnce>) -> u64 {
        let language = self.language;
        self.jobs.grow(subject.clone(), pictured, language)
    }
}

impl Jobs {
    fn compare(
        &mut self,
        subject: ComparisonSubject,
        known: PictureSource,
        entries: Vec<NumberedTrial>,
        ground: Rgb,
        language: Language,
    ) -> u64 {
        let number = self.number();
        let failed = move |why| JobResult::CompareResult(number, CompareResult::Failed(why));
        self.start_many(language, "compare", failed, move |tell| {
            let tell = |compared| tell(JobResult::CompareResult(number, compared));
            let pictured = match known {
                PictureSource::Picture(pictured) => pictured,
                PictureSource::Nothing(tracing) => match pictured(&subject.tracer, &tracing) {
                    Ok(None) => return,
                    Ok(Some(pictured)) => pictured,
                    Err(why) => return tell(CompareResult::Failed(why)),
                },
            };
            tell(CompareResult::Picture(Arc::clone(&pictured)));
            for (id, name, trial) in entries {
                let log = Arc::new(subject.paced(trial, &pictured.costs).run(&pictured.costs));
                tell(CompareResult::Run(id, Box::new(ComparedRun::new(name, log, &pictured.pixels, ground))));
            }
        });
        number
    }

    fn grow(&mut self, subject: ComparisonSubject, pictured: Arc<TracedOnce>, language: Language) -> u64 {
        let number = self.number();
        let failed = move |why| JobResult::CompareResult(number, CompareResult::Failed(why));
        self.start_many(language, "grow", failed, move |tell| {
            let trial = subject.paced(subject.trial.clone(), &pictured.costs);
            tell(JobResult::CompareResult(number, CompareResult::Growth(grown(&trial, &pictured.costs))));
        });
        number
    }
}

/// Traces the picture on all cores, unless it is given up.
fn pictured(tracer: &Arc<Tracer>, tracing: &TracingProgress) -> Result<Option<Arc<TracedOnce>>, String> {
    let done = |more| _ = tracing.done.fetch_add(more, Ordering::Relaxed);
    let traced = TracedPicture::by_pixel(tracer, &done, &tracing.cancel).map_err(|error| error.to_string())?;
    Ok(traced.map(|(pixels, costs)| Arc::new(TracedOnce { pixels, costs })))
}

/// With one machine to eight, the last of which is slow where a machine of the trial is.
fn grown(trial: &Trial, costs: &PixelCosts) -> Growth {
    const MOST: usize = 8;
    let slowest = trial.header.speeds.iter().copied().fold(1.0, f64::min);
    let slow = (0.0 < slowest && slowest < 0.5).then_some(slowest);
    // What was done to the run was done to its machines, which here are others.
    let mut bare = Trial { script: Vec::new(), ..trial.clone() };
    bare.header.spares = 0;
    let one = bare.with(Change::Nodes(1)).with(Change::Equal).with(Change::Strategy(Strategy::Serial));
    let alone = Metrics::of(&one.run(costs)).makespan().unwrap_or_default();
    let of = |strategy| {
        let run = |machines: usize| {
            let equal = bare.with(Change::Nodes(machines)).with(Change::Equal).with(Change::Strategy(strategy));
            let grown = match slow {
                Some(speed) if machines > 1 => equal.with(Change::Speed(machines as u16 - 1, speed)),
                _ => equal,
            };
            let tally = Metrics::of(&grown.run(costs));
            let (makespan, efficiency) = (tally.makespan()?, tally.efficiency()?);
            Some(GrowthPoint { machines, speedup: alone.div_duration_f64(makespan), efficiency })
        };
        (strategy, (1..=MOST).filter_map(run).collect())
    };
    Growth { of: [Strategy::Static, Strategy::Farm, Strategy::Ring, Strategy::Adaptive].map(of).into(), alone, slow }
}
