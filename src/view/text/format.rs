//! Numbers and names in words: the one place for their formats. Nodes and atoms have numbers from 1 for people.

use std::time::Duration;

use crate::balance::{NodeId, Party};
use crate::language::{Language, comma, decimal, say, word};
use crate::time::Time;
use crate::view::state::node_rows::NodeRow;
use crate::view::state::node_state::Activity;
use crate::view::text::glossary::Definition;

/// Returns a node's name for people: its number from 1.
pub fn node_name(node: NodeId) -> u32 {
    u32::from(node) + 1
}

/// Returns a party's name for people.
pub(crate) fn party_name(party: Party, language: Language) -> String {
    match party {
        Party::Parent => word!(language, "the parent", "o pai").into(),
        Party::Node(node) => node_name(node).to_string(),
    }
}

/// Writes a count with its thousands apart: `6 144`, with a space that does not break.
pub fn count(number: impl Into<u64>) -> String {
    let digits = number.into().to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(NO_BREAK_SPACE);
        }
        text.push(digit);
    }
    text
}

/// Stands between groups of three digits.
const NO_BREAK_SPACE: char = '\u{a0}';

/// Writes `part / whole` in whole per cent; `100 %` only if nothing is missing.
pub fn percent(part: u32, whole: u32) -> String {
    let rounded = (200 * u64::from(part) + u64::from(whole)) / (2 * u64::from(whole)).max(1);
    format!("{} %", if part < whole { rounded.min(99) } else { rounded })
}

/// Writes a fraction, 0 to 1, in whole per cent: `63 %`. Only nothing is `0 %`.
pub fn fraction(part: f64) -> String {
    if 0.0 < part && part < 0.005 { "< 1 %".into() } else { format!("{:.0} %", part * 100.0) }
}

/// Writes a fraction in per cent with two digits at least: `88 %`, `2.1 %`, `0.03 %`.
pub(crate) fn fine_fraction(part: f64, language: Language) -> String {
    let percent = 100.0 * part;
    match percent.abs() {
        0.0 => "0 %".into(),
        0.0..0.005 => word!(language, "< 0.01 %", "< 0,01 %").into(),
        0.005..0.095 => format!("{} %", decimal(language, percent, 2)),
        0.095..9.95 => format!("{} %", decimal(language, percent, 1)),
        _ => fraction(part),
    }
}

/// Writes a ratio of two times: `1.25`, `12`.
pub(crate) fn ratio_words(ratio: f64, language: Language) -> String {
    decimal(language, ratio, if ratio < 10.0 { 2 } else { 0 })
}

/// Writes a number with two significant digits: `0.012`, `0.50`, `12`; nothing smaller than a millionth.
pub fn two_digits(number: f64, language: Language) -> String {
    if number <= 0.0 {
        return "0".into();
    }
    let decimals = (1.0 - number.log10().floor()).clamp(0.0, 6.0) as usize;
    decimal(language, number, decimals)
}

/// Writes a length of the scene with about four significant digits: `1.000`, `12.35`, `1.00e9`, `∞`.
pub(crate) fn distance_words(distance: f64, language: Language) -> String {
    match distance.abs() {
        f64::INFINITY if distance < 0.0 => "−∞".into(),
        f64::INFINITY => "∞".into(),
        0.0 => "0".into(),
        0.001..10.0 => decimal(language, distance, 3),
        10.0..100.0 => decimal(language, distance, 2),
        100.0..100_000.0 => decimal(language, distance, 1),
        _ => comma(language, format!("{distance:.2e}")),
    }
    .replace('-', "−")
}

/// Writes a number down to its digit for 10^`power`, without zeros at its end: `−20`, `0.2`, `1 000`, `2e9`.
pub(crate) fn number_to_power(number: f64, power: i32, language: Language) -> String {
    let trimmed = |digits: &str| match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => digits.to_owned(),
    };
    let sign = if number < 0.0 { "−" } else { "" };
    let number = number.abs();
    if number >= 1e9 || power < -4 {
        let decimals = (number.log10().floor() as i32 - power).clamp(0, 9) as usize;
        let digits = format!("{number:.decimals$e}");
        let (digits, exponent) = digits.split_at(digits.find('e').unwrap_or(digits.len()));
        return comma(language, format!("{sign}{}{exponent}", trimmed(digits)));
    }
    let digits = trimmed(&format!("{number:.*}", (-power).max(0) as usize));
    let (whole, decimals) = digits.split_at(digits.find('.').unwrap_or(digits.len()));
    comma(language, format!("{sign}{}{decimals}", count(whole.parse().unwrap_or(u32::MAX))))
}

/// Writes a rate of atoms or messages a second without its unit: `62`; below ten with a decimal.
pub fn rate_number(rate: f64, language: Language) -> String {
    match rate {
        0.05..9.95 => decimal(language, rate, 1),
        _ => count(rate.round() as u32),
    }
}

/// Writes a rate of atoms or messages a second: `62/s`, `0.3/s`.
pub fn rate_words(rate: f64, language: Language) -> String {
    format!("{}/s", rate_number(rate, language))
}

/// Writes a weight on the wire: `840 B`, `12 kB`, `3.4 MB`.
pub fn bytes_words(bytes: u64, language: Language) -> String {
    match bytes {
        0..1000 => format!("{bytes} B"),
        1000..1_000_000 => format!("{:.0} kB", bytes as f64 / 1e3),
        _ => format!("{} MB", decimal(language, bytes as f64 / 1e6, 1)),
    }
}

/// A unit of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum TimeUnit {
    Seconds,
    Milliseconds,
    Microseconds,
    Nanoseconds,
}

impl TimeUnit {
    /// Returns the unit in which a length of time in seconds is from 1 to 1000.
    fn of(seconds: f64) -> Self {
        match seconds {
            0.0 | 0.9995.. => Self::Seconds,
            0.9995e-3.. => Self::Milliseconds,
            0.9995e-6.. => Self::Microseconds,
            _ => Self::Nanoseconds,
        }
    }

    /// Returns its name, and the power of ten of a second that it divides.
    fn name_and_power(self) -> (&'static str, u32) {
        match self {
            Self::Seconds => ("s", 0),
            Self::Milliseconds => ("ms", 3),
            Self::Microseconds => ("µs", 6),
            Self::Nanoseconds => ("ns", 9),
        }
    }
}

/// Unit and precision of the times of one run. All times of a run have the same unit, which follows its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeScale {
    unit: TimeUnit,
    /// Decimals of a second.
    decimals: u32,
}

impl TimeScale {
    /// Returns the scale of a run of this length. A twentieth of the run can be told from the next.
    pub fn of_length(length: Time) -> Self {
        Self { unit: TimeUnit::of(length.secs()), decimals: Self::decimals_at(length.secs() / 2.0) }
    }

    /// Returns a scale that is precise enough to follow a run at this playback rate, in run seconds per second.
    pub fn at_rate(self, rate: f64) -> Self {
        Self { decimals: self.decimals.max(Self::decimals_at(rate)), ..self }
    }

    /// Returns a scale with more decimals.
    pub fn finer(self, decimals: u32) -> Self {
        Self { decimals: (self.decimals + decimals).min(9), ..self }
    }

    /// Returns a scale with this number of decimals in its unit, for figures that are compared.
    pub fn with_decimals(self, decimals: u32) -> Self {
        let (_, power) = self.unit.name_and_power();
        Self { decimals: (power + decimals).min(9), ..self }
    }

    /// Returns the decimals of a second for times that differ by a tenth of `grain` seconds.
    fn decimals_at(grain: f64) -> u32 {
        if grain >= 1.0 || grain == 0.0 { 1 } else { (1.0 - grain.log10().floor()).clamp(1.0, 9.0) as u32 }
    }
}

/// Writes a length of time in the unit that suits it: `20.4 s`, `200 ms`, `1.3 ms`, `840 µs`.
pub fn duration(length: Duration, language: Language) -> String {
    let unit = TimeUnit::of(length.as_secs_f64());
    let (name, power) = unit.name_and_power();
    let number = length.as_secs_f64() * 10_f64.powi(power as i32);
    let digits = match unit {
        _ if length.is_zero() => 0,
        TimeUnit::Seconds => 1,
        TimeUnit::Nanoseconds => 0,
        _ if number < 9.95 => 1,
        _ => 0,
    };
    format!("{} {name}", decimal(language, number, digits))
}

/// Writes a time of a run in the scale of the run: `13.4 s`, `13.402518 s`, `3.2 ms`. Its decimals are not grouped: a
/// space among them would make two numbers of it.
pub fn time_words(time: Time, scale: TimeScale, language: Language) -> String {
    let (name, power) = scale.unit.name_and_power();
    let digits = scale.decimals.saturating_sub(power) as usize;
    format!("{} {name}", decimal(language, time.secs() * 10_f64.powi(power as i32), digits))
}

/// Writes a length of time in few letters, in seconds: `12 s`, `3.2 s`.
fn brief_seconds(length: Duration, language: Language) -> String {
    let seconds = length.as_secs_f64();
    format!("{} s", decimal(language, seconds, usize::from(seconds < 9.95)))
}

/// Returns what a node is doing, for its row: if it is or was stopped, also for how long; or how many atoms are lost
/// with it.
pub fn row_words(row: &NodeRow, language: Language) -> String {
    /// A shorter stop would be written as 0.
    const MIN_STOP: Duration = Duration::from_millis(50);
    let activity = match row.activity {
        Activity::Done => word!(language, "stopped", "parada"),
        activity => activity_word(activity, language),
    };
    if row.lost > 0 {
        let lost = count(row.lost);
        return say!(language, "{activity}, {lost} lost", "{activity}, {lost} perdidos");
    }
    let stops = matches!(
        row.activity,
        Activity::Done | Activity::Paused | Activity::SpeedZero | Activity::Hung | Activity::Off
    );
    if !stops || row.stopped < MIN_STOP {
        return activity_word(row.activity, language).into();
    }
    let stopped = brief_seconds(row.stopped, language);
    // The word ends with a number.
    let mark = if row.activity == Activity::SpeedZero { "," } else { "" };
    format!("{activity}{mark} {stopped}")
}

/// Returns the word for what a node is doing.
pub fn activity_word(activity: Activity, language: Language) -> &'static str {
    Definition::of_activity(activity).name(language)
}

/// Writes a number of atoms: `1 atom`, `2 atoms`.
pub(crate) fn atoms_words(atoms: impl Into<u64>, language: Language) -> String {
    counted(atoms, word!(language, "atom", "átomo"), language)
}

/// Writes a number of atoms left: `1 atom left`, `2 atoms left`. In Portuguese the verb comes first, and has a plural.
pub(crate) fn left_words(atoms: u32, language: Language) -> String {
    let (left, verb) = (atoms_words(atoms, language), if atoms == 1 { "resta" } else { "restam" });
    say!(language, "{left} left", "{verb} {left}")
}

/// Writes a count with its noun, which is given in the singular: `1 offer`, `2 offers`.
pub(crate) fn counted(number: impl Into<u64>, noun: &str, language: Language) -> String {
    let number = number.into();
    let noun = if number == 1 { noun.to_owned() } else { plural(noun, language) };
    format!("{} {noun}", count(number))
}

/// Returns the plural of a noun: `offers`; `vezes`, `níveis`, `ofertas`.
pub(crate) fn plural(noun: &str, language: Language) -> String {
    let ending = |ending, many| noun.strip_suffix(ending).map(|stem| format!("{stem}{many}"));
    match language {
        Language::English => None,
        Language::Portuguese => ending("z", "zes").or_else(|| ending("el", "eis")).or_else(|| ending("m", "ns")),
    }
    .unwrap_or_else(|| format!("{noun}s"))
}

/// More nodes than this are counted, not named.
const MAX_NAMES: usize = 5;

/// Lists nodes by name: `1`, `1 and 2`, `1, 2 and 3`; counts them if there are more than five.
pub(crate) fn names(nodes: &[NodeId], language: Language) -> String {
    let name = |node: &NodeId| node_name(*node).to_string();
    match nodes {
        [] => word!(language, "nobody", "ninguém").into(),
        [one] => name(one),
        [..] if nodes.len() > MAX_NAMES => counted(nodes.len() as u32, word!(language, "machine", "máquina"), language),
        [..] => listed(&nodes.iter().map(name).collect::<Vec<_>>(), language),
    }
}

/// Lists nodes like [`names`], after the word that suits their number: `machine 1`, `machines 1 and 2`, `6 machines`.
/// `before` stands before one name, before several names, and before a count.
pub(crate) fn machines(nodes: &[NodeId], before: [&str; 3], language: Language) -> String {
    let [one, several, counted] = before;
    let before = match nodes.len() {
        1 => one,
        0 | 2..=MAX_NAMES => several,
        _ => counted,
    };
    format!("{before}{}", names(nodes, language))
}

/// Lists words: `a`, `a and b`, `a, b and c`.
pub(crate) fn listed(words: &[String], language: Language) -> String {
    match words {
        [others @ .., last] if !others.is_empty() => {
            let others = others.join(", ");
            say!(language, "{others} and {last}", "{others} e {last}")
        }
        _ => words.concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn part_that_misses_anything_is_less_than_100_per_cent() {
        let written =
            [(0, 6144), (3901, 6144), (6143, 6144), (6144, 6144), (0, 0)].map(|(part, whole)| percent(part, whole));
        assert_eq!(written, ["0 %", "63 %", "99 %", "100 %", "0 %"]);
        assert_eq!([percent(1, 8), percent(635, 1000)], ["13 %", "64 %"]);
    }

    #[test]
    fn only_nothing_is_0_per_cent() {
        assert_eq!(
            [0.0, 1e-4, 0.0049, 0.0051, 0.634, 1.0].map(fraction),
            ["0 %", "< 1 %", "< 1 %", "1 %", "63 %", "100 %"]
        );
    }

    #[test]
    fn count_separates_thousands() {
        assert_eq!(count(0_u32), "0");
        assert_eq!(count(144_u32), "144");
        assert_eq!(count(1_234_567_u32), "1\u{a0}234\u{a0}567");
    }

    #[test]
    fn duration_chooses_its_unit() {
        let language = Language::English;
        let written = [0, 840, 1_300, 40_000, 999_400, 999_600, 20_440_000]
            .map(|micros| duration(Duration::from_micros(micros), language));
        assert_eq!(written, ["0 s", "840 µs", "1.3 ms", "40 ms", "999 ms", "1.0 s", "20.4 s"]);
        let written = [1, 100, 2_300, 999_800].map(|nanos| duration(Duration::from_nanos(nanos), language));
        assert_eq!(written, ["1 ns", "100 ns", "2.3 µs", "1.0 ms"]);
    }

    #[test]
    fn unit_follows_the_length_of_the_run() {
        let language = Language::English;
        let half = |length: u64| time_words(Time(length / 2), TimeScale::of_length(Time(length)), language);
        let written = [0, 300, 6_400, 3_200_000, 640_000_000, 1_300_000_000, 20_000_000_000].map(half);
        assert_eq!(written, ["0.0 s", "150 ns", "3.2 µs", "1.6 ms", "320 ms", "0.65 s", "10.0 s"]);
        // Neighbouring twentieths of a run differ, and no unit is too large or too small.
        for power in 2..11 {
            for length in [1, 2, 5, 9].map(|factor| factor * 10_u64.pow(power)) {
                let scale = TimeScale::of_length(Time(length));
                let times = (0..=20).map(|part| time_words(Time(part * length / 20), scale, language));
                let times: std::collections::BTreeSet<_> = times.collect();
                assert!(times.len() == 21 && times.iter().all(|time| time.chars().count() <= 9), "{times:?}");
            }
        }
    }

    #[test]
    fn time_has_more_digits_at_a_slower_playback_rate() {
        let language = Language::English;
        let scale = TimeScale::of_length(Time::from_secs(20.0));
        let at_rate = |rate| time_words(Time(13_402_518_077), scale.at_rate(rate), language);
        let written = [2.0, 1.0, 0.1, 1e-3, 1e-6].map(at_rate);
        let expected = ["13.4 s", "13.4 s", "13.40 s", "13.4025 s", "13.4025181 s"];
        assert_eq!(written, expected);
        assert_eq!(time_words(Time(60_999_999_999), scale, language), "61.0 s");
        assert_eq!(time_words(Time(13_402_518_077), scale.with_decimals(3), language), "13.403 s");
        let [exact, finer] = [scale.with_decimals(9), scale.finer(2)].map(|scale| time_words(Time(1), scale, language));
        assert_eq!([&*exact, &*finer], ["0.000000001 s", "0.000 s"]);
    }

    #[test]
    fn rate_below_ten_has_a_decimal() {
        let written = [0.0, 0.31, 0.96, 9.96, 61.7, 1234.0].map(|rate| rate_words(rate, Language::English));
        assert_eq!(written, ["0/s", "0.3/s", "1.0/s", "10/s", "62/s", "1\u{a0}234/s"]);
    }

    #[test]
    fn fine_fraction_has_two_digits() {
        let written = [0.0, 1e-6, 0.0003, 0.0213, 0.0996, 0.88, 1.0].map(|part| fine_fraction(part, Language::English));
        assert_eq!(written, ["0 %", "< 0.01 %", "0.03 %", "2.1 %", "10 %", "88 %", "100 %"]);
    }

    #[test]
    fn distance_has_four_digits() {
        let distances = [0.0, 1.0, 12.345, -3.5, 1e9, 1e-7, f64::NEG_INFINITY];
        let written = distances.map(|distance| distance_words(distance, Language::English));
        assert_eq!(written, ["0", "1.000", "12.35", "−3.500", "1.00e9", "1.00e−7", "−∞"]);
    }

    #[test]
    fn small_number_has_two_digits() {
        let numbers = [0.0, 0.000_012_34, 0.0123, 0.096, 0.5, 12.0];
        let written = numbers.map(|number| two_digits(number, Language::English));
        assert_eq!(written, ["0", "0.000012", "0.012", "0.096", "0.50", "12"]);
        assert_eq!([1.254, 12.0].map(|ratio| ratio_words(ratio, Language::Portuguese)), ["1,25", "12"]);
    }

    #[test]
    fn number_to_power_has_no_zeros_at_its_end() {
        let written = [(-20.0, 1), (0.2, -1), (0.5, -3), (2e9, 8), (3e-6, -6), (0.0, 0)]
            .map(|(number, power)| number_to_power(number, power, Language::English));
        assert_eq!(written, ["−20", "0.2", "0.5", "2e9", "3e-6", "0"]);
    }

    #[test]
    fn more_than_five_names_are_counted() {
        let language = Language::English;
        let written = [&[6][..], &[0, 1], &[0, 1, 7], &[0, 1, 2, 3, 4, 5]].map(|nodes| names(nodes, language));
        assert_eq!(written, ["7", "1 and 2", "1, 2 and 8", "6 machines"]);
        let wakes = [&[6][..], &[0, 1], &[0, 1, 2, 3, 4, 5]]
            .map(|nodes| machines(nodes, ["machine ", "machines ", ""], language));
        assert_eq!(wakes, ["machine 7", "machines 1 and 2", "6 machines"]);
        assert_eq!(
            [counted(1_u32, "offer", language), atoms_words(2000_u32, language)],
            ["1 offer", "2\u{a0}000 atoms"]
        );
    }

    #[test]
    fn portuguese_has_its_own_plurals_and_decimal_mark() {
        let language = Language::Portuguese;
        let written = [
            counted(1_u32, "vez", language),
            counted(2_u32, "vez", language),
            counted(0_u32, "nível", language),
            atoms_words(2000_u32, language),
        ];
        assert_eq!(written, ["1 vez", "2 vezes", "0 níveis", "2\u{a0}000 átomos"]);
        assert_eq!([left_words(1, language), left_words(2, language)], ["resta 1 átomo", "restam 2 átomos"]);
        assert_eq!(names(&[0, 1, 7], language), "1, 2 e 8");
        assert_eq!(duration(Duration::from_micros(1_300), language), "1,3 ms");
        let scale = TimeScale::of_length(Time::from_secs(20.0)).at_rate(1e-3);
        assert_eq!(time_words(Time(13_402_518_077), scale, language), "13,4025 s");
    }
}
