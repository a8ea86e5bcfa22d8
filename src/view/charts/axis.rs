//! Axes: their ranges, and the numbers written beside them.

use crate::language::Language;
use crate::view::text::format::{count, number_to_power};

/// Scale of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences are equal lengths.
    #[default]
    Linear,
    /// Equal ratios are equal lengths. Ticks at powers of ten, and at 1, 2, 5 where these are few.
    Log10,
    /// Equal ratios are equal lengths. Ticks at powers of two.
    Log2,
}

/// Quantity along one side of a chart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Name of the quantity, and its unit.
    pub label: String,
    /// The scale.
    pub scale: Scale,
    /// Least and greatest number; `None`: those of the values, on a linear scale with 0.
    pub range: Option<(f64, f64)>,
}

/// An axis with its range and ticks.
#[derive(Clone, Debug)]
pub(crate) struct Ruler {
    scale: Scale,
    from: f64,
    to: f64,
    /// Ticks, ascending.
    pub(crate) ticks: Vec<Tick>,
}

/// A number written beside an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) text: String,
}

/// Most ticks of an axis.
const MAX_TICKS: usize = 8;
/// Greatest number of ticks on an axis of powers of two; eleven reach from 1 to 1024.
const MAX_LOG2_TICKS: usize = 11;
/// Greatest number of an axis; its inverse is the least one that is not 0.
const MAX_NUMBER: f64 = 1e30;
/// Least width of a range, relative to its numbers.
const MIN_RELATIVE_WIDTH: f64 = 1e-6;
/// Number of step widths, each greater than the one before, after which any axis has two ticks.
const STEP_WIDTHS: i32 = 100;

impl Ruler {
    /// Chooses the finest ticks whose texts do not touch on an axis of this length; `extent` returns the length of a
    /// text.
    pub(crate) fn new(
        axis: &Axis,
        values: impl Iterator<Item = f64>,
        length: f32,
        extent: impl Fn(&str) -> f32,
        language: Language,
    ) -> Self {
        let scale = axis.scale;
        let given = axis.range.filter(|&range| is_usable(scale, range));
        let (from, to) = given.unwrap_or_else(|| values_range(scale, values));
        let at = |i: i32| Self::with(Steps::nth(scale, from, to, i), scale, (from, to), given.is_some(), language);
        let fits = |ruler: &Self| ruler.fits(length, &extent);
        (0..STEP_WIDTHS).map(at).find(fits).unwrap_or_else(|| at(STEP_WIDTHS))
    }

    /// Position of a number on the axis: 0 at its beginning, 1 at its end, also beyond. `None` if the scale does not
    /// have the number.
    pub(crate) fn place(&self, value: f64) -> Option<f64> {
        let (from, to) = (self.scale.to_length(self.from), self.scale.to_length(self.to));
        Some((self.scale.to_length(value) - from) / (to - from)).filter(|place| place.is_finite())
    }

    /// Creates the axis with these steps. A given range is kept if two ticks are in it.
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

    /// Whether there are not too many ticks, and their texts do not touch.
    fn fits(&self, length: f32, extent: &impl Fn(&str) -> f32) -> bool {
        let most = if self.scale == Scale::Log2 { MAX_LOG2_TICKS } else { MAX_TICKS };
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

    /// Converts a number to a length, in any unit.
    fn to_length(self, value: f64) -> f64 {
        if self.is_log() { value.log2() } else { value }
    }
}

/// Whether a range can be shown on a scale.
fn is_usable(scale: Scale, (from, to): (f64, f64)) -> bool {
    let greatest = from.abs().max(to.abs());
    let seen = if scale.is_log() { from >= 1.0 / MAX_NUMBER } else { greatest >= 1.0 / MAX_NUMBER };
    seen && greatest <= MAX_NUMBER && to - from > MIN_RELATIVE_WIDTH * greatest
}

/// Returns the least and the greatest value that the scale can show.
fn values_range(scale: Scale, values: impl Iterator<Item = f64>) -> (f64, f64) {
    let least = if scale.is_log() { 1.0 / MAX_NUMBER } else { -MAX_NUMBER };
    let seen = values.filter(|value| (least..=MAX_NUMBER).contains(value));
    let start = if scale.is_log() { (MAX_NUMBER, 1.0 / MAX_NUMBER) } else { (0.0, 0.0) };
    let (from, to) = seen.fold(start, |(from, to), value| (value.min(from), value.max(to)));
    match scale {
        Scale::Linear if to - from < 1.0 / MAX_NUMBER => (0.0, 1.0),
        Scale::Log10 | Scale::Log2 if from > to => (1.0, 10.0),
        _ => (from, to),
    }
}

/// A sequence of round numbers.
#[derive(Clone, Copy, Debug)]
enum Steps {
    /// Multiples of `digit` × 10^`power`.
    Even { digit: i64, power: i32 },
    /// 1, 2 and 5 times every power of ten.
    Thirds,
    /// Each power of ten whose exponent is a multiple of this.
    Tens(i64),
    /// Each power of two whose exponent is a multiple of this.
    Twos(i64),
}

impl Steps {
    /// Returns the `i`-th steps for a range, each wider than the one before.
    fn nth(scale: Scale, from: f64, to: f64, i: i32) -> Self {
        match scale {
            Scale::Linear => {
                let power = ((to - from) / MAX_TICKS as f64).log10().floor() as i32 + i / 3;
                Self::Even { digit: [1, 2, 5][(i % 3) as usize], power }
            }
            Scale::Log10 if i == 0 => Self::Thirds,
            Scale::Log10 => Self::Tens(i.into()),
            Scale::Log2 => Self::Twos(i64::from(i) + 1),
        }
    }

    /// Returns the round numbers from the last that is not above `from` to the first that is not below `to`, two at
    /// least.
    fn round(self, from: f64, to: f64) -> Vec<f64> {
        let index = |value: f64| match self {
            Self::Even { digit, power } => value / tenfold(digit, power),
            Self::Thirds => value.log10() * 3.0,
            Self::Tens(every) => value.log10() / every as f64,
            Self::Twos(every) => value.log2() / every as f64,
        };
        // Two more at each end, since thirds are not even and logarithms are rounded.
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

    /// Writes a tick's number.
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

/// Returns `digits` × 10^`power`, rounded once as long as both factors are exact.
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
    fn ticks_are_round_numbers() {
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
    fn axis_without_values_has_ticks() {
        let language = Language::English;
        assert_eq!(texts(Scale::Linear, None, &[f64::NAN, f64::INFINITY], language)[..2], ["0", "0.2"]);
        assert_eq!(texts(Scale::Log2, Some((-1.0, f64::NAN)), &[0.0], language), ["1", "2", "4", "8", "16"]);
        assert_eq!(texts(Scale::Log10, Some((7.0, 7.0)), &[100.0], language), ["100", "200"]);
    }

    /// Numbers of all magnitudes, some of them not finite, and often of one magnitude.
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
        fn ticks_ascend_and_do_not_touch(
            scale in scales(), values in numbers(), given in any::<bool>(), length in 150.0..1500.0f32, letter in 5.0..10.0f32,
        ) {
        let language = Language::English;
            let range = (given && values.len() > 1).then(|| (values[0].min(values[1]), values[0].max(values[1])));
            let axis = Axis { range, scale, ..Axis::default() };
            let extent = |text: &str| letter * text.chars().count() as f32;
            let ruler = Ruler::new(&axis, values.iter().copied(), length, extent, language);
            let most = if scale == Scale::Log2 { MAX_LOG2_TICKS } else { MAX_TICKS };
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
        fn ticks_cover_the_values(scale in scales(), values in numbers()) {
        let language = Language::English;
            let axis = Axis { scale, ..Axis::default() };
            let ruler = Ruler::new(&axis, values.iter().copied(), 600.0, |_| 10.0, language);
            let [first, .., last] = &ruler.ticks[..] else { panic!("an axis has two ends: {ruler:?}") };
            let is_seen = |value: &&f64| (1.0 / MAX_NUMBER..=MAX_NUMBER).contains(&if scale.is_log() { **value } else { value.abs() });
            for &value in values.iter().filter(is_seen) {
                prop_assert!((first.value..=last.value).contains(&value), "{value} is not in {ruler:?}");
                let place = ruler.place(value).expect("it is on the axis");
                prop_assert!((0.0..=1.0).contains(&place), "{value} is at {place}");
            }
        }

        #[test]
        fn given_range_is_kept(from in -1e6..1e6f64, more in 1.0..1e6f64) {
        let language = Language::English;
            let axis = Axis { range: Some((from, from + more)), ..Axis::default() };
            let ruler = Ruler::new(&axis, [1e9].into_iter(), 600.0, |_| 10.0, language);
            prop_assert_eq!((ruler.place(from), ruler.place(from + more)), (Some(0.0), Some(1.0)));
            prop_assert!(ruler.ticks.len() >= 3, "{:?}", ruler);
        }
    }
}
