//! The claims of every lesson hold for its runs, and errors in a lesson file name their place.

use std::fs;

use anel::cancel::CancelToken;
use anel::driver::PictureCache;
use anel::lesson::{BUILT_IN, Lesson, LessonRun};

fn performed(lesson: &Lesson) -> Vec<(String, LessonRun)> {
    let performed = lesson.perform(&PictureCache::default(), &|_| {}, &CancelToken::default());
    performed.expect("its scenes can be read").expect("it is not cancelled")
}

#[test]
fn claims_of_every_lesson_hold() {
    for (name, _) in BUILT_IN {
        let lesson = Lesson::open(name).unwrap_or_else(|error| panic!("{name}: {error}"));
        let claims = lesson.check(&performed(&lesson));
        let wrong: Vec<_> = claims.iter().filter(|(_, holds)| !holds).map(|(claim, _)| claim).collect();
        assert!(wrong.is_empty(), "{name}: {wrong:#?}");
        // A lesson without claims could say anything.
        assert!(claims.len() >= 3, "{name} has {} claims", claims.len());
        assert!(lesson.steps.iter().any(|step| step.ask.is_some()), "{name} has no question");
    }
}

#[test]
fn lesson_shows_the_same_runs_every_time() {
    let lesson = Lesson::open("sizes").expect("a built-in lesson");
    let [one, other] = [(); 2].map(|()| performed(&lesson));
    for ((name, one), (_, other)) in one.iter().zip(&other) {
        assert!(one.log == other.log, "the run {name}");
    }
}

/// The text of a lesson with one run and one step, which have these additional fields.
fn lesson_text(run: &str, step: &str) -> String {
    format!(
        "Lesson(\n    title: (\"A\", \"B\"),\n    about: \"C\",\n    runs: {{\"one\": (size: (40, 30), {run})}},\n    \
         steps: [\n        (say: \"D\", {step}),\n    ],\n)\n"
    )
}

#[test]
fn false_claim_is_found() {
    let lesson = Lesson::parse("mine", &lesson_text("", "until: End, holds: [(figure: Atoms, at_least: 25)]"))
        .expect("a lesson");
    let claims = lesson.check(&performed(&lesson));
    assert_eq!(claims.len(), 1);
    assert!(!claims[0].1 && claims[0].0.contains("Atoms of `one` is 24"), "{claims:?}");
    let lesson = Lesson::parse("mine", &lesson_text("strategy: \"static\"", "until: FirstTransfer")).expect("a lesson");
    let claims = lesson.check(&performed(&lesson));
    assert!(
        claims.len() == 1 && claims[0].0.starts_with("step 1: the run `one` has no FirstTransfer; it lasts "),
        "{claims:?}"
    );
    // A run has no moment after its end.
    let lesson = Lesson::parse("mine", &lesson_text("", "until: Seconds(500)")).expect("a lesson");
    let refused =
        lesson.check_moments(&performed(&lesson)).expect_err("the run lasts about twenty seconds").to_string();
    assert!(refused.starts_with("step 1: the run `one` has no Seconds(500.0); it lasts "), "{refused}");
}

#[test]
fn error_names_its_place() {
    let error = |text: &str| Lesson::parse("mine", text).expect_err("an invalid lesson").to_string();
    let place = |run: &str, step: &str, expected: &str| {
        let error = error(&lesson_text(run, step));
        assert!(error.contains(expected), "{error}, not {expected}");
    };
    place("colour: 3", "", "line 4");
    place("strategy: \"tree\"", "", "there is no strategy `tree`");
    place("speeds: []", "", "line 4, column 36: the run `one`: there can be 1 to 32 machines");
    place("without: [\"wake\"]", "", "only an `adaptive` run has remedies");
    place("strategy: \"adaptive\", without: [\"sleep\"]", "", "there is no remedy `sleep`");
    place("speeds: [2]", "", "a speed can be 0 to 1");
    place(
        "script: [(at: 1, machine: 9, speed: 0.1)]",
        "",
        "line 4, column 45: the run `one`: there are machines 1 to 8, not 9",
    );
    place(
        "scene: \"no\"",
        "",
        "line 4, column 36: the run `one`: there is no scene `no` beside the lesson, and no built-in one",
    );
    place("seconds: -1", "", "`seconds` can be 0.1 to 3600, not -1");
    place("", "run: \"two\"", "line 6, column 20: step 1: there is no run `two`; there are `one`");
    place("", "machine: 0", "line 6, column 20: step 1: there are machines 1 to 8, not 0");
    place("", "until: Noon", "step 1, until: ");
    place("", "until: Noon", "line 6");
    place("", "holds: [(figure: Seconds)]", "line 6, column 28: step 1: a claim needs `at_least` or `at_most`");
    let ask = "ask: (question: \"Q\", answers: [\"a\", \"b\"], right: 3, because: \"c\")";
    place("", ask, "line 6, column 62: step 1: `right` is the number of the right answer, 1 to 2, not 3");
    assert!(error("").contains("the file is empty; a lesson needs at least a title, runs and steps"));
    assert!(error("Lesson(title: \"A\", about: \"B\", runs: {}, steps: [])").contains("at least one run"));
    assert!(error(&(lesson_text("", "") + "x")).contains("something follows the end of the lesson"));
    let error = Lesson::open("no/such.ron").expect_err("there is none").to_string();
    assert!(error.starts_with("no/such.ron: there is no such file, and no built-in lesson of that name"), "{error}");
}

#[test]
fn scene_beside_the_lesson_is_found() {
    let directory = tempfile::tempdir().expect("a temporary directory");
    let scene = "Scene(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), lights: [], objects: [Sphere(radius: 1)])";
    fs::write(directory.path().join("ball.ron"), scene).expect("a file");
    let path = directory.path().join("mine.ron");
    fs::write(&path, lesson_text("scene: \"ball.ron\"", "until: End")).expect("a file");
    let lesson = Lesson::open(path.to_str().expect("a plain path")).expect("a lesson");
    let performed = performed(&lesson);
    assert_eq!(performed[0].1.opened.name, "ball");
    let lesson = Lesson { directory: "/nowhere".into(), ..lesson };
    let missing = lesson.perform(&PictureCache::default(), &|_| {}, &CancelToken::default());
    assert!(missing.is_err_and(|error| error.to_string().starts_with("the run `one`: ")), "it names the run");
}

#[test]
fn lesson_in_the_document_is_valid() {
    let document = fs::read_to_string("docs/lessons.md").expect("docs/lessons.md");
    let text = document.split("```ron\n").find(|block| block.starts_with("Lesson(")).expect("a lesson");
    let text = text.split("```").next().expect("its end");
    let lesson = Lesson::parse("example", text).unwrap_or_else(|error| panic!("the document's lesson: {error}"));
    let claims = lesson.check(&performed(&lesson));
    assert!(claims.len() == 2 && claims.iter().all(|(_, holds)| *holds), "{claims:#?}");
}
