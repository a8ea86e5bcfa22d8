//! The save sheet: pictures that are traced again, the preview, and the queue of files.

use std::path::Path;

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;

use super::driving::*;
use super::saving::{FIELD, choose_kind, file_name, typed};

#[test]
fn picture_of_another_size_is_traced_again_and_can_be_cancelled() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 20);
    let save = |window: &mut Window, name: &str| {
        press(window, "Save…");
        choose_kind(window, "any size");
        let path = directory.path().join(name);
        type_path(window, FIELD, &path);
        path
    };
    let path = save(&mut window, "small.png");
    type_number(&mut window, "Pixels across", "200");
    type_number(&mut window, "Pixels down", "50");
    press(&mut window, "Save");
    until(&mut window, "notice", |window| notice(window).starts_with("Saved to"));
    assert_eq!(image::image_dimensions(&path).expect("a PNG"), (200, 50));
    window.get_by_label_contains("The shape differs from the picture's");
    escape(&mut window);
    let path = save(&mut window, "huge.png");
    press(&mut window, "Own size");
    until(&mut window, "its own shape", |window| {
        window.query_by_label_contains("The shape differs from the picture's").is_none()
    });
    press(&mut window, "4K");
    window.get_by_label_contains("The shape differs from the picture's");
    for (side, pixels) in [("Pixels across", "3840"), ("Pixels down", "2160")] {
        let field = window.get_by_role_and_label(Role::SpinButton, side);
        assert_eq!(field.value().as_deref(), Some(pixels));
    }
    window.get_by_label_contains("PNG · 3840 × 2160 pixels");
    type_number(&mut window, "Samples a pixel", "16");
    press(&mut window, "Save");
    until(&mut window, "progress", |window| window.query_by_label("Cancel").is_some());
    press(&mut window, "Cancel");
    assert!(notice(&window).starts_with("Cancelled"), "{}", notice(&window));
    std::thread::sleep(std::time::Duration::from_millis(300));
    window.run_steps(3);
    assert!(!path.exists() && notice(&window).starts_with("Cancelled"));
}

#[test]
fn fields_stay_where_they_are_when_the_preview_comes_and_the_run_ends() {
    let mut window = open(SIZE);
    press(&mut window, "Save…");
    choose_kind(&mut window, "any size");
    press(&mut window, "4K");
    let place = |window: &Window| window.get_by_role_and_label(Role::Button, "Own size").rect();
    let before = place(&window);
    assert!(before.top() > window.get_by_label("Preview").rect().bottom());
    let preview = |window: &Window| window.get_by_label("Preview").value();
    until(&mut window, "a preview", |window| preview(window).as_deref() == Some("3840 × 2160"));
    assert_eq!(place(&window), before);
    until(&mut window, "the end", |window| session(window).stage().phase == anel::gui::Phase::Finished);
    window.run_steps(5);
    assert_eq!(place(&window), before);
}

/// Replaces the path in its field, which need not have the focus.
fn retype_path(window: &mut Window, path: &Path) {
    window.get_by_label(FIELD).click();
    window.run_steps(2);
    type_path(window, FIELD, path);
}

#[test]
fn path_and_facts_follow_the_size_at_once() {
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 20);
    press(&mut window, "Save…");
    choose_kind(&mut window, "any size");
    press(&mut window, "1080p");
    window.get_by_label_contains("The shape differs from the picture's");
    assert_eq!(file_name(&typed(&window)), "ten-objects-1920x1080.png");
    // Every key counts, without Enter.
    window.get_by_role_and_label(Role::SpinButton, "Pixels across").click();
    window.run_steps(3);
    window.event(egui::Event::Text("144".into()));
    window.run_steps(3);
    window.get_by_label_contains("PNG · 144 × 1080 pixels");
    assert_eq!(file_name(&typed(&window)), "ten-objects-144x1080.png");
    choose_kind(&mut window, "animation (GIF)");
    window.run_steps(3);
    window.get_by_label_contains("GIF · 948 × 436 pixels");
    assert!(file_name(&typed(&window)).starts_with("ten-objects-948x436-ring-8"), "{}", file_name(&typed(&window)));
}

#[test]
fn settings_and_sheet_leave_room_for_the_run() {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    press(&mut window, "Save…");
    assert!(window.query_by_label("Number of machines").is_none(), "Save closes Set up");
    window.get_by_label("Save a file");
    press(&mut window, "Set up");
    assert!(window.query_by_label("Save a file").is_none(), "Set up closes Save");
    window.get_by_label("Number of machines");
    // A wide window that is not high has room for both.
    resize(&mut window, [1700.0, 800.0]);
    press(&mut window, "Save…");
    window.get_by_label("Save a file");
    window.get_by_label("Number of machines");
}

#[test]
fn pictures_wait_for_each_other_and_can_be_cancelled_one_by_one() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 20);
    press(&mut window, "Save…");
    let path = |name: &str| directory.path().join(name);
    let save = |window: &mut Window, kind: &str, name: &str| {
        choose_kind(window, kind);
        retype_path(window, &path(name));
        press(window, "Save");
    };
    choose_kind(&mut window, "animation (GIF)");
    type_number(&mut window, "Seconds of the animation", "1");
    type_number(&mut window, "Width of the picture in the animation", "100");
    choose_kind(&mut window, "any size");
    press(&mut window, "4K");
    type_number(&mut window, "Samples a pixel", "16");
    save(&mut window, "any size", "huge.png");
    save(&mut window, "any size", "other.png");
    save(&mut window, "animation (GIF)", "run.gif");
    // What is quickly written does not wait.
    save(&mut window, "timeline", "timeline.svg");
    until(&mut window, "notice", |window| notice(window).contains("timeline.svg"));
    let names =
        |window: &Window| -> Vec<String> { session(window).exports().map(|export| export.name.to_owned()).collect() };
    assert_eq!(names(&window), ["huge.png", "other.png", "run.gif"]);
    window.get_by_label("other.png waits");
    press(&mut window, "Cancel other.png");
    assert_eq!(names(&window), ["huge.png", "run.gif"]);
    // Without the sheet, a message shows the progress.
    escape(&mut window);
    window.get_by_label("Writing huge.png");
    window.get_by_label_contains("then 1 more");
    press(&mut window, "Cancel");
    until(&mut window, "notice", |window| notice(window).contains("run.gif"));
    assert_eq!(image::image_dimensions(path("run.gif")).expect("a GIF"), (521, 396));
    assert!(path("timeline.svg").is_file() && !path("huge.png").exists() && !path("other.png").exists());
    // The next window remembers length and width.
    let mut storage = Storage::default();
    eframe::App::save(window.state_mut(), &mut storage);
    let mut again = launch_with(SIZE, &storage, anel::gui::Launch::default());
    press(&mut again, "Save…");
    choose_kind(&mut again, "animation (GIF)");
    let value = |name: &str| again.get_by_role_and_label(Role::SpinButton, name).value();
    assert_eq!(value("Seconds of the animation").as_deref(), Some("1 s"));
    assert_eq!(value("Width of the picture in the animation").as_deref(), Some("100 px"));
}

#[test]
fn preview_shows_what_will_be_saved() {
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 100);
    press(&mut window, "Save…");
    let preview = |window: &Window| window.get_by_label("Preview").value().unwrap_or_default();
    for (kind, size) in [
        ("render", "640 × 480"),
        ("costs", "640 × 480"),
        ("any size", "1280 × 960"),
        ("ring", "900 × "),
        ("timeline", "1200 × "),
        ("animation (GIF)", "948 × 436"),
        ("run", "All records of the run, to play it again"),
    ] {
        choose_kind(&mut window, kind);
        until(&mut window, kind, |window| preview(window).starts_with(size));
    }
    choose_kind(&mut window, "any size");
    press(&mut window, "Transparent");
    press(&mut window, "4K");
    until(&mut window, "the other size", |window| preview(window) == "3840 × 2160");
}

#[test]
fn region_is_saved_without_its_background() {
    const REGION: &str = "Region: column, row, width, height; empty for the whole picture";
    let directory = tempfile::tempdir().expect("a temporary directory");
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 20);
    press(&mut window, "Save…");
    choose_kind(&mut window, "any size");
    press(&mut window, "Own size");
    press(&mut window, "Transparent");
    let type_region = |window: &mut Window, region: &str| {
        window.get_by_label(REGION).click();
        window.run_steps(2);
        type_path(window, REGION, region.as_ref());
        window.get_by_label(FIELD).click();
        window.run_steps(2);
    };
    type_region(&mut window, "600,0,64,48");
    assert_eq!(file_name(&typed(&window)), "ten-objects-640x480-region-transparent.png");
    let path = directory.path().join("part.png");
    type_path(&mut window, FIELD, &path);
    press(&mut window, "Save");
    window.get_by_label_contains("not inside the picture of 640x480");
    type_region(&mut window, "100,60,64,48");
    press(&mut window, "Save");
    until(&mut window, "notice", |window| notice(window).starts_with("Saved to"));
    let part = image::open(&path).expect("a PNG");
    assert_eq!((part.width(), part.height(), part.color()), (64, 48, image::ColorType::Rgba8));
}
