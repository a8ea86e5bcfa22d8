//! Line charts: measurements over a quantity that was varied.

use super::axis::{Axis, Ruler};
use super::frame::{ChartFrame, ChartHeading, DASHES, DOTTED, LINE_HEIGHT, width_of_name};
use crate::language::Language;
use crate::palette::CHART_NODES;
use crate::view::draw::display_list::{Hue, Mark, Point};
use crate::view::draw::polyline::{clipped, is_inside, spread};

/// Size of a chart on a slide.
pub const CHART_SIZE: Point = [960.0, 540.0];

/// Least height of a chart without a title.
pub const MIN_CHART_HEIGHT: f32 = ChartFrame::MIN_SIZE[1];

/// A line chart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LineChart {
    /// Title of the chart.
    pub title: String,
    /// A line below the title; may be empty.
    pub note: String,
    /// Axis of the varied quantity.
    pub x: Axis,
    /// Axis of the measured quantity.
    pub y: Axis,
    /// The measurements.
    pub series: Vec<Series>,
}

/// A series of points.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// Colour, from [`series_hue`] where no machines are beside the chart.
    pub hue: Hue,
    /// Varied and measured values. A point that an axis cannot show is left out, and the line is broken there.
    pub points: Vec<(f64, f64)>,
    /// Style.
    pub style: Style,
}

/// Style of a series.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// A line with a dot at every point: measurements.
    #[default]
    Line,
    /// Dots without a line.
    Dots,
    /// Hollow dots without a line: somebody else's measurements beside ours.
    Hollow,
    /// A dashed line: a theory, a bound, somebody else's figures, or a second curve of one colour.
    Dashed,
}

/// Returns the colour of the `i`-th series of a chart: that of a node in a ring of
/// [`crate::palette::DISTINCT_COLOURS`]. From the ninth on colours repeat.
pub fn series_hue(i: usize) -> Hue {
    Hue::Node(CHART_NODES[i % CHART_NODES.len()])
}

/// Most series whose names are written at the ends of their lines; more of them have a legend.
const MAX_NAMED_SERIES: usize = 8;
/// Greatest part of the width that names at the ends of lines take.
const MAX_NAMES_WIDTH: f32 = 0.34;
/// Width of lines of measurements.
const LINE_WIDTH: f32 = 3.0;
/// Width of dashed lines.
const DASHED_WIDTH: f32 = 2.5;
/// Radius of dots.
const DOT_RADIUS: f32 = 5.0;
/// Space between the plot and the names.
const NAME_DISTANCE: f32 = 16.0;
/// Thickness of the line of a hollow dot.
const HOLLOW_WIDTH: f32 = 2.0;

impl LineChart {
    /// Draws the chart with its corner at 0, 0. It needs 480 × 360 at least, or a height of [`MIN_CHART_HEIGHT`]
    /// without a title.
    pub fn marks(&self, size: Point, language: Language) -> Vec<Mark> {
        let are_named = self.series.len() <= MAX_NAMED_SERIES;
        let legend: Vec<_> = self.series.iter().map(|series| (&*series.name, series.hue)).collect();
        let names = self.series.iter().map(|series| width_of_name(&series.name)).fold(0.0, f32::max);
        let aside = if are_named && names > 0.0 { NAME_DISTANCE + names.min(MAX_NAMES_WIDTH * size[0]) } else { 0.0 };
        let legend = if are_named { &[] } else { &legend[..] };
        let lines_below = if self.x.label.is_empty() { 1 } else { 2 };
        let heading = ChartHeading { title: &self.title, note: &self.note, legend, lines_below };
        let points = || self.series.iter().flat_map(|series| series.points.iter().copied());
        let (from, to) = self.x.range.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let heights = points().filter(|(x, _)| (from..=to).contains(x)).map(|(_, y)| y);
        let (mut frame, y) = ChartFrame::new(size, &heading, &self.y, heights, aside, language);
        let x = frame.columns(&self.x, points().map(|(x, _)| x), language);
        let ends: Vec<_> = self.series.iter().map(|series| series.draw(&mut frame, &x, &y)).collect();
        if are_named {
            self.draw_names(&mut frame, &ends);
        }
        frame.marks
    }

    /// Writes each name beside the end of its line, or joins both with a dotted line.
    fn draw_names(&self, frame: &mut ChartFrame, ends: &[Option<Point>]) {
        let all = self.series.iter().zip(ends).filter(|(series, _)| !series.name.is_empty());
        let named: Vec<_> = all.filter_map(|(series, end)| Some((series, (*end)?))).collect();
        let heights: Vec<f32> = named.iter().map(|(_, end)| end[1]).collect();
        let places = spread(&heights, LINE_HEIGHT, frame.top, frame.bottom);
        let x = frame.right + NAME_DISTANCE;
        for ((series, end), y) in named.into_iter().zip(places) {
            if (x - NAME_DISTANCE - end[0]).hypot(y - end[1]) > LINE_HEIGHT / 2.0 {
                let bend = [x - NAME_DISTANCE / 2.0, end[1]];
                frame.dashed(&[[end[0] + DOT_RADIUS, end[1]], bend, [x - 3.0, y]], DOTTED, 1.5, series.hue.full());
            }
            frame.name([x, y], &series.name, series.hue, frame.room_from(x));
        }
    }
}

impl Series {
    /// Draws the series and returns its last visible point.
    fn draw(&self, frame: &mut ChartFrame, x: &Ruler, y: &Ruler) -> Option<Point> {
        let place = |&(u, v): &(f64, f64)| Some([x.place(u)?, y.place(v)?]);
        let places: Vec<_> = self.points.iter().map(place).collect();
        let lines: Vec<Vec<Point>> =
            clipped(&places).iter().map(|line| line.iter().map(|&place| frame.at(place)).collect()).collect();
        let inside = places.iter().flatten().filter(|&&place| is_inside(place));
        let dots: Vec<Point> = inside.map(|&place| frame.at(place)).collect();
        let end = match self.style {
            Style::Line | Style::Dashed => lines.last().and_then(|line| line.last()),
            Style::Dots | Style::Hollow => dots.last(),
        };
        let (end, ink) = (end.copied(), self.hue.full());
        let disc = |centre, radius, ink| Mark::Disc { centre, radius, ink };
        match self.style {
            Style::Line => lines.into_iter().for_each(|line| frame.line(line, LINE_WIDTH, ink)),
            Style::Dashed => lines.iter().for_each(|line| frame.dashed(line, DASHES, DASHED_WIDTH, ink)),
            Style::Dots | Style::Hollow => {}
        }
        if self.style != Style::Dashed {
            frame.marks.extend(dots.iter().map(|&centre| disc(centre, DOT_RADIUS, ink)));
        }
        if self.style == Style::Hollow {
            frame.marks.extend(dots.iter().map(|&centre| disc(centre, DOT_RADIUS - HOLLOW_WIDTH, Hue::Ground.full())));
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
        fn texts_are_inside_and_do_not_touch(chart in charts(0..9), width in 480.0..1600.0f32, height in 360.0..1000.0f32) {
        let language = Language::English;
            check_words(&chart.marks([width, height], language), [width, height])?;
        }

        #[test]
        fn chart_without_a_title_needs_less_height(chart in charts(0..6), width in 480.0..1600.0f32) {
        let language = Language::English;
            check_words(&LineChart { title: String::new(), ..chart }.marks([width, MIN_CHART_HEIGHT], language), [width, MIN_CHART_HEIGHT])?;
        }

        #[test]
        fn legend_is_inside(chart in charts(9..14)) {
        let language = Language::English;
            check_words(&chart.marks(CHART_SIZE, language), CHART_SIZE)?;
        }

        #[test]
        fn points_in_range_are_drawn_in_the_plot(mut chart in charts(1..9), x in even_axes(), y in even_axes()) {
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
                Mark::Line { points, width, .. } if *width == LINE_WIDTH => Some(points),
                _ => None,
            });
            for [x, y] in dots.iter().chain(lines.flatten()) {
                let inside = (left - 0.1..=right + 0.1).contains(x) && (top - 0.1..=bottom + 0.1).contains(y);
                prop_assert!(inside, "{x}, {y} is not in {:?}", [left, top, right, bottom]);
            }
        }
    }

    #[test]
    fn points_are_at_their_values() {
        let language = Language::English;
        let (x, y) = (Axis { scale: Scale::Log2, ..Axis::default() }, Axis::default());
        let points = vec![(1.0, 0.0), (32.0, 1.0), (1024.0, 2.0), (2.0, f64::NAN), (0.0, 1.0)];
        let series = vec![Series { name: "ring".into(), hue: series_hue(0), points, style: Style::Dots }];
        let marks = LineChart { x, y, series, ..LineChart::default() }.marks(CHART_SIZE, language);
        let [left, top, right, bottom] = plot(&marks);
        assert_eq!(dots(&marks), [[left, bottom], [(left + right) / 2.0, (top + bottom) / 2.0], [right, top]]);
    }
}
