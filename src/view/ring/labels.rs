//! Form and position of the labels beside the nodes.
//!
//! They depend on the size and the number of nodes alone, never on the text, so labels do not jump.

use super::angles::direction;
use crate::language::{Language, word};
use crate::view::draw::display_list::{Anchor, Point, TextSize};

/// Form and text size of the labels in a ring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Labels {
    pub(crate) form: LabelForm,
    /// Text size as a multiple of the usual one; it grows with a large ring.
    pub(crate) text_scale: f32,
}

/// Amount of text in a label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LabelForm {
    /// The atoms left, and below them the activity.
    TwoLines,
    /// The atoms left.
    OneLine,
    /// The number of atoms left, without words.
    Number,
    /// No label.
    Nothing,
}

/// In a larger ring only the selected node has a label; the table has the numbers of all nodes.
pub(crate) const MAX_LABELLED_NODES: usize = 16;
/// Up to this height or width, text has its usual size.
const USUAL_SIZE_PX: f32 = 500.0;
/// Distance between labels and the edge.
const EDGE_GAP_PX: f32 = 2.0;

/// Maximum letters of a first line, as in `6 144 left`.
pub(crate) fn first_line_letters(language: Language) -> usize {
    word!(language, 10, 12)
}
/// Maximum letters of a second line, as in `offers help` or `oferece ajuda`.
pub(crate) fn second_line_letters(language: Language) -> usize {
    word!(language, 12, 13)
}
/// Maximum letters of a label that is only a number.
pub(crate) const NUMBER_LETTERS: usize = 5;

impl LabelForm {
    /// Returns the least height and width for this form, and the least radius of the rail as a share of them: labels
    /// must not shrink the ring further.
    fn least(self) -> [f32; 2] {
        match self {
            Self::TwoLines => [380.0, 0.25],
            Self::OneLine => [190.0, 0.3],
            Self::Number => [190.0, 0.2],
            Self::Nothing => [0.0, 0.0],
        }
    }
}

impl Labels {
    /// Chooses the longest form that fits, and the radius of the rail that leaves room for it.
    pub(crate) fn fit(nodes: usize, [width, height]: Point, language: Language) -> (Self, f32) {
        let room = width.min(height);
        let rail = |labels: Self| {
            let [beside, above] = labels.room(language);
            (height / 2.0 - above).min(width / 2.0 - beside)
        };
        let fits = |labels: &Self| {
            let ([least, part], rail) = (labels.form.least(), rail(*labels));
            room >= least && rail >= part * room && labels.are_apart(nodes, rail, language)
        };
        let text_scale = (room / USUAL_SIZE_PX).clamp(1.0, 1.4);
        let forms = [(LabelForm::TwoLines, text_scale), (LabelForm::OneLine, 1.0), (LabelForm::Number, 1.0)];
        // In a large ring one label is no reason to make all nodes smaller.
        let forms = if nodes <= MAX_LABELLED_NODES { &forms[..] } else { &forms[1..] };
        let fitting = forms.iter().map(|&(form, text_scale)| Self { form, text_scale }).find(fits);
        let labels = fitting.unwrap_or(Self { form: LabelForm::Nothing, text_scale: 1.0 });
        (labels, rail(labels))
    }

    /// Whether labels are shorter or smaller than usual.
    pub(crate) fn are_small(&self) -> bool {
        self.form != LabelForm::TwoLines
    }

    /// Returns the text size of a first line.
    pub(crate) fn size(&self) -> TextSize {
        if self.are_small() { TextSize::Small(1.0) } else { TextSize::Body(self.text_scale) }
    }

    /// Returns the maximum width and height of a label.
    fn extent(&self, language: Language) -> Point {
        let (size, second) = (self.size(), TextSize::Small(self.text_scale));
        match self.form {
            LabelForm::TwoLines => [
                size.width(first_line_letters(language)).max(second.width(second_line_letters(language))),
                size.line() + second.line(),
            ],
            LabelForm::OneLine => [size.width(first_line_letters(language)), size.line()],
            LabelForm::Number => [size.width(NUMBER_LETTERS), size.line()],
            LabelForm::Nothing => [0.0, 0.0],
        }
    }

    /// Returns the distance from the rail to the labels: offers pass there.
    pub(crate) fn gap(&self) -> f32 {
        match self.form {
            LabelForm::TwoLines => 18.0 * self.text_scale,
            LabelForm::OneLine | LabelForm::Number => 12.0,
            LabelForm::Nothing => 10.0,
        }
    }

    /// Returns the room that labels need beside the rail, and above it.
    fn room(&self, language: Language) -> [f32; 2] {
        self.extent(language).map(|extent| self.gap() + extent + EDGE_GAP_PX)
    }

    /// Returns the position of a label relative to the centre, as near to the rail as its height allows. To the right
    /// of the ring a text begins at this position, to the left it ends there: so it may have any length.
    pub(crate) fn place(&self, angle: f32, rail: f32, language: Language) -> (Point, Anchor) {
        let (radius, half) = (rail + self.gap(), self.extent(language)[1] / 2.0);
        let (cos, sin) = (angle.cos(), angle.sin());
        if cos.abs() <= 0.2 {
            let away = (radius + half) / sin.abs();
            return ([away * cos, away * sin], Anchor::Centre);
        }
        // The corner nearest to the centre is `radius` away from it, or the middle of the near side where that is
        // nearer.
        let corner = half * sin.abs() + (radius * radius - (half * cos).powi(2)).max(0.0).sqrt();
        let away = if corner * sin.abs() < half { radius / cos.abs() } else { corner };
        ([away * cos, away * sin], if cos > 0.0 { Anchor::Left } else { Anchor::Right })
    }

    /// Returns left, top, right and bottom of a label of the maximum length, relative to the centre.
    pub(crate) fn bounds(&self, angle: f32, rail: f32, language: Language) -> [f32; 4] {
        let ([x, y], anchor) = self.place(angle, rail, language);
        let [width, height] = self.extent(language);
        let left = anchor.left(x, width);
        [left, y - height / 2.0, left + width, y + height / 2.0]
    }

    /// Whether no two labels touch, even if all have their maximum length.
    fn are_apart(&self, nodes: usize, rail: f32, language: Language) -> bool {
        let [width, height] = self.extent(language);
        let reach = |node: usize| {
            let ([x, y], anchor) = self.place(direction(node, nodes), rail, language);
            (anchor.left(x, width), y)
        };
        !(2..=MAX_LABELLED_NODES).contains(&nodes)
            || (0..nodes).all(|node| {
                let ((x, y), (u, v)) = (reach(node), reach((node + 1) % nodes));
                (x - u).abs() >= width || (y - v).abs() >= height
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_exist_at_all_sizes_with_two_lines_in_large_rings() {
        let language = Language::English;
        for nodes in 1..=32 {
            for size in [[240.0, 240.0], [240.0, 900.0], [1000.0, 240.0], [330.0, 300.0]] {
                assert_ne!(Labels::fit(nodes, size, language).0.form, LabelForm::Nothing, "{nodes} nodes at {size:?}");
            }
            let form = if nodes <= 16 { LabelForm::TwoLines } else { LabelForm::OneLine };
            assert_eq!(Labels::fit(nodes, [640.0, 490.0], language).0.form, form, "{nodes} nodes");
            if nodes <= 12 {
                assert_eq!(Labels::fit(nodes, [480.0, 480.0], language).0.form, LabelForm::TwoLines, "{nodes} nodes");
            }
        }
        assert_eq!(Labels::fit(8, [180.0, 180.0], language).0.form, LabelForm::Nothing);
    }
}
