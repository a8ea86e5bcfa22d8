//! The report of the study of stability.

use super::{StabilityCase, StabilityRow, protocol};
use crate::study::format::{or_dash, significant};
use crate::study::markdown::Report;
use crate::view::{Axis, LineChart, Scale, Series, Style, series_hue};

/// Writes the report.
pub(super) fn report(found: &[CaseRows<'_>]) -> Report {
    let mut report = Report::titled("Where methods fail");
    report.line(
        "Cases of growing difficulty for this program's method (*ours*) and for naive methods. In geometry, the truth \
         is computed without rounding from the very numbers that the methods get. All methods use f64 unless stated \
         otherwise. Random numbers have fixed seeds, so another run gives the same results.\n",
    );
    let of_protocol = |(case, _): &&(&StabilityCase, &[StabilityRow])| case.methods == protocol::METHODS;
    methods(&mut report, found.iter().filter(|found| !of_protocol(found)));
    strategies(&mut report, found.iter().filter(of_protocol));
    for &(case, rows) in found {
        report.line(format!("\n<a id=\"{}\"></a>\n\n## {}\n\n{}\n", case.name, case.title, case.about));
        table(&mut report, case, rows);
        report.line(format!("\n![](stability-{}.svg)", case.name));
    }
    report
}

type CaseRows<'a> = (&'a StabilityCase, &'a [StabilityRow]);

/// Adds the table of the geometric methods: where each holds, and where it first fails.
fn methods<'a>(report: &mut Report, found: impl Iterator<Item = &'a CaseRows<'a>>) {
    report.line("| case | parameter | required up to | ours holds | ours first fails | others first fail |");
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
            four_digits(case.required),
            held_range(rows, ours),
            first_wrong(rows, ours),
            first.join("; ")
        ));
    }
}

/// Adds the table of the strategies: their worst makespan / ideal, and where the ring traces every atom once.
fn strategies<'a>(report: &mut Report, found: impl Iterator<Item = &'a CaseRows<'a>>) {
    let names = protocol::METHODS.join(" | ");
    report.line(
        "\nThe protocol in virtual time under extreme machines, costs or networks: each strategy's worst makespan / \
         ideal, and the value at which it occurs.\n",
    );
    report.line(format!("| case | parameter | the ring traces every atom once | {names} |"));
    report.line(format!("|---|---|---:|{}", "---:|".repeat(protocol::METHODS.len())));
    for (case, rows) in found {
        let worst = protocol::METHODS.iter().map(|method| {
            let measured = of(rows, method).map(|row| (row.measured.unwrap_or(f64::INFINITY), row.value));
            let worst = measured.max_by(|(this, _), (other, _)| this.total_cmp(other));
            or_dash(worst.map(|(measured, value)| format!("{} at {}", four_digits(measured), four_digits(value))))
        });
        report.line(format!(
            "| [{}](#{}) | {} | {} | {} |",
            case.title,
            case.name,
            case.parameter,
            held_range(rows, case.ours()),
            worst.collect::<Vec<_>>().join(" | ")
        ));
    }
}

fn of<'a>(rows: &'a [StabilityRow], method: &str) -> impl Iterator<Item = &'a StabilityRow> {
    rows.iter().filter(move |row| row.method == method)
}

/// Returns the range of values over which a method is never wrong.
fn held_range(rows: &[StabilityRow], method: &str) -> String {
    let held_range: Vec<&StabilityRow> = of(rows, method).take_while(|row| row.wrong == 0).collect();
    match held_range[..] {
        [] => "nowhere".into(),
        [only] => four_digits(only.value),
        [first, .., last] => format!("{} … {}", four_digits(first.value), four_digits(last.value)),
    }
}

fn first_wrong(rows: &[StabilityRow], method: &str) -> String {
    of(rows, method).find(|row| row.wrong > 0).map_or("nowhere".into(), |row| four_digits(row.value))
}

fn table(report: &mut Report, case: &StabilityCase, rows: &[StabilityRow]) {
    report.line(format!("| {} | tried | {} |", case.parameter, case.methods.join(" | ")));
    report.line(format!("|---:|---:|{}", "---:|".repeat(case.methods.len())));
    for rows in rows.chunks(case.methods.len()) {
        let Some(first) = rows.first() else { continue };
        let cells: Vec<String> = rows.iter().map(|row| cell(case, row)).collect();
        let bold = if first.value == case.required { "**" } else { "" };
        report.line(format!("| {bold}{}{bold} | {} | {} |", four_digits(first.value), first.tried, cells.join(" | ")));
    }
}

fn cell(case: &StabilityCase, row: &StabilityRow) -> String {
    match (case.measured_figure, row.measured) {
        (Some(_), Some(measured)) if row.wrong == 0 => four_digits(measured),
        (Some(_), Some(measured)) => format!("{} ({} wrong)", four_digits(measured), row.wrong),
        (None, Some(broken)) if broken > 0.0 => format!("{} ({broken} odd)", row.wrong),
        _ => row.wrong.to_string(),
    }
}

/// Formats a number with four significant digits, or a whole number in full.
fn four_digits(value: f64) -> String {
    let short = significant(value, 4);
    match value.abs() {
        size if size < 1e7 && value.fract() == 0.0 => value.to_string(),
        size if (1e-3..1e4).contains(&size) => short.to_string(),
        _ => format!("{short:e}"),
    }
}

/// Colour of the required limit; no case has this many methods.
const REQUIRED_HUE: usize = 3;

/// Charts the share of wrong answers, or the measured figure, by the case's parameter.
pub(super) fn chart(case: &StabilityCase, rows: &[StabilityRow]) -> LineChart {
    let tried = rows.iter().map(|row| row.tried).max().unwrap_or(1).max(1);
    // 0 has no place on a logarithmic axis: it is drawn on the lowest line.
    let floor = if case.measured_figure.is_some() { 1e-17 } else { 10f64.powf((0.1 / tried as f64).log10().floor()) };
    let y = |row: &StabilityRow| match case.measured_figure {
        Some(_) => row.measured.map(|measured| measured.max(floor)),
        None => Some((row.wrong as f64 / row.tried.max(1) as f64).max(floor)),
    };
    let least = case.values.iter().copied().filter(|&value| value > 0.0).fold(f64::INFINITY, f64::min);
    let x = |value: f64| value.max(least / 10.0);
    // This program's method has the same colour everywhere.
    let line = |(i, method): (usize, &&str)| Series {
        name: (*method).into(),
        hue: series_hue(case.methods.len() - 1 - i),
        points: of(rows, method).filter_map(|row| Some((x(row.value), y(row)?))).collect(),
        style: Style::Line,
    };
    let mut series: Vec<Series> = case.methods.iter().enumerate().map(line).collect();
    if case.measured_figure.is_none() {
        series.push(Series {
            name: "required".into(),
            hue: series_hue(REQUIRED_HUE),
            points: [floor, 1.0].map(|share| (x(case.required), share)).to_vec(),
            style: Style::Dashed,
        });
    }
    let at_0 = if case.values.contains(&0.0) { "; leftmost: exactly 0" } else { "" };
    let note = match case.measured_figure {
        None => format!("On the lowest line: none of {tried} answers per point wrong"),
        Some(_) if rows.iter().any(|row| row.measured.is_some_and(|measured| measured < floor)) => {
            format!("Values below {floor:e} are drawn there")
        }
        Some(_) => String::new(),
    };
    LineChart {
        title: case.title.into(),
        note,
        x: Axis { label: format!("{}{at_0}", case.parameter), scale: case.scale, range: None },
        y: Axis {
            label: case.measured_figure.unwrap_or("share of wrong answers").into(),
            scale: Scale::Log10,
            range: case.measured_figure.is_none().then_some((floor, 1.0)),
        },
        series,
    }
}
