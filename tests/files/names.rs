//! Names and contents of files as other programs and people make them: paths that are not UTF-8, byte order marks, runs
//! that are cut off.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use tempfile::TempDir;

const SCENE: &str = "(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), objects: [Sphere(radius: 1)])";

fn anel<I: AsRef<std::ffi::OsStr>>(directory: &Path, arguments: impl IntoIterator<Item = I>) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_anel"));
    command.current_dir(directory).args(arguments);
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
    command.output().expect("the program can be started")
}

/// Renders a small picture of the scene file `my.ron`, and keeps the run.
fn render(directory: &Path) -> Output {
    let rest = ["--size", "32x24", "--driver", "sim", "--log", "run.anel"];
    anel(directory, ["render", "my.ron", "--out", "p.png"].iter().chain(&rest))
}

#[test]
#[cfg(target_os = "linux")]
fn paths_that_are_not_utf_8_can_be_read_and_written() {
    use std::ffi::{OsStr, OsString};
    use std::os::unix::ffi::OsStrExt;

    let directory = TempDir::new().expect("a temporary directory");
    let name = |ending: &str| OsString::from(OsStr::from_bytes(&[b"caf\xe9", ending.as_bytes()].concat()));
    let succeeds = |arguments: &[&OsStr]| {
        let output = anel(directory.path(), arguments);
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        output.stdout
    };
    let os = |text: &'static str| OsStr::new(text);
    fs::write(directory.path().join(name(".ron")), SCENE).expect("a file");
    let [scene, out, log] = [name(".ron"), name(".png"), name(".anel")];
    let said = succeeds(&[os("render"), &scene, os("--out"), &out, os("--size"), os("32x24"), os("--log"), &log]);
    assert_eq!(said, b"caf\xe9.png\n");
    succeeds(&[os("inspect"), &scene, os("--pixel"), os("1,1"), os("--size"), os("32x24")]);
    succeeds(&[os("export"), &scene, os("--pov"), &name(".pov")]);
    succeeds(&[os("export"), &log, os("--csv"), &name(".csv"), os("--timeline"), &name(".svg")]);
    assert!(succeeds(&[&log]).ends_with(b".png\n"), "a run without a window");
    let lesson = "Lesson(title: \"A\", about: \"B\", runs: {\"one\": (scene: \"ball.ron\", size: (32, 24))}, \
         steps: [(say: \"C\", run: \"one\", holds: [(figure: Ends, at_least: 1)])])";
    let inner = directory.path().join(name(""));
    fs::create_dir(&inner).expect("a directory");
    fs::write(inner.join("ball.ron"), SCENE).expect("a file");
    fs::write(inner.join("lesson.ron"), lesson).expect("a file");
    succeeds(&[os("lesson"), inner.join("lesson.ron").as_os_str()]);
}

#[test]
fn byte_order_mark_is_no_error() {
    let directory = TempDir::new().expect("a temporary directory");
    let at = |name: &str| directory.path().join(name);
    let with_mark = |text: &str| format!("\u{feff}{text}");
    fs::write(at("my.ron"), with_mark(SCENE)).expect("a file");
    assert!(render(directory.path()).status.success());
    let run = fs::read_to_string(at("run.anel")).expect("a run");
    assert!(!run.contains('\u{feff}'), "the mark is not part of the scene");
    fs::write(at("run.anel"), with_mark(&run)).expect("a file");
    fs::write(at("lesson.ron"), with_mark("Lesson(title: \"A\", about: \"B\", runs: {}, steps: [])")).expect("a file");
    assert!(anel(directory.path(), ["export", "run.anel", "--csv", "r.csv"]).status.success());
    let said = anel(directory.path(), ["lesson", "lesson.ron"]).stderr;
    assert!(!String::from_utf8_lossy(&said).contains("column 1:"), "{}", String::from_utf8_lossy(&said));
    let utf_16: Vec<u8> = with_mark(SCENE).encode_utf16().flat_map(u16::to_le_bytes).collect();
    fs::write(at("my.ron"), utf_16).expect("a file");
    let said = String::from_utf8_lossy(&render(directory.path()).stderr).into_owned();
    assert!(said.contains("UTF-16; save it as UTF-8"), "{said}");
}

#[test]
fn run_that_is_cut_off_is_used_up_to_there_and_says_so() {
    let directory = TempDir::new().expect("a temporary directory");
    fs::write(directory.path().join("my.ron"), SCENE).expect("a file");
    assert!(render(directory.path()).status.success());
    let run = fs::read_to_string(directory.path().join("run.anel")).expect("a run");
    let (kept, _) = run.split_at(run.len() * 2 / 3);
    let kept = kept.trim_end();
    fs::write(directory.path().join("run.anel"), &kept[..kept.len() - 3]).expect("a file");
    let line = kept.lines().count();
    let exported = anel(directory.path(), ["export", "run.anel", "--csv", "r.csv"]);
    let said = String::from_utf8_lossy(&exported.stderr).into_owned();
    assert!(exported.status.success() && said.contains(&format!("run.anel is cut off in line {line}")), "{said}");
    let rows = fs::read_to_string(directory.path().join("r.csv")).expect("a table").lines().count();
    // The header's line became that of the columns, and the cut line is left out.
    assert_eq!(rows, line - 1);
    let said = anel(directory.path(), ["run.anel"]).stderr;
    assert!(String::from_utf8_lossy(&said).contains("is cut off in line"), "{}", String::from_utf8_lossy(&said));
}
