//! Where methods fail: cases that grow harder step by step, and what ours and a naive method make of them.
//!
//! What is true is known without rounding ([`exact`]), of the very numbers that the methods were given.

mod coincident;
mod exact;
mod far;
mod graze;
mod normals;
mod protocol;
mod refraction;
mod report;
mod scaled;
mod starts;
mod subject;
mod torus;

use fastrand::Rng;
use serde::Serialize;

use super::progress::Progress;
use super::{ProgressSink, Study, StudyError};
use crate::view::Scale;

/// Something that is tried at growing hardness, by several methods.
pub(super) struct StabilityCase {
    /// In file names.
    name: &'static str,
    title: &'static str,
    /// What is tried, what counts as wrong, and how the truth is known: sentences.
    about: &'static str,
    /// What grows harder, and its unit.
    parameter: &'static str,
    /// What it is set to, the easiest first. 0 is the hardest: it stands for no distance at all.
    values: Vec<f64>,
    /// The hardest of them at which ours must not be wrong.
    required: f64,
    /// How [`StabilityCase::values`] are drawn.
    scale: Scale,
    /// Ours is the last one; of the protocol, the ring.
    methods: &'static [&'static str],
    /// What [`Verdicts::measured`] is, if it is drawn instead of the share that is wrong.
    measures: Option<&'static str>,
    /// How often each value is tried.
    tries: u32,
    /// Tries one value so often; what comes of it, by method.
    attempt: fn(f64, u32, &mut Rng) -> Vec<Verdicts>,
}

/// What came of a method's tries.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Verdicts {
    tried: u64,
    wrong: u64,
    /// Something else that was measured; `None` if it is infinite, or nothing is.
    measured: Option<f64>,
}

/// What came of one method at one value.
#[derive(Clone, Debug, Serialize)]
pub(super) struct StabilityRow {
    case: &'static str,
    parameter: &'static str,
    value: f64,
    /// Whether ours must not be wrong there.
    required: bool,
    method: &'static str,
    tried: u64,
    wrong: u64,
    /// The greatest error, the greatest time over the ideal one, or how many answers were not even an entry and an exit, as
    /// the case has it.
    measured: Option<f64>,
}

/// All cases, from the geometry to the protocol.
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

/// Tries every case, and says in which range each method holds.
///
/// # Errors
/// A sentence, if the rows could not be written.
pub fn stability(tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let cases = cases();
    let mut progress = Progress::new(cases.len(), tell);
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
        study.add_chart(case.name, &report::chart(case, rows).marks(crate::view::CHART_SIZE));
    }
    study.add_report(report::report(&found));
    Ok(study)
}

impl StabilityCase {
    /// What comes of `tries` at each value: a row for each value and method.
    fn rows(&self, tries: u32) -> Vec<StabilityRow> {
        let mut rows = Vec::new();
        let hardest = self.values.iter().position(|&value| value == self.required);
        for (place, &value) in self.values.iter().enumerate() {
            let outcomes = (self.attempt)(value, tries, &mut Rng::with_seed(place as u64));
            rows.extend(self.methods.iter().zip(outcomes).map(|(&method, outcome)| StabilityRow {
                case: self.name,
                parameter: self.parameter,
                value,
                required: hardest.is_some_and(|hardest| place <= hardest),
                method,
                tried: outcome.tried,
                wrong: outcome.wrong,
                measured: outcome.measured,
            }));
        }
        rows
    }

    /// The name of our method.
    fn ours(&self) -> &'static str {
        self.methods.last().copied().unwrap_or_default()
    }
}

/// Powers of ten, from one exponent to another, which may be less.
fn tens(from: i32, to: i32) -> Vec<f64> {
    powers(from, to).map(|power| 10f64.powi(power)).collect()
}

/// Powers of two.
fn twos(from: i32, to: i32) -> Vec<f64> {
    powers(from, to).map(|power| 2f64.powi(power)).collect()
}

fn powers(from: i32, to: i32) -> impl Iterator<Item = i32> {
    let step = (to - from).signum();
    (0..=(to - from).abs()).map(move |i| from + step * i)
}

/// Counts wrong answers of several methods that try the same.
struct Count<const N: usize>([Verdicts; N]);

impl<const N: usize> Count<N> {
    /// Nothing has been tried.
    fn new() -> Self {
        Self([Verdicts::default(); N])
    }

    /// All have tried once more; which of them were wrong.
    fn add(&mut self, wrong: [bool; N]) {
        for (outcome, wrong) in self.0.iter_mut().zip(wrong) {
            outcome.tried += 1;
            outcome.wrong += u64::from(wrong);
        }
    }

    /// As [`Count::add`], for errors of which none may exceed `most`; what is no number is wrong, and not the greatest.
    fn add_errors(&mut self, errors: [f64; N], most: f64) {
        self.add(errors.map(|error| error.is_nan() || error > most));
        for (outcome, error) in self.0.iter_mut().zip(errors) {
            outcome.measured = Some(outcome.measured.unwrap_or(0.0).max(error));
        }
    }

    fn outcomes(self) -> Vec<Verdicts> {
        self.0.to_vec()
    }
}

/// Tries a case less often than the study does. Ours must hold as far as it is required, and the case must be a hard one:
/// there each other method must be wrong somewhere.
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
    fn every_case_has_a_name_a_chart_and_its_numbers_in_the_report() {
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
    fn the_same_is_tried_each_time() {
        let case = far::sphere();
        let found = || case.rows(50).into_iter().map(|row| row.wrong).collect::<Vec<_>>();
        assert_eq!(found(), found());
    }
}
