//! Control of the run's time: back, forward, slower, faster, and back to the present.

use anel::balance::{Message, Party};
use anel::gui::Phase;
use anel::language::Language;
use anel::record::RecordKind;
use anel::time::Time;
use anel::view::{Snapshot, Subject, time_words};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

use super::driving::*;

/// A window with a finished run.
fn finished() -> Window {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    press(&mut window, "Full speed");
    until(&mut window, "the end", |window| session(window).stage().phase == Phase::Finished);
    press(&mut window, "Set up");
    window
}

/// Drags the slider of the run's time to a fraction of its length, and releases it.
fn scrub(window: &mut Window, to: f32) {
    let rect = window.get_by_role_and_label(Role::Slider, "The run's time").rect();
    let at = |share: f32| egui::pos2(rect.left() + 8.0 + (rect.width() - 16.0) * share, rect.center().y);
    window.drag_at(at(0.5));
    window.step();
    window.hover_at(at(to));
    window.step();
    window.drop_at(at(to));
    window.run_steps(3);
}

fn shift(window: &mut Window, key: Key) {
    window.key_press_modifiers(Modifiers::SHIFT, key);
    window.run_steps(3);
}

/// The shown state of the run without its picture.
fn shown_state(window: &Window) -> String {
    let language = session(window).language();
    let stage = session(window).stage();
    let (state, at) = (stage.state(), stage.state().head());
    format!(
        "{} {:?} {:?} {}",
        stage.records_shown(),
        state.nodes(),
        state.atom_states(),
        stage.narrator().sentence(state, at, language)
    )
}

#[test]
fn running_run_is_rewound_and_returns_to_live() {
    let mut window = open(SIZE);
    until(&mut window, "many atoms", |window| done(window) > 600);
    scrub(&mut window, 0.3);
    let stage = session(&window).stage();
    assert!(!stage.is_live() && stage.phase == Phase::Running && !stage.paused);
    let (then, before) = (stage.latest().done(), stage.state().done());
    assert!(before < then, "{before} {then}");
    // The test draws frames faster than real time: a slow rate keeps the shown time behind.
    for _ in 0..4 {
        key(&mut window, Key::Comma);
    }
    until(&mut window, "more atoms", |window| {
        let stage = session(window).stage();
        stage.latest().done() > then + 20 && stage.state().done() > before
    });
    assert!(!session(&window).stage().is_live());
    press(&mut window, "Live");
    let stage = session(&window).stage();
    assert!(stage.is_live() && stage.state().done() == stage.latest().done());
}

#[test]
fn change_of_a_machine_returns_to_live() {
    let mut window = open(SIZE);
    until(&mut window, "many atoms", |window| done(window) > 400);
    // A slow rate keeps the shown time behind.
    for _ in 0..4 {
        key(&mut window, Key::Comma);
    }
    scrub(&mut window, 0.2);
    drag(&mut window, "Speed of machine 1", 0.0);
    assert!(session(&window).stage().is_live() && notice(&window).starts_with("Back in the present"));
    until(&mut window, "a record", |window| speeds_set(window) == [(0, 0.0)]);
}

#[test]
fn seeking_and_playing_to_a_time_show_the_same() {
    let language = Language::English;
    let mut window = finished();
    scrub(&mut window, 0.2);
    // The run plays until enough atoms are done.
    until(&mut window, "some time", |window| session(window).stage().state().done() > 3_000);
    key(&mut window, Key::Space);
    let (records, played) = (session(&window).stage().records_shown(), shown_state(&window));
    let log = &session(&window).stage().log;
    let mut snapshot = Snapshot::new(&log.header);
    log.records()[..records].iter().for_each(|record| snapshot.apply(record));
    let state = &snapshot.state;
    let expected = format!(
        "{records} {:?} {:?} {}",
        state.nodes(),
        state.atom_states(),
        snapshot.narrator.sentence(state, state.head(), language)
    );
    assert_eq!(played, expected);
    let now = session(&window).now();
    key(&mut window, Key::End);
    key(&mut window, Key::Home);
    assert_eq!((session(&window).now().0, done(&window)), (0, 0));
    window.state_mut().seek(now);
    window.step();
    assert_eq!(shown_state(&window), played);
}

#[test]
fn steps_move_from_event_to_event_and_back() {
    let mut window = finished();
    key(&mut window, Key::Home);
    let is_of_an_atom = |window: &Window| {
        let records = session(window).stage().records_shown();
        matches!(session(window).stage().log.records()[records - 1].kind, RecordKind::AtomDone { .. })
    };
    shift(&mut window, Key::ArrowRight);
    shift(&mut window, Key::ArrowRight);
    assert!(is_of_an_atom(&window) && done(&window) == 2);
    shift(&mut window, Key::ArrowLeft);
    assert!(is_of_an_atom(&window) && done(&window) == 1);
    ctrl(&mut window, Key::ArrowRight);
    let records = session(&window).stage().records_shown();
    let offer = session(&window).stage().log.records()[records - 1].clone();
    let RecordKind::Sent { from: Party::Node(from), message: Message::Offer { who, .. }, .. } = offer.kind else {
        panic!("not an offer: {offer:?}");
    };
    assert_eq!(from, who);
    window.get_by_label_contains("and offers help round the ring");
    key(&mut window, Key::ArrowRight);
    key(&mut window, Key::ArrowLeft);
    assert_eq!(session(&window).stage().records_shown(), records);
    key(&mut window, Key::Home);
    press(&mut window, "Step back");
    assert_eq!(notice(&window), "There is no earlier event");
}

#[test]
fn found_moment_is_shown_and_the_time_stops_there() {
    let mut window = finished();
    key(&mut window, Key::F);
    window.run_steps(2);
    let name = "The biggest transfer: ";
    let biggest = window.get_by_label_contains(name).rect().center();
    window.drag_at(biggest);
    window.step();
    window.drop_at(biggest);
    window.run_steps(4);
    assert!(matches!(window.state().selection(), Some(Subject::Message(_))), "{:?}", window.state().selection());
    let said = window.get_by_label("Selected").value().unwrap_or_default();
    assert!(said.contains(" in proportion to atoms traced, ") && said.contains(" that waited with machine "), "{said}");
    let then = session(&window).now();
    window.run_steps(5);
    assert_eq!(session(&window).now(), then);
    // Esc clears the selection.
    key(&mut window, Key::Escape);
    assert_eq!(window.state().selection(), None);
}

#[test]
fn rate_of_time_goes_down_and_up() {
    let mut window = finished();
    for _ in 0..6 {
        key(&mut window, Key::Comma);
    }
    window.get_by_label("Time goes 100 × slower");
    key(&mut window, Key::Space);
    let passes = |window: &mut Window| {
        let before = now(window);
        window.run_steps(4);
        now(window) - before
    };
    let usual = passes(&mut window);
    for _ in 0..3 {
        key(&mut window, Key::Comma);
    }
    window.get_by_label("Time goes 1\u{a0}000 × slower");
    let slow = passes(&mut window);
    assert!(usual > 8 * slow && slow > 0, "{usual} {slow}");
    for _ in 0..30 {
        window.key_press(Key::Period);
        window.step();
    }
    window.run_steps(3);
    assert!(session(&window).stage().shows_end(), "at the fastest rate the end is reached at once");
}

#[test]
fn only_the_knob_shows_the_time_above_the_line() {
    let mut window = finished();
    let line = window.get_by_role_and_label(Role::Slider, "The run's time").rect();
    let stage = session(&window).stage();
    assert!(stage.is_at_end());
    let knob = line.right_center() - egui::vec2(8.0, 0.0);
    let clock = time_words(stage.lasted(), stage.playback_scale(), Language::English);
    let shown = |window: &Window| -> Vec<egui::Rect> {
        window.query_all_by_label(&clock).map(|label| label.rect()).filter(|rect| rect.top() > 100.0).collect()
    };
    window.hover_at(knob);
    window.run_steps(3);
    let [label] = shown(&window)[..] else { panic!("{:?}", shown(&window)) };
    assert!(label.bottom() <= line.top() + 4.0, "{label:?} covers what is below {line:?}");
    window.hover_at(knob - egui::vec2(80.0, 0.0));
    window.run_steps(3);
    assert_eq!(shown(&window), []);
}

#[test]
fn recorded_run_does_not_wait_for_virtual_time() {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    press(&mut window, "Virtual");
    press(&mut window, "Full speed");
    until(&mut window, "the end", |window| session(window).stage().phase == Phase::Finished);
    key(&mut window, Key::Home);
    window.run_steps(3);
    assert_eq!(window.query_all_by_label_contains("Virtual time begins").count(), 0);
    window.get_by_label_contains("emulated machines an equal band");
}

#[test]
fn virtual_time_runs_at_the_fastest_rate() {
    let mut window = open(SIZE);
    press(&mut window, "Set up");
    switch_to_virtual_time(&mut window);
    type_number(&mut window, "Seconds of the run", "300");
    for _ in 0..30 {
        window.key_press(Key::Period);
        window.step();
    }
    // Five minutes would be too long to wait.
    until(&mut window, "the end", |window| session(window).stage().phase == Phase::Finished);
    assert!(session(&window).stage().length().secs() > 100.0);
}

#[test]
fn timeline_shows_the_work_of_machines_and_selects_an_atom() {
    let mut window = finished();
    key(&mut window, Key::T);
    let said = window.get_by_label("Timeline").value().unwrap_or_default();
    assert!(said.contains(" of the machines' time spent tracing") && said.contains(" messages, "), "{said}");
    let stage = session(&window).stage();
    let bars = stage.lanes().lanes()[2].bars();
    let longest = bars.iter().max_by_key(|bar| bar.to.since(bar.from)).copied().expect("an atom");
    let middle = Time(longest.from.0 / 2 + longest.to.0 / 2);
    let share = middle.0 as f32 / stage.length().0 as f32;
    window.state_mut().seek(middle);
    for _ in 0..9 {
        ctrl(&mut window, Key::ArrowUp);
    }
    let (timeline, lane) = (window.get_by_label("Timeline").rect(), window.get_by_label("Lane of machine 3").rect());
    // The zoom keeps the position of the shown time.
    let at = egui::pos2(timeline.left() + timeline.width() * share, lane.center().y);
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.run_steps(3);
    assert_eq!(window.state().selection(), Some(Subject::Atom(longest.atom)));
    let said = window.get_by_label("Selected").value().unwrap_or_default();
    assert!(said.starts_with(&format!("Atom {}", anel::view::count(longest.atom + 1))), "{said}");
    assert!(!session(&window).stage().is_live() && !session(&window).stage().goes_on());
    key(&mut window, Key::T);
    window.get_by_label("Machine 1");
}

#[test]
fn paused_time_needs_no_repaint() {
    let mut window = finished();
    scrub(&mut window, 0.4);
    key(&mut window, Key::Space);
    until(&mut window, "rest", |window| repaint_delay(window) > std::time::Duration::from_secs(1));
}

#[test]
fn camera_is_moved_and_restored() {
    let mut window = open(SIZE);
    let eye = |window: &Window| session(window).prepared().expect("a scene").opened.scene.camera.eye;
    let (home, begun) = (eye(&window), session(&window).runs_begun());
    key(&mut window, Key::C);
    key(&mut window, Key::ArrowRight);
    assert!(session(&window).is_camera_moving());
    until(&mut window, "a picture from there", |window| session(window).camera_preview().is_some());
    until(&mut window, "a run from there", |window| session(window).runs_begun() == begun + 1);
    assert!((eye(&window) - home).length() > 0.1 && !session(&window).is_camera_moving());
    // The scene text has the new camera.
    let text = &session(&window).header().scene_text;
    assert_eq!(anel::scene::Scene::parse(text).expect("a scene").camera.eye, eye(&window));
    press(&mut window, "Camera back");
    until(&mut window, "the first camera", |window| session(window).runs_begun() == begun + 2);
    assert_eq!(eye(&window), home);
    assert!(window.query_by_label("Camera back").is_none());
}
