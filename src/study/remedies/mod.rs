//! The adaptive ring compared with the article's ring and the farm with leases, and the gain of each remedy alone.

mod cases;
mod growth;
mod measure;
mod report;

use super::progress::Progress;
use super::{ProgressSink, Study, StudyError};
use crate::language::Language;
use crate::scene::Opened;

/// Measures all cases with the scene's picture.
///
/// # Errors
/// A [`StudyError`], if a run fails.
pub fn remedies(scene: &Opened, tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let mut progress = Progress::new(measure::steps() + growth::STEPS, tell);
    let growth = growth::measure(&mut progress);
    let rows = measure::measure(scene, &mut progress)?;
    let mut study = Study::new("remedies");
    study.add_rows(&rows)?;
    study.add_table("growth", &growth)?;
    for (name, chart) in report::charts(&rows).into_iter().chain(growth::charts(&growth)) {
        study.add_chart(&name, &chart.marks(crate::view::CHART_SIZE, Language::English));
    }
    let mut report = report::report(&rows);
    growth::report(&mut report, &growth);
    study.add_report(report);
    Ok(study)
}
