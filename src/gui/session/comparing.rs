//! The jobs of the Compare page: they run trials in virtual time.

use std::sync::Arc;

use super::super::settings::Settings;
use super::Session;
use super::job_result::{CompareResult, Growth, GrowthPoint, JobResult};
use super::jobs::Jobs;
use super::tracing::{TracingJob, TracingProgress};
use crate::balance::Strategy;
use crate::driver::{CostedPicture, PictureCache};
use crate::language::Language;
use crate::palette::Rgb;
use crate::runlog::{Driver, Metrics};
use crate::scene::Opened;
use crate::sim::{Change, PixelCosts, Trial};
use crate::tracer::Tracer;
use crate::view::ComparedRun;

/// The subject of a comparison: the run on the stage as a trial.
#[derive(Clone)]
pub struct ComparisonSubject {
    opened: Arc<Opened>,
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
        self.opened.text == other.opened.text
            && (self.tracer.size(), self.tracer.quality()) == (other.tracer.size(), other.tracer.quality())
    }

    /// Returns the trial at the pace at which it lasts in virtual time as long as set.
    fn paced(&self, mut trial: Trial, costs: &PixelCosts) -> Trial {
        if let Some(settings) = &self.settings {
            trial.header.pace = settings.header("", "", costs.whole(), 1).pace;
        }
        trial
    }
}

/// A trial to run, with the number of its column and its changes.
pub type NumberedTrial = (u64, Vec<Change>, Trial);

impl Session {
    /// Returns the run on the stage as a subject of comparison: in virtual time, with all changes that the user has
    /// made to it so far. `None` until the scene is compiled.
    pub fn subject(&self) -> Option<ComparisonSubject> {
        let recorded = self.recorded.as_ref().map(|recorded| (&recorded.opened, &recorded.tracer));
        let prepared = || self.prepared.as_ref().map(|prepared| (&prepared.opened, &prepared.tracer));
        let (opened, tracer) = recorded.or_else(prepared)?;
        let mut trial = Trial::of(&self.stage.log);
        let has_own_pace = self.recorded.is_some() || self.header().driver == Driver::Sim;
        let settings = (!has_own_pace).then(|| Settings { driver: Driver::Sim, ..self.settings.clone() });
        // A trial cannot share with rayon, so the ring takes its place.
        if self.header().driver == Driver::WorkStealing {
            trial = trial.with(Change::Strategy(Strategy::Ring));
        }
        let (opened, tracer) = (Arc::clone(opened), Arc::clone(tracer));
        (tracer.size() == trial.header.size).then_some(ComparisonSubject { opened, tracer, trial, settings })
    }

    /// Starts the job that traces the picture, unless it is kept, and runs the trials. Returns the job's number, and
    /// its progress until the picture is traced.
    pub fn compare(&mut self, subject: &ComparisonSubject, trials: Vec<NumberedTrial>) -> (u64, TracingProgress) {
        let language = self.language;
        let progress = TracingProgress::new(subject.tracer.size().pixels(), self.clock);
        let work = (subject.clone(), Arc::clone(&self.pictures), progress.job());
        (self.jobs.compare(work, trials, self.ground, language), progress)
    }

    /// Starts the job that runs the subject by each strategy with one to eight machines. Returns the job's number, and
    /// its progress if the picture has to be traced again.
    pub fn grow(&mut self, subject: &ComparisonSubject) -> (u64, TracingProgress) {
        let language = self.language;
        let progress = TracingProgress::new(subject.tracer.size().pixels(), self.clock);
        let work = (subject.clone(), Arc::clone(&self.pictures), progress.job());
        (self.jobs.grow(work, language), progress)
    }
}

/// The subject of a job, the kept pictures, and the job's progress.
type Work = (ComparisonSubject, Arc<PictureCache>, TracingJob);

impl Jobs {
    fn compare(&mut self, work: Work, trials: Vec<NumberedTrial>, ground: Rgb, language: Language) -> u64 {
        let number = self.number();
        let failed = move |why| JobResult::Compared(number, CompareResult::Failed(why));
        self.start_many(language, "compare", failed, move |send| {
            let send = |result| send(JobResult::Compared(number, result));
            let picture = match picture_of(&work) {
                Ok(None) => return,
                Ok(Some(picture)) => picture,
                Err(why) => return send(CompareResult::Failed(why)),
            };
            send(CompareResult::Traced);
            let (subject, _, job) = work;
            for (id, changes, trial) in trials {
                if job.cancel.is_cancelled() {
                    return;
                }
                let log = Arc::new(subject.paced(trial, &picture.costs).run(&picture.costs));
                send(CompareResult::Run(id, Box::new(ComparedRun::new(changes, log, &picture.pixels, ground))));
            }
        });
        number
    }

    fn grow(&mut self, work: Work, language: Language) -> u64 {
        let number = self.number();
        let failed = move |why| JobResult::Compared(number, CompareResult::Failed(why));
        self.start_many(language, "grow", failed, move |send| {
            let send = |result| send(JobResult::Compared(number, result));
            match picture_of(&work) {
                Ok(Some(picture)) => {
                    let (subject, ..) = work;
                    let trial = subject.paced(subject.trial.clone(), &picture.costs);
                    send(CompareResult::Growth(growth_of(&trial, &picture.costs)));
                }
                Ok(None) => {}
                Err(why) => send(CompareResult::Failed(why)),
            }
        });
        number
    }
}

/// Returns the picture of the subject, traced on all cores if it is not kept; `None` if that is cancelled.
fn picture_of((subject, kept, job): &Work) -> Result<Option<Arc<CostedPicture>>, String> {
    let picture = kept.get_or_trace(&subject.opened.text, &subject.tracer, &|more| job.add(more), &job.cancel);
    picture.map_err(|error| error.to_string())
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
