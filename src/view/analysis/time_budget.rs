//! The time budget of a finished run: where the machines' time went, and which machine finished last.

use std::time::Duration;

use crate::balance::{Message, NodeId, Party, Scheduler};
use crate::picture::atoms_in;
use crate::record::{Record, RecordKind};
use crate::runlog::{MessageCounts, Metrics, RunLog};
use crate::time::Time;
use crate::view::state::lane::Lane;
use crate::view::state::lanes::Lanes;

/// Time budget of a finished run.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeBudget {
    /// Scheduler of the run.
    pub scheduler: Scheduler,
    /// From the first band sent, or from the beginning of the estimate that it needs, to the last atom placed.
    pub makespan: Duration,
    /// Makespan if the work had been shared perfectly ([`Metrics::ideal`]).
    pub ideal: Duration,
    /// Σ speeds of the machines that work, with the times from which each sum holds ([`Metrics::powers`]).
    pub powers: Vec<(Time, f64)>,
    /// Seconds of all machines, from time 0 to the last atom placed.
    pub spent: MachineSeconds,
    /// Numbers of messages.
    pub messages: MessageCounts,
    /// The machine that traced the last atom.
    pub last: LastMachine,
    /// Σ waiting times of all messages at the parent.
    pub waited_at_parent: Duration,
    /// Time from the beginning of the estimate to the first band sent.
    pub estimating: Duration,
}

/// The machine that traced the last atom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LastMachine {
    /// The machine.
    pub node: NodeId,
    /// Its speed at the end.
    pub speed: f64,
    /// Time from the last atom of the machine that finished last but one to its own last atom. A machine that traced
    /// nothing finished at 0.
    pub alone: Duration,
    /// Atoms that it traced.
    pub traced: u32,
    /// Atoms that it gave to others.
    pub gave: u32,
}

/// Machine seconds: a second of a run of eight machines has eight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MachineSeconds {
    /// In which the machine traced atoms and was not stopped.
    pub tracing: f64,
    /// Before its first atom.
    pub starting: f64,
    /// Between its first and its last atom, in which it traced nothing and was not stopped.
    pub asking: f64,
    /// Between its first and its last atom, in which it was paused, hung, off or at speed 0.
    pub stopped: f64,
    /// After its last atom, until the picture was complete; all seconds of a machine that traced nothing.
    pub waiting: f64,
}

impl MachineSeconds {
    /// Sum of the parts.
    pub fn sum(&self) -> f64 {
        self.parts().iter().sum()
    }

    /// Parts in the order of the fields.
    pub fn parts(&self) -> [f64; 5] {
        [self.tracing, self.starting, self.asking, self.stopped, self.waiting]
    }

    /// Divides the time of one machine until `end`.
    fn of(lane: &Lane, end: Time) -> Self {
        let (Some(first), Some(last)) = (lane.bars().first(), lane.bars().last()) else {
            return Self { waiting: end.secs(), ..Self::default() };
        };
        let (begun, done) = (first.from.min(end), last.to.min(end));
        let tracing: f64 = lane.bars().iter().map(|bar| lane.running_seconds(bar.from, bar.to)).sum();
        Self {
            tracing,
            starting: begun.secs(),
            asking: (lane.running_seconds(begun, done) - tracing).max(0.0),
            stopped: lane.stopped_seconds(begun, done),
            waiting: end.since(done).as_secs_f64(),
        }
    }
}

impl TimeBudget {
    /// Computes the budget of a run; `None` unless its picture was completed.
    pub fn of(log: &RunLog) -> Option<Self> {
        Self::new(log, &Lanes::of(log))
    }

    /// Computes the budget of a run whose lanes are known already.
    pub(crate) fn new(log: &RunLog, lanes: &Lanes) -> Option<Self> {
        let metrics = Metrics::of(log);
        let (makespan, ideal) = (metrics.makespan()?, metrics.ideal()?);
        let end = log.records().iter().rfind(|record| record.kind == RecordKind::Finished)?.at;
        let mut spent = MachineSeconds::default();
        for lane in lanes.lanes().iter().map(|lane| MachineSeconds::of(lane, end)) {
            spent.tracing += lane.tracing;
            spent.starting += lane.starting;
            spent.asking += lane.asking;
            spent.stopped += lane.stopped;
            spent.waiting += lane.waiting;
        }
        Some(Self {
            scheduler: log.header.scheduler(),
            makespan,
            ideal,
            powers: metrics.powers(),
            spent,
            messages: metrics.messages(),
            last: LastMachine::of(log, &metrics)?,
            waited_at_parent: waited_at_parent(log),
            estimating: estimating(log.records()),
        })
    }

    /// The machines' power on the average of the time from 0 to `until`: how many reference machines they are worth.
    pub fn power(&self, until: Time) -> f64 {
        let ends = self.powers.iter().skip(1).map(|(at, _)| *at).chain([until]);
        let spans = self.powers.iter().zip(ends).map(|((from, power), end)| {
            let span = end.min(until).since(*from);
            power * span.as_secs_f64()
        });
        spans.sum::<f64>() / until.secs().max(f64::MIN_POSITIVE)
    }

    /// Ideal makespan / makespan, at most about 1.
    pub fn efficiency(&self) -> f64 {
        self.ideal.as_secs_f64() / self.makespan.as_secs_f64().max(f64::MIN_POSITIVE)
    }
}

impl LastMachine {
    /// Finds the machine that traced the last atom.
    fn of(log: &RunLog, metrics: &Metrics) -> Option<Self> {
        let ends = metrics.last_atoms().into_iter().map(Option::unwrap_or_default);
        let mut ends: Vec<(Time, NodeId)> = ends.zip(0..).collect();
        ends.sort_unstable();
        let (end, node) = ends.pop()?;
        let before = ends.pop().map_or(Time::ZERO, |(end, _)| end);
        let mut speed = *log.header.speeds.get(usize::from(node))?;
        let mut gave = 0;
        for record in log.records() {
            match &record.kind {
                RecordKind::SpeedSet { node: set, speed: now } if *set == node => speed = *now,
                RecordKind::Sent { from, message: Message::Transfer(ranges), .. } if *from == Party::Node(node) => {
                    gave += atoms_in(ranges);
                }
                _ => {}
            }
        }
        let traced = metrics.atoms_by_node()[usize::from(node)];
        Some(Self { node, speed, alone: end.since(before), traced, gave })
    }
}

/// Adds up how long messages waited at the parent, which handles one after the other.
fn waited_at_parent(log: &RunLog) -> Duration {
    let mut arrivals: Vec<Time> = log
        .records()
        .iter()
        .filter_map(|record| match &record.kind {
            RecordKind::Sent { to: Party::Parent, arrives, .. } => Some(*arrives),
            _ => None,
        })
        .collect();
    arrivals.sort_unstable();
    let handling = log.header.handling;
    let (mut busy_until, mut waited) = (Time::ZERO, Duration::ZERO);
    for arrives in arrivals {
        waited += busy_until.since(arrives);
        busy_until = arrives.max(busy_until) + handling;
    }
    waited
}

/// Returns the time from the beginning of the estimate to the first band sent.
fn estimating(records: &[Record]) -> Duration {
    let at =
        |wanted: fn(&RecordKind) -> bool| records.iter().find(|record| wanted(&record.kind)).map(|record| record.at);
    let begun = at(|kind| matches!(kind, RecordKind::Estimating));
    let done = at(|kind| matches!(kind, RecordKind::Sent { message: Message::Band(_), .. }));
    begun.zip(done).map_or(Duration::ZERO, |(begun, done)| done.since(begun))
}

#[cfg(test)]
mod tests {
    use crate::language::Language;
    use proptest::prelude::*;

    use super::super::compare_runs::{NamedBudget, compare_runs};
    use super::*;
    use crate::balance::{Rules, Strategy};
    use crate::record::Record;
    use crate::runlog::Header;
    use crate::view::tests::sample_runs;

    fn log(strategy: Strategy, speeds: &[f64], handling: u64) -> RunLog {
        let plain = sample_runs::header(speeds, 1200);
        let rules = Rules {
            strategy: strategy.clone(),
            part: strategy.usual_part(plain.division, speeds.len()),
            ..plain.rules
        };
        let header = Header { rules, handling: Duration::from_millis(handling), ..plain };
        let mut log = RunLog::new(header.clone());
        log.add(sample_runs::records(&header));
        log
    }

    proptest! {
        #[test]
        fn parts_add_up_to_all_machine_seconds(
            speeds in prop::collection::vec(0.05..1.0f64, 1..6), strategy in 0..6usize, handling in 0..20u64,
        ) {
            let log = log(Strategy::ALL[strategy].clone(), &speeds, handling);
            let budget = TimeBudget::of(&log).expect("it came to its end");
            let end = log.records().iter().find(|record| record.kind == RecordKind::Finished).expect("its end").at.secs();
            let (spent, parts) = (budget.spent, budget.spent.parts());
            prop_assert!((spent.sum() - end * speeds.len() as f64).abs() < 1e-6, "{spent:?}");
            prop_assert!(parts.iter().all(|part| *part >= 0.0), "{spent:?}");
            prop_assert!(budget.efficiency() <= 1.0 + 1e-9 && budget.ideal <= budget.makespan);
        }
    }

    #[test]
    fn slow_machine_is_alone_at_the_end_of_static_bands() {
        let bands = TimeBudget::of(&log(Strategy::Static, &[1.0, 1.0, 1.0, 0.1], 0)).expect("it came to its end");
        let LastMachine { node, speed, alone, traced, gave } = bands.last;
        assert_eq!((node, speed, traced, gave), (3, 0.1, 300, 0));
        assert!(alone > bands.makespan / 2 && bands.spent.waiting > 0.5 * bands.spent.sum());
        let ring = TimeBudget::of(&log(Strategy::Ring, &[1.0, 1.0, 1.0, 0.1], 0)).expect("it came to its end");
        assert!(ring.spent.waiting < 0.1 * ring.spent.sum(), "{ring:?}");
        assert!(ring.makespan < bands.makespan / 2 && ring.messages.atoms_moved > 100);
    }

    #[test]
    fn paused_machine_counts_as_stopped_whatever_its_speed() {
        let plain = log(Strategy::Static, &[1.0, 1.0], 0);
        let mut records = plain.records().to_vec();
        let at = |second: f64| Time::from_secs(second);
        for (at, kind) in [
            (at(0.2), RecordKind::Paused { node: 1 }),
            (at(0.3), RecordKind::SpeedSet { node: 1, speed: 0.5 }),
            (at(0.4), RecordKind::Resumed { node: 1 }),
        ] {
            let place = records.partition_point(|record| record.at <= at);
            records.insert(place, Record { at, kind });
        }
        let mut paused = RunLog::new(plain.header.clone());
        paused.add(records);
        let budget = TimeBudget::of(&paused).expect("it came to its end");
        assert!((budget.spent.stopped - 0.2).abs() < 1e-9, "{:?}", budget.spent);
        assert!((budget.power(at(0.4)) - 1.5).abs() < 1e-9, "a paused machine is worth nothing");
    }

    #[test]
    fn messages_wait_at_a_busy_parent() {
        let waited =
            |handling| TimeBudget::of(&log(Strategy::Farm, &[1.0; 5], handling)).expect("its end").waited_at_parent;
        assert_eq!(waited(0), Duration::ZERO);
        assert!(waited(30) > 3 * waited(5), "{:?} {:?}", waited(30), waited(5));
    }

    #[test]
    fn slowed_machine_explains_a_longer_run() {
        let language = Language::English;
        let plain = log(Strategy::Ring, &[1.0, 1.0], 0);
        let quick = TimeBudget::of(&plain).expect("it came to its end");
        let mut records = plain.records().to_vec();
        let half = Time(records[records.len() - 1].at.0 / 2);
        let place = records.partition_point(|record| record.at <= half);
        records.insert(place, Record { at: half, kind: RecordKind::SpeedSet { node: 1, speed: 0.5 } });
        let mut slowed = RunLog::new(plain.header.clone());
        slowed.add(records);
        let slow = TimeBudget::of(&slowed).expect("it came to its end");
        assert_eq!(slow.power(half), 2.0);
        let whole = Time(2 * half.0);
        assert!((slow.power(whole) - 1.75).abs() < 1e-9, "{}", slow.power(whole));
        let slow = TimeBudget { makespan: quick.makespan.mul_f64(1.2), ..slow };
        let text = compare_runs(
            NamedBudget { name: "One", budget: &quick },
            NamedBudget { name: "The other", budget: &slow },
            language,
        );
        assert!(text.contains("Its machines together are slower: those of the other run are 1.1"), "{text}");
    }
}
