//! Speedup and efficiency over the number of machines: a curve a strategy, the article's points, and the runs that are
//! compared.

use egui::{RichText, ScrollArea, Sense, Ui, WidgetInfo, vec2};

use super::CompareColumn;
use super::columns::letter;
use crate::gui::session::{Growth, GrowthPoint};
use crate::gui::widgets::paint::{Inks, paint};
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, decimal, say, word};
use crate::palette::{DISTINCT_COLOURS, node_colours};
use crate::study::article_over_ideal;
use crate::view::{Axis, Hue, LineChart, MIN_CHART_HEIGHT, Series, Sharing, Style, TimeBudget, fraction, series_hue};

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// How many times as fast as one machine.
    Speedup,
    /// What part of the machines' time is of use.
    Efficiency,
}

/// Shows the curves, as soon as they are known.
pub fn show(
    ui: &mut Ui,
    growth: Option<&Growth>,
    entries: &[CompareColumn],
    measure: Measure,
    look: Look,
    language: Language,
) {
    let Some(growth) = growth else {
        let text = word!(language, "Running with one machine to eight …", "Executando com uma a oito máquinas …");
        ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(look.quiet));
        return;
    };
    let chart = chart(growth, entries, measure, language);
    let size = vec2(ui.available_width() - GRID, ui.available_height().max(MIN_CHART_HEIGHT));
    // In a low window one scrolls.
    ScrollArea::vertical().id_salt("growth").show(ui, |ui| {
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        response.widget_info(|| {
            let line = |series: &Series| {
                let points: Vec<_> =
                    series.points.iter().map(|(x, y)| format!("{x:.0}: {}", decimal(language, *y, 2))).collect();
                format!("{}: {}", series.name, points.join(", "))
            };
            let lines: Vec<_> = chart.series.iter().map(line).collect();
            let words = format!("{}\n{}\n{}", chart.y.label, chart.note, lines.join("\n"));
            WidgetInfo::labeled(egui::Role::Image, true, words)
        });
        let colours = node_colours(DISTINCT_COLOURS);
        paint(ui.painter(), rect.min, &chart.marks(rect.size().into(), language), &Inks { look, nodes: &colours });
    });
}

fn chart(growth: &Growth, entries: &[CompareColumn], measure: Measure, language: Language) -> LineChart {
    let mut series = Vec::new();
    let is_speedup = measure == Measure::Speedup;
    for (i, (strategy, runs)) in growth.of.iter().enumerate() {
        let value = |run: &GrowthPoint| if is_speedup { run.speedup } else { run.efficiency };
        let name = Sharing::By(*strategy).name(language);
        let points = runs.iter().map(|run| (run.machines as f64, value(run))).collect();
        series.push(Series { name: name.to_owned(), hue: series_hue(i), points, style: Style::Line });
        // The article has figures of equal machines, and of four with a slow fifth.
        let article = |run: &GrowthPoint| {
            let over = article_over_ideal(*strategy, run.machines, growth.slow.is_some())?;
            let power = run.speedup / run.efficiency;
            Some((run.machines as f64, if is_speedup { power / over } else { 1.0 / over }))
        };
        let points: Vec<_> = runs.iter().filter_map(article).collect();
        if !points.is_empty() {
            series.push(Series { name: String::new(), hue: series_hue(i), points, style: Style::Hollow });
        }
    }
    let article = series.iter().any(|series| series.style == Style::Hollow);
    let dots = beside(growth, entries, measure);
    let note = note(article, !dots.is_empty(), entries, language);
    series.extend(dots);
    let machines = match growth.slow {
        None => word!(language, "equal machines", "máquinas iguais").to_owned(),
        Some(speed) => {
            let speed = fraction(speed);
            say!(language, "machines, the last of which runs at {speed}", "máquinas, a última a {speed}")
        }
    };
    let y = if is_speedup {
        word!(language, "times as fast as one machine", "vezes mais rápido que uma máquina")
    } else {
        word!(language, "ideal time / time", "tempo ideal / tempo")
    };
    LineChart {
        title: String::new(),
        note,
        x: Axis { label: machines, ..Axis::default() },
        y: Axis { label: y.to_owned(), ..Axis::default() },
        series,
    }
}

/// Forks, and what else lies on no curve.
fn beside(growth: &Growth, entries: &[CompareColumn], measure: Measure) -> Vec<Series> {
    /// What differs by less than this is the same.
    const SAME: f64 = 0.005;
    let dot = |(place, entry): (usize, &CompareColumn)| {
        let account: &TimeBudget = entry.contender.as_ref()?.budget.as_ref()?;
        let header = &entry.trial.header;
        let (machines, speedup) = (header.speeds.len(), growth.alone.div_duration_f64(account.makespan));
        let curve = growth.of.iter().find(|(strategy, _)| *strategy == header.rules.strategy);
        let of_curve = curve.and_then(|(_, runs)| runs.iter().find(|run| run.machines == machines));
        let is_on_it = of_curve.is_some_and(|run| {
            (run.speedup / speedup - 1.0).abs() < SAME && (run.efficiency / account.efficiency() - 1.0).abs() < SAME
        });
        let value = if measure == Measure::Speedup { speedup } else { account.efficiency() };
        (entry.is_fork() || !is_on_it).then(|| Series {
            name: letter(place).to_string(),
            hue: Hue::Text,
            points: vec![(machines as f64, value)],
            style: Style::Dots,
        })
    };
    entries.iter().enumerate().filter_map(dot).collect()
}

/// What the points are that are on no curve, and what has none.
fn note(article: bool, dots: bool, entries: &[CompareColumn], language: Language) -> String {
    let mut told = Vec::new();
    if article {
        told.push(
            word!(language, "Hollow dots: the article's measurements.", "Pontos vazados: o que o artigo mediu.")
                .to_owned(),
        );
    }
    if dots {
        told.push(word!(language, "Letters: the runs above.", "Letras: as execuções acima.").to_owned());
    }
    let is_endless = |entry: &CompareColumn| entry.contender.as_ref().is_some_and(|run| run.budget.is_none());
    for (place, _) in entries.iter().enumerate().filter(|(_, entry)| is_endless(entry)) {
        let letter = letter(place);
        told.push(say!(language, "{letter} never ends, and is not here.", "{letter} nunca termina, e não está aqui."));
    }
    told.join(" ")
}
