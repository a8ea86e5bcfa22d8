//! Settings of all machines and of the next run.

use std::time::Duration;

use anel::balance::{Party, Strategy};
use anel::gui::{Pace, Settings};
use anel::record::RecordKind;
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;

use super::driving::*;

/// A window with the panel of settings open.
fn open_setup() -> Window {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    window
}

#[test]
fn speeds_of_all_machines_apply_to_the_current_run() {
    let mut window = open_setup();
    until(&mut window, "many atoms", |window| done(window) > 100);
    press(&mut window, "All equal");
    until(&mut window, "a record", |window| speeds_set(window) == [(7, 1.0)]);
    press(&mut window, "Old laboratory");
    until(&mut window, "records", |window| session(window).stage().state().nodes()[6].speed == 0.21);
    press(&mut window, "Random");
    let random = session(&window).settings().speeds.clone();
    type_number(&mut window, "Seed", "77");
    let other = session(&window).settings().speeds.clone();
    assert_ne!(random, other);
    type_number(&mut window, "Seed", "1");
    assert_eq!(session(&window).settings().speeds, random);
    press(&mut window, "One slow");
    until(&mut window, "a record", |window| session(window).stage().state().nodes()[7].speed == 0.1);
    // The run was not restarted.
    assert!(done(&window) > 100);
}

#[test]
fn latency_applies_to_the_current_run() {
    let mut window = open_setup();
    until(&mut window, "many atoms", |window| done(window) > 100);
    type_number(&mut window, "Latency in milliseconds", "250");
    let set = |window: &Window| {
        recorded(window, |what| if let RecordKind::LatencySet { latency } = what { Some(*latency) } else { None })
    };
    until(&mut window, "a record", |window| set(window).last() == Some(&Duration::from_millis(250)));
    assert_eq!(session(&window).stage().state().latency(), Duration::from_millis(250));
    drag(&mut window, "Latency slider", 0.0);
    until(&mut window, "a record", |window| set(window).last() == Some(&Duration::ZERO));
    assert!(done(&window) > 100);
    ctrl(&mut window, Key::Z);
    assert_eq!(session(&window).settings().latency, 250.0);
}

#[test]
fn own_latency_applies_to_the_current_run_and_own_bandwidth_restarts_it() {
    let mut window = open_setup();
    until(&mut window, "many atoms", |window| done(window) > 100);
    press(&mut window, "Own links: none");
    type_number(&mut window, "Latency of machine 3 in milliseconds", "250");
    let set = |window: &Window| {
        let of = |kind: &RecordKind| match kind {
            RecordKind::OwnLatencySet { party, latency } => Some((*party, *latency)),
            _ => None,
        };
        recorded(window, of).last().copied()
    };
    let (machine, own) = (Party::Node(2), Some(Duration::from_millis(250)));
    until(&mut window, "a record", |window| set(window) == Some((machine, own)));
    assert_eq!(session(&window).stage().state().own_link(machine).latency, own);
    // A value like that of all others is none of its own.
    type_number(&mut window, "Latency of machine 3 in milliseconds", "40");
    until(&mut window, "a record", |window| set(window) == Some((machine, None)));
    assert!(done(&window) > 100);
    ctrl(&mut window, Key::Z);
    until(&mut window, "a record", |window| set(window) == Some((machine, own)));
    type_number(&mut window, "Kilobytes a second of machine 3", "100");
    let link = session(&window).header().link.own(machine);
    assert_eq!((link.latency, link.bandwidth), (own, Some(1e5)));
    assert_eq!(notice(&window), "Restarted with: machine 3 with a link of 250 ms, 100 kB/s");
    assert_eq!(session(&window).settings().own_link_count(), 1);
}

#[test]
fn number_of_machines_restarts_the_run_and_can_be_undone() {
    let mut window = open_setup();
    until(&mut window, "many atoms", |window| done(window) > 100);
    let begun = session(&window).runs_begun();
    type_number(&mut window, "Number of machines", "32");
    assert_eq!(session(&window).runs_begun(), begun + 1);
    assert_eq!(notice(&window), "Restarted with: 32 machines");
    assert_eq!((session(&window).header().speeds.len(), session(&window).stage().state().nodes().len()), (32, 32));
    window.get_by_label("Machine 32");
    // No run starts before the slider is released.
    let rect = window.get_by_label("Machines slider").rect();
    window.drag_at(rect.left_center());
    window.run_steps(3);
    assert_eq!(session(&window).header().speeds.len(), 32);
    window.drop_at(rect.left_center());
    window.run_steps(3);
    assert_eq!(session(&window).header().speeds.len(), 1);
    ctrl(&mut window, Key::Z);
    ctrl(&mut window, Key::Z);
    assert_eq!(session(&window).header().speeds.len(), 8);
    until(&mut window, "atoms", |window| done(window) > 10);
}

#[test]
fn tab_and_wheel_apply_a_number() {
    let mut window = open_setup();
    until(&mut window, "many atoms", |window| done(window) > 100);
    let machines = |window: &Window| session(window).header().speeds.len();
    window.get_by_role_and_label(Role::SpinButton, "Number of machines").click();
    window.run_steps(3);
    // All keys of a frame that took long.
    let tab =
        Event::Key { key: Key::Tab, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
    window.input_mut().events.extend([Event::Text("1".into()), Event::Text("6".into()), tab]);
    window.run_steps(3);
    assert_eq!(machines(&window), 16);
    assert_eq!(notice(&window), "Restarted with: 16 machines");
    // The wheel over a field and over its slider; the run restarts once, after the last notch.
    let begun = session(&window).runs_begun();
    for (name, lines, count) in [("Number of machines", 2.0, 18), ("Machines slider", -3.0, 15)] {
        window.hover_at(window.get_by_label(name).rect().center());
        window.run_steps(2);
        wheel(&mut window, lines);
        until(&mut window, name, |window| machines(window) == count);
    }
    assert_eq!(session(&window).runs_begun(), begun + 2);
    window.hover_at(window.get_by_label("Latency slider").rect().center());
    window.run_steps(2);
    wheel(&mut window, 9.0);
    until(&mut window, "a round latency", |window| session(window).settings().latency == 200.0);
    drag(&mut window, "Latency slider", 0.35);
    until(&mut window, "a round latency", |window| session(window).settings().latency == 250.0);
}

#[test]
fn size_atoms_and_strategy_restart_the_run() {
    let mut window = open_setup();
    type_number(&mut window, "Pixels in an atom", "200");
    assert_eq!(session(&window).header().division.atom_pixels(), 200);
    type_number(&mut window, "Fewest atoms of a transfer", "5");
    assert_eq!(session(&window).header().rules.part, 5);
    type_number(&mut window, "Width in pixels", "400");
    until(&mut window, "a small picture", |window| session(window).header().size.to_string() == "400x480");
    type_number(&mut window, "Height in pixels", "300");
    until(&mut window, "a small picture", |window| session(window).header().size.to_string() == "400x300");
    type_number(&mut window, "Samples", "2");
    until(&mut window, "samples", |window| session(window).header().quality.samples == 2);
    choose(&mut window, "Strategy", "Serial");
    assert_eq!(session(&window).header().rules.strategy, Strategy::Serial);
    until(&mut window, "atoms of the first", |window| session(window).stage().state().nodes()[0].done > 10);
    assert_eq!(done(&window), session(&window).stage().state().nodes()[0].done);
    choose(&mut window, "Strategy", "Ring");
    assert_eq!(session(&window).header().rules.strategy, Strategy::Ring);
    window.get_by_label("Usual sizes").click();
    window.run_steps(3);
    window.get_by_label("320x240").click();
    until(&mut window, "a usual size", |window| session(window).header().size.to_string() == "320x240");
    until(&mut window, "atoms", |window| done(window) > 10);
}

#[test]
fn pace_restarts_the_run() {
    let mut window = open_setup();
    let pace = session(&window).header().pace;
    type_number(&mut window, "Seconds of the run", "40");
    assert_eq!(session(&window).settings().pace, Pace::Lasts(40.0));
    assert!((session(&window).header().pace / pace - 0.5).abs() < 1e-6);
    press(&mut window, "Full speed");
    assert_eq!(session(&window).header().pace, 1.0);
    assert!(window.query_by_label("Seconds of the run").is_none());
    press(&mut window, "Slowly");
    assert!(session(&window).header().pace < 1.0);
}

#[test]
fn typed_number_counts_as_a_whole_or_not_at_all() {
    let mut window = open_setup();
    for typed in ["12,5", "12.5", "12,5 ms"] {
        type_number(&mut window, "Latency in milliseconds", "40");
        type_number(&mut window, "Latency in milliseconds", typed);
        assert_eq!((session(&window).settings().latency, notice(&window)), (12.5, String::new()), "{typed}");
    }
    type_number(&mut window, "Exact speed of machine 2", "12,5");
    assert_eq!(session(&window).speed(1), 0.125);
    for (field, typed, why) in [
        ("Latency in milliseconds", "30x", "is not a number"),
        ("Latency in milliseconds", "1,234.5", "thousands without a mark"),
        ("Number of machines", "2,5", "is not a whole number"),
        ("Exact speed of machine 2", "fast", "is not a number"),
    ] {
        let before = session(&window).settings().clone();
        type_number(&mut window, field, typed);
        let said = notice(&window);
        assert!(said.starts_with(&format!("“{typed}”")) && said.contains(why) && said.contains(field), "{said}");
        assert_eq!(*session(&window).settings(), before);
        press(&mut window, "Close notice");
    }
}

#[test]
fn impossible_setting_is_refused_in_a_sentence() {
    let mut window = open_setup();
    until(&mut window, "many atoms", |window| done(window) > 100);
    type_number(&mut window, "Pixels in an atom", "1");
    assert!(notice(&window).contains("307200 atoms; the window shows up to 262144"), "{}", notice(&window));
    assert!(done(&window) > 100);
    assert_eq!(session(&window).settings().atom, 50);
    // A larger number becomes the largest possible one.
    type_number(&mut window, "Number of machines", "999");
    assert_eq!(session(&window).header().speeds.len(), Settings::MAX_NODES);
}

#[test]
fn demonstration_can_be_restored() {
    let mut window = open_setup();
    type_number(&mut window, "Number of machines", "3");
    press(&mut window, "Back to the demonstration");
    assert_eq!(*session(&window).settings(), Settings::default());
    assert_eq!(session(&window).header().speeds.len(), 8);
    key(&mut window, Key::E);
    assert!(window.query_by_label("Number of machines").is_none());
}

#[test]
fn demonstration_has_its_scene_and_camera_and_is_undone() {
    let mut window = open_with(SIZE, "rings");
    press(&mut window, "Set up");
    type_number(&mut window, "Number of machines", "16");
    assert_eq!(session(&window).settings().speeds[15], 0.1, "one is slow as before");
    let shows = |window: &mut Window, scene: &str, nodes: usize| {
        until(window, scene, |window| session(window).loading().is_none() && session(window).header().scene == scene);
        assert_eq!(session(window).header().speeds.len(), nodes);
    };
    press(&mut window, "Back to the demonstration");
    shows(&mut window, "ten-objects", 8);
    key(&mut window, Key::PageUp);
    until(&mut window, "the moved camera", |window| {
        session(window).is_camera_moved() && !session(window).is_camera_moving()
    });
    // A picture of another size has the same camera, and the scene's own stays known.
    type_number(&mut window, "Width in pixels", "320");
    until(&mut window, "small picture", |window| session(window).header().size.width() == 320);
    assert!(session(&window).is_camera_moved());
    press(&mut window, "Back to the demonstration");
    until(&mut window, "the scene's camera", |window| !session(window).is_camera_moved());
    assert_eq!(*session(&window).settings(), Settings::default());
    ctrl(&mut window, Key::Z);
    until(&mut window, "the moved camera", |window| session(window).is_camera_moved());
    assert_eq!(session(&window).settings().size.width(), 320);
    ctrl(&mut window, Key::Z);
    ctrl(&mut window, Key::Z);
    shows(&mut window, "rings", 16);
    ctrl(&mut window, Key::Y);
    shows(&mut window, "ten-objects", 8);
}
