//! Esc leaves a text field, then closes the innermost of all that is open, and nothing else.

use anel::gui::Closable;
use egui::accesskit::Role;
use egui::{Event, Key};
use egui_kittest::kittest::Queryable;

use super::driving::*;

/// What a key or a button of the top bar opens.
const OPENERS: [(Closable, Key, &str); 10] = [
    (Closable::Help, Key::F1, "Help"),
    (Closable::Scenes, Key::O, "Scenes"),
    (Closable::Accuracy, Key::A, "Accuracy"),
    (Closable::Compare, Key::K, "Compare"),
    (Closable::Lessons, Key::N, "Learn"),
    (Closable::Save, Key::S, "Save…"),
    (Closable::Setup, Key::E, "Set up"),
    (Closable::CameraMode, Key::C, ""),
    (Closable::Selection, Key::Num2, ""),
    (Closable::Projector, Key::F11, ""),
];

fn stack(window: &Window) -> Vec<Closable> {
    window.state().open_stack().to_vec()
}

/// Opens by the button, if there is one: letters belong to an open path field.
fn open_by(window: &mut Window, (_, key_of_it, button): (Closable, Key, &str)) {
    match window.query_by_role_and_label(Role::Button, button) {
        Some(button) => {
            button.click_accesskit();
            window.run_steps(3);
        }
        None => key(window, key_of_it),
    }
}

/// Presses Esc, once more if a text field has the focus. Returns what is closed.
fn close(window: &mut Window) -> Vec<Closable> {
    let before = stack(window);
    if window.ctx.text_edit_focused() {
        key(window, Key::Escape);
        assert!(!window.ctx.text_edit_focused(), "Esc leaves the field");
        assert_eq!(stack(window), before, "Esc in a field closes nothing");
    }
    key(window, Key::Escape);
    let after = stack(window);
    before.into_iter().filter(|closable| !after.contains(closable)).collect()
}

#[test]
fn escape_closes_the_inner_of_two_and_then_the_outer() {
    let mut window = open(SIZE);
    let mut pairs = 0;
    for outer in OPENERS {
        for inner in OPENERS.into_iter().filter(|inner| inner.0 != outer.0) {
            // On the list of lessons a digit opens a lesson.
            if (outer.0, inner.0) == (Closable::Lessons, Closable::Selection) {
                continue;
            }
            open_by(&mut window, outer);
            assert_eq!(stack(&window), [outer.0]);
            open_by(&mut window, inner);
            // One page replaces another, and the list of keys covers what is below.
            if stack(&window) == [outer.0, inner.0] {
                pairs += 1;
                assert_eq!(close(&mut window), [inner.0], "{inner:?} over {outer:?}");
                assert_eq!(close(&mut window), [outer.0]);
            } else {
                while !stack(&window).is_empty() {
                    assert_eq!(close(&mut window).len(), 1, "{inner:?} after {outer:?}");
                }
            }
        }
    }
    assert!(pairs >= 40, "{pairs} pairs");
}

#[test]
fn letters_are_keys_again_when_the_field_of_the_scenes_is_left() {
    let mut window = open(SIZE);
    key(&mut window, Key::O);
    assert!(window.ctx.text_edit_focused());
    key(&mut window, Key::E);
    assert!(!window.state().open_stack().contains(&Closable::Setup), "a letter of the path");
    key(&mut window, Key::Escape);
    key(&mut window, Key::K);
    assert_eq!(window.state().open_stack(), [Closable::Compare]);
}

#[test]
fn escape_closes_a_menu_and_not_its_page() {
    let mut window = open(SIZE);
    key(&mut window, Key::K);
    until(&mut window, "three runs", |window| window.state().compared().len() == 3);
    press(&mut window, "Add A with one change");
    assert!(window.query_by_label("Next machine").is_some());
    key(&mut window, Key::Escape);
    assert!(window.query_by_label("Next machine").is_none());
    assert_eq!(stack(&window), [Closable::Compare]);
    press(&mut window, "Save…");
    assert_eq!(close(&mut window), [Closable::Save]);
    assert_eq!(close(&mut window), [Closable::Compare]);
}

#[test]
fn escape_leaves_a_number_and_not_the_menu_around_it() {
    let mut window = open(SIZE);
    key(&mut window, Key::E);
    let before = session(&window).settings().clone();
    window.get_by_label("Own links: none").click_accesskit();
    window.run_steps(3);
    let latency = "Latency of machine 1 in milliseconds";
    window.get_by_role_and_label(Role::SpinButton, latency).click();
    window.run_steps(3);
    window.event(Event::Text("7".into()));
    window.step();
    key(&mut window, Key::Escape);
    assert!(window.query_by_role_and_label(Role::SpinButton, latency).is_some(), "the menu is still open");
    assert_eq!(session(&window).settings(), &before, "what was typed does not count");
    key(&mut window, Key::Escape);
    assert!(window.query_by_role_and_label(Role::SpinButton, latency).is_none());
}
