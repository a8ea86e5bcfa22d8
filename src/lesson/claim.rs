//! What a lesson claims of its runs, and whether it is true.

use serde::Deserialize;

use super::perform::LessonRun;
use super::{Lesson, Moment, Step};
use crate::picture::atoms_in;
use crate::record::RecordKind;
use crate::runlog::RunLog;
use crate::view::TimeBudget;

/// A figure of a run within bounds; or how many times that of another run it is.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Which figure.
    pub figure: ClaimFigure,
    /// Of which run; of the one that the step shows if `None`.
    #[serde(default)]
    pub of: Option<String>,
    /// Divided by that of this run.
    #[serde(default)]
    pub over: Option<String>,
    /// It is not less.
    #[serde(default)]
    pub at_least: Option<f64>,
    /// It is not more.
    #[serde(default)]
    pub at_most: Option<f64>,
}

/// A figure of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum ClaimFigure {
    /// From the first band sent to the last atom placed.
    Seconds,
    /// The ideal time over that, 0 to 1.
    Efficiency,
    /// What part of the machines' time they waited, being done, for others, 0 to 1.
    Waiting,
    /// What part they waited between atoms, 0 to 1.
    Asking,
    /// What part they waited for their first atom, 0 to 1.
    Starting,
    /// What part of the run's time only one machine traced at its end, 0 to 1.
    Alone,
    /// The number of the machine that traced the last atom, from 1.
    Last,
    /// Offers made.
    Offers,
    /// Offers passed on.
    Hops,
    /// Transfers from machine to machine.
    Transfers,
    /// The atoms in them.
    Moved,
    /// The atoms in the largest.
    Largest,
    /// Messages of every kind.
    Messages,
    /// How many atoms the picture has.
    Atoms,
    /// How many times as dear as the mean atom the dearest is.
    Dearest,
    /// 1 if the picture is completed, else 0.
    Ends,
}

impl ClaimFigure {
    /// Its value in a run of which this is the account; `None` where there is none, since its picture is never completed.
    fn of(self, log: &RunLog, account: Option<&TimeBudget>) -> Option<f64> {
        match self {
            Self::Ends => return Some(if account.is_some() { 1.0 } else { 0.0 }),
            Self::Atoms => return Some(log.header.division.atoms().into()),
            _ => {}
        }
        let account = account?;
        let share = |part: f64| part / account.spent.sum().max(f64::MIN_POSITIVE);
        Some(match self {
            Self::Seconds => account.makespan.as_secs_f64(),
            Self::Efficiency => account.efficiency(),
            Self::Waiting => share(account.spent.waiting),
            Self::Asking => share(account.spent.asking),
            Self::Starting => share(account.spent.starting),
            Self::Alone => account.last.alone.div_duration_f64(account.makespan),
            Self::Last => f64::from(account.last.node) + 1.0,
            Self::Offers => account.messages.offers as f64,
            Self::Hops => account.messages.hops as f64,
            Self::Transfers => account.messages.transfers as f64,
            Self::Moved => account.messages.atoms_moved as f64,
            Self::Messages => account.messages.total as f64,
            Self::Largest => largest(log),
            Self::Dearest => dearest(log),
            Self::Ends | Self::Atoms => return None,
        })
    }
}

fn largest(log: &RunLog) -> f64 {
    let Some((records, _)) = Moment::BiggestTransfer.of(log) else { return 0.0 };
    match &log.records()[records - 1].what {
        RecordKind::Sent { message, .. } => atoms_in(message.ranges()).into(),
        _ => 0.0,
    }
}

fn dearest(log: &RunLog) -> f64 {
    let costs: Vec<f64> = log.costs().into_iter().flatten().map(|cost| cost.as_secs_f64()).collect();
    let mean = costs.iter().sum::<f64>() / costs.len().max(1) as f64;
    costs.iter().copied().fold(0.0, f64::max) / mean.max(f64::MIN_POSITIVE)
}

/// A run of which something is claimed.
struct ClaimRun<'a> {
    name: &'a str,
    log: &'a RunLog,
    account: Option<TimeBudget>,
}

fn known(performed: &[(String, LessonRun)]) -> Vec<ClaimRun<'_>> {
    performed.iter().map(|(name, run)| ClaimRun { name, log: &run.log, account: TimeBudget::of(&run.log) }).collect()
}

impl Claim {
    /// The claim's value, and whether it holds; `run` is what the step shows.
    fn holds(&self, run: &str, runs: &[ClaimRun<'_>]) -> (Option<f64>, bool) {
        let value = |name: &str| {
            let run = runs.iter().find(|run| run.name == name)?;
            self.figure.of(run.log, run.account.as_ref())
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
    /// What is to be said if its run does not have the moment to which it leads.
    fn missing(&self, performed: &[(String, LessonRun)]) -> Option<String> {
        let (until, (name, run)) = (self.until?, performed.iter().find(|(name, _)| *name == self.run)?);
        let lasts = run.log.records().last().map_or(0.0, |record| record.at.secs());
        until.of(&run.log).is_none().then(|| format!("the run `{name}` has no {until:?}; it lasts {lasts:.1} s"))
    }
}

impl Lesson {
    /// Whether the runs have all moments to which steps lead.
    ///
    /// # Errors
    /// A sentence on the first that a run does not have.
    pub fn has_moments(&self, performed: &[(String, LessonRun)]) -> Result<(), String> {
        let missing = (1..).zip(&self.steps).find_map(|(number, step)| Some((number, step.missing(performed)?)));
        missing.map_or(Ok(()), |(number, why)| Err(format!("step {number}: {why}")))
    }

    /// What each step claims and what that comes to in these runs; `None` where a run never ends.
    pub fn values(&self, performed: &[(String, LessonRun)]) -> Vec<Vec<Option<f64>>> {
        let runs = known(performed);
        let of = |step: &Step| step.holds.iter().map(|claim| claim.holds(&step.run, &runs).0).collect();
        self.steps.iter().map(of).collect()
    }

    /// Every claim with its value, and whether it holds; and every moment that a run does not have.
    pub fn check(&self, performed: &[(String, LessonRun)]) -> Vec<(String, bool)> {
        let runs = known(performed);
        let mut told = Vec::new();
        for (number, step) in (1..).zip(&self.steps) {
            told.extend(step.missing(performed).map(|why| (format!("step {number}: {why}"), false)));
            for claim in &step.holds {
                let (value, holds) = claim.holds(&step.run, &runs);
                let of = claim.of.as_deref().unwrap_or(&step.run);
                let over = claim.over.as_ref().map_or_else(String::new, |over| format!(" over `{over}`"));
                let value = value.map_or("nothing: a run never ends".to_owned(), |value| format!("{value:.4}"));
                let bound = |word: &str, bound: Option<f64>| {
                    bound.map_or_else(String::new, |bound| format!(", {word} {bound}"))
                };
                let (least, most) = (bound("at least", claim.at_least), bound("at most", claim.at_most));
                told.push((
                    format!("step {number}: {:?} of `{of}`{over} is {value}{least}{most}", claim.figure),
                    holds,
                ));
            }
        }
        told
    }
}
