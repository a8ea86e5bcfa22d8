//! Speed against accuracy: the cost of each knob of quality and the error of its picture against a reference; and for
//! the ring, the error of its speed estimates and the effect of the size of atoms.
//!
//! [`Reference`], [`measure`] and the automatic choice use no files and no texts, so that the window can apply them to
//! its own scene.

mod charts;
mod check;
mod choice;
mod fit;
mod knobs;
mod measure;
mod reference;
mod report;
mod ring;
mod ring_report;
mod scene;
mod transfers;

pub use choice::{best_within, fastest_within, front};
pub use knobs::{MAX_SAMPLES_PER_SIDE, combinations, size_for};
pub use measure::{Point, measure};
pub use reference::Reference;

use serde::Serialize;

use super::progress::Progress;
use super::{ProgressSink, Study, StudyError};
use crate::language::Language;
use crate::output::as_file_name;
use crate::picture::Size;
use crate::scene::Opened;
use crate::view::CHART_SIZE;
use ring::RingAccuracy;
use scene::{MeasuredPoint, SceneAccuracy};

/// One quality of one scene.
#[derive(Clone, Debug, Serialize)]
struct AccuracyRow {
    scene: String,
    width: u32,
    height: u32,
    /// The knob that is turned alone, or `together`.
    knob: &'static str,
    /// The value of that knob.
    value: Option<f64>,
    samples: u32,
    threshold: f64,
    max_depth: u32,
    cutoff: f64,
    cpu_s: f64,
    rays: u64,
    rmse: f64,
    /// The error of this knob alone.
    rmse_alone: Option<f64>,
    wrong_pixels: u32,
    worst_ssim: f64,
}

/// The knob's name in rows where all knobs are combined.
const TOGETHER: &str = "together";

impl AccuracyRow {
    fn new(found: &SceneAccuracy, entry: &MeasuredPoint) -> Self {
        let MeasuredPoint { knob, value, point, alone } = *entry;
        Self {
            scene: found.scene.clone(),
            width: found.size.width(),
            height: found.size.height(),
            knob: knob.map_or(TOGETHER, |knob| knob.name()),
            value,
            samples: point.quality.samples,
            threshold: point.quality.threshold,
            max_depth: point.quality.max_depth,
            cutoff: point.quality.cutoff,
            cpu_s: point.cpu_s,
            rays: point.rays,
            rmse: point.rmse(),
            rmse_alone: alone,
            wrong_pixels: point.difference.wrong_pixels,
            worst_ssim: point.difference.worst_ssim,
        }
    }
}

/// Measures the scenes, in pictures within `most` that are smaller where a scene's trees of rays are large, and runs of
/// the ring in virtual time.
///
/// # Errors
/// A [`StudyError`], if a thread cannot be started or panics.
pub fn accuracy(scenes: &[Opened], most: Size, tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let mut progress = Progress::new(scenes.len() * (scene::steps() + 1) + ring::STEPS, tell);
    let mut study = Study::new("accuracy");
    let found: Vec<SceneAccuracy> =
        scenes.iter().map(|opened| SceneAccuracy::of(opened, most, &mut progress)).collect::<Result<_, _>>()?;
    let ring = RingAccuracy::of(scenes, most, &mut progress)?;
    let rows: Vec<AccuracyRow> =
        found.iter().flat_map(|found| found.measured.iter().map(|entry| AccuracyRow::new(found, entry))).collect();
    study.add_rows(&rows)?;
    study.add_table("ring", &ring.rows())?;
    for found in &found {
        let name = as_file_name(&found.scene);
        study.add_chart(&format!("{name}-front"), &charts::front(found).marks(CHART_SIZE, Language::English));
        study.add_chart(&format!("{name}-alone"), &charts::alone(found).marks(CHART_SIZE, Language::English));
    }
    study.add_chart("estimate", &charts::estimate(&ring).marks(CHART_SIZE, Language::English));
    study.add_chart("lateness", &charts::lateness(&ring).marks(CHART_SIZE, Language::English));
    study.add_chart("atoms", &charts::atoms(&ring).marks(CHART_SIZE, Language::English));
    study.add_report(report::report(&found, &ring));
    Ok(study)
}
