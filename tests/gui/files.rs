//! Opening scenes and recorded runs, and files that change, disappear, or are not scenes.

use std::path::{Path, PathBuf};

use anel::gui::{Launch, Phase};
use egui::Key;
use egui_kittest::kittest::Queryable;
use tempfile::TempDir;

use super::driving::*;

const FIELD: &str = "Path of the file to open";

/// Writes a scene of one ball to a file.
fn ball(directory: &TempDir, name: &str) -> PathBuf {
    let path = directory.path().join(name);
    std::fs::write(&path, scene("radius: 1")).expect("a file");
    path
}

fn scene(radius: &str) -> String {
    format!("Scene(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), objects: [Sphere({radius})])")
}

fn open_path(window: &mut Window, path: &Path) {
    key(window, Key::O);
    type_path(window, FIELD, path);
    key(window, Key::Enter);
}

fn shows(window: &Window, scene: &str) -> bool {
    session(window).header().scene == scene && session(window).loading().is_none()
}

#[test]
fn scene_is_opened_from_the_gallery() {
    let mut window = open(SIZE);
    press(&mut window, "Scenes");
    // The tiles appear before their pictures.
    for (name, _) in anel::scene::BUILT_IN {
        window.get_by_label(&format!("Open {name}"));
    }
    window.get_by_label("Open csg-primer").click();
    until(&mut window, "the scene", |window| shows(window, "csg-primer"));
    until(&mut window, "its atoms", |window| done(window) > 20);
    assert!(window.query_by_label(FIELD).is_none());
}

#[test]
fn scene_is_opened_by_its_path_and_remembered() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = ball(&directory, "ball.ron");
    let mut window = open(SIZE);
    open_path(&mut window, &path);
    until(&mut window, "the scene", |window| shows(window, "ball"));
    key(&mut window, Key::O);
    window.get_by_label("Open ball");
    press(&mut window, "Close scenes");
    assert!(window.query_by_label("Open ball").is_none());
}

#[test]
fn bad_scene_names_the_place_and_does_not_replace_the_open_one() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("bad.ron");
    std::fs::write(&path, format!("\n\n{}", scene("radius: -1"))).expect("a file");
    let mut window = open(SIZE);
    until(&mut window, "many atoms", |window| done(window) > 100);
    open_path(&mut window, &path);
    until(&mut window, "notice", |window| notice(window).contains("bad.ron"));
    let said = notice(&window);
    assert!(said.contains("line 3, column") && said.contains("radius"), "{said}");
    assert!(shows(&window, "ten-objects") && done(&window) > 100);
    press(&mut window, "Close notice");
    assert_eq!(notice(&window), "");
}

#[test]
fn file_that_could_not_be_opened_is_tried_again_and_watched() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = ball(&directory, "ball.ron");
    std::fs::write(&path, scene("radius: -1")).expect("a file");
    let mut window = open(SIZE);
    key(&mut window, Key::F5);
    assert!(notice(&window).starts_with("There is no file to reload"), "{}", notice(&window));
    open_path(&mut window, &path);
    until(&mut window, "notice", |window| notice(window).starts_with("Not opened"));
    key(&mut window, Key::F5);
    until(&mut window, "the same error", |window| notice(window).starts_with("Still not opened"));
    std::thread::sleep(std::time::Duration::from_millis(100));
    std::fs::write(&path, scene("radius: -0.25")).expect("a file");
    until(&mut window, "offer to reload", |window| notice(window).starts_with("ball.ron has changed on disk. Before:"));
    press(&mut window, "Reload");
    assert_ne!(notice(&window), "", "what was said stays until the file is read");
    until(&mut window, "the next error", |window| notice(window).starts_with("Still not opened"));
    std::thread::sleep(std::time::Duration::from_millis(100));
    std::fs::write(&path, scene("radius: 0.25")).expect("a file");
    until(&mut window, "offer to reload", |window| notice(window).contains("has changed on disk"));
    key(&mut window, Key::F5);
    until(&mut window, "the mended scene", |window| shows(window, "ball"));
    assert_eq!(notice(&window), "");
    // With its notice a file is given up, and F5 is about the open one again.
    std::fs::write(&path, scene("radius: 0.5")).expect("a file");
    open_path(&mut window, &directory.path().join("nothing.ron"));
    until(&mut window, "notice", |window| notice(window).contains("no such file"));
    press(&mut window, "Close notice");
    key(&mut window, Key::F5);
    until(&mut window, "the scene again", |window| session(window).header().scene_text.contains("0.5"));
}

#[test]
fn typed_path_takes_the_place_of_the_last_one() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let [first, second] = ["first.ron", "second.ron"].map(|name| ball(&directory, name));
    let mut window = open(SIZE);
    open_path(&mut window, &first);
    until(&mut window, "the scene", |window| shows(window, "first"));
    key(&mut window, Key::O);
    window.run_steps(3);
    window.get_by_label(FIELD).type_text(second.to_str().expect("a plain path"));
    window.run_steps(2);
    assert_eq!(window.get_by_label(FIELD).value().as_deref(), second.to_str());
    // A click into the field selects all too; a second one sets the cursor.
    key(&mut window, Key::Escape);
    window.get_by_label(FIELD).click();
    window.run_steps(3);
    window.get_by_label(FIELD).type_text("mine.ron");
    window.run_steps(2);
    assert_eq!(window.get_by_label(FIELD).value().as_deref(), Some("mine.ron"));
    type_path(&mut window, FIELD, &second);
    key(&mut window, Key::Enter);
    until(&mut window, "the scene", |window| shows(window, "second"));
    // A full path behind the directory of the last one.
    key(&mut window, Key::O);
    type_path(&mut window, FIELD, Path::new(&format!("{}/{}", directory.path().display(), first.display())));
    key(&mut window, Key::Enter);
    until(&mut window, "the scene", |window| shows(window, "first"));
}

#[test]
fn notice_about_a_file_ends_when_a_file_is_opened() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = ball(&directory, "ball.ron");
    std::fs::write(&path, scene("radius: -1")).expect("a file");
    let mut window = open(SIZE);
    open_path(&mut window, &path);
    until(&mut window, "notice", |window| notice(window).starts_with("Not opened"));
    // The next attempt, with the mistake mended.
    std::fs::write(&path, scene("radius: 1")).expect("a file");
    open_path(&mut window, &path);
    until(&mut window, "the scene", |window| shows(window, "ball"));
    assert_eq!(notice(&window), "");
    std::thread::sleep(std::time::Duration::from_millis(100));
    std::fs::write(&path, scene("radius: 0.25")).expect("a file");
    until(&mut window, "offer to reload", |window| notice(window) == "ball.ron has changed on disk");
    key(&mut window, Key::R);
    assert_eq!(notice(&window), "ball.ron has changed on disk", "a new run changes nothing about the file");
    press(&mut window, "Scenes");
    press(&mut window, "Open glass");
    until(&mut window, "the scene", |window| shows(window, "glass"));
    assert_eq!(notice(&window), "");
}

#[test]
fn path_that_is_not_a_scene_is_refused_in_a_sentence() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open(SIZE);
    let cases =
        [(directory.path().join("nothing.ron"), "no such file"), (directory.path().to_owned(), "is a directory")];
    for (path, why) in cases {
        open_path(&mut window, &path);
        until(&mut window, "notice", |window| {
            notice(window).contains(why) || window.query_by_label_contains(why).is_some()
        });
        escape(&mut window);
        assert!(shows(&window, "ten-objects"));
    }
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

fn drop_on(window: &mut Window, path: &Path) {
    window.input_mut().dropped_files.push(std::sync::Arc::new(Dropped(path.to_owned())));
    window.step();
}

#[test]
fn dropped_scene_is_opened_and_a_dropped_folder_is_refused() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = ball(&directory, "ball.ron");
    let mut window = open(SIZE);
    drop_on(&mut window, &path);
    until(&mut window, "the scene", |window| shows(window, "ball"));
    drop_on(&mut window, directory.path());
    until(&mut window, "notice", |window| notice(window).contains("directory, not a scene"));
    assert!(shows(&window, "ball"));
}

#[test]
fn changed_file_is_offered_for_reload_and_a_removed_one_is_reported() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = ball(&directory, "ball.ron");
    let mut window = open_with(SIZE, path.to_str().expect("a plain path"));
    // The watch must have read the first version of the file.
    std::thread::sleep(std::time::Duration::from_millis(100));
    std::fs::write(&path, scene("radius: 0.25")).expect("a file");
    until(&mut window, "offer to reload", |window| notice(window) == "ball.ron has changed on disk");
    press(&mut window, "Reload");
    until(&mut window, "the new text", |window| session(window).header().scene_text.contains("0.25"));
    std::fs::write(&path, scene("radius: 0.5")).expect("a file");
    until(&mut window, "offer to reload", |window| notice(window) == "ball.ron has changed on disk");
    press(&mut window, "Always");
    until(&mut window, "the next text", |window| session(window).header().scene_text.contains("0.5"));
    std::fs::write(&path, scene("radius: 0.75")).expect("a file");
    until(&mut window, "the last text", |window| session(window).header().scene_text.contains("0.75"));
    press(&mut window, "Set up");
    window.get_by_label("Reload a changed scene at once").click();
    window.run_steps(3);
    assert!(!session(&window).always_reloads());
    std::thread::sleep(std::time::Duration::from_millis(100));
    std::fs::remove_file(&path).expect("a file");
    until(&mut window, "notice", |window| notice(window).contains("ball.ron was deleted"));
    key(&mut window, Key::F5);
    until(&mut window, "notice", |window| notice(window).contains("no such file"));
    key(&mut window, Key::R);
    until(&mut window, "atoms of the open scene", |window| done(window) > 20);
}

#[test]
#[cfg(target_os = "linux")]
fn path_that_is_not_utf_8_is_opened_remembered_and_saved_beside() {
    use std::os::unix::ffi::OsStrExt;
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join(std::ffi::OsStr::from_bytes(b"caf\xe9.ron"));
    std::fs::write(&path, scene("radius: 1")).expect("a file");
    let storage = Storage::default();
    let mut window = launch_with(SIZE, &storage, Launch::default());
    drop_on(&mut window, &path);
    until(&mut window, "the scene", |window| shows(window, "caf\u{fffd}"));
    let mut stored = Storage::default();
    eframe::App::save(window.state_mut(), &mut stored);
    // The next window opens the file again, and shows it among the recent ones.
    let mut window = launch_with(SIZE, &stored, Launch::default());
    assert!(shows(&window, "caf\u{fffd}"));
    assert_eq!(session(&window).recent(), [path]);
    key(&mut window, Key::O);
    press(&mut window, "Open caf\u{fffd}");
    until(&mut window, "the scene", |window| shows(window, "caf\u{fffd}"));
    assert_eq!(notice(&window), "");
}

#[test]
fn run_that_is_cut_off_is_shown_up_to_there() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("run.anel");
    let mut window = open(SIZE);
    until(&mut window, "atoms", |window| done(window) > 100);
    session(&window).stage().log.save(&path).expect("a run file");
    let text = std::fs::read_to_string(&path).expect("its text");
    std::fs::write(&path, &text[..text.len() - 5]).expect("a file");
    open_path(&mut window, &path);
    until(&mut window, "the run", |window| session(window).is_recorded());
    let line = text.lines().count();
    assert_eq!(notice(&window), format!("The run file is cut off in line {line}. The run is shown up to there"));
}

#[test]
fn recorded_run_is_replayed_and_made_live() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("run.anel");
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    type_number(&mut window, "Number of machines", "3");
    press(&mut window, "Full speed");
    until(&mut window, "the end", |window| session(window).stage().phase == Phase::Finished);
    let live = session(&window).stage().log.clone();
    let picture = session(&window).stage().frame.to_srgb8();
    live.save(&path).expect("a run file");

    let mut window = open_with(SIZE, path.to_str().expect("a plain path"));
    assert!(session(&window).is_recorded() && !session(&window).stage().shows_end());
    until(&mut window, "the end", |window| {
        session(window).stage().shows_end() && session(window).stage().source.has_ended()
    });
    let stage = session(&window).stage();
    assert_eq!(stage.log, live);
    assert!(stage.frame.to_srgb8() == picture, "the picture differs");
    // A recorded run cannot be changed, and says so.
    window.get_by_label("recorded");
    window.hover_at(window.get_by_label("Speed of machine 1").rect().center());
    window.run_steps(4);
    window.get_by_label("A recorded run cannot be changed. Set up, Make it live");
    drag(&mut window, "Speed of machine 1", 0.2);
    assert_eq!(session(&window).speed(0), 1.0);
    key(&mut window, Key::R);
    assert!(session(&window).is_recorded() && !session(&window).stage().shows_end());
    press(&mut window, "Set up");
    press(&mut window, "Make it live");
    until(&mut window, "a live run", |window| !session(window).is_recorded() && done(window) > 0);
    assert_eq!(session(&window).header().speeds.len(), 3);
}
