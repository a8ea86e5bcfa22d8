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
use crate::balance::{NodeId, Party, Remedies, Remedy, Scheduler};
use crate::picture::{Atom, Division};
use crate::record::{Record, RecordKind};
use crate::runlog::{Header, LinkSettings, OwnLink};
use crate::time::Time;

/// State of a run after some of its records.
///
/// Records of different parties may come interleaved: a message may be received here before it was sent.
#[derive(Clone, Debug)]
pub struct RunState {
    pub(crate) nodes: Vec<NodeState>,
    /// By atom.
    atoms: Vec<AtomState>,
    /// By atom: the number of atoms that were traced before it.
    orders: Vec<u32>,
    /// Σ costs of the traced atoms, in seconds of CPU time.
    total_cost: f64,
    pub(crate) flights: Flights,
    /// Messages that are not received yet, by their numbers.
    pub(crate) pending: BTreeMap<u64, Flight>,
    /// Messages whose receipt was recorded before their sending.
    received_early: BTreeSet<u64>,
    /// Atoms that the parent placed before their tracing was recorded.
    placed_early: BTreeSet<Atom>,
    /// Atoms that look different since [`RunState::take_touched`].
    touched: Vec<Range<Atom>>,
    division: Division,
    pub(crate) scheduler: Scheduler,
    /// Differences from the article's ring.
    remedies: Remedies,
    link: LinkSettings,
    /// Time for which the parent is busy with each message.
    pub(crate) handling: Duration,
    arrived: Arrived,
    /// Parts that the parent of a farm has given to nodes that asked.
    pub(crate) handed_out: Parcels,
    /// Whether the parent samples the picture.
    pub(crate) is_estimating: bool,
    head: Time,
    /// The time of the parent's latest record.
    pub(crate) parent_head: Time,
    pub(crate) finished: Option<Time>,
    /// Nodes that the parent takes for gone, by its last message about them and by the one before.
    pub(crate) gone: Vec<NodeId>,
    pub(crate) previous_gone: Vec<NodeId>,
}

/// Messages and pixels that the parent has received.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Arrived {
    /// Messages of every kind.
    pub messages: u64,
    /// Traced pixels.
    pub pixels: u32,
}

impl RunState {
    /// Creates the state of a run that has not begun.
    pub fn new(header: &Header) -> Self {
        let remedies = header.remedies();
        let spares: Vec<_> = (0..header.speeds.len() as NodeId).filter(|&node| header.is_spare(node)).collect();
        Self {
            nodes: (0..).zip(&header.speeds).map(|(id, &speed)| NodeState::new(speed, header.is_spare(id))).collect(),
            atoms: vec![AtomState::Nowhere; header.division.atoms() as usize],
            orders: vec![0; header.division.atoms() as usize],
            total_cost: 0.0,
            flights: Flights::default(),
            pending: BTreeMap::new(),
            received_early: BTreeSet::new(),
            placed_early: BTreeSet::new(),
            touched: Vec::new(),
            division: header.division,
            scheduler: header.scheduler(),
            remedies,
            link: header.link.clone(),
            handling: header.handling,
            arrived: Arrived::default(),
            handed_out: Parcels::default(),
            is_estimating: false,
            head: Time::ZERO,
            parent_head: Time::ZERO,
            finished: None,
            gone: spares.clone(),
            previous_gone: spares,
        }
    }

    /// Adds the next record. Nodes and atoms that the header does not have are ignored.
    pub fn apply(&mut self, record: &Record) {
        let at = record.at;
        self.head = self.head.max(at);
        match &record.kind {
            RecordKind::Sent { id, from, to, message, arrives, .. } => {
                if *from == Party::Parent {
                    (self.parent_head, self.is_estimating) = (self.parent_head.max(at), false);
                }
                self.apply_status(*from, message, at);
                self.sent(*id, Flight::new(*id, (*from, *to), message, at, *arrives));
            }
            RecordKind::Received { id, by } => {
                if *by == Party::Parent {
                    (self.arrived.messages, self.parent_head) = (self.arrived.messages + 1, self.parent_head.max(at));
                }
                match self.pending.remove(id) {
                    Some(flight) => self.received(flight, at),
                    None => _ = self.received_early.insert(*id),
                }
            }
            RecordKind::AtomStarted { node, atom } => {
                if let Some(state) = self.node(*node) {
                    // A node that slept has got atoms.
                    (state.atom, state.retired) = (Some(*atom), false);
                    self.touched.push(*atom..*atom + 1);
                }
            }
            RecordKind::AtomDone { node, atom, cost } => self.atom_done(*node, *atom, *cost, at),
            RecordKind::SpeedSet { node, speed } => _ = self.node(*node).map(|state| state.set_speed(*speed, at)),
            RecordKind::Paused { node } => _ = self.node(*node).map(|state| state.set_paused(true, at)),
            RecordKind::Resumed { node } => _ = self.node(*node).map(|state| state.set_paused(false, at)),
            RecordKind::LatencySet { latency } => self.link.latency = *latency,
            RecordKind::OwnLatencySet { party, latency } => {
                self.link.set_own(*party, OwnLink { latency: *latency, ..self.link.own(*party) });
            }
            RecordKind::Retired { node } => {
                if let Some(state) = self.node(*node) {
                    (state.retired, state.awaits_answer) = (true, false);
                }
            }
            RecordKind::Condition { node, condition } => self.set_condition(*node, *condition, at),
            RecordKind::Lost { id } => self.lose_message(*id, at),
            RecordKind::AtomFailed { node, .. } => _ = self.node(*node).map(NodeState::atom_failed),
            RecordKind::Delayed { from, to, until } => self.delayed((*from, *to), at, *until),
            RecordKind::Link { .. } | RecordKind::GivenUp { .. } => {}
            RecordKind::Estimating => self.is_estimating = true,
            RecordKind::Estimated { .. } => self.is_estimating = false,
            RecordKind::Finished => self.finished = Some(at),
        }
    }

    /// Nodes in the order of the ring.
    pub fn nodes(&self) -> &[NodeState] {
        &self.nodes
    }

    /// State of each atom.
    pub fn atom_states(&self) -> &[AtomState] {
        &self.atoms
    }

    /// Messages that are still drawn, and a few that are not any more, in the order in which they were sent. Of
    /// results, which are many, only some.
    pub fn flights(&self) -> &[Flight] {
        &self.flights
    }

    /// The message with this number, if it is not handled yet or still drawn.
    pub fn flight(&self, id: u64) -> Option<&Flight> {
        self.pending.get(&id).or_else(|| self.flights.iter().rfind(|flight| flight.id == id))
    }

    /// Number of traced atoms.
    pub fn done(&self) -> u32 {
        self.nodes.iter().map(|node| node.done).sum()
    }

    /// Number of atoms that were traced before a traced atom.
    pub fn order(&self, atom: Atom) -> u32 {
        self.orders.get(atom as usize).copied().unwrap_or_default()
    }

    /// Mean cost of the traced atoms, in seconds of CPU time; 0 if none is traced.
    pub fn mean_cost(&self) -> f64 {
        self.total_cost / f64::from(self.done().max(1))
    }

    /// Number of atoms of the picture.
    pub fn atoms(&self) -> u32 {
        self.atoms.len() as u32
    }

    /// Number of atoms in an equal share of the picture: of all machines but the spare ones.
    pub(crate) fn equal_share(&self) -> u32 {
        let machines = self.nodes.iter().filter(|node| !node.spare).count();
        self.atoms().div_ceil(machines.max(1) as u32)
    }

    /// Division of the picture into atoms.
    pub fn division(&self) -> Division {
        self.division
    }

    /// Scheduler of the run.
    pub fn scheduler(&self) -> &Scheduler {
        &self.scheduler
    }

    /// Whether the run is an adaptive ring with this remedy.
    pub fn has(&self, remedy: Remedy) -> bool {
        self.remedies.has(remedy)
    }

    /// Latency of the links at present.
    pub fn latency(&self) -> Duration {
        self.link.latency
    }

    /// Returns the shortest and the longest latency of a message from a node: in a ring to its left neighbour, else to
    /// the parent.
    pub fn latency_range(&self) -> (Duration, Duration) {
        let nodes = self.nodes.len() as NodeId;
        let latency = |node: NodeId| {
            let left = Party::Node(if node == 0 { nodes - 1 } else { node - 1 });
            self.link.between(Party::Node(node), if self.scheduler.is_ring() { left } else { Party::Parent }).0
        };
        let range = (0..nodes).map(latency).fold(None, |range: Option<(Duration, Duration)>, latency| {
            Some(range.map_or((latency, latency), |(least, most)| (least.min(latency), most.max(latency))))
        });
        range.unwrap_or_default()
    }

    /// Returns what a party has of its own at its end of the links.
    pub fn own_link(&self, party: Party) -> OwnLink {
        self.link.own(party)
    }

    /// Messages and pixels that the parent has received.
    pub fn arrived(&self) -> Arrived {
        self.arrived
    }

    /// Time of the latest record.
    pub fn head(&self) -> Time {
        self.head
    }

    /// Time at which the picture was complete.
    pub fn finished(&self) -> Option<Time> {
        self.finished
    }

    /// Takes the atoms that look different since the last call.
    pub fn take_touched(&mut self) -> Vec<Range<Atom>> {
        std::mem::take(&mut self.touched)
    }

    /// Sets the playback rate, in run seconds per wall second: it decides how long messages are drawn.
    pub fn set_rate(&mut self, rate: f64) {
        self.flights.set_rate(rate);
    }

    /// Playback rate: run seconds per wall second, at most 1.
    pub(crate) fn rate(&self) -> f64 {
        self.flights.rate()
    }

    fn node(&mut self, node: NodeId) -> Option<&mut NodeState> {
        self.nodes.get_mut(usize::from(node))
    }

    /// Notes a traced atom.
    fn atom_done(&mut self, node: NodeId, atom: Atom, cost: Duration, at: Time) {
        let order = self.done();
        if let (Some(state), Some(place)) = (self.nodes.get_mut(usize::from(node)), self.atoms.get_mut(atom as usize)) {
            // If an atom is traced twice, the first result counts.
            let counts = place.owner().is_none();
            // The parent's record may have come first, without the cost.
            if let AtomState::Traced { by, cost: known, .. } = place
                && *by == node
                && *known == 0.0
            {
                *known = cost.as_secs_f32();
                self.total_cost += cost.as_secs_f64();
            }
            if counts {
                self.orders[atom as usize] = order;
                self.total_cost += cost.as_secs_f64();
                *place = AtomState::traced(node, cost, at);
            }
            if self.placed_early.remove(&atom) {
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

    /// Returns the party that wrote a record.
    fn party(record: &Record) -> Party {
        match &record.kind {
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
            | RecordKind::OwnLatencySet { .. }
            | RecordKind::Estimating
            | RecordKind::Estimated { .. }
            | RecordKind::Finished => Party::Parent,
        }
    }

    proptest! {
        #[test]
        fn no_atom_is_lost_or_traced_twice(speeds in prop::collection::vec(0.05..1.0f64, 1..6), atoms in 1..80u32) {
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
            prop_assert!(state.atom_states().iter().all(|place| place.owner().is_some()));
            prop_assert!(state.nodes.iter().all(|node| node.left() == 0));
            prop_assert_eq!(state.arrived().pixels, header.size.pixels());
            let given: u32 = state.nodes.iter().map(|node| node.given.atoms).sum();
            prop_assert_eq!(given, state.nodes.iter().map(|node| node.got.atoms).sum::<u32>());
            for (node, band) in state.nodes.iter().zip(header.division.bands(speeds.len())) {
                prop_assert_eq!(node.done, band.len() as u32 + node.got.atoms - node.given.atoms);
                // Each offer but the last one was answered with atoms.
                prop_assert_eq!(node.offers, node.got.count + 1);
            }
        }

        #[test]
        fn interleaving_of_parties_does_not_matter(speeds in prop::collection::vec(0.05..1.0f64, 1..6), atoms in 1..60u32, batch in 2..40usize) {
            let header = sample_runs::header(&speeds, atoms);
            let records = sample_runs::records(&header);
            let (mut straight, mut mixed) = (RunState::new(&header), RunState::new(&header));
            records.iter().for_each(|record| straight.apply(record));
            for batch in records.chunks(batch) {
                let mut batch = batch.to_vec();
                // Records of one party stay in order.
                batch.sort_by_key(party);
                batch.iter().for_each(|record| mixed.apply(record));
            }
            prop_assert_eq!(straight.atom_states(), mixed.atom_states());
            prop_assert_eq!(straight.arrived(), mixed.arrived());
            for (one, other) in straight.nodes.iter().zip(&mixed.nodes) {
                prop_assert_eq!((one.done, one.left, one.retired), (other.done, other.left, other.retired));
                prop_assert_eq!((one.offers, one.hops, one.given, one.got), (other.offers, other.hops, other.given, other.got));
            }
        }
    }

    #[test]
    fn pause_and_latency_are_kept() {
        let mut state = RunState::new(&sample_runs::header(&[1.0, 0.5], 2));
        let mut apply = |kind| {
            state.apply(&Record { at: Time::ZERO, kind });
            (state.nodes[1].paused, state.nodes[1].speed, state.latency())
        };
        let (before, after) = (Duration::from_millis(40), Duration::from_millis(200));
        assert_eq!(apply(RecordKind::Paused { node: 1 }), (true, 0.5, before));
        assert_eq!(apply(RecordKind::LatencySet { latency: after }), (true, 0.5, after));
        assert_eq!(apply(RecordKind::Resumed { node: 1 }), (false, 0.5, after));
    }

    #[test]
    fn unknown_nodes_and_atoms_are_ignored() {
        let mut state = RunState::new(&sample_runs::header(&[1.0], 2));
        let offer = Message::offer(9, 0);
        let (from, to, at) = (Party::Node(9), Party::Node(8), Time::ZERO);
        state.apply(&Record { at, kind: RecordKind::Sent { id: 0, from, to, message: offer, bytes: 0, arrives: at } });
        state.apply(&Record { at, kind: RecordKind::Received { id: 0, by: to } });
        state.apply(&Record { at, kind: RecordKind::AtomDone { node: 9, atom: 77, cost: Duration::ZERO } });
        state.apply(&Record { at, kind: RecordKind::Paused { node: 9 } });
        assert!(state.flights().is_empty());
        assert_eq!(state.done(), 0);
    }
}
