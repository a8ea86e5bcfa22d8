//! Pictures that the command line writes: regions, transparency, and the colours of owners and costs.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use anel::palette::node_colours;
use anel::picture::{Frame, Quality, Size};
use anel::runlog::RunLog;
use anel::scene::{Scene, built_in};
use anel::tracer::{Scratch, Tracer};
use anel::view::{Layer, RunState, picture_pixels};
use serde_json::Value;

/// All ways to execute a run.
const RUNS: [&[&str]; 10] = [
    &["--strategy", "serial"],
    &["--strategy", "static"],
    &["--strategy", "static-estimate"],
    &["--strategy", "farm"],
    &["--strategy", "farm-by-speed"],
    &["--strategy", "ring"],
    &["--strategy", "adaptive"],
    &["--strategy", "rayon"],
    &["--driver", "pairs"],
    &["--driver", "sim", "--speeds", "1,0.3"],
];

/// A mirror ball before a background, and a box.
const BALL: &str = r#"Scene(camera: (eye: (0, 1, 7), look_at: (0, 0, 0)), background: (0.3, 0.5, 0.8),
    ambient: (0.3, 0.3, 0.3), lights: [Point(position: (3, 6, 5))], materials: {"mirror": (ka: 0.2, ks: 0.6)},
    objects: [Sphere(centre: (-0.5, 0, 0), radius: 1.2, material: "mirror"), Box(min: (0.9, -1, -1), max: (2, 1, 0))])"#;

fn render(directory: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_anel"));
    command
        .current_dir(directory)
        .args(arguments)
        .args(["--size", "60x45"])
        .output()
        .expect("the program can be started")
}

/// Runs the program, which must succeed. Returns its output.
fn rendered(directory: &Path, arguments: &[&str]) -> String {
    let output = render(directory, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn region_is_rendered_alone_by_every_strategy() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let picture = |name: &str| image::open(directory.path().join(name)).expect("a picture").to_rgb8();
    rendered(directory.path(), &["render", "glass", "--out", "whole.png", "--samples", "2"]);
    let crop = image::imageops::crop_imm(&picture("whole.png"), 17, 11, 21, 13).to_image();
    for run in RUNS {
        let part = ["render", "glass", "--out", "part.png", "--samples", "2", "--region", "17,11,21,13", "--json"];
        let said = rendered(directory.path(), &[&part[..], run].concat());
        assert!(picture("part.png") == crop, "{run:?}");
        let report: Value = serde_json::from_str(&said).expect("JSON");
        assert_eq!((&report["width"], &report["region"]), (&60.into(), &serde_json::json!([17, 11, 21, 13])));
        assert_eq!(report["atoms"], (21_u32 * 13).div_ceil(50));
        let primary = &report["rays"]["primary"];
        assert_eq!(*primary, 21 * 13 * 4, "{run:?} traced other pixels");
    }
}

#[test]
fn impossible_region_is_refused_in_one_sentence() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    for (arguments, reason) in [
        (&["--region", "50,0,11,5"][..], "not inside the picture of 60x45"),
        (&["--region", "0,0,0,5"], "has no pixels"),
        (&["--region", "1,2,3"], "X,Y,WIDTH,HEIGHT"),
        (&["--region", "-1,2,3,4"], "X,Y,WIDTH,HEIGHT"),
        (&["--region", "0,0,5,5", "--log", "run.anel"], "keeps a whole picture"),
        (&["--region", "0,0,5,5", "--driver", "sim", "--costs", "run.anel"], "leave out --costs or --region"),
        (&["--owners-png", "x.png"], "x.png would be replaced"),
        (&["--costs-png", "/no/such/place.png"], "does not exist"),
    ] {
        let output = render(directory.path(), &[&["render", "glass", "--out", "x.png"][..], arguments].concat());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && said.contains(reason), "{arguments:?}: {said}");
        assert_eq!(said.trim().lines().count(), 1, "{said}");
    }
    assert!(fs::read_dir(directory.path()).expect("the directory").next().is_none());
}

#[test]
fn transparent_picture_is_the_same_by_every_strategy() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let picture = |name: &str| image::open(directory.path().join(name)).expect("a picture");
    fs::write(directory.path().join("ball.ron"), BALL).expect("a scene");
    let transparent = ["render", "ball.ron", "--samples", "3", "--threshold", "0.02", "--transparent"];
    let layers = ["--out", "first.png", "--owners-png", "owners.png", "--strategy", "serial"];
    rendered(directory.path(), &[&transparent[..], &layers].concat());
    let first = picture("first.png");
    assert_eq!(first.color(), image::ColorType::Rgba8);
    let first = first.to_rgba8();
    let with = |wanted: fn(u8) -> bool| first.pixels().filter(|pixel| wanted(pixel.0[3])).count();
    let (clear, edge, solid) = (with(|a| a == 0), with(|a| a % 255 != 0), with(|a| a == 255));
    assert!(clear > 100 && edge > 50 && solid > 100, "{clear} clear, {edge} at edges, {solid} solid");
    for run in RUNS {
        rendered(directory.path(), &[&transparent[..], &["--out", "next.png"], run].concat());
        assert!(picture("next.png").to_rgba8() == first, "{run:?}");
    }
    // The colours of the nodes are those of the opaque picture.
    let opaque = ["render", "ball.ron", "--samples", "3", "--out", "opaque.png", "--owners-png", "its-owners.png"];
    rendered(directory.path(), &[&opaque[..], &["--strategy", "serial"]].concat());
    let (owners, its) = (picture("owners.png").to_rgb8(), picture("its-owners.png").to_rgb8());
    let far = owners.iter().zip(its.iter()).filter(|(one, other)| one.abs_diff(**other) > 12).count();
    assert!(owners.dimensions() == its.dimensions() && far < owners.len() / 50, "{far} of {} differ", owners.len());
}

#[test]
fn owner_and_cost_pictures_are_those_that_the_window_saves() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let file = |name: &str| fs::read(directory.path().join(name)).expect("a file");
    let run =
        ["render", "ten-objects", "--out", "x.png", "--log", "run.anel", "--speeds", "1,1,0.2", "--driver", "sim"];
    rendered(directory.path(), &[&run[..], &["--owners-png", "owners.png", "--costs-png", "costs.png"]].concat());
    let export =
        ["export", "run.anel", "--owners-png", "owners-2.png", "--costs-png", "costs-2.png", "--png", "large.png"];
    rendered(directory.path(), &[&export[..], &["--transparent"]].concat());
    assert!(file("owners.png") == file("owners-2.png") && file("costs.png") == file("costs-2.png"));
    assert!(file("owners.png") != file("costs.png") && file("owners.png") != file("x.png"));
    assert_eq!(image::open(directory.path().join("large.png")).expect("a picture").color(), image::ColorType::Rgba8);

    let log = RunLog::load(&directory.path().join("run.anel")).expect("a run file");
    let scene = Scene::parse(built_in("ten-objects").expect("it is built in")).expect("a scene");
    let (size, mut pixels) = (Size::new(60, 45).unwrap(), Vec::new());
    Tracer::new(&scene, size, Quality::default()).trace(0..size.pixels(), &mut Scratch::default(), &mut pixels);
    let mut state = RunState::new(&log.header);
    log.records().iter().for_each(|record| state.apply(record));
    for (name, layer) in [("owners.png", Layer::Owners), ("costs.png", Layer::Costs)] {
        let expected = picture_pixels(&Frame::of(size, &pixels), &state, &node_colours(3), (layer, 1.0));
        assert!(
            image::open(directory.path().join(name)).expect("a picture").to_rgb8().into_raw() == expected,
            "{name}"
        );
    }
}
