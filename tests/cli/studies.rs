//! Studies on the command line: other programs can read their files, and a refused study writes nothing.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use anel::picture::Size;
use anel::scene::Opened;
use anel::study::{Study, accuracy};
use serde_json::Value;
use tempfile::TempDir;

fn study(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_anel"))
        .current_dir(directory)
        .arg("study")
        .args(arguments)
        .output()
        .expect("the program can be started")
}

#[test]
fn study_writes_rows_charts_and_a_report_with_them() {
    let directory = TempDir::new().unwrap();
    let output = study(directory.path(), &["scale", "--out", "new/scale", "--json"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let output_json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(output_json["study"], "scale");
    let (mut charts, mut report, mut table) = (Vec::new(), String::new(), String::new());
    for file in output_json["files"].as_array().unwrap() {
        let path = file.as_str().unwrap();
        let text = fs::read_to_string(directory.path().join(path)).unwrap();
        match path.rsplit_once('.').unwrap().1 {
            "svg" => {
                let chart = roxmltree::Document::parse(&text).unwrap();
                assert_eq!(chart.root_element().tag_name().name(), "svg");
                charts.push(path.rsplit_once('/').unwrap().1);
            }
            "md" => report = text,
            "csv" => table = text,
            other => panic!("an unexpected kind of file: {other}"),
        }
    }
    for chart in &charts {
        assert!(report.contains(&format!("]({chart})")), "{chart} is missing in the report");
    }
    assert!(!charts.is_empty() && !report.contains("NaN"), "{report}");

    let rows = output_json["rows"].as_array().unwrap();
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let columns: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let records: Vec<_> = reader.records().map(Result::unwrap).collect();
    assert_eq!(records.len(), rows.len());
    for (record, row) in records.iter().zip(rows) {
        assert_eq!(row.as_object().unwrap().len(), columns.len());
        for (column, text) in columns.iter().zip(record) {
            let same = match &row[column] {
                Value::Number(number) => text.parse::<f64>().ok() == number.as_f64(),
                Value::Null => text.is_empty(),
                Value::String(string) => text == string,
                Value::Bool(is) => text.parse() == Ok(*is),
                other => panic!("{other} in a table"),
            };
            assert!(same, "{column}: {text} is not {}", row[column]);
        }
        // Every run ends, and none is faster than ideal.
        let efficiency = row["efficiency"].as_f64().unwrap();
        assert!(efficiency > 0.0 && efficiency < 1.0 + 1e-9, "{row}");
    }
}

#[test]
fn accuracy_is_the_same_every_time_except_for_cpu_seconds() {
    let scenes = ["csg-primer", "machine-part"].map(|name| Opened::new(name).unwrap());
    let take = || {
        let (mut reported, mut steps) = (0, 0);
        let mut report_step = |done: usize, of: usize, _: &str| {
            assert_eq!(done, reported, "each step is reported once");
            (reported, steps) = (reported + 1, of);
        };
        let study = accuracy(&scenes, Size::new(12, 9).unwrap(), &mut report_step).unwrap();
        assert_eq!(reported, steps);
        study
    };
    let (one, other): (Study, Study) = (take(), take());
    let mut knobs: Vec<&str> = one.rows.iter().map(|row| row["knob"].as_str().unwrap()).collect();
    knobs.dedup();
    assert_eq!(knobs, ["samples", "threshold", "depth", "cutoff", "together"].repeat(2));
    for (row, again) in one.rows.iter().zip(&other.rows) {
        let (row, again) = (row.as_object().unwrap(), again.as_object().unwrap());
        let differing: Vec<&String> = row.keys().filter(|key| row[*key] != again[*key]).collect();
        assert!(differing.is_empty() || differing == ["cpu_s"], "{differing:?}");
        assert!(row["cpu_s"].as_f64().unwrap() > 0.0 && row["rmse"].as_f64().unwrap() > 0.0);
        assert!(row["worst_ssim"].as_f64().unwrap() <= 1.0 && row["wrong_pixels"].as_u64().unwrap() <= 12 * 9);
    }
    let text = |name: &str| {
        let found = one.files.iter().find(|(file, _)| file == name).unwrap_or_else(|| panic!("{name} is missing"));
        String::from_utf8(found.1.clone()).unwrap()
    };
    let report = text("accuracy.md");
    assert!(!report.contains("NaN") && !report.contains("inf"), "{report}");
    for (file, _) in one.files.iter().filter(|(file, _)| !file.ends_with(".md")) {
        match file.ends_with(".svg") {
            true => assert!(roxmltree::Document::parse(&text(file)).is_ok() && report.contains(&format!("]({file})"))),
            false => assert!(report.contains(&format!("`{file}`")), "{file} is not named in the report"),
        }
    }
}

#[test]
fn impossible_study_is_refused_at_once() {
    let directory = TempDir::new().unwrap();
    fs::write(directory.path().join("file"), "kept").unwrap();
    for (arguments, named) in [
        (&["scale", "--out", "file"][..], "file"),
        (&["paper", "--out", "file/below"], "file/below"),
        (&["paper", "--scene", "no-such-scene"], "no-such-scene"),
        (&["rivals", "--scene", "file"], "file"),
        (&["stability", "--scene", "glass"], "--scene"),
        (&["everything"], "everything"),
    ] {
        let output = study(directory.path(), arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(error.contains(named) && !error.contains("panicked"), "{arguments:?}: {error}");
        assert!(output.stdout.is_empty());
    }
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1, "a refused study wrote a file");
    assert_eq!(fs::read_to_string(directory.path().join("file")).unwrap(), "kept");
}
