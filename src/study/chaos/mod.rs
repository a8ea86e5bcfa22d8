//! Many random runs of the ring that adapts, with everything that can befall machines and links: each has to end with the
//! whole picture, whatever happens.

mod bugs;
mod check;
mod plan;

use std::ops::Range;
use std::panic::{AssertUnwindSafe, catch_unwind};

use serde_json::json;

use super::markdown::Report;
use super::{ProgressSink, Study, StudyError};
use crate::balance::Condition;
use crate::runlog::{Header, RunLog};
use crate::scenario::Command;
use crate::scene::Opened;
use crate::sim::Sim;
use bugs::Bug;
use check::{RunTotals, Violation};
use plan::ChaosPlan;

/// Of so many failing seeds the runs are kept.
const KEPT: usize = 5;
/// Seeds that are tried for each bug that is put in.
const TRIED: u64 = 10_000;
/// How many seeds are a step.
const STEP: u64 = 250;

/// Tries these seeds, and says which fail. Of those, and of a seed that is tried alone, the run is kept as a file that the
/// window shows, with `scene` as its picture.
///
/// # Errors
/// A sentence, if a file could not be made.
pub fn chaos(seeds: Range<u64>, scene: &Opened, tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let mut seen = Seen::default();
    let mut failures: Vec<(u64, Violation)> = Vec::new();
    let count = seeds.end.saturating_sub(seeds.start);
    for seed in seeds.clone() {
        if (seed - seeds.start).is_multiple_of(STEP) {
            let found = if failures.is_empty() { String::new() } else { format!(", {} have failed", failures.len()) };
            tell((seed - seeds.start) as usize, count as usize, &format!("seed {seed}{found}"));
        }
        let plan = ChaosPlan::new(seed);
        match try_run(&plan, None) {
            Ok(outcome) => seen.add(&plan, outcome),
            Err(why) => failures.push((seed, why)),
        }
    }
    let bugs: Vec<_> = if count > 1 { Bug::ALL.map(|bug| (bug, find(bug, seeds.start))).into() } else { Vec::new() };
    let mut study = Study::new("chaos");
    let kept: Vec<u64> =
        if count == 1 { seeds.clone().collect() } else { failures.iter().map(|(seed, _)| *seed).take(KEPT).collect() };
    for seed in kept {
        let (file, mut bytes) = (format!("chaos-{seed}.anel"), Vec::new());
        record(&ChaosPlan::new(seed), scene).write(&mut bytes).map_err(|error| StudyError::file(&*file, error))?;
        study.files.push((file, bytes));
    }
    let failing: Vec<u64> = failures.iter().map(|(seed, _)| *seed).collect();
    study.summary = [("seeds", json!(count)), ("failures", json!(failing.len())), ("failing_seeds", json!(failing))]
        .map(|(name, value)| (name.to_owned(), value))
        .into_iter()
        .collect();
    study.add_report(report(&seeds, &seen, &failures, &bugs));
    Ok(study)
}

/// One run of a seed, with a bug if there is to be one. A party that finds the impossible panics; that is a failure too.
fn try_run(plan: &ChaosPlan, bug: Option<Bug>) -> Result<RunTotals, Violation> {
    let run = || check::run(plan, bug.map(Bug::tamper));
    catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|panic| {
        let said = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
        Err(Violation::Panic(said.unwrap_or_default().into()))
    })
}

/// The first seed from `first` on with which a bug is found, and what is said of it.
fn find(bug: Bug, first: u64) -> Option<(u64, Violation)> {
    (first..first + TRIED).find_map(|seed| try_run(&ChaosPlan::new(seed), Some(bug)).err().map(|why| (seed, why)))
}

/// All records of a plan's run, as far as a run that does not end has any that are of use.
fn record(plan: &ChaosPlan, scene: &Opened) -> RunLog {
    const MOST: usize = 1_000_000;
    let costs = plan.costs.clone();
    let mut sim = Sim::new(&plan.header, &plan.script, move |atom| costs[atom as usize]);
    let mut records = Vec::new();
    while let Some(next) = sim.next().filter(|_| records.len() < MOST) {
        sim.advance(next, &mut |record| records.push(record));
    }
    let header = Header { scene: scene.name.clone(), scene_text: scene.text.clone(), ..plan.header.clone() };
    let mut log = RunLog::new(header);
    log.add(records);
    log
}

/// What the runs amounted to that did not fail.
#[derive(Default)]
struct Seen {
    runs: u64,
    calm: u64,
    records: u64,
    again: u64,
    of_bound: f64,
    /// Of all scripts: switched off, hung, cut off, links cut, ways held up, speeds, latencies.
    befell: [u64; 7],
}

impl Seen {
    fn add(&mut self, plan: &ChaosPlan, outcome: RunTotals) {
        self.runs += 1;
        self.calm += u64::from(plan.calm);
        self.records += outcome.records;
        self.again += outcome.again;
        self.of_bound = self.of_bound.max(outcome.of_bound);
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
            self.befell[kind] += 1;
        }
    }
}

fn report(
    seeds: &Range<u64>,
    seen: &Seen,
    failures: &[(u64, Violation)],
    bugs: &[(Bug, Option<(u64, Violation)>)],
) -> Report {
    let mut report = Report::titled("Whatever befalls the ring that adapts");
    report.line(format!(
        "Seeds {} to {}: random runs in virtual time, of 1 to 24 machines (some of them spares that join later), 1 to \
         400 atoms whose cost varies a hundredfold, speeds of 0.001 to 1, latencies of 0 to 200 ms, in some a slow \
         shared wire and a slow parent. In seven of eight runs machines change their speed, stand still, hang, are \
         cut off, are switched off and begin anew, join, or are lost for good, links are cut and mended, and what is \
         on a way is held up for up to 10 s; at last one machine is well. Each run has to end; the picture has to be \
         whole, each atom of it traced by who sent it; no node may begin an atom after its shutdown; no offer may be \
         in two places; nothing may be given out again where nothing was lost; and there may be no more messages than \
         the ring's README says.\n",
        seeds.start,
        seeds.end.saturating_sub(1)
    ));
    let [off, hung, cut_off, links, delays, speeds, latencies] = seen.befell;
    report.line(format!("- runs that held: {}, of which nothing befell {}", seen.runs, seen.calm));
    report.line(format!("- runs that failed: {}", failures.len()));
    report.line(format!(
        "- what befell them: {off} machines switched off, {hung} hung, {cut_off} cut off, {links} links cut, {delays} \
         ways held up, {speeds} changed speeds, {latencies} changed latencies"
    ));
    report.line(format!("- records: {}; atoms given out again by the parent: {}", seen.records, seen.again));
    report.line(format!("- most messages, over the bound: {:.2}\n", seen.of_bound));
    for (seed, why) in failures {
        report
            .line(format!("- seed {seed}: {why} (`anel study chaos --seed {seed}` tries it again and keeps its run)"));
    }
    if !bugs.is_empty() {
        report.line("\n## Bugs that were put in on purpose\n");
        for (bug, found) in bugs {
            match found {
                Some((seed, why)) => report.line(format!("- {}: found with seed {seed}: {why}", bug.name())),
                None => report.line(format!("- {}: NOT FOUND in {TRIED} seeds", bug.name())),
            }
        }
    }
    report
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ring_survives_whatever_befalls_it() {
        for seed in 0..3_000 {
            if let Err(why) = try_run(&ChaosPlan::new(seed), None) {
                panic!("seed {seed}: {why}");
            }
        }
    }

    #[test]
    fn bugs_that_are_put_in_are_found() {
        for bug in Bug::ALL {
            assert!(find(bug, 0).is_some(), "{bug:?}");
        }
    }

    #[test]
    fn a_seed_is_the_same_run_whenever_it_is_tried() {
        let scene = Opened::new("csg-primer").expect("a scene that is built in");
        assert_eq!(record(&ChaosPlan::new(77), &scene), record(&ChaosPlan::new(77), &scene));
        let study = chaos(77..78, &scene, &mut |_, _, _| {}).expect("a study");
        assert!(study.files.iter().any(|(name, _)| name == "chaos-77.anel"));
        assert_eq!(study.summary["failures"], 0);
    }
}
