//! The report of the study of remedies: a table of the cases, a chart for each remedy, and the gain of each.

use super::super::markdown::Report;
use super::cases::cases;
use super::measure::{LATENCIES_MS, RemedyRow};
use crate::balance::Remedy;
use crate::view::{Axis, LineChart, Scale, Series, Style, series_hue};

/// Where a run that never ends is drawn, as makespan / bound.
const ENDLESS_RATIO: f64 = 10.0;

/// Returns charts of makespan / bound by case: the adaptive ring and its rivals, then all remedies and all but one.
pub(super) fn charts(rows: &[RemedyRow]) -> Vec<(String, LineChart)> {
    let mut charts = Vec::new();
    for latency in LATENCIES_MS {
        let name = |what: &str| format!("{what}-{latency}ms");
        let title = format!("The article's ring, the farm with leases and the adaptive ring, {latency} ms a message");
        charts.push((name("ring"), chart(rows, latency, title, &["ring", "farm-leases", "adaptive"])));
        for remedy in Remedy::ALL {
            let without = format!("without {remedy}");
            let title = format!("Gain of “{remedy}”, {latency} ms a message");
            charts.push((name(remedy.name()), chart(rows, latency, title, &[&without, "adaptive"])));
        }
    }
    charts
}

fn chart(rows: &[RemedyRow], latency: f64, title: String, rivals: &[&str]) -> LineChart {
    let cases = cases();
    let of = |rival: &str| {
        let point = |(number, case): (usize, &super::cases::RemedyCase)| {
            let row = find(rows, &case.name, "sim", latency, rival)?;
            // A logarithmic axis has no zero.
            Some((number as f64 + 1.0, row.over_bound.unwrap_or(ENDLESS_RATIO).min(ENDLESS_RATIO) - 1.0 + 1e-4))
        };
        cases.iter().enumerate().filter_map(point).collect::<Vec<_>>()
    };
    let series = rivals.iter().enumerate().map(|(place, rival)| Series {
        name: (*rival).into(),
        hue: series_hue(place),
        points: of(rival),
        style: if place == 0 { Style::Hollow } else { Style::Dots },
    });
    LineChart {
        title,
        note: "makespan / bound − 1; at 9 a run never ends; the report lists the numbered cases".into(),
        x: Axis { label: "case".into(), scale: Scale::Linear, range: Some((0.0, cases.len() as f64 + 1.0)) },
        y: Axis { label: "makespan / bound − 1".into(), scale: Scale::Log10, range: None },
        series: series.collect(),
    }
}

fn find<'a>(rows: &'a [RemedyRow], case: &str, driver: &str, latency: f64, rival: &str) -> Option<&'a RemedyRow> {
    rows.iter().find(|row| row.case == case && row.driver == driver && row.latency_ms == latency && row.rival == rival)
}

pub(super) fn report(rows: &[RemedyRow]) -> Report {
    let mut report = Report::titled("The adaptive ring");
    report.line(
        "Makespan / bound, where the bound is the least T with ∫ Σ speed dt ≥ work; a machine that is off, hangs or \
         is cut off contributes nothing. In virtual time: the median of five runs with atoms of 40 to 60 pixels. On \
         threads: the median of three runs, taken in turn. ∞ is a run that never ends. In brackets: the worst run.\n",
    );
    let rivals = ["ring", "farm-leases", "adaptive"];
    let columns = |of: String| rivals.map(|rival| format!("{rival}, {of}")).join(" | ");
    let simulated = LATENCIES_MS.map(|latency| columns(format!("{latency} ms"))).join(" | ");
    report.line(format!("| | case | aim | {simulated} | {} |", columns("threads".into())));
    report.line(format!("|--:|---|--:|{}", "--:|".repeat(rivals.len() * (LATENCIES_MS.len() + 1))));
    for (number, case) in cases().iter().enumerate() {
        let cell = |driver, latency, rival| {
            find(rows, &case.name, driver, latency, rival).map_or("–".into(), |row| {
                match (row.over_bound, row.worst) {
                    (Some(over), Some(worst)) => format!("{over:.3} ({worst:.3})"),
                    _ => "∞".into(),
                }
            })
        };
        let cells = |driver, latency| rivals.map(|rival| cell(driver, latency, rival)).join(" | ");
        let simulated = LATENCIES_MS.map(|latency| cells("sim", latency));
        let threads = cells("threads", 0.0);
        report.line(format!(
            "| {} | {} | {:.2} | {} | {threads} |",
            number + 1,
            case.name,
            case.aim,
            simulated.join(" | ")
        ));
    }
    report.line("\n## The cases\n");
    for (number, case) in cases().iter().enumerate() {
        report.line(format!("{}. *{}*: {}", number + 1, case.name, case.about));
    }
    report.line("\n## Gain of each remedy\n");
    report.line(
        "The greatest ratio of the makespan without a remedy to the makespan with all of them, with its case; and the \
         geometric mean over all cases that end.\n",
    );
    report.line("| remedy | greatest, 0 ms | mean | greatest, 1 ms | mean | greatest, 10 ms | mean |");
    report.line("|---|--:|--:|--:|--:|--:|--:|");
    for remedy in Remedy::ALL {
        let cells = LATENCIES_MS.map(|latency| gain(rows, remedy, latency));
        report.line(format!("| {remedy} | {} |", cells.join(" | ")));
    }
    let throttled = |rival| find(rows, "unequal, throttled", "threads", 0.0, rival).and_then(|row| row.over_bound);
    if let (Some(adaptive), Some(rayon)) = (throttled("adaptive"), throttled("rayon")) {
        report.line(format!(
            "\n## Compared with rayon\n\nPaced machines at 100, 70, 40 and 100 % on threads; the second falls to 1 % \
             at 30 % of the run. Makespan / bound: the adaptive ring {adaptive:.3}, rayon's work stealing {rayon:.3}. \
             The adaptive ring takes {:.3} × rayon's time.",
            adaptive / rayon
        ));
    }
    report
}

/// Returns a remedy's greatest gain and its case, and the mean gain.
fn gain(rows: &[RemedyRow], remedy: Remedy, latency: f64) -> String {
    let (mut most, mut place, mut sum, mut count) = (0.0, String::new(), 0.0, 0u32);
    for case in cases() {
        let of = |rival: &str| find(rows, &case.name, "sim", latency, rival).map(|row| row.over_bound);
        let (Some(Some(with)), Some(without)) = (of("adaptive"), of(&format!("without {remedy}"))) else { continue };
        let ratio = without.map_or(f64::INFINITY, |without| without / with);
        if ratio > most {
            (most, place) = (ratio, case.name);
        }
        if ratio.is_finite() {
            (sum, count) = (sum + ratio.ln(), count + 1);
        }
    }
    let most = if most.is_finite() { format!("{most:.3}") } else { "∞".into() };
    format!("{most} ({place}) | {:.4}", (sum / f64::from(count.max(1))).exp())
}
