//! Charts of the study: the article's own, run again, and others.

use super::article::{self, PACKETS, SERIAL_TIME};
use super::rows::PaperRow;
use crate::balance::Strategy;
use crate::language::Language;
use crate::study::fixture::STRATEGIES;
use crate::view::{Axis, Bar, BarChart, CHART_SIZE, LineChart, Mark, Scale, Series, Style, series_hue};

/// Selects the rows of a figure, a network and a driver.
pub(super) fn select<'a>(
    rows: &'a [PaperRow],
    figure: &'a str,
    network: &'a str,
    driver: &'a str,
) -> impl Iterator<Item = &'a PaperRow> + Clone {
    rows.iter().filter(move |row| row.figure == figure && row.network == network && row.driver == driver)
}

/// Returns all charts with their names.
pub(super) fn all(rows: &[PaperRow], handling: &[(f64, [f64; 4])]) -> Vec<(&'static str, Vec<Mark>)> {
    let mut charts = Vec::new();
    let figures = [
        ("figure5-threads", "threads", "none", "On threads, without a network"),
        ("figure5-sim", "sim", "none", "In virtual time, without a network"),
        ("figure5-threads-network", "threads", "modelled", "On threads, on the modelled network"),
        ("figure5-sim-network", "sim", "modelled", "In virtual time, on the modelled network"),
    ];
    for (name, driver, network, title) in figures {
        charts.push((name, makespans(rows, driver, network, title).marks(CHART_SIZE, Language::English)));
    }
    charts.push(("atoms", sizes(rows, "atom").marks(CHART_SIZE, Language::English)));
    charts.push(("parts", sizes(rows, "part").marks(CHART_SIZE, Language::English)));
    charts.push(("figure9", packets(rows).marks(CHART_SIZE, Language::English)));
    charts.push(("handling", handling_chart(handling).marks(CHART_SIZE, Language::English)));
    charts
}

/// Charts Figures 5 to 7: makespan / ideal, with the article's values.
fn makespans(rows: &[PaperRow], driver: &str, network: &str, title: &str) -> BarChart {
    let group = |nodes: usize, slow: bool| {
        let figure = if slow { "7" } else { "6" };
        let ours = select(rows, figure, network, driver).filter(move |row| row.nodes == nodes);
        let mut bars = Vec::new();
        for strategy in STRATEGIES {
            let Some(row) = ours.clone().find(|row| row.strategy == strategy.name()) else { continue };
            let other = article::over_ideal(&strategy, nodes, slow);
            bars.push(Bar { name: strategy.name().to_owned(), value: row.over_ideal, other });
        }
        (if slow { "4 and a slow one".into() } else { format!("{nodes} machines") }, bars)
    };
    BarChart {
        title: title.into(),
        note: "Makespan / ideal: 1 is perfect. Dark marks: the article's values".into(),
        y: Axis { label: "makespan / ideal".into(), scale: Scale::Log2, range: Some((1.0, 10.0)) },
        groups: vec![group(2, false), group(3, false), group(4, false), group(5, true)],
        reference: Some(1.0),
    }
}

/// Charts makespan / ideal by size of atoms or parts, in pixels.
fn sizes(rows: &[PaperRow], figure: &str) -> LineChart {
    let mut series = Vec::new();
    for strategy in [Strategy::Ring, Strategy::Farm] {
        for slow in [false, true] {
            for network in ["none", "modelled"] {
                let of = select(rows, figure, network, "sim")
                    .filter(|row| row.slow == slow && row.strategy == strategy.name());
                let size = |row: &PaperRow| if figure == "atom" { row.atom } else { row.atom * row.part };
                let points: Vec<_> = of.map(|row| (f64::from(size(row)), row.over_ideal)).collect();
                if points.is_empty() {
                    continue;
                }
                let machines = if slow { "4 + slow" } else { "4" };
                series.push(Series {
                    name: format!("{strategy}, {machines}{}", if network == "none" { "" } else { ", network" }),
                    hue: series_hue(series.len()),
                    points,
                    style: if network == "none" { Style::Line } else { Style::Dashed },
                });
            }
        }
    }
    let (title, label) = match figure {
        "atom" => ("Which size of atoms is best?", "pixels in an atom"),
        _ => ("Which size of parts or smallest transfers is best?", "pixels in a part or a smallest transfer"),
    };
    LineChart {
        title: title.into(),
        note: "Dashed: on the modelled network".into(),
        x: Axis { label: label.into(), scale: Scale::Log10, range: None },
        y: Axis { label: "makespan / ideal".into(), scale: Scale::Log10, range: None },
        series,
    }
}

/// Charts Figure 9: makespan / ideal by mean size of a packet.
fn packets(rows: &[PaperRow]) -> LineChart {
    let ratio = |seconds: f64| seconds * 4.0 / SERIAL_TIME.as_secs_f64();
    let article = PACKETS.map(|(tens, _, atoms)| (atoms, ratio(10.0 * tens))).to_vec();
    let ours = |strategy: Strategy, network| {
        let is_one = move |row: &&PaperRow| row.strategy == strategy.name() && !row.slow && row.transfers > 0;
        let of = select(rows, "part", network, "sim").filter(is_one);
        of.map(|row| (row.atoms_moved as f64 / row.transfers as f64, row.over_ideal)).collect()
    };
    let line = |i, name: &str, points, style| Series { name: name.into(), hue: series_hue(i), points, style };
    LineChart {
        title: "Figure 9: does the makespan rise as packets shrink?".into(),
        note: "A ring of four; ours by the smallest transfer allowed".into(),
        x: Axis { label: "mean atoms in a packet".into(), scale: Scale::Log10, range: None },
        y: Axis { label: "makespan / ideal".into(), scale: Scale::Linear, range: Some((0.95, 1.3)) },
        series: vec![
            line(0, "no network", ours(Strategy::Ring, "none"), Style::Dots),
            line(1, "modelled network", ours(Strategy::Ring, "modelled"), Style::Dots),
            line(0, "adaptive, no network", ours(Strategy::Adaptive, "none"), Style::Hollow),
            line(1, "adaptive, modelled network", ours(Strategy::Adaptive, "modelled"), Style::Hollow),
            line(3, "the article", article, Style::Dots),
        ],
    }
}

/// Charts how handling time chokes a farm's parent.
fn handling_chart(handling: &[(f64, [f64; 4])]) -> LineChart {
    let names = ["farm, parts of 1 atom", "farm, 16 parts a machine", "ring", "static"];
    let line = |(i, name): (usize, &str)| Series {
        name: name.into(),
        hue: series_hue(i),
        points: handling.iter().map(|(ms, makespans)| (*ms, makespans[i])).collect(),
        style: Style::Line,
    };
    LineChart {
        title: "When is a farm worse than static bands?".into(),
        note: "Four equal machines on one wire; the parent is busy for this time with each message".into(),
        x: Axis { label: "ms a message".into(), scale: Scale::Log10, range: None },
        y: Axis { label: "makespan / ideal".into(), scale: Scale::Log10, range: None },
        series: names.into_iter().enumerate().map(line).collect(),
    }
}
