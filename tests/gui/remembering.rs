//! Settings and scenes that one window stores and the next one restores.

use anel::gui::Launch;
use eframe::App as _;
use egui::Key;
use egui_kittest::kittest::Queryable;

use super::driving::*;

/// Opens a window without arguments that restores this storage.
fn reopen(storage: &Storage) -> Window {
    launch_with(SIZE, storage, Launch::default())
}

fn store(window: &mut Window) -> Storage {
    let mut storage = Storage::default();
    window.state_mut().save(&mut storage);
    storage
}

#[test]
fn first_window_opens_with_the_demonstration() {
    let window = reopen(&Storage::default());
    assert_eq!(session(&window).header().scene, "ten-objects");
    assert_eq!(*session(&window).settings(), anel::gui::Settings::default());
}

#[test]
fn settings_and_scene_are_restored() {
    let mut window = open_with(SIZE, "csg-primer");
    key(&mut window, Key::E);
    type_number(&mut window, "Number of machines", "5");
    drag(&mut window, "Speed of machine 2", 0.25);
    let storage = store(&mut window);
    let again = reopen(&storage);
    assert_eq!(session(&again).header().scene, "csg-primer");
    assert_eq!(session(&again).settings(), session(&window).settings());
    again.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Number of machines");
}

#[test]
fn removed_scene_is_replaced_by_the_demonstration() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("mine.ron");
    std::fs::write(&path, anel::scene::built_in("glass").expect("a built-in scene")).expect("a file");
    let mut window = open_with(SIZE, path.to_str().expect("a plain path"));
    let storage = store(&mut window);
    assert_eq!(session(&reopen(&storage)).header().scene, "mine");
    std::fs::remove_file(&path).expect("the file");
    let again = reopen(&storage);
    assert_eq!(session(&again).header().scene, "ten-objects");
    assert!(notice(&again).contains("mine.ron"), "{}", notice(&again));
}

#[test]
fn storage_of_an_earlier_version_is_read() {
    let written = "(settings: (size: (width: 320, height: 240), strategy: ring, part: 3, tempo: Lasts(7), latency: 9))";
    let window = reopen(&Storage(Some(written.into())));
    let settings = session(&window).settings();
    assert_eq!((settings.part, settings.latency, settings.size.width()), (3, 9.0, 320));
    assert_eq!((settings.handling, settings.bandwidth, settings.shared_wire), (0.0, 0, false));
}

#[test]
fn strategy_and_driver_are_restored() {
    let mut window = open(SIZE);
    key(&mut window, Key::E);
    choose(&mut window, "Strategy", "Work stealing (rayon)");
    let again = reopen(&store(&mut window));
    assert_eq!(session(&again).settings(), session(&window).settings());
    assert_ne!(*session(&again).settings(), anel::gui::Settings::default());
    choose(&mut window, "Strategy", "Estimated bands");
    press(&mut window, "Virtual");
    let again = reopen(&store(&mut window));
    assert_eq!(session(&again).settings(), session(&window).settings());
}

#[test]
fn damaged_storage_is_ignored() {
    for damaged in ["", "}{", "(settings: 7)", "(settings: (speeds: []))", "(settings: (speeds: [7.0], atom: 0))"] {
        let window = reopen(&Storage(Some(damaged.into())));
        assert_eq!(*session(&window).settings(), anel::gui::Settings::default(), "{damaged}");
    }
}
