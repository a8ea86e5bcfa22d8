//! What several benches need: the program's report of a run, medians, and charts.

#![allow(dead_code, reason = "each bench uses a part of it")]

use std::path::Path;
use std::process::Command;

use anel::export::to_svg;
use anel::view::{CHART_SIZE, Mark};
use serde_json::Value;

/// Renders a scene, and returns the report of the run.
pub fn render(scene: &str, size: &str, out: &Path, rest: &[&str]) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_anel"))
        .args(["render", scene, "--size", size, "--json", "--out"])
        .arg(out)
        .args(rest)
        .output()
        .expect("the program can be started");
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("no figures of {scene}: {}", String::from_utf8_lossy(&output.stderr)))
}

/// Returns the median, the greater of the two middle values if their number is even; NaN for no values.
pub fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Takes `svg FILE` out of the arguments, which are those of the bench without cargo's own. Returns the file.
pub fn take_svg(arguments: &mut Vec<String>) -> Option<String> {
    let at = arguments.iter().position(|argument| argument == "svg")?;
    let file = arguments.get(at + 1).cloned().expect("svg is followed by the name of a file");
    arguments.drain(at..at + 2);
    Some(file)
}

/// Writes a chart.
pub fn write_svg(file: &str, marks: &[Mark]) {
    std::fs::write(file, to_svg(marks, CHART_SIZE)).unwrap_or_else(|error| panic!("{file}: {error}"));
}
