//! Runs from 1 to 1,024 machines: how each strategy's efficiency falls.

use std::sync::Arc;
use std::time::Duration;

use serde::Serialize;

use super::StudyError;
use super::fixture::{AtomCosts, Fixture, STRATEGIES, simulate};
use super::progress::{Progress, ProgressSink};
use crate::balance::Rules;
use crate::parallel::{cores, map_on_threads};
use crate::picture::{Division, Size};
use crate::runlog::{Driver, Header, LinkSettings};
use crate::scene::Opened;

/// Mean cost of an atom: one machine needs about half a minute for the strong picture.
pub(super) const ATOM_COST: Duration = Duration::from_millis(2);

/// Width and height of the strong picture, whose size is constant, in pixels.
pub(super) const STRONG_PX: (u32, u32) = (1024, 768);

/// Atoms per node in the weak picture, whose size grows with the nodes.
pub(super) const ATOMS_PER_NODE: u32 = 1024;

/// Latency of a message, and time for which the parent is busy with it, in ms. If the second were always 0, a farm's
/// parent could answer any number of machines at once.
pub(super) const NETWORKS_MS: [(f64, f64); 4] = [(0.1, 0.0), (1.0, 0.0), (10.0, 0.0), (1.0, 0.1)];

const ATOM_PX: u32 = 50;

/// One run.
#[derive(Clone, Debug, Serialize)]
pub(super) struct ScaleRow {
    pub nodes: usize,
    pub latency_s: f64,
    /// Time for which the parent is busy with each message.
    pub handling_s: f64,
    pub weak: bool,
    pub strategy: &'static str,
    pub atoms: u32,
    pub makespan_s: f64,
    pub efficiency: f64,
    /// Efficiency of a makespan of W/m + 3.65 log₂ W, for W atoms on m nodes.
    pub bound_efficiency: f64,
    pub messages_per_node: f64,
    pub bytes_per_node: f64,
    pub hops_per_node: f64,
    pub atoms_moved: u64,
    pub transfers: u64,
    /// Share of the machines' time after their last atoms.
    pub tail_idle: f64,
}

/// Returns the numbers of machines: 1, 2, 4 … 1,024.
pub(super) fn node_counts() -> impl Iterator<Item = usize> + Clone {
    (0..=10).map(|power| 1 << power)
}

/// Simulates all runs in virtual time.
///
/// # Errors
/// A [`StudyError`], if the scene cannot be traced.
pub(super) fn measure(scene: &Opened, tell: ProgressSink<'_>) -> Result<Vec<ScaleRow>, StudyError> {
    let size = Size::new(STRONG_PX.0, STRONG_PX.1).map_err(StudyError::size)?;
    let fixture = Fixture::new(scene, size, 1)?;
    let atoms = Division::new(size.pixels(), ATOM_PX).atoms();
    let strong = fixture.costs(ATOM_PX, ATOM_COST * atoms);
    let mut progress = Progress::new(2 * node_counts().count(), tell);
    let mut rows = Vec::new();
    for weak in [false, true] {
        for nodes in node_counts() {
            let kind = if weak { "the picture grown with them" } else { "the same picture" };
            progress.next(&format!("{nodes} machines, {kind}"));
            let (costs, size) = if weak { resample(&strong, nodes)? } else { (strong.clone(), size) };
            let runs: Vec<_> =
                NETWORKS_MS.into_iter().flat_map(|network| STRATEGIES.map(|strategy| (network, strategy))).collect();
            rows.extend(map_on_threads(cores(), &runs, |(network, strategy)| {
                let plain = fixture.header(ATOM_PX, strategy.clone(), vec![1.0; nodes]);
                let plain = Header { size, division: Division::new(size.pixels(), ATOM_PX), ..plain };
                row(plain, *network, weak, &costs)
            }));
        }
    }
    Ok(rows)
}

/// Stretches the strong picture's costs over a picture of [`ATOMS_PER_NODE`] atoms per node, and returns the costs and
/// that picture's size: each atom costs what the atom at the same height costs, scaled to the same mean.
fn resample(costs: &AtomCosts, nodes: usize) -> Result<(AtomCosts, Size), StudyError> {
    let atoms = ATOMS_PER_NODE as usize * nodes;
    let at = |atom: usize| costs[(atom as u64 * costs.len() as u64 / atoms as u64) as usize];
    let total: Duration = (0..atoms).map(at).sum();
    let even = ATOM_COST.as_secs_f64() * atoms as f64 / total.as_secs_f64();
    let costs: Arc<[Duration]> = (0..atoms).map(|atom| at(atom).mul_f64(even)).collect();
    Ok((costs, Size::new(ATOM_PX * 32, atoms as u32 / 32).map_err(StudyError::size)?))
}

fn row(plain: Header, network: (f64, f64), weak: bool, costs: &AtomCosts) -> ScaleRow {
    let (latency, handling) = (Duration::from_secs_f64(network.0 * 1e-3), Duration::from_secs_f64(network.1 * 1e-3));
    let mut header = Header { driver: Driver::Sim, link: LinkSettings { latency, ..plain.link }, handling, ..plain };
    let nodes = header.speeds.len();
    header.rules.beat = Rules::beat_for(handling, nodes);
    header.rules.part = header.rules.strategy.usual_part(header.division, nodes);
    let metrics = simulate(&header, &[], costs);
    let (messages, atoms) = (metrics.messages(), header.division.atoms());
    let a_node = |count: u64| count as f64 / nodes as f64;
    let (w, m) = (f64::from(atoms), nodes as f64);
    ScaleRow {
        nodes,
        latency_s: latency.as_secs_f64(),
        handling_s: handling.as_secs_f64(),
        weak,
        strategy: header.rules.strategy.name(),
        atoms,
        makespan_s: metrics.makespan().unwrap_or_default().as_secs_f64(),
        efficiency: metrics.efficiency().unwrap_or_default(),
        bound_efficiency: (w / m) / (w / m + if nodes == 1 { 0.0 } else { 3.65 * w.log2() }),
        messages_per_node: a_node(messages.total),
        bytes_per_node: a_node(messages.bytes),
        hops_per_node: a_node(messages.hops),
        atoms_moved: messages.atoms_moved,
        transfers: messages.transfers,
        tail_idle: metrics.tail_idle().unwrap_or_default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grown_picture_keeps_costs_and_their_places() {
        let costs: AtomCosts = (0..3000u64).map(|atom| Duration::from_micros(500 + atom)).collect();
        for nodes in [1, 8] {
            let (grown, size) = resample(&costs, nodes).unwrap();
            assert_eq!(grown.len(), 1024 * nodes);
            assert_eq!(Division::new(size.pixels(), ATOM_PX).atoms() as usize, grown.len());
            let mean = grown.iter().sum::<Duration>() / grown.len() as u32;
            assert!(mean.abs_diff(ATOM_COST) < Duration::from_micros(1), "{mean:?}");
            assert!(grown.is_sorted());
        }
    }
}
