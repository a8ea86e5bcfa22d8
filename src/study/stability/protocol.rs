//! The protocol under failing machines and networks, in virtual time.

use std::time::Duration;

use fastrand::Rng;

use super::super::random::uniform;
use super::{MethodResult, StabilityCase, powers_of_2};
use crate::balance::{Message, NodeId, Party, Rules, Strategy};
use crate::picture::Size;
use crate::record::RecordKind;
use crate::runlog::{Driver, Header, LinkSettings, Metrics};
use crate::scenario::{Command, Script, square_wave};
use crate::sim::Sim;
use crate::study::fixture::{AtomCosts, weighted_costs};
use crate::time::Time;
use crate::view::Scale;

const STRATEGIES: [Strategy; 3] = [Strategy::Static, Strategy::Farm, Strategy::Ring];
pub(super) const METHODS: &[&str] = &["static", "farm", "ring"];

const NODES: usize = 8;
const ATOMS: u32 = 1024;
/// Mean cost of an atom.
const ATOM_COST: Duration = Duration::from_millis(2);
/// Time that all nodes together need at full speed.
const IDEAL_TIME: Duration = Duration::from_millis(2 * ATOMS as u64 / NODES as u64);
/// Latency of a message where a case does not set it.
const LATENCY: Duration = Duration::from_micros(100);

pub(super) fn cases() -> [StabilityCase; 5] {
    let case = |name, title, about, parameter, values: Vec<f64>, scale, attempt| StabilityCase {
        name,
        title,
        about,
        parameter,
        required: values.last().copied().unwrap_or_default(),
        values,
        scale,
        methods: METHODS,
        measured_figure: Some("makespan / ideal, the worst run"),
        tries: 10,
        attempt,
    };
    [
        case(
            "swing",
            "Machines whose speed swings",
            "Each of eight machines swings between full speed and a twentieth, with its own period near the given \
             one; every other machine begins slow. The ideal time accounts for every swing.",
            "period over the time at full speed",
            powers_of_2(-6, 4),
            Scale::Log2,
            swing,
        ),
        case(
            "stop",
            "A machine that stops",
            "One of eight machines stands at 0 % for a while, in half of the runs from the start, in the others from \
             some point in the first half of the run. The two atoms in its pipe cannot be taken back, so that every \
             strategy waits until the machine goes on, and would wait for ever if it never did. In a ring all its \
             other atoms leave it when other machines offer help.",
            "stop over the time of all at full speed",
            powers_of_2(-6, 3),
            Scale::Log2,
            stop,
        ),
        case(
            "crowd",
            "More machines than atoms",
            "64 atoms and more and more machines. No strategy needs less than the time of the dearest atom; where \
             that is longer, it counts as the ideal time, here and below. Where a machine has two atoms, both are in \
             its pipe, and a ring has nothing to give.",
            "machines per atom",
            powers_of_2(-3, 4),
            Scale::Log2,
            crowd,
        ),
        case(
            "corner",
            "All the work in one corner",
            "Of 1,024 atoms, some neighbouring ones at a random place in the picture cost 999/1000 of all the work; \
             in the end it is one atom. Where a pipe holds two dear atoms, the second waits for the first.",
            "share of the atoms that hold the work",
            powers_of_2(0, -10),
            Scale::Log2,
            corner,
        ),
        case(
            "latency",
            "Varying latencies",
            "The latency of all messages changes fifty times within the time of the run, to a random value between a \
             thousandth of the given latency and the whole.",
            "greatest latency over an atom's time",
            powers_of_2(-6, 7),
            Scale::Log2,
            latency,
        ),
    ]
}

/// Runs each strategy `tries` times. `plan` returns, the same for all strategies, the atoms' costs, the number of
/// nodes, and the script.
fn attempt(tries: u32, rng: &mut Rng, plan: impl Fn(u32, &mut Rng) -> (AtomCosts, usize, Script)) -> Vec<MethodResult> {
    let mut results = vec![MethodResult { measured: Some(0.0), ..MethodResult::default() }; STRATEGIES.len()];
    for index in 0..tries {
        let (costs, nodes, script) = plan(index, rng);
        for (strategy, result) in STRATEGIES.into_iter().zip(&mut results) {
            let run = run(strategy, nodes, &script, &costs);
            result.tried += run.tried;
            result.wrong += run.wrong;
            result.measured = result.measured.zip(run.measured).map(|(worst, this)| worst.max(this));
        }
    }
    results
}

/// Simulates a run. Wrong are the atoms not traced and placed exactly once; measured is makespan / ideal.
fn run(strategy: Strategy, nodes: usize, script: &Script, costs: &AtomCosts) -> MethodResult {
    // One atom a row.
    let Ok(size) = Size::new(50, costs.len() as u32) else { return MethodResult::default() };
    let plain = Header::plain(size, 50, strategy, vec![1.0; nodes]);
    let header = Header {
        driver: Driver::Sim,
        link: LinkSettings { latency: LATENCY, ..plain.link },
        rules: Rules { batch: None, ..plain.rules },
        ..plain
    };
    let cost = costs.clone();
    let mut sim = Sim::new(&header, script, move |atom| cost[atom as usize]);
    let (mut traced, mut placed) = (vec![0u32; costs.len()], vec![0u32; costs.len()]);
    let mut metrics = Metrics::new(&header);
    sim.run(&mut |record| {
        match &record.kind {
            RecordKind::AtomDone { atom, .. } => traced[*atom as usize] += 1,
            RecordKind::Sent { to: Party::Parent, message: Message::Results(ranges), .. } => {
                ranges.iter().cloned().flatten().for_each(|atom| placed[atom as usize] += 1);
            }
            _ => {}
        }
        metrics.add(&record);
    });
    let wrong = traced.iter().zip(&placed).filter(|&times| times != (&1, &1)).count();
    let dearest = costs.iter().max().copied().unwrap_or_default();
    let over = |makespan: Duration| Some(makespan.div_duration_f64(metrics.ideal()?.max(dearest)));
    MethodResult { tried: costs.len() as u64, wrong: wrong as u64, measured: metrics.makespan().and_then(over) }
}

/// Returns random costs with the mean [`ATOM_COST`]; the dearest atom costs up to ten times the cheapest.
fn uneven_costs(atoms: u32, rng: &mut Rng) -> AtomCosts {
    weighted_costs((0..atoms).map(|_| 10f64.powf(rng.f64())).collect(), ATOM_COST)
}

fn after(duration: Duration) -> Time {
    Time::ZERO + duration
}

fn swing(period: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    const FAST: f64 = 1.0;
    const SLOW: f64 = 0.05;
    attempt(tries, rng, |_, rng| {
        let mut script = Script::new();
        for node in 0..NODES as NodeId {
            let period = IDEAL_TIME.mul_f64(period * uniform(rng, 0.5, 1.5));
            let [first, second] = if node % 2 == 0 { [FAST, SLOW] } else { [SLOW, FAST] };
            script.push((Time::ZERO, Command::Speed { node, speed: first }));
            script.extend(square_wave(node, first, second, period, after(30 * IDEAL_TIME)));
        }
        script.sort_by_key(|(at, _)| *at);
        (uneven_costs(ATOMS, rng), NODES, script)
    })
}

fn stop(time: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    attempt(tries, rng, |index, rng| {
        let node = rng.u16(0..NODES as NodeId);
        let from = if index % 2 == 0 { Duration::ZERO } else { IDEAL_TIME.mul_f64(rng.f64() / 2.0) };
        let speed = |at: Duration, speed| (after(at), Command::Speed { node, speed });
        (uneven_costs(ATOMS, rng), NODES, vec![speed(from, 0.0), speed(from + IDEAL_TIME.mul_f64(time), 1.0)])
    })
}

fn crowd(an_atom: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    const FEW: u32 = 64;
    attempt(tries, rng, |_, rng| (uneven_costs(FEW, rng), (f64::from(FEW) * an_atom) as usize, Script::new()))
}

fn corner(share: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    attempt(tries, rng, |_, rng| {
        let dear = (f64::from(ATOMS) * share) as u32;
        let first = rng.u32(0..=ATOMS - dear);
        let cheap = if dear < ATOMS { 0.001 / f64::from(ATOMS - dear) } else { 0.0 };
        let weight = |atom| if (first..first + dear).contains(&atom) { 0.999 / f64::from(dear) } else { cheap };
        (weighted_costs((0..ATOMS).map(weight).collect(), ATOM_COST), NODES, Script::new())
    })
}

fn latency(greatest: f64, tries: u32, rng: &mut Rng) -> Vec<MethodResult> {
    attempt(tries, rng, |_, rng| {
        // Longer than any run lasts.
        let changes = (0..50 * 100).map(|change| {
            let latency = ATOM_COST.mul_f64(greatest * 10f64.powf(uniform(rng, -3.0, 0.0)));
            (after(IDEAL_TIME / 50 * change), Command::Latency(latency))
        });
        let script = changes.collect();
        (uneven_costs(ATOMS, rng), NODES, script)
    })
}

#[cfg(test)]
mod tests {
    use super::super::StabilityRow;
    use super::*;

    /// Returns the rows of a method, all of which ended with every atom traced and placed once.
    fn ended(case: &StabilityCase, method: &str) -> Vec<StabilityRow> {
        let rows: Vec<StabilityRow> = case.rows(4).into_iter().filter(|row| row.method == method).collect();
        assert_eq!(rows.len(), case.values.len());
        for row in &rows {
            assert!(row.wrong == 0 && row.measured.is_some_and(|over| over >= 1.0), "{row:?}");
        }
        rows
    }

    #[test]
    fn ring_ends_with_every_atom_once_in_all_cases() {
        for case in cases() {
            ended(&case, "ring");
        }
    }

    #[test]
    fn stopped_machine_keeps_only_the_atoms_in_its_pipe() {
        let costs = uneven_costs(ATOMS, &mut Rng::with_seed(0));
        let script = vec![(Time::ZERO, Command::Speed { node: 3, speed: 0.0 })];
        let lost = run(Strategy::Ring, NODES, &script, &costs);
        assert_eq!((lost.wrong, lost.measured), (2, None));
    }

    #[test]
    fn ring_is_faster_than_equal_bands_under_changes() {
        for case in &cases()[..4] {
            let (ring, bands) = (ended(case, "ring"), ended(case, "static"));
            let gains =
                ring.iter().zip(&bands).map(|(ring, bands)| bands.measured.zip(ring.measured).map(|(b, r)| b / r));
            let most = gains.flatten().fold(0.0, f64::max);
            assert!(most > 1.2, "{}: {most}", case.name);
        }
    }
}
