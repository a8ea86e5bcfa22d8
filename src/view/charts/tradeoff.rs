//! The chart of speed against accuracy: times of several qualities of one picture, and their errors.

use super::axis::{Axis, Ruler, Scale};
use super::frame::{ChartFrame, ChartHeading, DASHES};
use crate::language::{Language, word};
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};

/// Measured times and errors of several qualities.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tradeoff {
    /// Times of the picture in seconds, and its errors (RMSE in linear light).
    pub points: Vec<(f64, f64)>,
    /// Indices in `points` of the best for their time, the fastest first.
    pub front: Vec<usize>,
    /// Error of the reference itself.
    pub floor: f64,
    /// Index in `points` of the present settings.
    pub present: Option<usize>,
    /// Index in `points` of the chosen quality.
    pub chosen: Option<usize>,
    /// Name of the measured time, and its unit.
    pub time: String,
}

/// A drawn chart and the positions of its points.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeoffDrawing {
    /// Marks of the chart.
    pub marks: Vec<Mark>,
    /// Centre of each point, in the order of [`Tradeoff::points`].
    pub places: Vec<Point>,
}

/// Least error on the logarithmic axis; a smaller one is drawn here.
const MIN_ERROR: f64 = 1e-6;
/// Least time on the logarithmic axis, in seconds; a shorter one is drawn here.
const MIN_TIME_S: f64 = 1e-6;

/// Radius of the dot of a quality.
const DOT_RADIUS: f32 = 4.0;
/// Radius of the dot of a quality that is the best for its time.
const BEST_RADIUS: f32 = 5.0;
/// Radius of the ring round the present settings.
const PRESENT_RADIUS: f32 = 8.0;
/// Radius of the disc under the chosen quality.
const CHOSEN_RADIUS: f32 = 10.0;

impl Tradeoff {
    /// Draws the chart, with logarithmic axes and its corner at 0, 0; it needs 480 × 360 at least.
    pub fn drawn(&self, size: Point, language: Language) -> TradeoffDrawing {
        let axis = |label: &str| Axis { label: label.into(), scale: Scale::Log10, range: None };
        let shown: Vec<(f64, f64)> =
            self.points.iter().map(|(time, error)| (time.max(MIN_TIME_S), error.max(MIN_ERROR))).collect();
        let legend = [
            (word!(language, "a quality", "uma qualidade"), Hue::Quiet),
            (word!(language, "the best for its time", "a melhor em seu tempo"), Hue::Text),
            (word!(language, "chosen", "escolhida"), Hue::Accent),
        ];
        let heading = ChartHeading { title: "", note: "", legend: &legend, lines_below: 2 };
        let floor = Some(self.floor).filter(|floor| *floor > MIN_ERROR && !shown.is_empty());
        // Leaves space above the highest point for its name.
        let above_all = shown.iter().map(|(_, error)| *error).reduce(f64::max).map(|error| 1.5 * error);
        let heights = shown.iter().map(|(_, error)| *error).chain(floor).chain(above_all);
        let error =
            axis(word!(language, "error of the picture (RMSE, linear light)", "erro da imagem (RMSE, luz linear)"));
        let (mut frame, y) = ChartFrame::new(size, &heading, &error, heights, 0.0, language);
        let x = frame.columns(&axis(&self.time), shown.iter().map(|(time, _)| *time), language);
        if let Some(height) = floor.and_then(|floor| y.place(floor)) {
            let ends = [frame.at([0.0, height]), frame.at([1.0, height])];
            frame.dashed(&ends, DASHES, 2.0, Hue::Quiet.faint(0.7));
            frame.marks.push(above(ends[0], language));
        }
        let places: Vec<Point> = shown.iter().map(|&point| place(&frame, &x, &y, point)).collect();
        let at = |&i: &usize| places.get(i).copied();
        frame.line(self.front.iter().filter_map(at).collect(), 2.0, Hue::Text.faint(0.6));
        let disc = |centre, radius, hue: Hue| Mark::Disc { centre, radius, ink: hue.full() };
        frame.marks.extend(places.iter().map(|&centre| disc(centre, DOT_RADIUS, Hue::Quiet)));
        frame.marks.extend(self.front.iter().filter_map(at).map(|centre| disc(centre, BEST_RADIUS, Hue::Text)));
        if let Some(centre) = self.chosen.as_ref().and_then(at) {
            frame.marks.push(disc(centre, CHOSEN_RADIUS, Hue::Accent));
        }
        if let Some(centre) = self.present.as_ref().and_then(at) {
            let rings = [(PRESENT_RADIUS, Hue::Text), (PRESENT_RADIUS - 2.0, Hue::Ground), (DOT_RADIUS, Hue::Text)];
            frame.marks.extend(rings.map(|(radius, hue)| disc(centre, radius, hue)));
            frame.marks.push(beside(centre, &frame, language));
        }
        TradeoffDrawing { marks: frame.marks, places }
    }
}

fn place(frame: &ChartFrame, x: &Ruler, y: &Ruler, (time, error): (f64, f64)) -> Point {
    frame.at([x.place(time).unwrap_or(0.0), y.place(error).unwrap_or(0.0)])
}

/// Writes the name of the line of the reference's error.
fn above([x, y]: Point, language: Language) -> Mark {
    let text = word!(language, "the reference's own error", "o erro da própria referência").into();
    let (anchor, size) = (Anchor::Left, TextSize::Small(1.0));
    Mark::Label { at: [x + 8.0, y - 10.0], anchor, text, size, ink: Hue::Quiet.full() }
}

/// Writes the name of the present settings beside their point, on the side with enough space.
fn beside([x, y]: Point, frame: &ChartFrame, language: Language) -> Mark {
    let (anchor, side) = if frame.room_from(x) > 110.0 { (Anchor::Left, 1.0) } else { (Anchor::Right, -1.0) };
    let at = [x + side * (CHOSEN_RADIUS + 6.0), y - 1.6 * CHOSEN_RADIUS];
    let text = word!(language, "set now", "atual").into();
    Mark::Label { at, anchor, text, size: TextSize::Body(1.0), ink: Hue::Text.full() }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const SIZE: Point = [640.0, 420.0];

    fn discs(marks: &[Mark], wanted: Hue) -> Vec<Point> {
        let place = |mark: &Mark| match mark {
            Mark::Disc { centre, ink, .. } if ink.hue == wanted => Some(*centre),
            _ => None,
        };
        marks.iter().filter_map(place).collect()
    }

    fn clouds() -> impl Strategy<Value = Vec<(f64, f64)>> {
        let number = || prop_oneof![8 => (0.1..1.0f64, -6..3i32).prop_map(|(digits, power)| digits * 10f64.powi(power)), 1 => Just(0.0)];
        prop::collection::vec((number(), number()), 0..30)
    }

    proptest! {
        #[test]
        fn points_are_inside_and_ordered_as_their_values(points in clouds(), floor in 0.0..0.01f64) {
        let language = Language::English;
            let drawn = Tradeoff { points: points.clone(), floor, ..Tradeoff::default() }.drawn(SIZE, language);
            prop_assert_eq!(drawn.places.len(), points.len());
            prop_assert_eq!(&discs(&drawn.marks, Hue::Quiet), &drawn.places);
            for ([x, y], (time, error)) in drawn.places.iter().zip(&points) {
                prop_assert!((0.0..=SIZE[0]).contains(x) && (0.0..=SIZE[1]).contains(y), "{x}, {y}");
                for ([u, v], (other_time, other_error)) in drawn.places.iter().zip(&points) {
                    // Right is slower, up is worse.
                    prop_assert!(time > other_time || x <= u);
                    prop_assert!(error > other_error || y >= v);
                }
            }
        }

        #[test]
        fn chosen_and_present_points_are_marked(points in clouds(), at: prop::sample::Index) {
        let language = Language::English;
            prop_assume!(!points.is_empty());
            let chosen = at.index(points.len());
            let tradeoff = Tradeoff { points, chosen: Some(chosen), ..Tradeoff::default() };
            let drawn = tradeoff.drawn(SIZE, language);
            prop_assert_eq!(discs(&drawn.marks, Hue::Accent), vec![drawn.places[chosen]]);
            let drawn = Tradeoff { chosen: None, present: Some(chosen), ..tradeoff }.drawn(SIZE, language);
            prop_assert_eq!(discs(&drawn.marks, Hue::Ground), vec![drawn.places[chosen]]);
        }
    }

    #[test]
    fn indices_without_points_are_ignored() {
        let language = Language::English;
        let tradeoff = Tradeoff { front: vec![0, 9], present: Some(3), chosen: Some(4), ..Tradeoff::default() };
        let drawn = Tradeoff { points: vec![(1.0, 0.1)], ..tradeoff }.drawn(SIZE, language);
        assert_eq!(discs(&drawn.marks, Hue::Text), drawn.places);
        assert!(discs(&drawn.marks, Hue::Accent).is_empty());
    }
}
