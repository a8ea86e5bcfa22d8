//! A scene with what its atoms cost, and runs of it: on threads, and in virtual time.

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

/// What each atom costs the reference machine.
pub(super) type AtomCosts = Arc<[Duration]>;

/// What studies compare.
pub(super) const STRATEGIES: [Strategy; 6] = [
    Strategy::Static,
    Strategy::StaticEstimate,
    Strategy::Farm,
    Strategy::FarmBySpeed,
    Strategy::Ring,
    Strategy::Adaptive,
];

/// Costs are known for so many pixels together; atoms are multiples of it.
pub(super) const GRAIN: u32 = 5;

/// A scene that is compiled, and whose picture is traced.
pub(super) struct Fixture {
    pub scene: Opened,
    pub size: Size,
    pub samples: u32,
    pub tracer: Arc<Tracer>,
    /// Rays by [`GRAIN`] pixels.
    rays: Vec<u32>,
}

impl Fixture {
    /// Compiles the scene and traces its picture once.
    ///
    /// # Errors
    /// A sentence, if it could not be traced.
    pub fn new(scene: &Opened, size: Size, samples: u32) -> Result<Self, StudyError> {
        let tracer = Arc::new(Tracer::new(&scene.scene, size, Quality { samples, ..Quality::default() }));
        let whole =
            TracedPicture::of(&tracer, Division::new(size.pixels(), GRAIN), &|_| {}).map_err(StudyError::run)?;
        Ok(Self { scene: scene.clone(), size, samples, tracer, rays: whole.rays })
    }

    /// What atoms of `atom_pixels` (a multiple of [`GRAIN`]) cost, by their rays, if the whole picture costs `whole`.
    pub fn costs(&self, atom_pixels: u32, whole: Duration) -> AtomCosts {
        let all: u64 = self.rays.iter().map(|&rays| u64::from(rays)).sum();
        let a_ray = whole.as_secs_f64() / all as f64;
        let atom =
            |grains: &[u32]| Duration::from_secs_f64(a_ray * grains.iter().map(|&rays| f64::from(rays)).sum::<f64>());
        self.rays.chunks((atom_pixels / GRAIN).max(1) as usize).map(atom).collect()
    }

    /// A run of the scene as the article has it: results leave a node when its atoms have run out. Plain in all else.
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

/// Costs of atoms in proportion to these numbers, `mean` on average.
pub(super) fn weighted(weights: Vec<f64>, mean: Duration) -> AtomCosts {
    let all: f64 = weights.iter().sum();
    let each = mean.as_secs_f64() * weights.len() as f64 / all;
    AtomCosts::from_iter(weights.into_iter().map(|weight| Duration::from_secs_f64(each * weight)))
}

/// The CPU time of a scene's picture on one thread, by a sample of it.
pub(super) fn cost_of(scene: &Opened, size: Size, samples: u32) -> Duration {
    let tracer = Tracer::new(&scene.scene, size, Quality { samples, ..Quality::default() });
    probe(&tracer, Division::new(size.pixels(), 50), Duration::from_millis(300)).whole
}

/// Runs in virtual time what `header` describes, and counts what it amounts to.
pub(super) fn simulate(header: &Header, script: &[(Time, Command)], costs: &AtomCosts) -> Metrics {
    let (header, costs) = (virtually(header), costs.clone());
    tally(&header, Sim::new(&header, script, move |atom| costs[atom as usize]))
}

/// The same in virtual time, where each machine has a core of its own.
fn virtually(header: &Header) -> Header {
    Header { driver: Driver::Sim, cores: header.speeds.len(), ..header.clone() }
}

/// Lets it run, and counts what it amounts to.
fn tally(header: &Header, mut sim: Sim) -> Metrics {
    let mut tally = Metrics::new(header);
    sim.run(&mut |record| tally.add(&record));
    tally
}

/// The same run in virtual time, with the costs that were measured in it.
///
/// # Errors
/// A sentence, if not all atoms were traced.
pub(super) fn twin(log: &RunLog) -> Result<Metrics, StudyError> {
    let header = virtually(&log.header);
    Ok(tally(&header, Sim::measured(&header, log).map_err(StudyError::run)?))
}
