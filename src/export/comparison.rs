//! Compared runs as files: a CSV row per run, and a bar chart of their time budgets.

use std::collections::BTreeSet;
use std::io::{self, Write};

use serde::Serialize;

use super::drawing::write_drawing;
use super::to_svg;
use crate::balance::Strategy;
use crate::language::Language;
use crate::picture::Size;
use crate::sim::Change;
use crate::view::{PrintedDrawing, TimeBudget, trial_name};

/// Compared runs of one scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Title of the comparison.
    pub title: String,
    /// Size of the picture.
    pub size: Size,
    /// The runs, in the order in which they are shown.
    pub runs: Vec<ComparisonEntry>,
}

/// A compared run.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparisonEntry {
    /// How the atoms are distributed.
    pub strategy: Strategy,
    /// Changes from the first run.
    pub changes: Vec<Change>,
    /// Number of machines.
    pub machines: usize,
    /// Its time budget; `None` if the run never ends.
    pub account: Option<TimeBudget>,
}

/// Row of a run; most fields of a run that never ends are empty.
#[derive(Serialize)]
struct ComparisonRow {
    run: String,
    strategy: &'static str,
    machines: usize,
    time_s: Option<f64>,
    ideal_s: Option<f64>,
    efficiency: Option<f64>,
    tracing_s: Option<f64>,
    starting_s: Option<f64>,
    asking_s: Option<f64>,
    stopped_s: Option<f64>,
    waiting_s: Option<f64>,
    alone_s: Option<f64>,
    sharing_messages: Option<u64>,
    results_messages: Option<u64>,
    transfers: Option<u64>,
    atoms_moved: Option<u64>,
}

impl Comparison {
    /// Writes the runs as CSV, with a header row.
    ///
    /// # Errors
    /// The error of writing to `to`.
    pub fn write_csv(&self, to: impl Write) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(to);
        self.runs.iter().try_for_each(|run| table.serialize(run.row()))?;
        table.flush()
    }

    /// Returns the time budgets of the runs that end as a bar chart in SVG.
    pub fn bars_svg(&self) -> String {
        let names: Vec<String> = self.runs.iter().map(ComparisonEntry::name).collect();
        let accounts = self.runs.iter().map(|run| run.account.as_ref());
        let runs: Vec<(&str, &TimeBudget)> =
            names.iter().zip(accounts).filter_map(|(name, account)| Some((name.as_str(), account?))).collect();
        let title = format!("{}, {}, in virtual time", self.title, self.size);
        let PrintedDrawing { marks, size } = PrintedDrawing::comparison(&title, &runs, Language::English);
        to_svg(&marks, size)
    }

    /// Writes the bar chart: as PNG if `is_png`, else as SVG. Returns the letters that no font of this computer has,
    /// and that are drawn as boxes.
    ///
    /// # Errors
    /// The error of writing to `to`; an [`ExportError`](super::ExportError), if the chart cannot become pixels.
    pub fn write_bars(&self, to: impl Write, is_png: bool) -> io::Result<BTreeSet<char>> {
        write_drawing(to, &self.bars_svg(), is_png)
    }
}

impl ComparisonEntry {
    fn name(&self) -> String {
        trial_name(&self.strategy, &self.changes, Language::English)
    }

    fn row(&self) -> ComparisonRow {
        let known = self.account.as_ref();
        let of = |figure: fn(&TimeBudget) -> f64| known.map(figure);
        let counted = |figure: fn(&TimeBudget) -> u64| known.map(figure);
        ComparisonRow {
            run: self.name(),
            strategy: self.strategy.name(),
            machines: self.machines,
            time_s: of(|account| account.makespan.as_secs_f64()),
            ideal_s: of(|account| account.ideal.as_secs_f64()),
            efficiency: of(TimeBudget::efficiency),
            tracing_s: of(|account| account.spent.tracing),
            starting_s: of(|account| account.spent.starting),
            asking_s: of(|account| account.spent.asking),
            stopped_s: of(|account| account.spent.stopped),
            waiting_s: of(|account| account.spent.waiting),
            alone_s: of(|account| account.last.alone.as_secs_f64()),
            sharing_messages: counted(|account| account.messages.sharing()),
            results_messages: counted(|account| account.messages.results),
            transfers: counted(|account| account.messages.transfers),
            atoms_moved: counted(|account| account.messages.atoms_moved),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::runlog::examples::header;
    use crate::sim::{PixelCosts, Trial};

    fn comparison() -> Comparison {
        let ring = Trial::new(header(&[1.0, 1.0, 0.1]), Vec::new());
        let costs = vec![Duration::from_micros(50); ring.header.size.pixels() as usize];
        let costs = PixelCosts::new(ring.header.size, &costs);
        let run = |strategy, changes: Vec<Change>| {
            let trial = changes.iter().fold(ring.clone(), |trial, change| trial.with(change.clone()));
            let account = TimeBudget::of(&trial.run(&costs));
            ComparisonEntry { strategy, changes, machines: 3, account }
        };
        let bands = run(Strategy::Static, vec![Change::Strategy(Strategy::Static)]);
        let endless = run(Strategy::Static, vec![Change::Strategy(Strategy::Static), Change::Speed(2, 0.0)]);
        Comparison {
            title: "three, of which one is slow".into(),
            size: ring.header.size,
            runs: vec![run(Strategy::Ring, vec![]), bands, endless],
        }
    }

    #[test]
    fn endless_run_has_a_row_without_times() {
        let (comparison, mut file) = (comparison(), Vec::new());
        comparison.write_csv(&mut file).expect("it is written");
        let mut read = csv::Reader::from_reader(&*file);
        let rows: Vec<csv::StringRecord> = read.records().map(|row| row.expect("a row")).collect();
        assert_eq!([&rows[0][0], &rows[1][0], &rows[2][0]], ["Ring", "Equal bands", "Equal bands, 3 at 0 %"]);
        let seconds: Vec<Option<f64>> = rows.iter().map(|row| row[3].parse().ok()).collect();
        assert!(seconds[1] > seconds[0] && seconds[0] > Some(0.0) && seconds[2].is_none(), "{seconds:?}");
    }

    #[test]
    fn bars_name_only_runs_that_end() {
        let (comparison, mut file) = (comparison(), Vec::new());
        comparison.write_bars(&mut file, false).expect("it is written");
        let svg = String::from_utf8(file).expect("a text");
        for said in ["three, of which one is slow", ">Ring<", ">Equal bands<", "waiting at the end"] {
            assert!(svg.contains(said), "{said}: {svg}");
        }
        assert!(!svg.contains("3 at 0 %"));
    }
}
