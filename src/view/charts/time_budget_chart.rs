//! Where the time of several runs went, as bars of one length a second.

use crate::language::{Language, word};
use crate::view::analysis::time_budget::TimeBudget;
use crate::view::draw::display_list::{Anchor, Hue, Ink, Mark, Point, TextSize};
use crate::view::text::format::{duration, fraction};

/// The height of one run's bar, with what stands above it.
const ROW: f32 = 42.0;
/// The height of its bar alone.
const BAR: f32 = 16.0;
/// The height of the legend.
const LEGEND: f32 = 24.0;

/// How high the drawing of so many runs is.
pub fn spent_height(runs: usize) -> f32 {
    LEGEND + ROW * runs as f32
}

/// What the parts of a machine's time are called, in the order of [`crate::view::analysis::time_budget::Spent::parts`].
pub fn part_names(language: Language) -> [&'static str; 5] {
    [
        word!(language, "tracing", "calculando"),
        word!(language, "starting", "início"),
        word!(language, "asking", "pedindo"),
        word!(language, "stopped", "parada"),
        word!(language, "waiting at the end", "espera no fim"),
    ]
}

/// Each part's ink: neither is a node's colour.
fn inks() -> [Ink; 5] {
    [Hue::Accent.full(), Hue::Quiet.faint(0.45), Hue::Text.faint(0.85), Hue::Quiet.faint(0.8), Hue::Hairline.full()]
}

/// A bar a run, as long as it took, cut into what its machines' time was spent on.
pub fn spent(runs: &[(&str, &TimeBudget)], width: f32, language: Language) -> Vec<Mark> {
    let mut marks = Vec::new();
    legend(runs, width, &mut marks, language);
    let longest = runs.iter().map(|(_, account)| account.makespan.as_secs_f64()).fold(f64::MIN_POSITIVE, f64::max);
    for (i, (name, account)) in runs.iter().enumerate() {
        let top = LEGEND + ROW * i as f32;
        let label = |at: Point, anchor, text, hue: Hue, marks: &mut Vec<Mark>| {
            marks.push(Mark::Label { at, anchor, text, size: TextSize::Small(1.0), ink: hue.full() });
        };
        label([0.0, top + 9.0], Anchor::Left, (*name).to_owned(), Hue::Text, &mut marks);
        let took = duration(account.makespan, language);
        label([width, top + 9.0], Anchor::Right, took, Hue::Text, &mut marks);
        let length = (account.makespan.as_secs_f64() / longest) as f32 * width;
        let mut left = 0.0;
        for (part, ink) in account.spent.parts().into_iter().zip(inks()) {
            let share = part / account.spent.sum().max(f64::MIN_POSITIVE);
            let wide = share as f32 * length;
            if wide <= 0.0 {
                continue;
            }
            let centre = [left + wide / 2.0, top + 20.0 + BAR / 2.0];
            marks.push(Mark::Box { centre, half: [wide / 2.0, BAR / 2.0], round: 0.0, ink });
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

/// Says the same in words, a line a run.
pub fn spent_words(runs: &[(&str, &TimeBudget)], language: Language) -> String {
    let line = |(name, account): &(&str, &TimeBudget)| {
        let parts = account.spent.parts().into_iter().zip(part_names(language)).filter(|(part, _)| *part > 0.0);
        let parts: Vec<_> =
            parts.map(|(part, name)| format!("{name} {}", fraction(part / account.spent.sum()))).collect();
        format!("{name}: {}; {}", duration(account.makespan, language), parts.join(", "))
    };
    runs.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// Only of parts that there are.
fn legend(runs: &[(&str, &TimeBudget)], width: f32, marks: &mut Vec<Mark>, language: Language) {
    let mut left = 0.0;
    for (i, (name, ink)) in part_names(language).into_iter().zip(inks()).enumerate() {
        let share = |account: &TimeBudget| account.spent.parts()[i] / account.spent.sum().max(f64::MIN_POSITIVE);
        let needed = 18.0 + TextSize::Small(1.0).width(name.chars().count()) + 10.0;
        if runs.iter().all(|(_, account)| share(account) < 0.005) || left + needed > width + 20.0 {
            continue;
        }
        marks.push(Mark::Box { centre: [left + 6.0, 9.0], half: [6.0; 2], round: 2.0, ink });
        marks.push(Mark::Label {
            at: [left + 18.0, 9.0],
            anchor: Anchor::Left,
            text: name.to_owned(),
            size: TextSize::Small(1.0),
            ink: Hue::Quiet.full(),
        });
        left += needed;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::tests::sample_runs;

    #[test]
    fn bars_are_as_long_as_runs_and_their_parts_fill_them() {
        let language = Language::English;
        let accounts = [&[1.0, 1.0][..], &[1.0, 0.1]]
            .map(|speeds| TimeBudget::of(&sample_runs::log(speeds, 400)).expect("its end"));
        let runs = [("one", &accounts[0]), ("other", &accounts[1])];
        let marks = spent(&runs, 600.0, language);
        let row = |row: usize| -> f32 {
            let [top, bottom] = [row, row + 1].map(|row| LEGEND + ROW * row as f32);
            let wide = |mark: &Mark| match mark {
                Mark::Box { centre, half, .. } if (top..bottom).contains(&centre[1]) => 2.0 * half[0],
                _ => 0.0,
            };
            marks.iter().map(wide).sum()
        };
        let times = accounts[0].makespan.div_duration_f64(accounts[1].makespan) as f32;
        assert!((row(1) - 600.0).abs() < 0.5 && (row(0) - 600.0 * times).abs() < 0.5, "{} {}", row(0), row(1));
        let words = spent_words(&runs, language);
        assert!(words.starts_with("one: ") && words.contains("\nother: ") && words.contains("tracing "), "{words}");
    }
}
