//! Rows of the table of machines, and their shares of the finished work.

use std::borrow::Cow;
use std::time::Duration;

use super::node_state::{Activity, NodeState};
use super::run_state::RunState;
use crate::balance::{Condition, NodeId, Remedy};
use crate::time::Time;

/// Row of a node at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeRow {
    /// The node.
    pub node: NodeId,
    /// Atoms that it has traced.
    pub done: u32,
    /// Atoms that it has, without those in parcels that are drawn on their way.
    pub left: u32,
    /// Atoms that were lost when it was switched off, and that nobody will hand out again.
    pub lost: u32,
    /// Length of its bar of done atoms, 0 to 1 on a scale that all rows share.
    pub done_bar: f32,
    /// End of its bar of atoms left, on the same scale. The bar begins at `done_bar`.
    pub left_bar: f32,
    /// Fraction of the time until now in which it had no atom, 0 to 1.
    pub idle: f64,
    /// Time until now in which it was paused, hung, off or at speed 0.
    pub stopped: Duration,
    /// What it does, as it is shown.
    pub activity: Activity,
    /// Its speed as a fraction of the reference machine.
    pub speed: f64,
    /// Whether it is paused, with or without atoms.
    pub paused: bool,
    /// Atoms a second: in the last 3 s, or over the whole run once the picture is complete.
    pub rate: f64,
}

/// A node's share of all atoms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeShare {
    /// The node.
    pub node: NodeId,
    /// Beginning of the share in a bar of all atoms, 0 to 1.
    pub start: f32,
    /// End of the share in this bar.
    pub end: f32,
    /// Atoms that the node has traced.
    pub atoms: u32,
}

/// Returns a row for each node at `now`.
pub fn node_rows(state: &RunState, now: Time) -> Vec<NodeRow> {
    let until = state.finished().map_or(now, |end| now.min(end));
    let seen: Vec<_> = (0..state.nodes().len() as NodeId).map(|node| (node, state.node_as_drawn(node, now))).collect();
    // The scale ends at twice an equal share, or at the largest row if that is more.
    let share = state.atoms().div_ceil(seen.len().max(1) as u32);
    let most = seen.iter().map(|(_, node)| node.done + node.left()).max().unwrap_or(0).max(2 * share).max(1) as f32;
    let over_all = state.finished().filter(|&end| end > Time::ZERO);
    let row = |(node, of): &(NodeId, Cow<'_, NodeState>)| NodeRow {
        node: *node,
        done: of.done,
        left: of.left(),
        lost: if of.condition == Condition::Off && !state.has(Remedy::Leases) { of.lost_atoms } else { 0 },
        done_bar: of.done as f32 / most,
        left_bar: (of.done + of.left()) as f32 / most,
        idle: if until == Time::ZERO { 0.0 } else { of.idle(until).as_secs_f64().min(until.secs()) / until.secs() },
        stopped: of.stopped(until),
        activity: state.activity(*node, now),
        speed: of.speed,
        paused: of.paused,
        rate: over_all.map_or_else(|| of.rate(now), |end| f64::from(of.done) / end.secs()),
    };
    seen.iter().map(row).collect()
}

/// Returns the nodes' shares of all atoms, one after the other. The rest up to 1 is still to be traced.
pub fn node_shares(state: &RunState) -> Vec<NodeShare> {
    let all = state.atoms().max(1) as f32;
    let mut start = 0;
    let mut share = |(node, of): (NodeId, &NodeState)| {
        let from = start;
        start += of.done;
        NodeShare { node, start: from as f32 / all, end: start as f32 / all, atoms: of.done }
    };
    (0..).zip(state.nodes()).map(&mut share).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Record, RecordKind};
    use crate::view::tests::sample_runs;

    #[test]
    fn bars_share_a_scale_and_shares_fill_the_bar() {
        let header = sample_runs::header(&[1.0, 0.5, 0.2], 90);
        let mut state = RunState::new(&header);
        for record in sample_runs::records(&header) {
            state.apply(&record);
            let rows = node_rows(&state, record.at);
            assert!(rows.iter().all(|row| 0.0 <= row.done_bar && row.done_bar <= row.left_bar && row.left_bar <= 1.0));
            assert!(rows.iter().all(|row| (0.0..=1.0).contains(&row.idle)), "{rows:?}");
            assert!(rows.iter().all(|row| (0.0..120.0).contains(&row.rate)), "{rows:?}");
        }
        let shares = node_shares(&state);
        assert_eq!((shares[0].start, shares[2].end), (0.0, 1.0));
        assert!(shares.windows(2).all(|pair| pair[0].end == pair[1].start));
        let rows = node_rows(&state, state.head());
        assert!(rows[0].done > rows[1].done && rows[1].done > rows[2].done, "{rows:?}");
        assert_eq!(rows.iter().map(|row| row.done).sum::<u32>(), 90);
        let rates: f64 = rows.iter().map(|row| row.rate).sum();
        let seconds = state.finished().expect("the end").secs();
        assert!((rates * seconds - 90.0).abs() < 1e-6, "{rates} atoms a second for {seconds} s");
    }

    #[test]
    fn row_counts_the_time_in_which_its_machine_stood_still() {
        let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0], 90));
        let mut apply = |secs, kind| state.apply(&Record { at: Time::from_secs(secs), kind });
        apply(1.0, RecordKind::Paused { node: 0 });
        apply(2.0, RecordKind::SpeedSet { node: 0, speed: 0.0 });
        apply(3.0, RecordKind::Resumed { node: 0 });
        apply(4.0, RecordKind::SpeedSet { node: 0, speed: 0.5 });
        apply(9.0, RecordKind::Paused { node: 0 });
        let stopped = |secs| node_rows(&state, Time::from_secs(secs)).swap_remove(0).stopped;
        assert_eq!([9.0, 10.5].map(stopped), [3.0, 4.5].map(Duration::from_secs_f64));
    }
}
