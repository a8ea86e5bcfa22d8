//! Metadata of a run for its readers: title, notes and computer.

use std::env::consts::{ARCH, OS};
use std::fs;

use serde::{Deserialize, Serialize};

/// Metadata of a run for its readers. It has no effect on the run; an empty text means that nothing was given.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Metadata {
    /// Title of the run.
    pub title: String,
    /// Notes on the run.
    pub memo: String,
    /// Computer of the run: processor, cores and system, but neither its name nor its owner.
    pub machine: String,
}

impl Metadata {
    /// Creates the metadata of a run on this computer, which has `cores` cores.
    pub fn here(cores: usize) -> Self {
        let processor = fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| model(&text));
        let processor = processor.unwrap_or_else(|| ARCH.to_owned());
        let plural = if cores == 1 { "" } else { "s" };
        Self { machine: format!("{processor}, {cores} core{plural}, {OS}"), ..Self::default() }
    }

    /// Returns whether all texts are empty.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Returns the texts that are not empty.
    pub fn lines(&self) -> impl Iterator<Item = &str> {
        [&self.title, &self.memo, &self.machine].into_iter().map(String::as_str).filter(|line| !line.is_empty())
    }
}

/// Returns the name of the processor in the text of `/proc/cpuinfo`.
fn model(cpuinfo: &str) -> Option<String> {
    let named =
        |line: &str| line.split_once(':').filter(|(key, _)| key.trim() == "model name").map(|(_, name)| words(name));
    cpuinfo.lines().find_map(named).filter(|name| !name.is_empty())
}

/// Returns the text with one space between words.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn processor_name_is_read_from_cpuinfo() {
        let cpuinfo = "processor\t: 0\nvendor_id\t: X\nmodel name\t: Some  CPU @ 2.00GHz\nmodel\t\t: 85\n";
        assert_eq!(model(cpuinfo).as_deref(), Some("Some CPU @ 2.00GHz"));
        assert_eq!(model("processor : 0\nBogoMIPS : 50\n"), None);
    }

    #[test]
    fn computer_is_described_by_cores_and_system_only() {
        let here = Metadata::here(3);
        assert!(here.machine.contains("3 cores") && here.machine.ends_with(OS), "{}", here.machine);
        assert_eq!((here.title, here.memo), Default::default());
    }
}
