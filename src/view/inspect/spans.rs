//! The spans along a ray (Figure 2): a row for each solid that it passes, and below it what the solid is made of.

use super::phrases::passes_nothing;
use super::{Inspected, cut, edge, label, line, shown};
use crate::csg::{Operation, SolidKind, SpanDiagram};
use crate::language::{Language, say, word};
use crate::view::charts::axis::{Axis, Ruler};
use crate::view::draw::display_list::{Anchor, Hue, Mark};
use crate::view::text::format::{count, distance_words};
use crate::view::text::scene_stats::shape_names;

/// The spans as they are drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct SpanPlot {
    /// What is to be drawn.
    pub marks: Vec<Mark>,
    /// How high it is.
    pub height: f32,
}

/// A solid, or an operand of it, that the ray passes.
pub(super) struct SpanRow<'a> {
    pub(super) figure: &'a SpanDiagram,
    /// Of how many compositions it is an operand.
    pub(super) depth: usize,
    /// It is what the ray met, or a part of that.
    pub(super) is_met: bool,
}

const ROW: f32 = 20.0;
const INDENT: f32 = 12.0;
/// No row is further to the right.
const MOST_INDENTS: usize = 5;
/// So far a stay is drawn beyond where the ray ends, in the way to there.
const BEYOND: f64 = 0.35;

impl Inspected {
    /// The stays of the chosen ray in each solid that it passes and in what it is made of, `most` rows at most. Distances are
    /// to the right.
    pub fn spans(&self, width: f32, most: usize, language: Language) -> SpanPlot {
        let (rows, range) = (self.rows(), self.range());
        if rows.is_empty() {
            let marks = vec![label([0.0, ROW / 2.0], Anchor::Left, passes_nothing(language), Hue::Quiet)];
            return SpanPlot { marks, height: ROW };
        }
        let left = (0.42 * width).min(210.0);
        let axis = Axis { range: Some(range.into()), ..Axis::default() };
        let text_width = |text: &str| super::SMALL.width(text.chars().count()) + 8.0;
        let plot = width - left - RIGHT;
        let ruler = Ruler::new(&axis, std::iter::empty(), plot, text_width, language);
        let x = |t: f64| left + plot * ruler.place(t).unwrap_or(0.0).clamp(0.0, 1.0) as f32;
        // A text's middle, so that it is not cut at the right.
        let middle = |text: &str, at: f32| at.min(width - super::SMALL.width(text.chars().count()) / 2.0);
        let (shown, top) = (rows.len().min(most), ROW);
        let bottom = top + shown as f32 * ROW;
        let mut marks = Vec::new();
        for tick in &ruler.ticks {
            let at = x(tick.value);
            marks.push(line([[at, top], [at, bottom]], 1.0, Hue::Hairline.full()));
            marks.push(label([middle(&tick.text, at), bottom + ROW / 2.0], Anchor::Centre, &tick.text, Hue::Quiet));
        }
        for (row, y) in rows.iter().take(shown).zip((0..).map(|index| top + (index as f32 + 0.5) * ROW)) {
            self.row(row, y, left, &mut marks, language);
            self.bars(row.figure, y, &x, range, &mut marks);
        }
        // What is measured to the right.
        let along = word!(language, "along the ray", "ao longo do raio");
        marks.push(label([0.0, top / 2.0 - 2.0], Anchor::Left, along, Hue::Quiet));
        let to = self.ray().path.to;
        if to.is_finite() {
            let at = x(to);
            marks.push(line([[at, top - 3.0], [at, bottom]], 2.0, Hue::Text.full()));
            let end = distance_words(to, language);
            let text = say!(language, "ends at {end}", "termina em {end}");
            let beside = super::SMALL.width(along.len() + 1 + text.chars().count() / 2);
            marks.push(label([middle(&text, at).max(beside), top / 2.0 - 2.0], Anchor::Centre, text, Hue::Text));
        }
        if shown < rows.len() {
            let more = count((rows.len() - shown) as u64);
            let text = say!(language, "and {more} more", "e mais {more}");
            marks.push(label([0.0, bottom + ROW / 2.0], Anchor::Left, text, Hue::Quiet));
        }
        SpanPlot { marks, height: bottom + ROW }
    }

    /// All that the ray passes, each solid before what it is made of.
    pub(super) fn rows(&self) -> Vec<SpanRow<'_>> {
        let met = self.ray().met.map(|met| met.start.root);
        let (range, mut rows) = (self.range(), Vec::new());
        for (root, figure) in self.figures.iter().filter(|(_, figure)| seen(figure, range).next().is_some()) {
            let mut waiting = vec![(figure, 0)];
            while let Some((figure, depth)) = waiting.pop() {
                rows.push(SpanRow { figure, depth, is_met: met == Some(*root) });
                // What the ray does not pass says nothing.
                let passed = figure.operands.iter().rev().filter(|operand| seen(operand, range).next().is_some());
                waiting.extend(passed.map(|operand| (operand, depth + 1)));
            }
        }
        rows
    }

    /// What a row is called.
    pub(super) fn row_name(&self, figure: &SpanDiagram, language: Language) -> String {
        match figure.what {
            SolidKind::Composition(Operation::Union) => word!(language, "union", "união").into(),
            SolidKind::Composition(Operation::Intersection) => word!(language, "intersection", "interseção").into(),
            SolidKind::Composition(Operation::Difference) => word!(language, "difference", "diferença").into(),
            SolidKind::Primitive { tag, kind } => {
                let [kind, _] = shape_names(kind, language);
                self.name(tag).map_or_else(|| kind.into(), |name| format!("{name}: {kind}"))
            }
        }
    }

    /// The distances that are drawn: those at which the ray enters or leaves anything, and some more. From 0 on if most of the
    /// way would be seen anyway.
    fn range(&self) -> [f64; 2] {
        let to = self.ray().path.to;
        let most = if to.is_finite() { (1.0 + BEYOND) * to } else { f64::MAX };
        let (mut first, mut last) = if to.is_finite() { (to, to) } else { (f64::MAX, 0.0) };
        let mut waiting: Vec<&SpanDiagram> = self.figures.iter().map(|(_, figure)| figure).collect();
        while let Some(figure) = waiting.pop() {
            for &t in figure.stays.iter().flatten().filter(|t| (NOTHING..=most).contains(*t)) {
                (first, last) = (first.min(t), last.max(t));
            }
            waiting.extend(&figure.operands);
        }
        let more = (0.08 * (last - first)).max(0.02 * last);
        let (near, far) = (first - more, last + more);
        match far.is_finite() && far > NOTHING {
            true if near > 0.35 * far => [near, far],
            true => [0.0, far],
            false => [0.0, 1.0],
        }
    }

    fn row(&self, row: &SpanRow<'_>, y: f32, left: f32, marks: &mut Vec<Mark>, language: Language) {
        let x = INDENT * row.depth.min(MOST_INDENTS) as f32;
        let hue = if row.is_met { Hue::Text } else { Hue::Quiet };
        let text = cut(&self.row_name(row.figure, language), left - x - 8.0);
        marks.push(label([x, y], Anchor::Left, text, hue));
    }

    fn bars(&self, figure: &SpanDiagram, y: f32, x: &impl Fn(f64) -> f32, range: [f64; 2], marks: &mut Vec<Mark>) {
        let inks = match figure.what {
            SolidKind::Composition(_) => [Hue::Quiet, Hue::Quiet],
            SolidKind::Primitive { tag, .. } => {
                let colour = shown(self.material(tag).colour);
                [Hue::Told(edge(colour)), Hue::Told(colour)]
            }
        };
        let high = if matches!(figure.what, SolidKind::Composition(_)) { 3.0 } else { 6.0 };
        for [enter, leave] in seen(figure, range) {
            let (from, to) = (x(enter), x(leave));
            // A stay that is too short to be seen is seen.
            let half = ((to - from) / 2.0).max(1.0);
            for (hue, by) in inks.into_iter().zip([0.0, 1.0]) {
                let half = [(half - by).max(0.5), high - by];
                marks.push(Mark::Box { centre: [(from + to) / 2.0, y], half, round: 1.5, ink: hue.full() });
            }
        }
    }
}

/// A stay that ends nearer to where the drawing begins, in parts of its distances, only touches that place.
const NOTHING: f64 = 1e-9;
/// To the right of the plot, for the half of its last number.
const RIGHT: f32 = 24.0;

/// The stays that are drawn, cut to what is drawn of them.
fn seen(figure: &SpanDiagram, [near, far]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let first = near + NOTHING * far;
    let stays = figure.stays.iter().filter(move |[enter, leave]| *leave > first && *enter < far);
    stays.map(move |[enter, leave]| [enter.max(near), leave.min(far)])
}

#[cfg(test)]
mod tests {
    use super::super::ChosenRay;
    use super::super::tests::{assert_within, each};
    use super::*;
    use crate::picture::Quality;

    fn rays(of: &Inspected) -> impl Iterator<Item = ChosenRay> + use<> {
        (0..of.sample().rays.len().min(4)).map(|ray| ChosenRay { sample: 0, ray })
    }

    #[test]
    fn rows_are_no_more_than_asked_for_and_stay_within() {
        let language = Language::English;
        each(Quality::default(), |tracer, inspected| {
            for chosen in rays(&inspected) {
                let one = inspected.choose(tracer, chosen).expect("a ray of it");
                for (width, most) in [(300.0, 3), (640.0, 12)] {
                    let spans = one.spans(width, most, language);
                    assert_within(&spans.marks, [width, spans.height]);
                    let says_more = spans
                        .marks
                        .iter()
                        .any(|mark| matches!(mark, Mark::Label { text, .. } if text.contains("more")));
                    assert_eq!(says_more, one.rows().len() > most);
                    assert!(spans.height <= (most as f32 + 2.0) * ROW);
                }
            }
        });
    }

    #[test]
    fn what_the_ray_met_is_among_the_rows_and_its_end_is_marked() {
        let language = Language::English;
        each(Quality::default(), |tracer, inspected| {
            for chosen in rays(&inspected) {
                let one = inspected.choose(tracer, chosen).expect("a ray of it");
                let spans = one.spans(640.0, usize::MAX, language);
                let is_end = |mark: &Mark| matches!(mark, Mark::Label { text, .. } if text.starts_with("ends at"));
                let ends = spans.marks.iter().any(is_end);
                assert_eq!(ends, one.ray().met.is_some());
                assert_eq!(one.rows().iter().any(|row| row.is_met), one.ray().met.is_some());
            }
        });
    }
}
