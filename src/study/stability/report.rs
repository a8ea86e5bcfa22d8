//! What the study of stability says.

use super::{StabilityCase, StabilityRow, protocol};
use crate::study::markdown::Report;
use crate::view::{Axis, LineChart, Scale, Series, Style, series_hue};

/// The report, in Markdown.
pub(super) fn report(found: &[Found<'_>]) -> Report {
    let mut report = Report::titled("Where methods fail");
    report.line(
        "Cases that grow harder step by step, and what a naive method and ours make of them. In geometry, what is \
         true is worked out without rounding from the very numbers that the methods were given. All is in f64 unless \
         it says otherwise, and random with fixed seeds: who runs it again gets the same.\n",
    );
    let of_protocol = |(case, _): &&(&StabilityCase, &[StabilityRow])| case.methods == protocol::METHODS;
    methods(&mut report, found.iter().filter(|found| !of_protocol(found)));
    strategies(&mut report, found.iter().filter(of_protocol));
    for &(case, rows) in found {
        report.line(format!("\n<a id=\"{}\"></a>\n\n## {}\n\n{}\n", case.name, case.title, case.about));
        table(&mut report, case, rows);
        report.line(format!("\n![](stability-{}.svg)", case.name));
    }
    report.line("\nAll numbers are in `stability.csv`.");
    report
}

type Found<'a> = (&'a StabilityCase, &'a [StabilityRow]);

/// Where geometric methods hold, and where they first fail.
fn methods<'a>(report: &mut Report, found: impl Iterator<Item = &'a Found<'a>>) {
    report.line("| case | what grows harder | required up to | ours holds | ours first fails | others first fail |");
    report.line("|---|---|---:|---:|---:|---|");
    for (case, rows) in found {
        let (ours, others) = (case.ours(), &case.methods[..case.methods.len() - 1]);
        let first: Vec<String> =
            others.iter().map(|method| format!("{method}: {}", first_wrong(rows, method))).collect();
        report.line(format!(
            "| [{}](#{}) | {} | {} | {} | {} | {} |",
            case.title,
            case.name,
            case.parameter,
            number(case.required),
            held(rows, ours),
            first_wrong(rows, ours),
            first.join("; ")
        ));
    }
}

/// What strategies lose, and where a ring does not trace every atom once.
fn strategies<'a>(report: &mut Report, found: impl Iterator<Item = &'a Found<'a>>) {
    let names = protocol::METHODS.join(" | ");
    report.line(
        "\nThe protocol in virtual time, where machines, costs or the network are wild: each strategy's worst time \
         over the ideal one, and where it had that.\n",
    );
    report.line(format!("| case | what is varied | the ring traces every atom once | {names} |"));
    report.line(format!("|---|---|---:|{}", "---:|".repeat(protocol::METHODS.len())));
    for (case, rows) in found {
        let worst = protocol::METHODS.iter().map(|method| {
            let measured = of(rows, method).map(|row| (row.measured.unwrap_or(f64::INFINITY), row.value));
            let worst = measured.max_by(|(this, _), (other, _)| this.total_cmp(other));
            worst.map_or("–".into(), |(measured, value)| format!("{} at {}", number(measured), number(value)))
        });
        report.line(format!(
            "| [{}](#{}) | {} | {} | {} |",
            case.title,
            case.name,
            case.parameter,
            held(rows, case.ours()),
            worst.collect::<Vec<_>>().join(" | ")
        ));
    }
}

fn of<'a>(rows: &'a [StabilityRow], method: &str) -> impl Iterator<Item = &'a StabilityRow> {
    rows.iter().filter(move |row| row.method == method)
}

/// From where to where a method is never wrong.
fn held(rows: &[StabilityRow], method: &str) -> String {
    let held: Vec<&StabilityRow> = of(rows, method).take_while(|row| row.wrong == 0).collect();
    match held[..] {
        [] => "nowhere".into(),
        [only] => number(only.value),
        [first, .., last] => format!("{} … {}", number(first.value), number(last.value)),
    }
}

fn first_wrong(rows: &[StabilityRow], method: &str) -> String {
    of(rows, method).find(|row| row.wrong > 0).map_or("nowhere".into(), |row| number(row.value))
}

fn table(report: &mut Report, case: &StabilityCase, rows: &[StabilityRow]) {
    report.line(format!("| {} | tried | {} |", case.parameter, case.methods.join(" | ")));
    report.line(format!("|---:|---:|{}", "---:|".repeat(case.methods.len())));
    for rows in rows.chunks(case.methods.len()) {
        let Some(first) = rows.first() else { continue };
        let cells: Vec<String> = rows.iter().map(|row| cell(case, row)).collect();
        let bold = if first.value == case.required { "**" } else { "" };
        report.line(format!("| {bold}{}{bold} | {} | {} |", number(first.value), first.tried, cells.join(" | ")));
    }
}

fn cell(case: &StabilityCase, row: &StabilityRow) -> String {
    match (case.measures, row.measured) {
        (Some(_), Some(measured)) if row.wrong == 0 => number(measured),
        (Some(_), Some(measured)) => format!("{} ({} wrong)", number(measured), row.wrong),
        (None, Some(broken)) if broken > 0.0 => format!("{} ({broken} odd)", row.wrong),
        _ => row.wrong.to_string(),
    }
}

/// A number with four figures, or a whole one with all that it has.
fn number(value: f64) -> String {
    let short: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    match value.abs() {
        size if size < 1e7 && value.fract() == 0.0 => value.to_string(),
        size if (1e-3..1e4).contains(&size) => short.to_string(),
        _ => format!("{short:e}"),
    }
}

/// The colour of what is required; no case has so many methods.
const REQUIRED: usize = 3;

/// The share of wrong answers, or what was measured, against what grows harder.
pub(super) fn chart(case: &StabilityCase, rows: &[StabilityRow]) -> LineChart {
    let tried = rows.iter().map(|row| row.tried).max().unwrap_or(1).max(1);
    // What is 0 has no place on a logarithmic axis: it lies on the lowest line.
    let floor = if case.measures.is_some() { 1e-17 } else { 10f64.powf((0.1 / tried as f64).log10().floor()) };
    let y = |row: &StabilityRow| match case.measures {
        Some(_) => row.measured.map(|measured| measured.max(floor)),
        None => Some((row.wrong as f64 / row.tried.max(1) as f64).max(floor)),
    };
    let least = case.values.iter().copied().filter(|&value| value > 0.0).fold(f64::INFINITY, f64::min);
    let x = |value: f64| value.max(least / 10.0);
    // Ours has the same colour everywhere.
    let line = |(i, method): (usize, &&str)| Series {
        name: (*method).into(),
        hue: series_hue(case.methods.len() - 1 - i),
        points: of(rows, method).filter_map(|row| Some((x(row.value), y(row)?))).collect(),
        style: Style::Line,
    };
    let mut series: Vec<Series> = case.methods.iter().enumerate().map(line).collect();
    if case.measures.is_none() {
        series.push(Series {
            name: "required".into(),
            hue: series_hue(REQUIRED),
            points: [floor, 1.0].map(|share| (x(case.required), share)).to_vec(),
            style: Style::Dashed,
        });
    }
    let at_0 = if case.values.contains(&0.0) { "; leftmost: exactly 0" } else { "" };
    let note = match case.measures {
        None => format!("On the lowest line: none wrong of {tried} a point"),
        Some(_) if rows.iter().any(|row| row.measured.is_some_and(|measured| measured < floor)) => {
            format!("What is below {floor:e} is drawn there")
        }
        Some(_) => String::new(),
    };
    LineChart {
        title: case.title.into(),
        note,
        x: Axis { label: format!("{}{at_0}", case.parameter), scale: case.scale, range: None },
        y: Axis {
            label: case.measures.unwrap_or("share of wrong answers").into(),
            scale: Scale::Log10,
            range: case.measures.is_none().then_some((floor, 1.0)),
        },
        series,
    }
}
