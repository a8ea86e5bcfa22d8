//! Nothing is cut off in windows of any size, with and without the panels.

use egui::accesskit::Role;
use egui::{Key, Pos2, Rect};
use egui_kittest::kittest::{NodeT, Queryable};

use super::driving::*;

fn rect(window: &Window, name: &str) -> Rect {
    window.get_by_label(name).rect()
}

/// The area of the window, with a margin of one point.
fn whole(size: [f32; 2]) -> Rect {
    Rect::from_min_size(Pos2::ZERO, size.into()).expand(1.0)
}

#[test]
fn windows_of_every_size_show_all_widgets() {
    for size in [[1280.0, 800.0], [1920.0, 1080.0], [1024.0, 640.0], [800.0, 500.0], [683.0, 427.0]] {
        let window = open(size);
        let buttons = ["Scenes", "Pause", "Restart", "Undo", "Set up", "Save…", "Dark or light", "Help"];
        let time = [
            "Beginning",
            "Step back",
            "Unit of a step",
            "Step forward",
            "Slower",
            "Faster",
            "The run's time",
            "Live",
            "Find",
        ];
        // A small picture has space for the layer's name only.
        let layer = if size[0] < 1000.0 { "Who traced it" } else { "Render or layer" };
        let others = [layer, "Speed of machine 1", "Pause machine 1"];
        for pair in time.windows(2) {
            let (one, other) = (rect(&window, pair[0]), rect(&window, pair[1]));
            assert!(one.right() <= other.left(), "{pair:?} at {size:?}");
        }
        assert!(rect(&window, "The run's time").width() > 100.0);
        for name in buttons.into_iter().chain(time).chain(others) {
            let rect = rect(&window, name);
            assert!(whole(size).contains_rect(rect) && rect.area() > 0.0, "{name} at {size:?}: {rect:?}");
        }
        for pair in buttons.windows(2).skip(1) {
            let (one, other) = (rect(&window, pair[0]), rect(&window, pair[1]));
            assert!(one.right() <= other.left(), "{pair:?} at {size:?}");
        }
        for name in ["Picture", "The ring", "Who has traced how much"] {
            let rect = rect(&window, name);
            assert!(whole(size).contains_rect(rect) && rect.area() > 1000.0, "{name} at {size:?}: {rect:?}");
        }
    }
}

#[test]
fn buttons_of_the_bar_keep_their_places_and_words() {
    let mut window = open(SIZE);
    let all = |window: &Window, main| [main, "Restart", "Set up", "Accuracy"].map(|name| rect(window, name));
    let before = all(&window, "Pause");
    key(&mut window, Key::Space);
    assert_eq!(all(&window, "Resume"), before);
    window.key_press_modifiers(egui::Modifiers::SHIFT, Key::L);
    window.run_steps(3);
    for name in ["Precisão", "Salvar…", "Lições", "Comparar", "Ajustar"] {
        assert!(rect(&window, name).width() > 60.0, "{name} has lost its word");
    }
}

#[test]
fn smallest_window_shows_all_machines() {
    for size in [[1024.0, 640.0], [800.0, 500.0]] {
        let window = open(size);
        for node in 1..=8 {
            let row = rect(&window, &format!("Machine {node}"));
            assert!(whole(size).contains_rect(row), "node {node} at {size:?}: {row:?}");
            for part in ["Speed of machine", "Exact speed of machine", "Pause machine"] {
                let part = rect(&window, &format!("{part} {node}")).shrink(2.0);
                assert!(row.contains_rect(part), "{part:?} {row:?} at {size:?}");
            }
        }
    }
}

#[test]
fn save_sheet_leaves_the_picture_where_it_is() {
    for size in [[1920.0, 1080.0], [1280.0, 800.0], [1024.0, 640.0], [800.0, 500.0], [683.0, 427.0]] {
        let mut window = open(size);
        let picture = rect(&window, "Picture");
        key(&mut window, Key::S);
        assert_eq!(rect(&window, "Picture"), picture, "{size:?}");
        window.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
        key(&mut window, Key::Delete);
        key(&mut window, Key::Enter);
        let sheet = rect(&window, "Preview").union(rect(&window, "Path of the file"));
        // A narrow window has no room beside the sheet.
        assert!(sheet.left() > picture.right() || size[0] < 900.0, "{size:?}: {sheet:?} {picture:?}");
        let words = window.get_by_label_contains("There is no path").rect();
        assert!(whole(size).contains_rect(words), "{size:?}: {words:?}");
        for name in ["Save", "Browse…", "Copy picture", "Close save", "render", "Perfetto", "Preview"] {
            assert!(whole(size).contains_rect(rect(&window, name)), "{name} at {size:?}: {:?}", rect(&window, name));
        }
    }
}

#[test]
fn settings_leave_space_for_picture_and_ring() {
    for size in [[1920.0, 1080.0], [1280.0, 800.0], [1024.0, 640.0]] {
        let mut window = open(size);
        key(&mut window, Key::E);
        for name in ["Picture", "The ring"] {
            let rect = rect(&window, name);
            let panel = window.get_by_label("Number of machines").rect();
            assert!(whole(size).contains_rect(rect) && rect.area() > 20_000.0, "{name} at {size:?}: {rect:?}");
            assert!(rect.left() > panel.right(), "{name} at {size:?}");
        }
    }
}

#[test]
fn ring_of_32_machines_has_half_the_window() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("run.anel");
    let speeds = vec!["1"; 32].join(",");
    let written = std::process::Command::new(env!("CARGO_BIN_EXE_anel"))
        .args(["render", "csg-primer", "--size", "64x48", "--driver", "sim", "--speeds", &speeds, "--out"])
        .arg(directory.path().join("picture.png"))
        .arg("--log")
        .arg(&path)
        .output()
        .expect("the program runs");
    assert!(written.status.success(), "{written:?}");
    let mut window = open_with(SIZE, path.to_str().expect("a plain path"));
    window.run_steps(3);
    let ring = rect(&window, "The ring");
    assert!(ring.height() >= SIZE[1] / 2.0, "{ring:?}");
    for node in 1..=32 {
        let row = rect(&window, &format!("Machine {node}"));
        assert!(whole(SIZE).contains_rect(row) && row.top() > ring.bottom(), "machine {node}: {row:?}");
        for part in ["Exact speed of machine", "Pause machine"] {
            let part = rect(&window, &format!("{part} {node}"));
            assert!(row.expand(4.0).contains_rect(part), "{part:?} {row:?}");
        }
    }
}

#[test]
fn split_is_dragged_and_remembered() {
    const SPLIT: &str = "Height of picture and ring";
    let mut window = open(SIZE);
    let usual = rect(&window, "The ring").height();
    let edge = rect(&window, SPLIT).center();
    window.drag_at(edge);
    window.step();
    window.hover_at(edge - egui::vec2(0.0, 90.0));
    window.run_steps(2);
    window.drop_at(edge - egui::vec2(0.0, 90.0));
    window.run_steps(3);
    let dragged = rect(&window, "The ring").height();
    assert!((usual - dragged - 90.0).abs() < 4.0, "{usual} {dragged}");
    let mut storage = Storage::default();
    eframe::App::save(window.state_mut(), &mut storage);
    let mut window = launch_with(SIZE, &storage, anel::gui::Launch::default());
    window.run_steps(3);
    assert!((rect(&window, "The ring").height() - dragged).abs() < 1.0);
}

/// Shows a notice in each of these states of the window, and checks that it covers nothing.
#[test]
fn notice_has_a_place_of_its_own() {
    let seen =
        [Role::Button, Role::Slider, Role::SpinButton, Role::TextInput, Role::ComboBox, Role::Image, Role::Label];
    for size in [[1024.0, 640.0], [1280.0, 800.0], [1920.0, 1080.0], [683.0, 427.0]] {
        let mut window = open(size);
        until(&mut window, "traced atoms", |window| done(window) > 200);
        for opened in [None, Some(Key::Num3), Some(Key::E), Some(Key::T), Some(Key::K), Some(Key::N)] {
            opened.into_iter().for_each(|opened| key(&mut window, opened));
            if opened == Some(Key::N) {
                press(&mut window, "What is an atom?");
                until(&mut window, "a lesson", |window| window.state().lesson().is_some());
            }
            window.event(egui::Event::Copy);
            window.run_steps(4);
            let words = window.get_by_label("The picture is copied to the clipboard").rect();
            let notice = words.union(rect(&window, "Close notice"));
            assert!(whole(size).contains_rect(notice), "{opened:?} at {size:?}: {notice:?}");
            for role in seen {
                for node in window.query_all_by_role(role) {
                    let node_of_it = node.accesskit_node();
                    let name = node_of_it.label().or(node_of_it.value()).unwrap_or_default();
                    let is_own = ["The picture is copied to the clipboard", "Close notice"].contains(&&*name);
                    let both = node.rect().intersect(notice);
                    let is_covered = !is_own && both.width() > 1.0 && both.height() > 1.0;
                    assert!(!is_covered, "{opened:?} at {size:?}: {name:?} at {:?} meets {notice:?}", node.rect());
                }
            }
            press(&mut window, "Close notice");
        }
    }
}
