//! Studies: many runs, reported as CSV tables, charts and a Markdown report.

pub mod accuracy;
mod chaos;
mod error;
mod exact;
mod fixture;
mod format;
mod markdown;
mod methods;
mod needs;
mod paper;
mod peer;
mod preview_time;
mod progress;
mod random;
mod remedies;
mod rivals;
mod scale;
mod scale_report;
mod stability;

pub use accuracy::accuracy;
pub use chaos::chaos;
pub use error::StudyError;
pub use methods::methods;
pub use needs::needs;
pub use paper::{article_over_ideal, paper};
pub use peer::{PovRayError, peer};
pub use progress::ProgressSink;
pub use remedies::remedies;
pub use rivals::rivals;
pub use scale_report::scale;
pub use stability::stability;

use std::io;

use serde::Serialize;
use serde_json::{Map, Value};

use crate::export::to_svg;
use crate::view::{CHART_SIZE, Mark};
use markdown::Report;

/// The result of a study.
#[derive(Clone, Debug)]
pub struct Study {
    /// The study's name on the command line.
    pub name: &'static str,
    /// A JSON object for each run, with the columns of the CSV.
    pub rows: Vec<Value>,
    /// Results over all runs, for a study with too many runs for a row each.
    pub summary: Map<String, Value>,
    /// Files by name: CSV, SVG charts, PNG pictures, and a Markdown report.
    pub files: Vec<(String, Vec<u8>)>,
}

impl Study {
    fn new(name: &'static str) -> Self {
        Self { name, rows: Vec::new(), summary: Map::new(), files: Vec::new() }
    }

    /// Adds rows to the study's results, as JSON and as the CSV file named after the study.
    fn add_rows(&mut self, rows: &[impl Serialize]) -> Result<(), StudyError> {
        for row in rows {
            self.rows.push(serde_json::to_value(row)?);
        }
        self.add_csv(format!("{}.csv", self.name), rows)
    }

    /// Adds another table, as a CSV file.
    fn add_table(&mut self, name: &str, rows: &[impl Serialize]) -> Result<(), StudyError> {
        self.add_csv(format!("{}-{name}.csv", self.name), rows)
    }

    fn add_csv(&mut self, file: String, rows: &[impl Serialize]) -> Result<(), StudyError> {
        let mut csv = csv::Writer::from_writer(Vec::new());
        let written = rows.iter().try_for_each(|row| csv.serialize(row)).map_err(io::Error::from);
        let bytes = written.and_then(|()| csv.into_inner().map_err(|error| error.into_error()));
        self.files.push((file.clone(), bytes.map_err(|error| StudyError::file(file, error))?));
        Ok(())
    }

    fn add_chart(&mut self, name: &str, marks: &[Mark]) {
        let svg = to_svg(marks, CHART_SIZE);
        self.files.push((format!("{}-{name}.svg", self.name), svg.into_bytes()));
    }

    fn add_report(&mut self, report: Report) {
        self.files.push((format!("{}.md", self.name), report.into_text().into_bytes()));
    }
}

/// Returns the median, the greater of the two middle values if their number is even; 0 for no values.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_is_the_middle_value() {
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), 2.0);
        assert_eq!([median(&mut [1.0, 4.0]), median(&mut [])], [4.0, 0.0]);
    }
}
