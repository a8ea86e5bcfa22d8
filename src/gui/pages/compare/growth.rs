//! Charts of speedup and efficiency over the number of machines: a curve for each strategy, the article's points, and
//! the compared runs.

use egui::{RichText, ScrollArea, Sense, Ui, WidgetInfo, vec2};

use super::CompareColumn;
use super::columns::letter;
use crate::balance::Scheduler;
use crate::gui::session::{Growth, GrowthPoint};
use crate::gui::widgets::paint::{Inks, paint};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, decimal, say, word};
use crate::palette::{DISTINCT_COLOURS, node_colours};
use crate::study::article_over_ideal;
use crate::view::{Axis, Hue, LineChart, MIN_CHART_HEIGHT, Series, Style, TimeBudget, fraction};

/// Quantity of the chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Makespan of one machine at full speed / makespan.
    Speedup,
    /// Ideal makespan / makespan.
    Efficiency,
}

/// Shows the chart as soon as its runs have ended.
pub fn show(
    ui: &mut Ui,
    growth: Option<&Growth>,
    columns: &[CompareColumn],
    measure: Measure,
    look: Look,
    language: Language,
) {
    let Some(growth) = growth else {
        let text = word!(language, "Running with one to eight machines …", "Executando com uma a oito máquinas …");
        ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet));
        return;
    };
    let chart = chart(growth, columns, measure, language);
    let size = vec2(ui.available_width() - GRID, ui.available_height().max(MIN_CHART_HEIGHT));
    // A low window scrolls.
    ScrollArea::vertical().id_salt("growth").show(ui, |ui| {
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        response.widget_info(|| {
            let line = |series: &Series| {
                let points: Vec<_> =
                    series.points.iter().map(|(x, y)| format!("{x:.0}: {}", decimal(language, *y, 2))).collect();
                format!("{}: {}", series.name, points.join(", "))
            };
            let lines: Vec<_> = chart.series.iter().map(line).collect();
            let text = format!("{}\n{}\n{}", chart.y.label, chart.note, lines.join("\n"));
            WidgetInfo::labeled(egui::Role::Image, true, text)
        });
        let colours = node_colours(DISTINCT_COLOURS);
        paint(ui.painter(), rect.min, &chart.marks(rect.size().into(), language), &Inks { look, nodes: &colours });
    });
}

/// Colour and style of the curves of equal bands, the farm, the farm with leases, the ring and the adaptive ring. The
/// colours of machines belong to the machines, whose pictures are above. Dashes let an equal curve below be seen.
const CURVES: [(Hue, Style); 5] = [
    (Hue::Quiet, Style::Line),
    (Hue::Text, Style::Line),
    (Hue::Quiet, Style::Dashed),
    (Hue::Accent, Style::Line),
    (Hue::Text, Style::Dashed),
];

/// Builds the chart.
fn chart(growth: &Growth, columns: &[CompareColumn], measure: Measure, language: Language) -> LineChart {
    let mut series = Vec::new();
    let is_speedup = measure == Measure::Speedup;
    for (i, (strategy, runs)) in growth.curves.iter().enumerate() {
        let value = |run: &GrowthPoint| if is_speedup { run.speedup } else { run.efficiency };
        let name = Scheduler::Protocol(strategy.clone()).title(language);
        let points = runs.iter().map(|run| (run.machines as f64, value(run))).collect();
        let (hue, style) = CURVES[i % CURVES.len()];
        series.push(Series { name: name.to_owned(), hue, points, style });
        // The article has figures for equal machines, and for four machines with a slow fifth one.
        let article = |run: &GrowthPoint| {
            let over = article_over_ideal(strategy, run.machines, growth.slow.is_some())?;
            let power = run.speedup / run.efficiency;
            Some((run.machines as f64, if is_speedup { power / over } else { 1.0 / over }))
        };
        let points: Vec<_> = runs.iter().filter_map(article).collect();
        if !points.is_empty() {
            series.push(Series { name: String::new(), hue, points, style: Style::Hollow });
        }
    }
    let has_article = series.iter().any(|series| series.style == Style::Hollow);
    let dots = dots_beside_curves(growth, columns, measure);
    let note = note(has_article, !dots.is_empty(), columns, language);
    series.extend(dots);
    let machines = match growth.slow {
        None => word!(language, "equal machines", "máquinas iguais").to_owned(),
        Some(speed) => {
            let speed = fraction(speed);
            say!(language, "machines; the last one at {speed}", "máquinas; a última a {speed}")
        }
    };
    let y = if is_speedup {
        word!(language, "speedup: time of one machine / time", "speedup: tempo de uma máquina / tempo")
    } else {
        word!(language, "efficiency: ideal time / time", "eficiência: tempo ideal / tempo")
    };
    LineChart {
        title: String::new(),
        note,
        x: Axis { label: machines, ..Axis::default() },
        y: Axis { label: y.to_owned(), ..Axis::default() },
        series,
    }
}

/// Returns the compared runs that are on no curve: changed runs, and others that differ from the curve of their
/// strategy.
fn dots_beside_curves(growth: &Growth, columns: &[CompareColumn], measure: Measure) -> Vec<Series> {
    /// Greatest relative difference from the curve of a run that is on it.
    const TOLERANCE: f64 = 0.005;
    let dot = |(index, column): (usize, &CompareColumn)| {
        let budget: &TimeBudget = column.run.as_ref()?.budget.as_ref()?;
        let header = &column.trial.header;
        let (machines, speedup) = (header.speeds.len(), growth.alone.div_duration_f64(budget.makespan));
        let curve = growth.curves.iter().find(|(strategy, _)| *strategy == header.rules.strategy);
        let on_curve = curve.and_then(|(_, runs)| runs.iter().find(|run| run.machines == machines));
        let is_on_curve = on_curve.is_some_and(|run| {
            (run.speedup / speedup - 1.0).abs() < TOLERANCE
                && (run.efficiency / budget.efficiency() - 1.0).abs() < TOLERANCE
        });
        let value = if measure == Measure::Speedup { speedup } else { budget.efficiency() };
        (column.is_fork() || !is_on_curve).then(|| Series {
            name: letter(index).to_string(),
            hue: Hue::Text,
            points: vec![(machines as f64, value)],
            style: Style::Dots,
        })
    };
    columns.iter().enumerate().filter_map(dot).collect()
}

/// Explains the points that are on no curve, and names the runs that have none.
fn note(has_article: bool, has_dots: bool, columns: &[CompareColumn], language: Language) -> String {
    let mut sentences = Vec::new();
    if has_article {
        sentences.push(
            word!(language, "Hollow dots: the article's measurements.", "Pontos vazados: as medidas do artigo.")
                .to_owned(),
        );
    }
    if has_dots {
        sentences.push(word!(language, "Letters: the runs above.", "Letras: as execuções acima.").to_owned());
    }
    let is_endless = |column: &CompareColumn| column.run.as_ref().is_some_and(|run| run.budget.is_none());
    for (index, _) in columns.iter().enumerate().filter(|(_, column)| is_endless(column)) {
        let letter = letter(index);
        sentences.push(say!(
            language,
            "{letter} never ends, so it has no point.",
            "{letter} nunca termina, e não tem ponto."
        ));
    }
    sentences.join(" ")
}
