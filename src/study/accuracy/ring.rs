//! Runs of the ring for the study of accuracy: in virtual time, with random speeds and with finer and coarser atoms.

use std::time::Duration;

use super::transfers::{NODES, RingRow, RingRun, Transfer, run_default, run_ring};
use crate::picture::Size;
use crate::scene::Opened;
use crate::study::StudyError;
use crate::study::fixture::Fixture;
use crate::study::progress::Progress;

/// Runs of each scene.
const SEEDS_PER_SCENE: u64 = 40;

/// Runs of each size of atoms and each latency.
const SEEDS_PER_ATOM_SIZE: u64 = 12;

/// Number of steps besides one for each scene.
pub(super) const STEPS: usize = LATENCIES_MS.len();

/// Latencies of a message in ms, where sizes of atoms are compared.
pub(super) const LATENCIES_MS: [f64; 3] = [0.1, 1.0, 10.0];

/// Sizes of atoms, in pixels.
const ATOM_SIZES_PX: [u32; 10] = [5000, 2000, 1000, 500, 200, 100, 50, 20, 10, 5];

/// Runs of the ring from which the study reads how accurate its shares are.
pub(super) struct RingAccuracy {
    pub size: Size,
    /// By scene: runs with atoms of 50 pixels, and their transfers.
    pub runs_by_scene: Vec<Vec<RingRun>>,
    /// Runs of the first scene: by latency, then by size of atoms with the coarsest first, then by speeds.
    pub atom_sizes: Vec<AtomSizeRuns>,
}

/// Runs with one size of atoms and one latency, on several rings.
pub(super) struct AtomSizeRuns {
    pub latency_ms: f64,
    pub atom_pixels: u32,
    pub runs: Vec<RingRow>,
}

impl AtomSizeRuns {
    /// Returns the mean of a figure over the runs.
    pub fn mean(&self, of: impl Fn(&RingRow) -> f64) -> f64 {
        self.runs.iter().map(of).sum::<f64>() / self.runs.len() as f64
    }
}

impl RingAccuracy {
    /// Runs rings of eight machines on the scenes' pictures.
    ///
    /// # Errors
    /// [`StudyError::Run`], if a scene cannot be traced.
    pub fn of(scenes: &[Opened], size: Size, progress: &mut Progress<'_>) -> Result<Self, StudyError> {
        let mut runs_by_scene = Vec::new();
        let mut first = None;
        for opened in scenes {
            progress.next(&format!("{}: rings of {NODES} machines", opened.name));
            let fixture = Fixture::new(opened, size, 1)?;
            runs_by_scene.push((0..SEEDS_PER_SCENE).map(|seed| run_default(&fixture, seed)).collect());
            first.get_or_insert(fixture);
        }
        let mut atom_sizes = Vec::new();
        for latency_ms in LATENCIES_MS {
            progress.next(&format!("rings with a latency of {latency_ms} ms"));
            let Some(fixture) = &first else { continue };
            let latency = Duration::from_secs_f64(latency_ms * 1e-3);
            atom_sizes.extend(ATOM_SIZES_PX.map(|atom_pixels| AtomSizeRuns {
                latency_ms,
                atom_pixels,
                runs: (0..SEEDS_PER_ATOM_SIZE).map(|seed| run_ring(fixture, atom_pixels, latency, seed).row).collect(),
            }));
        }
        Ok(Self { size, runs_by_scene, atom_sizes })
    }

    /// Returns all runs as rows.
    pub fn rows(&self) -> Vec<RingRow> {
        let default_runs = self.runs_by_scene.iter().flatten().map(|run| run.row.clone());
        default_runs.chain(self.atom_sizes.iter().flat_map(|group| group.runs.iter().cloned())).collect()
    }

    /// Returns all transfers of runs with atoms of the default size.
    pub fn transfers(&self) -> impl Iterator<Item = &Transfer> {
        self.runs_by_scene.iter().flatten().flat_map(|run| &run.transfers)
    }

    /// Returns the points of all runs with atoms of the default size.
    pub fn all_points(&self) -> Vec<(f64, f64)> {
        self.runs_by_scene.iter().flat_map(|runs| Self::points(runs)).collect()
    }

    /// Returns a point for each run: the error of its estimates, and its lateness.
    pub fn points(runs: &[RingRun]) -> Vec<(f64, f64)> {
        runs.iter().filter_map(|run| Some((run.row.estimate_error?, run.row.lateness))).collect()
    }
}
