//! The spans along a ray (Figure 2): a row for each solid on the ray, and below it rows for its operands.

use super::phrases::passes_nothing;
use super::{Inspected, cut, edge, label, line, shown};
use crate::csg::{Operation, SolidKind, SpanDiagram};
use crate::language::{Language, say, word};
use crate::view::charts::axis::{Axis, Ruler};
use crate::view::draw::display_list::{Anchor, Hue, Mark};
use crate::view::text::format::{count, distance_words};
use crate::view::text::scene_stats::shape_names;

/// Drawn spans.
#[derive(Clone, Debug, PartialEq)]
pub struct SpanPlot {
    /// Marks of the drawing.
    pub marks: Vec<Mark>,
    /// Height of the drawing.
    pub height: f32,
}

/// Row of a solid, or of an operand, that the ray enters.
pub(super) struct SpanRow<'a> {
    pub(super) diagram: &'a SpanDiagram,
    /// Number of compositions that it is an operand of.
    pub(super) depth: usize,
    /// Whether it is the solid that the ray met, or an operand of it.
    pub(super) is_met: bool,
}

/// Height of a row.
const ROW_HEIGHT: f32 = 20.0;
/// Indent of an operand's name.
const INDENT: f32 = 12.0;
/// Most indents of a name.
const MAX_INDENTS: usize = 5;
/// Part of the ray's length that is drawn beyond its end.
const BEYOND_END: f64 = 0.35;

impl Inspected {
    /// Draws the spans of the chosen ray in solids and their operands, `most` rows at most. Distance from the ray's
    /// start is to the right.
    pub fn spans(&self, width: f32, most: usize, language: Language) -> SpanPlot {
        let (rows, range) = (self.rows(), self.range());
        if rows.is_empty() {
            let marks = vec![label([0.0, ROW_HEIGHT / 2.0], Anchor::Left, passes_nothing(language), Hue::Quiet)];
            return SpanPlot { marks, height: ROW_HEIGHT };
        }
        let left = (0.42 * width).min(210.0);
        let axis = Axis { range: Some(range.into()), ..Axis::default() };
        let text_width = |text: &str| super::SMALL.width(text.chars().count()) + 8.0;
        let plot = width - left - RIGHT_MARGIN;
        let ruler = Ruler::new(&axis, std::iter::empty(), plot, text_width, language);
        let x = |t: f64| left + plot * ruler.place(t).unwrap_or(0.0).clamp(0.0, 1.0) as f32;
        // Centre of a text, so that it is not cut at the right.
        let middle = |text: &str, at: f32| at.min(width - super::SMALL.width(text.chars().count()) / 2.0);
        let (shown, top) = (rows.len().min(most), ROW_HEIGHT);
        let bottom = top + shown as f32 * ROW_HEIGHT;
        let mut marks = Vec::new();
        for tick in &ruler.ticks {
            let at = x(tick.value);
            marks.push(line([[at, top], [at, bottom]], 1.0, Hue::Hairline.full()));
            marks.push(label(
                [middle(&tick.text, at), bottom + ROW_HEIGHT / 2.0],
                Anchor::Centre,
                &tick.text,
                Hue::Quiet,
            ));
        }
        for (row, y) in rows.iter().take(shown).zip((0..).map(|index| top + (index as f32 + 0.5) * ROW_HEIGHT)) {
            self.draw_row_name(row, y, left, &mut marks, language);
            self.draw_bars(row.diagram, y, &x, range, &mut marks);
        }
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
            marks.push(label([0.0, bottom + ROW_HEIGHT / 2.0], Anchor::Left, text, Hue::Quiet));
        }
        SpanPlot { marks, height: bottom + ROW_HEIGHT }
    }

    /// Rows of the solids that the ray enters, each solid before its operands.
    pub(super) fn rows(&self) -> Vec<SpanRow<'_>> {
        let met = self.ray().met.map(|met| met.start.root);
        let (range, mut rows) = (self.range(), Vec::new());
        for (root, diagram) in self.diagrams.iter().filter(|(_, diagram)| spans_in(diagram, range).next().is_some()) {
            let mut waiting = vec![(diagram, 0)];
            while let Some((diagram, depth)) = waiting.pop() {
                rows.push(SpanRow { diagram, depth, is_met: met == Some(*root) });
                // Operands that the ray does not enter have no row.
                let passed = diagram.operands.iter().rev().filter(|operand| spans_in(operand, range).next().is_some());
                waiting.extend(passed.map(|operand| (operand, depth + 1)));
            }
        }
        rows
    }

    /// Name of a row.
    pub(super) fn row_name(&self, diagram: &SpanDiagram, language: Language) -> String {
        match diagram.kind {
            SolidKind::Composition(Operation::Union) => word!(language, "union", "união").into(),
            SolidKind::Composition(Operation::Intersection) => word!(language, "intersection", "interseção").into(),
            SolidKind::Composition(Operation::Difference) => word!(language, "difference", "diferença").into(),
            SolidKind::Primitive { tag, kind } => {
                let [kind, _] = shape_names(kind, language);
                self.name(tag).map_or_else(|| kind.into(), |name| format!("{name}: {kind}"))
            }
        }
    }

    /// Range of distances that is drawn: those at which the ray enters or leaves a solid, and a margin. It begins at 0
    /// if that is near enough.
    fn range(&self) -> [f64; 2] {
        let to = self.ray().path.to;
        let most = if to.is_finite() { (1.0 + BEYOND_END) * to } else { f64::MAX };
        let (mut first, mut last) = if to.is_finite() { (to, to) } else { (f64::MAX, 0.0) };
        let mut waiting: Vec<&SpanDiagram> = self.diagrams.iter().map(|(_, diagram)| diagram).collect();
        while let Some(diagram) = waiting.pop() {
            for &t in diagram.spans.iter().flatten().filter(|t| (MIN_SPAN_END..=most).contains(*t)) {
                (first, last) = (first.min(t), last.max(t));
            }
            waiting.extend(&diagram.operands);
        }
        let more = (0.08 * (last - first)).max(0.02 * last);
        let (near, far) = (first - more, last + more);
        match far.is_finite() && far > MIN_SPAN_END {
            true if near > 0.35 * far => [near, far],
            true => [0.0, far],
            false => [0.0, 1.0],
        }
    }

    fn draw_row_name(&self, row: &SpanRow<'_>, y: f32, left: f32, marks: &mut Vec<Mark>, language: Language) {
        let x = INDENT * row.depth.min(MAX_INDENTS) as f32;
        let hue = if row.is_met { Hue::Text } else { Hue::Quiet };
        let text = cut(&self.row_name(row.diagram, language), left - x - 8.0);
        marks.push(label([x, y], Anchor::Left, text, hue));
    }

    fn draw_bars(
        &self,
        diagram: &SpanDiagram,
        y: f32,
        x: &impl Fn(f64) -> f32,
        range: [f64; 2],
        marks: &mut Vec<Mark>,
    ) {
        let inks = match diagram.kind {
            SolidKind::Composition(_) => [Hue::Quiet, Hue::Quiet],
            SolidKind::Primitive { tag, .. } => {
                let colour = shown(self.material(tag).colour);
                [Hue::Fixed(edge(colour)), Hue::Fixed(colour)]
            }
        };
        let high = if matches!(diagram.kind, SolidKind::Composition(_)) { 3.0 } else { 6.0 };
        for [enter, leave] in spans_in(diagram, range) {
            let (from, to) = (x(enter), x(leave));
            // A short span has a least width, so that it is visible.
            let half = ((to - from) / 2.0).max(1.0);
            for (hue, by) in inks.into_iter().zip([0.0, 1.0]) {
                let half = [(half - by).max(0.5), high - by];
                marks.push(Mark::Box { centre: [(from + to) / 2.0, y], half, round: 1.5, ink: hue.full() });
            }
        }
    }
}

/// Least end of a drawn span after the beginning of the range, as a part of the range's end.
const MIN_SPAN_END: f64 = 1e-9;
/// Space to the right of the plot, for one half of its last number.
const RIGHT_MARGIN: f32 = 24.0;

/// Returns the spans within a range of distances, cut to it.
fn spans_in(diagram: &SpanDiagram, [near, far]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let first = near + MIN_SPAN_END * far;
    let stays = diagram.spans.iter().filter(move |[enter, leave]| *leave > first && *enter < far);
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
    fn drawing_has_at_most_the_asked_rows_and_is_inside() {
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
                    assert!(spans.height <= (most as f32 + 2.0) * ROW_HEIGHT);
                }
            }
        });
    }

    #[test]
    fn met_solid_has_a_row_and_the_end_is_marked() {
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
