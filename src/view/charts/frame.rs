//! What every chart has: words above it, a legend, numbers at its sides, and a plot between them.

use super::axis::{Axis, Ruler};
use crate::language::Language;
use crate::view::draw::display_list::{Anchor, Hue, Ink, Mark, Point, TextSize};
use crate::view::draw::polyline::dashes;

/// The words above a plot.
pub(crate) struct ChartHeading<'a> {
    /// What the chart is about.
    pub(crate) title: &'a str,
    /// What is to be seen in it.
    pub(crate) note: &'a str,
    /// Names that are not written in the plot.
    pub(crate) legend: &'a [(&'a str, Hue)],
    /// How many lines there are below the plot.
    pub(crate) below: usize,
}

/// A chart in the making.
pub(crate) struct ChartFrame {
    /// What is drawn so far.
    pub(crate) marks: Vec<Mark>,
    size: Point,
    /// The plot's edges.
    pub(crate) left: f32,
    pub(crate) top: f32,
    pub(crate) right: f32,
    pub(crate) bottom: f32,
}

/// Round everything.
const MARGIN: f32 = 24.0;
/// Beside the plot at least, so that a number below its corner is not cut.
pub(crate) const BESIDE: f32 = 64.0;
/// Sizes of text: what a chart is about, what is to be seen in it, everything else, and the least that can be read
/// from the back of a room.
const TITLE: f32 = 28.0;
const NOTE: f32 = 18.0;
const USUAL: f32 = 16.0;
const LEAST: f32 = 15.0;
/// Between a text and what it belongs to.
pub(crate) const GAP: f32 = 10.0;
/// Pieces of a line that means something, and of one that leads to a name.
pub(crate) const DASHES: [f32; 2] = [10.0, 6.0];
pub(crate) const DOTTED: [f32; 2] = [2.0, 4.0];
/// How high a line of the usual size is.
pub(crate) const LINE: f32 = 20.0;
/// From the plot to the first line below it.
const BELOW: f32 = 20.0;
/// From there to the next one.
const NEXT: f32 = 22.0;

impl ChartFrame {
    /// Charts are laid out for this size at least.
    pub(crate) const LEAST: Point = [480.0, 272.0];

    /// The words, the plot with room for `aside` to its right, and what is measured upwards.
    pub(crate) fn new(
        size: Point,
        words: &ChartHeading<'_>,
        axis: &Axis,
        values: impl Iterator<Item = f64>,
        aside: f32,
        language: Language,
    ) -> (Self, Ruler) {
        let size = [size[0].max(Self::LEAST[0]), size[1].max(Self::LEAST[1])];
        let bottom = size[1] - MARGIN - GAP - words.below as f32 * NEXT;
        let right = size[0] - (MARGIN + aside).max(BESIDE);
        let mut sheet = Self { marks: Vec::new(), size, left: MARGIN, top: MARGIN, right, bottom };
        let width = size[0] - 2.0 * MARGIN;
        sheet.heading(words.title, strong(TITLE), Hue::Text, width);
        sheet.heading(words.note, plain(NOTE), Hue::Quiet, width);
        sheet.legend(words.legend, width);
        sheet.top += GAP;
        sheet.heading(&axis.label, plain(USUAL), Hue::Quiet, width);
        sheet.top += GAP;
        let ruler = Ruler::new(axis, values, sheet.bottom - sheet.top, |_| LINE, language);
        let widest = ruler.ticks.iter().map(|tick| width_of(&tick.text)).fold(0.0, f32::max);
        sheet.left = (MARGIN + widest + GAP).max(BESIDE);
        sheet.rows(&ruler);
        (sheet, ruler)
    }

    /// What is measured to the right: numbers below the plot.
    pub(crate) fn columns(&mut self, axis: &Axis, values: impl Iterator<Item = f64>, language: Language) -> Ruler {
        let ruler = Ruler::new(axis, values, self.right - self.left, |text| width_of(text) + 2.0 * GAP, language);
        for tick in &ruler.ticks {
            let [x, bottom] = self.at([ruler.place(tick.value).unwrap_or(0.0), 0.0]);
            self.line(vec![[x, bottom], [x, bottom + 6.0]], 1.0, Hue::Hairline.full());
            self.below(0, &tick.text, x, f32::INFINITY);
        }
        let middle = (self.left + self.right) / 2.0;
        let (at, room) = ([middle, self.bottom + BELOW + NEXT], 2.0 * middle.min(self.size[0] - middle) - 2.0 * MARGIN);
        self.label(at, Anchor::Centre, &axis.label, Hue::Quiet, room);
        ruler
    }

    /// A name or a number in some line below the plot.
    pub(crate) fn below(&mut self, line: usize, text: &str, x: f32, room: f32) {
        self.label([x, self.bottom + BELOW + line as f32 * NEXT], Anchor::Centre, text, Hue::Text, room);
    }

    /// A text of the usual size.
    fn label(&mut self, at: Point, anchor: Anchor, text: &str, hue: Hue, room: f32) {
        let (text, size) = fitted(text, plain(USUAL), room);
        self.text(at, anchor, text, size, hue.full());
    }

    /// A name in its own colour.
    pub(crate) fn name(&mut self, at: Point, text: &str, hue: Hue, room: f32) {
        let (text, size) = fitted(text, strong(USUAL), room);
        self.text(at, Anchor::Left, text, size, hue.full());
    }

    /// A line that order or measurements draw.
    pub(crate) fn line(&mut self, points: Vec<Point>, width: f32, ink: Ink) {
        if points.len() > 1 {
            self.marks.push(Mark::Line { points, width, ink });
        }
    }

    /// The same in pieces, so long and so far apart.
    pub(crate) fn dashed(&mut self, points: &[Point], [dash, gap]: [f32; 2], width: f32, ink: Ink) {
        for piece in dashes(points, dash, gap) {
            self.line(piece, width, ink);
        }
    }

    /// A place in the plot, whose corners are 0, 0 and 1, 1.
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> Point {
        [self.left + x as f32 * (self.right - self.left), self.bottom - y as f32 * (self.bottom - self.top)]
    }

    /// How much room there is from a place to the right edge.
    pub(crate) fn room_from(&self, x: f32) -> f32 {
        self.size[0] - MARGIN / 2.0 - x
    }

    fn text(&mut self, at: Point, anchor: Anchor, text: String, size: TextSize, ink: Ink) {
        if !text.is_empty() {
            self.marks.push(Mark::Label { at, anchor, text, size, ink });
        }
    }

    /// A line of words above the plot.
    fn heading(&mut self, text: &str, size: TextSize, hue: Hue, room: f32) {
        if !text.is_empty() {
            let height = 1.3 * size.units();
            let (text, size) = fitted(text, size, room);
            self.text([MARGIN, self.top + height / 2.0], Anchor::Left, text, size, hue.full());
            self.top += height;
        }
    }

    /// Names with their colours, in as many rows as they need.
    fn legend(&mut self, names: &[(&str, Hue)], room: f32) {
        const KEY: f32 = 14.0;
        const ROW: f32 = 26.0;
        if names.is_empty() {
            return;
        }
        self.top += GAP / 2.0;
        let mut x = MARGIN;
        for &(name, hue) in names {
            let width = strong(USUAL).width(name.chars().count()).min(room - KEY - GAP);
            if x > MARGIN && x + KEY + GAP + width > MARGIN + room {
                (x, self.top) = (MARGIN, self.top + ROW);
            }
            let y = self.top + ROW / 2.0;
            let (centre, half) = ([x + KEY / 2.0, y], [KEY / 2.0; 2]);
            self.marks.push(Mark::Box { centre, half, round: 2.0, ink: hue.full() });
            let (text, size) = fitted(name, strong(USUAL), width + 0.1);
            self.text([x + KEY + GAP, y], Anchor::Left, text, size, Hue::Text.full());
            x += KEY + GAP + width + 2.0 * GAP;
        }
        self.top += ROW;
    }

    /// Hairlines across the plot with their numbers, stronger where 0 is.
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

/// What a text of the usual size takes.
pub(crate) fn width_of(text: &str) -> f32 {
    plain(USUAL).width(text.chars().count())
}

/// What a name takes.
pub(crate) fn width_of_name(text: &str) -> f32 {
    strong(USUAL).width(text.chars().count())
}

fn plain(units: f32) -> TextSize {
    TextSize::Small(units / TextSize::SMALL)
}

fn strong(units: f32) -> TextSize {
    TextSize::Body(units / TextSize::BODY)
}

/// A text for so much room: smaller if it has to be, and cut if that is not enough.
fn fitted(text: &str, size: TextSize, room: f32) -> (String, TextSize) {
    let letters = text.chars().count();
    let least = LEAST / size.units();
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

    /// The words on a sheet as boxes: left, top, right, bottom.
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

    /// All words are inside and apart, and can be read.
    pub(crate) fn check_words(marks: &[Mark], [width, height]: Point) -> Result<(), TestCaseError> {
        let words = words(marks);
        for (i, (one, text)) in words.iter().enumerate() {
            let inside = one[0] >= 0.0 && one[1] >= 0.0 && one[2] <= width && one[3] <= height;
            prop_assert!(inside && one[3] - one[1] >= LEAST - 0.01, "{text:?} at {one:?} of {width} × {height}");
            for (other, than) in &words[..i] {
                let apart = one[0] >= other[2] || other[0] >= one[2] || one[1] >= other[3] || other[1] >= one[3];
                prop_assert!(apart, "{text:?} at {one:?} touches {than:?} at {other:?}");
            }
        }
        Ok(())
    }

    /// The plot's left, top, right and bottom edge, as its hairlines tell them.
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
        fn a_text_becomes_smaller_and_then_shorter(text in "[a-z ]{0,60}", size in LEAST..30.0f32, room in 60.0..900.0f32) {
            let (found, with) = fitted(&text, strong(size), room);
            prop_assert!(with.width(found.chars().count()) <= room + 0.5, "{found:?} at {with:?}");
            prop_assert!((LEAST - 0.01..=size + 0.01).contains(&with.units()));
            if found != text {
                prop_assert!(found.ends_with('…') && with.units() < LEAST + 0.01, "{found:?} at {with:?}");
                prop_assert!(text.starts_with(found.trim_end_matches('…')));
            }
        }
    }
}
