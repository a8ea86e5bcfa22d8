//! Metrics of a run, computed from its records in the order of time, as they come or from a log.

use std::time::Duration;

use super::{Header, MessageCounts, RunLog};
use crate::balance::{Condition, Message, NodeId};
use crate::record::{Record, RecordKind};
use crate::time::Time;

/// Metrics of a run.
#[derive(Clone, Debug)]
pub struct Metrics {
    speeds: Vec<f64>,
    pace: f64,
    cores: usize,
    /// When the parent sent the first band, or began the estimate before it.
    start: Option<Time>,
    finished: Option<Time>,
    work: Duration,
    /// By atom: whether it was traced.
    traced: Vec<bool>,
    /// Cost of atoms that were traced before.
    twice: Duration,
    /// By node: the number of atoms that it has traced, and the time of the last.
    nodes: Vec<(u32, Time)>,
    /// Changes of the machines' capacity, in the order of time.
    changes: Vec<(Time, NodeId, CapacityChange)>,
    messages: MessageCounts,
}

#[derive(Clone, Copy, Debug)]
enum CapacityChange {
    Speed(f64),
    Paused(bool),
    Condition(Condition),
}

impl Metrics {
    /// Creates the metrics of a run without records.
    pub fn new(header: &Header) -> Self {
        Self {
            speeds: header.speeds.clone(),
            pace: header.pace,
            cores: header.cores,
            start: None,
            finished: None,
            work: Duration::ZERO,
            traced: vec![false; header.division.atoms() as usize],
            twice: Duration::ZERO,
            nodes: vec![(0, Time::ZERO); header.speeds.len()],
            changes: (0..header.speeds.len() as NodeId)
                .filter(|&node| header.is_spare(node))
                .map(|node| (Time::ZERO, node, CapacityChange::Condition(Condition::Off)))
                .collect(),
            messages: MessageCounts::default(),
        }
    }

    /// Computes the metrics of a log.
    pub fn of(log: &RunLog) -> Self {
        let mut metrics = Self::new(&log.header);
        log.records().iter().for_each(|record| metrics.add(record));
        metrics
    }

    /// Takes in the next record.
    pub fn add(&mut self, record: &Record) {
        let at = record.at;
        match &record.kind {
            RecordKind::Sent { from, message, bytes, .. } => {
                if matches!(message, Message::Band(_)) {
                    self.start.get_or_insert(at);
                }
                self.messages.add(*from, message, *bytes);
            }
            RecordKind::Estimating => _ = self.start.get_or_insert(at),
            RecordKind::AtomDone { node, atom, cost } => {
                match self.traced.get_mut(*atom as usize) {
                    Some(traced) if !*traced => (*traced, self.work) = (true, self.work + *cost),
                    _ => self.twice += *cost,
                }
                if let Some((atoms, end)) = self.nodes.get_mut(usize::from(*node)) {
                    (*atoms, *end) = (*atoms + 1, at);
                }
            }
            RecordKind::SpeedSet { node, speed } => self.changes.push((at, *node, CapacityChange::Speed(*speed))),
            RecordKind::Paused { node } => self.changes.push((at, *node, CapacityChange::Paused(true))),
            RecordKind::Resumed { node } => self.changes.push((at, *node, CapacityChange::Paused(false))),
            RecordKind::Condition { node, condition } => {
                self.changes.push((at, *node, CapacityChange::Condition(*condition)))
            }
            RecordKind::Finished => self.finished = Some(at),
            RecordKind::Received { .. }
            | RecordKind::Estimated { .. }
            | RecordKind::AtomStarted { .. }
            | RecordKind::LatencySet { .. }
            | RecordKind::OwnLatencySet { .. }
            | RecordKind::Link { .. }
            | RecordKind::Delayed { .. }
            | RecordKind::Lost { .. }
            | RecordKind::AtomFailed { .. }
            | RecordKind::GivenUp { .. }
            | RecordKind::Retired { .. } => {}
        }
    }

    /// From the first band sent, or the beginning of an estimate that it needs, to the last atom placed; `None` while
    /// the picture is incomplete.
    pub fn makespan(&self) -> Option<Duration> {
        Some(self.finished?.since(self.start?))
    }

    /// Returns the sum of the atoms' costs, each counted once, in CPU time of this computer.
    pub fn work(&self) -> Duration {
        self.work
    }

    /// Returns the cost of atoms that were traced once more; only the adaptive ring and losses cause any.
    pub fn twice(&self) -> Duration {
        self.twice
    }

    /// How long the work would have taken, had it been shared perfectly: the least T for which the emulated machines,
    /// never more than the computer's cores, do all the work in T: ∫ min(Σ speed × pace, cores) dt = [`Metrics::work`].
    /// Speeds that change count from then on, and a machine that is paused or not well does nothing: what one that is
    /// cut off has done reaches nobody. `None` if the machines stand still before the work is done.
    pub fn ideal(&self) -> Option<Duration> {
        let start = self.start?;
        let powers = self.powers();
        let mut left = self.work.as_secs_f64();
        let mut since = start;
        let mut last = 0;
        for (i, &(at, _)) in powers.iter().enumerate().skip(1) {
            let (span, rate) = (at.since(since).as_secs_f64(), self.rate(powers[i - 1].1));
            if left <= span * rate {
                break;
            }
            left -= span * rate;
            (since, last) = (since.max(at), i);
        }
        let rest = Duration::try_from_secs_f64(left / self.rate(powers[last].1)).ok()?;
        since.since(start).checked_add(rest)
    }

    /// Σ speeds of the machines that work, with the times from which each sum holds, the first from time 0: how many
    /// reference machines they are worth. A machine that is paused, or not well, counts 0.
    pub fn powers(&self) -> Vec<(Time, f64)> {
        let machine = |&speed| MachineCapacity { speed, paused: false, condition: Condition::Well };
        let mut machines: Vec<_> = self.speeds.iter().map(machine).collect();
        let mut powers = vec![(Time::ZERO, power(&machines))];
        for &(at, node, change) in &self.changes {
            if let Some(machine) = machines.get_mut(usize::from(node)) {
                match change {
                    CapacityChange::Speed(speed) => machine.speed = speed,
                    CapacityChange::Paused(paused) => machine.paused = paused,
                    CapacityChange::Condition(condition) => machine.condition = condition,
                }
            }
            powers.push((at, power(&machines)));
        }
        powers
    }

    /// Returns [`Metrics::ideal`] / [`Metrics::makespan`]: 1 is perfect; `None` while either is unknown.
    pub fn efficiency(&self) -> Option<f64> {
        let (ideal, makespan) = (self.ideal()?, self.makespan()?);
        (!makespan.is_zero()).then(|| ideal.div_duration_f64(makespan))
    }

    /// From the moment at which the first node is done with its last atom to that at which the last is; nodes that
    /// traced nothing do not count.
    pub fn finish_spread(&self) -> Duration {
        let ends: Vec<Time> = self.last_atoms().into_iter().flatten().collect();
        ends.iter().max().zip(ends.iter().min()).map_or(Duration::ZERO, |(last, first)| last.since(*first))
    }

    /// By node: when it was done with its last atom; `None` if it traced nothing.
    pub fn last_atoms(&self) -> Vec<Option<Time>> {
        self.nodes.iter().map(|(atoms, end)| (*atoms > 0).then_some(*end)).collect()
    }

    /// The share of the machines' time that lies after their last atoms, a slow machine's time counting less; of a node
    /// that traced nothing, all of its time. `None` while the picture is incomplete.
    pub fn tail_idle(&self) -> Option<f64> {
        let (start, finished) = (self.start?, self.finished?);
        let idle = |(speed, (atoms, end)): (&f64, &(u32, Time))| {
            speed * finished.since(if *atoms > 0 { *end } else { start }).as_secs_f64()
        };
        let idle: f64 = self.speeds.iter().zip(&self.nodes).map(idle).sum();
        let all = self.speeds.iter().sum::<f64>() * finished.since(start).as_secs_f64();
        (all > 0.0).then(|| idle / all)
    }

    /// Returns the number of atoms traced, by node.
    pub fn atoms_by_node(&self) -> Vec<u32> {
        self.nodes.iter().map(|(atoms, _)| *atoms).collect()
    }

    /// Returns the counts of messages.
    pub fn messages(&self) -> MessageCounts {
        self.messages
    }

    /// CPU seconds of this computer that machines of this power do in a second.
    fn rate(&self, power: f64) -> f64 {
        (power * self.pace).min(self.cores as f64)
    }
}

/// Σ speeds of the machines that work.
fn power(machines: &[MachineCapacity]) -> f64 {
    machines.iter().filter(|machine| machine.works()).map(|machine| machine.speed).sum()
}

struct MachineCapacity {
    speed: f64,
    paused: bool,
    condition: Condition,
}

impl MachineCapacity {
    fn works(&self) -> bool {
        !self.paused && self.condition == Condition::Well
    }
}

#[cfg(test)]
mod tests {
    use super::super::examples::{at, done, header, sent};
    use super::*;
    use crate::balance::Party;

    fn metrics_of(header: &Header, records: &[Record]) -> Metrics {
        let mut metrics = Metrics::new(header);
        records.iter().for_each(|record| metrics.add(record));
        metrics
    }

    fn ideal(header: &Header, records: &[Record]) -> Option<Duration> {
        metrics_of(header, records).ideal()
    }

    const PARENT: Party = Party::Parent;

    fn node(node: u16) -> Party {
        Party::Node(node)
    }

    /// Two nodes, 20 CPU seconds, from second 1 to second 13.
    fn run() -> Vec<Record> {
        vec![
            sent(1, PARENT, node(0), Message::Band(0..10)),
            sent(1, PARENT, node(1), Message::Band(10..20)),
            done(6, 0, 0, 5),
            sent(6, node(0), node(1), Message::offer(0, 1)),
            sent(7, node(1), node(0), Message::Transfer(vec![15..17, 18..20])),
            done(9, 1, 10, 7),
            sent(9, node(1), node(0), Message::offer(1, 1)),
            sent(10, node(0), node(1), Message::offer(1, 1)),
            done(12, 0, 15, 8),
            sent(12, node(0), PARENT, Message::Results(vec![0..1, 15..16])),
            at(13, RecordKind::Finished),
            sent(13, PARENT, node(0), Message::Shutdown),
        ]
    }

    fn secs(secs: u64) -> Option<Duration> {
        Some(Duration::from_secs(secs))
    }

    #[test]
    fn work_makespan_and_idle_time() {
        let run = run();
        let header = header(&[1.0; 3]);
        let whole = metrics_of(&header, &run);
        assert_eq!((whole.makespan(), whole.work()), (secs(12), Duration::from_secs(20)));
        assert_eq!(metrics_of(&header, &run[..10]).makespan(), None, "before the end");
        assert_eq!(whole.finish_spread(), Duration::from_secs(3));
        assert_eq!(metrics_of(&header, &[]).finish_spread(), Duration::ZERO);
        assert_eq!(whole.atoms_by_node(), [2, 1, 0]);
        // 1 s, 4 s, and all 12 s of the one that traced nothing.
        assert_eq!(whole.tail_idle(), Some(17.0 / 36.0));
    }

    #[test]
    fn ideal_is_bounded_by_machines_and_by_cores() {
        let run = run();
        assert_eq!(ideal(&header(&[1.0, 1.0]), &run), secs(10));
        assert_eq!(ideal(&header(&[0.25, 0.25]), &run), secs(40));
        assert_eq!(ideal(&header(&[1.0; 8]), &run), secs(10), "eight machines on two cores");
        assert_eq!(ideal(&Header { pace: 0.1, ..header(&[1.0, 1.0]) }, &run), secs(100));
        assert_eq!(metrics_of(&header(&[1.0, 1.0]), &run).efficiency(), Some(10.0 / 12.0));
    }

    #[test]
    fn ideal_follows_changes_of_speed() {
        let header = header(&[1.0, 1.0]);
        let mut run = run();
        // Two a second for 3 s, from then on one a second for the 14 that are left.
        run.insert(2, at(4, RecordKind::SpeedSet { node: 1, speed: 0.0 }));
        assert_eq!(ideal(&header, &run), secs(17));
        run.insert(3, at(5, RecordKind::SpeedSet { node: 0, speed: 0.0 }));
        assert_eq!(ideal(&header, &run), None, "nobody works any more");
        run.insert(6, at(8, RecordKind::SpeedSet { node: 0, speed: 0.5 }));
        assert_eq!(ideal(&header, &run), secs(7 + 26));
    }

    #[test]
    fn paused_machine_counts_as_speed_0() {
        let header = header(&[1.0, 1.0]);
        let mut run = run();
        // Two a second for 3 s, one a second for 5, and again two a second for the 9 that are left.
        run.insert(2, at(4, RecordKind::Paused { node: 1 }));
        assert_eq!(ideal(&header, &run), secs(17), "until the end");
        run.insert(6, at(9, RecordKind::Resumed { node: 1 }));
        assert_eq!(ideal(&header, &run), Some(Duration::from_millis(12_500)));
        // A speed that is set meanwhile counts from then on.
        run.insert(3, at(5, RecordKind::SpeedSet { node: 1, speed: 0.5 }));
        assert_eq!(ideal(&header, &run), secs(8 + 6));
    }

    #[test]
    fn power_leaves_out_machines_that_do_not_work() {
        let header = Header { spares: 1, ..header(&[1.0, 0.5, 0.25]) };
        let run = [
            at(1, RecordKind::Paused { node: 0 }),
            at(2, RecordKind::SpeedSet { node: 0, speed: 0.75 }),
            at(3, RecordKind::Resumed { node: 0 }),
            at(4, RecordKind::Condition { node: 1, condition: Condition::CutOff }),
            at(5, RecordKind::Condition { node: 2, condition: Condition::Well }),
        ];
        let powers = metrics_of(&header, &run).powers();
        let powers: Vec<_> = powers.into_iter().map(|(at, power)| (at.secs(), power)).collect();
        let changes = [(1.0, 0.5), (2.0, 0.5), (3.0, 1.25), (4.0, 0.75), (5.0, 1.0)];
        assert_eq!(powers, [&[(0.0, 1.75), (0.0, 1.5)], &changes[..]].concat());
    }

    #[test]
    fn an_ideal_beyond_all_time_is_none() {
        let run = [sent(0, PARENT, node(0), Message::Band(0..20)), done(1, 0, 0, 1)];
        // The end of the second that this takes is more than 2⁶⁴ s away, if only since the change.
        let slow = 1.0 / (2f64.powi(64) + 1e10);
        let change = at(18_000_000_000, RecordKind::SpeedSet { node: 0, speed: slow });
        assert_eq!(ideal(&header(&[slow]), &[&run[..], &[change]].concat()), None);
    }

    #[test]
    fn changes_after_the_ideal_end_do_not_matter() {
        let mut run = run();
        run.push(at(14, RecordKind::SpeedSet { node: 0, speed: 0.0 }));
        assert_eq!(ideal(&header(&[1.0, 1.0]), &run), secs(10));
    }

    #[test]
    fn makespan_includes_the_estimate() {
        let mut run = run();
        run.insert(0, at(0, RecordKind::Estimating));
        assert_eq!(metrics_of(&header(&[1.0, 1.0]), &run).makespan(), secs(13));
    }

    #[test]
    fn messages_are_counted_by_kind() {
        let mut run = run();
        run.push(sent(14, node(0), PARENT, Message::Request));
        run.push(sent(14, PARENT, node(0), Message::Part(3..4)));
        let expected = MessageCounts {
            requests: 1,
            parts: 1,
            offers: 2,
            hops: 1,
            transfers: 1,
            atoms_moved: 4,
            results: 1,
            total: 10,
            bytes: 100,
            ..MessageCounts::default()
        };
        assert_eq!(metrics_of(&header(&[1.0, 1.0]), &run).messages(), expected);
    }
}
