//! The page of speed and accuracy: measuring, looking at pictures and choosing a quality.

use anel::picture::Quality;
use anel::study::accuracy::combinations;
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use tempfile::TempDir;

use super::driving::*;

/// A window with a scene that is quickly measured, in a small picture.
fn open_small(directory: &TempDir) -> Window {
    let path = directory.path().join("ball.ron");
    let scene = "Scene(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), lights: [Point(position: (3, 5, 5))], \
                 objects: [Sphere(radius: 1), HalfSpace(normal: (0, 1, 0), offset: -1)])";
    std::fs::write(&path, scene).expect("a file");
    let mut window = open_with(SIZE, path.to_str().expect("a plain path"));
    press(&mut window, "Set up");
    for (side, pixels) in [("Width in pixels", "24"), ("Height in pixels", "18"), ("Pixels in an atom", "1")] {
        type_number(&mut window, side, pixels);
    }
    let is_small = |window: &Window| session(window).loading().is_none() && session(window).header().size.width() == 24;
    until(&mut window, "small picture", is_small);
    press(&mut window, "Set up");
    window
}

fn points(window: &Window) -> usize {
    window.state().points_measured()
}

fn quality(window: &Window) -> Quality {
    session(window).settings().quality
}

/// The number of qualities that are measured, the current one among them.
fn all() -> usize {
    combinations().len()
}

fn is_measured(window: &Window) -> bool {
    window.query_by_label(&format!("{} points", all())).is_some()
}

#[test]
fn page_measures_the_scene_while_the_run_is_paused() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open_small(&directory);
    key(&mut window, Key::A);
    assert!(session(&window).stage().paused);
    until(&mut window, "point", |window| points(window) > 0);
    window.get_by_role_and_label(Role::Button, "Point 1");
    window.get_by_label("What this scene needs");
    window.get_by_label("Made of: 1 ball and 1 half-space");
    until(&mut window, "all points", is_measured);
    assert!(!session(&window).stage().paused);
    window.get_by_role_and_label(Role::Button, &format!("Point {}", all()));
    // A measured scene is not measured again.
    key(&mut window, Key::Escape);
    assert!(window.query_by_label("Point 1").is_none());
    press(&mut window, "Accuracy");
    assert!(is_measured(&window) && !session(&window).stage().paused);
}

#[test]
fn point_shows_its_picture_beside_the_reference_and_their_difference() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open_small(&directory);
    press(&mut window, "Accuracy");
    until(&mut window, "all points", is_measured);
    let set_now = window.get_by_label_contains("Set now: 1 sample a pixel").value();
    // Not at its place: another point may lie over it.
    window.get_by_label("Point 9").click_accesskit();
    window.run_steps(3);
    assert!(window.query_by_label_contains("Set now:").is_none(), "{set_now:?}");
    window.get_by_label_contains("samples a pixel");
    let divider = |window: &Window| window.get_by_label("Divider of the pictures").accesskit_node().numeric_value();
    assert_eq!(divider(&window), Some(50.0));
    let place = window.get_by_label("Divider of the pictures").rect();
    window.drag_at(place.lerp_inside([0.5, 0.5]));
    window.step();
    window.drop_at(place.lerp_inside([0.25, 0.5]));
    window.run_steps(3);
    assert!(divider(&window).is_some_and(|share| (share - 25.0).abs() < 2.0), "{:?}", divider(&window));
    press(&mut window, "Difference");
    window.get_by_label("Difference from the reference");
    window.get_by_label("Colours of errors");
    assert!(window.query_by_label("Divider of the pictures").is_none());
}

#[test]
fn quality_chosen_by_a_limit_can_be_set_and_undone() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open_small(&directory);
    let before = quality(&window);
    press(&mut window, "Accuracy");
    until(&mut window, "all points", is_measured);
    // The smallest error requires the best quality, and the shortest time a fast one.
    drag(&mut window, "Largest error", 0.0);
    press(&mut window, "Take these settings");
    let best = quality(&window);
    assert!(best.samples > 2 && best != before, "{best:?}");
    assert!(window.query_by_label("Largest error").is_none());
    until(&mut window, "the run with it", |window| session(window).header().quality == best);
    ctrl(&mut window, Key::Z);
    assert_eq!(quality(&window), before);
    until(&mut window, "the run before", |window| session(window).header().quality == before);
    key(&mut window, Key::A);
    until(&mut window, "all points", is_measured);
    drag(&mut window, "Longest time", 0.0);
    assert!(window.query_by_label_contains("1 sample a pixel").is_some());
}

#[test]
fn closing_the_page_cancels_the_measurement() {
    // The demonstration takes longer to measure.
    let mut window = open(SIZE);
    key(&mut window, Key::A);
    let said = window.get_by_label("Chart of time and error").value();
    assert!(said.is_some_and(|said| said.starts_with("First the reference is traced")));
    assert!(session(&window).stage().paused);
    press(&mut window, "Close accuracy");
    assert!(!session(&window).stage().paused && points(&window) == 0);
    let traced = done(&window);
    until(&mut window, "progress of the run", |window| done(window) > traced);
    until(&mut window, "the end of the measurement", |window| session(window).measurements() == 0);
    assert_eq!(points(&window), 0);
}

#[test]
fn changed_scene_is_measured_again() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open_small(&directory);
    key(&mut window, Key::A);
    until(&mut window, "points", |window| points(window) > 3);
    // A scene that is read again counts as another one.
    key(&mut window, Key::F5);
    until(&mut window, "new measurement", |window| points(window) < 3);
    until(&mut window, "all points", is_measured);
    assert!(!session(&window).stage().paused);
}

#[test]
fn page_fits_into_small_windows() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open_small(&directory);
    key(&mut window, Key::A);
    until(&mut window, "all points", is_measured);
    for size in [[1280.0, 800.0], [1000.0, 700.0]] {
        resize(&mut window, size);
        window.run_steps(3);
        let whole = egui::Rect::from_min_size(egui::Pos2::ZERO, size.into());
        let rect = |name: &str| window.get_by_label(name).rect();
        let chart = rect("Chart of time and error");
        for name in ["Point 1", &format!("Point {}", all())] {
            assert!(chart.contains_rect(rect(name).shrink(8.0)), "{name} at {size:?}");
        }
        for name in [
            "Chart of time and error",
            "Divider of the pictures",
            "Largest error",
            "Take these settings",
            "What this scene needs",
        ] {
            assert!(whole.contains_rect(rect(name)), "{name} at {size:?}: {:?}", rect(name));
        }
        assert!(chart.right() < rect("Divider of the pictures").left());
        assert!(chart.bottom() < rect("Largest error").top());
    }
}
