//! All texts are legible: on every page, in both languages, at every size and in projector mode, no text is cut off by
//! its container, shortened, or drawn over another.

use std::collections::BTreeMap;

use anel::gui::{Launch, Opening, Phase};
use anel::language::Language;
use anel::lesson::{BUILT_IN, Lesson};
use egui::{Key, Modifiers, Rect, Shape};
use egui_kittest::kittest::Queryable;

use super::driving::*;

const LANGUAGES: [Language; 2] = [Language::English, Language::Portuguese];

/// Overlap and clipping below this many points are ignored.
const SLACK_PT: f32 = 1.5;

/// A text with the area of its letters.
struct Text {
    words: String,
    letters: Rect,
    /// The clip rectangle.
    clip: Rect,
    is_shortened: bool,
    /// Whether an opaque surface covers a part of it.
    is_covered: bool,
}

/// The texts that the window shows.
fn texts(window: &Window) -> Vec<Text> {
    let mut seen = Vec::new();
    for clipped in &window.output().shapes {
        gather(&clipped.shape, clipped.clip_rect, &mut seen);
    }
    seen
}

/// Collects texts from back to front. An opaque surface removes the texts behind it, or marks them as covered.
fn gather(shape: &Shape, clip: Rect, seen: &mut Vec<Text>) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| gather(shape, clip, seen)),
        Shape::Rect(rect) if rect.fill.is_opaque() => {
            let surface = rect.rect.intersect(clip);
            seen.retain(|text| !surface.expand(SLACK_PT).contains_rect(text.letters));
            for text in seen {
                text.is_covered |= surface.intersects(text.letters.intersect(text.clip).shrink(SLACK_PT));
            }
        }
        Shape::Text(text) if !text.galley.text().trim().is_empty() => {
            let letters = text.visual_bounding_rect();
            if clip.intersects(letters) && letters.is_positive() {
                let words = text.galley.text().to_owned();
                seen.push(Text { words, letters, clip, is_shortened: text.galley.elided, is_covered: false });
            }
        }
        _ => {}
    }
}

/// Whether this is the text of an offer or a transfer; these move and may overlap.
fn is_in_flight(words: &str) -> bool {
    words.starts_with('×') || words == "?" || words.parse::<u16>().is_ok()
}

/// The parts of a page that may be hidden.
#[derive(Clone, Copy, PartialEq)]
enum Hidden {
    Nothing,
    /// Lines that scroll into view.
    Lines,
    /// The beginning of a path in a field, and lines that scroll into view.
    Typed,
    /// Texts below a list or a sheet, and lines of it.
    Below,
}

/// The illegible texts, each with its fault.
fn faults(window: &Window, hidden: Hidden) -> Vec<String> {
    let (texts, whole) = (texts(window), window.ctx.content_rect());
    let ring = window.query_by_label("The ring").or_else(|| window.query_by_label("O anel"));
    let ring = ring.map_or(Rect::NOTHING, |ring| ring.rect());
    let mut found = Vec::new();
    for (index, text) in texts.iter().enumerate() {
        let Text { words, letters, clip, .. } = text;
        let passes = |words: &str, at: Rect| ring.intersects(at) && is_in_flight(words);
        if text.is_covered && hidden != Hidden::Below && !ring.intersects(*letters) {
            found.push(format!("{words:?} is covered"));
        }
        if text.is_shortened {
            found.push(format!("{words:?} is shortened"));
        }
        // The words about the run are in a low area on the left; areas that scroll are higher, or further right.
        let scrolls = clip.height() > 100.0 || clip.left() > 100.0;
        let mut visible = clip.intersect(whole).expand(SLACK_PT);
        match hidden {
            Hidden::Typed if words.contains('/') => (visible.min.x, visible.max.x) = (f32::NEG_INFINITY, f32::INFINITY),
            Hidden::Lines | Hidden::Below | Hidden::Typed if scrolls => {
                (visible.min.y, visible.max.y) = (f32::NEG_INFINITY, f32::INFINITY)
            }
            _ => {}
        }
        if !visible.contains_rect(*letters) {
            found.push(format!("{words:?} at {letters:?} is cut off by {visible:?}"));
        }
        for other in texts[index + 1..].iter().filter(|_| !text.is_covered) {
            let both = letters.intersect(other.letters).intersect(text.clip).intersect(other.clip);
            let is_fault = both.width() > SLACK_PT && both.height() > SLACK_PT;
            if is_fault && !passes(words, both) && !passes(&other.words, both) {
                found.push(format!("{words:?} and {:?} overlap at {both:?}", other.words));
            }
        }
    }
    found
}

/// A walk through a window, with the faults found.
struct Walk {
    window: Window,
    found: Vec<String>,
    /// The places of the picture in the steps of a lesson so far, by window.
    pictures: BTreeMap<String, Rect>,
}

impl Walk {
    /// Opens a window of this size, in projector mode or not.
    fn begin(size: [f32; 2], in_projector_mode: bool, language: Language) -> Self {
        let opening = Some(Opening::read("ten-objects").expect("a built-in scene"));
        let launch = Launch { opening, language, ..Launch::default() };
        let mut window = launch_with(size, &Storage::default(), launch);
        if in_projector_mode {
            key(&mut window, Key::F11);
            resize(&mut window, size);
        }
        Self { window, found: Vec::new(), pictures: BTreeMap::new() }
    }

    fn look(&mut self, page: &str, hidden: Hidden) {
        self.window.run_steps(4);
        self.found.extend(faults(&self.window, hidden).into_iter().map(|fault| format!("{page}: {fault}")));
    }

    /// Chooses each kind of file in the open save sheet, and lets one file be written while another one waits.
    fn look_at_kinds_of_files(&mut self) {
        let directory = tempfile::tempdir().expect("a temporary directory");
        let is_english = session(&self.window).language() == Language::English;
        let (kinds, [large, cancel, save, path]) = if is_english {
            (
                ["owners", "ring", "timeline", "animation (GIF)", "run", "table", "any size"],
                ["any size", "Cancel", "Save", "Path of the file"],
            )
        } else {
            (
                ["donas", "anel", "linha do tempo", "filme (GIF)", "execução", "tabela", "ampliada"],
                ["ampliada", "Cancelar", "Salvar", "Caminho do arquivo"],
            )
        };
        for kind in kinds {
            press(&mut self.window, kind);
            self.look(kind, Hidden::Typed);
        }
        press(&mut self.window, "4K");
        self.look("4K", Hidden::Typed);
        for name in ["first.png", "second.png"] {
            // The chosen kind gives the focus to the path.
            press(&mut self.window, large);
            type_path(&mut self.window, path, &directory.path().join(name));
            press(&mut self.window, save);
        }
        self.until("progress", |window| window.query_by_label(cancel).is_some());
        self.look("the queue", Hidden::Typed);
        press(&mut self.window, &format!("{cancel} second.png"));
        press(&mut self.window, cancel);
        // No machine is pointed at.
        self.window.hover_at(egui::Pos2::ZERO);
    }

    fn until(&mut self, what: &str, condition: impl Fn(&Window) -> bool) {
        until(&mut self.window, what, condition);
    }
}

/// Checks all pages in both languages.
fn assert_pages_legible(size: [f32; 2], in_projector_mode: bool) {
    for language in LANGUAGES {
        let mut walk = Walk::begin(size, in_projector_mode, language);
        walk.until("many atoms", |window| done(window) > 600);
        walk.look("the run", Hidden::Nothing);
        for (open, page, hidden) in [
            (Key::E, "what is set", Hidden::Lines),
            (Key::O, "the scenes", Hidden::Lines),
            (Key::S, "saving", Hidden::Typed),
            (Key::T, "the timeline", Hidden::Nothing),
            (Key::F1, "the keys", Hidden::Below),
            (Key::W, "the words", Hidden::Below),
            (Key::F, "what is worth jumping to", Hidden::Below),
            (Key::N, "the lessons", Hidden::Lines),
        ] {
            key(&mut walk.window, open);
            walk.look(page, hidden);
            if open == Key::S {
                walk.look_at_kinds_of_files();
            }
            match open {
                Key::E | Key::T => key(&mut walk.window, open),
                _ => escape(&mut walk.window),
            }
        }
        key(&mut walk.window, Key::Num3);
        walk.look("a machine", Hidden::Nothing);
        key(&mut walk.window, Key::K);
        walk.until("three runs", |window| window.state().compared().len() == 3);
        walk.look("what is compared", Hidden::Lines);
        let english = language == Language::English;
        let efficiency = if english { "Efficiency" } else { "Eficiência" };
        for tab in [if english { "Where the time went" } else { "Para onde foi o tempo" }, "Speedup", efficiency] {
            press(&mut walk.window, tab);
            let waits = if english { "Running with" } else { "Executando com" };
            walk.until("the curves", |window| window.query_by_label_contains(waits).is_none());
            walk.look(tab, Hidden::Lines);
        }
        key(&mut walk.window, Key::Escape);
        // The same run at full speed, so that its end comes soon. The button may be further down the panel.
        key(&mut walk.window, Key::E);
        walk.window.get_by_label(if english { "Full speed" } else { "Total" }).click_accesskit();
        walk.window.run_steps(3);
        key(&mut walk.window, Key::E);
        walk.until("the end", |window| session(window).stage().phase == Phase::Finished);
        walk.look("the end", Hidden::Nothing);
        key(&mut walk.window, Key::T);
        walk.look("the end's timeline", Hidden::Nothing);
        let picture = if language == Language::English { "Picture" } else { "Imagem" };
        let middle = walk.window.get_by_label(picture).rect().center();
        walk.window.drag_at(middle);
        walk.window.step();
        walk.window.drop_at(middle);
        walk.until("the pixel", |window| !session(window).is_inspecting());
        walk.look("a pixel", Hidden::Lines);
        assert!(walk.found.is_empty(), "{size:?}, {language:?}: {:#?}", walk.found);
    }
}

#[test]
fn every_page_is_legible_in_a_window_of_1280() {
    assert_pages_legible([1280.0, 800.0], false);
}

#[test]
fn every_page_is_legible_in_a_window_of_1920() {
    assert_pages_legible([1920.0, 1080.0], false);
}

#[test]
fn every_page_is_legible_in_a_window_of_1024() {
    assert_pages_legible([1024.0, 640.0], false);
}

#[test]
fn every_page_is_legible_in_projector_mode() {
    assert_pages_legible([1280.0, 800.0], true);
    assert_pages_legible([1920.0, 1080.0], true);
}

/// A lesson computes its runs when it is opened; so each is opened once and looked at in all windows and languages.
fn assert_lessons_legible(lessons: &[(&str, &str)]) {
    let mut walk = Walk::begin(SIZE, false, Language::English);
    lessons.iter().for_each(|(name, _)| walk.take_lesson(name));
    assert!(walk.found.is_empty(), "{:#?}", walk.found);
}

#[test]
fn every_step_of_the_first_lessons_is_legible() {
    assert_lessons_legible(&BUILT_IN[..BUILT_IN.len() / 2]);
}

#[test]
fn every_step_of_the_last_lessons_is_legible() {
    assert_lessons_legible(&BUILT_IN[BUILT_IN.len() / 2..]);
}

impl Walk {
    /// Checks every step of a lesson, before and after its question is answered.
    fn take_lesson(&mut self, name: &str) {
        let lesson = Lesson::open(name).expect("a built-in lesson");
        self.pictures.clear();
        let language = session(&self.window).language();
        key(&mut self.window, Key::N);
        // The lesson may be further down the list.
        self.window.get_by_label(lesson.title.in_language(language)).click_accesskit();
        self.until("the lesson", |window| window.state().lesson() == Some((name, 0)));
        for (place, step) in lesson.steps.iter().enumerate() {
            let page = format!("{name}, step {}", place + 1);
            self.look_everywhere(&page);
            if let Some(question) = &step.ask {
                press(&mut self.window, question.answers[0].in_language(language));
                self.look_everywhere(&format!("{page}, answered"));
            }
            // Page Down first jumps to the end of the step.
            while self.window.state().lesson() == Some((name, place)) && place + 1 < lesson.steps.len() {
                key(&mut self.window, Key::PageDown);
            }
        }
        self.look_everywhere(&format!("{name}, the end"));
    }

    /// Looks in windows of two sizes, in projector mode and in both languages. Returns to the first window and to
    /// English.
    fn look_everywhere(&mut self, page: &str) {
        for (size, in_projector_mode) in [(SIZE, false), (SIZE, true), ([1920.0, 1080.0], true)] {
            if in_projector_mode {
                key(&mut self.window, Key::F11);
            }
            resize(&mut self.window, size);
            for language in LANGUAGES {
                let at = format!("{size:?}, {in_projector_mode}, {language:?}");
                self.look(&format!("{at}, {page}"), Hidden::Nothing);
                let picture = self.window.get_by_label(["Picture", "Imagem"][language as usize]).rect();
                let first = *self.pictures.entry(at.clone()).or_insert(picture);
                let moved = (first.min - picture.min).length() + (first.max - picture.max).length();
                if moved > SLACK_PT {
                    self.found.push(format!("{at}, {page}: the picture has moved from {first:?} to {picture:?}"));
                }
                self.window.key_press_modifiers(Modifiers::SHIFT, Key::L);
                self.window.run_steps(3);
            }
            if in_projector_mode {
                key(&mut self.window, Key::F11);
            }
        }
        resize(&mut self.window, SIZE);
    }
}
