//! Folds records into lanes: what each machine did, and when.

use super::flight::{Cargo, Flight};
use super::lane::{Lane, LanePhase, Traced};
use crate::balance::{NodeId, Party, Remedy};
use crate::picture::Atom;
use crate::record::{Record, RecordKind};
use crate::runlog::{Header, RunLog};
use crate::time::Time;

/// One lane for each machine, and all messages. Records of different parties may come interleaved; those of one party
/// come in order.
#[derive(Clone, Debug)]
pub struct Lanes {
    lanes: Vec<Lane>,
    trips: Vec<Trip>,
    /// By trip: the bytes of all trips up to it.
    bytes: Vec<u64>,
    version: u64,
    /// Whether a retired machine can be woken.
    can_wake: bool,
}

/// A message on its way.
#[derive(Clone, Debug, PartialEq)]
pub struct Trip {
    /// The message's number in the run.
    pub id: u64,
    /// The sender.
    pub from: Party,
    /// The receiver.
    pub to: Party,
    /// The kind of message.
    pub load: Load,
    /// Number of atoms in it.
    pub atoms: u32,
    /// When it was sent.
    pub sent: Time,
    /// When the link delivers it.
    pub arrives: Time,
}

/// Kind of a message, as the timeline tells them apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Load {
    /// An offer, the sender's own or another's.
    Offer,
    /// A request, or its answer without atoms.
    Request,
    /// Atoms to be traced.
    Atoms,
    /// Traced atoms.
    Results,
    /// A message of the adaptive ring that carries no work, for example that a node wakes or is lost.
    Notice,
    /// The end of the run.
    Shutdown,
}

impl Lanes {
    /// Creates the lanes of a run that has not begun.
    pub fn new(header: &Header) -> Self {
        let lane = |(node, speed): (NodeId, &f64)| Lane::new(*speed, header.is_spare(node));
        Self {
            lanes: (0..).zip(&header.speeds).map(lane).collect(),
            trips: Vec::new(),
            bytes: Vec::new(),
            version: 0,
            can_wake: header.remedies().has(Remedy::Wake),
        }
    }

    /// Folds all records of a run.
    pub fn of(log: &RunLog) -> Self {
        let mut lanes = Self::new(&log.header);
        log.records().iter().for_each(|record| lanes.apply(record));
        lanes
    }

    /// Adds the next record.
    pub fn apply(&mut self, record: &Record) {
        self.version += 1;
        let at = record.at;
        match &record.kind {
            RecordKind::Sent { id, from, to, message, bytes, arrives } => {
                self.sent(Flight::new(*id, (*from, *to), message, at, *arrives), *bytes);
            }
            RecordKind::Condition { node, condition } => {
                if let Some(lane) = self.lane(*node) {
                    lane.set_condition(at, *condition);
                }
            }
            RecordKind::AtomFailed { node, .. } => _ = self.lane(*node).map(|lane| lane.open = None),
            RecordKind::Link { .. }
            | RecordKind::Delayed { .. }
            | RecordKind::Lost { .. }
            | RecordKind::GivenUp { .. } => {}
            RecordKind::Received { .. }
            | RecordKind::Estimating
            | RecordKind::Estimated { .. }
            | RecordKind::LatencySet { .. }
            | RecordKind::OwnLatencySet { .. } => {}
            RecordKind::AtomStarted { node, atom } => {
                if let Some(lane) = self.lane(*node) {
                    lane.open = Some((*atom, at));
                    lane.begin_phase(at, LanePhase::HasAtoms);
                }
            }
            RecordKind::AtomDone { node, atom, .. } => {
                if let Some(lane) = self.lane(*node) {
                    // A bar without a beginning has no length.
                    let from = lane.open.take().filter(|(open, _)| open == atom).map_or(at, |(_, since)| since);
                    lane.bars.push(Traced { from, to: at, atom: *atom });
                }
            }
            RecordKind::SpeedSet { node, speed } => {
                if let Some(lane) = self.lane(*node) {
                    lane.set_speed(at, *speed);
                }
            }
            RecordKind::Paused { node } => _ = self.lane(*node).map(|lane| lane.set_paused(at, true)),
            RecordKind::Resumed { node } => _ = self.lane(*node).map(|lane| lane.set_paused(at, false)),
            RecordKind::Retired { node } => {
                let phase = if self.can_wake { LanePhase::Asleep } else { LanePhase::Retired };
                if let Some(lane) = self.lane(*node) {
                    lane.begin_phase(at, phase);
                }
            }
            RecordKind::Finished => self.lanes.iter_mut().for_each(|lane| lane.begin_phase(at, LanePhase::Retired)),
        }
    }

    /// Lanes in the order of the ring.
    pub fn lanes(&self) -> &[Lane] {
        &self.lanes
    }

    /// Messages, about in the order in which they were sent.
    pub fn trips(&self) -> &[Trip] {
        &self.trips
    }

    /// The message with this number in the run.
    pub fn trip(&self, id: u64) -> Option<&Trip> {
        self.trips.iter().rfind(|trip| trip.id == id)
    }

    /// A number that changes with every record.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// The first bar of an atom, and its machine.
    pub fn bar_of(&self, atom: Atom) -> Option<(NodeId, Traced)> {
        let of = |(node, lane): (NodeId, &Lane)| lane.bars.iter().find(|bar| bar.atom == atom).map(|&bar| (node, bar));
        (0..).zip(&self.lanes).find_map(of)
    }

    /// Sums up how the machines used their time until `now`.
    pub fn usage(&self, now: Time) -> Usage {
        let tracing: Vec<f64> = self.lanes.iter().map(|lane| lane.tracing_seconds(now)).collect();
        let sum: f64 = tracing.iter().sum();
        let busiest = tracing.iter().copied().fold(0.0, f64::max);
        let all = now.secs() * tracing.len() as f64;
        let on_the_way: f64 = self.lanes.iter().map(|lane| lane.on_the_way_seconds(now)).sum();
        // Nearly in order: a record may come a little before that of an earlier message.
        let trips = self.trips.partition_point(|trip| trip.sent <= now);
        let share = |part: f64, of: f64| if of > 0.0 { part / of } else { 0.0 };
        Usage {
            utilisation: share(sum, all),
            imbalance: share(busiest * tracing.len() as f64 - sum, sum).max(0.0),
            on_the_way: share(on_the_way, all),
            messages: trips,
            bytes: trips.checked_sub(1).map_or(0, |last| self.bytes[last]),
        }
    }

    fn lane(&mut self, node: NodeId) -> Option<&mut Lane> {
        self.lanes.get_mut(usize::from(node))
    }

    fn sent(&mut self, flight: Flight, bytes: u64) {
        let Flight { id, from, to, sent, arrives, .. } = flight;
        let atoms = flight.cargo.atoms();
        let load = match &flight.cargo {
            Cargo::Offer { .. } | Cargo::Wake => Load::Offer,
            Cargo::Request => Load::Request,
            Cargo::Part(part) if part.is_empty() => Load::Request,
            Cargo::Band(_) | Cargo::Part(_) | Cargo::Transfer(_) | Cargo::Again(_) => Load::Atoms,
            Cargo::Results(_) => Load::Results,
            Cargo::Sleeps | Cargo::Beat | Cargo::Notice => Load::Notice,
            Cargo::Shutdown => Load::Shutdown,
        };
        if let Party::Node(node) = from {
            let own = matches!(flight.cargo, Cargo::Offer { who } if who == node);
            if (own || load == Load::Request)
                && let Some(lane) = self.lane(node)
            {
                lane.begin_phase(sent, LanePhase::Offers);
            }
        }
        if let (Party::Node(node), Load::Atoms, 1..) = (to, load, atoms)
            && let Some(lane) = self.lane(node)
        {
            lane.begin_phase(sent, LanePhase::Receives);
        }
        self.bytes.push(self.bytes.last().copied().unwrap_or(0).saturating_add(bytes));
        self.trips.push(Trip { id, from, to, load, atoms, sent, arrives });
    }
}

/// Use of all machines' time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Usage {
    /// Part of the time in which machines traced atoms, 0 to 1.
    pub utilisation: f64,
    /// Tracing time of the busiest machine / mean tracing time − 1; 0 is perfect.
    pub imbalance: f64,
    /// Part of the time in which an offer or a request of a machine, or atoms for it, were on the way, 0 to 1.
    pub on_the_way: f64,
    /// Number of messages that have been sent.
    pub messages: usize,
    /// Weight of these messages in bytes.
    pub bytes: u64,
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::view::tests::sample_runs;

    fn lanes(speeds: &[f64], atoms: u32) -> (Lanes, Time) {
        let header = sample_runs::header(speeds, atoms);
        let mut lanes = Lanes::new(&header);
        let records = sample_runs::records(&header);
        records.iter().for_each(|record| lanes.apply(record));
        (lanes, records.last().map_or(Time::ZERO, |last| last.at))
    }

    proptest! {
        #[test]
        fn every_atom_is_one_bar_and_bars_do_not_overlap(
            speeds in prop::collection::vec(0.05..1.0f64, 1..6), atoms in 1..300u32,
        ) {
            let (lanes, end) = lanes(&speeds, atoms);
            let mut traced: Vec<Atom> = Vec::new();
            for lane in lanes.lanes() {
                prop_assert!(lane.bars().windows(2).all(|pair| pair[0].to <= pair[1].from));
                prop_assert!(lane.bars().iter().all(|bar| bar.from <= bar.to && bar.to <= end));
                prop_assert!(lane.phases().is_sorted_by_key(|(at, _)| *at));
                traced.extend(lane.bars().iter().map(|bar| bar.atom));
            }
            traced.sort_unstable();
            prop_assert_eq!(traced, (0..atoms).collect::<Vec<_>>());
            prop_assert!((0..atoms).all(|atom| lanes.bar_of(atom).is_some_and(|(_, bar)| bar.atom == atom)));
        }

        #[test]
        fn usage_is_the_sum_of_the_bars(speeds in prop::collection::vec(0.05..1.0f64, 1..6), atoms in 1..300u32, at in 0.0..1.0f64) {
            let (lanes, end) = lanes(&speeds, atoms);
            let now = Time((at * end.0 as f64) as u64);
            let usage = lanes.usage(now);
            let covered = |bar: &Traced| bar.to.min(now).since(bar.from).as_secs_f64();
            let busy: f64 = lanes.lanes().iter().flat_map(Lane::bars).map(covered).sum();
            prop_assert!((usage.utilisation * now.secs() * speeds.len() as f64 - busy).abs() < 1e-6);
            prop_assert!((0.0..=1.0 + 1e-9).contains(&usage.utilisation) && (0.0..=1.0).contains(&usage.on_the_way));
            prop_assert!((0.0..speeds.len() as f64).contains(&usage.imbalance));
            prop_assert_eq!(usage.messages, lanes.trips().iter().filter(|trip| trip.sent <= now).count());
        }
    }

    #[test]
    fn lane_passes_through_the_phases_of_a_ring() {
        let (lanes, end) = lanes(&[1.0, 1.0, 0.1], 300);
        let fast = &lanes.lanes()[0];
        assert_eq!((fast.phase_at(Time::ZERO), fast.phase_at(end)), (LanePhase::Receives, LanePhase::Retired));
        let seen: Vec<LanePhase> = fast.phases().iter().map(|(_, phase)| *phase).collect();
        for phase in [LanePhase::HasAtoms, LanePhase::Offers, LanePhase::Receives, LanePhase::Retired] {
            assert!(seen.contains(&phase), "{phase:?}: {seen:?}");
        }
        let bar = fast.bars()[fast.bars().len() / 2];
        assert_eq!(fast.bar_at(Time((bar.from.0 + bar.to.0) / 2)), Some(bar));
    }

    #[test]
    fn paused_machine_at_speed_0_stays_stopped_when_resumed() {
        let header = sample_runs::header(&[1.0, 1.0], 9);
        let mut lanes = Lanes::new(&header);
        let kinds = [
            RecordKind::Paused { node: 1 },
            RecordKind::SpeedSet { node: 1, speed: 0.0 },
            RecordKind::Resumed { node: 1 },
        ];
        for (at, kind) in (1..).zip(kinds) {
            lanes.apply(&Record { at: Time(at), kind });
        }
        assert_eq!(lanes.lanes()[1].stops(), [(Time(1), None)]);
    }
}
