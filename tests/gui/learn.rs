//! Lessons: choosing one, its steps, and its questions, which come before their answers are shown.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;

use super::driving::*;

fn step(window: &Window) -> Option<(String, usize)> {
    window.state().lesson().map(|(name, step)| (name.to_owned(), step))
}

/// A window with the second lesson at its first step.
fn bands() -> Window {
    let mut window = open(SIZE);
    key(&mut window, Key::N);
    press(&mut window, "Why not bands?");
    until(&mut window, "the lesson", |window| step(window).is_some());
    window.run_steps(3);
    window
}

fn finished(window: &Window) -> bool {
    session(window).stage().state().finished().is_some()
}

#[test]
fn question_of_a_step_is_answered_before_the_run_goes_on() {
    let mut window = bands();
    assert_eq!(step(&window), Some(("bands".into(), 0)));
    until(&mut window, "the first moment", |window| done(window) >= 6144 * 2 / 5);
    assert!(!finished(&window), "the run pauses at that moment");
    key(&mut window, Key::PageDown);
    assert_eq!(step(&window), Some(("bands".into(), 1)));
    // Nothing moves before the question is answered, by no means of control.
    let before = done(&window);
    let stage = session(&window).stage();
    assert!(stage.shown_length() >= stage.lasted(), "the past is shown");
    assert!(2 * stage.shown_length().0 < stage.length().0, "the end stays hidden");
    window.run_steps(20);
    key(&mut window, Key::PageDown);
    for shows_more in [Key::R, Key::ArrowRight, Key::L, Key::Num9] {
        key(&mut window, shows_more);
    }
    assert_eq!((step(&window).map(|(_, step)| step), done(&window)), (Some(1), before));
    // Digits answer; they select no machine.
    assert_eq!(
        (notice(&window).split(':').next(), window.state().selected()),
        (Some("First answer the question"), None)
    );
    window.get_by_label_contains("the keys 1 to 2 answer");
    press(&mut window, "Yes");
    window.get_by_label("Yes: wrong");
    window.get_by_label("No: right");
    window.get_by_label_contains("step 2 of 5 · right answers: 0 of 1");
    window.get_by_label_contains("more than a quarter of the machines' time is lost");
    window.get_by_label_contains("Checked on these runs: efficiency: ");
    // Page Down first jumps to the end of the step.
    key(&mut window, Key::PageDown);
    assert!(finished(&window) && step(&window) == Some(("bands".into(), 1)));
    key(&mut window, Key::PageDown);
    assert_eq!(step(&window), Some(("bands".into(), 2)));
    assert_eq!(session(&window).header().speeds[7], 0.1, "another run");
    assert!(done(&window) == 0 && window.state().selected() == Some(7));
    key(&mut window, Key::PageUp);
    // Answers are kept, and time continues from there.
    assert!(step(&window) == Some(("bands".into(), 1)) && done(&window) >= before && !finished(&window));
    press(&mut window, "Leave the lesson");
    assert_eq!(step(&window), None);
}

#[test]
fn lesson_leaves_camera_and_table_as_they_were() {
    let mut window = open(SIZE);
    key(&mut window, Key::C);
    key(&mut window, Key::N);
    press(&mut window, "For a projector");
    assert!(window.state().open_stack().contains(&anel::gui::Closable::Projector));
    press(&mut window, "For a projector");
    press(&mut window, "Why not bands?");
    until(&mut window, "the lesson", |window| step(window).is_some());
    window.run_steps(3);
    assert_eq!(notice(&window), "", "nothing is said of the camera");
    key(&mut window, Key::T);
    // What the next window restores is what was there before the lesson.
    let mut storage = Storage::default();
    eframe::App::save(window.state_mut(), &mut storage);
    assert!(storage.0.is_some_and(|text| text.contains("timeline:false")));
    press(&mut window, "Leave the lesson");
    window.run_steps(3);
    window.get_by_label("Machine 1");
}

#[test]
fn own_lesson_is_opened_and_its_error_is_shown() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("mine.ron");
    let lesson = |until: &str| {
        format!(
            "Lesson(title: \"Mine\", about: \"A\", runs: {{\"one\": (size: (40, 30))}}, \
             steps: [(say: \"D\", until: {until})])"
        )
    };
    std::fs::write(&path, lesson("Noon")).expect("a file");
    let mut window = open(SIZE);
    key(&mut window, Key::N);
    window.get_by_role_and_label(Role::TextInput, "Path of a lesson").click();
    window.run_steps(2);
    type_path(&mut window, "Path of a lesson", &path);
    press(&mut window, "Open the lesson");
    window.get_by_label_contains("mine.ron: line 1, column ");
    std::fs::write(&path, lesson("End")).expect("a file");
    press(&mut window, "Open the lesson");
    until(&mut window, "the lesson", |window| step(window).is_some());
    until(&mut window, "its end", finished);
}

#[test]
fn keys_lead_through_a_lesson_and_back_to_the_own_run() {
    let mut window = open(SIZE);
    let own = session(&window).header().clone();
    key(&mut window, Key::N);
    key(&mut window, Key::Num2);
    until(&mut window, "the lesson", |window| step(window) == Some(("bands".into(), 0)));
    assert_ne!(session(&window).header().speeds, own.speeds);
    key(&mut window, Key::PageDown);
    key(&mut window, Key::PageDown);
    // Page Down works also while Tab has the focus on a button. The answer comes before the result.
    let before = now(&window);
    key(&mut window, Key::Space);
    key(&mut window, Key::End);
    key(&mut window, Key::Tab);
    key(&mut window, Key::PageDown);
    assert!(notice(&window).starts_with("First answer the question"), "{}", notice(&window));
    assert_eq!((step(&window), now(&window)), (Some(("bands".into(), 1)), before));
    key(&mut window, Key::Num9);
    assert!(window.query_by_label_contains("more than a quarter").is_none(), "there is no such answer");
    key(&mut window, Key::Num2);
    window.get_by_label_contains("more than a quarter of the machines' time is lost");
    press(&mut window, "Leave the lesson");
    until(&mut window, "own run", |window| session(window).header().speeds == own.speeds);
    assert!(!session(&window).is_recorded());
}

#[test]
fn scene_opened_during_a_lesson_stays_after_it() {
    let mut window = bands();
    key(&mut window, Key::O);
    press(&mut window, "Open csg-primer");
    until(&mut window, "the other scene", |window| session(window).header().scene == "csg-primer" && now(window) > 0);
    let begun = session(&window).runs_begun();
    press(&mut window, "Leave the lesson");
    assert_eq!((step(&window), session(&window).runs_begun()), (None, begun));
    assert_eq!(session(&window).header().scene, "csg-primer");
}

#[test]
fn lesson_is_opened_like_a_scene() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("mine.ron");
    let lesson = "// Mine.\n/* All of it. */\nLesson(title: \"Mine\", about: \"A\", \
                  runs: {\"one\": (size: (40, 30))}, steps: [(say: \"D\", until: End)])";
    std::fs::write(&path, lesson).expect("a file");
    let argument = path.to_str().expect("a plain path");
    let mut window = open_with(SIZE, argument);
    assert_eq!(step(&window), Some(("mine".into(), 0)));
    until(&mut window, "its end", finished);
    std::fs::write(&path, lesson.replace("End", "Noon")).expect("a file");
    let told = anel::gui::Opening::read(argument).expect_err("a mistake");
    assert!(told.contains("mine.ron: line 3, column ") && told.contains("Noon"), "{told}");
}

#[test]
fn projector_mode_is_large_and_has_few_buttons() {
    let mut window = open(SIZE);
    let zoom = window.ctx.zoom_factor();
    key(&mut window, Key::F11);
    assert_eq!(window.ctx.zoom_factor(), 1.5 * zoom);
    assert!(window.query_by_role_and_label(Role::Button, "Restart").is_none());
    // The keys of a presenter.
    key(&mut window, Key::PageDown);
    assert!(session(&window).stage().paused);
    key(&mut window, Key::Escape);
    assert_eq!(window.ctx.zoom_factor(), zoom);
    window.get_by_role_and_label(Role::Button, "Restart");
}

#[test]
fn result_of_all_questions_stands_at_the_end_of_a_lesson() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let path = directory.path().join("mine.ron");
    let asking = |until: &str, right: u32| {
        format!(
            "(say: \"D\", until: {until}, ask: (question: \"Q\", answers: [\"a\", \"b\"], right: {right}, because: \"B\"))"
        )
    };
    let first = "(say: \"D\", until: Traced(0.2))".to_owned();
    let steps = [first, asking("Traced(0.5)", 1), asking("End", 2)].join(", ");
    let lesson =
        format!("Lesson(title: \"Mine\", about: \"A\", runs: {{\"one\": (size: (40, 30))}}, steps: [{steps}])");
    std::fs::write(&path, lesson).expect("a file");
    let mut window = open_with(SIZE, path.to_str().expect("a plain path"));
    let go_on = |window: &mut Window, from: usize| {
        while step(window).is_some_and(|(_, at)| at == from) {
            key(window, Key::PageDown);
        }
    };
    go_on(&mut window, 0);
    key(&mut window, Key::Num1);
    window.run_steps(3);
    window.get_by_label("a: right");
    assert!(window.query_by_label_contains(": wrong").is_none());
    go_on(&mut window, 1);
    key(&mut window, Key::Num1);
    until(&mut window, "the end", finished);
    window.run_steps(3);
    window.get_by_label("a: wrong");
    window.get_by_label("Result: 1 of 2 answers were right.");
}
