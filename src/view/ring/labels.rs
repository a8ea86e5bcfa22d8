//! What is said beside the nodes, and how much of it there is room for.
//!
//! The room depends on the size and the number of nodes alone, never on what is said, so that nothing jumps.

use super::angles::direction;
use crate::language::{Language, word};
use crate::view::draw::display_list::{Anchor, Point, TextSize};

/// How labels look in a ring of some size.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Labels {
    pub(crate) form: Form,
    /// How much larger than usual words are: in a large ring they grow with it.
    pub(crate) text: f32,
}

/// How much is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// How much is left, and below it what the node does.
    TwoLines,
    /// How much is left.
    OneLine,
    /// A mere number.
    Number,
    Nothing,
}

/// Beyond this many nodes only the selected one has a label; the rows have the numbers of all.
pub(crate) const LABELLED: usize = 16;
/// Up to this height or width words have their usual size.
const USUAL: f32 = 500.0;
/// Between labels and the edge.
const EDGE: f32 = 2.0;

/// The most letters in a first line, as in `6 144 left`, in a second one, as in `10 % · 62/s`, and in a number.
pub(crate) fn longest(language: Language) -> usize {
    word!(language, 10, 12)
}
pub(crate) const SECOND: usize = 12;
pub(crate) const NUMBER: usize = 5;

impl Form {
    /// From which height and width on it is thought of, and what part of these the rail's radius is at least: words
    /// are not worth more.
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
    /// The most that there is room for, and the rail's radius that leaves this room.
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
        let text = (room / USUAL).clamp(1.0, 1.4);
        let forms = [(Form::TwoLines, text), (Form::OneLine, 1.0), (Form::Number, 1.0)];
        let fitting = forms.map(|(form, text)| Self { form, text }).into_iter().find(fits);
        let labels = fitting.unwrap_or(Self { form: Form::Nothing, text: 1.0 });
        (labels, rail(labels))
    }

    /// Whether there is little room for words.
    pub(crate) fn are_small(&self) -> bool {
        self.form != Form::TwoLines
    }

    /// How large what is to be read is.
    pub(crate) fn size(&self) -> TextSize {
        if self.are_small() { TextSize::Small(1.0) } else { TextSize::Body(self.text) }
    }

    /// What a label takes at most.
    fn extent(&self, language: Language) -> Point {
        let (size, second) = (self.size(), TextSize::Small(self.text));
        match self.form {
            Form::TwoLines => [size.width(longest(language)).max(second.width(SECOND)), size.line() + second.line()],
            Form::OneLine => [size.width(longest(language)), size.line()],
            Form::Number => [size.width(NUMBER), size.line()],
            Form::Nothing => [0.0, 0.0],
        }
    }

    /// From the rail to the labels: offers need room there.
    pub(crate) fn gap(&self) -> f32 {
        match self.form {
            Form::TwoLines => 18.0 * self.text,
            Form::OneLine | Form::Number => 12.0,
            Form::Nothing => 10.0,
        }
    }

    /// What the labels need beside the rail, and above it.
    fn room(&self, language: Language) -> [f32; 2] {
        self.extent(language).map(|extent| self.gap() + extent + EDGE)
    }

    /// The place of a label seen from the centre: as near to the rail as its height allows. To the right of the ring a
    /// text begins at its place, to the left it ends there, so that it may have any length.
    pub(crate) fn place(&self, angle: f32, rail: f32, language: Language) -> (Point, Anchor) {
        let (radius, half) = (rail + self.gap(), self.extent(language)[1] / 2.0);
        let (cos, sin) = (angle.cos(), angle.sin());
        if cos.abs() <= 0.2 {
            let away = (radius + half) / sin.abs();
            return ([away * cos, away * sin], Anchor::Centre);
        }
        // The corner nearest to the centre is `radius` away from it, or the middle of the near side where that is nearer.
        let corner = half * sin.abs() + (radius * radius - (half * cos).powi(2)).max(0.0).sqrt();
        let away = if corner * sin.abs() < half { radius / cos.abs() } else { corner };
        ([away * cos, away * sin], if cos > 0.0 { Anchor::Left } else { Anchor::Right })
    }

    /// Whether no two labels touch even if all are as long as they get.
    fn are_apart(&self, nodes: usize, rail: f32, language: Language) -> bool {
        let [width, height] = self.extent(language);
        let reach = |node: usize| {
            let ([x, y], anchor) = self.place(direction(node, nodes), rail, language);
            (anchor.left(x, width), y)
        };
        !(2..=LABELLED).contains(&nodes)
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
    fn there_are_labels_at_all_sizes_and_two_lines_where_there_is_room() {
        let language = Language::English;
        for nodes in 1..=32 {
            for size in [[240.0, 240.0], [240.0, 900.0], [1000.0, 240.0], [330.0, 300.0]] {
                assert_ne!(Labels::fit(nodes, size, language).0.form, Form::Nothing, "{nodes} nodes at {size:?}");
            }
            assert_eq!(Labels::fit(nodes, [640.0, 490.0], language).0.form, Form::TwoLines, "{nodes} nodes");
            if nodes <= 12 {
                assert_eq!(Labels::fit(nodes, [480.0, 480.0], language).0.form, Form::TwoLines, "{nodes} nodes");
            }
        }
        assert_eq!(Labels::fit(8, [180.0, 180.0], language).0.form, Form::Nothing);
    }
}
