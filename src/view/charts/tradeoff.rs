//! Speed against accuracy: what several qualities of one picture cost, and how far each is from the reference.

use super::axis::{Axis, Ruler, Scale};
use super::frame::{ChartFrame, ChartHeading, DASHES};
use crate::language::{Language, word};
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};

/// What is known of several qualities so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tradeoff {
    /// What the picture takes in seconds, and its error (a root of a mean square in linear light).
    pub points: Vec<(f64, f64)>,
    /// Places of those in `points` that are the best for their time, the fastest first.
    pub front: Vec<usize>,
    /// The error of the reference itself.
    pub floor: f64,
    /// The place in `points` of what is set now.
    pub present: Option<usize>,
    /// The place in `points` of what is chosen.
    pub chosen: Option<usize>,
    /// What of time is measured, and its unit.
    pub time: String,
}

/// A chart, and where its points are.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// What is to be drawn.
    pub marks: Vec<Mark>,
    /// The middle of each point, in the order of [`Tradeoff::points`].
    pub places: Vec<Point>,
}

/// Whatever is nearer to the reference stands here: a logarithm knows no 0.
const LEAST_ERROR: f64 = 1e-6;
/// Whatever is faster, in seconds.
const LEAST_TIME: f64 = 1e-6;

/// How large dots are: of any quality, of one on the front, and round what is set and what is chosen.
const DOT: f32 = 4.0;
const BEST: f32 = 5.0;
const RING: [f32; 2] = [8.0, 10.0];

impl Tradeoff {
    /// Time and error, both on logarithmic axes, as a display list whose corner is at 0, 0; it needs 480 × 360 at least.
    pub fn drawn(&self, size: Point, language: Language) -> Drawn {
        let axis = |label: &str| Axis { label: label.into(), scale: Scale::Log10, range: None };
        let shown: Vec<(f64, f64)> =
            self.points.iter().map(|(time, error)| (time.max(LEAST_TIME), error.max(LEAST_ERROR))).collect();
        let legend = [
            (word!(language, "a quality", "uma qualidade"), Hue::Quiet),
            (word!(language, "the best for its time", "a melhor em seu tempo"), Hue::Text),
            (word!(language, "chosen", "escolhida"), Hue::Accent),
        ];
        let words = ChartHeading { title: "", note: "", legend: &legend, below: 2 };
        let floor = Some(self.floor).filter(|floor| *floor > LEAST_ERROR && !shown.is_empty());
        // Above the highest point there is room for its name.
        let above_all = shown.iter().map(|(_, error)| *error).reduce(f64::max).map(|error| 1.5 * error);
        let heights = shown.iter().map(|(_, error)| *error).chain(floor).chain(above_all);
        let error =
            axis(word!(language, "error of the picture (RMSE, linear light)", "erro da imagem (RMSE, luz linear)"));
        let (mut sheet, y) = ChartFrame::new(size, &words, &error, heights, 0.0, language);
        let x = sheet.columns(&axis(&self.time), shown.iter().map(|(time, _)| *time), language);
        if let Some(height) = floor.and_then(|floor| y.place(floor)) {
            let ends = [sheet.at([0.0, height]), sheet.at([1.0, height])];
            sheet.dashed(&ends, DASHES, 2.0, Hue::Quiet.faint(0.7));
            sheet.marks.push(above(ends[0], language));
        }
        let places: Vec<Point> = shown.iter().map(|&point| place(&sheet, &x, &y, point)).collect();
        let at = |&i: &usize| places.get(i).copied();
        sheet.line(self.front.iter().filter_map(at).collect(), 2.0, Hue::Text.faint(0.6));
        let disc = |centre, radius, hue: Hue| Mark::Disc { centre, radius, ink: hue.full() };
        sheet.marks.extend(places.iter().map(|&centre| disc(centre, DOT, Hue::Quiet)));
        sheet.marks.extend(self.front.iter().filter_map(at).map(|centre| disc(centre, BEST, Hue::Text)));
        if let Some(centre) = self.chosen.as_ref().and_then(at) {
            sheet.marks.push(disc(centre, RING[1], Hue::Accent));
        }
        if let Some(centre) = self.present.as_ref().and_then(at) {
            let rings = [(RING[0], Hue::Text), (RING[0] - 2.0, Hue::Ground), (DOT, Hue::Text)];
            sheet.marks.extend(rings.map(|(radius, hue)| disc(centre, radius, hue)));
            sheet.marks.push(beside(centre, &sheet, language));
        }
        Drawn { marks: sheet.marks, places }
    }
}

fn place(sheet: &ChartFrame, x: &Ruler, y: &Ruler, (time, error): (f64, f64)) -> Point {
    sheet.at([x.place(time).unwrap_or(0.0), y.place(error).unwrap_or(0.0)])
}

/// What the line of the floor is called.
fn above([x, y]: Point, language: Language) -> Mark {
    let text = word!(language, "the reference's own error", "o erro da própria referência").into();
    let (anchor, size) = (Anchor::Left, TextSize::Small(1.0));
    Mark::Label { at: [x + 8.0, y - 10.0], anchor, text, size, ink: Hue::Quiet.full() }
}

/// What the point of the present settings is called, on the side where there is room.
fn beside([x, y]: Point, sheet: &ChartFrame, language: Language) -> Mark {
    let (anchor, side) = if sheet.room_from(x) > 110.0 { (Anchor::Left, 1.0) } else { (Anchor::Right, -1.0) };
    let at = [x + side * (RING[1] + 6.0), y - 1.6 * RING[1]];
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
        fn every_point_is_in_the_chart_and_stands_as_its_numbers_do(points in clouds(), floor in 0.0..0.01f64) {
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
        fn what_is_chosen_and_what_is_set_are_where_their_points_are(points in clouds(), at: prop::sample::Index) {
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
    fn places_that_are_no_points_are_left_out() {
        let language = Language::English;
        let tradeoff = Tradeoff { front: vec![0, 9], present: Some(3), chosen: Some(4), ..Tradeoff::default() };
        let drawn = Tradeoff { points: vec![(1.0, 0.1)], ..tradeoff }.drawn(SIZE, language);
        assert_eq!(discs(&drawn.marks, Hue::Text), drawn.places);
        assert!(discs(&drawn.marks, Hue::Accent).is_empty());
    }
}
