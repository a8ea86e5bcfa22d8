//! Grouped bar charts: a few things measured in several cases.

use std::iter;

use super::axis::Axis;
use super::frame::{ChartFrame, ChartHeading, DASHES, GAP, MIN_SIDE_WIDTH, width_of};
use super::line_chart::series_hue;
use crate::language::Language;
use crate::view::draw::display_list::{Hue, Mark, Point};

/// A grouped bar chart. Bars begin at 0, or at the plot's lower edge on a logarithmic axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BarChart {
    /// Title of the chart.
    pub title: String,
    /// A line below the title; may be empty.
    pub note: String,
    /// Axis of the measured quantity.
    pub y: Axis,
    /// Cases, and the bars of each.
    pub groups: Vec<(String, Vec<Bar>)>,
    /// Value of a dashed line across the plot.
    pub reference: Option<f64>,
}

/// One bar.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Name in the legend: bars of one name have one colour.
    pub name: String,
    /// The measured value.
    pub value: f64,
    /// Value of somebody else, drawn as a mark across the bar.
    pub other: Option<f64>,
}

/// Part of a group's width that is left empty.
const GROUP_GAP: f32 = 0.22;
/// Part of a bar's width that is left empty.
const BAR_GAP: f32 = 0.1;
/// Least height of a bar, so that a bar of 0 can be seen.
const MIN_BAR_HEIGHT: f32 = 2.0;
/// Distance from the plot's edge of the cut in a bar that leaves the plot.
const CUT_DISTANCE: f32 = 12.0;
/// Thickness of the mark for somebody else's value.
const MARK_WIDTH: f32 = 3.0;

impl BarChart {
    /// Draws the chart with its corner at 0, 0; it needs 480 × 360 at least.
    pub fn marks(&self, size: Point, language: Language) -> Vec<Mark> {
        let names = self.names();
        let legend: Vec<_> = names.iter().enumerate().map(|(i, &name)| (name, series_hue(i))).collect();
        let rough = (size[0] - 2.0 * MIN_SIDE_WIDTH) / self.groups.len().max(1) as f32 - GAP;
        let lines_below = if self.groups.iter().any(|(group, _)| width_of(group) > rough) { 2 } else { 1 };
        let heading = ChartHeading { title: &self.title, note: &self.note, legend: &legend, lines_below };
        let bars =
            || self.groups.iter().flat_map(|(_, bars)| bars).flat_map(|bar| iter::once(bar.value).chain(bar.other));
        let (mut frame, ruler) = ChartFrame::new(size, &heading, &self.y, bars().chain(self.reference), 0.0, language);
        let zero = ruler.place(0.0).unwrap_or(0.0).clamp(0.0, 1.0);
        let group_width = (frame.right - frame.left) / self.groups.len().max(1) as f32;
        let slot = group_width * (1.0 - GROUP_GAP) / names.len().max(1) as f32;
        for (i, (group, bars)) in self.groups.iter().enumerate() {
            let middle = frame.left + (i as f32 + 0.5) * group_width;
            let room = group_width - GAP;
            let (first, second) =
                if lines_below > 1 && width_of(group) > room { halves(group) } else { (&**group, "") };
            frame.below(0, first, middle, room);
            frame.below(1, second, middle, room);
            for Bar { name, value, other } in bars {
                let nth = names.iter().position(|known| known == name);
                let (Some(place), Some(nth)) = (ruler.place(*value), nth) else { continue };
                let x = middle + (nth as f32 + 0.5 - names.len() as f32 / 2.0) * slot;
                draw_bar(&mut frame, [x, slot * (1.0 - BAR_GAP) / 2.0], (zero, place), series_hue(nth));
                let inside = |place: &f64| (0.0..=1.0).contains(place);
                if let Some(place) = other.and_then(|other| ruler.place(other)).filter(inside) {
                    let y = frame.at([0.0, place])[1];
                    frame.line(vec![[x - slot / 2.0, y], [x + slot / 2.0, y]], MARK_WIDTH, Hue::Text.full());
                }
            }
        }
        if let Some(place) = self.reference.and_then(|value| ruler.place(value)).filter(|v| (0.0..=1.0).contains(v)) {
            let (from, to) = (frame.at([0.0, place]), frame.at([1.0, place]));
            frame.dashed(&[from, to], DASHES, 2.0, Hue::Text.full());
        }
        frame.marks
    }

    /// Names of the bars, in the order of their first appearance.
    fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for Bar { name, .. } in self.groups.iter().flat_map(|(_, bars)| bars) {
            if !names.contains(&&**name) {
                names.push(name);
            }
        }
        names
    }
}

/// Breaks a name into two lines, so that the longer one is as short as possible.
fn halves(name: &str) -> (&str, &str) {
    let longer = |&(one, other): &(&str, &str)| one.chars().count().max(other.chars().count());
    let cuts = name.match_indices(' ').map(|(at, _)| (name[..at].trim(), name[at..].trim()));
    cuts.min_by_key(longer).unwrap_or((name, ""))
}

/// Draws a bar between two heights. A bar that leaves the plot has a cut there.
fn draw_bar(frame: &mut ChartFrame, [x, half]: [f32; 2], (from, to): (f64, f64), hue: Hue) {
    let [start, end] = [from, to.clamp(0.0, 1.0)].map(|height| frame.at([0.0, height])[1]);
    let (top, bottom) = (start.min(end), start.max(end));
    let tall = (bottom - top).max(MIN_BAR_HEIGHT);
    // Down from the top, but never below the plot.
    let middle = (top + tall / 2.0).min(frame.bottom - tall / 2.0);
    frame.marks.push(Mark::Box { centre: [x, middle], half: [half, tall / 2.0], round: 1.0, ink: hue.full() });
    if !(0.0..=1.0).contains(&to) && tall > 2.0 * CUT_DISTANCE {
        let cut = if to > 1.0 { top + CUT_DISTANCE } else { bottom - CUT_DISTANCE };
        let points = vec![[x - half - 1.0, cut + 3.0], [x + half + 1.0, cut - 3.0]];
        frame.line(points, 4.0, Hue::Ground.full());
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::axis::Scale;
    use super::super::frame::tests::{check_words, plot};
    use super::super::line_chart::CHART_SIZE;
    use super::*;

    /// Returns each bar's left, top, right and bottom edge.
    fn boxes(marks: &[Mark]) -> Vec<[f32; 4]> {
        let edges = |mark: &Mark| match mark {
            Mark::Box { centre: [x, y], half: [w, h], .. } => Some([x - w, y - h, x + w, y + h]),
            _ => None,
        };
        let [left, top, right, _] = plot(marks);
        let inside = |edges: &[f32; 4]| edges[0] >= left && edges[2] <= right && edges[1] > top - 1.0;
        marks.iter().filter_map(edges).filter(inside).collect()
    }

    fn bars(scale: Scale, groups: &[&[f64]]) -> BarChart {
        let named = |(i, values): (usize, &&[f64])| {
            let bar = |(j, &value)| Bar { name: format!("machine {j}"), value, other: None };
            let bars = values.iter().enumerate().map(bar).collect();
            (format!("the case with number {i}"), bars)
        };
        let groups = groups.iter().enumerate().map(named).collect();
        BarChart { groups, y: Axis { scale, ..Axis::default() }, ..BarChart::default() }
    }

    proptest! {
        #[test]
        fn bars_are_as_high_as_their_values_and_do_not_touch(
            groups in prop::collection::vec(prop::collection::vec(1.0..1000.0f64, 1..5), 1..7),
        ) {
        let language = Language::English;
            let groups: Vec<_> = groups.iter().map(|group| &group[..]).collect();
            let marks = bars(Scale::Linear, &groups).marks(CHART_SIZE, language);
            let [_, _, _, bottom] = plot(&marks);
            let (boxes, values) = (boxes(&marks), groups.concat());
            prop_assert_eq!(boxes.len(), values.len());
            let greatest = values.iter().copied().fold(0.0, f64::max);
            let tallest = boxes.iter().map(|edges| edges[3] - edges[1]).fold(0.0, f32::max);
            for (edges, value) in boxes.iter().zip(values) {
                prop_assert!((edges[3] - bottom).abs() < 0.01, "{edges:?}");
                let tall = (tallest * (value / greatest) as f32).max(MIN_BAR_HEIGHT);
                prop_assert!((edges[3] - edges[1] - tall).abs() < 0.01, "{edges:?} of {value}");
            }
            prop_assert!(boxes.windows(2).all(|two| two[0][2] < two[1][0]), "{boxes:?}");
        }

        #[test]
        fn texts_are_inside_and_do_not_touch(
            names in prop::collection::vec("[a-z ]{0,40}", 1..9), width in 480.0..1600.0f32, height in 360.0..1000.0f32,
            title in "[a-z ]{0,90}", scale in prop_oneof![Just(Scale::Linear), Just(Scale::Log10), Just(Scale::Log2)],
        ) {
        let language = Language::English;
            let values = [&[0.3, 7.0, f64::NAN, -1.0][..]; 8];
            let mut bars = bars(scale, &values[..names.len()]);
            bars.groups.iter_mut().zip(names).for_each(|(group, name)| group.0 = name);
            (bars.title, bars.reference) = (title, Some(1.0));
            check_words(&bars.marks([width, height], language), [width, height])?;
        }
    }

    #[test]
    fn negative_bar_hangs_down() {
        let language = Language::English;
        let marks = bars(Scale::Linear, &[&[10.0, -10.0]]).marks(CHART_SIZE, language);
        let [[_, top, _, zero], [_, same, _, bottom]] = boxes(&marks)[..] else { panic!("two bars") };
        assert_eq!(zero, same);
        assert!((zero - top - (bottom - same)).abs() < 0.01 && zero > top);
    }

    #[test]
    fn bar_that_leaves_the_plot_has_a_cut() {
        let language = Language::English;
        let mut bars = bars(Scale::Log10, &[&[5.0, 5000.0]]);
        bars.y.range = Some((1.0, 100.0));
        let marks = bars.marks(CHART_SIZE, language);
        let [_, top, _, bottom] = plot(&marks);
        let [_, tall] = boxes(&marks)[..] else { panic!("two bars") };
        assert_eq!((tall[1], tall[3]), (top, bottom));
        let cut = |mark: &&Mark| matches!(mark, Mark::Line { ink, .. } if ink.hue == Hue::Ground);
        assert_eq!(marks.iter().filter(cut).count(), 1);
    }

    #[test]
    fn reference_line_is_at_its_value() {
        let language = Language::English;
        let mut bars = bars(Scale::Linear, &[&[2.0]]);
        bars.reference = Some(1.0);
        let marks = bars.marks(CHART_SIZE, language);
        let [left, top, _, bottom] = plot(&marks);
        let first = marks.iter().find_map(|mark| match mark {
            Mark::Line { points, ink, .. } if ink.hue == Hue::Text => Some(points[0]),
            _ => None,
        });
        assert_eq!(first, Some([left, (top + bottom) / 2.0]));
    }

    #[test]
    fn mark_of_another_value_is_as_high_as_its_bar() {
        let language = Language::English;
        let mut bars = bars(Scale::Linear, &[&[4.0, 3.0]]);
        bars.groups[0].1[0].other = Some(3.0);
        let marks = bars.marks(CHART_SIZE, language);
        let [left, _, right, _] = boxes(&marks)[0];
        let mark = marks.iter().find_map(|mark| match mark {
            Mark::Line { points, ink, .. } if ink.hue == Hue::Text => Some(points.clone()),
            _ => None,
        });
        let [from, to] = mark.unwrap()[..] else { panic!("a straight line") };
        assert!(from[0] <= left && right <= to[0] && to[0] <= boxes(&marks)[1][0]);
        assert!((from[1] - boxes(&marks)[1][1]).abs() < 0.01 && from[1] == to[1]);
    }

    #[test]
    fn long_name_has_two_lines() {
        assert_eq!(halves("one machine at 10 %"), ("one machine", "at 10 %"));
        assert_eq!(halves("unbreakable"), ("unbreakable", ""));
    }
}
