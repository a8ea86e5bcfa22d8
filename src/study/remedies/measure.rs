//! The runs: the article's ring, the ring that adapts, and that ring without each of its remedies.

use std::time::Duration;

use serde::Serialize;

use super::super::median;
use super::super::progress::Progress;
use super::cases::{RemedyCase, cases, throttled};
use crate::balance::{Remedies, Remedy, Rules, Strategy};
use crate::driver::{cores, run_to_end};
use crate::picture::Size;
use crate::runlog::{Driver, Header, LinkSettings, Metrics};
use crate::scene::Opened;
use crate::study::fixture::{Fixture, cost_of, simulate};

/// How long a run in virtual time takes all machines together at full speed, and about how long one on threads does.
const RUN: Duration = Duration::from_millis(1200);
/// How long a message travels, in ms. On threads there is no network.
pub(super) const LATENCIES: [f64; 3] = [0.0, 1.0, 10.0];
/// Pixels in an atom: in virtual time each is a run, and the middle one counts, since the last atoms are a matter of luck.
const ATOMS: [u32; 5] = [40, 45, 50, 55, 60];
/// Runs on threads, of which the middle one counts.
const RUNS: usize = 3;
/// The picture.
const SIZE: (u32, u32) = (640, 480);

/// What shares the atoms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rival {
    Ring,
    Adaptive(Remedies),
    Rayon,
}

impl Rival {
    /// What is measured in virtual time: the ring, the one that adapts, and that one without each remedy.
    pub fn simulated() -> impl Iterator<Item = Self> {
        let without = Remedy::ALL.map(|remedy| Self::Adaptive(Remedies::ALL.without(remedy)));
        [Self::Ring, Self::Adaptive(Remedies::ALL)].into_iter().chain(without)
    }

    pub fn name(self) -> String {
        match self {
            Self::Ring => "ring".into(),
            Self::Adaptive(Remedies::ALL) => "adaptive".into(),
            Self::Adaptive(remedies) => {
                let missing = Remedy::ALL.into_iter().filter(|&remedy| !remedies.has(remedy));
                format!("without {}", missing.map(Remedy::name).collect::<Vec<_>>().join(", "))
            }
            Self::Rayon => "rayon".into(),
        }
    }

    fn strategy(self) -> Strategy {
        if self == Self::Ring { Strategy::Ring } else { Strategy::Adaptive }
    }
}

/// One case of one rival: the middle of its runs.
#[derive(Clone, Debug, Serialize)]
pub(super) struct RemedyRow {
    pub case: String,
    pub driver: &'static str,
    pub latency_ms: f64,
    pub rival: String,
    /// The time over the least T with ∫ Σ speed dt ≥ work; `None` if it never ends.
    pub over_bound: Option<f64>,
    /// Of the runs.
    pub worst: Option<f64>,
    pub aim: f64,
    pub messages_per_node: f64,
    /// Work done twice / work.
    pub twice: f64,
}

/// How many steps [`measure`] takes at most.
pub(super) fn steps() -> usize {
    cases().len() * (LATENCIES.len() + RUNS * 2) + RUNS * 2
}

/// Everything: in virtual time, and on threads.
///
/// # Errors
/// A sentence, if a run failed.
pub(super) fn measure(scene: &Opened, progress: &mut Progress<'_>) -> Result<Vec<RemedyRow>, String> {
    let cases = cases();
    let size = Size::new(SIZE.0, SIZE.1)?;
    let corner = Opened::new("corner").map_err(|error| error.to_string())?;
    let (plain, corner) = (Fixture::new(scene, size, 1)?, Fixture::new(&corner, size, 1)?);
    let bench = |case: &RemedyCase| if case.corner { &corner } else { &plain };
    let mut rows = Vec::new();
    for latency in LATENCIES {
        for case in &cases {
            progress.next(&format!("in virtual time, {latency} ms a message: {}", case.name));
            rows.extend(Rival::simulated().map(|rival| virtually(bench(case), case, latency, rival)));
        }
    }
    for case in &cases {
        // Who never ends there would not end here either.
        let ends = |rival: &Rival| {
            rows.iter().any(|row| row.case == case.name && row.rival == rival.name() && row.over_bound.is_some())
        };
        let rivals: Vec<_> = [Rival::Ring, Rival::Adaptive(Remedies::ALL)].into_iter().filter(ends).collect();
        let measured = on_threads(&bench(case).scene, case, &rivals, progress)?;
        rows.extend(measured);
    }
    // Rayon knows no losses, but a machine that becomes slow.
    rows.extend(on_threads(scene, &throttled(), &[Rival::Adaptive(Remedies::ALL), Rival::Rayon], progress)?);
    Ok(rows)
}

fn header(bench: &Fixture, case: &RemedyCase, atom: u32, rival: Rival) -> Header {
    let plain = bench.header(atom, rival.strategy(), case.speeds.clone());
    let remedies = if let Rival::Adaptive(remedies) = rival { remedies } else { plain.rules.remedies };
    let spares = if rival == Rival::Ring { 0 } else { case.spares };
    Header { rules: Rules { batch: Some(Rules::BATCH), remedies, ..plain.rules }, spares, ..plain }
}

fn virtually(bench: &Fixture, case: &RemedyCase, latency: f64, rival: Rival) -> RemedyRow {
    let power: f64 = case.speeds.iter().sum();
    let runs: Vec<Metrics> = ATOMS
        .iter()
        .map(|&atom| {
            let plain = header(bench, case, atom, rival);
            let link = LinkSettings { latency: Duration::from_secs_f64(latency * 1e-3), ..plain.link };
            let header = Header { link, ..plain };
            simulate(&header, &(case.script)(RUN), &bench.costs(atom, RUN.mul_f64(power)))
        })
        .collect();
    row(case, Driver::Sim, latency, rival, &runs)
}

/// Each of the rivals in turn, so that what disturbs the computer disturbs all alike.
fn on_threads(
    scene: &Opened,
    case: &RemedyCase,
    rivals: &[Rival],
    progress: &mut Progress<'_>,
) -> Result<Vec<RemedyRow>, String> {
    // What leaves more than half of the computer idle.
    let pace = (0.4 * cores() as f64 / case.speeds.iter().sum::<f64>()).min(1.0);
    let rate = case.speeds.iter().sum::<f64>() * pace;
    let size = Size::new(SIZE.0, SIZE.1)?;
    let long_enough = |samples: &u32| cost_of(scene, size, *samples).as_secs_f64() >= RUN.as_secs_f64() * rate;
    let samples = (1..8).find(long_enough).unwrap_or(8);
    let bench = Fixture::new(scene, size, samples)?;
    let run = cost_of(scene, size, samples).div_f64(rate);
    let mut runs: Vec<Vec<Metrics>> = rivals.iter().map(|_| Vec::new()).collect();
    for _ in 0..RUNS {
        for (&rival, runs) in rivals.iter().zip(&mut runs) {
            progress.next(&format!("on threads: {}, {}", case.name, rival.name()));
            let driver = if rival == Rival::Rayon { Driver::WorkStealing } else { Driver::Threads };
            let header = Header { driver, pace, cores: cores(), ..header(&bench, case, 50, rival) };
            runs.push(Metrics::of(&run_to_end(&bench.tracer, &header, &(case.script)(run))?));
        }
    }
    Ok(rivals.iter().zip(&runs).map(|(&rival, runs)| row(case, Driver::Threads, 0.0, rival, runs)).collect())
}

fn row(case: &RemedyCase, driver: Driver, latency_ms: f64, rival: Rival, runs: &[Metrics]) -> RemedyRow {
    let over = |tally: &Metrics| Some(tally.makespan()?.div_duration_f64(tally.ideal()?));
    let mut ratios: Vec<f64> = runs.iter().filter_map(over).collect();
    let all = ratios.len() == runs.len();
    let worst = ratios.iter().copied().fold(0.0, f64::max);
    let of_runs = |of: &dyn Fn(&Metrics) -> f64| median(&mut runs.iter().map(of).collect::<Vec<_>>());
    RemedyRow {
        case: case.name.clone(),
        driver: driver.name(),
        latency_ms,
        rival: rival.name(),
        over_bound: all.then(|| median(&mut ratios)),
        worst: all.then_some(worst),
        aim: case.aim,
        messages_per_node: of_runs(&|tally| tally.messages().total as f64 / case.speeds.len() as f64),
        twice: of_runs(&|tally| tally.twice().as_secs_f64() / tally.work().as_secs_f64()),
    }
}
