//! Faults that no text may have, whatever the run: two numbers side by side, doubled words, a plural after 1.

use crate::balance::Scheduler;
use crate::language::Language;

/// Plurals of what is counted.
const PLURALS: [&str; 23] = [
    "machines",
    "atoms",
    "parts",
    "messages",
    "threads",
    "parcels",
    "transfers",
    "pixels",
    "levels",
    "rays",
    "solids",
    "times",
    "samples",
    "máquinas",
    "átomos",
    "partes",
    "mensagens",
    "pacotes",
    "transferências",
    "raios",
    "sólidos",
    "vezes",
    "ofertas",
];

const UNITS: [&str; 9] = ["s", "ms", "µs", "ns", "%", "B", "kB", "MB", "kB/s"];

/// Finds the faults of a text; each is a few words with the place.
pub(super) fn faults(text: &str, language: Language) -> Vec<String> {
    let mut found = Vec::new();
    let words: Vec<&str> = text.split([' ', '\n']).collect();
    let bare = |word: &str| word.trim_matches(|letter: char| !letter.is_alphanumeric()).to_lowercase();
    let begins = |word: &str| word.starts_with(|letter: char| letter.is_ascii_digit());
    let ends = |word: &str| word.ends_with(|letter: char| letter.is_ascii_digit());
    let is_word = |word: &str| word.chars().count() > 2 && word.chars().all(char::is_alphabetic);
    for (index, pair) in words.windows(2).enumerate() {
        let (one, next) = (pair[0], pair[1]);
        let after = words.get(index + 2).map(|word| bare(word)).unwrap_or_default();
        let unit = words.get(index + 2).map_or("", |word| word.trim_end_matches([',', ';', ':', '.', ')']));
        if ends(one) && begins(next) {
            found.push(format!("two numbers: {one} {next}"));
        }
        if one.strip_suffix(',').is_some_and(ends) && begins(next) && ends(next) && UNITS.contains(&unit) {
            found.push(format!("a comma between two numbers: {one} {next}"));
        }
        if is_word(one) && *one.to_lowercase() == bare(next) || is_word(one) && begins(next) && after == bare(one) {
            found.push(format!("a doubled word: {one} {next} {after}"));
        }
        if bare(one) == "1" && ends(one) && PLURALS.contains(&bare(next).as_str()) {
            found.push(format!("a plural: {one} {next}"));
        }
    }
    let parts: Vec<&str> = text.split(" · ").collect();
    found.extend(parts.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| format!("a doubled part: {}", pair[0])));
    found.extend(groups(text).filter(|group| group.len() != 3).map(|group| format!("a group of digits: {group}")));
    if language == Language::Portuguese {
        let names = Scheduler::ALL.into_iter().map(|scheduler| (scheduler.title(Language::English), scheduler));
        let english = names.filter(|(name, scheduler)| *name != scheduler.title(language));
        found.extend(english.filter(|(name, _)| has_words(text, name)).map(|(name, _)| format!("a name: {name}")));
    }
    found.iter().map(|fault| format!("{fault} in {text}")).collect()
}

/// The digits after each space that does not break, between two digits.
fn groups(text: &str) -> impl Iterator<Item = String> {
    let parts: Vec<&str> = text.split('\u{a0}').collect();
    let digits = |part: &&str| part.chars().take_while(char::is_ascii_digit).collect::<String>();
    let is_group = |pair: &&[&str]| pair[0].ends_with(|letter: char| letter.is_ascii_digit());
    let groups = parts.windows(2).filter(is_group).map(|pair| digits(&pair[1])).filter(|group| !group.is_empty());
    groups.collect::<Vec<_>>().into_iter()
}

/// Whether `text` has `name` between other letters than letters.
fn has_words(text: &str, name: &str) -> bool {
    text.match_indices(name).any(|(at, _)| {
        let (before, after) = (text[..at].chars().next_back(), text[at + name.len()..].chars().next());
        [before, after].into_iter().flatten().all(|letter| !letter.is_alphabetic())
    })
}

#[test]
fn faults_are_found() {
    for (text, fault) in [
        ("Machine 1 needs help and wakes machines 6 machines", "a doubled word"),
        ("“recorded” · 8 machines", ""),
        ("recorded · recorded", "a doubled part"),
        ("machine 8 31 %", "two numbers"),
        ("of 1 81 % arrives", "two numbers"),
        ("The costliest atom: 3\u{a0}091, 365 µs of its time", "a comma between two numbers"),
        ("10,842\u{a0}1 s", "a group of digits"),
        ("1 machines compute", "a plural"),
        ("21 machines compute, 1\u{a0}001 atoms wait", ""),
        ("It traces an an atom", ""),
        ("It waits for for the parent", "a doubled word"),
        ("1, 2 and 3 retire", ""),
    ] {
        let found = faults(text, Language::English);
        assert_eq!(found.is_empty(), fault.is_empty(), "{text}: {found:?}");
        assert!(found.iter().all(|found| found.starts_with(fault)), "{text}: {found:?}");
    }
    assert!(!faults("Equal bands leva 20 s", Language::Portuguese).is_empty());
    assert!(!faults("o tempo de Ring.", Language::Portuguese).is_empty());
    assert!(faults("Serial leva 20 s, sem String", Language::Portuguese).is_empty());
}
