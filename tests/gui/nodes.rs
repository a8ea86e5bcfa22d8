//! A machine: its speed by slider, number and key, its pause, its selection, and undo.

use anel::gui::Phase;
use anel::record::RecordKind;
use anel::time::Time;
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;

use super::driving::*;

#[test]
fn slider_changes_the_speed_while_it_is_dragged() {
    let mut window = open(SIZE);
    let slider = window.get_by_label("Speed of machine 1").rect();
    window.drag_at(slider.right_center() - egui::vec2(8.0, 0.0));
    window.step();
    window.hover_at(slider.center());
    until(&mut window, "a record of the new speed", |window| !speeds_set(window).is_empty());
    let (node, speed) = speeds_set(&window)[0];
    assert!(node == 0 && speed > 0.03 && speed < 0.15, "{node} {speed}");
    window.hover_at(slider.left_center());
    window.step();
    window.drop_at(slider.left_center());
    until(&mut window, "a record of speed 0", |window| speeds_set(window).last() == Some(&(0, 0.0)));
}

#[test]
fn slider_sets_low_speeds_and_moves_by_steps() {
    let mut window = open(SIZE);
    fn slider(window: &Window) -> egui_kittest::Node<'_> {
        window.get_by_role_and_label(Role::Slider, "Speed of machine 8")
    }
    let (whole, mut last) = (slider(&window).rect(), 0.0);
    for percent in [1, 2, 5, 10, 20, 50, 100] {
        let at = drag_speed(&mut window, 8, percent);
        assert_eq!(session(&window).speed(7), f64::from(percent) / 100.0);
        assert!(at - last >= 0.1 * whole.width(), "{percent} % is {} px right of the one before", at - last);
        last = at;
    }
    drag(&mut window, "Speed of machine 8", 0.0);
    assert_eq!(session(&window).speed(7), 0.0);
    // The wheel over the slider, and the arrow keys, which it has after the drag.
    window.hover_at(slider(&window).rect().center());
    window.step();
    for (lines, speed) in [(1.0, 0.01), (2.0, 0.05), (-1.0, 0.02)] {
        wheel(&mut window, lines);
        assert_eq!(session(&window).speed(7), speed);
    }
    slider(&window).focus();
    window.run_steps(2);
    for (arrow, speed) in [(Key::ArrowRight, 0.05), (Key::ArrowRight, 0.1), (Key::ArrowLeft, 0.05)] {
        key(&mut window, arrow);
        assert_eq!(session(&window).speed(7), speed);
    }
    assert!(session(&window).stage().is_live(), "the arrows are the slider's");
}

#[test]
fn exact_speed_can_be_typed() {
    let mut window = open(SIZE);
    type_number(&mut window, "Exact speed of machine 2", "37");
    until(&mut window, "a record", |window| speeds_set(window).last() == Some(&(1, 0.37)));
    // No machine is faster than the reference machine.
    type_number(&mut window, "Exact speed of machine 2", "370");
    until(&mut window, "a record", |window| speeds_set(window).last() == Some(&(1, 1.0)));
}

#[test]
fn speed_set_during_a_pause_applies_after_it() {
    let mut window = open(SIZE);
    until(&mut window, "a traced atom", |window| done(window) > 5);
    key(&mut window, Key::Space);
    drag_speed(&mut window, 8, 50);
    assert_eq!(session(&window).speed(7), 0.5);
    press(&mut window, "Resume");
    until(&mut window, "a record", |window| speeds_set(window).last() == Some(&(7, 0.5)));
}

#[test]
fn earlier_moment_of_a_finished_run_has_its_own_speeds() {
    let mut window = open(SIZE);
    key(&mut window, Key::E);
    window.get_by_label("Full speed").click_accesskit();
    window.run_steps(3);
    until(&mut window, "the end", |window| session(window).stage().phase == Phase::Finished);
    type_number(&mut window, "Exact speed of machine 2", "37");
    assert_eq!(session(&window).speed(1), 0.37, "the next run's");
    window.state_mut().seek(Time(1));
    window.run_steps(2);
    assert_eq!(session(&window).speed(1), 1.0, "the run's at its beginning");
    type_number(&mut window, "Exact speed of machine 2", "50");
    assert!(session(&window).stage().shows_end() && notice(&window).contains("for the next one"));
    assert_eq!(session(&window).speed(1), 0.5);
}

#[test]
fn machine_is_paused_and_resumed() {
    let mut window = open(SIZE);
    until(&mut window, "a traced atom", |window| done(window) > 5);
    let pauses = |window: &Window| {
        recorded(window, |what| match what {
            RecordKind::Paused { node } => Some((*node, true)),
            RecordKind::Resumed { node } => Some((*node, false)),
            _ => None,
        })
    };
    press(&mut window, "Pause machine 2");
    until(&mut window, "a pause", |window| pauses(window) == [(1, true)]);
    let then = session(&window).stage().state().nodes()[1].done;
    assert!(session(&window).is_node_paused(1) && session(&window).stage().state().nodes()[1].paused);
    until(&mut window, "atoms of other machines", |window| done(window) > 200);
    assert!(session(&window).stage().state().nodes()[1].done <= then + 1);
    press(&mut window, "Pause machine 2");
    until(&mut window, "work", |window| pauses(window) == [(1, true), (1, false)]);
    until(&mut window, "its atoms", |window| session(window).stage().state().nodes()[1].done > then + 1);
}

#[test]
fn machine_is_selected_and_changed_with_keys() {
    let mut window = open(SIZE);
    key(&mut window, Key::Plus);
    assert!(notice(&window).contains("select a machine"), "{}", notice(&window));
    key(&mut window, Key::Num8);
    assert_eq!(window.state().selected(), Some(7));
    key(&mut window, Key::Plus);
    assert_eq!(session(&window).speed(7), 0.2);
    for speed in [0.1, 0.05, 0.02, 0.01, 0.0, 0.0] {
        key(&mut window, Key::Minus);
        assert_eq!(session(&window).speed(7), speed);
    }
    until(&mut window, "records", |window| speeds_set(window).len() == 6);
    key(&mut window, Key::P);
    assert!(session(&window).is_node_paused(7));
    key(&mut window, Key::Num9);
    assert_eq!(notice(&window), "This run has no machine 9");
    key(&mut window, Key::Num8);
    assert_eq!(window.state().selected(), None);
    window.get_by_label("Machine 3").click();
    window.run_steps(2);
    assert_eq!(window.state().selected(), Some(2));
    key(&mut window, Key::Escape);
    assert_eq!(window.state().selected(), None);
}

#[test]
fn click_on_the_ring_selects_a_machine() {
    let mut window = open(SIZE);
    let ring = window.get_by_label("The ring").rect();
    let top = egui::pos2(ring.center().x, ring.top() + 0.22 * ring.height());
    for selected in [Some(0), None] {
        window.drag_at(top);
        window.step();
        window.drop_at(top);
        window.run_steps(2);
        assert_eq!(window.state().selected(), selected);
    }
}

#[test]
fn change_of_speed_is_undone_and_redone() {
    let mut window = open(SIZE);
    drag_speed(&mut window, 1, 30);
    drag_speed(&mut window, 1, 60);
    let second = session(&window).speed(0);
    ctrl(&mut window, Key::Z);
    let first = session(&window).speed(0);
    assert!(first < 0.5 && second > 0.5, "{first} {second}");
    press(&mut window, "Undo");
    assert_eq!(session(&window).speed(0), 1.0);
    assert_eq!(notice(&window), "Undone. Now: machine 1 at 100 %");
    until(&mut window, "a record", |window| speeds_set(window).last() == Some(&(0, 1.0)));
    ctrl(&mut window, Key::Y);
    window.key_press_modifiers(egui::Modifiers::COMMAND | egui::Modifiers::SHIFT, Key::Z);
    window.run_steps(3);
    assert_eq!(session(&window).speed(0), second);
    until(&mut window, "a record", |window| speeds_set(window).last() == Some(&(0, second)));
}
