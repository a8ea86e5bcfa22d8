//! Machines that fail and recover, by the menus of rows and of the ring and by keys, and spare machines that join.

use anel::balance::{Condition, Remedy, Strategy};
use anel::language::Language;
use anel::record::RecordKind;
use anel::view::{RingLayout, message_at, time_words};
use egui::Key;
use egui_kittest::kittest::Queryable;

use super::driving::*;

/// A window with an adaptive ring in virtual time.
fn open_adaptive() -> Window {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    switch_to_virtual_time(&mut window);
    choose(&mut window, "Strategy", "Adaptive ring");
    press(&mut window, "Set up");
    until(&mut window, "atoms", |window| done(window) > 50);
    window
}

fn conditions(window: &Window) -> Vec<(u16, Condition)> {
    recorded(window, |what| match what {
        RecordKind::Condition { node, condition } => Some((*node, *condition)),
        _ => None,
    })
}

/// Clicks the right mouse button at a point.
fn press_right(window: &mut Window, at: egui::Pos2) {
    window.hover_at(at);
    window.step();
    for pressed in [true, false] {
        let (button, modifiers) = (egui::PointerButton::Secondary, egui::Modifiers::NONE);
        window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
        window.step();
    }
}

fn is_narrated(window: &Window, words: &str) -> bool {
    let language = session(window).language();
    session(window).stage().narrator().events().any(|(_, event)| event.sentence(language).contains(words))
}

#[test]
fn machine_is_switched_off_and_on_by_the_menu_of_its_row() {
    let mut window = open_adaptive();
    window.get_by_label("Machine 2").click_secondary();
    window.run_steps(3);
    assert_eq!(window.state().selected(), Some(1), "the keys of the menu act on its machine");
    key(&mut window, Key::Escape);
    window.get_by_label("Machine 3").click_secondary();
    press(&mut window, "Switch off");
    until(&mut window, "a loss", |window| conditions(window) == [(2, Condition::Off)]);
    let state = session(&window).stage().state();
    assert_eq!((state.nodes()[2].condition, state.nodes()[2].left()), (Condition::Off, 0));
    until(&mut window, "the ring to notice", |window| is_narrated(window, "the ring closes round it"));
    assert!(is_narrated(&window, "Machine 3 is switched off with "));
    window.get_by_label("Machine 3 now: off").click();
    press(&mut window, "Switch on");
    until(&mut window, "its return", |window| is_narrated(window, "the ring opens for it"));
    let before = session(&window).stage().state().nodes()[2].done;
    until(&mut window, "its work", |window| session(window).stage().state().nodes()[2].done > before);
}

#[test]
fn spare_machine_joins() {
    let mut window = open_adaptive();
    assert_eq!((session(&window).header().spares, session(&window).header().speeds.len()), (1, 9));
    assert!(session(&window).is_spare(8));
    window.get_by_label("Machine 9").click_secondary();
    press(&mut window, "Join");
    until(&mut window, "its work", |window| session(window).stage().state().nodes()[8].done > 0);
    assert!(is_narrated(&window, "Machine 9 joins"));
    drag_speed(&mut window, 9, 50);
    assert_eq!(session(&window).speed(8), 0.5);
}

#[test]
fn ring_has_the_same_menu() {
    let mut window = open_adaptive();
    let ring = window.get_by_label("The ring").rect();
    let top = egui::pos2(ring.center().x, ring.top() + 0.22 * ring.height());
    press_right(&mut window, top);
    press(&mut window, "Hang");
    until(&mut window, "a machine that hangs", |window| conditions(window) == [(0, Condition::Hung)]);
}

#[test]
fn keys_make_the_selected_machine_fail_and_recover() {
    let mut window = open_adaptive();
    key(&mut window, Key::Num2);
    for (pressed, condition) in [(Key::H, Condition::Hung), (Key::U, Condition::CutOff), (Key::X, Condition::Off)] {
        let before = conditions(&window).len();
        key(&mut window, pressed);
        until(&mut window, "a failure", |window| conditions(window).last() == Some(&(1, condition)));
        key(&mut window, pressed);
        until(&mut window, "its end", |window| conditions(window).last() == Some(&(1, Condition::Well)));
        assert_eq!(conditions(&window).len(), before + 2);
    }
}

#[test]
fn ring_without_remedies_says_that_it_hangs() {
    let language = Language::English;
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    switch_to_virtual_time(&mut window);
    until(&mut window, "atoms", |window| done(window) > 50);
    assert_eq!(session(&window).header().rules.strategy, Strategy::Ring);
    key(&mut window, Key::Num1);
    key(&mut window, Key::X);
    for _ in 0..8 {
        key(&mut window, Key::Period);
    }
    until(&mut window, "the run to hang", |window| {
        let (stage, now) = (session(window).stage(), session(window).now());
        let sentence = stage.narrator().sentence(stage.state(), now, language);
        sentence.starts_with("The run hangs because 1 is off and ")
            && sentence.ends_with("atoms are lost: the article's ring cannot recover, the adaptive ring can")
    });
    let row = window.get_by_label("Machine 1").value().unwrap_or_default();
    assert!(row.contains("off, ") && row.contains(" lost") && !row.contains(" 0 left"), "{row}");
    // The clock stands still.
    let stage = session(&window).stage();
    let stopped = time_words(stage.state().head(), stage.playback_scale(), language);
    window.run_steps(8);
    assert!(window.query_all_by_label(&stopped).next().is_some(), "{stopped}");
    press(&mut window, "Again with the adaptive ring");
    until(&mut window, "a run that recovers", |window| session(window).header().rules.strategy == Strategy::Adaptive);
    assert_eq!(session(&window).recovering_scheduler(), None);
}

#[test]
fn keys_of_failures_say_why_they_do_nothing() {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    type_number(&mut window, "Number of machines", "2");
    press(&mut window, "Full speed");
    until(&mut window, "the end", |window| session(window).stage().phase == anel::gui::Phase::Finished);
    until(&mut window, "no notice", |window| notice(window).is_empty());
    key(&mut window, Key::Num1);
    // The result stays with the details of the selection.
    window.get_by_label("Result");
    assert!(window.get_by_label("Selected").rect().height() > 12.0);
    key(&mut window, Key::H);
    assert_eq!(notice(&window), "Only in a live run that has not ended. Press Restart");
}

#[test]
fn message_is_delayed_by_its_menu() {
    let language = Language::English;
    let mut window = open_adaptive();
    let ring = window.get_by_label("The ring").rect();
    let message = |window: &Window| {
        let (stage, now) = (session(window).stage(), session(window).now());
        let points =
            (0..60 * 60).map(|i| [(i % 60) as f32 / 60.0 * ring.width(), (i / 60) as f32 / 60.0 * ring.height()]);
        let layout = RingLayout::new(stage.state().nodes().len(), ring.size().into(), language);
        let found = points.map(|at| (at, message_at(&layout, stage.state(), now, at)));
        found.filter_map(|(at, flight)| flight.map(|flight| (at, flight.from, flight.to))).next()
    };
    until(&mut window, "a message", |window| message(window).is_some());
    key(&mut window, Key::Space);
    let ([x, y], from, to) = message(&window).expect("the message at the paused time");
    let at = ring.min + egui::vec2(x, y);
    press_right(&mut window, at);
    press(&mut window, "Delay by 5 s");
    key(&mut window, Key::Space);
    let held = |window: &Window| {
        recorded(window, |what| match what {
            RecordKind::Delayed { from, to, .. } => Some((*from, *to)),
            _ => None,
        })
    };
    until(&mut window, "a delay", |window| held(window) == [(from, to)]);
    until(&mut window, "event of the delay", |window| is_narrated(window, " are held up for 5.0 s"));
}

#[test]
fn remedy_is_switched_off() {
    let mut window = open_adaptive();
    press(&mut window, "Set up");
    press(&mut window, "Remedies: all remedies");
    window.get_by_label("waking").click();
    until(&mut window, "a run without it", |window| !session(window).header().remedies().has(Remedy::Wake));
    assert_eq!(session(&window).header().remedies().iter().count(), 6);
}
