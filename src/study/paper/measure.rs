//! The runs of Figures 5 to 9, and of what the article leaves to be asked.

use std::iter;
use std::time::Duration;

use super::super::progress::Progress;
use super::article::{ATOM, NETWORK, Network, SERIAL, slow_speed, times_ideal};
use super::rows::{PaperRow, RowSubject, middle};
use crate::balance::Strategy;
use crate::driver::{cores, run_to_end};
use crate::runlog::{Driver, Header, Metrics};
use crate::scenario::{Command, Script, square_wave};
use crate::study::StudyError;
use crate::study::fixture::{AtomCosts, Fixture, STRATEGIES, simulate, twin};
use crate::time::Time;

/// Runs of the same kind on threads, of which the middle one counts.
pub(super) const RUNS: usize = 3;

/// Sizes of atoms that are tried, in pixels.
const ATOMS: [u32; 10] = [5, 10, 25, 50, 100, 250, 500, 1000, 2500, 10_000];

/// Sizes of a farm's parts, and least sizes of a ring's transfers, that are tried, in atoms.
const PARTS: [u32; 10] = [1, 2, 5, 10, 20, 40, 80, 160, 320, 640];

/// With how many periods a machine's speed swings.
pub(super) const PERIODS: usize = 4;

/// The periods: of an offer's lap, of an atom, of a tenth of the run and of the run, where a machine needs `scale` times the
/// article's time.
fn periods(scale: f64, atoms: usize) -> [Duration; PERIODS] {
    let run = SERIAL.mul_f64(scale / (4.0 - 0.45));
    [Duration::from_secs_f64(4.0 * NETWORK.latency * scale), SERIAL.mul_f64(scale) / atoms as u32, run / 10, run]
}

/// Two, three and four equal machines, and four with a slow one.
pub(super) fn machines() -> [Vec<f64>; 4] {
    let mut slow = vec![1.0; 4];
    slow.push(slow_speed());
    [vec![1.0; 2], vec![1.0; 3], vec![1.0; 4], slow]
}

/// Everything that runs.
pub(super) struct Measuring<'a> {
    bench: &'a Fixture,
    /// Of the article's machines, at the article's times.
    costs: AtomCosts,
    /// Of a machine of the article's speed on this computer.
    pace: f64,
    /// How much shorter runs on threads are than the article's.
    scale: f64,
    pub rows: Vec<PaperRow>,
}

impl<'a> Measuring<'a> {
    /// Nothing has run yet; `work` is the CPU time of the whole picture, and a machine of the article's speed gets the part
    /// `pace` of a core.
    pub fn new(bench: &'a Fixture, work: Duration, pace: f64) -> Self {
        let scale = work.div_f64(pace).div_duration_f64(SERIAL);
        Self { bench, costs: bench.costs(ATOM, SERIAL), pace, scale, rows: Vec::new() }
    }

    /// How many steps [`Measuring::threads`] takes.
    pub const THREAD_STEPS: usize = RUNS * (1 + 4 * (2 * STRATEGIES.len() + 1) + 4 + PERIODS);

    /// Figures 6 and 7 on threads, without a network and on the modelled one, the slow machine at every place, and a machine
    /// that swings: in turn, so that what disturbs the computer disturbs all alike.
    ///
    /// # Errors
    /// A sentence, if a run failed.
    pub fn threads(&mut self, progress: &mut Progress<'_>) -> Result<(), StudyError> {
        let kinds = self.kinds();
        let mut rows: Vec<Vec<PaperRow>> = kinds.iter().map(|_| Vec::new()).collect();
        for _ in 0..RUNS {
            for ((about, header, script), rows) in kinds.iter().zip(&mut rows) {
                let header = Header { pace: self.pace, cores: cores(), ..header.clone() };
                progress.next(&format!("{} on {} machines", header.strategy_name(), header.speeds.len()));
                let log = run_to_end(&self.bench.tracer, &header, script).map_err(StudyError::run)?;
                // Rayon's rules are not ours to simulate; and when threads obey a script is not quite when it says.
                let has_twin = header.driver == Driver::Threads && script.is_empty();
                let twin = if has_twin { Some(twin(&log)?) } else { None };
                rows.push(PaperRow::new(*about, &header, &Metrics::of(&log), twin.as_ref()));
            }
        }
        self.rows.extend(rows.into_iter().filter_map(middle));
        Ok(())
    }

    /// What runs on threads.
    fn kinds(&self) -> Vec<(RowSubject, Header, Script)> {
        let plain = |figure, header| (RowSubject::new(figure, false), header, Script::new());
        let mut kinds = vec![plain("6", self.bench.header(ATOM, Strategy::Serial, vec![1.0]))];
        for speeds in machines() {
            let figure = if speeds.len() == 5 { "7" } else { "6" };
            for strategy in STRATEGIES {
                let header = self.bench.header(ATOM, strategy, speeds.clone());
                kinds.push(plain(figure, header.clone()));
                kinds.push((RowSubject::new(figure, true), self.modelled(header, self.scale), Script::new()));
            }
            let rayon = self.bench.header(ATOM, Strategy::Ring, speeds);
            kinds.push(plain(figure, Header { driver: Driver::WorkStealing, ..rayon }));
        }
        kinds.extend((0..4).map(|place| plain("place", self.bench.header(ATOM, Strategy::Ring, slow_at(place)))));
        let periods = periods(self.scale, self.costs.len());
        // Nobody can swing a thread's speed with the lap of an offer, 70 µs of its time.
        kinds.extend(self.swinging(self.scale, &periods[1..]));
        kinds
    }

    /// Figures 6 and 7 in virtual time, at the article's times.
    pub fn simulated(&mut self) {
        for modelled in [false, true] {
            for speeds in machines() {
                let figure = if speeds.len() == 5 { "7" } else { "6" };
                for strategy in STRATEGIES {
                    self.simulate(RowSubject::new(figure, modelled), self.bench.header(ATOM, strategy, speeds.clone()));
                }
            }
            let alone = |speed| self.bench.header(ATOM, Strategy::Serial, vec![speed]);
            self.simulate(RowSubject::new("6", modelled), alone(1.0));
            self.simulate(RowSubject::new("7", modelled), alone(slow_speed()));
            for place in 0..5 {
                let header = self.bench.header(ATOM, Strategy::Ring, slow_at(place));
                self.simulate(RowSubject::new("place", modelled), header);
            }
        }
    }

    /// Time over sizes of atoms, of a farm's parts, and of a ring's smallest transfers (Figures 8 and 9).
    pub fn sizes(&mut self) {
        for modelled in [false, true] {
            let on_network = |header| if modelled { NETWORK.with(header, 1.0) } else { header };
            let [.., equal, slow] = machines();
            for speeds in [equal, slow] {
                for atom in ATOMS {
                    let costs = self.bench.costs(atom, SERIAL);
                    let header = self.bench.header(atom, Strategy::Ring, speeds.clone());
                    self.add(RowSubject::new("atom", modelled), &on_network(header), &[], &costs);
                }
                let strategies = [Strategy::Ring, Strategy::Adaptive, Strategy::Farm];
                for (part, strategy) in PARTS.into_iter().flat_map(|part| strategies.map(|strategy| (part, strategy))) {
                    let mut header = self.bench.header(ATOM, strategy, speeds.clone());
                    header.rules.part = part;
                    self.add(RowSubject::new("part", modelled), &on_network(header), &[], &self.costs.clone());
                }
            }
        }
    }

    /// A ring of four of which one machine swings, in virtual time.
    pub fn swings(&mut self) {
        let periods = periods(1.0, self.costs.len());
        for (about, header, script) in self.swinging(1.0, &periods) {
            self.add(about, &header, &script, &self.costs.clone());
        }
    }

    /// A ring of four on the modelled network, of which one machine has its mean speed throughout, or swings between full and
    /// a tenth of its speed with one of these periods.
    fn swinging(&self, scale: f64, periods: &[Duration]) -> Vec<(RowSubject, Header, Script)> {
        let run = |period: Option<Duration>| {
            let last = if period.is_some() { 1.0 } else { 0.55 };
            let header = self.modelled(self.bench.header(ATOM, Strategy::Ring, vec![1.0, 1.0, 1.0, last]), scale);
            // Whatever it takes, it ends before.
            let end = Time::ZERO + SERIAL.mul_f64(scale);
            let script = period.map_or_else(Script::new, |period| square_wave(3, 1.0, 0.1, period, end));
            (RowSubject { period, ..RowSubject::new("swing", true) }, header, script)
        };
        iter::once(None).chain(periods.iter().copied().map(Some)).map(run).collect()
    }

    /// By handling time of a message in ms, at four equal machines: times over the ideal of a farm with parts of one atom, of
    /// one with parts of the usual size, of the ring, and of static bands.
    pub fn handling(&self) -> Vec<(f64, [f64; 4])> {
        let times = |handling: f64| {
            let network = Network { handling: handling * 1e-3, ..NETWORK };
            let run = |strategy, part: Option<u32>| {
                let mut header = network.with(self.bench.header(ATOM, strategy, vec![1.0; 4]), 1.0);
                header.rules.part = part.unwrap_or(header.rules.part);
                times_ideal(&simulate(&header, &[], &self.costs))
            };
            let farm = |part| run(Strategy::Farm, part);
            [farm(Some(Network::PART)), farm(None), run(Strategy::Ring, None), run(Strategy::Static, None)]
        };
        [0.1, 0.3, 1.0, 3.0, 10.0, 15.0, 20.0, 30.0, 100.0].map(|handling| (handling, times(handling))).to_vec()
    }

    /// The run on the modelled network, with its farm's parts.
    fn modelled(&self, mut header: Header, scale: f64) -> Header {
        if header.rules.strategy.is_farm() {
            header.rules.part = Network::PART;
        }
        NETWORK.with(header, scale)
    }

    fn simulate(&mut self, about: RowSubject, header: Header) {
        let header = if about.modelled { self.modelled(header, 1.0) } else { header };
        self.add(about, &header, &[], &self.costs.clone());
    }

    /// Adds the row of a run in virtual time.
    fn add(&mut self, about: RowSubject, header: &Header, script: &[(Time, Command)], costs: &AtomCosts) {
        let header = Header { driver: Driver::Sim, ..header.clone() };
        let tally = simulate(&header, script, costs);
        self.rows.push(PaperRow::new(about, &header, &tally, None));
    }
}

/// Four machines and the article's slow one, which stands at this place of the ring.
fn slow_at(place: usize) -> Vec<f64> {
    let mut speeds = vec![1.0; 4];
    speeds.insert(place, slow_speed());
    speeds
}
