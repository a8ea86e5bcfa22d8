//! A scene with the costs of its atoms, and runs of it on threads and in virtual time.

use std::sync::Arc;
use std::time::Duration;

use super::StudyError;
use crate::balance::{Rules, Strategy};
use crate::driver::{TracedPicture, probe};
use crate::picture::{Division, Quality, Size};
use crate::runlog::{Driver, Header, Metrics, RunLog};
use crate::scenario::Command;
use crate::scene::Opened;
use crate::sim::Sim;
use crate::time::Time;
use crate::tracer::Tracer;

/// CPU time of each atom on the reference machine.
pub(super) type AtomCosts = Arc<[Duration]>;

/// The strategies that studies compare.
pub(super) const STRATEGIES: [Strategy; 7] = [
    Strategy::Static,
    Strategy::StaticEstimate,
    Strategy::Farm,
    Strategy::FarmBySpeed,
    Strategy::FarmLeases,
    Strategy::Ring,
    Strategy::Adaptive,
];

/// Pixels whose cost is known together; sizes of atoms are multiples of it.
pub(super) const GRAIN_PX: u32 = 5;

/// A compiled scene whose picture has been traced.
pub(super) struct Fixture {
    pub scene: Opened,
    pub size: Size,
    pub samples: u32,
    pub tracer: Arc<Tracer>,
    /// Rays per [`GRAIN_PX`] pixels.
    rays: Vec<u32>,
}

impl Fixture {
    /// Compiles the scene and traces its picture once.
    ///
    /// # Errors
    /// [`StudyError::Run`], if a thread cannot be started or panics.
    pub fn new(scene: &Opened, size: Size, samples: u32) -> Result<Self, StudyError> {
        let tracer = Arc::new(Tracer::new(&scene.scene, size, Quality { samples, ..Quality::default() }));
        let whole =
            TracedPicture::of(&tracer, Division::new(size.pixels(), GRAIN_PX), &|_| {}).map_err(StudyError::run)?;
        Ok(Self { scene: scene.clone(), size, samples, tracer, rays: whole.rays })
    }

    /// Returns the costs of atoms of `atom_pixels` (a multiple of [`GRAIN_PX`]), in proportion to their rays; the whole
    /// picture costs `whole`.
    pub fn costs(&self, atom_pixels: u32, whole: Duration) -> AtomCosts {
        let all: u64 = self.rays.iter().map(|&rays| u64::from(rays)).sum();
        let a_ray = whole.as_secs_f64() / all as f64;
        let atom =
            |grains: &[u32]| Duration::from_secs_f64(a_ray * grains.iter().map(|&rays| f64::from(rays)).sum::<f64>());
        self.rays.chunks((atom_pixels / GRAIN_PX).max(1) as usize).map(atom).collect()
    }

    /// Returns the header of a run by the article's rules: a node sends its results when it has no atoms left. All else
    /// is the default.
    pub fn header(&self, atom_pixels: u32, strategy: Strategy, speeds: Vec<f64>) -> Header {
        let plain = Header::plain(self.size, atom_pixels, strategy, speeds);
        Header {
            scene: self.scene.name.clone(),
            scene_text: self.scene.text.clone(),
            quality: self.tracer.quality(),
            rules: Rules { batch: None, ..plain.rules },
            ..plain
        }
    }
}

/// Returns costs in proportion to the weights, with the mean `mean`.
pub(super) fn weighted_costs(weights: Vec<f64>, mean: Duration) -> AtomCosts {
    let all: f64 = weights.iter().sum();
    let each = mean.as_secs_f64() * weights.len() as f64 / all;
    AtomCosts::from_iter(weights.into_iter().map(|weight| Duration::from_secs_f64(each * weight)))
}

/// Estimates the CPU time of a scene's picture on one thread from a sample of its pixels.
pub(super) fn estimate_cost(scene: &Opened, size: Size, samples: u32) -> Duration {
    let tracer = Tracer::new(&scene.scene, size, Quality { samples, ..Quality::default() });
    probe(&tracer, Division::new(size.pixels(), 50), Duration::from_millis(300)).whole
}

/// Simulates a run in virtual time and returns its metrics.
pub(super) fn simulate(header: &Header, script: &[(Time, Command)], costs: &AtomCosts) -> Metrics {
    let (header, costs) = (in_virtual_time(header), costs.clone());
    collect_metrics(&header, Sim::new(&header, script, move |atom| costs[atom as usize]))
}

/// Moves a run to virtual time, where each machine has its own core.
fn in_virtual_time(header: &Header) -> Header {
    Header { driver: Driver::Sim, cores: header.speeds.len(), ..header.clone() }
}

/// Runs a simulation to its end and collects its metrics.
fn collect_metrics(header: &Header, mut sim: Sim) -> Metrics {
    let mut metrics = Metrics::new(header);
    sim.run(&mut |record| metrics.add(&record));
    metrics
}

/// Simulates a recorded run in virtual time, with the costs measured in it.
///
/// # Errors
/// [`StudyError::Run`], if not all atoms were traced.
pub(super) fn simulate_twin(log: &RunLog) -> Result<Metrics, StudyError> {
    let header = in_virtual_time(&log.header);
    Ok(collect_metrics(&header, Sim::measured(&header, log).map_err(StudyError::run)?))
}
