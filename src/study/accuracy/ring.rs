//! Runs of the ring for the study of accuracy: in virtual time, with random speeds and with finer and coarser atoms.

use std::time::Duration;

use super::sharing::{NODES, SharedRun, Transfer, WatchedRun, run, usual};
use crate::picture::Size;
use crate::scene::Opened;
use crate::study::StudyError;
use crate::study::fixture::Fixture;
use crate::study::progress::Progress;

/// Runs of each scene.
const SEEDS: u64 = 40;

/// Runs of each size of atoms and each latency.
const FEW_SEEDS: u64 = 12;

/// Number of steps besides one for each scene.
pub(super) const STEPS: usize = LATENCIES.len();

/// Latencies of a message in ms, where sizes of atoms are compared.
pub(super) const LATENCIES: [f64; 3] = [0.1, 1.0, 10.0];

/// Sizes of atoms, in pixels.
const ATOMS: [u32; 10] = [5000, 2000, 1000, 500, 200, 100, 50, 20, 10, 5];

/// Results for the ring.
pub(super) struct RingAccuracy {
    pub size: Size,
    /// By scene: runs with atoms of 50 pixels, and their transfers.
    pub shared: Vec<Vec<SharedRun>>,
    /// Runs of the first scene: by latency, then by size of atoms with the coarsest first, then by speeds.
    pub grained: Vec<Grain>,
}

/// Runs with one size of atoms and one latency, on several rings.
pub(super) struct Grain {
    pub latency_ms: f64,
    pub atom_pixels: u32,
    pub runs: Vec<WatchedRun>,
}

impl Grain {
    /// Returns the mean of a figure over the runs.
    pub fn mean(&self, of: impl Fn(&WatchedRun) -> f64) -> f64 {
        self.runs.iter().map(of).sum::<f64>() / self.runs.len() as f64
    }
}

impl RingAccuracy {
    /// Runs rings of eight machines on the scenes' pictures.
    ///
    /// # Errors
    /// [`StudyError::Run`], if a scene cannot be traced.
    pub fn of(scenes: &[Opened], size: Size, progress: &mut Progress<'_>) -> Result<Self, StudyError> {
        let mut shared = Vec::new();
        let mut first = None;
        for opened in scenes {
            progress.next(&format!("{}: rings of {NODES} machines", opened.name));
            let bench = Fixture::new(opened, size, 1)?;
            shared.push((0..SEEDS).map(|seed| usual(&bench, seed)).collect());
            first.get_or_insert(bench);
        }
        let mut grained = Vec::new();
        for latency_ms in LATENCIES {
            progress.next(&format!("rings with a latency of {latency_ms} ms"));
            let Some(bench) = &first else { continue };
            let latency = Duration::from_secs_f64(latency_ms * 1e-3);
            grained.extend(ATOMS.map(|atom_pixels| Grain {
                latency_ms,
                atom_pixels,
                runs: (0..FEW_SEEDS).map(|seed| run(bench, atom_pixels, latency, seed).run).collect(),
            }));
        }
        Ok(Self { size, shared, grained })
    }

    /// Returns all runs as rows.
    pub fn rows(&self) -> Vec<WatchedRun> {
        let usual = self.shared.iter().flatten().map(|shared| shared.run.clone());
        usual.chain(self.grained.iter().flat_map(|grain| grain.runs.iter().cloned())).collect()
    }

    /// Returns all transfers of runs with atoms of the default size.
    pub fn transfers(&self) -> impl Iterator<Item = &Transfer> {
        self.shared.iter().flatten().flat_map(|shared| &shared.transfers)
    }

    /// Returns the points of all runs with atoms of the default size.
    pub fn all_points(&self) -> Vec<(f64, f64)> {
        self.shared.iter().flat_map(|runs| Self::points(runs)).collect()
    }

    /// Returns a point for each run: the error of its estimates, and its lateness.
    pub fn points(runs: &[SharedRun]) -> Vec<(f64, f64)> {
        runs.iter().filter_map(|shared| Some((shared.run.estimate_error?, shared.run.lateness))).collect()
    }
}
