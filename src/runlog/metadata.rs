//! What stands beside a run for people: what it is called, what is to be known of it, and on what it ran.

use std::env::consts::{ARCH, OS};
use std::fs;

use serde::{Deserialize, Serialize};

/// What stands beside a run for people. It changes nothing in the run, and what is empty was not said.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Metadata {
    /// What the run is called.
    pub title: String,
    /// What is to be known of it.
    pub memo: String,
    /// The computer that it ran on: processor, cores, system; nothing about whose it is.
    pub machine: String,
}

impl Metadata {
    /// For a run on this computer, which has so many cores.
    pub fn here(cores: usize) -> Self {
        let processor = fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| model(&text));
        let processor = processor.unwrap_or_else(|| ARCH.to_owned());
        let plural = if cores == 1 { "" } else { "s" };
        Self { machine: format!("{processor}, {cores} core{plural}, {OS}"), ..Self::default() }
    }

    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// All that is said, a line each.
    pub fn lines(&self) -> impl Iterator<Item = &str> {
        [&self.title, &self.memo, &self.machine].into_iter().map(String::as_str).filter(|line| !line.is_empty())
    }
}

/// The processor's name in what Linux tells of it.
fn model(cpuinfo: &str) -> Option<String> {
    let named =
        |line: &str| line.split_once(':').filter(|(key, _)| key.trim() == "model name").map(|(_, name)| words(name));
    cpuinfo.lines().find_map(named).filter(|name| !name.is_empty())
}

/// With one space between words.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_is_named_where_linux_names_it() {
        let cpuinfo = "processor\t: 0\nvendor_id\t: X\nmodel name\t: Some  CPU @ 2.00GHz\nmodel\t\t: 85\n";
        assert_eq!(model(cpuinfo).as_deref(), Some("Some CPU @ 2.00GHz"));
        assert_eq!(model("processor : 0\nBogoMIPS : 50\n"), None);
    }

    #[test]
    fn a_computer_is_described_without_its_names() {
        let here = Metadata::here(3);
        assert!(here.machine.contains("3 cores") && here.machine.ends_with(OS), "{}", here.machine);
        assert_eq!((here.title, here.memo), Default::default());
    }
}
