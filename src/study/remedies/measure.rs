//! Runs of the article's ring, the adaptive ring, and the adaptive ring without each of its remedies.

use std::time::Duration;

use serde::Serialize;

use super::super::median;
use super::super::progress::Progress;
use super::cases::{RemedyCase, cases, throttled};
use crate::balance::{Remedies, Remedy, Rules, Strategy};
use crate::driver::run_to_end;
use crate::parallel::cores;
use crate::picture::Size;
use crate::runlog::{Driver, Header, LinkSettings, Metrics};
use crate::scene::Opened;
use crate::study::StudyError;
use crate::study::fixture::{Fixture, estimate_cost, simulate};

/// Time that all machines together need at full speed, for a run in virtual time; about the makespan of a run on
/// threads.
const RUN_TIME: Duration = Duration::from_millis(1200);
/// Latencies of a message in ms. On threads there is no network.
pub(super) const LATENCIES_MS: [f64; 3] = [0.0, 1.0, 10.0];
/// Sizes of atoms in pixels. In virtual time each is a run and the median counts, since the last atoms are a matter of
/// chance.
const ATOM_SIZES_PX: [u32; 5] = [40, 45, 50, 55, 60];
/// Runs on threads, of which the median counts.
const RUNS: usize = 3;
/// Width and height of the picture, in pixels.
const PICTURE_PX: (u32, u32) = (640, 480);

/// What distributes the atoms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rival {
    Ring,
    FarmLeases,
    Adaptive(Remedies),
    Rayon,
}

impl Rival {
    /// Returns the rivals measured in virtual time: the ring, the farm with leases, the adaptive ring, and the
    /// adaptive ring without each remedy.
    pub fn simulated() -> impl Iterator<Item = Self> {
        let without = Remedy::ALL.map(|remedy| Self::Adaptive(Remedies::ALL.without(remedy)));
        [Self::Ring, Self::FarmLeases, Self::Adaptive(Remedies::ALL)].into_iter().chain(without)
    }

    pub fn name(self) -> String {
        match self {
            Self::Ring => "ring".into(),
            Self::FarmLeases => "farm-leases".into(),
            Self::Adaptive(Remedies::ALL) => "adaptive".into(),
            Self::Adaptive(remedies) => {
                let missing = Remedy::ALL.into_iter().filter(|&remedy| !remedies.has(remedy));
                format!("without {}", missing.map(Remedy::name).collect::<Vec<_>>().join(", "))
            }
            Self::Rayon => "rayon".into(),
        }
    }

    fn strategy(self) -> Strategy {
        match self {
            Self::FarmLeases => Strategy::FarmLeases,
            Self::Adaptive(_) => Strategy::Adaptive,
            // Rayon ignores the strategy.
            Self::Ring | Self::Rayon => Strategy::Ring,
        }
    }
}

/// Result of one rival in one case: the median of its runs.
#[derive(Clone, Debug, Serialize)]
pub(super) struct RemedyRow {
    pub case: String,
    pub driver: &'static str,
    pub latency_ms: f64,
    pub rival: String,
    /// Makespan / bound, where the bound is the least T with ∫ Σ speed dt ≥ work; `None` if a run never ends.
    pub over_bound: Option<f64>,
    /// The worst makespan / bound of the runs.
    pub worst: Option<f64>,
    pub aim: f64,
    pub messages_per_node: f64,
    /// Work done twice / work.
    pub twice: f64,
}

/// Number of steps that [`measure`] takes at most.
pub(super) fn steps() -> usize {
    cases().len() * (LATENCIES_MS.len() + RUNS * 3) + RUNS * 2
}

/// Measures all cases in virtual time and on threads.
///
/// # Errors
/// A [`StudyError`], if a run fails.
pub(super) fn measure(scene: &Opened, progress: &mut Progress<'_>) -> Result<Vec<RemedyRow>, StudyError> {
    let cases = cases();
    let size = Size::new(PICTURE_PX.0, PICTURE_PX.1).map_err(StudyError::size)?;
    let corner = Opened::new("corner")?;
    let (plain, corner) = (Fixture::new(scene, size, 1)?, Fixture::new(&corner, size, 1)?);
    let fixture = |case: &RemedyCase| if case.work_in_corner { &corner } else { &plain };
    let mut rows = Vec::new();
    for latency in LATENCIES_MS {
        for case in &cases {
            progress.next(&format!("in virtual time, {latency} ms a message: {}", case.name));
            rows.extend(Rival::simulated().map(|rival| simulate_case(fixture(case), case, latency, rival)));
        }
    }
    for case in &cases {
        // A rival that never ends in virtual time would not end on threads either.
        let ends = |rival: &Rival| {
            rows.iter().any(|row| row.case == case.name && row.rival == rival.name() && row.over_bound.is_some())
        };
        let all = [Rival::Ring, Rival::FarmLeases, Rival::Adaptive(Remedies::ALL)];
        let rivals: Vec<_> = all.into_iter().filter(ends).collect();
        let measured = run_on_threads(&fixture(case).scene, case, &rivals, progress)?;
        rows.extend(measured);
    }
    // Rayon tolerates no losses, only a machine that becomes slow.
    rows.extend(run_on_threads(scene, &throttled(), &[Rival::Adaptive(Remedies::ALL), Rival::Rayon], progress)?);
    Ok(rows)
}

fn header(fixture: &Fixture, case: &RemedyCase, atom: u32, rival: Rival) -> Header {
    let plain = fixture.header(atom, rival.strategy(), case.speeds.clone());
    let remedies = if let Rival::Adaptive(remedies) = rival { remedies } else { plain.rules.remedies };
    let spares = if rival == Rival::Ring { 0 } else { case.spares };
    Header { rules: Rules { batch: Some(Rules::BATCH), remedies, ..plain.rules }, spares, ..plain }
}

fn simulate_case(fixture: &Fixture, case: &RemedyCase, latency: f64, rival: Rival) -> RemedyRow {
    let total_speed: f64 = case.speeds.iter().sum();
    let runs: Vec<Metrics> = ATOM_SIZES_PX
        .iter()
        .map(|&atom| {
            let plain = header(fixture, case, atom, rival);
            let link = LinkSettings { latency: Duration::from_secs_f64(latency * 1e-3), ..plain.link };
            let header = Header { link, ..plain };
            simulate(&header, &(case.script)(RUN_TIME), &fixture.costs(atom, RUN_TIME.mul_f64(total_speed)))
        })
        .collect();
    row(case, Driver::Sim, latency, rival, &runs)
}

/// Runs the rivals in turn, so that a disturbance of the computer affects all alike.
fn run_on_threads(
    scene: &Opened,
    case: &RemedyCase,
    rivals: &[Rival],
    progress: &mut Progress<'_>,
) -> Result<Vec<RemedyRow>, StudyError> {
    // Leaves more than half of the computer idle.
    let pace = (0.4 * cores() as f64 / case.speeds.iter().sum::<f64>()).min(1.0);
    let rate = case.speeds.iter().sum::<f64>() * pace;
    let size = Size::new(PICTURE_PX.0, PICTURE_PX.1).map_err(StudyError::size)?;
    let long_enough =
        |samples: &u32| estimate_cost(scene, size, *samples).as_secs_f64() >= RUN_TIME.as_secs_f64() * rate;
    let samples = (1..8).find(long_enough).unwrap_or(8);
    let fixture = Fixture::new(scene, size, samples)?;
    let run = estimate_cost(scene, size, samples).div_f64(rate);
    let mut runs: Vec<Vec<Metrics>> = rivals.iter().map(|_| Vec::new()).collect();
    for _ in 0..RUNS {
        for (&rival, runs) in rivals.iter().zip(&mut runs) {
            progress.next(&format!("on threads: {}, {}", case.name, rival.name()));
            let driver = if rival == Rival::Rayon { Driver::WorkStealing } else { Driver::Threads };
            let header = Header { driver, pace, cores: cores(), ..header(&fixture, case, 50, rival) };
            let log = run_to_end(&fixture.tracer, &header, &(case.script)(run)).map_err(StudyError::run)?;
            runs.push(Metrics::of(&log));
        }
    }
    Ok(rivals.iter().zip(&runs).map(|(&rival, runs)| row(case, Driver::Threads, 0.0, rival, runs)).collect())
}

fn row(case: &RemedyCase, driver: Driver, latency_ms: f64, rival: Rival, runs: &[Metrics]) -> RemedyRow {
    let over = |metrics: &Metrics| Some(metrics.makespan()?.div_duration_f64(metrics.ideal()?));
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
        messages_per_node: of_runs(&|metrics| metrics.messages().total as f64 / case.speeds.len() as f64),
        twice: of_runs(&|metrics| metrics.twice().as_secs_f64() / metrics.work().as_secs_f64()),
    }
}
