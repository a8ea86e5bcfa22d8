//! What the measurements say: a table of the cases, a chart for each remedy, and how much it gains.

use super::super::markdown::Report;
use super::cases::cases;
use super::measure::{LATENCIES, RemedyRow};
use crate::balance::Remedy;
use crate::view::{Axis, LineChart, Scale, Series, Style, series_hue};

/// A ring that never ends is shown here.
const ENDLESS: f64 = 10.0;

/// A chart for each remedy: what a run takes over the bound, with all remedies and without this one, by case.
pub(super) fn charts(rows: &[RemedyRow]) -> Vec<(String, LineChart)> {
    let mut charts = Vec::new();
    for latency in LATENCIES {
        let name = |what: &str| format!("{what}-{latency}ms");
        let title = format!("The article's ring and the ring that adapts, {latency} ms a message");
        charts.push((name("ring"), chart(rows, latency, title, &["ring", "adaptive"])));
        for remedy in Remedy::ALL {
            let without = format!("without {remedy}");
            let title = format!("What “{remedy}” gains, {latency} ms a message");
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
            // On a scale of ratios there is no zero.
            Some((number as f64 + 1.0, row.over_bound.unwrap_or(ENDLESS).min(ENDLESS) - 1.0 + 1e-4))
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
        note: "time over the bound, less one; at 9 a run never ends; the cases' numbers are the report's".into(),
        x: Axis { label: "case".into(), scale: Scale::Linear, range: Some((0.0, cases.len() as f64 + 1.0)) },
        y: Axis { label: "over the bound".into(), scale: Scale::Log10, range: None },
        series: series.collect(),
    }
}

fn find<'a>(rows: &'a [RemedyRow], case: &str, driver: &str, latency: f64, rival: &str) -> Option<&'a RemedyRow> {
    rows.iter().find(|row| row.case == case && row.driver == driver && row.latency_ms == latency && row.rival == rival)
}

pub(super) fn report(rows: &[RemedyRow]) -> Report {
    let mut report = Report::titled("The ring that adapts");
    report.line(
        "Time over the bound, the least T with ∫ Σ speed dt ≥ work, where a machine that is off, hangs or is cut off \
         counts for nothing. In virtual time the middle of five runs with atoms of 40 to 60 pixels, on threads of \
         three runs in turn; ∞ is a run that never ends. In brackets the worst of the runs.\n",
    );
    report.line(
        "| | case | aim | ring, 0 ms | adaptive, 0 ms | ring, 1 ms | adaptive, 1 ms | ring, 10 ms | adaptive, 10 ms | \
         ring, threads | adaptive, threads |",
    );
    report.line("|--:|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
    for (number, case) in cases().iter().enumerate() {
        let cell = |driver, latency, rival| {
            find(rows, &case.name, driver, latency, rival).map_or("–".into(), |row| {
                match (row.over_bound, row.worst) {
                    (Some(over), Some(worst)) => format!("{over:.3} ({worst:.3})"),
                    _ => "∞".into(),
                }
            })
        };
        let simulated =
            LATENCIES.map(|latency| format!("{} | {}", cell("sim", latency, "ring"), cell("sim", latency, "adaptive")));
        let threads = [cell("threads", 0.0, "ring"), cell("threads", 0.0, "adaptive")].join(" | ");
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
    report.line("\n## What each remedy gains\n");
    report.line(
        "Where a run takes longest without a remedy, over the time with all of them, and the geometric mean of all \
         cases that end.\n",
    );
    report.line("| remedy | most, 0 ms | mean | most, 1 ms | mean | most, 10 ms | mean |");
    report.line("|---|--:|--:|--:|--:|--:|--:|");
    for remedy in Remedy::ALL {
        let cells = LATENCIES.map(|latency| gain(rows, remedy, latency));
        report.line(format!("| {remedy} | {} |", cells.join(" | ")));
    }
    let throttled = |rival| find(rows, "unequal, throttled", "threads", 0.0, rival).and_then(|row| row.over_bound);
    if let (Some(adaptive), Some(rayon)) = (throttled("adaptive"), throttled("rayon")) {
        report.line(format!(
            "\n## Beside rayon\n\nPaced machines at 100, 70, 40 and 100 %, of which the second falls to 1 % at 30 % \
             of the run, on threads: the ring that adapts takes {adaptive:.3} × the bound, rayon's work stealing \
             {rayon:.3}: {:.3} × its time.",
            adaptive / rayon
        ));
    }
    report
}

/// What a remedy gains at most, and where; and on the average.
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
