//! Tests of the status of the article's ring, and of runs that hang.

use super::deadlock::{deadlock_words, recovering_scheduler};
use super::incomplete::unfinished_words;
use super::status_sentence;
use crate::balance::{Condition, Message, NodeId, Party, Scheduler, Strategy};
use crate::language::Language;
use crate::record::{Record, RecordKind};
use crate::scenario::Command;
use crate::sim::Sim;
use crate::time::Time;
use crate::view::state::atom_state::AtomState;
use crate::view::state::node_rows::node_rows;
use crate::view::state::run_state::RunState;
use crate::view::tests::sample_runs;

/// Atoms left, and speed.
type Left = (u32, f64);
const PAUSED: f64 = -1.0;

/// A run in which machines have these atoms left, at these speeds.
fn run(machines: &[Left], retired: &[NodeId]) -> RunState {
    let mut state = RunState::new(&sample_runs::header(&vec![1.0; machines.len()], 900));
    let mut apply = |kind| state.apply(&Record { at: Time::ZERO, kind });
    for ((id, node), &(left, speed)) in (0..).zip(0..).zip(machines) {
        let (to, message) = (Party::Node(node), Message::Band(100 * id as u32..100 * id as u32 + left));
        let (from, at) = (Party::Parent, Time::ZERO);
        apply(RecordKind::Sent { id, from, to, message, bytes: 0, arrives: at });
        apply(RecordKind::Received { id, by: to });
        apply(if speed == PAUSED { RecordKind::Paused { node } } else { RecordKind::SpeedSet { node, speed } });
    }
    retired.iter().for_each(|&node| apply(RecordKind::Retired { node }));
    state
}

/// The status of that run.
fn status(machines: &[Left], retired: &[NodeId], language: Language) -> String {
    let words = status_sentence(&run(machines, retired), language);
    assert!(words.chars().count() <= 105, "{} characters: {words}", words.chars().count());
    words
}

#[test]
fn only_computing_machines_are_counted() {
    let language = Language::English;
    assert_eq!(status(&[(5, 1.0), (5, 1.0), (5, 1.0)], &[], language), "All 3 machines compute their own atoms");
    assert_eq!(status(&[(0, 1.0), (5, 1.0), (9, 1.0)], &[], language), "2 of 3 machines compute; 3 has the most left");
    assert_eq!(status(&[(9, 1.0), (0, 1.0), (0, 1.0)], &[], language), "Only 1 still computes: 9 atoms left");
    assert_eq!(status(&[(9, 1.0)], &[], language), "The only machine computes: 9 atoms left");
    assert_eq!(status(&[(0, 1.0), (0, 1.0)], &[], language), "The machines wait for the parent");
    assert_eq!(
        status(&[(5, 1.0), (5, 1.0), (9, 0.1)], &[], language),
        "All 3 machines compute; 3 is slow (10 %) and has the most left: 9 atoms"
    );
}

#[test]
fn machine_that_stands_still_gives_away_its_queue_but_not_its_pipe() {
    let language = Language::English;
    let others = [(5, 1.0), (5, 1.0)];
    let status = |left, speed| status(&[others[0], others[1], (left, speed)], &[], language);
    let two = "2 of 3 machines compute; 3";
    let first = "no offer reaches it, because 1 answers first";
    assert_eq!(status(50, PAUSED), format!("3 has been paused since the beginning with 50 atoms: {first}"));
    assert_eq!(status(50, 0.0), format!("3 has been stopped since the beginning with 50 atoms: {first}"));
    assert_eq!(status(2, PAUSED), format!("{two} is paused and keeps the 2 atoms in its pipe"));
    assert_eq!(status(1, 0.0), format!("{two} is stopped (0 %) and keeps the atom in its pipe"));
}

#[test]
fn machines_that_stand_still_are_named_together() {
    let language = Language::English;
    let status = |left| status(&[(5, 1.0), (left, PAUSED), (left, 0.0)], &[], language);
    // An offer of 1 goes to 3, which answers it first.
    assert_eq!(
        status(40),
        "2 has been paused since the beginning with 40 atoms: no offer reaches it, because 3 answers first"
    );
    assert_eq!(status(2), "Only 1 computes; 2 and 3 stand still and keep the atoms in their pipes");
}

#[test]
fn retired_machines_do_not_help() {
    let language = Language::English;
    assert_eq!(
        status(&[(0, 1.0), (0, 1.0), (0, 1.0), (0, 1.0), (40, 0.05)], &[0, 1, 2, 3], language),
        "5 still has 40 atoms, but 1, 2, 3 and 4 have retired: a retired machine offers no more help"
    );
    assert_eq!(
        status(&[(0, 1.0), (40, 1.0)], &[0], language),
        "2 still has 40 atoms, but 1 has retired: a retired machine offers no more help"
    );
    assert_eq!(status(&[(0, 1.0), (0, 1.0), (40, 1.0)], &[0], language), "Only 3 still computes: 40 atoms left");
    assert_eq!(
        status(&[(0, 1.0), (3, 1.0), (40, 0.1)], &[0], language),
        "2 of 3 machines compute; 3 has the most left, 40 atoms, but 1 has retired and will not help"
    );
}

#[test]
fn last_atoms_are_in_a_pipe() {
    let language = Language::English;
    let why = "atoms in a pipe are never given away";
    for retired in [&[][..], &[0]] {
        let status = |left| status(&[(0, 1.0), (left, 0.01)], retired, language);
        assert_eq!(status(2), format!("Only 2 still computes: its last 2 atoms are in its pipe, and {why}"));
        assert_eq!(status(1), format!("Only 2 still computes, its last atom: {why}"));
    }
}

#[test]
fn ring_that_stands_still_says_why_and_what_helps() {
    let language = Language::English;
    let alone = |left, speed, retired: &[NodeId]| status(&[(left, speed), (0, 1.0), (0, 1.0)], retired, language);
    let pipe = "are in its pipe and stay there";
    assert_eq!(alone(2, 0.0, &[]), format!("Machine 1 is stopped (0 %); its last 2 atoms {pipe}: raise its speed"));
    assert_eq!(alone(2, PAUSED, &[1, 2]), format!("Machine 1 is paused; its last 2 atoms {pipe}: resume it"));
    assert!(alone(1, PAUSED, &[]).starts_with("Machine 1 is paused; its last atom is in its pipe"));
    assert_eq!(
        alone(90, 0.0, &[1, 2]),
        "Machine 1 is stopped (0 %) with 90 atoms, and nobody offers help any more: raise its speed"
    );
    assert_eq!(alone(90, PAUSED, &[1]), "Machine 1 is paused with 90 atoms: the others offer to take them");
    assert_eq!(
        status(&[(2, 0.0), (1, PAUSED), (0, 1.0)], &[2], language),
        "2 machines stand still with 3 atoms, and nobody can take them: resume them, or raise their speeds"
    );
    assert_eq!(
        status(&[(20, 0.0), (2, 0.0), (0, 1.0)], &[], language),
        "2 machines stand still with 22 atoms: the others offer to take them"
    );
}

#[test]
fn all_machines_stand_still() {
    let language = Language::English;
    assert!(status(&[(5, 0.0), (5, 0.0)], &[], language).starts_with("All machines are stopped (0 %): raise a speed"));
    assert!(status(&[(5, PAUSED), (5, PAUSED)], &[], language).starts_with("All machines are paused: resume one"));
    assert!(
        status(&[(5, PAUSED), (5, 0.0)], &[], language)
            .starts_with("All machines stand still: raise a speed or resume")
    );
    assert_eq!(status(&[(5, PAUSED)], &[], language), "The only machine is paused: resume it");
}

/// The last state of a run by `strategy` in which machine 2 gets this condition at 0.5 s.
fn end(strategy: Strategy, condition: Condition, language: Language) -> RunState {
    let mut header = sample_runs::header(&[1.0; 3], 300);
    header.rules.strategy = strategy.clone();
    let script = [(Time::from_secs(0.5), Command::Condition { node: 1, condition })];
    let mut state = RunState::new(&header);
    let mut before = 0;
    Sim::new(&header, &script, |_| sample_runs::COST).run(&mut |record| {
        state.apply(&record);
        before += usize::from(record.at.secs() < 0.7 && deadlock_words(&state, language).is_some());
    });
    assert_eq!(before, 0, "others go on: {strategy} {condition:?}");
    state
}

#[test]
fn run_that_hangs_says_why_and_which_strategy_recovers() {
    let language = Language::English;
    let remedy = "the article's ring cannot recover, the adaptive ring can";
    for (condition, why) in
        [(Condition::Off, "2 is off"), (Condition::Hung, "2 hangs"), (Condition::CutOff, "2 is cut off")]
    {
        let state = end(Strategy::Ring, condition, language);
        let lost = state.atom_states().iter().filter(|place| **place == AtomState::Lost).count();
        let why = if lost > 0 { format!("{why} and {lost} atoms are lost") } else { why.to_owned() };
        assert_eq!(status_sentence(&state, language), format!("The run hangs because {why}: {remedy}"));
        assert_eq!(recovering_scheduler(&state), Some(Scheduler::Protocol(Strategy::Adaptive)));
        let rows = node_rows(&state, state.head());
        // Atoms in messages are lost too.
        assert_eq!((rows[1].lost > 0, rows[1].lost as usize <= lost), (condition == Condition::Off, true));
        let words = unfinished_words(&state, language);
        assert!(
            words.starts_with("The record ends here, with ") && words.ends_with(&format!("{why}; {remedy}")),
            "{words}"
        );
    }
    let words = status_sentence(&end(Strategy::Static, Condition::Off, language), language);
    assert!(words.ends_with("atoms are lost: the adaptive ring and the farm with leases can recover"), "{words}");
    let state = end(Strategy::Farm, Condition::Off, language);
    let words = status_sentence(&state, language);
    assert!(words.ends_with(": this farm cannot recover, the farm with leases can"), "{words}");
    assert_eq!(recovering_scheduler(&state), Some(Scheduler::Protocol(Strategy::FarmLeases)));
    for strategy in [Strategy::FarmLeases, Strategy::Adaptive] {
        assert!(end(strategy, Condition::Off, language).finished().is_some());
    }
}
