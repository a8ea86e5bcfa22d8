//! Time budgets of several runs as bars on one scale of time.

use crate::language::Language;
use crate::view::analysis::time_budget::TimeBudget;
use crate::view::draw::display_list::{Anchor, Hue, Ink, Mark, Point, TextSize};
use crate::view::text::format::{duration, fraction};
use crate::view::text::glossary::Definition;

/// Height of one run's bar with its label.
const ROW_HEIGHT: f32 = 42.0;
/// Height of the bar alone.
const BAR_HEIGHT: f32 = 16.0;
/// Height of the legend.
const LEGEND_HEIGHT: f32 = 24.0;

/// Height of the chart of a number of runs.
pub fn time_budget_height(runs: usize) -> f32 {
    LEGEND_HEIGHT + ROW_HEIGHT * runs as f32
}

/// Returns the names of a budget's parts, in the order of [`crate::view::MachineSeconds::parts`].
pub fn part_names(language: Language) -> [&'static str; 5] {
    Definition::TIME_BUDGET.map(|part| part.name(language))
}

/// Inks of the parts: none is a node's colour.
fn inks() -> [Ink; 5] {
    [Hue::Accent.full(), Hue::Quiet.faint(0.45), Hue::Text.faint(0.85), Hue::Quiet.faint(0.8), Hue::Hairline.full()]
}

/// Draws a bar for each run, as long as its makespan, and divided into the parts of its machine seconds.
pub fn time_budget_marks(runs: &[(&str, &TimeBudget)], width: f32, language: Language) -> Vec<Mark> {
    let mut marks = Vec::new();
    legend(runs, width, &mut marks, language);
    let longest = runs.iter().map(|(_, budget)| budget.makespan.as_secs_f64()).fold(f64::MIN_POSITIVE, f64::max);
    for (i, (name, budget)) in runs.iter().enumerate() {
        let top = LEGEND_HEIGHT + ROW_HEIGHT * i as f32;
        let label = |at: Point, anchor, text, hue: Hue, marks: &mut Vec<Mark>| {
            marks.push(Mark::Label { at, anchor, text, size: TextSize::Small(1.0), ink: hue.full() });
        };
        label([0.0, top + 9.0], Anchor::Left, (*name).to_owned(), Hue::Text, &mut marks);
        let makespan = duration(budget.makespan, language);
        label([width, top + 9.0], Anchor::Right, makespan, Hue::Text, &mut marks);
        let length = (budget.makespan.as_secs_f64() / longest) as f32 * width;
        let mut left = 0.0;
        for (part, ink) in budget.spent.parts().into_iter().zip(inks()) {
            let share = part / budget.spent.sum().max(f64::MIN_POSITIVE);
            let wide = share as f32 * length;
            if wide <= 0.0 {
                continue;
            }
            let centre = [left + wide / 2.0, top + 20.0 + BAR_HEIGHT / 2.0];
            marks.push(Mark::Box { centre, half: [wide / 2.0, BAR_HEIGHT / 2.0], round: 0.0, ink });
            let text = fraction(share);
            if wide > TextSize::Small(1.0).width(text.chars().count()) + 8.0 {
                let hue = if matches!(ink.hue, Hue::Hairline) { Hue::Text } else { Hue::Ground };
                label(centre, Anchor::Centre, text, hue, &mut marks);
            }
            left += wide;
        }
    }
    marks
}

/// Describes the chart in words, a line for each run.
pub fn time_budget_words(runs: &[(&str, &TimeBudget)], language: Language) -> String {
    let line = |(name, budget): &(&str, &TimeBudget)| {
        let parts = budget.spent.parts().into_iter().zip(part_names(language)).filter(|(part, _)| *part > 0.0);
        let parts: Vec<_> =
            parts.map(|(part, name)| format!("{name} {}", fraction(part / budget.spent.sum()))).collect();
        format!("{name}: {}; {}", duration(budget.makespan, language), parts.join(", "))
    };
    runs.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// Returns the definitions of the parts in the legend, each with its area: left, top, right, bottom.
pub fn time_budget_legend(runs: &[(&str, &TimeBudget)], width: f32, language: Language) -> Vec<(Definition, [f32; 4])> {
    let (entries, _) = legend_entries(runs, width, language);
    entries.into_iter().map(|(part, _, [left, right])| (part, [left, 0.0, right, LEGEND_HEIGHT])).collect()
}

/// Draws the legend, without parts that no run has.
fn legend(runs: &[(&str, &TimeBudget)], width: f32, marks: &mut Vec<Mark>, language: Language) {
    let (entries, scale) = legend_entries(runs, width, language);
    for (part, ink, [left, _]) in entries {
        marks.push(Mark::Box { centre: [left + 6.0, 9.0], half: [6.0; 2], round: 2.0, ink });
        marks.push(Mark::Label {
            at: [left + 18.0, 9.0],
            anchor: Anchor::Left,
            text: part.name(language).to_owned(),
            size: TextSize::Small(scale),
            ink: Hue::Quiet.full(),
        });
    }
}

/// Part of a legend, with its ink, and its left and right end.
type LegendEntry = (Definition, Ink, [f32; 2]);

/// Arranges the legend. Where it is too long for one line, its names have a smaller scale.
fn legend_entries(runs: &[(&str, &TimeBudget)], width: f32, language: Language) -> (Vec<LegendEntry>, f32) {
    let is_drawn = |part: usize| runs.iter().any(|(_, budget)| budget.spent.parts()[part] > 0.0);
    let parts = Definition::TIME_BUDGET.into_iter().zip(inks()).enumerate().filter(|(part, _)| is_drawn(*part));
    let parts: Vec<_> = parts.map(|(_, part)| part).collect();
    let needed =
        |part: &Definition, scale: f32| 18.0 + TextSize::Small(scale).width(part.name(language).chars().count()) + 10.0;
    let whole: f32 = parts.iter().map(|(part, _)| needed(part, 1.0)).sum();
    let scale = (width / whole.max(1.0)).min(1.0);
    let mut right = 0.0;
    let place = |(part, ink): (Definition, Ink)| {
        let left = right;
        right += needed(&part, scale);
        (part, ink, [left, right])
    };
    (parts.into_iter().map(place).collect(), scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::tests::sample_runs;

    #[test]
    fn bars_are_as_long_as_makespans_and_filled_by_their_parts() {
        let language = Language::English;
        let budgets = [&[1.0, 1.0][..], &[1.0, 0.1]]
            .map(|speeds| TimeBudget::of(&sample_runs::log(speeds, 400)).expect("its end"));
        let runs = [("one", &budgets[0]), ("other", &budgets[1])];
        let marks = time_budget_marks(&runs, 600.0, language);
        let row = |row: usize| -> f32 {
            let [top, bottom] = [row, row + 1].map(|row| LEGEND_HEIGHT + ROW_HEIGHT * row as f32);
            let wide = |mark: &Mark| match mark {
                Mark::Box { centre, half, .. } if (top..bottom).contains(&centre[1]) => 2.0 * half[0],
                _ => 0.0,
            };
            marks.iter().map(wide).sum()
        };
        let times = budgets[0].makespan.div_duration_f64(budgets[1].makespan) as f32;
        assert!((row(1) - 600.0).abs() < 0.5 && (row(0) - 600.0 * times).abs() < 0.5, "{} {}", row(0), row(1));
        let words = time_budget_words(&runs, language);
        assert!(words.starts_with("one: ") && words.contains("\nother: ") && words.contains("tracing "), "{words}");
    }
}
