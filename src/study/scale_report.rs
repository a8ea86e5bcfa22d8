//! The report of the study of scaling.

use super::fixture::STRATEGIES;
use super::markdown::Report;
use super::scale::{ATOM_COST, ATOMS_PER_NODE, NETWORKS_MS, STRONG_PX, ScaleRow, measure, node_counts};
use super::{ProgressSink, Study, StudyError};
use crate::balance::Strategy;
use crate::language::Language;
use crate::scene::Opened;
use crate::view::{Axis, CHART_SIZE, LineChart, Scale, Series, Style, series_hue};

/// Runs every strategy with 1 to 1,024 machines in virtual time, on the same picture and on one that grows with the
/// machines, at latencies of 0.1, 1 and 10 ms.
///
/// # Errors
/// A [`StudyError`], if the scene cannot be traced.
pub fn scale(scene: &Opened, tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let rows = measure(scene, tell)?;
    let mut study = Study::new("scale");
    study.add_rows(&rows)?;
    for weak in [false, true] {
        let kind = if weak { "weak" } else { "strong" };
        for network in NETWORKS_MS {
            let chart = efficiency(&rows, weak, network);
            study.add_chart(
                &format!("{kind}-{}", network_file_name(network)),
                &chart.marks(CHART_SIZE, Language::English),
            );
        }
        study.add_chart(&format!("{kind}-messages"), &messages(&rows, weak).marks(CHART_SIZE, Language::English));
    }
    study.add_chart("ring", &ring_chart(&rows).marks(CHART_SIZE, Language::English));
    study.add_report(report(&rows, &scene.name));
    Ok(study)
}

fn nodes_axis() -> Axis {
    Axis { label: "machines".into(), scale: Scale::Log2, range: None }
}

/// Returns a network's part of a file name.
fn network_file_name((latency, handling): (f64, f64)) -> String {
    if handling > 0.0 { format!("{latency}ms-busy-parent") } else { format!("{latency}ms") }
}

/// Describes a network.
fn network_words((latency, handling): (f64, f64)) -> String {
    let busy = if handling > 0.0 { format!(", the parent busy for {handling} ms with each") } else { String::new() };
    format!("{latency} ms a message{busy}")
}

fn select(
    rows: &[ScaleRow],
    weak: bool,
    network: (f64, f64),
    strategy: Strategy,
) -> impl Iterator<Item = &ScaleRow> + Clone {
    let is = |seconds: f64, ms: f64| (seconds - ms * 1e-3).abs() < 1e-9;
    rows.iter().filter(move |row| {
        row.weak == weak
            && row.strategy == strategy.name()
            && is(row.latency_s, network.0)
            && is(row.handling_s, network.1)
    })
}

fn points<'a>(rows: impl Iterator<Item = &'a ScaleRow>, value: impl Fn(&ScaleRow) -> f64) -> Vec<(f64, f64)> {
    rows.map(|row| (row.nodes as f64, value(row))).collect()
}

fn efficiency(rows: &[ScaleRow], weak: bool, network: (f64, f64)) -> LineChart {
    let line = |(i, strategy): (usize, Strategy)| Series {
        name: strategy.name().into(),
        hue: series_hue(i),
        points: points(select(rows, weak, network, strategy), |row| row.efficiency),
        style: Style::Line,
    };
    let mut series: Vec<Series> = STRATEGIES.into_iter().enumerate().map(line).collect();
    series.push(Series {
        name: "W/m + 3.65 log₂W".into(),
        hue: series_hue(STRATEGIES.len()),
        points: points(select(rows, weak, network, Strategy::Ring), |row| row.bound_efficiency),
        style: Style::Dashed,
    });
    LineChart {
        title: if weak { "A picture that grows with the machines" } else { "The same picture" }.into(),
        note: format!("{}; dashed: work stealing with free messages", network_words(network)),
        x: nodes_axis(),
        y: Axis { label: "efficiency: ideal / makespan".into(), scale: Scale::Linear, range: Some((0.0, 1.0)) },
        series,
    }
}

fn messages(rows: &[ScaleRow], weak: bool) -> LineChart {
    let line = |(i, strategy): (usize, Strategy)| Series {
        name: strategy.name().into(),
        hue: series_hue(i),
        points: points(select(rows, weak, NETWORKS_MS[1], strategy), |row| row.messages_per_node),
        style: Style::Line,
    };
    LineChart {
        title: format!("Messages per machine, {}", if weak { "a picture that grows" } else { "the same picture" }),
        note: network_words(NETWORKS_MS[1]),
        x: nodes_axis(),
        y: Axis { label: "messages per machine".into(), scale: Scale::Log10, range: None },
        series: STRATEGIES.into_iter().enumerate().map(line).collect(),
    }
}

/// Charts how the ring's efficiency falls: the baseline for improvements.
fn ring_chart(rows: &[ScaleRow]) -> LineChart {
    let line = |(i, (weak, network)): (usize, (bool, (f64, f64)))| Series {
        name: format!("{} {} ms", if weak { "grown," } else { "same," }, network.0),
        hue: series_hue(i),
        points: points(select(rows, weak, network, Strategy::Ring), |row| row.efficiency),
        style: if weak { Style::Dashed } else { Style::Line },
    };
    let free = NETWORKS_MS.into_iter().filter(|(_, handling)| *handling == 0.0);
    let kinds = [false, true].into_iter().flat_map(|weak| free.clone().map(move |network| (weak, network)));
    LineChart {
        title: "How the ring's efficiency falls".into(),
        note: "Dashed: the picture grows with the machines".into(),
        x: nodes_axis(),
        y: Axis { label: "efficiency".into(), scale: Scale::Linear, range: Some((0.0, 1.0)) },
        series: kinds.enumerate().map(line).collect(),
    }
}

fn report(rows: &[ScaleRow], scene: &str) -> Report {
    let mut report = Report::titled("From 1 to 1,024 machines");
    report.line(format!(
        "All runs are in virtual time. The scene is {scene}; an atom of 50 pixels costs {} ms on average, in \
         proportion to its rays. *The same picture* has {} × {} pixels; *the grown picture* has {ATOMS_PER_NODE} atoms \
         per machine. A machine sends its results when it has no atoms left. Efficiency is ideal / makespan. The \
         bound is W/m + 3.65 log₂W atoms' time, for work stealing on m machines with messages that take no time (M. \
         Tchiboukdjian, N. Gast, D. Trystram, J.-L. Roch, J. Bernard, 2010).\n",
        ATOM_COST.as_millis(),
        STRONG_PX.0,
        STRONG_PX.1
    ));
    for weak in [false, true] {
        for network in NETWORKS_MS {
            let kind = if weak { "The picture grows with the machines" } else { "The same picture" };
            report.line(format!("## {kind}, {}\n", network_words(network)));
            let names = STRATEGIES.map(|strategy| strategy.name()).join(" | ");
            report.line(format!("| machines | {names} | bound | ring: messages per machine | idle at the end |"));
            report.line(format!("|---:|{}---:|---:|---:|", "---:|".repeat(STRATEGIES.len())));
            for nodes in node_counts() {
                let at = |strategy| select(rows, weak, network, strategy).find(|row| row.nodes == nodes);
                let cells = STRATEGIES
                    .map(|strategy| at(strategy).map_or(String::new(), |row| format!("{:.3}", row.efficiency)));
                let Some(ring) = at(Strategy::Ring) else { continue };
                report.line(format!(
                    "| {nodes} | {} | {:.3} | {:.1} | {:.3} |",
                    cells.join(" | "),
                    ring.bound_efficiency,
                    ring.messages_per_node,
                    ring.tail_idle
                ));
            }
            let chart = network_file_name(network);
            report.line(format!("\n![](scale-{}-{chart}.svg)\n", if weak { "weak" } else { "strong" }));
        }
    }
    report.line("## Messages\n");
    report.line("![](scale-strong-messages.svg)\n\n![](scale-weak-messages.svg)\n");
    report.line("## Why the ring's efficiency falls\n");
    report.line("![](scale-ring.svg)\n");
    report.line(explanation(rows));
    report
}

/// Explains why the ring's efficiency falls, with the figures.
fn explanation(rows: &[ScaleRow]) -> String {
    let ring = |weak, network, nodes| select(rows, weak, network, Strategy::Ring).find(|row| row.nodes == nodes);
    let most = node_counts().max().unwrap_or(1);
    let (Some(few), Some(many), Some(slow)) =
        (ring(true, NETWORKS_MS[0], 16), ring(true, NETWORKS_MS[0], most), ring(true, NETWORKS_MS[2], most))
    else {
        return String::new();
    };
    let parcel = |row: &ScaleRow| row.atoms_moved as f64 / row.transfers.max(1) as f64;
    format!(
        "An offer goes to the left neighbour first and ends at the first node that has an atom to give. Neighbours \
         have neighbouring bands, which cost about the same, so the first node that could give atoms has usually \
         little work left itself: it gives a few atoms, the offerer traces them and offers again. At 16 machines a \
         transfer moves {:.1} atoms, at {most} only {:.1} ({:.0} transfers per machine), while the atoms that should \
         move lie hundreds of hops away. Work spreads round the ring as heat does, from neighbour to neighbour, and a \
         node whose offer has gone round once retires for good. Every hop takes a message's time: at {most} machines \
         one lap is {:.2} s at {} ms and {:.1} s at {} ms, against an ideal time of {:.1} s. With the same picture \
         the bands shrink as well: an offer's lap grows with N while a node's work falls with 1/N. Efficiency at \
         {most} machines with the grown picture: {:.2} at {} ms, {:.2} at {} ms; the machines are idle at the end for \
         {:.0} and {:.0} % of all time.",
        parcel(few),
        parcel(many),
        many.transfers as f64 / many.nodes as f64,
        most as f64 * NETWORKS_MS[0].0 * 1e-3,
        NETWORKS_MS[0].0,
        most as f64 * NETWORKS_MS[2].0 * 1e-3,
        NETWORKS_MS[2].0,
        many.makespan_s * many.efficiency,
        many.efficiency,
        NETWORKS_MS[0].0,
        slow.efficiency,
        NETWORKS_MS[2].0,
        100.0 * many.tail_idle,
        100.0 * slow.tail_idle,
    )
}
