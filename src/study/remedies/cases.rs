//! What befalls a ring, in each of the cases that are measured.

use std::time::Duration;

use crate::balance::{Condition, NodeId};
use crate::scenario::{Command, Script, square_wave};
use crate::time::Time;

/// The speed of the slow machine: about the article's.
const SLOW: f64 = 0.14;
/// What a machine is throttled to.
const THROTTLED: f64 = 0.01;
/// The machine that things happen to.
const VICTIM: NodeId = 1;

/// One case.
pub(super) struct RemedyCase {
    pub name: String,
    /// What befalls whom, for the report.
    pub about: String,
    pub speeds: Vec<f64>,
    /// Machines that are off at first.
    pub spares: NodeId,
    /// Whether nearly all the work is in one corner of the picture.
    pub corner: bool,
    /// What is done, if all machines together would take so long.
    pub script: Box<dyn Fn(Duration) -> Script>,
    /// The most that the time over the bound should be.
    pub aim: f64,
}

/// Unequal machines, of which one is throttled in mid-run: for rayon, which knows no losses.
pub(super) fn throttled() -> RemedyCase {
    let about = "machines at 100, 70, 40 and 100 %, of which the second falls to 1 % at 30 % of the run";
    let script = at(0.3, Command::Speed { node: VICTIM, speed: THROTTLED });
    RemedyCase { speeds: vec![1.0, 0.7, 0.4, 1.0], script, ..plain("unequal, throttled", about, 1.05) }
}

/// Four equal machines to which nothing happens.
fn plain(name: &str, about: &str, aim: f64) -> RemedyCase {
    let script = Box::new(|_| Script::new());
    RemedyCase { name: name.into(), about: about.into(), speeds: vec![1.0; 4], spares: 0, corner: false, script, aim }
}

/// One thing that is done when so much of the run is over.
fn at(part: f64, command: Command) -> Box<dyn Fn(Duration) -> Script> {
    Box::new(move |run| vec![(Time::ZERO + run.mul_f64(part), command)])
}

/// All of them.
pub(super) fn cases() -> Vec<RemedyCase> {
    let with = |name: &str, about: &str, script: Box<dyn Fn(Duration) -> Script>| RemedyCase {
        script,
        ..plain(name, about, 1.05)
    };
    let speed = |speed| Command::Speed { node: VICTIM, speed };
    let put = |condition| Command::Condition { node: VICTIM, condition };
    let mut cases = vec![plain("equal", "four equal machines", 1.01)];
    cases.extend((0..5).map(|place| {
        let mut speeds = vec![1.0; 4];
        speeds.insert(place, SLOW);
        let name = format!("slow fifth, place {}", place + 1);
        RemedyCase { name, speeds, ..plain("", "a fifth machine at 14 % of the speed of four equal ones", 1.02) }
    }));
    cases.extend([
        with("1 % at 30 %", "one of four falls to 1 % of its speed at 30 % of the run", at(0.3, speed(THROTTLED))),
        with("1 % at 90 %", "the same at 90 %", at(0.9, speed(THROTTLED))),
        with("1 % at the end", "the same when others have nothing to do any more", at(0.998, speed(THROTTLED))),
        with("0 % at 30 %", "one of four stands still from 30 % of the run on", at(0.3, speed(0.0))),
        with("0 % at 90 %", "the same at 90 %", at(0.9, speed(0.0))),
        with("killed at 50 %", "one of four is switched off at half of the run", at(0.5, put(Condition::Off))),
        with("hung at 50 %", "it hangs instead, for good", at(0.5, put(Condition::Hung))),
        with("cut off at 50 %", "it is cut off instead", at(0.5, put(Condition::CutOff))),
        with(
            "killed and back",
            "one of four is switched off at 30 % and begins anew at 60 %",
            Box::new(move |run| {
                [(0.3, Condition::Off), (0.6, Condition::Well)]
                    .map(|(part, condition)| (Time::ZERO + run.mul_f64(part), put(condition)))
                    .to_vec()
            }),
        ),
        RemedyCase {
            speeds: vec![1.0; 5],
            spares: 1,
            script: at(0.3, Command::Condition { node: 4, condition: Condition::Well }),
            ..plain("joined at 30 %", "a fifth equal machine joins four at 30 % of the run", 1.05)
        },
        RemedyCase { corner: true, ..plain("corner", "nearly all the work in one corner of the picture", 1.05) },
        with(
            "square wave",
            "one of four swings between full speed and a twentieth, ten times in the run",
            Box::new(|run| square_wave(VICTIM, 1.0, 0.05, run / 10, Time::ZERO + run * 20)),
        ),
    ]);
    cases
}
