//! Every strategy and driver: the settings are in the run's header, and the run ends.

use std::time::Duration;

use anel::balance::{Message, Party, Strategy};
use anel::gui::Phase;
use anel::record::RecordKind;
use anel::runlog::Driver;
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;

use super::driving::*;

fn open_setup() -> Window {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    window
}

fn driver(window: &Window) -> Driver {
    session(window).header().driver
}

fn has_ended(window: &Window) -> bool {
    session(window).stage().phase == Phase::Finished
}

#[test]
fn every_strategy_can_be_chosen_and_traces() {
    let mut window = open_setup();
    let all = [
        ("Equal bands", Strategy::Static, 1),
        ("Estimated bands", Strategy::StaticEstimate, 1),
        ("Farm", Strategy::Farm, 48),
        ("Farm by speed", Strategy::FarmBySpeed, 48),
        ("Farm with leases", Strategy::FarmLeases, 48),
        ("Serial", Strategy::Serial, 1),
        ("Ring", Strategy::Ring, 1),
    ];
    for (name, strategy, part) in all {
        choose(&mut window, "Strategy", name);
        let rules = session(&window).header().rules.clone();
        assert_eq!((rules.strategy, rules.part, driver(&window)), (strategy, part, Driver::Threads));
        until(&mut window, "atoms", |window| done(window) > 20);
    }
    choose(&mut window, "Strategy", "Farm");
    assert_eq!(notice(&window), "Restarted with: farm");
    ctrl(&mut window, Key::Z);
    assert_eq!(session(&window).header().rules.strategy, Strategy::Ring);
}

#[test]
fn rayon_runs_in_real_time_only() {
    let mut window = open_setup();
    switch_to_virtual_time(&mut window);
    choose(&mut window, "Strategy", "Work stealing (rayon)");
    assert_eq!(driver(&window), Driver::WorkStealing);
    press(&mut window, "Virtual");
    assert_eq!(driver(&window), Driver::WorkStealing);
    choose(&mut window, "Strategy", "Equal bands");
    assert_eq!(driver(&window), Driver::Threads);
}

#[test]
fn parts_and_the_network_can_be_set() {
    let mut window = open_setup();
    assert!(window.query_by_role_and_label(Role::SpinButton, "Atoms in a part").is_none());
    choose(&mut window, "Strategy", "Farm");
    type_number(&mut window, "Atoms in a part", "30");
    assert_eq!(session(&window).header().rules.part, 30);
    type_number(&mut window, "Parent's milliseconds for a message", "20");
    assert_eq!(session(&window).header().handling, Duration::from_millis(20));
    // Without a bandwidth there is no shared wire.
    assert!(window.query_by_label("All share one wire").is_none());
    type_number(&mut window, "Kilobytes a second", "100");
    assert_eq!(session(&window).header().link.bandwidth, Some(1e5));
    window.get_by_label("All share one wire").click();
    window.run_steps(3);
    assert!(session(&window).header().link.shared);
    assert_eq!(notice(&window), "Restarted with: one wire for all machines");
    for _ in 0..3 {
        ctrl(&mut window, Key::Z);
    }
    let header = session(&window).header();
    assert_eq!((header.handling, header.link.bandwidth, header.link.shared), (Duration::ZERO, None, false));
    until(&mut window, "atoms", |window| done(window) > 10);
}

#[test]
fn farm_with_a_slow_parent_ends() {
    let mut window = open_setup();
    choose(&mut window, "Strategy", "Farm");
    type_number(&mut window, "Seconds of the run", "2");
    type_number(&mut window, "Parent's milliseconds for a message", "10");
    until(&mut window, "queue at the parent", |window| {
        session(window).stage().state().line_length(session(window).now()) > 2
    });
    until(&mut window, "the end", has_ended);
    let given = |kind: &RecordKind| match kind {
        RecordKind::Sent { from: Party::Parent, message: Message::Part(part), .. } => Some(part.len()),
        _ => None,
    };
    let parts = recorded(&window, given);
    // The results of the last node complete the picture, so its request may stay unanswered.
    let none = parts.iter().filter(|&&atoms| atoms == 0).count();
    assert!((7..=8).contains(&none), "{none} nodes hear that no part is left");
    assert_eq!(parts.iter().sum::<usize>(), 6144 - 8 * 48);
    window.run_steps(2);
    let said = window.get_by_label("Result").value().unwrap_or_default();
    assert!(said.ends_with("Machines asked the parent for 120 parts"), "{said}");
}

#[test]
fn run_in_virtual_time_obeys_and_is_replayed_and_made_live() {
    let mut window = open_setup();
    choose(&mut window, "Strategy", "Farm by speed");
    press(&mut window, "Virtual");
    type_number(&mut window, "Seconds of the run", "3");
    until(&mut window, "many atoms", |window| done(window) > 1000);
    drag(&mut window, "Speed of machine 8", 1.0);
    until(&mut window, "the end", has_ended);
    assert_eq!(speeds_set(&window), [(7, 1.0)]);
    assert_eq!(done(&window), 6144);
    let lasted = session(&window).stage().lasted().secs();
    assert!((1.5..5.0).contains(&lasted), "{lasted} s");
    assert_eq!((driver(&window), session(&window).header().cores), (Driver::Sim, 8));

    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("virtual.anel");
    session(&window).stage().log.save(&path).expect("a file");
    let rules = session(&window).header().rules.clone();
    let mut again = open_with(SIZE, path.to_str().expect("a plain path"));
    assert!(session(&again).is_recorded() && driver(&again) == Driver::Sim);
    until(&mut again, "the speed", |window| session(window).stage().state().nodes()[7].speed == 1.0);
    press(&mut again, "Set up");
    press(&mut again, "Make it live");
    until(&mut again, "live run", |window| !session(window).is_recorded() && done(window) > 10);
    assert_eq!((driver(&again), session(&again).header().rules.clone()), (Driver::Sim, rules));
}

#[test]
fn virtual_time_follows_the_pace() {
    let mut window = open_setup();
    switch_to_virtual_time(&mut window);
    let slow = session(&window).header().pace;
    assert!(slow > 0.0 && slow < 0.5, "{slow}");
    type_number(&mut window, "Seconds of the run", "40");
    assert!((session(&window).header().pace / slow - 0.5).abs() < 1e-6);
    press(&mut window, "Full speed");
    assert_eq!(session(&window).header().pace, 1.0);
    until(&mut window, "the end", has_ended);
}
