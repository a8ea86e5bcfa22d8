//! A run in the window: it starts at once, pauses, restarts, and needs no repaint when nothing moves.

use std::time::Duration;

use anel::gui::Phase;
use egui::Key;
use egui_kittest::kittest::Queryable;

use super::driving::*;

#[test]
fn run_starts_at_once() {
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
    // Records from before the pause may still arrive.
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
fn restart_keeps_the_speeds() {
    let mut window = open(SIZE);
    drag(&mut window, "Speed of machine 3", 0.0);
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
fn finished_run_shows_its_result_and_can_be_replayed_or_restarted() {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    press(&mut window, "All equal");
    press(&mut window, "Full speed");
    until(&mut window, "the end", |window| session(window).stage().phase == Phase::Finished);
    window.run_steps(2);
    let outcome = session(&window).stage().result().expect("an outcome");
    let said = window.get_by_label("Result").value().unwrap_or_default();
    assert!(said.contains(&format!("efficiency {:.0} %", 100.0 * outcome.efficiency)), "{said}");
    // A finished run cannot be paused: Space replays it from its beginning.
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
fn stopped_machines_need_few_repaints_and_a_pause_none() {
    let mut window = open(SIZE);
    until(&mut window, "traced atoms", |window| done(window) > 20);
    assert!(repaint_delay(&window) <= Duration::from_millis(40));
    for node in 1..=8 {
        drag(&mut window, &format!("Speed of machine {node}"), 0.0);
    }
    until(&mut window, "rest", |window| repaint_delay(window) >= Duration::from_millis(200));
    until(&mut window, "a sentence", |window| {
        window.query_by_label_contains("All machines are stopped (0 %)").is_some()
    });
    key(&mut window, Key::Space);
    until(&mut window, "a window at rest", |window| repaint_delay(window) > Duration::from_secs(1));
}

#[test]
fn list_of_keys_opens_and_closes() {
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
fn theme_is_switched() {
    let mut window = open(SIZE);
    let before = window.ctx.theme();
    press(&mut window, "Dark or light");
    assert_ne!(window.ctx.theme(), before);
    key(&mut window, Key::D);
    assert_eq!(window.ctx.theme(), before);
}

#[test]
fn zoom_has_limits() {
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
