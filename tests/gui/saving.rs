//! Saving pictures and runs.

use std::path::{Path, PathBuf};

use anel::runlog::RunLog;
use egui::Key;
use egui_kittest::kittest::Queryable;

use super::driving::*;

pub const FIELD: &str = "Path of the file";

/// Chooses the kind of file.
pub fn choose_kind(window: &mut Window, kind: &str) {
    press(window, kind);
}

pub fn typed(window: &Window) -> PathBuf {
    window.get_by_label(FIELD).value().unwrap_or_default().into()
}

pub fn file_name(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

#[test]
fn save_writes_the_render_and_names_the_file() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("rs picture.png");
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 100);
    press(&mut window, "Save…");
    assert_eq!(file_name(&typed(&window)), "ten-objects-640x480-unfinished.png");
    // Letters are typed, although they are shortcuts elsewhere.
    save_to(&mut window, &path);
    let picture = image::open(&path).expect("a PNG").to_rgb8();
    assert_eq!(picture.dimensions(), (640, 480));
    let black = picture.pixels().filter(|pixel| pixel.0 == [0; 3]).count();
    assert!(black > 1000 && black < 640 * 480 - 1000, "{black} black pixels");
    // The sheet stays open for another file.
    assert!(window.query_by_label(FIELD).is_some());
}

#[test]
fn run_is_saved_and_opened_with_keys() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("run.anel");
    let mut window = open(SIZE);
    until(&mut window, "some atoms", |window| done(window) > 20);
    window.key_press_modifiers(egui::Modifiers::COMMAND | egui::Modifiers::SHIFT, Key::S);
    window.run_steps(3);
    type_path(&mut window, "Path of the file", &path);
    key(&mut window, Key::Enter);
    until(&mut window, "a file", |_| path.is_file());
    until(&mut window, "notice", |window| notice(window).contains("run.anel"));
    escape(&mut window);
    key(&mut window, Key::O);
    press(&mut window, "Open the last saved run: run.anel");
    until(&mut window, "the run", |window| session(window).is_recorded());
    assert_eq!(session(&window).header().scene, "ten-objects");
}

#[test]
fn owners_and_blend_are_different_pictures_with_their_own_names() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open(SIZE);
    drag(&mut window, "Render or layer", 0.4);
    until(&mut window, "traced atoms", |window| done(window) > 300);
    key(&mut window, Key::Space);
    std::thread::sleep(std::time::Duration::from_millis(100));
    window.run_steps(3);
    let mut pictures = Vec::new();
    for (kind, ending) in [("render", ""), ("owners", "-owners"), ("blend", "-blend")] {
        press(&mut window, "Save…");
        choose_kind(&mut window, kind);
        assert_eq!(file_name(&typed(&window)), format!("ten-objects-640x480{ending}-unfinished.png"));
        let path = directory.path().join(format!("{kind}.png"));
        type_path(&mut window, FIELD, &path);
        key(&mut window, Key::Enter);
        until(&mut window, "a file", |window| notice(window).starts_with("Saved to"));
        pictures.push(image::open(&path).expect("a PNG").to_rgb8().into_raw());
        escape(&mut window);
    }
    let different = |one: &[u8], other: &[u8]| one.iter().zip(other).filter(|(a, b)| a != b).count();
    for (one, other) in [(0, 1), (1, 2), (0, 2)] {
        assert!(different(&pictures[one], &pictures[other]) > 1000, "{one} {other}");
    }
    // Pixels that no node has traced are black in all of them.
    assert!(
        pictures
            .iter()
            .all(|picture| picture[picture.len() / 2 - 60_000..][..3] == pictures[0][picture_middle()..][..3])
    );
}

/// A byte of a pixel that no node has reached after a few hundred atoms.
fn picture_middle() -> usize {
    640 * 480 * 3 / 2 - 60_000
}

/// A window with traced atoms, in which the run is chosen to be saved.
fn about_to_save_a_run() -> Window {
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 100);
    key(&mut window, Key::S);
    choose_kind(&mut window, "run");
    window
}

/// Types more of the run's title, and moves the focus to the path.
fn add_to_title(window: &mut Window, text: &str) {
    window.get_by_label("Title of the run").click();
    window.run_steps(2);
    window.get_by_label("Title of the run").type_text(text);
    window.run_steps(2);
    window.get_by_label(FIELD).click();
    window.run_steps(2);
}

/// Saves the chosen kind under this path, and waits for the notice.
fn save_to(window: &mut Window, path: &Path) {
    type_path(window, FIELD, path);
    press(window, "Save");
    until(window, "notice", |window| notice(window).starts_with("Saved to"));
}

#[test]
fn saved_run_file_can_be_loaded() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("run.anel");
    let mut window = about_to_save_a_run();
    assert_eq!(file_name(&typed(&window)), "ten-objects-640x480-ring-8-unfinished.anel");
    save_to(&mut window, &path);
    let log = RunLog::load(&path).expect("a run file");
    assert_eq!(log.header, *session(&window).header());
    assert!(log.records().len() > 100);
}

#[test]
fn run_is_saved_with_a_title_that_is_shown_when_it_is_opened() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("run.anel");
    let mut window = about_to_save_a_run();
    add_to_title(&mut window, "Eight of them");
    save_to(&mut window, &path);
    let log = RunLog::load(&path).expect("a run file");
    assert_eq!(log.header.caption.title, "Eight of them");
    assert!(log.header.caption.machine.contains("core"), "{:?}", log.header.caption);
    let mut window = open_with(SIZE, path.to_str().expect("a plain path"));
    until(&mut window, "the title", |window| notice(window).contains("Eight of them"));
    // A changed title survives a restart.
    key(&mut window, Key::S);
    press(&mut window, "run");
    add_to_title(&mut window, ", again");
    save_to(&mut window, &directory.path().join("again.anel"));
    press(&mut window, "Restart");
    assert_eq!(session(&window).header().caption.title, "Eight of them, again");
}

#[test]
fn extension_of_a_typed_name_follows_the_kind() {
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 20);
    key(&mut window, Key::S);
    type_path(&mut window, FIELD, "/tmp/mine.png".as_ref());
    for (kind, name) in
        [("timeline", "mine.svg"), ("animation (GIF)", "mine.gif"), ("table", "mine.csv"), ("render", "mine.png")]
    {
        choose_kind(&mut window, kind);
        assert_eq!(file_name(&typed(&window)), name);
    }
}

#[test]
fn drawings_and_records_are_written_in_the_background() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 300);
    let starts = [("timeline", "<svg"), ("ring", "<svg"), ("table", "time_s,"), ("Perfetto", "{\"displayTimeUnit\"")];
    press(&mut window, "Save…");
    for (kind, start) in starts {
        choose_kind(&mut window, kind);
        let path = directory.path().join(kind);
        type_path(&mut window, FIELD, &path);
        press(&mut window, "Save");
        until(&mut window, "notice", |window| notice(window).contains(kind));
        assert!(std::fs::read_to_string(&path).expect("a file").starts_with(start), "{kind}");
    }
}

#[test]
fn first_typed_letters_replace_the_file_name() {
    let mut window = open(SIZE);
    key(&mut window, Key::S);
    let before = typed(&window);
    window.event(egui::Event::Text("mine".into()));
    window.run_steps(2);
    assert_eq!(typed(&window), before.with_file_name("mine.png"));
}

#[test]
fn notice_about_a_run_ends_with_it() {
    let mut window = open(SIZE);
    for (ends, name) in [(Key::R, "a restart"), (Key::F11, "a projector")] {
        window.event(egui::Event::Copy);
        window.run_steps(2);
        assert!(notice(&window).contains("clipboard"));
        key(&mut window, ends);
        assert_eq!(notice(&window), "", "{name}");
    }
}

#[test]
fn picture_is_copied_with_two_keys() {
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 20);
    window.event(egui::Event::Copy);
    window.step();
    let copied = window.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyImage(image) => Some(image.size),
        _ => None,
    });
    assert_eq!(copied, Some([640, 480]));
    assert!(notice(&window).contains("clipboard"), "{}", notice(&window));
}

#[test]
fn save_gives_the_reason_of_a_failure() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let read_only = directory.path().join("old.png");
    std::fs::write(&read_only, "dear").expect("a file");
    let mut permissions = std::fs::metadata(&read_only).expect("the file").permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&read_only, permissions).expect("permissions");
    let cases = [
        ("/no/such/place/picture.png".into(), "directory does not exist"),
        (read_only, "read-only"),
        (directory.path().to_owned(), "is a directory"),
    ];
    let mut window = open(SIZE);
    key(&mut window, Key::S);
    for (path, why) in cases {
        type_path(&mut window, FIELD, &path);
        key(&mut window, Key::Enter);
        until(&mut window, "notice", |window| window.query_by_label_contains(why).is_some());
    }
    window.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
    key(&mut window, Key::Delete);
    key(&mut window, Key::Enter);
    window.get_by_label_contains("There is no path");
}

#[test]
fn name_of_another_format_is_refused() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open(SIZE);
    key(&mut window, Key::S);
    for (kind, name, ending) in [
        ("render", "x.jpg", ".png"),
        ("timeline", "x.jpeg", ".svg or .png"),
        ("run", "x.png", ".anel"),
        ("table", "x.xls", ".csv"),
    ] {
        choose_kind(&mut window, kind);
        type_path(&mut window, FIELD, &directory.path().join(name));
        key(&mut window, Key::Enter);
        window.get_by_label(&format!("{name}: this is no name for such a file. Let it end in {ending}"));
    }
    assert_eq!(std::fs::read_dir(directory.path()).expect("the directory").count(), 0);
}

#[test]
fn no_letter_is_a_shortcut_while_the_save_sheet_is_open() {
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 20);
    key(&mut window, Key::S);
    type_path(&mut window, FIELD, "/no/such/place/picture.png".as_ref());
    key(&mut window, Key::Enter);
    until(&mut window, "notice", |window| window.query_by_label_contains("directory does not exist").is_some());
    // The path still has the focus.
    assert!(window.get_by_label(FIELD).is_focused());
    window.event(egui::Event::Text("r s".into()));
    let then = done(&window);
    for letter in [Key::R, Key::Space, Key::S] {
        key(&mut window, letter);
    }
    assert!(file_name(&typed(&window)).ends_with("picture.pngr s"), "{:?}", typed(&window));
    assert!(done(&window) >= then && !session(&window).stage().paused);
    escape(&mut window);
    assert!(window.query_by_label(FIELD).is_none());
    key(&mut window, Key::Space);
    assert!(session(&window).stage().paused);
}

#[test]
fn file_is_replaced_only_after_a_second_press() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("there.png");
    std::fs::write(&path, "dear").expect("a file");
    let mut window = open(SIZE);
    key(&mut window, Key::S);
    type_path(&mut window, FIELD, &path);
    key(&mut window, Key::Enter);
    window.get_by_label("there.png exists. Press Save again to replace it");
    // After a change of the path the question comes again.
    window.event(egui::Event::Text("x".into()));
    window.run_steps(2);
    assert!(window.query_by_label_contains("exists").is_none());
    key(&mut window, Key::Backspace);
    press(&mut window, "Save");
    window.get_by_label_contains("Press Save again");
    assert_eq!(std::fs::read(&path).expect("the file"), b"dear");
    press(&mut window, "Save");
    until(&mut window, "notice", |window| notice(window).starts_with("Saved to"));
    assert!(image::open(&path).is_ok());
}
