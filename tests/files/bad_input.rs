//! Bad scenes and arguments end with one clear sentence, exit code 2 and no file written; a full disk with exit code 1
//! and no partial file.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use tempfile::TempDir;

const GOOD: &str = "(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), objects: [Sphere(radius: 1)])";

fn anel(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_anel"))
        .current_dir(directory)
        .args(arguments)
        .output()
        .expect("the program can be started")
}

/// Renders a scene file with these contents, which must be refused. Returns the error message.
fn refused_scene(contents: impl AsRef<[u8]>) -> String {
    let directory = TempDir::new().expect("a temporary directory");
    fs::write(directory.path().join("bad.ron"), contents).expect("a file in it");
    refused(directory.path(), &["render", "bad.ron", "--out", "out.png"])
}

/// Runs the program, which must refuse with exit code 2, no output and no new file. Returns the error message.
fn refused(directory: &Path, arguments: &[&str]) -> String {
    let before = fs::read_dir(directory).expect("the directory").count();
    let output = anel(directory, arguments);
    let error = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
    assert!(output.stdout.is_empty(), "{arguments:?} printed on standard output");
    assert_eq!(fs::read_dir(directory).expect("the directory").count(), before, "{arguments:?} wrote something");
    assert!(!error.contains("panicked"), "{error}");
    error
}

#[test]
fn bad_scene_is_refused_with_line_column_and_field() {
    let with = |objects: &str| GOOD.replace("Sphere(radius: 1)", objects);
    let many =
        |head: &str, tail: &str| format!("{}{}{}", head.repeat(100_000), "Sphere(radius: 1)", tail.repeat(100_000));
    // The contents of the file, and the words that the error must contain.
    let cases: &[(String, &[&str])] = &[
        ("(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), objects: [".into(), &["line 1, column "]),
        (with("Sphere(radius: 1, colour: 3)"), &["line 1, column ", "object 1", "colour", "radius"]),
        (with("Sphere(\n  centre: (0, 0, 0),\n  radius: NaN)"), &["line 3, column ", "object 1, Sphere.radius", "NaN"]),
        (with("Sphere(radius: inf)"), &["line 1, column ", "object 1, Sphere.radius", "inf"]),
        (with("Sphere(radius: 0)"), &["line 1, column ", "object 1, Sphere.radius", "greater than 0"]),
        (with("Sphere(radius: -1)"), &["line 1, column ", "object 1, Sphere.radius", "greater than 0", "-1"]),
        (with("Sphere(centre: (0, inf, 0), radius: 1)"), &["object 1, Sphere.centre", "inf"]),
        (with("Cylinder(from: (0, 0, 0), to: (0, 1, 0), radius: 0)"), &["object 1, Cylinder.radius", "greater than 0"]),
        (with("Cylinder(from: (0, 1, 0), to: (0, 1, 0), radius: 1)"), &["line 1", "from and to"]),
        (with("Cone(from: (0, 0, 0), to: (0, 1, 0), radius: 1, to_radius: -1)"), &["line 1", "to_radius"]),
        (
            with("Cone(from: (0, 1, 0), to: (0, 0, 0), radius: 0, to_radius: 1)"),
            &["object 1, Cone.radius", "swap `from` and `to`"],
        ),
        (with("Sphere(radius: 1,5)"), &["line 1, column ", "object 1", "write 1.5, not 1,5"]),
        (with("Torus(radius: 2, tube: 0,25, material: \"m\")"), &["object 1", "write 0.25, not 0,25"]),
        (with("Sphere(centre: (0, 1,5, 0), radius: 1)"), &["object 1, Sphere.centre", "write 1.5, not 1,5"]),
        (with("Sphere(radius: 1, transform: [Rotate((0, -22,5, 0))])"), &["write -22.5, not -22,5"]),
        (GOOD.replace("eye", "field_of_view: 40,5, eye"), &["camera", "write 40.5, not 40,5"]),
        (
            GOOD.replace("objects", "materials: {\"m\": (colour: (0,1, 0,2, 0,3))}, objects"),
            &["materials.m.colour", "a decimal mark is a point"],
        ),
        (with("Box(min: (0, 0, 0), max: (1, 0, 1))"), &["line 1", "min must be below max"]),
        (with("HalfSpace(normal: (0, 0, 0))"), &["object 1, HalfSpace.normal", "length 0"]),
        (with("Torus(radius: 1, tube: 1)"), &["line 1", "tube must be less than radius"]),
        (with("Torus(radius: 1, tube: -1)"), &["line 1", "object 1, Torus.tube", "greater than 0"]),
        (with("Quadric(constant: 1)"), &["line 1", "squares, products and linear"]),
        (with("Union(of: [])"), &["line 1", "at least one solid"]),
        (with("Sphere(radius: 1, transform: [Scale((1, 0, 1))])"), &["object 1, Sphere.transform 1", "other than 0"]),
        (with("Sphere(radius: 1, material: \"gold\")"), &["line 1, column 86", "no material `gold`"]),
        (with("Use(solid: \"wheel\")"), &["line 1, column ", "no solid `wheel`"]),
        (
            with("Repeat(count: 0, step: [], of: Sphere(radius: 1))"),
            &["object 1, Repeat.count", "from 1 to 200000, not 0"],
        ),
        (
            with("Repeat(count: 1000000000, step: [], of: Sphere(radius: 1))"),
            &["object 1, Repeat.count", "not 1000000000"],
        ),
        (with("Repeat(count: 2.5, step: [], of: Sphere(radius: 1))"), &["object 1, Repeat.count", "whole number"]),
        (with("Repeat(count: 2, step: [Rotate((0, 30))], of: Sphere(radius: 1))"), &["object 1, Repeat.step 1"]),
        (with("Repeat(count: 2, step: [Scale((1, 0, 1))], of: Sphere(radius: 1))"), &["Repeat.step 1", "other than 0"]),
        (with("Repeat(count: 2, step: [], of: Sphere(radius: 0))"), &["object 1, Repeat.of", "greater than 0"]),
        (with("Repeat(count: 2, of: Sphere(radius: 1))"), &["line 1, column ", "step"]),
        (
            GOOD.replace("objects", "solids: {\"a\": Repeat(count: 2, step: [], of: Use(solid: \"a\"))}, objects"),
            &["line 1, column ", "a solid uses itself", "a → a"],
        ),
        (with("Helix(radius: 1)"), &["line 1, column ", "Torus", "Sphere"]),
        (
            GOOD.replace(
                "objects",
                "solids: {\"a\": Union(of: [Use(solid: \"b\")]), \"b\": Use(solid: \"a\")}, objects",
            ),
            &["line 1, column ", "a solid uses itself", "a → b → a"],
        ),
        (
            GOOD.replace("objects", "solids: {\"a\": Sphere(radius: 1), \"a\": Sphere(radius: 2)}, objects"),
            &["line 1, column ", "`a` is defined twice"],
        ),
        (
            GOOD.replace("objects", "materials: {\"m\": (kd: 1.5)}, objects"),
            &["line 1, column ", "materials.m.kd", "between 0 and 1", "1.5"],
        ),
        (with(&many("Union(of: [", "])")), &["line 1, column "]),
        ("(objects: [Sphere(radius: 1)])".into(), &["line 1, column ", "camera"]),
        (GOOD.replace("(0, 0, 0)", "(0, 0, 5)"), &["camera", "eye and look_at"]),
        (GOOD.replace("look_at", "field_of_view: 180, look_at"), &["camera.field_of_view", "180"]),
        (format!("{GOOD} {GOOD}"), &["line 1, column ", "follows the end"]),
        (String::new(), &["empty"]),
        (" \n\n".into(), &["empty"]),
        ("\u{0}\u{1}garbage".into(), &["line 1, column "]),
    ];
    for (text, names) in cases {
        let error = refused_scene(text);
        let start: String = text.chars().take(200).collect();
        assert_eq!(error.trim_end().lines().count(), 1, "more than one line for {start}: {error}");
        assert!(error.starts_with("anel: bad.ron: "), "the error begins with the file name: {error}");
        for name in *names {
            assert!(error.contains(name), "{name} is missing for {start}: {error}");
        }
    }
}

#[test]
fn scene_that_grows_without_bounds_is_refused() {
    // Forty names, each of which uses the one before twice: 2⁴⁰ spheres.
    let mut solids = String::from("\"s0\": Sphere(radius: 1)");
    for k in 1..=40 {
        solids += &format!(", \"s{k}\": Union(of: [Use(solid: \"s{0}\"), Use(solid: \"s{0}\")])", k - 1);
    }
    let error = refused_scene(
        GOOD.replace("objects: [Sphere(radius: 1)]", &format!("solids: {{{solids}}}, objects: [Use(solid: \"s40\")]")),
    );
    assert!(error.contains("more than 200000 primitives"), "{error}");
    // A grid of grids: 200000⁴ spheres.
    let repeat = |of: &str| format!("Repeat(count: 200000, step: [Translate((1, 0, 0))], of: {of})");
    let grid = repeat(&repeat(&repeat(&repeat("Sphere(radius: 1)"))));
    let error = refused_scene(GOOD.replace("Sphere(radius: 1)", &grid));
    assert!(error.contains("object 1: the scene has more than 200000 primitives"), "{error}");
    let error = refused_scene(
        GOOD.replace("Sphere(radius: 1)", "Repeat(count: 100, step: [Scale((1e6, 1e6, 1e6))], of: Sphere(radius: 1))"),
    );
    assert!(error.contains("too large or too small"), "{error}");
    // A chain of names deeper than any call stack.
    let mut solids = String::from("\"s0\": Sphere(radius: 1)");
    for k in 1..=100_000 {
        solids += &format!(", \"s{k}\": Use(solid: \"s{}\")", k - 1);
    }
    let error =
        refused_scene(GOOD.replace(
            "objects: [Sphere(radius: 1)]",
            &format!("solids: {{{solids}}}, objects: [Use(solid: \"s100000\")]"),
        ));
    assert!(error.contains("deep"), "{error}");
    // Transforms that underflow or overflow: 1e120 is finite, its cube is not.
    for (factor, times) in [("1e-6", 60), ("1e6", 20)] {
        let scales = format!("Scale(({factor}, {factor}, {factor})), ").repeat(times);
        let error = refused_scene(GOOD.replace("radius: 1", &format!("radius: 1, transform: [{scales}]")));
        assert!(error.contains("too large or too small"), "{error}");
    }
}

#[test]
fn file_that_is_not_a_scene_is_refused() {
    let directory = TempDir::new().expect("a temporary directory");
    let at = directory.path();
    let error = refused(at, &["render", "nowhere.ron", "--out", "out.png"]);
    assert!(
        error.contains("nowhere.ron") && error.contains("no such file") && error.contains("ten-objects"),
        "{error}"
    );
    fs::create_dir(at.join("folder.ron")).expect("a directory");
    assert!(refused(at, &["render", "folder.ron", "--out", "out.png"]).contains("directory"));
    fs::write(at.join("latin.ron"), b"(camera: (\n// caf\xe9\n").expect("a file");
    assert!(refused(at, &["render", "latin.ron", "--out", "out.png"]).contains("line 2: the file is not text"));
    // Opening a pipe would wait for a writer.
    #[cfg(unix)]
    if Command::new("mkfifo").arg(at.join("pipe.ron")).status().is_ok_and(|status| status.success()) {
        assert!(refused(at, &["render", "pipe.ron", "--out", "out.png"]).contains("not a regular file"));
    }
    // A gigabyte, too much to read to the end.
    let large = fs::File::create(at.join("large.ron")).expect("a file");
    large.set_len(1 << 30).expect("a sparse file");
    assert!(refused(at, &["render", "large.ron", "--out", "out.png"]).contains("larger than 16 MiB"));
    // The viewer's argument is refused in the same way.
    assert!(refused(at, &["nowhere.ron"]).contains("no such file"));
}

#[test]
fn bad_arguments_are_refused_before_tracing() {
    let directory = TempDir::new().expect("a temporary directory");
    let at = directory.path();
    fs::create_dir(at.join("folder")).expect("a directory");
    let cases: &[(&[&str], &str)] = &[
        (&["--size", "0x0"], "has no pixels"),
        (&["--size", "0x480"], "has no pixels"),
        (&["--size", "1000000x1000000"], "too large"),
        (&["--size", "99999999999x1"], "not a size"),
        (&["--size", "large"], "not a size"),
        (&["--size", "-1x5"], "not a size"),
        (&["--size", "11000x11000", "--atom", "1"], "too many"),
        (&["--nodes", "0"], "0 is not in 1..=1024"),
        (&["--nodes", "10000"], "10000 is not in 1..=1024"),
        (&["--speeds", "0"], "from 0.0001 to 1"),
        (&["--speeds", "-1,1"], "from 0.0001 to 1"),
        (&["--speeds", "1,NaN"], "from 0.0001 to 1"),
        (&["--speeds", "1,1e-300"], "from 0.0001 to 1"),
        (&["--speeds", "1,1", "--nodes", "3"], "3 nodes but 2 speeds"),
        (&["--speeds", ""], "speed"),
        (&["--strategy", "magic"], "ring"),
        (&["--strategy", "serial", "--nodes", "2"], "one node"),
        (&["--pace", "0"], "pace"),
        (&["--pace", "fast"], "pace"),
        (&["--atom", "0"], "0 is not in 1.."),
        (&["--samples", "0"], "0 is not in 1..=64"),
        (&["--latency", "-1"], "latency"),
        (&["--bandwidth", "0"], "bandwidth"),
        (&["--latency", "1,2,3"], "there are 4 nodes but 3 latencies"),
        (&["--bandwidth", "1e6,0"], "bandwidth"),
        (&["--parent-latency", "-1"], "parent-latency"),
        (&["--out", "missing/out.png"], "does not exist"),
        (&["--out", "folder"], "is a directory"),
        (&["--out", "new/"], "does not name a file"),
        (&["--log", "./folder/../out.png"], "would be replaced"),
        (&["--out", "/dev/null"], "not a regular file"),
        (&["--log", "missing/run.log"], "does not exist"),
        (&["--out", "out.jpg"], "a PNG picture, not .jpg; give its name the ending .png"),
        (&["--out", "OUT.SVG"], "a PNG picture, not .svg"),
        (&["--log", "run.csv"], "a run file, not .csv"),
        (&["--sise", "1x1"], "--sise"),
        (&["--strategy", "rayon", "--latency", "1"], "do not apply to rayon"),
        (&["--strategy", "rayon", "--bandwidth", "1e6"], "do not apply to rayon"),
        (&["--strategy", "rayon", "--parent-latency", "1"], "do not apply to rayon"),
        (&["--strategy", "rayon", "--handling", "1"], "do not apply to rayon"),
        (&["--strategy", "rayon", "--shared-wire"], "do not apply to rayon"),
        (&["--strategy", "rayon", "--driver", "pairs"], "only with --driver threads"),
        (&["--strategy", "rayon", "--driver", "sim"], "only with --driver threads"),
    ];
    for (arguments, names) in cases {
        let mut all = vec!["render", "glass"];
        if !arguments.contains(&"--out") {
            all.extend(["--out", "out.png"]);
        }
        all.extend(*arguments);
        let error = refused(at, &all);
        assert_eq!(error.trim_end().lines().count(), 1, "more than one line: {error}");
        assert!(error.contains(names), "{arguments:?}: {error}");
    }
}

#[test]
fn pixel_outside_the_picture_is_refused() {
    let directory = TempDir::new().expect("a temporary directory");
    let cases: &[(&[&str], &str)] = &[
        (&["--pixel", "640,0"], "there is no pixel 640,0 in a picture of 640x480"),
        (&["--pixel", "0,480"], "is 639,479"),
        (&["--pixel", "4,3", "--size", "4x3"], "is 3,2"),
        (&["--pixel", "-1,0"], "for example 320,240"),
        (&["--pixel", "5"], "for example 320,240"),
        (&["--pixel", "1,2,3"], "for example 320,240"),
        (&["--pixel", "1.5,2"], "for example 320,240"),
        (&["--pixel", "99999999999,2"], "for example 320,240"),
        (&[], "--pixel"),
        (&["--pixel", "1,1", "--samples", "0"], "0 is not in 1..=64"),
        (&["--pixel", "1,1", "--depth", "101"], "101 is not in 1..=100"),
        (&["--pixel", "1,1", "--out", "out.png"], "--out"),
    ];
    for (arguments, names) in cases {
        let error = refused(directory.path(), &[&["inspect", "glass"], *arguments].concat());
        assert_eq!(error.trim_end().lines().count(), 1, "more than one line: {error}");
        assert!(error.contains(names) && !error.contains("render --help"), "{arguments:?}: {error}");
    }
    assert!(refused(directory.path(), &["inspect", "nowhere.ron", "--pixel", "1,1"]).contains("no such file"));
}

#[test]
fn file_that_is_not_a_run_is_refused() {
    let directory = TempDir::new().expect("a temporary directory");
    let at = directory.path();
    fs::write(at.join("scene.ron"), GOOD).expect("a file in it");
    fs::write(at.join("cut.anel"), "{\"anel_run\":2,\"header\":{\"scene\":\"x").expect("a file in it");
    assert!(refused(at, &["replay", "nothing.anel"]).contains("cannot read nothing.anel"));
    assert!(refused(at, &["replay", "."]).contains("this is a directory"));
    assert!(refused(at, &["replay", "scene.ron"]).contains("this is not a run file of anel"));
    for arguments in [&["replay", "cut.anel"][..], &["cut.anel"]] {
        assert!(refused(at, arguments).contains("cut.anel, line 1: "));
    }
}

#[test]
fn output_never_replaces_the_scene() {
    let directory = TempDir::new().expect("a temporary directory");
    let at = directory.path();
    fs::write(at.join("my.ron"), GOOD).expect("a file");
    for arguments in [
        &["render", "my.ron", "--out", "my.ron"][..],
        &["render", "my.ron", "--out", "out.png", "--log", "./my.ron"],
        &["export", "my.ron", "--pov", "my.ron"],
        &["my.ron", "--log", "my.ron"],
    ] {
        assert!(refused(at, arguments).contains("would be replaced"), "{arguments:?}");
        assert_eq!(fs::read_to_string(at.join("my.ron")).expect("the scene"), GOOD);
    }
}

/// A closed pipe or a full device must not make the program panic.
#[test]
#[cfg(unix)]
fn closed_and_full_outputs_do_not_panic() {
    let directory = TempDir::new().expect("a temporary directory");
    let shell = |rest: &str| {
        let command = format!("'{}' render glass --out out.png --size 32x24 {rest}", env!("CARGO_BIN_EXE_anel"));
        let output = Command::new("bash").current_dir(directory.path()).args(["-c", &command]).output();
        let output = output.expect("a shell can be started");
        assert!(!String::from_utf8_lossy(&output.stderr).contains("panicked"), "{rest}");
        output.status.code()
    };
    assert_eq!(shell("--json | true; exit ${PIPESTATUS[0]}"), Some(0));
    assert_eq!(shell("2>&1 >/dev/null | true; exit ${PIPESTATUS[0]}"), Some(0));
    if Path::new("/dev/full").exists() {
        assert_eq!(shell("--json > /dev/full"), Some(1));
        assert_eq!(shell("2> /dev/full"), Some(0));
    }
}

#[test]
fn a_camera_inside_a_solid_renders() {
    let directory = TempDir::new().expect("a temporary directory");
    let scene = GOOD.replace("radius: 1", "radius: 50");
    fs::write(directory.path().join("inside.ron"), scene).expect("a file");
    let output = anel(directory.path(), &["render", "inside.ron", "--out", "out.png", "--size", "32x24"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), "out.png");
    assert!(directory.path().join("out.png").exists());
}

/// A limit on the size of files stands for a full disk.
#[test]
#[cfg(unix)]
fn full_disk_leaves_no_partial_file() {
    let directory = TempDir::new().expect("a temporary directory");
    fs::write(directory.path().join("out.png"), "an older picture").expect("a file");
    let render = |rest: &str| {
        let command =
            format!("trap '' XFSZ; ulimit -f 4; exec '{}' render ten-objects {rest}", env!("CARGO_BIN_EXE_anel"));
        let output = Command::new("bash").current_dir(directory.path()).args(["-c", &command]).output();
        let output = output.expect("a shell can be started");
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert!(error.contains("nothing of it was kept"), "{error}");
    };
    render("--size 320x240 --out out.png");
    let kept = fs::read_to_string(directory.path().join("out.png")).expect("the older picture");
    assert_eq!(kept, "an older picture");
    let files = || fs::read_dir(directory.path()).expect("the directory").count();
    assert_eq!(files(), 1, "the partial file is removed");
    // The picture fits; the records do not.
    render("--out small.png --size 8x8 --atom 1 --log run.log");
    assert!(!directory.path().join("run.log").exists());
}

#[test]
fn json_prints_one_object_and_nothing_else() {
    let directory = TempDir::new().expect("a temporary directory");
    for rest in [&["--speeds", "1,0.5"][..], &["--strategy", "rayon", "--speeds", "1,0.5"]] {
        let strategy = if rest.contains(&"rayon") { ("rayon", "rayon") } else { ("ring", "threads") };
        let mut arguments = vec!["render", "glass", "--out", "out.png", "--size", "64x48", "--json"];
        arguments.extend(rest);
        let report = json(directory.path(), &arguments);
        assert_eq!((&report["strategy"], &report["driver"]), (&strategy.0.into(), &strategy.1.into()));
        assert_eq!((&report["nodes"], &report["rays"]["primary"]), (&2.into(), &(64 * 48).into()));
        let by_node = report["atoms_by_node"].as_array().expect("a list");
        assert_eq!(
            by_node.iter().filter_map(serde_json::Value::as_u64).sum::<u64>(),
            report["atoms"].as_u64().expect("a number")
        );
    }
}

/// Runs the program, which must print one JSON object with all its fields. Returns the object.
fn json(directory: &Path, arguments: &[&str]) -> serde_json::Value {
    let output = anel(directory, arguments);
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).expect("text");
    assert_eq!(text.trim_end().lines().count(), 1);
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    for field in "scene width height strategy driver nodes wall_s makespan_s work_s ideal_s efficiency overhead \
                  finish_spread_s rays atoms atoms_by_node messages compiled"
        .split_whitespace()
    {
        assert!(report.get(field).is_some(), "{field} is missing");
    }
    for field in ["primary", "shadow", "reflected", "refracted"] {
        assert!(report["rays"][field].is_u64(), "rays.{field}");
    }
    for field in ["requests", "offers", "hops", "transfers", "atoms_moved", "bytes"] {
        assert!(report["messages"][field].is_u64(), "messages.{field}");
    }
    report
}
