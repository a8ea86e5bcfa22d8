//! Random scene and run files: each is read or refused in one sentence, and a file that is read never makes the program
//! panic, hang, exhaust memory or produce negative colours.
//!
//! The usual test tries a few thousand inputs, the same ones every time. `ANEL_FUZZ_SECONDS=3600 cargo test --test
//! files fuzz -- --nocapture` tries others for an hour, with the overflow checks of the development profile. An input
//! that failed once is kept in `tests/files/fuzz/corpus`.

mod hunt;
mod mutator;
mod run;

use std::path::Path;

use anel::export::to_pov;
use anel::picture::{Quality, Size};
use anel::ron_file::FileError;
use anel::scene::{Opened, SMALL_BUILT_IN};
use anel::tracer::{Scratch, Tracer};
use hunt::{Hunt, corpus};

/// The corpus of scenes and the small built-in scenes: thousands of mutants of a large one would take minutes.
fn scenes() -> Vec<Vec<u8>> {
    let built_in = SMALL_BUILT_IN.iter().map(|(_, text)| text.as_bytes().to_vec()).collect();
    [corpus("tests/files/fuzz/corpus/scenes"), built_in].concat()
}

/// Checks that an error message is one short line.
fn assert_sentence(error: &str) {
    let is_line = !error.trim().is_empty() && !error.contains(char::is_control);
    assert!(is_line && error.chars().count() < 600, "not one short line: {error:?}");
}

fn open(file: &Path) -> Result<Opened, FileError> {
    let opened = Opened::new(file.to_str().expect("a path that is text"));
    if let Err(error) = &opened {
        assert_sentence(&error.to_string());
    }
    opened
}

#[test]
fn scene_file_is_read_or_refused() {
    let check = |file: &Path| open(file).is_ok();
    Hunt { name: "scene-file", corpus: scenes(), mutants: 5000, check }.run();
}

#[test]
fn scene_that_is_read_can_be_traced() {
    Hunt { name: "scene", corpus: scenes(), mutants: 2000, check: trace }.run();
}

fn trace(file: &Path) -> bool {
    let Ok(Opened { scene, .. }) = open(file) else { return false };
    let size = Size::new(8, 6).expect("a small picture");
    let tracer = Tracer::new(&scene, size, Quality::default());
    let mut pixels = Vec::new();
    tracer.trace(0..size.pixels(), &mut Scratch::default(), &mut pixels);
    let is_light = |channel: &f32| channel.is_finite() && *channel >= 0.0;
    assert!(pixels.iter().flatten().all(is_light), "{pixels:?}");
    assert!(tracer.boxes().iter().all(|bounds| bounds.is_finite()));
    assert!(tracer.scene_stats().lights == scene.lights.len());
    let pov = to_pov(&scene, size, &Quality::default());
    // Comments may contain names of the scene.
    let mut lines = pov.text.lines().filter(|line| !line.starts_with("//"));
    assert!(lines.all(|line| !line.contains("NaN") && !line.contains("inf")), "{}", pov.text);
    true
}

#[test]
fn run_file_that_is_read_can_be_shown() {
    Hunt { name: "run-file", corpus: corpus("tests/files/fuzz/corpus/runs"), mutants: 2000, check: run::show }.run();
}
