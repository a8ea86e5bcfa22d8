//! Closing of the window while a file is being written.

use std::path::Path;

use anel::picture::Size;
use egui::{Key, ViewportCommand, ViewportEvent, ViewportId};
use egui_kittest::kittest::Queryable;

use super::driving::*;

const FIELD: &str = "Path of the file";

/// Begins to save a picture of this size and these samples.
fn save(window: &mut Window, path: &Path, size: Size, samples: &str) {
    press(window, "Save…");
    press(window, "any size");
    type_path(window, FIELD, path);
    type_number(window, "Pixels across", &size.width().to_string());
    type_number(window, "Pixels down", &size.height().to_string());
    type_number(window, "Samples a pixel", samples);
    press(window, "Save");
}

/// Presses the window's ×. Returns the commands to the window.
fn close(window: &mut Window) -> Vec<ViewportCommand> {
    window.input_mut().viewports.entry(ViewportId::ROOT).or_default().events.push(ViewportEvent::Close);
    window.step();
    commands(window)
}

fn commands(window: &Window) -> Vec<ViewportCommand> {
    window.output().viewport_output[&ViewportId::ROOT].commands.clone()
}

#[test]
fn window_asks_before_it_drops_a_file() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("huge.png");
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 20);
    assert!(close(&mut window).is_empty(), "nothing is being written");
    save(&mut window, &path, Size::new(3000, 2000).expect("a size"), "16");
    assert!(close(&mut window).contains(&ViewportCommand::CancelClose));
    window.run_steps(2);
    window.get_by_label("huge.png is still being written");
    key(&mut window, Key::Escape);
    assert!(window.query_by_label_contains("still being written").is_none());
    assert!(close(&mut window).contains(&ViewportCommand::CancelClose));
    press(&mut window, "Do not quit");
    assert!(window.query_by_label_contains("still being written").is_none());
    assert!(close(&mut window).contains(&ViewportCommand::CancelClose));
    window.run_steps(2);
    window.get_by_label("Quit without the file").click();
    let mut closes = false;
    for _ in 0..4 {
        window.step();
        closes |= commands(&window).contains(&ViewportCommand::Close);
    }
    assert!(closes && !path.exists());
}

#[test]
fn window_closes_when_the_file_is_written() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("small.png");
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 20);
    save(&mut window, &path, Size::new(400, 300).expect("a size"), "4");
    assert!(close(&mut window).contains(&ViewportCommand::CancelClose));
    until(&mut window, "the end", |window| commands(window).contains(&ViewportCommand::Close));
    assert_eq!(image::image_dimensions(&path).expect("a PNG"), (400, 300));
}
