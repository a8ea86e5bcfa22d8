//! A run in the window: it starts at once, pauses, starts anew, and rests when nothing moves.

use std::time::Duration;

use anel::gui::Phase;
use egui::Key;
use egui_kittest::kittest::Queryable;

use super::driving::*;

#[test]
fn a_run_starts_at_once() {
    let mut window = open(SIZE);
    until(&mut window, "a traced atom", |window| done(window) > 20);
    let speeds: Vec<_> = session(&window).stage().state().nodes().iter().map(|node| node.speed).collect();
    assert_eq!((speeds.len(), speeds[7]), (8, 0.1));
}

#[test]
fn pause_stops_the_clock_and_the_work() {
    let mut window = open(SIZE);
    until(&mut window, "a traced atom", |window| done(window) > 5);
    press(&mut window, "Pause");
    assert!(session(&window).stage().paused);
    let paused_at = now(&window);
    // What was under way when the clock stopped may still be told.
    std::thread::sleep(Duration::from_millis(100));
    window.run_steps(2);
    let told = |window: &Window| (done(window), session(window).stage().log.records().len());
    let then = told(&window);
    std::thread::sleep(Duration::from_millis(200));
    window.run_steps(5);
    assert_eq!((now(&window), told(&window)), (paused_at, then));
    key(&mut window, Key::Space);
    until(&mut window, "more atoms", |window| done(window) > then.0);
    assert!(now(&window) > paused_at);
}

#[test]
fn restart_begins_anew_with_the_speeds_as_they_are() {
    let mut window = open(SIZE);
    drag(&mut window, "Speed of node 3", 0.0);
    until(&mut window, "speed 0", |window| session(window).stage().state().nodes()[2].speed == 0.0);
    until(&mut window, "many atoms", |window| done(window) > 300);
    let begun = session(&window).runs_begun();
    press(&mut window, "Restart");
    assert_eq!(session(&window).runs_begun(), begun + 1);
    assert_eq!(session(&window).header().speeds[2], 0.0);
    until(&mut window, "many atoms", |window| done(window) > 100);
    key(&mut window, Key::R);
    assert_eq!(session(&window).runs_begun(), begun + 2);
    assert_eq!(session(&window).stage().phase, Phase::Running);
}

#[test]
fn a_finished_run_says_what_came_of_it_and_begins_anew() {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    press(&mut window, "All equal");
    press(&mut window, "Full speed");
    until(&mut window, "the end", |window| session(window).stage().phase == Phase::Finished);
    window.run_steps(2);
    let outcome = session(&window).stage().result().expect("an outcome");
    let said = window.get_by_label("Result").value().unwrap_or_default();
    assert!(said.contains(&format!("efficiency {:.0} %", 100.0 * outcome.efficiency)), "{said}");
    // There is nothing to pause any more: it is shown again from its beginning.
    for _ in 0..9 {
        key(&mut window, Key::Comma);
    }
    key(&mut window, Key::Space);
    let stage = session(&window).stage();
    assert!(!stage.paused && !stage.shows_end() && stage.goes_on() && stage.phase == Phase::Finished);
    key(&mut window, Key::R);
    assert_eq!(session(&window).stage().phase, Phase::Running);
}

#[test]
fn all_machines_at_rest_draw_little_and_a_pause_nothing() {
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 20);
    assert!(rests(&window) <= Duration::from_millis(40));
    for node in 1..=8 {
        drag(&mut window, &format!("Speed of node {node}"), 0.0);
    }
    until(&mut window, "rest", |window| rests(window) >= Duration::from_millis(200));
    until(&mut window, "a sentence", |window| {
        window.query_by_label_contains("All machines are stopped (0 %)").is_some()
    });
    key(&mut window, Key::Space);
    until(&mut window, "a window at rest", |window| rests(window) > Duration::from_secs(1));
}

#[test]
fn the_keys_are_listed_and_the_list_goes_away() {
    let mut window = open(SIZE);
    key(&mut window, Key::F1);
    window.get_by_label("What the keys do");
    key(&mut window, Key::Escape);
    assert!(window.query_by_label("What the keys do").is_none());
    press(&mut window, "Help");
    press(&mut window, "Close help");
    assert!(window.query_by_label("What the keys do").is_none());
}

#[test]
fn dark_becomes_light() {
    let mut window = open(SIZE);
    let before = window.ctx.theme();
    press(&mut window, "Dark or light");
    assert_ne!(window.ctx.theme(), before);
    key(&mut window, Key::D);
    assert_eq!(window.ctx.theme(), before);
}

#[test]
fn the_zoom_has_limits() {
    let mut window = open(SIZE);
    for (plus_or_minus, limit) in [(Key::Plus, 2.0), (Key::Minus, 0.6)] {
        for _ in 0..20 {
            ctrl(&mut window, plus_or_minus);
            assert!((0.6..=2.0).contains(&window.ctx.zoom_factor()));
        }
        assert_eq!(window.ctx.zoom_factor(), limit);
    }
    ctrl(&mut window, Key::Num0);
    assert_eq!(window.ctx.zoom_factor(), 1.0);
}
