//! A random run made from a seed: machines, costs of atoms, a network, and injected failures.

use std::time::Duration;

use fastrand::Rng;

use super::super::random::uniform;
use crate::balance::{Condition, NodeId, Party, Rules, Strategy};
use crate::picture::Size;
use crate::runlog::{Driver, Header};
use crate::scenario::{Command, Script};
use crate::time::Time;

/// Pixels in an atom: each row of the picture is an atom.
const ATOM_PX: u32 = 50;

/// Least speed of a machine that does not stand still.
const MIN_SPEED: f64 = 1e-3;

/// A random run.
#[derive(Clone, Debug)]
pub(super) struct ChaosPlan {
    pub header: Header,
    pub script: Script,
    /// CPU time by atom.
    pub costs: Vec<Duration>,
    /// Whether the run has no losses and no changes of speed.
    pub faultless: bool,
}

impl ChaosPlan {
    /// Creates the plan of a seed's run, which is the same on every computer: the same machines, costs and failures for
    /// each strategy.
    pub fn new(seed: u64, strategy: Strategy) -> Self {
        let mut rng = Rng::with_seed(seed);
        let nodes = *pick(&mut rng, &[1, 2, 3, 4, 5, 6, 8, 12, 24]);
        let atoms = 10f64.powf(uniform(&mut rng, 0.0, 2.6)) as u32;
        // Where nothing is lost, no machine may be so slow that it seems stuck.
        let faultless = rng.u32(0..8) == 0;
        let mean = 10f64.powf(uniform(&mut rng, -5.0, if faultless { -3.0 } else { -2.3 }));
        let costs =
            (0..atoms).map(|_| Duration::from_secs_f64(mean * 10f64.powf(uniform(&mut rng, -1.0, 1.0)))).collect();
        let speeds: Vec<f64> = (0..nodes).map(|_| speed(&mut rng, if faultless { 0.2 } else { MIN_SPEED })).collect();
        let mut header = plain(atoms, strategy, speeds);
        let batches = [None, Some(Duration::ZERO), Some(Rules::BATCH), Some(5 * Rules::BATCH)];
        header.rules.batch = *pick(&mut rng, &batches);
        header.link.latency = latency(&mut rng, faultless);
        if rng.u32(0..4) == 0 {
            // For the same reason a whole picture's results must not delay a message too long.
            let slowest = if faultless { 6.5 } else { 5.0 };
            let bandwidth = Some(10f64.powf(uniform(&mut rng, slowest, 8.0)));
            (header.link.bandwidth, header.link.shared) = (bandwidth, rng.bool());
            let longest = if faultless { 100 } else { 500 };
            header.handling = Duration::from_micros(rng.u64(0..longest));
        }
        header.rules.beat = Rules::beat_for(header.handling, nodes);
        if rng.u32(0..4) == 0 && nodes > 1 {
            header.spares = rng.u16(0..nodes as NodeId / 2 + 1);
        }
        let mut plan = Self { header, script: Vec::new(), costs, faultless };
        if !faultless {
            plan.inject_failures(&mut rng);
        }
        plan
    }

    /// Returns the time that all machines together need at their first speeds.
    pub fn ideal(&self) -> Duration {
        self.costs.iter().sum::<Duration>().div_f64(self.header.speeds.iter().sum::<f64>())
    }

    /// Injects failures and changes. At the end at least one machine works again, so that the run can finish.
    fn inject_failures(&mut self, rng: &mut Rng) {
        let nodes = self.header.speeds.len() as NodeId;
        // Long enough for losses to be detected.
        let span = (self.ideal().as_secs_f64() * 3.0).max(2.0);
        let at = |rng: &mut Rng, from: f64| Time::from_secs(uniform(rng, from, span));
        let mut script = Script::new();
        for _ in 0..rng.u32(1..=12) {
            let node = rng.u16(0..nodes);
            let begins = at(rng, 0.0);
            let ends = at(rng, begins.secs());
            let condition = *pick(rng, &[Condition::Hung, Condition::CutOff, Condition::Off]);
            match rng.u32(0..9) {
                // It joins late.
                0 => {
                    script.push((Time::ZERO, Command::Condition { node, condition: Condition::Off }));
                    script.push((ends, Command::Condition { node, condition: Condition::Well }));
                }
                1 | 2 => {
                    script.push((begins, Command::Condition { node, condition }));
                    script.push((ends, Command::Condition { node, condition: Condition::Well }));
                }
                // It is lost for good.
                3 => script.push((begins, Command::Condition { node, condition })),
                4 => {
                    let (one, other) = (Party::Node(node), party(rng, nodes));
                    script.push((begins, Command::Link { one, other, cut: true }));
                    if rng.bool() {
                        script.push((ends, Command::Link { one, other, cut: false }));
                    }
                }
                5 => {
                    let by = Duration::from_secs_f64(10f64.powf(uniform(rng, -3.0, 1.0)));
                    let (one, other) = (Party::Node(node), party(rng, nodes));
                    let (from, to) = if rng.bool() { (one, other) } else { (other, one) };
                    script.push((begins, Command::Delay { from, to, by }));
                }
                6 => script.push((begins, Command::Latency(latency(rng, false)))),
                7 => {
                    script.push((begins, Command::Speed { node, speed: 0.0 }));
                    script.push((ends, Command::Speed { node, speed: speed(rng, MIN_SPEED) }));
                }
                _ => script.push((begins, Command::Speed { node, speed: speed(rng, MIN_SPEED) })),
            }
        }
        let (node, end) = (rng.u16(0..nodes), Time::from_secs(span));
        script.push((end, Command::Condition { node, condition: Condition::Well }));
        script.push((end, Command::Speed { node, speed: uniform(rng, 0.1, 1.0) }));
        script.push((end, Command::Link { one: Party::Node(node), other: Party::Parent, cut: false }));
        script.sort_by_key(|(at, _)| *at);
        self.script = script;
    }
}

fn plain(atoms: u32, strategy: Strategy, speeds: Vec<f64>) -> Header {
    // No side is 0, and the picture is small.
    let size = Size::new(ATOM_PX, atoms.max(1)).expect("a small picture");
    Header { driver: Driver::Sim, ..Header::plain(size, ATOM_PX, strategy, speeds) }
}

/// Picks a node or the parent.
fn party(rng: &mut Rng, nodes: NodeId) -> Party {
    match rng.u16(0..=nodes) {
        last if last == nodes => Party::Parent,
        node => Party::Node(node),
    }
}

fn latency(rng: &mut Rng, faultless: bool) -> Duration {
    // Where nothing is lost, no message may take so long that it seems lost.
    let longest = if faultless { -2.5 } else { -0.7 };
    if rng.u32(0..4) == 0 { Duration::ZERO } else { Duration::from_secs_f64(10f64.powf(uniform(rng, -5.0, longest))) }
}

fn speed(rng: &mut Rng, slowest: f64) -> f64 {
    if rng.bool() { 1.0 } else { slowest.powf(rng.f64()) }
}

fn pick<'a, T>(rng: &mut Rng, choices: &'a [T]) -> &'a T {
    &choices[rng.usize(0..choices.len())]
}
