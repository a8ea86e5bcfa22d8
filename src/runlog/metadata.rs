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

    /// Returns the lines of all texts.
    pub fn lines(&self) -> impl Iterator<Item = String> {
        [&self.title, &self.memo, &self.machine].into_iter().flat_map(|text| text_lines(text))
    }
}

/// Splits a title or a memo into lines: at line breaks, and at `\n`, as a line break is typed on the command line.
pub fn text_lines(text: &str) -> impl Iterator<Item = String> {
    let text = text.replace("\\n", "\n");
    let lines: Vec<_> = text.lines().map(|line| line.trim().to_owned()).filter(|line| !line.is_empty()).collect();
    lines.into_iter()
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
    fn memo_breaks_at_real_and_typed_line_breaks() {
        assert_eq!(text_lines(" one\\ntwo\n\n three ").collect::<Vec<_>>(), ["one", "two", "three"]);
    }

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
