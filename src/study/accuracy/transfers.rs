//! Error of the ring's speed estimate at each transfer (§7), and lateness of its runs.

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use fastrand::Rng;
use serde::Serialize;

use crate::balance::{Message, NodeId, PIPE_ATOMS, Party, Strategy};
use crate::picture::Atom;
use crate::record::{Record, RecordKind};
use crate::runlog::{Driver, Header, LinkSettings, Metrics};
use crate::sim::Sim;
use crate::study::fixture::{AtomCosts, Fixture};
use crate::time::Time;

/// Machines in a ring.
pub(super) const NODES: usize = 8;

/// Time of the reference machine for the whole picture.
pub(super) const PICTURE_TIME: Duration = Duration::from_secs(3);

/// Latency of a message.
const LATENCY: Duration = Duration::from_millis(1);

/// A run and its transfers.
pub(super) struct RingRun {
    pub row: RingRow,
    pub transfers: Vec<Transfer>,
}

/// The row of a run.
#[derive(Clone, Debug, Serialize)]
pub(super) struct RingRow {
    pub scene: String,
    /// Seed of the random speeds.
    pub seed: u64,
    pub atom_pixels: u32,
    pub latency_s: f64,
    pub messages: u64,
    pub transfers: u64,
    /// Mean distance of the estimated share from the true one, weighted by the waiting work.
    pub estimate_error: Option<f64>,
    /// Makespan / ideal − 1.
    pub lateness: f64,
}

/// A transfer of atoms from their owner to an offerer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transfer {
    /// Number of atoms that wait with the owner.
    pub waiting: u32,
    /// Cost of the waiting atoms on the reference machine.
    pub work: Duration,
    /// Share of the waiting atoms for the offerer by counts of traced atoms, 0 to 1.
    pub estimate: f64,
    /// Share with which both finish together, by true speeds and costs, 0 to 1.
    pub truth: f64,
}

/// Returns random speeds from 0.1 to 1, the same for the same seed.
pub(super) fn random_speeds(seed: u64) -> Vec<f64> {
    let mut rng = Rng::with_seed(seed);
    (0..NODES).map(|_| 0.1 + 0.9 * rng.f64()).collect()
}

/// Simulates the ring with atoms of the default size.
pub(super) fn run_default(fixture: &Fixture, seed: u64) -> RingRun {
    run_ring(fixture, 50, LATENCY, seed)
}

/// Simulates the ring on machines of random speeds.
pub(super) fn run_ring(fixture: &Fixture, atom_pixels: u32, latency: Duration, seed: u64) -> RingRun {
    let plain = fixture.header(atom_pixels, Strategy::Ring, random_speeds(seed));
    let header = Header { driver: Driver::Sim, link: LinkSettings { latency, ..plain.link }, ..plain };
    let costs = fixture.costs(atom_pixels, PICTURE_TIME);
    let (mut metrics, mut observer) = (Metrics::new(&header), TransferObserver::new(&header, costs.clone()));
    Sim::new(&header, &[], move |atom| costs[atom as usize]).run(&mut |record| {
        metrics.add(&record);
        observer.observe(&record);
    });
    let messages = metrics.messages();
    let row = RingRow {
        scene: header.scene.clone(),
        seed,
        atom_pixels,
        latency_s: latency.as_secs_f64(),
        messages: messages.total,
        transfers: messages.transfers,
        estimate_error: mean_error(&observer.transfers),
        lateness: metrics.efficiency().map_or(f64::INFINITY, |efficiency| 1.0 / efficiency - 1.0),
    };
    RingRun { row, transfers: observer.transfers }
}

/// Returns the mean distance of estimate and truth, weighted by the waiting work; `None` without transfers.
fn mean_error(transfers: &[Transfer]) -> Option<f64> {
    let sum = |of: &dyn Fn(&Transfer) -> f64| {
        transfers.iter().map(|transfer| of(transfer) * transfer.work.as_secs_f64()).sum::<f64>()
    };
    let all = sum(&|_| 1.0);
    (all > 0.0).then(|| sum(&|transfer| (transfer.estimate - transfer.truth).abs()) / all)
}

/// Follows the owners of atoms through the records.
struct TransferObserver {
    nodes: Vec<NodeAtoms>,
    costs: AtomCosts,
    latency: Duration,
    /// Bands and transfers in flight, by message.
    under_way: BTreeMap<u64, Vec<Atom>>,
    transfers: Vec<Transfer>,
}

/// The atoms of one node.
struct NodeAtoms {
    speed: f64,
    /// Atoms still to be traced, in order.
    atoms: VecDeque<Atom>,
    /// When the first of them was started.
    begun: Option<Time>,
    traced: u32,
    /// Count of traced atoms in the node's last offer.
    offered: u32,
}

impl TransferObserver {
    fn new(header: &Header, costs: AtomCosts) -> Self {
        let node = |&speed: &f64| NodeAtoms { speed, atoms: VecDeque::new(), begun: None, traced: 0, offered: 0 };
        let nodes = header.speeds.iter().map(node).collect();
        Self { nodes, costs, latency: header.link.latency, under_way: BTreeMap::new(), transfers: Vec::new() }
    }

    fn node(&mut self, id: NodeId) -> &mut NodeAtoms {
        &mut self.nodes[usize::from(id)]
    }

    fn observe(&mut self, record: &Record) {
        match &record.kind {
            RecordKind::Sent { id, message: Message::Band(atoms), .. } => {
                self.under_way.insert(*id, atoms.clone().collect());
            }
            RecordKind::Sent {
                id,
                from: Party::Node(from),
                to: Party::Node(to),
                message: Message::Transfer(ranges),
                ..
            } => {
                let given: Vec<Atom> = ranges.iter().cloned().flatten().collect();
                self.transfers.extend(self.transfer(*from, *to, record.at));
                let atoms = &mut self.node(*from).atoms;
                atoms.truncate(atoms.len().saturating_sub(given.len()));
                self.under_way.insert(*id, given);
            }
            RecordKind::Sent { from: Party::Node(from), message: Message::Offer { who, done, .. }, .. }
                if who == from =>
            {
                self.node(*who).offered = *done;
            }
            RecordKind::Received { id, by: Party::Node(by) } => {
                let atoms = self.under_way.remove(id).unwrap_or_default();
                self.node(*by).atoms.extend(atoms);
            }
            RecordKind::AtomStarted { node, .. } => self.node(*node).begun = Some(record.at),
            RecordKind::AtomDone { node, .. } => {
                let node = self.node(*node);
                node.atoms.pop_front();
                (node.begun, node.traced) = (None, node.traced + 1);
            }
            _ => {}
        }
    }

    /// Returns the estimate and the truth when `from` gives atoms away; `None` if neither node has traced an atom,
    /// since there is no estimate then.
    fn transfer(&self, from: NodeId, to: NodeId, now: Time) -> Option<Transfer> {
        let (owner, offerer) = (&self.nodes[usize::from(from)], &self.nodes[usize::from(to)]);
        let counted = f64::from(owner.traced) + f64::from(offerer.offered);
        let in_pipe = owner.atoms.len().min(PIPE_ATOMS as usize);
        let seconds = |atom: &Atom| self.costs[*atom as usize].as_secs_f64();
        let begun = owner.begun.map_or(0.0, |begun| now.since(begun).as_secs_f64() * owner.speed);
        let in_hand = owner.atoms.iter().take(in_pipe).map(seconds).sum::<f64>() - begun;
        let waiting: Vec<f64> = owner.atoms.iter().skip(in_pipe).map(seconds).collect();
        (counted > 0.0 && !waiting.is_empty()).then(|| Transfer {
            waiting: waiting.len() as u32,
            work: Duration::from_secs_f64(waiting.iter().sum()),
            estimate: f64::from(offerer.offered) / counted,
            truth: balanced_share(
                &waiting,
                in_hand.max(0.0) / owner.speed,
                self.latency.as_secs_f64(),
                [owner.speed, offerer.speed],
            ),
        })
    }
}

/// Returns the share of the `waiting` work, from its end, with which offerer and owner finish together, 0 to 1. The
/// owner cannot start it before `owner_from`, the offerer not before `offerer_from`; all in seconds.
fn balanced_share(waiting: &[f64], owner_from: f64, offerer_from: f64, [owner, offerer]: [f64; 2]) -> f64 {
    let mut owner_ends = owner_from + waiting.iter().sum::<f64>() / owner;
    let mut offerer_ends = offerer_from;
    for (given, work) in waiting.iter().rev().enumerate() {
        let ahead = owner_ends - offerer_ends;
        // The change of that by a whole atom.
        let an_atom = work / owner + work / offerer;
        if ahead < an_atom {
            return (given as f64 + (ahead / an_atom).max(0.0)) / waiting.len() as f64;
        }
        owner_ends -= work / owner;
        offerer_ends += work / offerer;
    }
    1.0
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::picture::Size;
    use crate::scene::Opened;

    proptest! {
        #[test]
        fn balanced_share_makes_both_finish_together(
            waiting in prop::collection::vec(0.01..1.0_f64, 1..30), owner in 0.1..1.0_f64, offerer in 0.1..1.0_f64,
            owner_from in 0.0..2.0_f64, offerer_from in 0.0..2.0_f64,
        ) {
            let share = balanced_share(&waiting, owner_from, offerer_from, [owner, offerer]);
            prop_assert!((0.0..=1.0).contains(&share));
            let given = share * waiting.len() as f64;
            let part = |place: usize| (given - (waiting.len() - 1 - place) as f64).clamp(0.0, 1.0);
            let work: f64 = waiting.iter().enumerate().map(|(place, work)| work * part(place)).sum();
            let owner_ends = owner_from + (waiting.iter().sum::<f64>() - work) / owner;
            let offerer_ends = offerer_from + work / offerer;
            let apart = owner_ends - offerer_ends;
            // All or nothing is best where even that is not enough.
            prop_assert!(apart.abs() < 1e-9 || (share == 0.0 && apart < 0.0) || (share == 1.0 && apart > 0.0));
        }
    }

    #[test]
    fn equal_machines_share_evenly_and_atoms_in_hand_count() {
        assert_eq!(balanced_share(&[1.0; 8], 0.0, 0.0, [1.0, 1.0]), 0.5);
        assert_eq!(balanced_share(&[1.0; 8], 2.0, 0.0, [0.5, 0.5]), 0.5 + 1.0 / 16.0);
        assert_eq!(balanced_share(&[1.0; 8], 0.0, 0.0, [0.25, 0.75]), 0.75);
        assert_eq!(balanced_share(&[1.0; 2], 0.0, 9.0, [1.0, 1.0]), 0.0);
    }

    #[test]
    fn every_transfer_is_observed_with_its_owners_atoms() {
        let scene = Opened::new("ten-objects").unwrap();
        let fixture = Fixture::new(&scene, Size::new(160, 120).unwrap(), 1).unwrap();
        for seed in 0..5 {
            let RingRun { row, transfers } = run_default(&fixture, seed);
            // Without counts there is no estimate; that happens only at the beginning.
            assert!(transfers.len() as u64 <= row.transfers && transfers.len() as u64 + 3 > row.transfers);
            assert!(row.lateness > 0.0 && row.lateness < 1.0 && !transfers.is_empty());
            let is_share = |share| (0.0..=1.0).contains(&share);
            assert!(transfers.iter().all(|transfer| is_share(transfer.estimate) && is_share(transfer.truth)));
            // The estimate is the protocol's, except for rounding.
            assert!(row.estimate_error.is_some_and(|error| error < 0.5));
        }
    }
}
