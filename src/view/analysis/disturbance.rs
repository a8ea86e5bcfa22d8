//! How much of their time machines have lost because this computer was busy with other things.

use crate::balance::{NodeId, Party};
use crate::language::{Language, say};
use crate::record::RecordKind;
use crate::runlog::{Driver, RunLog};
use crate::time::Time;
use crate::view::state::run_state::RunState;
use crate::view::text::format::fraction;

/// Returns the share of their time that the machines have lost to other work of this computer, 0 to 1:
/// 1 − Σ costs / ∫ min(Σ speed × pace, cores) dt, where the sum is over the machines that have atoms and are not
/// stopped. An undisturbed machine with atoms spends speed × pace CPU seconds a second; machines that together want
/// more cores than there are hold each other up, which does not count. 0 in virtual time.
pub fn disturbance(log: &RunLog) -> f64 {
    let header = &log.header;
    if header.driver == Driver::Sim {
        return 0.0;
    }
    let mut state = RunState::new(header);
    let mut rates = vec![0.0; header.speeds.len()];
    let (mut now, mut wanted, mut spent) = (Time::ZERO, 0.0, 0.0);
    for record in log.records() {
        let rate: f64 = rates.iter().sum();
        wanted += rate.min(header.cores as f64) * record.at.since(now).as_secs_f64();
        now = now.max(record.at);
        state.apply(record);
        if let RecordKind::AtomDone { cost, .. } = &record.kind {
            spent += cost.as_secs_f64();
        }
        for node in changed_nodes(&record.kind).into_iter().flatten() {
            if let (Some(rate), Some(node)) = (rates.get_mut(usize::from(node)), state.nodes().get(usize::from(node))) {
                *rate = if node.computes() { (node.speed * header.pace).min(1.0) } else { 0.0 };
            }
        }
    }
    if wanted > 0.0 { (1.0 - spent / wanted).max(0.0) } else { 0.0 }
}

/// Returns the nodes whose number of atoms, speed or condition a record can change.
fn changed_nodes(kind: &RecordKind) -> [Option<NodeId>; 2] {
    let node = |party: &Party| if let Party::Node(node) = party { Some(*node) } else { None };
    match kind {
        RecordKind::Sent { from, to, .. } => [node(from), node(to)],
        RecordKind::Received { by, .. } => [node(by), None],
        RecordKind::AtomStarted { node, .. }
        | RecordKind::AtomDone { node, .. }
        | RecordKind::AtomFailed { node, .. }
        | RecordKind::SpeedSet { node, .. }
        | RecordKind::Paused { node }
        | RecordKind::Resumed { node }
        | RecordKind::Condition { node, .. }
        | RecordKind::Retired { node } => [Some(*node), None],
        RecordKind::Estimating
        | RecordKind::Estimated { .. }
        | RecordKind::Link { .. }
        | RecordKind::Delayed { .. }
        | RecordKind::Lost { .. }
        | RecordKind::LatencySet { .. }
        | RecordKind::OwnLatencySet { .. }
        | RecordKind::Finished
        | RecordKind::GivenUp { .. } => [None, None],
    }
}

/// Says that a disturbance has spoiled the times of a run; `None` if it is too small.
pub fn disturbance_words(disturbance: f64, language: Language) -> Option<String> {
    /// Least share that is said. An undisturbed run loses less to its own messages and to the drawing of the window.
    const LEAST_SHARE: f64 = 0.1;
    let share = fraction(disturbance);
    (disturbance >= LEAST_SHARE).then(|| {
        say!(
            language,
            "This computer was busy: other work took {share} of the machines' time, so time and efficiency are worse",
            "Este computador estava ocupado: outro trabalho tomou {share} do tempo das máquinas; por isso tempo e \
            eficiência são piores"
        )
    })
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::record::Record;
    use crate::runlog::Header;
    use crate::view::tests::sample_runs;

    /// A run of two machines on threads, as the simulator makes it. After `at` seconds everything stands still for
    /// `length` seconds, as the clock goes on.
    fn held_up(at: f64, length: f64) -> RunLog {
        let virtual_header = sample_runs::header(&[1.0, 0.5], 300);
        let header = Header { driver: Driver::Threads, ..virtual_header.clone() };
        let late = |record: Record| {
            let by = if record.at.secs() > at { Duration::from_secs_f64(length) } else { Duration::ZERO };
            Record { at: record.at + by, ..record }
        };
        let mut log = RunLog::new(header);
        log.add(sample_runs::records(&virtual_header).into_iter().map(late).collect());
        log
    }

    #[test]
    fn time_in_which_all_machines_stand_still_is_lost() {
        let whole = held_up(0.0, 0.0);
        // Two machines, 3 s of work at 0.15 of a core.
        let length = whole.records().last().expect("records").at.secs();
        assert!(disturbance(&whole) < 0.01, "{}", disturbance(&whole));
        let held_up = disturbance(&held_up(0.5, length));
        assert!((held_up - 0.5).abs() < 0.03, "half of the time is lost: {held_up}");
        assert_eq!(disturbance(&sample_runs::log(&[1.0, 0.5], 300)), 0.0);
    }

    #[test]
    fn machines_that_share_the_cores_do_not_disturb_each_other() {
        let atoms = |at: f64, node, atom, ends: bool| {
            let cost = Duration::from_secs(1);
            let kind =
                if ends { RecordKind::AtomDone { node, atom, cost } } else { RecordKind::AtomStarted { node, atom } };
            Record { at: Time::from_secs(at), kind }
        };
        // Two machines at full speed on one core: each atom takes twice its cost.
        let plain = sample_runs::header(&[1.0, 1.0], 2);
        let header = Header { driver: Driver::Threads, pace: 1.0, cores: 1, ..plain.clone() };
        let bands: Vec<_> = sample_runs::records(&plain)
            .into_iter()
            .take_while(|record| !matches!(record.kind, RecordKind::AtomStarted { .. }))
            .map(|record| Record { at: Time::ZERO, ..record })
            .collect();
        let disturbed = |end: f64| {
            let mut log = RunLog::new(header.clone());
            log.add(bands.clone());
            log.add(vec![atoms(0.0, 0, 0, false), atoms(0.0, 1, 1, false)]);
            log.add(vec![atoms(end, 0, 0, true), atoms(end, 1, 1, true)]);
            disturbance(&log)
        };
        assert!(disturbed(2.0) < 1e-9, "{}", disturbed(2.0));
        assert!((disturbed(4.0) - 0.5).abs() < 1e-9, "another program had the core half of the time");
    }

    #[test]
    fn small_disturbances_are_not_said() {
        assert_eq!(disturbance_words(0.04, Language::English), None);
        let said = disturbance_words(0.234, Language::English).unwrap_or_default();
        assert!(said.contains("other work took 23 % of the machines' time"), "{said}");
    }
}
