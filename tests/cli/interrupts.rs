//! Signals: an interrupted run keeps its picture and its records so far, and no command leaves a temporary file.

use std::ffi::OsString;
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use anel::runlog::RunLog;
use tempfile::TempDir;

const STEP: Duration = Duration::from_millis(20);

fn start(directory: &Path, arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_anel"));
    command.current_dir(directory).args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().expect("the program can be started")
}

/// Sends a signal, waits for the end, and returns the exit code with both outputs.
fn interrupted(mut program: Child, signal: &str) -> (Option<i32>, String, String) {
    let sent = Command::new("kill").args([signal, &program.id().to_string()]).status().expect("`kill` is installed");
    assert!(sent.success());
    let status = program.wait().expect("a child");
    let (mut out, mut err) = (String::new(), String::new());
    program.stdout.take().expect("it is piped").read_to_string(&mut out).expect("text");
    program.stderr.take().expect("it is piped").read_to_string(&mut err).expect("text");
    (status.code(), out, err)
}

fn names(directory: &Path) -> Vec<OsString> {
    let entries = fs::read_dir(directory).expect("the directory");
    let mut names: Vec<_> = entries.map(|entry| entry.expect("an entry").file_name()).collect();
    names.sort();
    names
}

/// At this pace a run lasts for hours.
const SLOW: [&str; 8] = ["render", "glass", "--out", "part.png", "--log", "run.anel", "--pace", "0.0005"];

#[test]
fn interrupted_render_writes_its_picture_and_its_records() {
    for (signal, code, json) in [("-TERM", 143, false), ("-INT", 130, true)] {
        let directory = TempDir::new().expect("a temporary directory");
        let rest: &[&str] = if json { &["--json"] } else { &[] };
        let program = start(directory.path(), &[&SLOW, rest].concat());
        // Enough for some atoms. With none the picture is black, and the test still holds.
        sleep(25 * STEP);
        let (status, out, err) = interrupted(program, signal);
        assert_eq!(status, Some(code), "{err}");
        assert!(
            err.contains("the run was interrupted: part.png has ") && err.contains("run.anel the records"),
            "{err}"
        );
        assert_eq!(image::image_dimensions(directory.path().join("part.png")).expect("a PNG"), (640, 480));
        let log = RunLog::load(&directory.path().join("run.anel")).expect("a whole run file");
        assert!(log.cut_off_at().is_none() && !log.records().is_empty());
        assert_eq!(names(directory.path()), ["part.png", "run.anel"]);
        if json {
            let report: serde_json::Value = serde_json::from_str(&out).expect("one JSON object");
            assert_eq!((&report["interrupted"], &report["atoms"]), (&true.into(), &6144.into()));
        } else {
            assert_eq!(out.trim(), "part.png");
        }
    }
}

#[test]
fn interrupted_run_in_virtual_time_writes_the_traced_part() {
    let directory = TempDir::new().expect("a temporary directory");
    let size = ["--driver", "sim", "--size", "1600x1200", "--samples", "16"];
    let program = start(directory.path(), &[&SLOW[..6], &size].concat());
    sleep(50 * STEP);
    let (status, _, err) = interrupted(program, "-TERM");
    assert_eq!(status, Some(143), "{err}");
    let picture = image::open(directory.path().join("part.png")).expect("a PNG").to_rgb8();
    assert!(picture.pixels().any(|pixel| pixel.0 != [0; 3]), "nothing is traced: {err}");
    RunLog::load(&directory.path().join("run.anel")).expect("a whole run file");
    assert_eq!(names(directory.path()), ["part.png", "run.anel"]);
}

#[test]
fn no_signal_leaves_a_temporary_file() {
    let directory = TempDir::new().expect("a temporary directory");
    let at = directory.path();
    let run = ["render", "csg-primer", "--out", "p.png", "--size", "64x48", "--driver", "sim", "--log", "run.anel"];
    assert!(start(at, &run).wait().expect("a child").success());
    let before = names(at);
    for (signal, code) in [("-INT", 130), ("-TERM", 143), ("-HUP", 129)] {
        let program = start(at, &["export", "run.anel", "--gif", "run.gif", "--width", "1920", "--seconds", "120"]);
        while names(at).len() == before.len() {
            sleep(STEP);
        }
        let (status, _, err) = interrupted(program, signal);
        assert_eq!(status, Some(code), "{err}");
        assert_eq!(names(at), before, "{signal}");
    }
}
