//! The state of a run at one moment, as a fold over its records.

mod failures;
mod messages;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::time::Duration;

use super::atom_state::AtomState;
use super::flight::Flight;
use super::flights::Flights;
use super::node_state::{NodeState, Parcels};
use super::scheduler::Sharing;
use crate::balance::{NodeId, Party, Remedies, Remedy};
use crate::picture::{Atom, Division};
use crate::record::{Record, RecordKind};
use crate::runlog::{Driver, Header};
use crate::time::Time;

/// What is known of a run after some of its records.
///
/// Records of different parties may come interleaved: a message may be received here before it was sent.
#[derive(Clone, Debug)]
pub struct RunState {
    pub(crate) nodes: Vec<NodeState>,
    /// By atom.
    places: Vec<AtomState>,
    /// By atom: how many were traced before it.
    orders: Vec<u32>,
    /// Seconds of CPU time that all traced atoms took.
    cost: f64,
    pub(crate) flights: Flights,
    pub(crate) pending: BTreeMap<u64, Flight>,
    early: BTreeSet<u64>,
    /// Atoms that the parent has placed before their tracing was told.
    early_atoms: BTreeSet<Atom>,
    touched: Vec<Range<Atom>>,
    division: Division,
    pub(crate) sharing: Sharing,
    /// What a ring does otherwise than the article's.
    remedies: Remedies,
    /// In virtual time the whole picture is traced before the run begins.
    pub(crate) is_virtual: bool,
    latency: Duration,
    /// How long the parent is busy with each message.
    pub(crate) handling: Duration,
    arrived: Arrived,
    /// What the parent of a farm has given to nodes that asked.
    pub(crate) handed_out: Parcels,
    /// The parent samples the picture.
    pub(crate) is_estimating: bool,
    head: Time,
    /// The time of the parent's latest record.
    pub(crate) parent_head: Time,
    pub(crate) finished: Option<Time>,
    /// Whom the parent last said to be gone, and before that.
    pub(crate) gone: Vec<NodeId>,
    pub(crate) gone_before: Vec<NodeId>,
}

/// What has arrived at the parent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Arrived {
    /// Messages of every kind.
    pub messages: u64,
    /// Traced pixels.
    pub pixels: u32,
}

impl RunState {
    /// The state before anything has happened.
    pub fn new(header: &Header) -> Self {
        let remedies = header.remedies();
        let spares: Vec<_> = (0..header.speeds.len() as NodeId).filter(|&node| header.is_spare(node)).collect();
        Self {
            nodes: (0..).zip(&header.speeds).map(|(id, &speed)| NodeState::new(speed, header.is_spare(id))).collect(),
            places: vec![AtomState::Nowhere; header.division.atoms() as usize],
            orders: vec![0; header.division.atoms() as usize],
            cost: 0.0,
            flights: Flights::default(),
            pending: BTreeMap::new(),
            early: BTreeSet::new(),
            early_atoms: BTreeSet::new(),
            touched: Vec::new(),
            division: header.division,
            sharing: Sharing::of(header),
            remedies,
            is_virtual: header.driver == Driver::Sim,
            latency: header.link.latency,
            handling: header.handling,
            arrived: Arrived::default(),
            handed_out: Parcels::default(),
            is_estimating: false,
            head: Time::ZERO,
            parent_head: Time::ZERO,
            finished: None,
            gone: spares.clone(),
            gone_before: spares,
        }
    }

    /// Takes in what happened next. What does not belong to the header's nodes and atoms is left out.
    pub fn apply(&mut self, record: &Record) {
        let at = record.at;
        self.head = self.head.max(at);
        match &record.what {
            RecordKind::Sent { id, from, to, message, arrives, .. } => {
                if *from == Party::Parent {
                    (self.parent_head, self.is_estimating) = (self.parent_head.max(at), false);
                }
                self.said(*from, message, at);
                self.sent(*id, Flight::new(*id, (*from, *to), message, at, *arrives));
            }
            RecordKind::Received { id, by } => {
                if *by == Party::Parent {
                    (self.arrived.messages, self.parent_head) = (self.arrived.messages + 1, self.parent_head.max(at));
                }
                match self.pending.remove(id) {
                    Some(flight) => self.received(flight, at),
                    None => _ = self.early.insert(*id),
                }
            }
            RecordKind::AtomStarted { node, atom } => {
                if let Some(state) = self.node(*node) {
                    // Whoever slept has been given something.
                    (state.atom, state.retired) = (Some(*atom), false);
                    self.touched.push(*atom..*atom + 1);
                }
            }
            RecordKind::AtomDone { node, atom, cost } => self.atom_done(*node, *atom, *cost, at),
            RecordKind::SpeedSet { node, speed } => _ = self.node(*node).map(|state| state.set_speed(*speed, at)),
            RecordKind::Paused { node } => _ = self.node(*node).map(|state| state.set_paused(true, at)),
            RecordKind::Resumed { node } => _ = self.node(*node).map(|state| state.set_paused(false, at)),
            RecordKind::LatencySet { latency } => self.latency = *latency,
            RecordKind::Retired { node } => {
                if let Some(state) = self.node(*node) {
                    (state.retired, state.offer_out) = (true, false);
                }
            }
            RecordKind::Condition { node, condition } => self.condition_set(*node, *condition, at),
            RecordKind::Lost { id } => self.lost(*id, at),
            RecordKind::AtomFailed { node, .. } => _ = self.node(*node).map(NodeState::atom_failed),
            RecordKind::Delayed { from, to, until } => self.delayed((*from, *to), at, *until),
            RecordKind::Link { .. } | RecordKind::GivenUp { .. } => {}
            RecordKind::Estimating => self.is_estimating = true,
            RecordKind::Estimated { .. } => self.is_estimating = false,
            RecordKind::Finished => self.finished = Some(at),
        }
    }

    /// All nodes, in the order of the ring.
    pub fn nodes(&self) -> &[NodeState] {
        &self.nodes
    }

    /// Where each atom stands.
    pub fn places(&self) -> &[AtomState] {
        &self.places
    }

    /// The messages that can still be seen, and a few that are gone, in the order in which they left; of results, which
    /// are many, only some.
    pub fn flights(&self) -> &[Flight] {
        &self.flights
    }

    /// A message that has not been handled yet, or can still be seen, by its name in the run.
    pub fn flight(&self, id: u64) -> Option<&Flight> {
        self.pending.get(&id).or_else(|| self.flights.iter().rfind(|flight| flight.id == id))
    }

    /// How many atoms have been traced.
    pub fn done(&self) -> u32 {
        self.nodes.iter().map(|node| node.done).sum()
    }

    /// How many atoms were traced before a traced one.
    pub fn order(&self, atom: Atom) -> u32 {
        self.orders.get(atom as usize).copied().unwrap_or_default()
    }

    /// What an atom has cost on the average, in seconds of CPU time; 0 if none is traced.
    pub fn mean_cost(&self) -> f64 {
        self.cost / f64::from(self.done().max(1))
    }

    /// How many atoms there are.
    pub fn atoms(&self) -> u32 {
        self.places.len() as u32
    }

    /// How the picture is cut into atoms.
    pub fn division(&self) -> Division {
        self.division
    }

    /// How the atoms are shared.
    pub fn sharing(&self) -> Sharing {
        self.sharing
    }

    /// Whether it is a ring that does this otherwise than the article's.
    pub fn has(&self, remedy: Remedy) -> bool {
        self.remedies.has(remedy)
    }

    /// How long a message travels that leaves now, apart from what its weight takes.
    pub fn latency(&self) -> Duration {
        self.latency
    }

    /// What has arrived at the parent.
    pub fn arrived(&self) -> Arrived {
        self.arrived
    }

    /// The time of the latest record.
    pub fn head(&self) -> Time {
        self.head
    }

    /// When the picture was complete.
    pub fn finished(&self) -> Option<Time> {
        self.finished
    }

    /// The atoms that look different since this was last asked.
    pub fn take_touched(&mut self) -> Vec<Range<Atom>> {
        std::mem::take(&mut self.touched)
    }

    /// So many of the run's seconds go by in a second of whoever looks on: the slower, the less are flights stretched.
    pub fn set_rate(&mut self, rate: f64) {
        self.flights.set_rate(rate);
    }

    /// How many of the run's seconds go by in a second of whoever looks on, at most one.
    pub(crate) fn rate(&self) -> f64 {
        self.flights.rate()
    }

    fn node(&mut self, node: NodeId) -> Option<&mut NodeState> {
        self.nodes.get_mut(usize::from(node))
    }

    fn atom_done(&mut self, node: NodeId, atom: Atom, cost: Duration, at: Time) {
        let order = self.done();
        if let (Some(state), Some(place)) = (self.nodes.get_mut(usize::from(node)), self.places.get_mut(atom as usize))
        {
            // Of an atom that is traced twice the first result counts.
            let counts = place.owner().is_none();
            // The parent may have told of it before its worker.
            if let AtomState::Traced { by, cost: known, .. } = place
                && *by == node
                && *known == 0.0
            {
                *known = cost.as_secs_f32();
                self.cost += cost.as_secs_f64();
            }
            if counts {
                self.orders[atom as usize] = order;
                self.cost += cost.as_secs_f64();
                *place = AtomState::traced(node, cost, at);
            }
            if self.early_atoms.remove(&atom) {
                place.place();
            }
            state.atom_done(counts, at);
            self.touched.push(atom..atom + 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::flight::Cargo;
    use super::*;
    use crate::balance::Message;
    use crate::view::tests::sample_runs;

    fn in_flight(state: &RunState) -> u32 {
        state
            .pending
            .values()
            .filter(|flight| !matches!(flight.cargo, Cargo::Results(_)))
            .map(|f| f.cargo.atoms())
            .sum()
    }

    /// Who wrote a record down.
    fn party(record: &Record) -> Party {
        match &record.what {
            RecordKind::Sent { from, .. } => *from,
            RecordKind::Received { by, .. } => *by,
            RecordKind::AtomStarted { node, .. }
            | RecordKind::AtomDone { node, .. }
            | RecordKind::SpeedSet { node, .. }
            | RecordKind::Paused { node }
            | RecordKind::Resumed { node }
            | RecordKind::Condition { node, .. }
            | RecordKind::AtomFailed { node, .. }
            | RecordKind::Retired { node } => Party::Node(*node),
            RecordKind::Delayed { to, .. } => *to,
            RecordKind::Link { .. } | RecordKind::Lost { .. } | RecordKind::GivenUp { .. } => Party::Parent,
            RecordKind::LatencySet { .. }
            | RecordKind::Estimating
            | RecordKind::Estimated { .. }
            | RecordKind::Finished => Party::Parent,
        }
    }

    proptest! {
        #[test]
        fn no_atom_is_lost_or_doubled(speeds in prop::collection::vec(0.05..1.0f64, 1..6), atoms in 1..80u32) {
            let header = sample_runs::header(&speeds, atoms);
            let mut state = RunState::new(&header);
            for record in sample_runs::records(&header) {
                state.apply(&record);
                let left: u32 = state.nodes.iter().map(NodeState::left).sum();
                prop_assert!(left + state.done() + in_flight(&state) <= atoms);
                if left > 0 && state.nodes.iter().all(|node| node.band_at.is_some()) {
                    prop_assert_eq!(left + state.done() + in_flight(&state), atoms);
                }
            }
            prop_assert!(state.finished().is_some());
            prop_assert!(state.places().iter().all(|place| place.owner().is_some()));
            prop_assert!(state.nodes.iter().all(|node| node.left() == 0));
            prop_assert_eq!(state.arrived().pixels, header.size.pixels());
            let given: u32 = state.nodes.iter().map(|node| node.given.atoms).sum();
            prop_assert_eq!(given, state.nodes.iter().map(|node| node.got.atoms).sum::<u32>());
            for (node, band) in state.nodes.iter().zip(header.division.bands(speeds.len())) {
                prop_assert_eq!(node.done, band.len() as u32 + node.got.atoms - node.given.atoms);
                // Each offer but the last is taken.
                prop_assert_eq!(node.offers, node.got.count + 1);
            }
        }

        #[test]
        fn interleaving_changes_nothing(speeds in prop::collection::vec(0.05..1.0f64, 1..6), atoms in 1..60u32, batch in 2..40usize) {
            let header = sample_runs::header(&speeds, atoms);
            let records = sample_runs::records(&header);
            let (mut straight, mut mixed) = (RunState::new(&header), RunState::new(&header));
            records.iter().for_each(|record| straight.apply(record));
            for batch in records.chunks(batch) {
                let mut batch = batch.to_vec();
                // Each party's records stay in order, but whole parties come one after the other.
                batch.sort_by_key(party);
                batch.iter().for_each(|record| mixed.apply(record));
            }
            prop_assert_eq!(straight.places(), mixed.places());
            prop_assert_eq!(straight.arrived(), mixed.arrived());
            for (one, other) in straight.nodes.iter().zip(&mixed.nodes) {
                prop_assert_eq!((one.done, one.left, one.retired), (other.done, other.left, other.retired));
                prop_assert_eq!((one.offers, one.hops, one.given, one.got), (other.offers, other.hops, other.given, other.got));
            }
        }
    }

    #[test]
    fn pauses_and_latencies_are_kept() {
        let mut state = RunState::new(&sample_runs::header(&[1.0, 0.5], 2));
        let mut apply = |what| {
            state.apply(&Record { at: Time::ZERO, what });
            (state.nodes[1].paused, state.nodes[1].speed, state.latency())
        };
        let (before, after) = (Duration::from_millis(40), Duration::from_millis(200));
        assert_eq!(apply(RecordKind::Paused { node: 1 }), (true, 0.5, before));
        assert_eq!(apply(RecordKind::LatencySet { latency: after }), (true, 0.5, after));
        assert_eq!(apply(RecordKind::Resumed { node: 1 }), (false, 0.5, after));
    }

    #[test]
    fn strangers_are_left_out() {
        let mut state = RunState::new(&sample_runs::header(&[1.0], 2));
        let offer = Message::offer(9, 0);
        let (from, to, at) = (Party::Node(9), Party::Node(8), Time::ZERO);
        state.apply(&Record { at, what: RecordKind::Sent { id: 0, from, to, message: offer, bytes: 0, arrives: at } });
        state.apply(&Record { at, what: RecordKind::Received { id: 0, by: to } });
        state.apply(&Record { at, what: RecordKind::AtomDone { node: 9, atom: 77, cost: Duration::ZERO } });
        state.apply(&Record { at, what: RecordKind::Paused { node: 9 } });
        assert!(state.flights().is_empty());
        assert_eq!(state.done(), 0);
    }
}
