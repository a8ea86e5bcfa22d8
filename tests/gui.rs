//! The window without a window: drives the app by the accessible names of its widgets.

use std::time::Duration;

use anel::gui::{App, Launch, Phase};
use anel::record::What;
use anel::scene::Opened;
use egui::{Key, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

fn open(size: [f32; 2]) -> Harness<'static, App> {
    let launch = Launch { scene: Opened::new("ten-objects").expect("a built-in scene"), log: None };
    Harness::builder().with_size(size).build_eframe(move |creation| App::new(&creation.egui_ctx, &launch))
}

const SIZE: [f32; 2] = [1280.0, 800.0];

/// Lets the app go on until `come` is true; a run that hangs fails here instead of for ever.
fn until(harness: &mut Harness<'_, App>, what: &str, come: impl Fn(&Harness<'_, App>) -> bool) {
    for _ in 0..3000 {
        harness.step();
        if come(harness) {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("{what} has not come");
}

fn done(harness: &Harness<'_, App>) -> u32 {
    harness.state().session().state().done()
}

fn speeds_set(harness: &Harness<'_, App>) -> Vec<(u16, f64)> {
    let set = |what: &What| if let What::SpeedSet { node, speed } = what { Some((*node, *speed)) } else { None };
    harness.state().session().log().records().iter().filter_map(|record| set(&record.what)).collect()
}

/// Replaces the path in the save bar, which has the focus.
fn type_path(harness: &mut Harness<'_, App>, path: &str) {
    harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
    harness.step();
    harness.get_by_label("Path of the PNG").type_text(path);
    harness.run_steps(2);
    assert_eq!(harness.get_by_label("Path of the PNG").value().as_deref(), Some(path));
}

/// Opens the save row, empties its path and asks to save.
fn save_to_no_path(harness: &mut Harness<'_, App>) {
    harness.key_press(Key::S);
    harness.run_steps(3);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
    harness.key_press(Key::Delete);
    harness.run_steps(2);
    harness.key_press(Key::Enter);
}

#[test]
fn a_run_starts_at_once() {
    let mut harness = open(SIZE);
    until(&mut harness, "a traced atom", |harness| done(harness) > 20);
    let speeds: Vec<_> = harness.state().session().state().nodes().iter().map(|node| node.speed).collect();
    assert_eq!((speeds.len(), speeds[4]), (8, 0.1));
}

#[test]
fn dragging_a_slider_changes_the_speed_before_it_is_let_go() {
    let mut harness = open(SIZE);
    harness.step();
    let slider = harness.get_by_label("Speed of node 1").rect();
    harness.drag_at(slider.right_center() - vec2(8.0, 0.0));
    harness.step();
    harness.hover_at(slider.center());
    until(&mut harness, "a record of the new speed", |harness| !speeds_set(harness).is_empty());
    let (node, speed) = speeds_set(&harness)[0];
    assert!(node == 0 && speed > 0.4 && speed < 0.6, "{node} {speed}");
    harness.hover_at(slider.left_center());
    harness.step();
    harness.drop_at(slider.left_center());
    until(&mut harness, "a record of speed 0", |harness| speeds_set(harness).last() == Some(&(0, 0.0)));
}

#[test]
fn pause_stops_the_clock_and_the_work() {
    let mut harness = open(SIZE);
    until(&mut harness, "a traced atom", |harness| done(harness) > 5);
    harness.get_by_label("Pause").click();
    until(&mut harness, "a pause", |harness| harness.state().session().is_paused());
    let paused_at = harness.state().session().now();
    // What was under way when the clock stopped may still be told.
    std::thread::sleep(Duration::from_millis(100));
    harness.run_steps(2);
    let (then, records) = (done(&harness), harness.state().session().log().records().len());
    std::thread::sleep(Duration::from_millis(200));
    harness.run_steps(5);
    assert_eq!(harness.state().session().now(), paused_at);
    assert_eq!((done(&harness), harness.state().session().log().records().len()), (then, records));
    harness.key_press(Key::Space);
    until(&mut harness, "more atoms", |harness| done(harness) > then);
    assert!(harness.state().session().now() > paused_at);
}

#[test]
fn a_speed_set_during_a_pause_counts_when_the_run_goes_on() {
    let mut harness = open(SIZE);
    until(&mut harness, "a traced atom", |harness| done(harness) > 5);
    harness.key_press(Key::Space);
    until(&mut harness, "a pause", |harness| harness.state().session().is_paused());
    let slider = harness.get_by_label("Speed of node 8").rect();
    harness.drag_at(slider.center());
    harness.step();
    harness.drop_at(slider.center());
    harness.run_steps(3);
    assert_eq!(harness.state().session().speed(7), 0.5);
    harness.get_by_label("Go on").click();
    until(&mut harness, "a record", |harness| speeds_set(harness).last() == Some(&(7, 0.5)));
}

#[test]
fn restart_begins_anew_with_the_speeds_as_they_are() {
    let mut harness = open(SIZE);
    harness.step();
    let slider = harness.get_by_label("Speed of node 3").rect();
    harness.drag_at(slider.left_center());
    harness.step();
    harness.drop_at(slider.left_center());
    until(&mut harness, "speed 0", |harness| harness.state().session().state().nodes()[2].speed == 0.0);
    until(&mut harness, "many atoms", |harness| done(harness) > 300);
    let before = harness.state().session().now();
    harness.get_by_label("Restart").click();
    harness.run_steps(2);
    assert!(done(&harness) < 300);
    assert!(harness.state().session().now() < before);
    assert_eq!(harness.state().session().header().speeds[2], 0.0);
    until(&mut harness, "many atoms", |harness| done(harness) > 100);
    harness.key_press(Key::R);
    harness.run_steps(2);
    assert!(done(&harness) < 100);
    assert_eq!(*harness.state().session().phase(), Phase::Running);
}

#[test]
fn save_writes_the_render_and_says_where() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("rs picture.png");
    let mut harness = open(SIZE);
    until(&mut harness, "traced atoms", |harness| done(harness) > 100);
    harness.get_by_label("Save PNG").click();
    harness.run_steps(3);
    let offered = harness.get_by_label("Path of the PNG").value().unwrap_or_default();
    assert!(offered.ends_with("ten-objects-640x480-unfinished.png"), "{offered}");
    // Letters that are keys elsewhere are letters here.
    type_path(&mut harness, path.to_str().expect("a plain path"));
    harness.get_by_label("Save").click();
    until(&mut harness, "a sentence", |harness| harness.query_by_label_contains("Saved to").is_some());
    let picture = image::open(&path).expect("a PNG").to_rgb8();
    assert_eq!(picture.dimensions(), (640, 480));
    let black = picture.pixels().filter(|pixel| pixel.0 == [0; 3]).count();
    assert!(black > 1000 && black < 640 * 480 - 1000, "{black} black pixels");
}

#[test]
fn save_says_why_it_failed() {
    let mut harness = open(SIZE);
    harness.step();
    harness.key_press(Key::S);
    harness.run_steps(3);
    type_path(&mut harness, "/no/such/place/picture.png");
    harness.key_press(Key::Enter);
    until(&mut harness, "a sentence", |harness| harness.query_by_label_contains("directory does not exist").is_some());
}

fn typed(harness: &Harness<'_, App>) -> String {
    harness.get_by_label("Path of the PNG").value().unwrap_or_default()
}

/// How long until the window would draw itself anew.
fn rests(harness: &Harness<'_, App>) -> Duration {
    harness.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay
}

#[test]
fn no_letter_is_a_shortcut_while_the_save_row_is_open() {
    let mut harness = open(SIZE);
    until(&mut harness, "traced atoms", |harness| done(harness) > 20);
    harness.key_press(Key::S);
    harness.run_steps(3);
    type_path(&mut harness, "/no/such/place/picture.png");
    harness.key_press(Key::Enter);
    until(&mut harness, "a sentence", |harness| harness.query_by_label_contains("directory does not exist").is_some());
    // The keyboard still belongs to the path.
    assert!(harness.get_by_label("Path of the PNG").is_focused());
    harness.event(egui::Event::Text("r s".into()));
    let then = done(&harness);
    for key in [Key::R, Key::Space, Key::S] {
        harness.key_press(key);
        harness.run_steps(2);
    }
    assert!(typed(&harness).ends_with("picture.pngr s"), "{}", typed(&harness));
    assert!(done(&harness) >= then && !harness.state().session().is_paused());
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert!(harness.query_by_label("Path of the PNG").is_none());
    harness.key_press(Key::Space);
    until(&mut harness, "a pause", |harness| harness.state().session().is_paused());
}

#[test]
fn a_file_is_replaced_only_when_asked_twice() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("there.png");
    std::fs::write(&path, "dear").expect("a file");
    let mut harness = open(SIZE);
    harness.step();
    harness.key_press(Key::S);
    harness.run_steps(3);
    type_path(&mut harness, path.to_str().expect("a plain path"));
    harness.key_press(Key::Enter);
    harness.run_steps(2);
    harness.get_by_label("there.png exists; press Save again to replace it");
    // Another path in between: the question is asked anew.
    harness.event(egui::Event::Text("x".into()));
    harness.step();
    assert!(harness.query_by_label_contains("exists").is_none());
    harness.key_press(Key::Backspace);
    harness.step();
    harness.get_by_label("Save").click();
    harness.run_steps(3);
    harness.get_by_label_contains("press Save again");
    assert_eq!(std::fs::read(&path).expect("the file"), b"dear");
    harness.get_by_label("Save").click();
    until(&mut harness, "a sentence", |harness| harness.query_by_label_contains("Saved to").is_some());
    assert!(image::open(&path).is_ok());
}

#[test]
fn an_empty_path_is_told_in_words() {
    let mut harness = open(SIZE);
    harness.step();
    save_to_no_path(&mut harness);
    harness.run_steps(2);
    harness.get_by_label_contains("There is no path");
}

#[test]
fn all_machines_at_rest_draw_little_and_a_pause_nothing() {
    let mut harness = open(SIZE);
    until(&mut harness, "traced atoms", |harness| done(harness) > 20);
    assert!(rests(&harness) <= Duration::from_millis(40));
    for node in 1..=8 {
        let slider = harness.get_by_label(&format!("Speed of node {node}")).rect();
        harness.drag_at(slider.left_center());
        harness.step();
        harness.drop_at(slider.left_center());
        harness.step();
    }
    until(&mut harness, "rest", |harness| rests(harness) >= Duration::from_millis(200));
    until(&mut harness, "a sentence", |harness| harness.query_by_label_contains("All machines stand still").is_some());
    harness.key_press(Key::Space);
    until(&mut harness, "a window at rest", |harness| rests(harness) > Duration::from_secs(1));
}

#[test]
fn the_zoom_has_limits() {
    let mut harness = open(SIZE);
    for (key, limit) in [(Key::Plus, 2.0), (Key::Minus, 0.6)] {
        for _ in 0..20 {
            harness.key_press_modifiers(egui::Modifiers::COMMAND, key);
            harness.step();
            assert!((0.6..=2.0).contains(&harness.ctx.zoom_factor()));
        }
        assert_eq!(harness.ctx.zoom_factor(), limit);
    }
    harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::Num0);
    harness.run_steps(2);
    assert_eq!(harness.ctx.zoom_factor(), 1.0);
}

#[test]
fn every_size_shows_everything() {
    for size in [[1280.0, 800.0], [1920.0, 1080.0], [1024.0, 640.0], [800.0, 500.0], [683.0, 427.0]] {
        let mut harness = open(size);
        harness.run_steps(3);
        let window = egui::Rect::from_min_size(egui::Pos2::ZERO, size.into()).expand(1.0);
        for name in ["Pause", "Restart", "Save PNG", "Dark or light", "Render or owners", "Speed of node 1"] {
            let rect = harness.get_by_label(name).rect();
            assert!(window.contains_rect(rect) && rect.area() > 0.0, "{name} at {size:?}: {rect:?}");
        }
        for name in ["Picture", "Ring", "Who has traced how much"] {
            let rect = harness.get_by_label(name).rect();
            assert!(window.contains_rect(rect) && rect.area() > 1000.0, "{name} at {size:?}: {rect:?}");
        }
    }
}

#[test]
fn the_smallest_window_has_room_for_all_machines_and_the_save_row() {
    for size in [[1024.0, 640.0], [800.0, 500.0]] {
        let mut harness = open(size);
        harness.step();
        save_to_no_path(&mut harness);
        harness.run_steps(3);
        let rect = |name: &str| harness.get_by_label(name).rect();
        let window = egui::Rect::from_min_size(egui::Pos2::ZERO, size.into()).expand(1.0);
        let words = harness.get_by_label_contains("There is no path").rect();
        for name in ["Picture", "Ring"] {
            assert!(rect(name).top() >= words.bottom() && rect(name).area() > 1000.0, "{name} at {size:?}");
            assert!(rect(name).bottom() <= rect("Who has traced how much").top(), "{name} at {size:?}");
        }
        assert!(rect("Picture").right() < rect("Ring").left());
        for name in ["Save", "Choose…", "Close"] {
            assert!(window.contains_rect(rect(name)), "{name} at {size:?}");
        }
        for node in 1..=8 {
            let row = rect(&format!("Node {node}"));
            assert!(window.contains_rect(row), "node {node} at {size:?}: {row:?}");
            assert!(row.contains_rect(rect(&format!("Speed of node {node}")).shrink(2.0)));
        }
    }
}
