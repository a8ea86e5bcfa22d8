//! Claims of a lesson about its runs: figures within bounds, and their check.

use serde::Deserialize;

use super::perform::LessonRun;
use super::{Lesson, LessonError, MissingMoment, Moment, Step};
use crate::picture::atoms_in;
use crate::record::RecordKind;
use crate::runlog::RunLog;
use crate::view::TimeBudget;

/// A claim: a figure of a run, or its ratio to the figure of another run, lies within bounds.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// The figure.
    pub figure: ClaimFigure,
    /// The name of the run; the run that the step shows if `None`.
    #[serde(default)]
    pub of: Option<String>,
    /// The name of the run by whose figure the figure is divided.
    #[serde(default)]
    pub over: Option<String>,
    /// The lower bound, inclusive.
    #[serde(default)]
    pub at_least: Option<f64>,
    /// The upper bound, inclusive.
    #[serde(default)]
    pub at_most: Option<f64>,
}

/// A figure of a run. `docs/figures.md` defines them exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum ClaimFigure {
    /// The makespan in seconds.
    Seconds,
    /// Ideal makespan / makespan, 0 to 1.
    Efficiency,
    /// Share of the machines' time after their last atoms, 0 to 1.
    Waiting,
    /// Share of the machines' time between their atoms, 0 to 1.
    Asking,
    /// Share of the machines' time before their first atoms, 0 to 1.
    Starting,
    /// Share of the makespan, at its end, in which only one machine traced, 0 to 1.
    Alone,
    /// The number of the machine that traced the last atom, from 1.
    Last,
    /// The number of offers made.
    Offers,
    /// The number of offers passed on.
    Hops,
    /// The number of transfers from machine to machine.
    Transfers,
    /// The number of atoms in all transfers.
    Moved,
    /// The number of atoms in the largest transfer.
    Largest,
    /// The number of messages of every kind.
    Messages,
    /// The number of atoms of the picture.
    Atoms,
    /// The cost of the dearest atom / the mean cost of an atom.
    Dearest,
    /// 1 if the picture is completed, else 0.
    Ends,
}

impl ClaimFigure {
    /// The value in a run, whose time budget is `None` if its picture is never completed. Then only [`Self::Ends`] and
    /// [`Self::Atoms`] have a value.
    fn of(self, log: &RunLog, budget: Option<&TimeBudget>) -> Option<f64> {
        match self {
            Self::Ends => return Some(if budget.is_some() { 1.0 } else { 0.0 }),
            Self::Atoms => return Some(log.header.division.atoms().into()),
            _ => {}
        }
        let budget = budget?;
        let share = |part: f64| part / budget.spent.sum().max(f64::MIN_POSITIVE);
        Some(match self {
            Self::Seconds => budget.makespan.as_secs_f64(),
            Self::Efficiency => budget.efficiency(),
            Self::Waiting => share(budget.spent.waiting),
            Self::Asking => share(budget.spent.asking),
            Self::Starting => share(budget.spent.starting),
            Self::Alone => budget.last.alone.div_duration_f64(budget.makespan),
            Self::Last => f64::from(budget.last.node) + 1.0,
            Self::Offers => budget.messages.offers as f64,
            Self::Hops => budget.messages.hops as f64,
            Self::Transfers => budget.messages.transfers as f64,
            Self::Moved => budget.messages.atoms_moved as f64,
            Self::Messages => budget.messages.total as f64,
            Self::Largest => largest(log),
            Self::Dearest => dearest(log),
            Self::Ends | Self::Atoms => return None,
        })
    }
}

/// The number of atoms in the largest transfer; 0 without transfers.
fn largest(log: &RunLog) -> f64 {
    let Some((records, _)) = Moment::BiggestTransfer.of(log) else { return 0.0 };
    match &log.records()[records - 1].kind {
        RecordKind::Sent { message, .. } => atoms_in(message.ranges()).into(),
        _ => 0.0,
    }
}

/// The cost of the dearest atom divided by the mean cost of an atom.
fn dearest(log: &RunLog) -> f64 {
    let costs: Vec<f64> = log.costs().into_iter().flatten().map(|cost| cost.as_secs_f64()).collect();
    let mean = costs.iter().sum::<f64>() / costs.len().max(1) as f64;
    costs.iter().copied().fold(0.0, f64::max) / mean.max(f64::MIN_POSITIVE)
}

/// A run with its time budget, `None` if its picture is never completed.
struct ClaimRun<'a> {
    name: &'a str,
    log: &'a RunLog,
    budget: Option<TimeBudget>,
}

fn claim_runs(performed: &[(String, LessonRun)]) -> Vec<ClaimRun<'_>> {
    performed.iter().map(|(name, run)| ClaimRun { name, log: &run.log, budget: TimeBudget::of(&run.log) }).collect()
}

impl Claim {
    /// Returns the value, and whether the claim is true. `run` is the run that the step shows.
    fn check(&self, run: &str, runs: &[ClaimRun<'_>]) -> (Option<f64>, bool) {
        let value = |name: &str| {
            let run = runs.iter().find(|run| run.name == name)?;
            self.figure.of(run.log, run.budget.as_ref())
        };
        let of = value(self.of.as_deref().unwrap_or(run));
        let value = match &self.over {
            Some(over) => of.zip(value(over)).map(|(of, over)| of / over),
            None => of,
        };
        let is_within = |value: f64| {
            self.at_least.is_none_or(|least| value >= least) && self.at_most.is_none_or(|most| value <= most)
        };
        (value, value.is_some_and(is_within))
    }
}

impl Step {
    /// Returns the moment of the step if its run does not have it.
    fn missing(&self, performed: &[(String, LessonRun)]) -> Option<MissingMoment> {
        let (moment, (name, run)) = (self.until?, performed.iter().find(|(name, _)| *name == self.run)?);
        let seconds = run.log.records().last().map_or(0.0, |record| record.at.secs());
        moment.of(&run.log).is_none().then(|| MissingMoment { run: name.clone(), moment, seconds })
    }
}

impl Lesson {
    /// Checks that each run has the moments to which steps go.
    ///
    /// # Errors
    /// [`LessonError::Moment`] for the first step whose run does not have its moment.
    pub fn check_moments(&self, performed: &[(String, LessonRun)]) -> Result<(), LessonError> {
        let missing = (1..).zip(&self.steps).find_map(|(step, of)| Some((step, of.missing(performed)?)));
        missing.map_or(Ok(()), |(step, missing)| Err(LessonError::Moment { step, missing }))
    }

    /// The values of all claims, step by step; a value is `None` if its run never ends.
    pub fn values(&self, performed: &[(String, LessonRun)]) -> Vec<Vec<Option<f64>>> {
        let runs = claim_runs(performed);
        let of = |step: &Step| step.holds.iter().map(|claim| claim.check(&step.run, &runs).0).collect();
        self.steps.iter().map(of).collect()
    }

    /// Checks all moments and claims. Returns one English line for each claim, with its value, and for each missing
    /// moment, and whether it is true.
    pub fn check(&self, performed: &[(String, LessonRun)]) -> Vec<(String, bool)> {
        let runs = claim_runs(performed);
        let mut lines = Vec::new();
        for (number, step) in (1..).zip(&self.steps) {
            lines.extend(step.missing(performed).map(|missing| (format!("step {number}: {missing}"), false)));
            for claim in &step.holds {
                let (value, is_true) = claim.check(&step.run, &runs);
                let of = claim.of.as_deref().unwrap_or(&step.run);
                let over = claim.over.as_ref().map_or_else(String::new, |over| format!(" over `{over}`"));
                let value = value.map_or("nothing: a run never ends".to_owned(), |value| format!("{value:.4}"));
                let bound = |word: &str, bound: Option<f64>| {
                    bound.map_or_else(String::new, |bound| format!(", {word} {bound}"))
                };
                let (least, most) = (bound("at least", claim.at_least), bound("at most", claim.at_most));
                let line = format!("step {number}: {:?} of `{of}`{over} is {value}{least}{most}", claim.figure);
                lines.push((line, is_true));
            }
        }
        lines
    }
}
