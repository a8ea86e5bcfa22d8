//! Waiting: a picture is traced for virtual time with its progress, once, and can be cancelled.

use anel::gui::Session;
use anel::picture::Size;
use anel::runlog::Driver;
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;

use super::driving::*;

fn runs(window: &Window) -> usize {
    session(window).runs_begun()
}

fn is_tracing(window: &Window) -> bool {
    session(window).loading().is_some_and(|loading| loading.traced.share > 0.0 && loading.traced.elapsed_s > 0.5)
}

/// The driver of the run on the stage, and that of the settings.
fn drivers(window: &Window) -> [Driver; 2] {
    [session(window).header().driver, session(window).settings().driver]
}

#[test]
fn cancelled_tracing_leaves_the_run_as_it_was() {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    let (before, speeds) = (runs(&window), session(&window).settings().speeds.clone());
    type_number(&mut window, "Width in pixels", "2000");
    until(&mut window, "large picture", |window| session(window).header().size.width() == 2000);
    until(&mut window, "atoms", |window| done(window) > 5);
    press(&mut window, "Virtual");
    until(&mut window, "tracing", is_tracing);
    window.get_by_role_and_label(Role::Button, "Cancel");
    window.get_by_label_contains("Tracing the picture: ");
    let stage = |window: &Window| {
        let session: &Session = session(window);
        (session.stage().paused, session.stage().is_live())
    };
    assert_eq!(stage(&window), (true, true), "the run leaves the cores to the tracing");
    // What does not change the picture does not begin the tracing again.
    let share = |window: &Window| session(window).loading().map_or(0.0, |loading| loading.traced.share);
    let traced = share(&window);
    type_number(&mut window, "Number of machines", "9");
    key(&mut window, Key::R);
    assert!(share(&window) >= traced, "traced from the beginning");
    press(&mut window, "Cancel");
    assert!(session(&window).loading().is_none());
    assert_eq!((drivers(&window), stage(&window)), ([Driver::Threads; 2], (false, true)));
    assert_eq!((runs(&window), &session(&window).settings().speeds), (before + 1, &speeds));
    ctrl(&mut window, Key::Z);
    assert_eq!(session(&window).settings().size, Size::new(640, 480).expect("a picture"), "the change before it");
}

#[test]
fn picture_is_traced_once() {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    type_number(&mut window, "Width in pixels", "160");
    type_number(&mut window, "Height in pixels", "120");
    switch_to_virtual_time(&mut window);
    let begins_at_once = |window: &mut Window, change: &dyn Fn(&mut Window)| {
        let before = runs(window);
        change(window);
        assert!(session(window).loading().is_none() && runs(window) > before);
    };
    begins_at_once(&mut window, &|window| type_number(window, "Number of machines", "5"));
    begins_at_once(&mut window, &|window| choose(window, "Strategy", "Farm"));
    begins_at_once(&mut window, &|window| key(window, Key::R));
    press(&mut window, "Set up");
    key(&mut window, Key::K);
    until(&mut window, "the comparison", |window| window.state().compared().len() == 3);
    key(&mut window, Key::K);
    key(&mut window, Key::N);
    press(&mut window, "Why not bands?");
    until(&mut window, "the lesson", |window| window.state().lesson().is_some());
    begins_at_once(&mut window, &|window| press(window, "Leave the lesson"));
    assert!(!session(&window).is_recorded());
}

#[test]
fn lesson_that_is_being_prepared_is_cancelled() {
    let mut window = open(SIZE);
    let is_preparing = |window: &Window| window.query_by_label("Tracing the pictures of the lesson").is_some();
    key(&mut window, Key::N);
    press(&mut window, "Why not bands?");
    assert!(is_preparing(&window));
    press(&mut window, "Cancel");
    assert!(!is_preparing(&window), "the list stays open");
    press(&mut window, "Why not bands?");
    key(&mut window, Key::N);
    assert!(window.query_by_label("Why not bands?").is_none(), "the list is closed");
    key(&mut window, Key::N);
    assert!(!is_preparing(&window), "the lesson would open by itself");
}
