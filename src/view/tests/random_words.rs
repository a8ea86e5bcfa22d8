//! Texts of random runs, in both languages, without the faults that [`super::faults`] knows.

use std::time::Duration;

use proptest::prelude::*;

use super::portuguese::{Room, Said, compare, sentences_after_it, sentences_while_it_runs};
use super::sample_runs;
use crate::balance::{Condition, NodeId, Rules, Scheduler, Strategy as Sharing};
use crate::language::Language;
use crate::runlog::{Driver, Header, RunLog};
use crate::scenario::Command;
use crate::sim::Sim;
use crate::time::Time;
use crate::view::analysis::compare_runs::{NamedBudget, compare_runs};
use crate::view::analysis::time_budget::TimeBudget;

/// A run by a scheduler, with these commands.
fn run(scheduler: &Scheduler, speeds: &[f64], handling: u64, script: &[(Time, Command)]) -> RunLog {
    let plain = sample_runs::header(speeds, 240);
    let (strategy, driver) = match scheduler {
        Scheduler::Protocol(strategy) => (strategy.clone(), Driver::Sim),
        Scheduler::WorkStealing => (Sharing::Ring, Driver::WorkStealing),
    };
    let (part, handling) = (strategy.usual_part(plain.division, speeds.len()), Duration::from_millis(handling));
    let rules = Rules { strategy, part, beat: Rules::beat_for(handling, speeds.len()), ..plain.rules };
    let header = Header { rules, driver, handling, ..plain };
    let mut records = Vec::new();
    let cost = |atom| sample_runs::COST + Duration::from_micros(u64::from(atom % 9) * 90);
    Sim::new(&header, script, cost).run(&mut |record| records.push(record));
    let mut log = RunLog::new(header);
    log.add(records);
    log
}

/// A command of a user, or a failure.
fn command(nodes: NodeId) -> impl Strategy<Value = Command> {
    let node = 0..nodes;
    prop_oneof![
        (node.clone(), prop_oneof![Just(0.0), 0.01..1.0f64, Just(1.0)])
            .prop_map(|(node, speed)| Command::Speed { node, speed }),
        (node.clone(), any::<bool>()).prop_map(|(node, paused)| Command::Pause { node, paused }),
        (
            node,
            prop_oneof![Just(Condition::Well), Just(Condition::Off), Just(Condition::Hung), Just(Condition::CutOff)]
        )
            .prop_map(|(node, condition)| Command::Condition { node, condition }),
        (0..90u64).prop_map(|ms| Command::Latency(Duration::from_millis(ms))),
    ]
}

/// A scheduler, speeds, the parent's time for a message, and commands in the order of their times.
fn inputs() -> impl Strategy<Value = (usize, Vec<f64>, u64, Vec<(Time, Command)>)> {
    (1..10usize).prop_flat_map(|nodes| {
        let scripted =
            (0..8_000u64, command(nodes as NodeId)).prop_map(|(ms, command)| (Time(ms * 1_000_000), command));
        let script = prop::collection::vec(scripted, 0..7).prop_map(|mut script| {
            script.sort_by_key(|(at, _)| *at);
            script
        });
        let speeds = prop::collection::vec(prop_oneof![0.02..1.0f64, Just(1.0), Just(0.0)], nodes);
        (0..Scheduler::ALL.len(), speeds, prop_oneof![Just(0), 0..40u64], script)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn texts_of_random_runs_have_no_faults((scheduler, speeds, handling, script) in inputs()) {
        let scheduler = &Scheduler::ALL[scheduler];
        let log = run(scheduler, &speeds, handling, &script);
        compare(|language| {
            let mut said = sentences_while_it_runs(&log, language);
            said.extend(sentences_after_it(&log, language));
            // Long sentences are the business of other tests.
            let mut said: Said = said.into_iter().map(|(_, words)| (Room::Some, words)).collect();
            said.extend(comparison(scheduler, &log, &speeds, language).map(|words| (Room::Some, words)));
            said
        });
    }
}

/// Explains how a run differs from equal bands at the same speeds.
fn comparison(scheduler: &Scheduler, log: &RunLog, speeds: &[f64], language: Language) -> Option<String> {
    let bands = Scheduler::Protocol(Sharing::Static);
    let plain = run(&bands, speeds, 0, &[]);
    let (one, other) = (TimeBudget::of(log)?, TimeBudget::of(&plain)?);
    let names = [scheduler, &bands].map(|scheduler| scheduler.title(language));
    let named = |index: usize, budget| NamedBudget { name: names[index], budget };
    Some(compare_runs(named(0, &one), named(1, &other), language))
}
