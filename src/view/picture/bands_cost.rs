//! Bands whose atoms are cheap, and bands whose atoms are costly.

use crate::balance::{NodeId, Scheduler, Strategy};
use crate::view::state::atom_state::AtomState;
use crate::view::state::run_state::RunState;

/// Returns the machines whose bands have the cheapest and the costliest atoms so far, of the machines at full speed.
/// `None` if a run has no equal bands, if too few atoms of any of these bands are traced, or if the bands differ
/// little.
pub fn cheapest_and_costliest(state: &RunState) -> Option<[NodeId; 2]> {
    /// Fewer atoms of a band say little about it: the answer would soon change.
    const MIN_ATOMS: usize = 20;
    const MIN_SHARE: f64 = 0.06;
    /// Least ratio of the costs that is worth a word.
    const MIN_RATIO: f64 = 1.5;
    let has_bands = state.scheduler().is_ring() || *state.scheduler() == Scheduler::Protocol(Strategy::Static);
    if !has_bands {
        return None;
    }
    let bands = state.division().bands(state.nodes().len());
    let mean = |(_, band): &(NodeId, std::ops::Range<u32>)| {
        let atoms = state.atom_states().get(band.start as usize..band.end as usize)?;
        let (mut traced, mut sum) = (0, 0.0);
        for atom in atoms {
            if let AtomState::Traced { cost, .. } = atom {
                traced += 1;
                sum += f64::from(*cost);
            }
        }
        let is_enough = traced >= MIN_ATOMS.max((MIN_SHARE * band.len() as f64) as usize);
        is_enough.then(|| sum / traced as f64)
    };
    let is_at_full_speed = |(node, _): &(NodeId, std::ops::Range<u32>)| {
        let of = &state.nodes()[usize::from(*node)];
        of.speed > 0.995 && of.runs()
    };
    let fast = (0..).zip(bands).filter(is_at_full_speed);
    let means = fast.map(|band| Some((band.0, mean(&band)?))).collect::<Option<Vec<(NodeId, f64)>>>()?;
    let by_cost = |one: &&(NodeId, f64), other: &&(NodeId, f64)| one.1.total_cmp(&other.1);
    let (cheapest, costliest) = (means.iter().min_by(by_cost)?, means.iter().max_by(by_cost)?);
    (costliest.1 > MIN_RATIO * cheapest.1).then_some([cheapest.0, costliest.0])
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::record::{Record, RecordKind};
    use crate::time::Time;
    use crate::view::tests::sample_runs;

    #[test]
    fn bands_are_compared_once_enough_of_them_is_traced() {
        let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0, 0.1], 90));
        let mut trace = |node: NodeId, atoms: std::ops::Range<u32>, ms| {
            for atom in atoms {
                let kind = RecordKind::AtomDone { node, atom, cost: Duration::from_millis(ms) };
                state.apply(&Record { at: Time::ZERO, kind });
            }
            cheapest_and_costliest(&state)
        };
        assert_eq!(trace(0, 0..25, 1), None);
        assert_eq!(trace(2, 60..85, 9), None, "a slow machine is slow for another reason");
        assert_eq!(trace(1, 30..45, 3), None, "too few");
        assert_eq!(trace(1, 45..55, 3), Some([0, 1]));
    }
}
