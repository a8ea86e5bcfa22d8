//! Charts of measurements: what is known of them, and a display list.

use super::axis::{Axis, Ruler};
use super::frame::{ChartFrame, ChartHeading, DASHES, DOTTED, LINE, width_of_name};
use crate::language::Language;
use crate::palette::CHART_NODES;
use crate::view::draw::display_list::{Hue, Mark, Point};
use crate::view::draw::polyline::{clipped, is_inside, spread};

/// The size of a chart on a slide.
pub const CHART_SIZE: Point = [960.0, 540.0];

/// The least height of a chart without a title.
pub const LEAST_HIGH: f32 = ChartFrame::LEAST[1];

/// Measurements over something that was varied.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LineChart {
    /// What it is about.
    pub title: String,
    /// What is to be seen in it, in one line; may be empty.
    pub note: String,
    /// What was varied.
    pub x: Axis,
    /// What was measured.
    pub y: Axis,
    /// The measurements.
    pub series: Vec<Series>,
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What they are of.
    pub name: String,
    /// Their colour: see [`series_hue`].
    pub hue: Hue,
    /// What was varied, and what came of it. A point that an axis cannot show is left out, and the line is broken there.
    pub points: Vec<(f64, f64)>,
    /// How they are drawn.
    pub style: Style,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// A line with a dot at every point: measurements.
    #[default]
    Line,
    /// Dots that nothing connects.
    Dots,
    /// The same, hollow: somebody else's measurements beside ours.
    Hollow,
    /// A dashed line: what theory says, a bound, somebody else's figures.
    Dashed,
}

/// The colour of the `i`-th series of a chart; from the ninth on they repeat. It is that of a node in a ring of
/// [`crate::palette::DISTINCT_COLOURS`].
pub fn series_hue(i: usize) -> Hue {
    Hue::Node(CHART_NODES[i % CHART_NODES.len()])
}

/// With more series than this, names stand in a legend and not where the lines end.
const NAMED: usize = 8;
/// The most of the width that names at the lines' ends take.
const NAMES: f32 = 0.34;
/// How broad lines are, and how large dots.
const BROAD: f32 = 3.0;
const THIN: f32 = 2.5;
const DOT: f32 = 5.0;
/// Between the plot and the names.
const ASIDE: f32 = 16.0;
/// How thick the line of a hollow dot is.
const HOLLOW: f32 = 2.0;

impl LineChart {
    /// The chart as a display list whose corner is at 0, 0; it needs 480 × 360 at least, without a title [`LEAST_HIGH`].
    pub fn marks(&self, size: Point, language: Language) -> Vec<Mark> {
        let are_named = self.series.len() <= NAMED;
        let legend: Vec<_> = self.series.iter().map(|series| (&*series.name, series.hue)).collect();
        let names = self.series.iter().map(|series| width_of_name(&series.name)).fold(0.0, f32::max);
        let aside = if are_named && names > 0.0 { ASIDE + names.min(NAMES * size[0]) } else { 0.0 };
        let legend = if are_named { &[] } else { &legend[..] };
        let below = if self.x.label.is_empty() { 1 } else { 2 };
        let words = ChartHeading { title: &self.title, note: &self.note, legend, below };
        let points = || self.series.iter().flat_map(|series| series.points.iter().copied());
        let (from, to) = self.x.range.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let heights = points().filter(|(x, _)| (from..=to).contains(x)).map(|(_, y)| y);
        let (mut sheet, y) = ChartFrame::new(size, &words, &self.y, heights, aside, language);
        let x = sheet.columns(&self.x, points().map(|(x, _)| x), language);
        let ends: Vec<_> = self.series.iter().map(|series| series.draw(&mut sheet, &x, &y)).collect();
        if are_named {
            self.put_names(&mut sheet, &ends);
        }
        sheet.marks
    }

    /// Each name beside the end of its line, or dots that lead from there to its name.
    fn put_names(&self, sheet: &mut ChartFrame, ends: &[Option<Point>]) {
        let all = self.series.iter().zip(ends).filter(|(series, _)| !series.name.is_empty());
        let named: Vec<_> = all.filter_map(|(series, end)| Some((series, (*end)?))).collect();
        let heights: Vec<f32> = named.iter().map(|(_, end)| end[1]).collect();
        let places = spread(&heights, LINE, sheet.top, sheet.bottom);
        let x = sheet.right + ASIDE;
        for ((series, end), y) in named.into_iter().zip(places) {
            if (x - ASIDE - end[0]).hypot(y - end[1]) > LINE / 2.0 {
                let bend = [x - ASIDE / 2.0, end[1]];
                sheet.dashed(&[[end[0] + DOT, end[1]], bend, [x - 3.0, y]], DOTTED, 1.5, series.hue.full());
            }
            sheet.name([x, y], &series.name, series.hue, sheet.room_from(x));
        }
    }
}

impl Series {
    /// Draws the series and gives its last point that is seen.
    fn draw(&self, sheet: &mut ChartFrame, x: &Ruler, y: &Ruler) -> Option<Point> {
        let place = |&(u, v): &(f64, f64)| Some([x.place(u)?, y.place(v)?]);
        let places: Vec<_> = self.points.iter().map(place).collect();
        let lines: Vec<Vec<Point>> =
            clipped(&places).iter().map(|line| line.iter().map(|&place| sheet.at(place)).collect()).collect();
        let inside = places.iter().flatten().filter(|&&place| is_inside(place));
        let dots: Vec<Point> = inside.map(|&place| sheet.at(place)).collect();
        let end = match self.style {
            Style::Line | Style::Dashed => lines.last().and_then(|line| line.last()),
            Style::Dots | Style::Hollow => dots.last(),
        };
        let (end, ink) = (end.copied(), self.hue.full());
        let disc = |centre, radius, ink| Mark::Disc { centre, radius, ink };
        match self.style {
            Style::Line => lines.into_iter().for_each(|line| sheet.line(line, BROAD, ink)),
            Style::Dashed => lines.iter().for_each(|line| sheet.dashed(line, DASHES, THIN, ink)),
            Style::Dots | Style::Hollow => {}
        }
        if self.style != Style::Dashed {
            sheet.marks.extend(dots.iter().map(|&centre| disc(centre, DOT, ink)));
        }
        if self.style == Style::Hollow {
            sheet.marks.extend(dots.iter().map(|&centre| disc(centre, DOT - HOLLOW, Hue::Ground.full())));
        }
        end
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::axis::Scale;
    use super::super::frame::tests::{check_words, plot};
    use super::*;

    fn axes() -> impl Strategy<Value = Axis> {
        let scales = prop_oneof![Just(Scale::Linear), Just(Scale::Log10), Just(Scale::Log2)];
        let ranges = prop::option::of((0.1..50.0f64, 1.0..900.0f64).prop_map(|(from, more)| (from, from + more)));
        ("[a-z ()]{0,60}", scales, ranges).prop_map(|(label, scale, range)| Axis { label, scale, range })
    }

    /// Axes that begin and end with a round number.
    fn even_axes() -> impl Strategy<Value = Axis> {
        let scales = prop_oneof![Just(Scale::Linear), Just(Scale::Log10), Just(Scale::Log2)];
        (scales, 1..6i32).prop_map(|(scale, k)| {
            let range = match scale {
                Scale::Linear => (0.0, 100.0 * f64::from(k)),
                Scale::Log10 => (1.0, 10f64.powi(k)),
                Scale::Log2 => (1.0, 4f64.powi(k)),
            };
            Axis { scale, range: Some(range), ..Axis::default() }
        })
    }

    fn dots(marks: &[Mark]) -> Vec<Point> {
        let place = |mark: &Mark| if let Mark::Disc { centre, .. } = mark { Some(*centre) } else { None };
        marks.iter().filter_map(place).collect()
    }

    fn charts(series: std::ops::Range<usize>) -> impl Strategy<Value = LineChart> {
        let number = || prop_oneof![9 => -10.0..1100.0f64, 1 => any::<f64>()];
        let styles = prop_oneof![Just(Style::Line), Just(Style::Dots), Just(Style::Hollow), Just(Style::Dashed)];
        let one = ("[a-z, ]{0,40}", prop::collection::vec((number(), number()), 0..12), styles);
        let all = prop::collection::vec(one, series);
        ("[A-Z ]{0,90}", "[a-z ]{0,120}", axes(), axes(), all).prop_map(|(title, note, x, y, all)| {
            let made = |(i, (name, points, style))| Series { name, hue: series_hue(i), points, style };
            LineChart { title, note, x, y, series: all.into_iter().enumerate().map(made).collect() }
        })
    }

    proptest! {
        #[test]
        fn words_are_inside_and_apart(chart in charts(0..9), width in 480.0..1600.0f32, height in 360.0..1000.0f32) {
        let language = Language::English;
            check_words(&chart.marks([width, height], language), [width, height])?;
        }

        #[test]
        fn without_a_title_less_is_enough(chart in charts(0..6), width in 480.0..1600.0f32) {
        let language = Language::English;
            check_words(&LineChart { title: String::new(), ..chart }.marks([width, LEAST_HIGH], language), [width, LEAST_HIGH])?;
        }

        #[test]
        fn a_legend_is_inside_too(chart in charts(9..14)) {
        let language = Language::English;
            check_words(&chart.marks(CHART_SIZE, language), CHART_SIZE)?;
        }

        #[test]
        fn all_that_is_in_range_is_drawn_in_the_plot(mut chart in charts(1..9), x in even_axes(), y in even_axes()) {
        let language = Language::English;
            let is_seen = |axis: &Axis, value| axis.range.is_some_and(|(from, to)| from <= value && value <= to);
            let points = chart.series.iter().flat_map(|series| &series.points);
            let seen = points.filter(|(u, v)| is_seen(&x, *u) && is_seen(&y, *v)).count();
            chart.series.iter_mut().for_each(|series| series.style = Style::Line);
            let marks = LineChart { x, y, ..chart }.marks(CHART_SIZE, language);
            let [left, top, right, bottom] = plot(&marks);
            let dots = dots(&marks);
            prop_assert_eq!(dots.len(), seen);
            let lines = marks.iter().filter_map(|mark| match mark {
                Mark::Line { points, width, .. } if *width == BROAD => Some(points),
                _ => None,
            });
            for [x, y] in dots.iter().chain(lines.flatten()) {
                let inside = (left - 0.1..=right + 0.1).contains(x) && (top - 0.1..=bottom + 0.1).contains(y);
                prop_assert!(inside, "{x}, {y} is not in {:?}", [left, top, right, bottom]);
            }
        }
    }

    #[test]
    fn points_are_where_their_numbers_say() {
        let language = Language::English;
        let (x, y) = (Axis { scale: Scale::Log2, ..Axis::default() }, Axis::default());
        let points = vec![(1.0, 0.0), (32.0, 1.0), (1024.0, 2.0), (2.0, f64::NAN), (0.0, 1.0)];
        let series = vec![Series { name: "ring".into(), hue: series_hue(0), points, style: Style::Dots }];
        let marks = LineChart { x, y, series, ..LineChart::default() }.marks(CHART_SIZE, language);
        let [left, top, right, bottom] = plot(&marks);
        assert_eq!(dots(&marks), [[left, bottom], [(left + right) / 2.0, (top + bottom) / 2.0], [right, top]]);
    }
}
