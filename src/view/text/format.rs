//! Numbers and names in words. Nodes are numbered from 1 for people.

use std::time::Duration;

use crate::balance::{NodeId, Party};
use crate::language::{Language, comma, decimal, say, word};
use crate::time::Time;
use crate::view::state::node_state::Activity;

/// A node's name for people: its number from 1.
pub fn node_name(node: NodeId) -> u32 {
    u32::from(node) + 1
}

/// A party's name for people.
pub(crate) fn party_name(party: Party, language: Language) -> String {
    match party {
        Party::Parent => word!(language, "the parent", "o pai").into(),
        Party::Node(node) => node_name(node).to_string(),
    }
}

/// A count with its thousands apart: `6 144`, with a narrow space that does not break.
pub fn count(number: u32) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{a0}');
        }
        text.push(digit);
    }
    text
}

/// How many of `whole` are `part`, in whole per cent, the same everywhere: all of it only when nothing is missing.
pub fn percent(part: u32, whole: u32) -> String {
    let rounded = (200 * u64::from(part) + u64::from(whole)) / (2 * u64::from(whole)).max(1);
    format!("{} %", if part < whole { rounded.min(99) } else { rounded })
}

/// A fraction in whole per cent.
pub fn fraction(part: f64) -> String {
    format!("{:.0} %", part * 100.0)
}

/// Atoms a second: `62/s`; below one a second with a decimal.
pub fn rate_words(rate: f64, language: Language) -> String {
    if rate < 0.05 {
        "0/s".into()
    } else if rate < 0.95 {
        format!("{}/s", decimal(language, rate, 1))
    } else {
        format!("{}/s", count(rate.round() as u32))
    }
}

/// A weight on the wire: `840 B`, `12 kB`, `3.4 MB`.
pub fn bytes_words(bytes: u64, language: Language) -> String {
    match bytes {
        0..1000 => format!("{bytes} B"),
        1000..1_000_000 => format!("{:.0} kB", bytes as f64 / 1e3),
        _ => format!("{} MB", decimal(language, bytes as f64 / 1e6, 1)),
    }
}

/// A length of time in the unit that suits it: `20.4 s`, `200 ms`, `1.3 ms`, `840 µs`.
pub fn duration(length: Duration, language: Language) -> String {
    let ms = length.as_secs_f64() * 1e3;
    if length.is_zero() {
        "0 s".into()
    } else if ms < 0.9995 {
        format!("{:.0} µs", ms * 1e3)
    } else if ms < 9.95 {
        format!("{} ms", decimal(language, ms, 1))
    } else if ms < 999.5 {
        format!("{ms:.0} ms")
    } else {
        format!("{} s", decimal(language, ms * 1e-3, 1))
    }
}

/// A time of the run, as exactly as one can follow where so many of its seconds go by in a second: `13.4 s`,
/// `13.402 518 s`.
pub fn time_words(time: Time, rate: f64, language: Language) -> String {
    let digits = if rate >= 1.0 { 1 } else { (1.0 - rate.log10().floor()).clamp(1.0, 9.0) as usize };
    let text = format!("{:.digits$}", time.secs());
    let (whole, part) = text.split_once('.').unwrap_or((&text, ""));
    let mut words = format!("{whole}.");
    for (place, digit) in part.chars().enumerate() {
        if place > 0 && place.is_multiple_of(3) {
            words.push('\u{a0}');
        }
        words.push(digit);
    }
    comma(language, words) + " s"
}

/// What a node is doing, in a word.
pub fn activity_word(activity: Activity, language: Language) -> &'static str {
    match activity {
        Activity::NoBand => word!(language, "no band", "sem faixa"),
        Activity::Tracing => word!(language, "tracing", "calculando"),
        Activity::SpeedZero => word!(language, "at 0 %", "a 0 %"),
        Activity::Paused => word!(language, "paused", "em pausa"),
        Activity::Offering => word!(language, "offering", "oferecendo"),
        Activity::Asking => word!(language, "asking", "pedindo"),
        Activity::InLine => word!(language, "in line", "na fila"),
        Activity::Receiving => word!(language, "receiving", "recebendo"),
        Activity::Idle => word!(language, "idle", "ociosa"),
        Activity::Retired => word!(language, "retired", "dispensada"),
        Activity::Asleep => word!(language, "asleep", "dormindo"),
        Activity::NoMore => word!(language, "no more", "sem trabalho"),
        Activity::Hung => word!(language, "hung", "travada"),
        Activity::CutOff => word!(language, "cut off", "isolada"),
        Activity::Off => word!(language, "off", "desligada"),
        Activity::Spare => word!(language, "spare", "reserva"),
        Activity::Done => word!(language, "done", "pronta"),
    }
}

/// `1 atom`, `2 atoms`.
pub(crate) fn atoms_words(atoms: u32, language: Language) -> String {
    counted(atoms, word!(language, "atom", "átomo"), language)
}

/// `1 atom left`, `2 atoms left`; in Portuguese the verb comes first, and counts too.
pub(crate) fn left_words(atoms: u32, language: Language) -> String {
    let (left, verb) = (atoms_words(atoms, language), if atoms == 1 { "resta" } else { "restam" });
    say!(language, "{left} left", "{verb} {left}")
}

/// A count and what is counted: `1 offer`, `2 offers`.
pub(crate) fn counted(number: u32, what: &str, language: Language) -> String {
    let many = if number == 1 { what.to_owned() } else { plural(what, language) };
    format!("{} {many}", count(number))
}

/// More than one of it, in the language that is spoken: `offers`; `vezes`, `níveis`, `ofertas`.
pub(crate) fn plural(what: &str, language: Language) -> String {
    let ending = |ending, many| what.strip_suffix(ending).map(|stem| format!("{stem}{many}"));
    match language {
        Language::English => None,
        Language::Portuguese => ending("z", "zes").or_else(|| ending("el", "eis")),
    }
    .unwrap_or_else(|| format!("{what}s"))
}

/// `1`, `1 and 2`, `1, 2 and 3`; if they are many, how many of them there are.
pub(crate) fn names(nodes: &[NodeId], language: Language) -> String {
    const MANY: usize = 5;
    let name = |node: &NodeId| node_name(*node).to_string();
    match nodes {
        [] => word!(language, "nobody", "ninguém").into(),
        [one] => name(one),
        [..] if nodes.len() > MANY => counted(nodes.len() as u32, word!(language, "machine", "máquina"), language),
        [..] => listed(&nodes.iter().map(name).collect::<Vec<_>>(), language),
    }
}

/// `a`, `a and b`, `a, b and c`.
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
    fn only_the_whole_is_a_hundred_per_cent() {
        let said =
            [(0, 6144), (3901, 6144), (6143, 6144), (6144, 6144), (0, 0)].map(|(part, whole)| percent(part, whole));
        assert_eq!(said, ["0 %", "63 %", "99 %", "100 %", "0 %"]);
        assert_eq!([percent(1, 8), percent(635, 1000)], ["13 %", "64 %"]);
    }

    #[test]
    fn thousands_stand_apart() {
        assert_eq!(count(0), "0");
        assert_eq!(count(144), "144");
        assert_eq!(count(1_234_567), "1\u{a0}234\u{a0}567");
    }

    #[test]
    fn lengths_of_time_have_the_unit_that_suits_them() {
        let language = Language::English;
        let said = [0, 840, 1_300, 40_000, 999_400, 999_600, 20_440_000]
            .map(|micros| duration(Duration::from_micros(micros), language));
        assert_eq!(said, ["0 s", "840 µs", "1.3 ms", "40 ms", "999 ms", "1.0 s", "20.4 s"]);
    }

    #[test]
    fn the_slower_time_goes_the_more_exactly_it_is_told() {
        let language = Language::English;
        let said = [2.0, 1.0, 0.1, 1e-3, 1e-6].map(|rate| time_words(Time(13_402_518_077), rate, language));
        let expected = ["13.4 s", "13.4 s", "13.40 s", "13.402\u{a0}5 s", "13.402\u{a0}518\u{a0}1 s"];
        assert_eq!(said, expected);
        assert_eq!(time_words(Time(60_999_999_999), 1.0, language), "61.0 s");
    }

    #[test]
    fn slow_rates_have_a_decimal() {
        let said = [0.0, 0.31, 0.96, 61.7, 1234.0].map(|rate| rate_words(rate, Language::English));
        assert_eq!(said, ["0/s", "0.3/s", "1/s", "62/s", "1\u{a0}234/s"]);
    }

    #[test]
    fn names_are_listed_while_they_are_few() {
        let language = Language::English;
        let said = [&[6][..], &[0, 1], &[0, 1, 7], &[0, 1, 2, 3, 4, 5]].map(|nodes| names(nodes, language));
        assert_eq!(said, ["7", "1 and 2", "1, 2 and 8", "6 machines"]);
        assert_eq!([counted(1, "offer", language), atoms_words(2000, language)], ["1 offer", "2\u{a0}000 atoms"]);
    }

    #[test]
    fn portuguese_counts_its_own_way() {
        let language = Language::Portuguese;
        let said = [
            counted(1, "vez", language),
            counted(2, "vez", language),
            counted(0, "nível", language),
            atoms_words(2000, language),
        ];
        assert_eq!(said, ["1 vez", "2 vezes", "0 níveis", "2\u{a0}000 átomos"]);
        assert_eq!([left_words(1, language), left_words(2, language)], ["resta 1 átomo", "restam 2 átomos"]);
        assert_eq!(names(&[0, 1, 7], language), "1, 2 e 8");
        assert_eq!(duration(Duration::from_micros(1_300), language), "1,3 ms");
        assert_eq!(time_words(Time(13_402_518_077), 1e-3, language), "13,402\u{a0}5 s");
    }
}
