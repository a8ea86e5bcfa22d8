//! Trials: runs in virtual time that are defined by a header and a script, and variants with one change.

use std::time::Duration;

use super::Sim;
use crate::balance::{NodeId, Party, Remedy, Rules, Strategy};
use crate::picture::{Division, Size};
use crate::record::RecordKind;
use crate::runlog::{Driver, Header, OwnLink, RunLog};
use crate::scenario::{Command, Script};
use crate::time::Time;

/// Definition of a run in virtual time.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Settings of the run.
    pub header: Header,
    /// Commands during the run.
    pub script: Script,
}

/// One change of a trial; everything else stays the same.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Another strategy, with its default parameters.
    Strategy(Strategy),
    /// Another number of machines; added machines run at full speed.
    Nodes(usize),
    /// The speed of a machine from the start.
    Speed(NodeId, f64),
    /// The speed of a machine from a time on.
    SpeedAt(Time, NodeId, f64),
    /// Full speed for all machines.
    Equal,
    /// The adaptive ring without one of its remedies.
    Without(Remedy),
    /// Another number of pixels in an atom.
    Atom(u32),
    /// Another latency of all nodes that have none of their own.
    Latency(Duration),
    /// A node's own latency from the start.
    OwnLatency(NodeId, Duration),
    /// Another time that the parent is busy with each message.
    Handling(Duration),
}

impl Trial {
    /// Creates the trial of a recorded run, with all commands that were executed in it.
    pub fn of(log: &RunLog) -> Self {
        let command = |at: Time, kind: &RecordKind| match *kind {
            RecordKind::SpeedSet { node, speed } => Some(Command::Speed { node, speed }),
            RecordKind::Paused { node } => Some(Command::Pause { node, paused: true }),
            RecordKind::Resumed { node } => Some(Command::Pause { node, paused: false }),
            RecordKind::LatencySet { latency } => Some(Command::Latency(latency)),
            RecordKind::OwnLatencySet { party, latency } => Some(Command::OwnLatency { party, latency }),
            RecordKind::Condition { node, condition } => Some(Command::Condition { node, condition }),
            RecordKind::Link { one, other, cut } => Some(Command::Link { one, other, cut }),
            RecordKind::Delayed { from, to, until } => Some(Command::Delay { from, to, by: until.since(at) }),
            _ => None,
        };
        let script =
            log.records().iter().filter_map(|record| Some((record.at, command(record.at, &record.kind)?))).collect();
        Self::new(log.header.clone(), script)
    }

    /// Creates a trial; the driver of `header` is replaced by virtual time.
    pub fn new(header: Header, script: Script) -> Self {
        Self { header: Header { driver: Driver::Sim, cores: header.speeds.len(), ..header }, script }
    }

    /// Returns a copy with one change.
    pub fn with(&self, change: Change) -> Self {
        let mut trial = self.clone();
        let header = &mut trial.header;
        let sets_part = matches!(change, Change::Strategy(_) | Change::Nodes(_) | Change::Atom(_));
        let sets_beat = matches!(change, Change::Nodes(_) | Change::Handling(_));
        match change {
            Change::Strategy(strategy) => {
                header.rules.strategy = strategy;
                if !header.rules.strategy.survives_losses() {
                    // The other strategies do not let spare machines in.
                    header.speeds.truncate(header.speeds.len() - usize::from(std::mem::take(&mut header.spares)));
                }
            }
            Change::Nodes(nodes) => {
                header.speeds.resize(nodes.max(1), 1.0);
                header.spares = header.spares.min(header.speeds.len() as NodeId - 1);
            }
            Change::Speed(node, speed) => {
                if let Some(known) = header.speeds.get_mut(usize::from(node)) {
                    *known = speed;
                }
            }
            Change::SpeedAt(at, node, speed) => {
                let later = trial.script.partition_point(|(other, _)| *other <= at);
                trial.script.insert(later, (at, Command::Speed { node, speed }));
                // Later speeds of this machine would undo the change.
                let of_it = |command: &Command| matches!(command, Command::Speed { node: of, .. } if *of == node);
                let mut place = 0;
                trial.script.retain(|(_, command)| {
                    place += 1;
                    place <= later + 1 || !of_it(command)
                });
            }
            Change::Without(remedy) => header.rules.remedies = header.rules.remedies.without(remedy),
            Change::Equal => header.speeds.fill(1.0),
            Change::Atom(pixels) => header.division = Division::new(header.size.pixels(), pixels.max(1)),
            Change::Latency(latency) => header.link.latency = latency,
            Change::OwnLatency(node, latency) => {
                let party = Party::Node(node);
                header.link.set_own(party, OwnLink { latency: Some(latency), ..header.link.own(party) });
            }
            Change::Handling(handling) => header.handling = handling,
        }
        if sets_part {
            header.rules.part = header.rules.strategy.usual_part(header.division, header.speeds.len());
        }
        if sets_beat {
            header.rules.beat = Rules::beat_for(header.handling, header.speeds.len());
        }
        header.cores = header.speeds.len();
        header.link.trim(header.speeds.len());
        trial
    }

    /// Returns the speed of a machine at a time.
    pub fn speed_at(&self, at: Time, node: NodeId) -> f64 {
        let set = |(when, command): &(Time, Command)| match *command {
            Command::Speed { node: of, speed } if of == node && *when <= at => Some(speed),
            _ => None,
        };
        let at_first = || self.header.speeds.get(usize::from(node)).copied().unwrap_or_default();
        self.script.iter().rev().find_map(set).unwrap_or_else(at_first)
    }

    /// Runs the trial with these costs of pixels, and returns its log. The picture stays incomplete if machines with
    /// atoms stand still for ever.
    ///
    /// # Panics
    /// If the costs are for a picture of another size.
    pub fn run(&self, costs: &PixelCosts) -> RunLog {
        let costs = costs.of_atoms(self.header.division);
        let mut sim = Sim::new(&self.header, &self.script, move |atom| costs[atom as usize]);
        let (mut log, mut records) = (RunLog::new(self.header.clone()), Vec::new());
        sim.run(&mut |record| records.push(record));
        log.add(records);
        log
    }
}

/// Costs of all pixels of a picture on the reference machine, from which the costs of atoms of any size follow.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelCosts {
    size: Size,
    /// By pixel: the summed cost of all pixels before it, in nanoseconds, which take half the memory of `Duration`.
    before: Vec<u64>,
}

impl PixelCosts {
    /// Creates the costs from one cost for each pixel, in scan order.
    ///
    /// # Panics
    /// If the number of costs is not the number of pixels.
    pub fn new(size: Size, costs: &[Duration]) -> Self {
        assert_eq!(costs.len(), size.pixels() as usize, "a cost for each pixel");
        let mut sum = 0;
        let before = std::iter::once(0).chain(costs.iter().map(|cost| {
            // 2^64 ns are 584 years.
            sum += cost.as_nanos() as u64;
            sum
        }));
        Self { size, before: before.collect() }
    }

    /// Returns the cost of the whole picture.
    pub fn whole(&self) -> Duration {
        Duration::from_nanos(self.before[self.size.pixels() as usize])
    }

    /// Returns the cost of each atom.
    ///
    /// # Panics
    /// If the division is that of another number of pixels.
    pub fn of_atoms(&self, division: Division) -> Vec<Duration> {
        let cost = |atom| {
            let pixels = division.pixels(atom);
            Duration::from_nanos(self.before[pixels.end as usize] - self.before[pixels.start as usize])
        };
        (0..division.atoms()).map(cost).collect()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::{prop, prop_assert_eq, proptest};

    use super::*;
    use crate::balance::Condition;
    use crate::runlog::Metrics;
    use crate::runlog::examples::header;

    fn costs(size: Size) -> PixelCosts {
        let costs: Vec<_> = (0..size.pixels()).map(|pixel| Duration::from_micros(20 + u64::from(pixel % 50))).collect();
        PixelCosts::new(size, &costs)
    }

    fn makespan(trial: &Trial) -> Duration {
        Metrics::of(&trial.run(&costs(trial.header.size))).makespan().expect("it ends")
    }

    #[test]
    fn each_change_leaves_everything_else_the_same() {
        let trial = Trial::new(header(&[1.0, 1.0, 1.0, 0.1]), Vec::new());
        let bands = trial.with(Change::Strategy(Strategy::Static));
        assert!(makespan(&bands) > 2 * makespan(&trial), "{:?} {:?}", makespan(&bands), makespan(&trial));
        assert_eq!(bands.with(Change::Strategy(trial.header.rules.strategy.clone())), trial);
        let equal = trial.with(Change::Equal);
        assert_eq!(equal, trial.with(Change::Speed(3, 1.0)));
        assert!(makespan(&equal) < makespan(&trial));
        assert_eq!(trial.with(Change::Nodes(6)).header.speeds, [1.0, 1.0, 1.0, 0.1, 1.0, 1.0]);
        assert_eq!(trial.with(Change::Nodes(6)).header.cores, 6);
        let busy = trial.with(Change::Handling(Duration::from_millis(20)));
        assert!(busy.header.rules.beat > trial.header.rules.beat, "a busy parent gets fewer beats");
        let later = trial.with(Change::Latency(Duration::from_millis(300)));
        assert!(makespan(&later) > makespan(&trial));
        let far = trial.with(Change::OwnLatency(3, Duration::from_millis(300)));
        let latencies = [0, 3].map(|node| far.header.link.latency_of(Party::Node(node)));
        assert_eq!(latencies, [Duration::ZERO, Duration::from_millis(300)]);
        assert_eq!(Trial { header: Header { link: trial.header.link.clone(), ..far.header }, ..far }, trial);
    }

    #[test]
    fn spares_stay_only_where_machines_are_let_in() {
        let mut trial = Trial::new(header(&[1.0, 1.0, 1.0]), Vec::new());
        trial = trial.with(Change::Strategy(Strategy::Adaptive));
        trial.header.spares = 1;
        let ring = trial.with(Change::Strategy(Strategy::Ring)).header;
        assert_eq!((ring.speeds.len(), ring.spares, ring.cores), (2, 0, 2));
        assert_eq!(trial.with(Change::Strategy(Strategy::FarmLeases)).header.spares, 1);
        let one = trial.with(Change::Nodes(1)).header;
        assert_eq!((one.speeds.len(), one.spares), (1, 0));
    }

    #[test]
    fn fork_equals_the_original_until_its_change() {
        let trial = Trial::new(header(&[1.0, 1.0, 1.0]), Vec::new());
        let half = Time::ZERO + makespan(&trial) / 2;
        let (one, other) = (trial.run(&costs(trial.header.size)), trial.with(Change::SpeedAt(half, 1, 0.05)));
        let other = other.run(&costs(trial.header.size));
        let until = one.until(half);
        assert_eq!(one.records()[..until], other.records()[..until]);
        assert!(other.records().last().map(|last| last.at) > one.records().last().map(|last| last.at));
    }

    #[test]
    fn trial_of_a_log_has_the_same_commands_and_records() {
        let trial = Trial::new(header(&[1.0, 1.0]), vec![(Time(500_000), Command::Speed { node: 1, speed: 0.2 })]);
        let log = trial.run(&costs(trial.header.size));
        assert_eq!(Trial::of(&log), trial);
        assert_eq!(Trial::of(&log).run(&costs(trial.header.size)), log);
        assert_eq!([Time(400_000), Time(500_000)].map(|at| trial.speed_at(at, 1)), [1.0, 0.2]);
        let off = Command::Condition { node: 1, condition: Condition::Off };
        let failing = Trial { script: vec![(Time(500_000), off)], ..trial.clone() };
        assert_eq!(Trial::of(&failing.run(&costs(trial.header.size))), failing);
        let fork = trial.with(Change::SpeedAt(Time(10), 1, 0.5));
        assert_eq!(fork.script, [(Time(10), Command::Speed { node: 1, speed: 0.5 })]);
    }

    proptest! {
        #[test]
        fn cost_of_an_atom_is_the_sum_of_its_pixels(costs in prop::collection::vec(0..1000u64, 48), atom in 1..60u32) {
            let costs: Vec<_> = costs.into_iter().map(Duration::from_nanos).collect();
            let size = Size::new(8, 6).expect("a picture");
            let (pixels, division) = (PixelCosts::new(size, &costs), Division::new(48, atom));
            let of_atoms = pixels.of_atoms(division);
            prop_assert_eq!(of_atoms.iter().sum::<Duration>(), pixels.whole());
            let first: Duration = costs.iter().take(atom as usize).sum();
            prop_assert_eq!(of_atoms[0], first);
        }
    }
}
