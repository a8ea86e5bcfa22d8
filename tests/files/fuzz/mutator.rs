//! Makes nearly valid texts from valid ones: parts are changed, moved, repeated, nested or left out.

use std::ops::Range;

use fastrand::Rng;

/// Makes mutants of a corpus and of kept mutants.
pub struct Mutator {
    rng: Rng,
    corpus: Vec<String>,
    kept: Vec<String>,
}

/// Finds the parts of one kind in a text.
type Parts = fn(&str) -> Vec<Range<usize>>;

/// Longer mutants are cut off.
const MAX_MUTANT_BYTES: usize = 1 << 16;
/// The number of mutants kept for further changes.
const MAX_KEPT: usize = 200;
/// Longer mutants are not kept: soon all would be long, and only few could be tried.
const MAX_KEPT_BYTES: usize = 1 << 13;

/// Numbers at or next to the limits of types and settings.
const LIMITS: [&str; 36] = [
    "0",
    "-0",
    "-0.0",
    "1",
    "-1",
    "0.5",
    "2",
    "3",
    "63",
    "64",
    "65",
    "255",
    "1024",
    "1025",
    "3600",
    "65535",
    "65536",
    "134217728",
    "999999999",
    "1000000000",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "18446744073709551616",
    "1e6",
    "1e-6",
    "1e12",
    "-1e12",
    "1e-12",
    "1e308",
    "-1e308",
    "1e400",
    "1e-320",
    "NaN",
    "inf",
];

impl Mutator {
    /// A mutator; the same corpus and seed give the same mutants.
    pub fn new(corpus: &[Vec<u8>], seed: u64) -> Self {
        let corpus = corpus.iter().map(|input| String::from_utf8_lossy(input).into_owned()).collect();
        Self { rng: Rng::with_seed(seed), corpus, kept: Vec::new() }
    }

    /// The next mutant.
    pub fn mutant(&mut self) -> Vec<u8> {
        let mut text = self.parent();
        loop {
            self.change(&mut text);
            if self.rng.bool() {
                break;
            }
        }
        let mut bytes = text.into_bytes();
        bytes.truncate(MAX_MUTANT_BYTES);
        if self.rng.u8(..20) == 0 && !bytes.is_empty() {
            let at = self.rng.usize(..bytes.len());
            bytes[at] = self.rng.u8(..);
        }
        bytes
    }

    /// Keeps a mutant, so that later mutants may be made of it.
    pub fn keep(&mut self, mutant: Vec<u8>) {
        if mutant.len() > MAX_KEPT_BYTES {
            return;
        }
        let text = String::from_utf8_lossy(&mutant).into_owned();
        if self.kept.len() < MAX_KEPT {
            self.kept.push(text);
        } else {
            self.kept[self.rng.usize(..MAX_KEPT)] = text;
        }
    }

    fn parent(&mut self) -> String {
        let from = if self.kept.is_empty() || self.rng.bool() { &self.corpus } else { &self.kept };
        from[self.rng.usize(..from.len())].clone()
    }

    fn change(&mut self, text: &mut String) {
        let kind: Parts = [groups, words, lines][self.rng.usize(..3)];
        match self.rng.u8(..16) {
            0..6 => {
                let number = LIMITS[self.rng.usize(..LIMITS.len())].to_owned();
                self.replace(text, numbers, |_, _| number);
            }
            6 | 7 => self.replace(text, numbers, nudged),
            8 => self.graft(text, numbers),
            9 | 10 => self.graft(text, groups),
            11 => self.graft(text, kind),
            12 => self.replace(text, kind, |_, _| String::new()),
            13 | 14 => self.replace(text, kind, repeated),
            _ => self.nest(text),
        }
    }

    /// Replaces a random part of this kind.
    fn replace(&mut self, text: &mut String, kind: Parts, by: impl FnOnce(&mut Rng, &str) -> String) {
        if let Some(part) = self.rng.choice(kind(text)) {
            let other = by(&mut self.rng, &text[part.clone()]);
            text.replace_range(part, &other);
        }
    }

    /// Replaces a part by one of another text that begins with the same bracket, sign or quote.
    fn graft(&mut self, text: &mut String, kind: Parts) {
        let other = self.parent();
        self.replace(text, kind, |rng, part| {
            let begins = |text: &str| text.chars().next().filter(|first| !first.is_alphanumeric());
            let alike = kind(&other).into_iter().filter(|range| begins(&other[range.clone()]) == begins(part));
            rng.choice(alike.collect::<Vec<_>>()).map_or_else(|| part.to_owned(), |range| other[range].to_owned())
        });
    }

    /// Nests a group in itself many times, in the place of an inner group.
    fn nest(&mut self, text: &mut String) {
        self.replace(text, groups, |rng, group| {
            // The first is the group itself.
            let Some(inner) = rng.choice(groups(group).split_off(1)) else { return group.to_owned() };
            let depth = 1 << rng.u32(..9);
            let (before, after) = (&group[..inner.start], &group[inner.end..]);
            [before.repeat(depth), group[inner].to_owned(), after.repeat(depth)].concat()
        });
    }
}

/// A number changed by 1, in sign, or by powers of ten.
fn nudged(rng: &mut Rng, number: &str) -> String {
    let Ok(value) = number.parse::<f64>() else { return number.to_owned() };
    let nudged = match rng.u8(..4) {
        0 => value + 1.0,
        1 => value - 1.0,
        2 => -value,
        _ => value * 10f64.powi(rng.i32(-12..=12)),
    };
    nudged.to_string()
}

/// A part repeated 2 to 32 times, as in a list.
fn repeated(rng: &mut Rng, part: &str) -> String {
    let count = 1 << rng.u32(1..6);
    vec![part; count].join(if part.ends_with('\n') { "" } else { ", " })
}

fn numbers(text: &str) -> Vec<Range<usize>> {
    runs(text, |first| first.is_ascii_digit() || first == '-', |c| c.is_alphanumeric() || "+-.".contains(c))
}

fn words(text: &str) -> Vec<Range<usize>> {
    runs(text, |first| first.is_alphabetic() || first == '"', |c| c.is_alphanumeric() || "_-\"".contains(c))
}

/// The ranges that start with a character of the first kind and continue with the second kind.
fn runs(text: &str, starts: fn(char) -> bool, continues: fn(char) -> bool) -> Vec<Range<usize>> {
    let mut runs = Vec::new();
    let mut end = 0;
    for (start, first) in text.char_indices() {
        if start >= end && continues(first) {
            end = text[start..].find(|c| !continues(c)).map_or(text.len(), |length| start + length);
            if starts(first) {
                runs.push(start..end);
            }
        }
    }
    runs
}

fn lines(text: &str) -> Vec<Range<usize>> {
    let mut end = 0;
    let range = |line: &str| {
        end += line.len();
        end - line.len()..end
    };
    text.split_inclusive('\n').map(range).collect()
}

/// The groups in brackets, with the brackets and the name before them; outer groups come before inner ones.
fn groups(text: &str) -> Vec<Range<usize>> {
    let (mut open, mut groups) = (Vec::new(), Vec::new());
    for (at, c) in text.char_indices() {
        if "([{".contains(c) {
            let name = text[..at].trim_end_matches(|c: char| c.is_ascii_alphanumeric());
            open.push(name.len());
        } else if ")]}".contains(c)
            && let Some(start) = open.pop()
        {
            groups.push(start..at + 1);
        }
    }
    groups.sort_by_key(|group| (group.start, usize::MAX - group.end));
    groups
}
