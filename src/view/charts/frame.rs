//! The frame of a chart: title, legend, axes, and the plot between them.

use super::axis::{Axis, Ruler};
use crate::language::Language;
use crate::view::draw::display_list::{Anchor, Hue, Ink, Mark, Point, TextSize};
use crate::view::draw::polyline::dashes;

/// Texts above a plot, and the number of lines below it.
pub(crate) struct ChartHeading<'a> {
    /// Title of the chart.
    pub(crate) title: &'a str,
    /// A line below the title.
    pub(crate) note: &'a str,
    /// Names and colours of the legend.
    pub(crate) legend: &'a [(&'a str, Hue)],
    /// Lines of text below the plot.
    pub(crate) lines_below: usize,
}

/// A chart while it is drawn.
pub(crate) struct ChartFrame {
    /// Marks drawn so far.
    pub(crate) marks: Vec<Mark>,
    size: Point,
    /// Edges of the plot.
    pub(crate) left: f32,
    pub(crate) top: f32,
    pub(crate) right: f32,
    pub(crate) bottom: f32,
}

/// Empty space round the chart.
const MARGIN: f32 = 24.0;
/// Least space beside the plot, so that a number below its corner is not cut.
pub(crate) const MIN_SIDE_WIDTH: f32 = 64.0;
/// Text size of the title.
const TITLE_SIZE: f32 = 28.0;
/// Text size of the note below the title.
const NOTE_SIZE: f32 = 18.0;
/// Text size of everything else.
const LABEL_SIZE: f32 = 16.0;
/// Least text size that can be read from the back of a room.
const MIN_TEXT_SIZE: f32 = 15.0;
/// Space between a text and its mark.
pub(crate) const GAP: f32 = 10.0;
/// Lengths of the dashes and gaps of a reference line.
pub(crate) const DASHES: [f32; 2] = [10.0, 6.0];
/// Lengths of the dots and gaps of a line that leads to a name.
pub(crate) const DOTTED: [f32; 2] = [2.0, 4.0];
/// Height of a line of labels.
pub(crate) const LINE_HEIGHT: f32 = 20.0;
/// Distance from the plot to the first line below it.
const FIRST_LINE_BELOW: f32 = 20.0;
/// Distance from one line below the plot to the next.
const LINE_STEP: f32 = 22.0;

impl ChartFrame {
    /// Least size of a chart.
    pub(crate) const MIN_SIZE: Point = [480.0, 272.0];

    /// Draws the texts above the plot and its vertical axis, with a space of width `aside` to the right of the plot.
    pub(crate) fn new(
        size: Point,
        heading: &ChartHeading<'_>,
        axis: &Axis,
        values: impl Iterator<Item = f64>,
        aside: f32,
        language: Language,
    ) -> (Self, Ruler) {
        let size = [size[0].max(Self::MIN_SIZE[0]), size[1].max(Self::MIN_SIZE[1])];
        let bottom = size[1] - MARGIN - GAP - heading.lines_below as f32 * LINE_STEP;
        let right = size[0] - (MARGIN + aside).max(MIN_SIDE_WIDTH);
        let mut frame = Self { marks: Vec::new(), size, left: MARGIN, top: MARGIN, right, bottom };
        let width = size[0] - 2.0 * MARGIN;
        frame.heading(heading.title, strong(TITLE_SIZE), Hue::Text, width);
        frame.heading(heading.note, plain(NOTE_SIZE), Hue::Quiet, width);
        frame.legend(heading.legend, width);
        frame.top += GAP;
        frame.heading(&axis.label, plain(LABEL_SIZE), Hue::Quiet, width);
        frame.top += GAP;
        let ruler = Ruler::new(axis, values, frame.bottom - frame.top, |_| LINE_HEIGHT, language);
        let widest = ruler.ticks.iter().map(|tick| width_of(&tick.text)).fold(0.0, f32::max);
        frame.left = (MARGIN + widest + GAP).max(MIN_SIDE_WIDTH);
        frame.rows(&ruler);
        (frame, ruler)
    }

    /// Draws the horizontal axis: numbers below the plot.
    pub(crate) fn columns(&mut self, axis: &Axis, values: impl Iterator<Item = f64>, language: Language) -> Ruler {
        let ruler = Ruler::new(axis, values, self.right - self.left, |text| width_of(text) + 2.0 * GAP, language);
        for tick in &ruler.ticks {
            let [x, bottom] = self.at([ruler.place(tick.value).unwrap_or(0.0), 0.0]);
            self.line(vec![[x, bottom], [x, bottom + 6.0]], 1.0, Hue::Hairline.full());
            self.below(0, &tick.text, x, f32::INFINITY);
        }
        let middle = (self.left + self.right) / 2.0;
        let (at, room) = (
            [middle, self.bottom + FIRST_LINE_BELOW + LINE_STEP],
            2.0 * middle.min(self.size[0] - middle) - 2.0 * MARGIN,
        );
        self.label(at, Anchor::Centre, &axis.label, Hue::Quiet, room);
        ruler
    }

    /// Writes a name or a number in a line below the plot.
    pub(crate) fn below(&mut self, line: usize, text: &str, x: f32, room: f32) {
        self.label(
            [x, self.bottom + FIRST_LINE_BELOW + line as f32 * LINE_STEP],
            Anchor::Centre,
            text,
            Hue::Text,
            room,
        );
    }

    /// Writes a label.
    fn label(&mut self, at: Point, anchor: Anchor, text: &str, hue: Hue, room: f32) {
        let (text, size) = fitted(text, plain(LABEL_SIZE), room);
        self.text(at, anchor, text, size, hue.full());
    }

    /// Writes a name in its own colour.
    pub(crate) fn name(&mut self, at: Point, text: &str, hue: Hue, room: f32) {
        let (text, size) = fitted(text, strong(LABEL_SIZE), room);
        self.text(at, Anchor::Left, text, size, hue.full());
    }

    /// Draws a line.
    pub(crate) fn line(&mut self, points: Vec<Point>, width: f32, ink: Ink) {
        if points.len() > 1 {
            self.marks.push(Mark::Line { points, width, ink });
        }
    }

    /// Draws a dashed line.
    pub(crate) fn dashed(&mut self, points: &[Point], [dash, gap]: [f32; 2], width: f32, ink: Ink) {
        for piece in dashes(points, dash, gap) {
            self.line(piece, width, ink);
        }
    }

    /// Converts a point of the plot, whose corners are 0, 0 and 1, 1.
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> Point {
        [self.left + x as f32 * (self.right - self.left), self.bottom - y as f32 * (self.bottom - self.top)]
    }

    /// Space from `x` to the right edge.
    pub(crate) fn room_from(&self, x: f32) -> f32 {
        self.size[0] - MARGIN / 2.0 - x
    }

    fn text(&mut self, at: Point, anchor: Anchor, text: String, size: TextSize, ink: Ink) {
        if !text.is_empty() {
            self.marks.push(Mark::Label { at, anchor, text, size, ink });
        }
    }

    /// Writes a line above the plot.
    fn heading(&mut self, text: &str, size: TextSize, hue: Hue, room: f32) {
        if !text.is_empty() {
            let height = 1.3 * size.units();
            let (text, size) = fitted(text, size, room);
            self.text([MARGIN, self.top + height / 2.0], Anchor::Left, text, size, hue.full());
            self.top += height;
        }
    }

    /// Draws the legend, in as many rows as it needs.
    fn legend(&mut self, names: &[(&str, Hue)], room: f32) {
        const KEY_SIZE: f32 = 14.0;
        const ROW_HEIGHT: f32 = 26.0;
        if names.is_empty() {
            return;
        }
        self.top += GAP / 2.0;
        let mut x = MARGIN;
        for &(name, hue) in names {
            let width = strong(LABEL_SIZE).width(name.chars().count()).min(room - KEY_SIZE - GAP);
            if x > MARGIN && x + KEY_SIZE + GAP + width > MARGIN + room {
                (x, self.top) = (MARGIN, self.top + ROW_HEIGHT);
            }
            let y = self.top + ROW_HEIGHT / 2.0;
            let (centre, half) = ([x + KEY_SIZE / 2.0, y], [KEY_SIZE / 2.0; 2]);
            self.marks.push(Mark::Box { centre, half, round: 2.0, ink: hue.full() });
            let (text, size) = fitted(name, strong(LABEL_SIZE), width + 0.1);
            self.text([x + KEY_SIZE + GAP, y], Anchor::Left, text, size, Hue::Text.full());
            x += KEY_SIZE + GAP + width + 2.0 * GAP;
        }
        self.top += ROW_HEIGHT;
    }

    /// Draws hairlines across the plot with their numbers; the one at 0 is stronger.
    fn rows(&mut self, ruler: &Ruler) {
        for tick in &ruler.ticks {
            let place = ruler.place(tick.value).unwrap_or(0.0);
            let (from, to) = (self.at([0.0, place]), self.at([1.0, place]));
            let ink = if tick.value == 0.0 { Hue::Quiet } else { Hue::Hairline }.full();
            self.line(vec![from, to], 1.0, ink);
            self.label([from[0] - GAP, from[1]], Anchor::Right, &tick.text, Hue::Text, f32::INFINITY);
        }
    }
}

/// Width of a label.
pub(crate) fn width_of(text: &str) -> f32 {
    plain(LABEL_SIZE).width(text.chars().count())
}

/// Returns the width of a name in a chart's legend or axis, in the chart's units.
pub(crate) fn width_of_name(text: &str) -> f32 {
    strong(LABEL_SIZE).width(text.chars().count())
}

fn plain(units: f32) -> TextSize {
    TextSize::Small(units / TextSize::SMALL)
}

fn strong(units: f32) -> TextSize {
    TextSize::Body(units / TextSize::BODY)
}

/// Fits a text into a width: makes it smaller if needed, and cuts it if that is not enough.
fn fitted(text: &str, size: TextSize, room: f32) -> (String, TextSize) {
    let letters = text.chars().count();
    let least = MIN_TEXT_SIZE / size.units();
    let share = (room / size.width(letters).max(1.0)).clamp(least, 1.0);
    let size = match size {
        TextSize::Small(times) => TextSize::Small(times * share),
        TextSize::Body(times) => TextSize::Body(times * share),
        TextSize::Fit(units) => TextSize::Fit(units * share),
    };
    let most = (room / size.width(1) + 0.01) as usize;
    if letters <= most {
        return (text.to_owned(), size);
    }
    let kept: String = text.chars().take(most.saturating_sub(1)).collect();
    (kept.trim_end().to_owned() + "…", size)
}

#[cfg(test)]
pub(crate) mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Returns the texts and their boxes: left, top, right, bottom.
    fn words(marks: &[Mark]) -> Vec<([f32; 4], String)> {
        let extent = |mark: &Mark| match mark {
            Mark::Label { at: [x, y], anchor, text, size, .. } => {
                let (width, half) = (size.width(text.chars().count()), size.units() / 2.0);
                let left = anchor.left(*x, width);
                Some([left, y - half, left + width, y + half])
            }
            _ => None,
        };
        let text = |mark: &Mark| if let Mark::Label { text, .. } = mark { text.clone() } else { String::new() };
        marks.iter().filter_map(|mark| Some((extent(mark)?, text(mark)))).collect()
    }

    /// Checks that all texts are inside, do not touch, and are large enough.
    pub(crate) fn check_words(marks: &[Mark], [width, height]: Point) -> Result<(), TestCaseError> {
        let words = words(marks);
        for (i, (one, text)) in words.iter().enumerate() {
            let inside = one[0] >= 0.0 && one[1] >= 0.0 && one[2] <= width && one[3] <= height;
            prop_assert!(
                inside && one[3] - one[1] >= MIN_TEXT_SIZE - 0.01,
                "{text:?} at {one:?} of {width} × {height}"
            );
            for (other, than) in &words[..i] {
                let apart = one[0] >= other[2] || other[0] >= one[2] || one[1] >= other[3] || other[1] >= one[3];
                prop_assert!(apart, "{text:?} at {one:?} touches {than:?} at {other:?}");
            }
        }
        Ok(())
    }

    /// Returns the plot's left, top, right and bottom edge, from its hairlines.
    pub(crate) fn plot(marks: &[Mark]) -> [f32; 4] {
        let places = marks.iter().filter_map(|mark| match mark {
            Mark::Line { points, ink, .. } if points[0][1] == points[1][1] && ink.hue != Hue::Text => Some(points),
            _ => None,
        });
        let start = [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];
        let hairlines = places.filter(|points| points.len() == 2 && points[1][0] - points[0][0] > 100.0);
        hairlines.flatten().fold(start, |[left, top, right, bottom], [x, y]| {
            [left.min(*x), top.min(*y), right.max(*x), bottom.max(*y)]
        })
    }

    proptest! {
        #[test]
        fn text_becomes_smaller_and_then_shorter(text in "[a-z ]{0,60}", size in MIN_TEXT_SIZE..30.0f32, room in 60.0..900.0f32) {
            let (found, with) = fitted(&text, strong(size), room);
            prop_assert!(with.width(found.chars().count()) <= room + 0.5, "{found:?} at {with:?}");
            prop_assert!((MIN_TEXT_SIZE - 0.01..=size + 0.01).contains(&with.units()));
            if found != text {
                prop_assert!(found.ends_with('…') && with.units() < MIN_TEXT_SIZE + 0.01, "{found:?} at {with:?}");
                prop_assert!(text.starts_with(found.trim_end_matches('…')));
            }
        }
    }
}
