//! Where methods fail: cases of growing difficulty, for this program's method and for naive ones.
//!
//! The truth is computed without rounding ([`exact`](super::exact)), from the very numbers that the methods get.

mod coincident;
mod far;
mod graze;
mod lost;
mod normals;
mod placed_primitive;
mod plain;
mod protocol;
mod refraction;
mod report;
mod scaled;
mod starts;
pub(super) mod torus;
mod wrong;

use fastrand::Rng;
use serde::Serialize;

use super::progress::Progress;
use super::{ProgressSink, Study, StudyError};
use crate::language::Language;
use crate::view::Scale;

/// A numerical test of growing difficulty, and the methods that are put to it.
pub(super) struct StabilityCase {
    /// Name in file names.
    name: &'static str,
    title: &'static str,
    /// Description for the report: the test, what counts as wrong, and the source of the truth.
    about: &'static str,
    /// The parameter that makes it harder, with its unit.
    parameter: &'static str,
    /// Values of the parameter, the easiest first. 0 is the hardest: no distance at all.
    values: Vec<f64>,
    /// The hardest value at which this program's method must not be wrong.
    required: f64,
    /// Scale of [`StabilityCase::values`] in the chart.
    scale: Scale,
    /// Methods; this program's is the last. Of the protocol, it is the ring.
    methods: &'static [&'static str],
    /// Meaning of [`MethodResult::measured`], if it is charted instead of the share of wrong answers.
    measured_figure: Option<&'static str>,
    /// Number of tries for each value.
    tries: u32,
    /// Tries one value a number of times; returns the results by method.
    attempt: fn(f64, u32, &mut Rng) -> Vec<MethodResult>,
}

/// Result of a method's tries.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct MethodResult {
    tried: u64,
    wrong: u64,
    /// Another measured figure; `None` if it is infinite, or if there is none.
    measured: Option<f64>,
}

/// Result of one method at one value.
#[derive(Clone, Debug, Serialize)]
pub(super) struct StabilityRow {
    case: &'static str,
    parameter: &'static str,
    value: f64,
    /// Whether this program's method must not be wrong there.
    required: bool,
    method: &'static str,
    tried: u64,
    wrong: u64,
    /// By case: the greatest error, the greatest makespan / ideal, or the number of answers that are not even an entry
    /// and an exit.
    measured: Option<f64>,
}

/// Returns all cases, from the geometry to the protocol.
fn cases() -> Vec<StabilityCase> {
    let mut cases = vec![far::sphere()];
    cases.extend(graze::cases());
    cases.extend(torus::cases());
    cases.extend(coincident::cases());
    cases.extend([starts::on_faces(), scaled::scenes()]);
    cases.extend(refraction::cases());
    cases.extend(normals::cases());
    cases.extend(protocol::cases());
    cases
}

/// Tries every case, and reports the range in which each method holds.
///
/// # Errors
/// A [`StudyError`], if a table cannot be made.
pub fn stability(tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let cases = cases();
    let mut progress = Progress::new(cases.len() + 2, tell);
    let mut study = Study::new("stability");
    let (mut rows, mut ends) = (Vec::new(), Vec::new());
    for case in &cases {
        progress.next(case.title);
        rows.extend(case.rows(case.tries));
        ends.push(rows.len());
    }
    study.add_rows(&rows)?;
    let starts = [0].into_iter().chain(ends.iter().copied());
    let found: Vec<(&StabilityCase, &[StabilityRow])> =
        cases.iter().zip(starts.zip(&ends)).map(|(case, (start, &end))| (case, &rows[start..end])).collect();
    for (case, rows) in &found {
        study.add_chart(case.name, &report::chart(case, rows).marks(crate::view::CHART_SIZE, Language::English));
    }
    progress.next("Lost rays");
    let lost = lost::rows()?;
    study.add_table("lost", &lost)?;
    progress.next("Wrong pixels");
    let wrong = wrong::rows()?;
    study.add_table("wrong", &wrong)?;
    let mut report = report::report(&found);
    lost::report(&mut report, &lost);
    wrong::report(&mut report, &wrong);
    report.line("\nAll numbers are in `stability.csv`, `stability-lost.csv` and `stability-wrong.csv`.");
    study.add_report(report);
    Ok(study)
}

impl StabilityCase {
    /// Tries each value `tries` times and returns a row for each value and method.
    fn rows(&self, tries: u32) -> Vec<StabilityRow> {
        let mut rows = Vec::new();
        let hardest = self.values.iter().position(|&value| value == self.required);
        for (place, &value) in self.values.iter().enumerate() {
            let results = (self.attempt)(value, tries, &mut Rng::with_seed(place as u64));
            rows.extend(self.methods.iter().zip(results).map(|(&method, result)| StabilityRow {
                case: self.name,
                parameter: self.parameter,
                value,
                required: hardest.is_some_and(|hardest| place <= hardest),
                method,
                tried: result.tried,
                wrong: result.wrong,
                measured: result.measured,
            }));
        }
        rows
    }

    /// Returns the name of this program's method.
    fn ours(&self) -> &'static str {
        self.methods.last().copied().unwrap_or_default()
    }
}

/// Returns powers of ten, from one exponent to another, which may be smaller.
fn powers_of_10(from: i32, to: i32) -> Vec<f64> {
    exponents(from, to).map(|power| 10f64.powi(power)).collect()
}

/// Returns powers of two, from one exponent to another, which may be smaller.
fn powers_of_2(from: i32, to: i32) -> Vec<f64> {
    exponents(from, to).map(|power| 2f64.powi(power)).collect()
}

fn exponents(from: i32, to: i32) -> impl Iterator<Item = i32> {
    let step = (to - from).signum();
    (0..=(to - from).abs()).map(move |i| from + step * i)
}

/// Counts wrong answers of several methods on the same tries.
struct ResultCounter<const N: usize>([MethodResult; N]);

impl<const N: usize> ResultCounter<N> {
    /// Starts without tries.
    fn new() -> Self {
        Self([MethodResult::default(); N])
    }

    /// Adds a try; `wrong` tells by method whether its answer is wrong.
    fn add(&mut self, wrong: [bool; N]) {
        for (result, wrong) in self.0.iter_mut().zip(wrong) {
            result.tried += 1;
            result.wrong += u64::from(wrong);
        }
    }

    /// Adds a try with errors, of which none may exceed `most`; NaN counts as wrong, but not as the greatest error.
    fn add_errors(&mut self, errors: [f64; N], most: f64) {
        self.add(errors.map(|error| error.is_nan() || error > most));
        for (result, error) in self.0.iter_mut().zip(errors) {
            result.measured = Some(result.measured.unwrap_or(0.0).max(error));
        }
    }

    fn results(self) -> Vec<MethodResult> {
        self.0.to_vec()
    }
}

/// Tries a case less often than the study does. This program's method must hold as far as required, and the case must
/// be hard: within that range every other method must be wrong somewhere.
#[cfg(test)]
fn check(case: &StabilityCase, tries: u32) {
    let rows = case.rows(tries);
    assert_eq!(rows.len(), case.values.len() * case.methods.len(), "{}", case.name);
    for method in case.methods {
        let required = rows.iter().filter(|row| row.method == *method && row.required);
        let wrong: Vec<(f64, u64)> =
            required.map(|row| (row.value, row.wrong)).filter(|(_, wrong)| *wrong > 0).collect();
        assert_eq!(wrong.is_empty(), *method == case.ours(), "{}, {method}: {wrong:?} of {tries}", case.name);
    }
    assert!(rows.iter().any(|row| row.required), "{}: {} is no value", case.name, case.required);
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn cases_have_distinct_names_charts_and_figures_in_the_report() {
        let cases = cases();
        let names: BTreeSet<&str> = cases.iter().map(|case| case.name).collect();
        assert_eq!(names.len(), cases.len());
        let rows: Vec<Vec<StabilityRow>> = cases.iter().map(|case| case.rows(4)).collect();
        let found: Vec<(&StabilityCase, &[StabilityRow])> =
            cases.iter().zip(&rows).map(|(case, rows)| (case, &rows[..])).collect();
        let report = report::report(&found).into_text();
        for (case, rows) in found {
            assert!(report.contains(&format!("](stability-{}.svg)", case.name)) && report.contains(case.about));
            let lines: Vec<usize> = report::chart(case, rows).series.iter().map(|series| series.points.len()).collect();
            assert!(lines[..case.methods.len()].iter().all(|&points| points == case.values.len()), "{}", case.name);
        }
        assert!(!report.contains("NaN") && !report.contains("inf"));
    }

    #[test]
    fn tries_are_reproducible() {
        let case = far::sphere();
        let found = || case.rows(50).into_iter().map(|row| row.wrong).collect::<Vec<_>>();
        assert_eq!(found(), found());
    }
}
