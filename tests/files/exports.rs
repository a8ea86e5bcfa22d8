//! The files of `anel export`, read back by other programs and libraries.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use anel::runlog::RunLog;
use tempfile::TempDir;

fn anel(directory: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_anel"));
    command.current_dir(directory).args(arguments).output().expect("the program can be started")
}

/// Checks that the program succeeded; prints its error message otherwise.
fn assert_success(output: &Output) {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// Runs the program, which must refuse its arguments in one line. Returns the error message.
fn refused(directory: &Path, arguments: &[&str]) -> String {
    let output = anel(directory, arguments);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert_eq!(said.trim().lines().count(), 1, "{said}");
    said
}

/// A directory with `run.anel`, a short run with a title, and its picture `run.png`.
fn recorded() -> TempDir {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let run = [
        "render",
        "csg-primer",
        "--out",
        "run.png",
        "--size",
        "160x120",
        "--log",
        "run.anel",
        "--title",
        "A <slow> third",
    ];
    let slow = ["--memo", "for a talk", "--driver", "sim", "--speeds", "1,1,0.1", "--pace", "0.01", "--latency", "5"];
    assert_success(&anel(directory.path(), &[&run[..], &slow].concat()));
    directory
}

/// Whether a program is installed. Without it a test is skipped with a message, or fails if `CI` is set.
fn is_installed(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let found = std::env::split_paths(&path).any(|directory| directory.join(program).is_file());
    if !found {
        assert!(std::env::var_os("CI").is_none(), "{program} is not installed");
        eprintln!("\n*** SKIPPED: exports were NOT read by {program}, which is not installed ***\n");
    }
    found
}

fn pixels(path: &Path) -> image::RgbImage {
    image::open(path).expect("a picture").to_rgb8()
}

/// Mean difference of two pictures of one size, for each channel of each pixel, from 0 to 255.
fn mean_difference(one: &image::RgbImage, other: &image::RgbImage) -> f64 {
    assert_eq!(one.dimensions(), other.dimensions());
    let sum: u64 = one.iter().zip(other.iter()).map(|(one, other)| u64::from(one.abs_diff(*other))).sum();
    sum as f64 / one.len() as f64
}

#[test]
fn one_command_writes_several_files() {
    let directory = recorded();
    let at = |name: &str| directory.path().join(name);
    let files =
        ["--csv", "r.csv", "--trace", "r.json", "--ring", "ring.svg", "--timeline", "line.svg", "--png", "large.png"];
    assert_success(&anel(
        directory.path(),
        &[&["export", "run.anel"], &files[..], &["--size", "320x120", "--at", "0.5"]].concat(),
    ));
    let log = RunLog::load(&at("run.anel")).expect("the run");
    let rows = fs::read_to_string(at("r.csv")).expect("a table").lines().count();
    assert_eq!(rows, 1 + log.records().len());
    let trace: serde_json::Value = serde_json::from_slice(&fs::read(at("r.json")).expect("a trace")).expect("JSON");
    assert_eq!(trace["otherData"]["title"], "A <slow> third");
    for drawing in ["ring.svg", "line.svg"] {
        let text = fs::read_to_string(at(drawing)).expect("a drawing");
        let document = roxmltree::Document::parse(&text).expect("XML");
        let said: Vec<_> = document.descendants().filter_map(|node| node.text()).collect();
        assert!(said.contains(&"A <slow> third") && said.contains(&"for a talk"), "{drawing}: {said:?}");
    }
    assert_eq!(pixels(&at("large.png")).dimensions(), (320, 120));
    let left: Vec<_> =
        fs::read_dir(directory.path()).expect("the directory").map(|file| file.unwrap().file_name()).collect();
    assert_eq!(left.len(), 7, "{left:?}");
}

#[test]
fn exported_picture_is_the_rendered_one() {
    let directory = recorded();
    assert_success(&anel(directory.path(), &["export", "run.anel", "--png", "again.png"]));
    assert!(pixels(&directory.path().join("again.png")) == pixels(&directory.path().join("run.png")));
}

#[test]
fn film_ends_with_the_picture() {
    let directory = recorded();
    let at = |name: &str| directory.path().join(name);
    assert_success(&anel(
        directory.path(),
        &["export", "run.anel", "--gif", "run.gif", "--seconds", "2", "--width", "160"],
    ));
    if !is_installed("convert") || !is_installed("identify") {
        return;
    }
    let run = |program: &str, arguments: &[&str]| {
        let output =
            Command::new(program).args(arguments).current_dir(directory.path()).output().expect("an installed program");
        assert_success(&output);
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    run("convert", &["run.gif", "-coalesce", "-delete", "0--2", "last.png"]);
    let (last, picture) = (pixels(&at("last.png")), pixels(&at("run.png")));
    // The picture is left of the ring, in its own size, vertically centred.
    let top = (last.height() - picture.height() - 44) / 2;
    let shown = image::imageops::crop_imm(&last, 16, top, picture.width(), picture.height()).to_image();
    let difference = mean_difference(&shown, &picture);
    assert!(difference < 3.0, "{difference}");
    let delays = run("identify", &["-format", "%T ", "run.gif"]);
    let delays: Vec<u32> = delays.split_whitespace().map(|delay| delay.parse().expect("a number")).collect();
    assert_eq!((delays.len(), delays.last()), (27, Some(&300)), "{delays:?}");
    // Two seconds of the run, then the last picture.
    assert_eq!(delays[..delays.len() - 2].iter().sum::<u32>(), 200);
}

#[test]
fn drawings_look_alike_in_another_renderer() {
    let directory = recorded();
    let at = |name: &str| directory.path().join(name);
    for (option, name) in [("--ring", "ring"), ("--timeline", "line")] {
        let [svg, png] = ["svg", "png"].map(|ending| format!("{name}.{ending}"));
        assert_success(&anel(directory.path(), &["export", "run.anel", option, &svg]));
        assert_success(&anel(directory.path(), &["export", "run.anel", option, &png]));
        if !is_installed("rsvg-convert") {
            return;
        }
        let other = format!("{name}-other.png");
        let convert = Command::new("rsvg-convert")
            .args(["--zoom", "2", &svg, "-o", &other])
            .current_dir(directory.path())
            .output();
        assert_success(&convert.expect("an installed program"));
        let difference = mean_difference(&pixels(&at(&png)), &pixels(&at(&other)));
        // The fonts differ; an empty page would differ by more.
        assert!(difference < 8.0, "{name}: {difference}");
    }
}

#[test]
fn impossible_export_is_refused_in_one_sentence() {
    let directory = recorded();
    let refused = |arguments: &[&str]| refused(directory.path(), arguments);
    let said = refused(&["export", "ten-objects", "--csv", "r.csv"]);
    assert!(said.contains("ten-objects is a scene") && said.contains("--log RUN.anel"), "{said}");
    let said = refused(&["export", "ten-objects", "--pov", "s.pov", "--gif", "r.gif"]);
    assert!(said.contains("r.gif is made of a recorded run"), "{said}");
    let said = refused(&["export", "run.anel", "--pov", "s.pov"]);
    assert!(said.contains("run.anel is a recorded run") && said.contains("made of a scene"), "{said}");
    let said = refused(&["export", "run.anel", "--ring", "ring.jpg"]);
    assert!(said.contains("ring.jpg is drawn as .svg or .png"), "{said}");
    for (option, name) in [("--png", "x.jpg"), ("--gif", "x.mp4"), ("--csv", "x.xlsx"), ("--trace", "x.csv")] {
        let said = refused(&["export", "run.anel", option, name]);
        assert!(said.contains(name) && said.contains("give its name the ending"), "{said}");
    }
    assert!(refused(&["export", "ten-objects", "--pov", "scene.ron"]).contains("the ending .pov"));
    assert!(refused(&["export", "run.anel"]).contains("required"));
    assert!(refused(&["export", "run.anel", "--at", "1", "--csv", "r.csv"]).contains("--ring"));
    assert!(refused(&["export", "run.anel", "--ring", "r.svg", "--at", "-1"]).contains("--at"));
    let said = refused(&["export", "run.anel", "--csv", "same", "--trace", "same"]);
    assert!(said.contains("would be replaced"), "{said}");
    assert!(refused(&["export", "run.anel", "--csv", "run.anel"]).contains("would be replaced"));
    assert!(refused(&["render", "csg-primer", "--out", "x.png", "--title", "lost"]).contains("--log"));
    let left: Vec<_> =
        fs::read_dir(directory.path()).expect("the directory").map(|file| file.unwrap().file_name()).collect();
    assert_eq!(left.len(), 2, "a refused command wrote a file: {left:?}");
}

#[test]
fn scene_is_exported_for_povray_at_any_size() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let exported = |size: &[&str]| {
        let output = anel(directory.path(), &[&["export", "ten-objects", "--pov", "scene.pov"], size].concat());
        assert_success(&output);
        assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
        fs::read_to_string(directory.path().join("scene.pov")).expect("a scene")
    };
    let usual = exported(&[]);
    assert!(usual.contains("right -x*image_width/image_height") && usual.contains("+W640 +H480"), "{}", &usual[..400]);
    // Only the example in the comment changes.
    assert_eq!(exported(&["--size", "300x900"]).replace("+W300 +H900", "+W640 +H480"), usual);
}

#[test]
fn export_says_what_povray_shows_in_another_way() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let scene = r#"Scene(camera: (eye: (0, 0, 9), look_at: (0, 0, 0)), materials: {
        "glass": (ka: 0, kd: 0, ks: 0.1, kt: 0.9, ior: 1.5), "lossy": (ka: 0, kd: 0, ks: 0.1, kt: 0.7, ior: 1.5)},
        objects: [Sphere(radius: 1, material: "glass"), Sphere(radius: 1, centre: (1, 0, 0), material: "lossy")])"#;
    fs::write(directory.path().join("two.ron"), scene).expect("a scene");
    let output = anel(directory.path(), &["export", "two.ron", "--pov", "two.pov"]);
    assert_success(&output);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let text = fs::read_to_string(directory.path().join("two.pov")).expect("a scene");
    let comments: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("// ")).collect();
    assert_eq!(said.lines().count(), 2, "{said}");
    for (line, part) in said.lines().zip(["objects 1 and 2 transmit light", "`lossy` reflects Ks + Kt = 0.7"]) {
        let line = line.strip_prefix("anel: ").expect("the program's name");
        assert!(line.contains(part) && comments.contains(&format!("{line}.").as_str()), "{line}");
    }
}
