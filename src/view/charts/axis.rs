//! Axes: which part of the numbers is seen, and which of them are written beside it.

use crate::language::Language;
use crate::view::text::format::{count, number_to_power};

/// How numbers become lengths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences are equal lengths.
    #[default]
    Linear,
    /// Equal ratios are equal lengths; powers of ten, and 1, 2, 5 where these are few.
    Log10,
    /// Equal ratios are equal lengths; powers of two.
    Log2,
}

/// What is measured along one side of a chart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// What is measured, and its unit.
    pub label: String,
    /// How numbers become lengths.
    pub scale: Scale,
    /// The least and the greatest number seen; otherwise what the numbers need, on a linear scale together with 0.
    pub range: Option<(f64, f64)>,
}

/// An axis laid out.
#[derive(Clone, Debug)]
pub(crate) struct Ruler {
    scale: Scale,
    from: f64,
    to: f64,
    /// What is written beside the axis, ascending.
    pub(crate) ticks: Vec<Tick>,
}

/// A number beside an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) text: String,
}

/// The most numbers that an axis has; on a base of two 1 to 1024.
const MOST: usize = 8;
const MOST_POWERS: usize = 11;
/// No measurement is greater, and none but 0 is nearer to 0.
const LIMIT: f64 = 1e30;
/// A range of a smaller part of its numbers is taken for none.
const LEAST: f64 = 1e-6;
/// So many steps, each greater than the one before, lead to two numbers on any axis.
const TRIES: i32 = 100;

impl Ruler {
    /// The finest numbers that stand apart on an axis so long; `extent` is what a text takes of it.
    pub(crate) fn new(
        axis: &Axis,
        values: impl Iterator<Item = f64>,
        length: f32,
        extent: impl Fn(&str) -> f32,
        language: Language,
    ) -> Self {
        let scale = axis.scale;
        let given = axis.range.filter(|&range| is_usable(scale, range));
        let (from, to) = given.unwrap_or_else(|| needed(scale, values));
        let at = |i: i32| Self::with(Steps::nth(scale, from, to, i), scale, (from, to), given.is_some(), language);
        let fits = |ruler: &Self| ruler.is_apart(length, &extent);
        (0..TRIES).map(at).find(fits).unwrap_or_else(|| at(TRIES))
    }

    /// Where on the axis a number is: 0 at its beginning, 1 at its end; what is beyond has its place beyond, and what
    /// no number of the scale is has none.
    pub(crate) fn place(&self, value: f64) -> Option<f64> {
        let (from, to) = (self.scale.unrolled(self.from), self.scale.unrolled(self.to));
        Some((self.scale.unrolled(value) - from) / (to - from)).filter(|place| place.is_finite())
    }

    /// The axis with these steps: a range that was given stays as it is if two of them are in it.
    fn with(steps: Steps, scale: Scale, (from, to): (f64, f64), given: bool, language: Language) -> Self {
        let outer = steps.round(from, to);
        let inner: Vec<f64> = outer.iter().copied().filter(|value| (from..=to).contains(value)).collect();
        let (values, from, to) = match &outer[..] {
            [first, .., last] if !given || inner.len() < 2 => (outer.clone(), *first, *last),
            _ => (inner, from, to),
        };
        let ticks = values.into_iter().map(|value| Tick { value, text: steps.text(value, language) }).collect();
        Self { scale, from, to, ticks }
    }

    fn is_apart(&self, length: f32, extent: &impl Fn(&str) -> f32) -> bool {
        let most = if self.scale == Scale::Log2 { MOST_POWERS } else { MOST };
        let place = |tick: &Tick| self.place(tick.value).unwrap_or(0.0) as f32 * length;
        self.ticks.len() <= most
            && self
                .ticks
                .windows(2)
                .all(|two| place(&two[1]) - place(&two[0]) >= (extent(&two[0].text) + extent(&two[1].text)) / 2.0)
    }
}

impl Scale {
    fn is_log(self) -> bool {
        self != Self::Linear
    }

    /// The number as a length, in any unit.
    fn unrolled(self, value: f64) -> f64 {
        if self.is_log() { value.log2() } else { value }
    }
}

fn is_usable(scale: Scale, (from, to): (f64, f64)) -> bool {
    let greatest = from.abs().max(to.abs());
    let seen = if scale.is_log() { from >= 1.0 / LIMIT } else { greatest >= 1.0 / LIMIT };
    seen && greatest <= LIMIT && to - from > LEAST * greatest
}

/// From the least to the greatest of what can be on the scale.
fn needed(scale: Scale, values: impl Iterator<Item = f64>) -> (f64, f64) {
    let least = if scale.is_log() { 1.0 / LIMIT } else { -LIMIT };
    let seen = values.filter(|value| (least..=LIMIT).contains(value));
    let start = if scale.is_log() { (LIMIT, 1.0 / LIMIT) } else { (0.0, 0.0) };
    let (from, to) = seen.fold(start, |(from, to), value| (value.min(from), value.max(to)));
    match scale {
        Scale::Linear if to - from < 1.0 / LIMIT => (0.0, 1.0),
        Scale::Log10 | Scale::Log2 if from > to => (1.0, 10.0),
        _ => (from, to),
    }
}

/// Round numbers.
#[derive(Clone, Copy, Debug)]
enum Steps {
    /// Multiples of `digit` times ten to `power`.
    Even { digit: i64, power: i32 },
    /// 1, 2 and 5 times every power of ten.
    Thirds,
    /// Every so many powers of ten.
    Tens(i64),
    /// Every so many powers of two.
    Twos(i64),
}

impl Steps {
    /// The `i`-th steps for a range, each wider than the one before.
    fn nth(scale: Scale, from: f64, to: f64, i: i32) -> Self {
        match scale {
            Scale::Linear => {
                let power = ((to - from) / MOST as f64).log10().floor() as i32 + i / 3;
                Self::Even { digit: [1, 2, 5][(i % 3) as usize], power }
            }
            Scale::Log10 if i == 0 => Self::Thirds,
            Scale::Log10 => Self::Tens(i.into()),
            Scale::Log2 => Self::Twos(i64::from(i) + 1),
        }
    }

    /// The round numbers from the last that is not above `from` to the first that is not below `to`, two at least.
    fn round(self, from: f64, to: f64) -> Vec<f64> {
        let index = |value: f64| match self {
            Self::Even { digit, power } => value / tenfold(digit, power),
            Self::Thirds => value.log10() * 3.0,
            Self::Tens(every) => value.log10() / every as f64,
            Self::Twos(every) => value.log2() / every as f64,
        };
        // Two more at each end than needed, since thirds are not even and logarithms are rounded.
        let (first, last) = (index(from).floor() as i64 - 2, index(to).ceil() as i64 + 2);
        let mut values: Vec<f64> = (first..=last).map(|i| self.value(i)).collect();
        let below = values.iter().filter(|value| **value <= from).count().saturating_sub(1);
        values.drain(..below.min(values.len() - 2));
        let within = values.iter().filter(|value| **value < to).count() + 1;
        values.truncate(within.max(2));
        values
    }

    fn value(self, i: i64) -> f64 {
        match self {
            Self::Even { digit, power } => tenfold(i * digit, power),
            Self::Thirds => tenfold([1, 2, 5][i.rem_euclid(3) as usize], i.div_euclid(3) as i32),
            Self::Tens(every) => tenfold(1, (i * every) as i32),
            Self::Twos(every) => 2f64.powi((i * every) as i32),
        }
    }

    /// The number in words: plain digits where they are few.
    fn text(self, value: f64, language: Language) -> String {
        let own = value.abs().log10().floor() as i32;
        let power = match self {
            _ if value == 0.0 => return "0".into(),
            Self::Twos(_) if value < 1.0 && value > 1e-9 => return format!("1/{}", count((1.0 / value) as u32)),
            Self::Even { power, .. } => power,
            Self::Thirds | Self::Tens(_) => own,
            Self::Twos(_) if (1.0..1e9).contains(&value) => 0,
            Self::Twos(_) => own - 1,
        };
        number_to_power(value, power, language)
    }
}

/// `digits` times ten to `power`, rounded once while both can be written exactly.
fn tenfold(digits: i64, power: i32) -> f64 {
    if power < 0 { digits as f64 / 10f64.powi(-power) } else { digits as f64 * 10f64.powi(power) }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn texts(scale: Scale, range: Option<(f64, f64)>, values: &[f64], language: Language) -> Vec<String> {
        let axis = Axis { range, scale, ..Axis::default() };
        let ruler =
            Ruler::new(&axis, values.iter().copied(), 600.0, |text| 10.0 * text.chars().count() as f32, language);
        ruler.ticks.into_iter().map(|tick| tick.text.replace('\u{a0}', " ")).collect()
    }

    #[test]
    fn numbers_are_those_that_people_would_write() {
        let language = Language::English;
        assert_eq!(texts(Scale::Linear, None, &[0.2, 0.97], language), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
        assert_eq!(texts(Scale::Linear, Some((0.0, 1.0)), &[], language), ["0", "0.2", "0.4", "0.6", "0.8", "1"]);
        assert_eq!(texts(Scale::Linear, None, &[-20.0, 35.0], language), ["−20", "−10", "0", "10", "20", "30", "40"]);
        assert_eq!(
            texts(Scale::Linear, None, &[5321.0], language),
            ["0", "1 000", "2 000", "3 000", "4 000", "5 000", "6 000"]
        );
        let nodes = ["1", "2", "4", "8", "16", "32", "64", "128", "256", "512", "1 024"];
        assert_eq!(texts(Scale::Log2, None, &[1.0, 1024.0], language), nodes);
        assert_eq!(texts(Scale::Log2, None, &[0.2, 1.5], language), ["1/8", "1/4", "1/2", "1", "2"]);
        assert_eq!(texts(Scale::Log10, None, &[0.3, 8.0], language), ["0.2", "0.5", "1", "2", "5", "10"]);
        assert_eq!(texts(Scale::Log10, None, &[0.01, 900.0], language), ["0.01", "0.1", "1", "10", "100", "1 000"]);
        assert_eq!(texts(Scale::Log10, Some((2.1, 4.9)), &[], language), ["2", "5"]);
    }

    #[test]
    fn an_axis_of_nothing_has_numbers_too() {
        let language = Language::English;
        assert_eq!(texts(Scale::Linear, None, &[f64::NAN, f64::INFINITY], language)[..2], ["0", "0.2"]);
        assert_eq!(texts(Scale::Log2, Some((-1.0, f64::NAN)), &[0.0], language), ["1", "2", "4", "8", "16"]);
        assert_eq!(texts(Scale::Log10, Some((7.0, 7.0)), &[100.0], language), ["100", "200"]);
    }

    /// Numbers of every magnitude, some that are none, and often of one magnitude.
    fn numbers() -> impl Strategy<Value = Vec<f64>> {
        let one = prop_oneof![
            8 => (-1.0..1.0f64, -9..12i32).prop_map(|(digits, power)| digits * 10f64.powi(power)),
            1 => any::<f64>(),
        ];
        prop_oneof![prop::collection::vec(one, 0..12), prop::collection::vec(0.0..1000.0f64, 1..12)]
    }

    fn scales() -> impl Strategy<Value = Scale> {
        prop_oneof![Just(Scale::Linear), Just(Scale::Log10), Just(Scale::Log2)]
    }

    proptest! {
        #[test]
        fn ticks_ascend_stand_apart_and_are_few(
            scale in scales(), values in numbers(), given in any::<bool>(), length in 150.0..1500.0f32, letter in 5.0..10.0f32,
        ) {
        let language = Language::English;
            let range = (given && values.len() > 1).then(|| (values[0].min(values[1]), values[0].max(values[1])));
            let axis = Axis { range, scale, ..Axis::default() };
            let extent = |text: &str| letter * text.chars().count() as f32;
            let ruler = Ruler::new(&axis, values.iter().copied(), length, extent, language);
            let most = if scale == Scale::Log2 { MOST_POWERS } else { MOST };
            prop_assert!((2..=most).contains(&ruler.ticks.len()), "{ruler:?}");
            let places: Vec<f32> = ruler
                .ticks
                .iter()
                .map(|tick| ruler.place(tick.value).expect("a tick is on its axis") as f32 * length)
                .collect();
            prop_assert!((-0.01..=length + 0.01).contains(&places[0]) && places[places.len() - 1] <= length + 0.01);
            for (i, two) in ruler.ticks.windows(2).enumerate() {
                prop_assert!(two[0].value < two[1].value && two[0].text != two[1].text, "{:?}", two);
                let room = (extent(&two[0].text) + extent(&two[1].text)) / 2.0;
                prop_assert!(places[i + 1] - places[i] >= room, "{:?}", two);
            }
        }

        #[test]
        fn ticks_cover_what_is_seen(scale in scales(), values in numbers()) {
        let language = Language::English;
            let axis = Axis { scale, ..Axis::default() };
            let ruler = Ruler::new(&axis, values.iter().copied(), 600.0, |_| 10.0, language);
            let [first, .., last] = &ruler.ticks[..] else { panic!("an axis has two ends: {ruler:?}") };
            let is_seen = |value: &&f64| (1.0 / LIMIT..=LIMIT).contains(&if scale.is_log() { **value } else { value.abs() });
            for &value in values.iter().filter(is_seen) {
                prop_assert!((first.value..=last.value).contains(&value), "{value} is not in {ruler:?}");
                let place = ruler.place(value).expect("it is on the axis");
                prop_assert!((0.0..=1.0).contains(&place), "{value} is at {place}");
            }
        }

        #[test]
        fn a_range_that_is_given_is_kept(from in -1e6..1e6f64, more in 1.0..1e6f64) {
        let language = Language::English;
            let axis = Axis { range: Some((from, from + more)), ..Axis::default() };
            let ruler = Ruler::new(&axis, [1e9].into_iter(), 600.0, |_| 10.0, language);
            prop_assert_eq!((ruler.place(from), ruler.place(from + more)), (Some(0.0), Some(1.0)));
            prop_assert!(ruler.ticks.len() >= 3, "{:?}", ruler);
        }
    }
}
