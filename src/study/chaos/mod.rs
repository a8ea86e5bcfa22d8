//! Many random runs of the adaptive ring and of the farm with leases, with failing machines and links. Every run must
//! end with the whole picture.

mod bugs;
mod check;
mod plan;

use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

use serde_json::json;

use super::markdown::Report;
use super::{ProgressSink, Study, StudyError};
use crate::balance::{Condition, Strategy};
use crate::runlog::{Header, RunLog};
use crate::scenario::Command;
use crate::scene::Opened;
use crate::sim::Sim;
use bugs::Bug;
use check::{RunTotals, Violation};
use plan::ChaosPlan;

/// The strategies that survive failures; each seed is a run of each.
const STRATEGIES: [Strategy; 2] = [Strategy::Adaptive, Strategy::FarmLeases];
/// Number of failing runs that are kept.
const MAX_KEPT_RUNS: usize = 5;
/// Seeds tried for each injected bug.
const SEEDS_PER_BUG: u64 = 10_000;
/// Seeds per progress step.
const SEEDS_PER_STEP: u64 = 250;

/// Runs every seed and reports the seeds that fail. Keeps the runs of the first failing seeds, or of a single seed, as
/// run files with the picture of `scene`.
///
/// # Errors
/// [`StudyError::File`], if a run file cannot be made.
pub fn chaos(seeds: Range<u64>, scene: &Opened, tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let mut totals = [ChaosTotals::default(), ChaosTotals::default()];
    let mut failures: Vec<FailedRun> = Vec::new();
    let count = seeds.end.saturating_sub(seeds.start);
    for seed in seeds.clone() {
        if (seed - seeds.start).is_multiple_of(SEEDS_PER_STEP) {
            let found = if failures.is_empty() { String::new() } else { format!(", {} have failed", failures.len()) };
            tell((seed - seeds.start) as usize, count as usize, &format!("seed {seed}{found}"));
        }
        for (strategy, totals) in STRATEGIES.into_iter().zip(&mut totals) {
            let plan = ChaosPlan::new(seed, strategy.clone());
            match try_run(&plan, None) {
                Ok(run) => totals.add(&plan, run),
                Err(why) => failures.push(FailedRun { seed, strategy, why }),
            }
        }
    }
    let bugs: Vec<_> =
        if count > 1 { Bug::ALL.map(|bug| (bug, find_bug(bug, seeds.start))).into() } else { Vec::new() };
    let mut study = Study::new("chaos");
    let kept: Vec<(u64, Strategy)> = if count == 1 {
        STRATEGIES.map(|strategy| (seeds.start, strategy)).into()
    } else {
        failures.iter().map(|failed| (failed.seed, failed.strategy.clone())).take(MAX_KEPT_RUNS).collect()
    };
    for (seed, strategy) in kept {
        let of = if strategy == Strategy::Adaptive { String::new() } else { format!("-{strategy}") };
        let (file, mut bytes) = (format!("chaos-{seed}{of}.anel"), Vec::new());
        let log = record_run(&ChaosPlan::new(seed, strategy), scene);
        log.write(&mut bytes).map_err(|error| StudyError::file(&*file, error))?;
        study.files.push((file, bytes));
    }
    let mut failing: Vec<u64> = failures.iter().map(|failed| failed.seed).collect();
    failing.dedup();
    study.summary = [("seeds", json!(count)), ("failures", json!(failing.len())), ("failing_seeds", json!(failing))]
        .map(|(name, value)| (name.to_owned(), value))
        .into_iter()
        .collect();
    study.add_report(report(&seeds, &totals, &failures, &bugs));
    Ok(study)
}

/// Runs a seed, with an injected bug if there is one. A panic of a party counts as a violation.
fn try_run(plan: &ChaosPlan, bug: Option<Bug>) -> Result<RunTotals, Violation> {
    let run = || check::run(plan, bug.map(Bug::tamper));
    catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|panic| {
        let said = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
        Err(Violation::Panic(said.unwrap_or_default().into()))
    })
}

/// Finds the first seed from `first` on with which a bug is detected, and the violation that reveals it.
fn find_bug(bug: Bug, first: u64) -> Option<(u64, Violation)> {
    (first..first + SEEDS_PER_BUG)
        .find_map(|seed| try_run(&ChaosPlan::new(seed, bug.strategy()), Some(bug)).err().map(|why| (seed, why)))
}

/// Returns all records of a plan's run; of a run that does not end, the first million.
fn record_run(plan: &ChaosPlan, scene: &Opened) -> RunLog {
    const MAX_RECORDS: usize = 1_000_000;
    let costs = plan.costs.clone();
    let mut sim = Sim::new(&plan.header, &plan.script, move |atom| costs[atom as usize]);
    let mut records = Vec::new();
    while let Some(next) = sim.next().filter(|_| records.len() < MAX_RECORDS) {
        sim.advance(next, &mut |record| records.push(record));
    }
    let header = Header { scene: scene.name.clone(), scene_text: scene.text.clone(), ..plan.header.clone() };
    let mut log = RunLog::new(header);
    log.add(records);
    log
}

/// A run that violates a check.
struct FailedRun {
    seed: u64,
    strategy: Strategy,
    why: Violation,
}

/// Totals over the runs of a strategy that passed.
#[derive(Default)]
struct ChaosTotals {
    runs: u64,
    faultless: u64,
    records: u64,
    again: u64,
    share_of_bound: f64,
    /// Commands in all scripts: machines off, hung and cut off; links cut; messages delayed; speeds and latencies
    /// changed.
    commands: [u64; 7],
}

impl ChaosTotals {
    fn add(&mut self, plan: &ChaosPlan, run: RunTotals) {
        self.runs += 1;
        self.faultless += u64::from(plan.faultless);
        self.records += run.records;
        self.again += run.again;
        self.share_of_bound = self.share_of_bound.max(run.share_of_bound);
        for (_, command) in &plan.script {
            let kind = match command {
                Command::Condition { condition: Condition::Off, .. } => 0,
                Command::Condition { condition: Condition::Hung, .. } => 1,
                Command::Condition { condition: Condition::CutOff, .. } => 2,
                Command::Link { cut: true, .. } => 3,
                Command::Delay { .. } => 4,
                Command::Speed { .. } => 5,
                Command::Latency(_) => 6,
                _ => continue,
            };
            self.commands[kind] += 1;
        }
    }
}

fn report(
    seeds: &Range<u64>,
    totals: &[ChaosTotals; 2],
    failures: &[FailedRun],
    bugs: &[(Bug, Option<(u64, Violation)>)],
) -> Report {
    let mut report = Report::titled("The adaptive ring and the farm with leases under random failures");
    report.line(format!(
        "Seeds {} to {}: random runs in virtual time, of each of the two strategies, with 1 to 24 machines (some of them spares that join later), 1 \
         to 400 atoms whose costs vary by a factor of 100, speeds from 0.001 to 1 and latencies from 0 to 200 ms. \
         Some runs have a slow shared wire and a slow parent. In seven of eight runs, machines change their speed, \
         stand still, hang, are cut off, are switched off and restart, join, or are lost for good; links are cut and \
         repaired; and messages are delayed by up to 10 s. In the end at least one machine works. Every run must \
         satisfy these conditions: it ends; the picture is whole, and each atom was traced by the node that sent it; \
         no offer is in two places; no atom is handed out again where \
         nothing was lost; and the number of messages stays within the bound of the strategy's README.\n",
        seeds.start,
        seeds.end.saturating_sub(1)
    ));
    for (strategy, totals) in STRATEGIES.iter().zip(totals) {
        let failed = failures.iter().filter(|failed| failed.strategy == *strategy).count();
        report_strategy(&mut report, strategy, totals, failed);
    }
    for FailedRun { seed, strategy, why } in failures {
        report.line(format!(
            "- seed {seed}, {strategy}: {why} (`anel study chaos --seed {seed}` runs it again and keeps its run)"
        ));
    }
    if !bugs.is_empty() {
        report.line("\n## Injected bugs\n");
        for (bug, found) in bugs {
            match found {
                Some((seed, why)) => report.line(format!("- {}: found with seed {seed}: {why}", bug.name())),
                None => report.line(format!("- {}: NOT FOUND in {SEEDS_PER_BUG} seeds", bug.name())),
            }
        }
    }
    report
}

/// Reports the totals of a strategy.
fn report_strategy(report: &mut Report, strategy: &Strategy, totals: &ChaosTotals, failed: usize) {
    let [off, hung, cut_off, links, delays, speeds, latencies] = totals.commands;
    report.line(format!("\n## {strategy}\n"));
    report.line(format!(
        "- runs that passed: {}, of which {} had no failures and no changes",
        totals.runs, totals.faultless
    ));
    report.line(format!("- runs that failed: {failed}"));
    report.line(format!(
        "- injected: {off} machines switched off, {hung} hung, {cut_off} cut off, {links} links cut, {delays} delays, \
         {speeds} changes of speed, {latencies} changes of latency"
    ));
    report.line(format!("- records: {}; atoms handed out again by the parent: {}", totals.records, totals.again));
    report.line(format!("- most messages / bound: {:.2}\n", totals.share_of_bound));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adaptive_ring_and_farm_with_leases_survive_random_failures() {
        for (seed, strategy) in (0..3_000).flat_map(|seed| STRATEGIES.map(|strategy| (seed, strategy))) {
            if let Err(why) = try_run(&ChaosPlan::new(seed, strategy.clone()), None) {
                panic!("seed {seed}, {strategy}: {why}");
            }
        }
    }

    #[test]
    fn injected_bugs_are_found() {
        for bug in Bug::ALL {
            assert!(find_bug(bug, 0).is_some(), "{bug:?}");
        }
    }

    #[test]
    fn seed_determines_run() {
        let scene = Opened::new("csg-primer").expect("a built-in scene");
        let plan = || ChaosPlan::new(77, Strategy::Adaptive);
        assert_eq!(record_run(&plan(), &scene), record_run(&plan(), &scene));
        let study = chaos(77..78, &scene, &mut |_, _, _| {}).expect("a study");
        assert!(study.files.iter().any(|(name, _)| name == "chaos-77.anel"));
        assert_eq!(study.summary["failures"], 0);
    }
}
