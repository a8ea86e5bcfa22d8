//! From 4 to 1,024 machines: efficiency, and growth of messages.

use std::time::Duration;

use fastrand::Rng;
use serde::Serialize;

use super::super::markdown::Report;
use super::super::progress::Progress;
use crate::balance::{Remedies, Remedy, Rules, Strategy};
use crate::picture::Size;
use crate::runlog::{Driver, Header, LinkSettings};
use crate::study::fixture::{AtomCosts, simulate, weighted_costs};
use crate::view::{Axis, LineChart, Scale, Series, Style, series_hue};

/// Numbers of machines.
const NODE_COUNTS: [usize; 5] = [4, 16, 64, 256, 1024];
/// Atoms per machine.
const ATOMS_PER_NODE: u32 = 512;
/// Mean CPU time of an atom.
const ATOM_COST: Duration = Duration::from_millis(2);
/// Latency of a message.
const LATENCY: Duration = Duration::from_millis(1);
/// Where the work is uneven, nine tenths of it are in this fraction of the picture: one sixteenth.
const DENSE_PART_DIVISOR: usize = 16;
/// Strategies that are compared.
const RIVALS: [(&str, Strategy, Remedies); 4] = [
    ("ring", Strategy::Ring, Remedies::ALL),
    ("farm-leases", Strategy::FarmLeases, Remedies::ALL),
    ("adaptive", Strategy::Adaptive, Remedies::ALL),
    ("without shortcuts", Strategy::Adaptive, Remedies::ALL.without(Remedy::Shortcuts)),
];

/// One run.
#[derive(Clone, Debug, Serialize)]
pub(super) struct GrowthRow {
    pub nodes: usize,
    pub uneven: bool,
    pub rival: &'static str,
    pub efficiency: f64,
    pub makespan_s: f64,
    pub messages_per_node: f64,
    /// Offers, hops, notes (offers left with sleepers) and wakes per machine.
    pub asking_per_node: f64,
    pub transfers_per_node: f64,
}

/// Number of steps that [`measure`] takes.
pub(super) const STEPS: usize = 2 * NODE_COUNTS.len();

/// Simulates all runs in virtual time.
pub(super) fn measure(progress: &mut Progress<'_>) -> Vec<GrowthRow> {
    let mut rows = Vec::new();
    for uneven in [false, true] {
        for nodes in NODE_COUNTS {
            progress.next(&format!("{nodes} machines"));
            let costs = costs(nodes, uneven);
            rows.extend(
                RIVALS.map(|(name, strategy, remedies)| row(nodes, uneven, &costs, name, (strategy, remedies))),
            );
        }
    }
    rows
}

/// Returns random costs within a tenfold range; if `uneven`, nine tenths of the work are in one part of the picture.
fn costs(nodes: usize, uneven: bool) -> AtomCosts {
    let mut rng = Rng::with_seed(nodes as u64);
    let atoms = ATOMS_PER_NODE as usize * nodes;
    let dear = if uneven { 0.9 * DENSE_PART_DIVISOR as f64 } else { 1.0 };
    let cheap = if uneven { 0.1 * DENSE_PART_DIVISOR as f64 / (DENSE_PART_DIVISOR as f64 - 1.0) } else { 1.0 };
    let weight = |atom| 10f64.powf(rng.f64()) * if atom < atoms / DENSE_PART_DIVISOR { dear } else { cheap };
    weighted_costs((0..atoms).map(weight).collect(), ATOM_COST)
}

fn row(
    nodes: usize,
    uneven: bool,
    costs: &AtomCosts,
    rival: &'static str,
    (strategy, remedies): (Strategy, Remedies),
) -> GrowthRow {
    // Pictures of this many atoms are small enough.
    let size = Size::new(50, costs.len() as u32).unwrap_or_else(|why| unreachable!("{why}"));
    let plain = Header::plain(size, 50, strategy, vec![1.0; nodes]);
    let header = Header {
        driver: Driver::Sim,
        rules: Rules { batch: None, remedies, ..plain.rules },
        link: LinkSettings { latency: LATENCY, ..plain.link },
        ..plain
    };
    let metrics = simulate(&header, &[], costs);
    let messages = metrics.messages();
    let a_node = |count: u64| count as f64 / nodes as f64;
    GrowthRow {
        nodes,
        uneven,
        rival,
        efficiency: metrics.efficiency().unwrap_or_default(),
        makespan_s: metrics.makespan().unwrap_or_default().as_secs_f64(),
        messages_per_node: a_node(messages.total),
        asking_per_node: a_node(messages.offers + messages.hops + messages.notes + messages.wakes),
        transfers_per_node: a_node(messages.transfers),
    }
}

/// Charts efficiency, and messages per machine, by number of machines.
pub(super) fn charts(rows: &[GrowthRow]) -> Vec<(String, LineChart)> {
    let mut charts = Vec::new();
    for uneven in [false, true] {
        let kind = if uneven { "uneven" } else { "even" };
        let words = if uneven { "nine tenths of the work in a sixteenth of the picture" } else { "work spread evenly" };
        let efficiency = chart(rows, uneven, "efficiency", Scale::Linear, |row| row.efficiency);
        charts.push((
            format!("growth-{kind}"),
            LineChart { title: format!("A picture that grows: {words}"), ..efficiency },
        ));
        let asking =
            chart(rows, uneven, "offers, hops, notes and wakes per machine", Scale::Log10, |row| row.asking_per_node);
        charts.push((
            format!("asking-{kind}"),
            LineChart { title: format!("Growth of messages that look for work: {words}"), ..asking },
        ));
    }
    charts
}

fn chart(rows: &[GrowthRow], uneven: bool, label: &str, scale: Scale, value: impl Fn(&GrowthRow) -> f64) -> LineChart {
    let line = |(place, (name, ..)): (usize, (&str, Strategy, Remedies))| {
        let of = rows.iter().filter(|row| row.uneven == uneven && row.rival == name);
        let points = of.map(|row| (row.nodes as f64, value(row))).collect();
        Series { name: name.into(), hue: series_hue(place), points, style: Style::Line }
    };
    let range = (scale == Scale::Linear).then_some((0.0, 1.0));
    LineChart {
        note: format!("{} ms a message, {ATOMS_PER_NODE} atoms per machine", LATENCY.as_millis()),
        x: Axis { label: "machines".into(), scale: Scale::Log2, range: None },
        y: Axis { label: label.into(), scale, range },
        series: RIVALS.into_iter().enumerate().map(line).collect(),
        ..LineChart::default()
    }
}

/// Adds the chapter on growth: a table for even and for uneven work.
pub(super) fn report(report: &mut Report, rows: &[GrowthRow]) {
    report.line("\n## From 4 to 1,024 machines\n");
    report.line(format!(
        "In virtual time, with {} ms a message and {ATOMS_PER_NODE} atoms of {} ms per machine. Each cell: \
         efficiency, and in brackets offers, hops, notes and wakes per machine.\n",
        LATENCY.as_millis(),
        ATOM_COST.as_millis()
    ));
    for uneven in [false, true] {
        let kind = if uneven { "Nine tenths of the work in a sixteenth of the picture" } else { "Work spread evenly" };
        report.line(format!("### {kind}\n"));
        report.line(format!(
            "| machines | log₂ | {} |\n|--:|--:|{}",
            RIVALS.map(|(name, ..)| name).join(" | "),
            "--:|".repeat(RIVALS.len())
        ));
        for nodes in NODE_COUNTS {
            let cell = |name| {
                let row = rows.iter().find(|row| row.uneven == uneven && row.nodes == nodes && row.rival == name);
                row.map_or(String::new(), |row| format!("{:.3} ({:.0})", row.efficiency, row.asking_per_node))
            };
            report.line(format!(
                "| {nodes} | {} | {} |",
                nodes.ilog2(),
                RIVALS.map(|(name, ..)| cell(name)).join(" | ")
            ));
        }
        report.line("");
    }
}
