//! The page of compared runs: comparing, forking, explaining and saving.

use std::time::Duration;

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};

use super::driving::*;

type Runs = Vec<(String, Option<Duration>)>;

fn runs(window: &Window) -> Runs {
    window.state().compared()
}

fn names(window: &Window) -> Vec<String> {
    runs(window).into_iter().map(|(name, _)| name).collect()
}

fn makespan(runs: &Runs, name: &str) -> Duration {
    let run = runs.iter().find(|(other, _)| other == name);
    run.and_then(|(_, makespan)| *makespan).unwrap_or_else(|| panic!("{name} of {runs:?}"))
}

/// The texts of the widgets with this role.
fn texts(window: &Window, role: Role) -> Vec<String> {
    let of = |node: egui_kittest::Node<'_>| {
        let node = node.accesskit_node();
        node.label().or_else(|| node.value()).unwrap_or_default()
    };
    window.query_all_by_role(role).map(of).collect()
}

/// The texts of the clocks.
fn times(window: &Window) -> Vec<String> {
    texts(window, Role::Label).into_iter().filter(|text| text.ends_with(" s")).collect()
}

/// A window with the demonstration, compared.
fn open_comparison() -> Window {
    let mut window = open(SIZE);
    key(&mut window, Key::K);
    until(&mut window, "three runs", |window| runs(window).len() == 3);
    window.run_steps(3);
    window
}

#[test]
fn bands_farm_and_ring_are_compared_while_the_run_is_paused() {
    let mut window = open_comparison();
    assert!(session(&window).stage().paused);
    let known = runs(&window);
    let [bands, farm, ring] = ["Equal bands", "Farm", "Ring"].map(|name| makespan(&known, name));
    assert!(bands > 3 * ring && farm > ring, "{known:?}");
    window.get_by_label("A and C: why they differ");
    let told = texts(&window, Role::Label).into_iter().find(|text| text.contains("as long as"));
    let told = told.expect("an explanation of the difference");
    assert!(told.starts_with("Equal bands takes ") && told.contains("machine 8, which is slow (10 %)"), "{told}");
    key(&mut window, Key::Escape);
    assert!(!session(&window).stage().paused);
    // Finished runs are not executed again.
    key(&mut window, Key::K);
    assert_eq!(names(&window).len(), 3);
}

#[test]
fn run_is_forked_with_one_change_and_removed() {
    let mut window = open_comparison();
    press(&mut window, "Add C with one change");
    // The present values are listed, but cannot be chosen.
    window.get_by_role_and_label(Role::Label, "8 machines, now");
    window.get_by_role_and_label(Role::Label, "8 at 10 %, now");
    press(&mut window, "8 at 5 %");
    until(&mut window, "the fork", |window| runs(window).len() == 4);
    let known = runs(&window);
    assert_ne!(makespan(&known, "Ring, 8 at 5 %"), makespan(&known, "Ring"), "{known:?}");
    window.get_by_label("C and D: why they differ");
    press(&mut window, "Remove B");
    assert_eq!(names(&window), ["Equal bands", "Ring", "Ring, 8 at 5 %"]);
    press(&mut window, "Add a run");
    press(&mut window, "Serial");
    until(&mut window, "fourth run", |window| runs(window).len() == 4);
    assert_eq!(names(&window)[3], "Serial");
}

#[test]
fn fork_starts_at_the_shown_time_and_a_run_without_end_says_so() {
    let mut window = open_comparison();
    // Somewhere in the middle of the ring.
    key(&mut window, Key::Home);
    key(&mut window, Key::Space);
    window.run_steps(30);
    key(&mut window, Key::Space);
    press(&mut window, "Add A with one change");
    let shown = times(&window);
    let later = texts(&window, Role::Button).into_iter().find(|label| label.starts_with("8 at 0 % from "));
    press(&mut window, &later.expect("a change from the shown time on"));
    until(&mut window, "the fork", |window| runs(window).len() == 4);
    assert_eq!(times(&window), shown, "the shown time stays");
    let (name, makespan) = runs(&window).swap_remove(3);
    assert!(name.starts_with("Equal bands, 8 at 0 % from ") && makespan.is_none(), "{name} {makespan:?}");
    window.run_steps(2);
    assert!(texts(&window, Role::Label).iter().any(|text| text.contains("never ends")));
}

#[test]
fn letter_chooses_a_run_wheel_zooms_and_one_table_has_all_runs() {
    let mut window = open_comparison();
    press(&mut window, "Choose B");
    window.get_by_label("C and B: why they differ");
    let time = window.get_by_label("time").value().unwrap_or_default();
    assert_eq!(time.split("; ").count(), 3, "{time}");
    assert_eq!(times(&window).len(), 1, "one clock: {:?}", times(&window));
    let lanes = |window: &Window| {
        let lanes = window.get_by_label("Lanes of all runs");
        (lanes.rect(), lanes.value().unwrap_or_default())
    };
    let (rect, whole) = lanes(&window);
    window.hover_at(rect.center());
    window.step();
    wheel(&mut window, 5.0);
    window.run_steps(10);
    assert_ne!(lanes(&window).1, whole);
    let shown = times(&window);
    window.drag_at(rect.lerp_inside(egui::vec2(0.4, 0.5)));
    window.step();
    window.drop_at(rect.lerp_inside(egui::vec2(0.4, 0.5)));
    window.run_steps(3);
    assert_ne!(times(&window), shown, "a click shows its time");
}

#[test]
fn every_tab_has_words() {
    let mut window = open_comparison();
    let tabs = |window: &Window| window.get_by_label("Efficiency").rect();
    let before = tabs(&window);
    press(&mut window, "Where the time went");
    let spent = window.get_by_role_and_label(Role::Image, "Where the time went").value().expect("words");
    assert!(spent.contains("Equal bands: ") && spent.contains("waiting at the end"), "{spent}");
    press(&mut window, "Speedup");
    let is_told = |window: &Window, words: &str| texts(window, Role::Image).iter().any(|label| label.contains(words));
    until(&mut window, "curves", |window| is_told(window, "Ring: 1: "));
    assert_eq!(tabs(&window), before, "nothing moves");
    assert!(is_told(&window, "Hollow dots: the article's") && !is_told(&window, "Letters: "));
    // A fork is a dot beside the curves; a run without end has no dot.
    press(&mut window, "Add C with one change");
    press(&mut window, "8 at 50 %");
    until(&mut window, "dot", |window| is_told(window, "\nD: 8: ") && is_told(window, "Letters: "));
    press(&mut window, "Add A with one change");
    press(&mut window, "8 at 0 %");
    until(&mut window, "run without end", |window| is_told(window, "E never ends"));
}

#[test]
fn compared_runs_are_saved_as_a_table_and_as_bars() {
    let mut window = open_comparison();
    let directory = tempfile::tempdir().expect("a directory");
    for (kind, name, begins) in [("table", "runs.csv", "run,strategy,machines,time_s"), ("bars", "runs.svg", "<svg")] {
        let path = directory.path().join(name);
        key(&mut window, Key::S);
        press(&mut window, kind);
        window.run_steps(2);
        type_path(&mut window, "Path of the file", &path);
        key(&mut window, Key::Enter);
        until(&mut window, "the file", |_| path.exists());
        let written = std::fs::read_to_string(&path).expect("a text");
        assert!(written.contains(begins) && written.contains("Equal bands"), "{written}");
    }
}
