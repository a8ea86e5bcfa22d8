//! The cases of the study: machines, and the failures injected.

use std::time::Duration;

use crate::balance::{Condition, NodeId};
use crate::scenario::{Command, Script, square_wave};
use crate::time::Time;

/// Speed of the slow machine: about the article's.
const SLOW_SPEED: f64 = 0.14;
/// Speed of a throttled machine.
const THROTTLED_SPEED: f64 = 0.01;
/// The machine that fails or changes.
const FAILING_NODE: NodeId = 1;

/// One case.
pub(super) struct RemedyCase {
    pub name: String,
    /// What happens to which machine, for the report.
    pub about: String,
    pub speeds: Vec<f64>,
    /// Number of machines that are off at first.
    pub spares: NodeId,
    /// Whether nearly all the work is in one corner of the picture.
    pub work_in_corner: bool,
    /// Returns the script for a run in which all machines together need the given time.
    pub script: Box<dyn Fn(Duration) -> Script>,
    /// The greatest makespan / bound that counts as good.
    pub aim: f64,
}

/// Returns the case of unequal machines of which one is throttled in mid-run: for rayon, which tolerates no losses.
pub(super) fn throttled() -> RemedyCase {
    let about = "machines at 100, 70, 40 and 100 %; the second falls to 1 % at 30 % of the run";
    let script = at(0.3, Command::Speed { node: FAILING_NODE, speed: THROTTLED_SPEED });
    RemedyCase { speeds: vec![1.0, 0.7, 0.4, 1.0], script, ..plain("unequal, throttled", about, 1.05) }
}

/// Returns a case of four equal machines without failures.
fn plain(name: &str, about: &str, aim: f64) -> RemedyCase {
    let script = Box::new(|_| Script::new());
    RemedyCase {
        name: name.into(),
        about: about.into(),
        speeds: vec![1.0; 4],
        spares: 0,
        work_in_corner: false,
        script,
        aim,
    }
}

/// Returns a script with one command, given when the fraction `part` of the run is over.
fn at(part: f64, command: Command) -> Box<dyn Fn(Duration) -> Script> {
    Box::new(move |run| vec![(Time::ZERO + run.mul_f64(part), command)])
}

/// Returns all cases.
pub(super) fn cases() -> Vec<RemedyCase> {
    let with = |name: &str, about: &str, script: Box<dyn Fn(Duration) -> Script>| RemedyCase {
        script,
        ..plain(name, about, 1.05)
    };
    let speed = |speed| Command::Speed { node: FAILING_NODE, speed };
    let become_condition = |condition| Command::Condition { node: FAILING_NODE, condition };
    let mut cases = vec![plain("equal", "four equal machines", 1.01)];
    cases.extend((0..5).map(|place| {
        let mut speeds = vec![1.0; 4];
        speeds.insert(place, SLOW_SPEED);
        let name = format!("slow fifth, place {}", place + 1);
        RemedyCase { name, speeds, ..plain("", "a fifth machine at 14 % of the speed of four equal ones", 1.02) }
    }));
    cases.extend([
        with(
            "1 % at 30 %",
            "one of four machines falls to 1 % of its speed at 30 % of the run",
            at(0.3, speed(THROTTLED_SPEED)),
        ),
        with("1 % at 90 %", "the same at 90 % of the run", at(0.9, speed(THROTTLED_SPEED))),
        with("1 % at the end", "the same when the other machines have no work left", at(0.998, speed(THROTTLED_SPEED))),
        with("0 % at 30 %", "one of four machines stands still from 30 % of the run on", at(0.3, speed(0.0))),
        with("0 % at 90 %", "the same at 90 % of the run", at(0.9, speed(0.0))),
        with(
            "killed at 50 %",
            "one of four machines is switched off at 50 % of the run",
            at(0.5, become_condition(Condition::Off)),
        ),
        with(
            "hung at 50 %",
            "one of four machines hangs for good at 50 % of the run",
            at(0.5, become_condition(Condition::Hung)),
        ),
        with(
            "cut off at 50 %",
            "one of four machines is cut off at 50 % of the run",
            at(0.5, become_condition(Condition::CutOff)),
        ),
        with(
            "killed and back",
            "one of four machines is switched off at 30 % of the run and restarts at 60 %",
            Box::new(move |run| {
                [(0.3, Condition::Off), (0.6, Condition::Well)]
                    .map(|(part, condition)| (Time::ZERO + run.mul_f64(part), become_condition(condition)))
                    .to_vec()
            }),
        ),
        RemedyCase {
            speeds: vec![1.0; 5],
            spares: 1,
            script: at(0.3, Command::Condition { node: 4, condition: Condition::Well }),
            ..plain("joined at 30 %", "a fifth equal machine joins four at 30 % of the run", 1.05)
        },
        RemedyCase {
            work_in_corner: true,
            ..plain("corner", "nearly all the work in one corner of the picture", 1.05)
        },
        with(
            "square wave",
            "the speed of one of four machines swings between 100 % and 5 %, ten times in the run",
            Box::new(|run| square_wave(FAILING_NODE, 1.0, 0.05, run / 10, Time::ZERO + run * 20)),
        ),
    ]);
    cases
}
