//! The article's comparison, Figures 5 to 9, with a verdict on each of its claims.

mod article;
mod charts;
mod claims;
mod division;
mod measure;
mod report;
mod rows;

use std::time::Duration;

use super::fixture::{Fixture, estimate_cost};
use super::progress::Progress;
use super::rivals::{self, RivalRow};
use super::{ProgressSink, Study, StudyError};
use crate::parallel::cores;
use crate::picture::{Quality, Size};
use crate::scene::Opened;
use crate::tracer::Tracer;
pub use article::over_ideal as article_over_ideal;
use measure::PaperRuns;
use rows::PaperRow;

/// Makespan of a run of four machines on threads: "a second or more"; and the threads' pauses make work dearer.
const THREAD_RUN_TIME: Duration = Duration::from_millis(1100);

/// Runs Figures 5 to 9 on threads and in virtual time, without a network and on a modelled one, with further
/// comparisons of the strategies, and judges each claim of §7, §10 and §11.
///
/// # Errors
/// A [`StudyError`], if a run fails.
pub fn paper(scene: &Opened, tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let mut progress = Progress::new(3 + PaperRuns::THREAD_STEPS + rivals::STEPS, tell);
    progress.next("cost of the picture");
    let size = Size::new(640, 480).map_err(StudyError::size)?;
    let (samples, work, pace) = long_enough(scene, size);
    let fixture = Fixture::new(scene, size, samples)?;
    let mut runs = PaperRuns::new(&fixture, work, pace);
    progress.next("virtual time");
    runs.simulated();
    runs.sizes();
    runs.swings();
    let handling = runs.handling();
    runs.threads(&mut progress)?;
    let competing = rivals::run_rivals(&fixture, &mut progress)?;
    progress.next("rays between owners");
    // The article's picture has one sample a pixel.
    let divisions = division::count(&Tracer::new(&scene.scene, size, Quality::default()));
    let found = PaperFindings { fixture: &fixture, pace, rows: runs.rows, handling, competing, divisions };
    found.written()
}

/// Results of all parts of the study.
struct PaperFindings<'a> {
    fixture: &'a Fixture,
    /// Fraction of a core that a machine of the article's speed gets.
    pace: f64,
    rows: Vec<PaperRow>,
    /// See [`PaperRuns::handling`].
    handling: Vec<(f64, [f64; 4])>,
    /// The ring, the ring with two threads a node, and rayon.
    competing: [RivalRow; 3],
    divisions: Vec<division::SpaceDivision>,
}

impl PaperFindings<'_> {
    /// Writes the tables, charts and report.
    fn written(&self) -> Result<Study, StudyError> {
        let mut study = Study::new("paper");
        study.add_rows(&self.rows)?;
        for (name, marks) in charts::all(&self.rows, &self.handling) {
            study.add_chart(name, &marks);
        }
        study.add_report(report::report(self));
        Ok(study)
    }
}

/// Chooses samples a pixel and a pace, and returns them with the CPU time of that picture: a run of four machines lasts
/// [`THREAD_RUN_TIME`], and five machines take no more than half of the computer.
fn long_enough(scene: &Opened, size: Size) -> (u32, Duration, f64) {
    let most = (0.1 * cores() as f64).min(1.0);
    let pace = |work: Duration| work.div_duration_f64(4 * THREAD_RUN_TIME);
    let costs = (1..=8).map(|samples| (samples, estimate_cost(scene, size, samples)));
    // Where even one sample takes too long, runs last longer.
    let fitting = costs.take_while(|&(samples, work)| samples == 1 || pace(work) <= most).last();
    let (samples, work) = fitting.unwrap_or((1, THREAD_RUN_TIME));
    (samples, work, pace(work).clamp(1e-3, most))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs on threads take minutes; runs in virtual time stand in for them here.
    #[test]
    fn report_shows_all_charts_and_no_missing_numbers() {
        let scene = Opened::new("ten-objects").unwrap();
        let fixture = Fixture::new(&scene, Size::new(100, 75).unwrap(), 1).unwrap();
        let mut runs = PaperRuns::new(&fixture, THREAD_RUN_TIME, 0.2);
        runs.simulated();
        runs.sizes();
        runs.swings();
        let handling = runs.handling();
        let on_threads = |row: &PaperRow| PaperRow { driver: "threads", twin_s: Some(row.makespan_s), ..row.clone() };
        let rows: Vec<PaperRow> = runs.rows.iter().flat_map(|row| [row.clone(), on_threads(row)]).collect();
        let needs = RivalRow::example();
        let divisions = division::count(&fixture.tracer);
        let found = PaperFindings {
            fixture: &fixture,
            pace: 0.2,
            rows,
            handling,
            competing: [(); 3].map(|()| needs.clone()),
            divisions,
        };
        let Study { files, rows, .. } = found.written().unwrap();
        let text = |name: &str| {
            let (_, bytes) = files.iter().find(|(file, _)| file == name).unwrap_or_else(|| panic!("{name}"));
            str::from_utf8(bytes).unwrap()
        };
        let report = text("paper.md");
        assert!(!report.contains("NaN") && !report.contains("inf"), "{report}");
        let shown: Vec<&str> = report.split("![](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
        for name in &shown {
            roxmltree::Document::parse(text(name)).unwrap();
        }
        assert_eq!(shown.len() + 2, files.len(), "every chart is shown: {shown:?}");
        assert_eq!(
            csv::Reader::from_reader(text("paper.csv").as_bytes()).records().map(Result::unwrap).count(),
            rows.len()
        );
        let verdicts = report.lines().filter(|line| line.starts_with("- **")).count();
        assert_eq!(verdicts, 7, "{report}");
    }
}
