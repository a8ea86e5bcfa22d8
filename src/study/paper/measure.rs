//! The runs of Figures 5 to 9, and runs for questions that the article leaves open.

use std::iter;
use std::time::Duration;

use super::super::progress::Progress;
use super::article::{ATOM_PX, NETWORK, Network, SERIAL_TIME, makespan_over_ideal, slow_speed};
use super::rows::{PaperRow, RowSubject, median_row};
use crate::balance::Strategy;
use crate::driver::run_to_end;
use crate::parallel::cores;
use crate::runlog::{Driver, Header, Metrics};
use crate::scenario::{Command, Script, square_wave};
use crate::study::StudyError;
use crate::study::fixture::{AtomCosts, Fixture, STRATEGIES, simulate, simulate_twin};
use crate::time::Time;

/// Runs of the same kind on threads, of which the median counts.
pub(super) const RUNS: usize = 3;

/// Sizes of atoms, in pixels.
const ATOM_SIZES_PX: [u32; 10] = [5, 10, 25, 50, 100, 250, 500, 1000, 2500, 10_000];

/// Sizes of a farm's parts, and least sizes of a ring's transfers, in atoms.
const PART_SIZES: [u32; 10] = [1, 2, 5, 10, 20, 40, 80, 160, 320, 640];

/// Number of periods with which a machine's speed swings.
pub(super) const PERIOD_COUNT: usize = 4;

/// Returns the periods of a swing: an offer's lap, an atom, a tenth of the run, and the run, where a machine needs
/// `scale` times the article's time.
fn periods(scale: f64, atoms: usize) -> [Duration; PERIOD_COUNT] {
    let run = SERIAL_TIME.mul_f64(scale / (4.0 - 0.45));
    [Duration::from_secs_f64(4.0 * NETWORK.latency * scale), SERIAL_TIME.mul_f64(scale) / atoms as u32, run / 10, run]
}

/// Returns the speeds of two, three and four equal machines, and of four with a slow one.
pub(super) fn machines() -> [Vec<f64>; 4] {
    let mut slow = vec![1.0; 4];
    slow.push(slow_speed());
    [vec![1.0; 2], vec![1.0; 3], vec![1.0; 4], slow]
}

/// The runs of the study, and their rows.
pub(super) struct PaperRuns<'a> {
    fixture: &'a Fixture,
    /// Costs of atoms on the article's machines, at the article's times.
    costs: AtomCosts,
    /// Pace of a machine of the article's speed on this computer.
    pace: f64,
    /// Duration of runs on threads, as a multiple of the article's.
    scale: f64,
    pub rows: Vec<PaperRow>,
}

impl<'a> PaperRuns<'a> {
    /// Prepares the runs. `work` is the CPU time of the whole picture; a machine of the article's speed gets the
    /// fraction `pace` of a core.
    pub fn new(fixture: &'a Fixture, work: Duration, pace: f64) -> Self {
        let scale = work.div_f64(pace).div_duration_f64(SERIAL_TIME);
        Self { fixture, costs: fixture.costs(ATOM_PX, SERIAL_TIME), pace, scale, rows: Vec::new() }
    }

    /// Number of steps that [`PaperRuns::threads`] takes.
    pub const THREAD_STEPS: usize = RUNS * (1 + 4 * (2 * STRATEGIES.len() + 1) + 4 + PERIOD_COUNT);

    /// Runs on threads: Figures 6 and 7 without a network and on the modelled one, the slow machine at every place, and
    /// a machine whose speed swings. The kinds of runs take turns, so that a disturbance of the computer affects all
    /// alike.
    ///
    /// # Errors
    /// [`StudyError::Run`], if a run fails.
    pub fn threads(&mut self, progress: &mut Progress<'_>) -> Result<(), StudyError> {
        let thread_runs = self.thread_runs();
        let mut rows: Vec<Vec<PaperRow>> = thread_runs.iter().map(|_| Vec::new()).collect();
        for _ in 0..RUNS {
            for ((subject, header, script), rows) in thread_runs.iter().zip(&mut rows) {
                let header = Header { pace: self.pace, cores: cores(), ..header.clone() };
                progress.next(&format!("{} on {} machines", header.scheduler().name(), header.speeds.len()));
                let log = run_to_end(&self.fixture.tracer, &header, script).map_err(StudyError::run)?;
                // Rayon's rules are not simulated here; and threads obey a script a little later than it says.
                let has_twin = header.driver == Driver::Threads && script.is_empty();
                let twin = if has_twin { Some(simulate_twin(&log)?) } else { None };
                rows.push(PaperRow::new(*subject, &header, &Metrics::of(&log), twin.as_ref()));
            }
        }
        self.rows.extend(rows.into_iter().filter_map(median_row));
        Ok(())
    }

    /// Returns the runs on threads.
    fn thread_runs(&self) -> Vec<(RowSubject, Header, Script)> {
        let plain = |figure, header| (RowSubject::new(figure, false), header, Script::new());
        let mut thread_runs = vec![plain("6", self.fixture.header(ATOM_PX, Strategy::Serial, vec![1.0]))];
        for speeds in machines() {
            let figure = if speeds.len() == 5 { "7" } else { "6" };
            for strategy in STRATEGIES {
                let header = self.fixture.header(ATOM_PX, strategy, speeds.clone());
                thread_runs.push(plain(figure, header.clone()));
                thread_runs.push((RowSubject::new(figure, true), self.modelled(header, self.scale), Script::new()));
            }
            let rayon = self.fixture.header(ATOM_PX, Strategy::Ring, speeds);
            thread_runs.push(plain(figure, Header { driver: Driver::WorkStealing, ..rayon }));
        }
        thread_runs.extend(
            (0..4)
                .map(|place| plain("place", self.fixture.header(ATOM_PX, Strategy::Ring, speeds_with_slow_at(place)))),
        );
        let periods = periods(self.scale, self.costs.len());
        // Nobody can change a thread's speed within an offer's lap, 70 µs of its time.
        thread_runs.extend(self.swinging(self.scale, &periods[1..]));
        thread_runs
    }

    /// Runs Figures 6 and 7 in virtual time, at the article's times.
    pub fn simulated(&mut self) {
        for modelled in [false, true] {
            for speeds in machines() {
                let figure = if speeds.len() == 5 { "7" } else { "6" };
                for strategy in STRATEGIES {
                    self.simulate(
                        RowSubject::new(figure, modelled),
                        self.fixture.header(ATOM_PX, strategy, speeds.clone()),
                    );
                }
            }
            let alone = |speed| self.fixture.header(ATOM_PX, Strategy::Serial, vec![speed]);
            self.simulate(RowSubject::new("6", modelled), alone(1.0));
            self.simulate(RowSubject::new("7", modelled), alone(slow_speed()));
            for place in 0..5 {
                let header = self.fixture.header(ATOM_PX, Strategy::Ring, speeds_with_slow_at(place));
                self.simulate(RowSubject::new("place", modelled), header);
            }
        }
    }

    /// Runs all sizes of atoms, of a farm's parts, and of a ring's smallest transfers (Figures 8 and 9).
    pub fn sizes(&mut self) {
        for modelled in [false, true] {
            let on_network = |header| if modelled { NETWORK.with(header, 1.0) } else { header };
            let [.., equal, slow] = machines();
            for speeds in [equal, slow] {
                for atom in ATOM_SIZES_PX {
                    let costs = self.fixture.costs(atom, SERIAL_TIME);
                    let header = self.fixture.header(atom, Strategy::Ring, speeds.clone());
                    self.add(RowSubject::new("atom", modelled), &on_network(header), &[], &costs);
                }
                let strategies = [Strategy::Ring, Strategy::Adaptive, Strategy::Farm];
                for (part, strategy) in
                    PART_SIZES.into_iter().flat_map(|part| strategies.clone().map(|strategy| (part, strategy)))
                {
                    let mut header = self.fixture.header(ATOM_PX, strategy, speeds.clone());
                    header.rules.part = part;
                    self.add(RowSubject::new("part", modelled), &on_network(header), &[], &self.costs.clone());
                }
            }
        }
    }

    /// Runs a ring of four in which one machine's speed swings, in virtual time.
    pub fn swings(&mut self) {
        let periods = periods(1.0, self.costs.len());
        for (subject, header, script) in self.swinging(1.0, &periods) {
            self.add(subject, &header, &script, &self.costs.clone());
        }
    }

    /// Returns runs of a ring of four on the modelled network. One machine keeps its mean speed throughout, or swings
    /// between full speed and a tenth with one of the periods.
    fn swinging(&self, scale: f64, periods: &[Duration]) -> Vec<(RowSubject, Header, Script)> {
        let run = |period: Option<Duration>| {
            let last = if period.is_some() { 1.0 } else { 0.55 };
            let header = self.modelled(self.fixture.header(ATOM_PX, Strategy::Ring, vec![1.0, 1.0, 1.0, last]), scale);
            // Longer than any of these runs.
            let end = Time::ZERO + SERIAL_TIME.mul_f64(scale);
            let script = period.map_or_else(Script::new, |period| square_wave(3, 1.0, 0.1, period, end));
            (RowSubject { period, ..RowSubject::new("swing", true) }, header, script)
        };
        iter::once(None).chain(periods.iter().copied().map(Some)).map(run).collect()
    }

    /// Measures makespan / ideal by handling time of a message in ms, at four equal machines: of a farm with parts of
    /// one atom, of a farm with parts of the usual size, of the ring, and of static bands.
    pub fn handling(&self) -> Vec<(f64, [f64; 4])> {
        let times = |handling: f64| {
            let network = Network { handling: handling * 1e-3, ..NETWORK };
            let run = |strategy, part: Option<u32>| {
                let mut header = network.with(self.fixture.header(ATOM_PX, strategy, vec![1.0; 4]), 1.0);
                header.rules.part = part.unwrap_or(header.rules.part);
                makespan_over_ideal(&simulate(&header, &[], &self.costs))
            };
            let farm = |part| run(Strategy::Farm, part);
            [farm(Some(Network::PART)), farm(None), run(Strategy::Ring, None), run(Strategy::Static, None)]
        };
        [0.1, 0.3, 1.0, 3.0, 10.0, 15.0, 20.0, 30.0, 100.0].map(|handling| (handling, times(handling))).to_vec()
    }

    /// Puts a run on the modelled network, with the parts of the modelled farm.
    fn modelled(&self, mut header: Header, scale: f64) -> Header {
        if header.rules.strategy.is_farm() {
            header.rules.part = Network::PART;
        }
        NETWORK.with(header, scale)
    }

    fn simulate(&mut self, subject: RowSubject, header: Header) {
        let header = if subject.modelled { self.modelled(header, 1.0) } else { header };
        self.add(subject, &header, &[], &self.costs.clone());
    }

    /// Runs in virtual time and adds the row.
    fn add(&mut self, subject: RowSubject, header: &Header, script: &[(Time, Command)], costs: &AtomCosts) {
        let header = Header { driver: Driver::Sim, ..header.clone() };
        let metrics = simulate(&header, script, costs);
        self.rows.push(PaperRow::new(subject, &header, &metrics, None));
    }
}

/// Returns the speeds of four machines and the article's slow one, which is at `place` in the ring.
fn speeds_with_slow_at(place: usize) -> Vec<f64> {
    let mut speeds = vec![1.0; 4];
    speeds.insert(place, slow_speed());
    speeds
}
