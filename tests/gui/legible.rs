//! Whatever is written can be read: on every page, in both languages, at every size and for the projector, no text is cut
//! off by what it stands in, none is shortened, and none is drawn over another.

use anel::gui::{App, Launch, Opening, Phase};
use anel::language::Language;
use anel::lesson::{BUILT_IN, Lesson};
use egui::{Key, Rect, Shape, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

use super::driving::*;

const LANGUAGES: [Language; 2] = [Language::English, Language::Portuguese];

/// How much of a letter nobody misses, in points.
const SLACK: f32 = 1.5;

/// A text, and where its letters stand.
struct Text {
    words: String,
    letters: Rect,
    /// Where anything is seen at all.
    room: Rect,
    is_shortened: bool,
    /// Whether something lies on a part of it.
    is_covered: bool,
}

/// What the window shows.
fn texts(window: &Window) -> Vec<Text> {
    let mut seen = Vec::new();
    for clipped in &window.output().shapes {
        gather(&clipped.shape, clipped.clip_rect, &mut seen);
    }
    seen
}

/// From back to front: an opaque surface hides what it lies on, or covers a part of it.
fn gather(shape: &Shape, room: Rect, seen: &mut Vec<Text>) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| gather(shape, room, seen)),
        Shape::Rect(rect) if rect.fill.is_opaque() => {
            let surface = rect.rect.intersect(room);
            seen.retain(|text| !surface.expand(SLACK).contains_rect(text.letters));
            for text in seen {
                text.is_covered |= surface.intersects(text.letters.intersect(text.room).shrink(SLACK));
            }
        }
        Shape::Text(text) if !text.galley.text().trim().is_empty() => {
            let letters = text.visual_bounding_rect();
            if room.intersects(letters) && letters.is_positive() {
                let words = text.galley.text().to_owned();
                seen.push(Text { words, letters, room, is_shortened: text.galley.elided, is_covered: false });
            }
        }
        _ => {}
    }
}

/// An offer or what is given for it: they meet on their ways, and the nearer one lies on the other.
fn is_in_flight(words: &str) -> bool {
    words.starts_with('×') || words == "?" || words.parse::<u16>().is_ok()
}

/// What of a page may be out of sight.
#[derive(Clone, Copy, PartialEq)]
enum Hidden {
    Nothing,
    /// What one scrolls to.
    Lines,
    /// The beginning of what is typed into a field.
    Typed,
    /// What a list or a sheet lies on, and lines of it.
    Below,
}

/// What cannot be read, in words.
fn faults(window: &Window, hidden: Hidden) -> Vec<String> {
    let (texts, whole) = (texts(window), window.ctx.content_rect());
    let ring = window.query_by_label("The ring").or_else(|| window.query_by_label("O anel"));
    let ring = ring.map_or(Rect::NOTHING, |ring| ring.rect());
    let mut found = Vec::new();
    for (index, text) in texts.iter().enumerate() {
        let Text { words, letters, room, .. } = text;
        let passes = |words: &str, at: Rect| ring.intersects(at) && is_in_flight(words);
        if text.is_covered && hidden != Hidden::Below && !ring.intersects(*letters) {
            found.push(format!("{words:?} is covered"));
        }
        if text.is_shortened {
            found.push(format!("{words:?} is shortened"));
        }
        // Words about the run stand at the left in a low place; whatever scrolls is high, or stands further right.
        let scrolls = room.height() > 100.0 || room.left() > 100.0;
        let mut room = room.intersect(whole).expand(SLACK);
        match hidden {
            Hidden::Lines | Hidden::Below if scrolls => (room.min.y, room.max.y) = (f32::NEG_INFINITY, f32::INFINITY),
            Hidden::Typed if words.contains('/') => (room.min.x, room.max.x) = (f32::NEG_INFINITY, f32::INFINITY),
            _ => {}
        }
        if !room.contains_rect(*letters) {
            found.push(format!("{words:?} at {letters:?} is cut off by {room:?}"));
        }
        for other in texts[index + 1..].iter().filter(|_| !text.is_covered) {
            let both = letters.intersect(other.letters).intersect(text.room).intersect(other.room);
            let is_fault = both.width() > SLACK && both.height() > SLACK;
            if is_fault && !passes(words, both) && !passes(&other.words, both) {
                found.push(format!("{words:?} and {:?} lie over each other at {both:?}", other.words));
            }
        }
    }
    found
}

/// A window that is walked through, and what could not be read there.
struct Walk {
    window: Window,
    found: Vec<String>,
}

impl Walk {
    /// Of so many pixels, for who sits before it or for a room.
    fn begin(size: [f32; 2], is_for_a_room: bool, language: Language) -> Self {
        let opening = Some(Opening::read("ten-objects").expect("a built-in scene"));
        let launch = Launch { opening, language, ..Launch::default() };
        let build = move |creation: &mut eframe::CreationContext<'static>| App::new(&creation.egui_ctx, None, launch);
        let mut window = Harness::builder().with_size(Vec2::from(size)).build_eframe(build);
        until(&mut window, "a run", |window| session(window).loading().is_none() && now(window) > 0);
        if is_for_a_room {
            key(&mut window, Key::F11);
        }
        Self { window, found: Vec::new() }
    }

    fn look(&mut self, page: &str, hidden: Hidden) {
        self.window.run_steps(4);
        self.found.extend(faults(&self.window, hidden).into_iter().map(|fault| format!("{page}: {fault}")));
    }

    fn until(&mut self, what: &str, come: impl Fn(&Window) -> bool) {
        until(&mut self.window, what, come);
    }
}

/// Walks through the pages in both languages.
fn pages_can_be_read(size: [f32; 2], is_for_a_room: bool) {
    for language in LANGUAGES {
        let mut walk = Walk::begin(size, is_for_a_room, language);
        walk.until("many atoms", |window| done(window) > 600);
        walk.look("the run", Hidden::Nothing);
        for (open, page, hidden) in [
            (Key::E, "what is set", Hidden::Lines),
            (Key::O, "the scenes", Hidden::Lines),
            (Key::S, "saving", Hidden::Typed),
            (Key::T, "the timeline", Hidden::Nothing),
            (Key::F1, "the keys", Hidden::Below),
            (Key::F, "what is worth jumping to", Hidden::Below),
            (Key::N, "the lessons", Hidden::Lines),
        ] {
            key(&mut walk.window, open);
            walk.look(page, hidden);
            key(&mut walk.window, if matches!(open, Key::E | Key::T) { open } else { Key::Escape });
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
        key(&mut walk.window, Key::End);
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
fn every_page_can_be_read_in_a_window_of_1280() {
    pages_can_be_read([1280.0, 800.0], false);
}

#[test]
fn every_page_can_be_read_in_a_window_of_1920() {
    pages_can_be_read([1920.0, 1080.0], false);
}

#[test]
fn every_page_can_be_read_in_a_window_of_1024() {
    pages_can_be_read([1024.0, 640.0], false);
}

#[test]
fn every_page_can_be_read_by_a_room() {
    pages_can_be_read([1280.0, 800.0], true);
    pages_can_be_read([1920.0, 1080.0], true);
}

#[test]
fn every_step_of_every_lesson_can_be_read() {
    let mut found = Vec::new();
    for (size, is_for_a_room) in [([1280.0, 800.0], false), ([1280.0, 800.0], true), ([1920.0, 1080.0], true)] {
        for language in LANGUAGES {
            let mut walk = Walk::begin(size, is_for_a_room, language);
            for (name, _) in BUILT_IN {
                walk.take_lesson(name);
            }
            found.extend(walk.found.into_iter().map(|fault| format!("{size:?}, {language:?}, {fault}")));
        }
    }
    assert!(found.is_empty(), "{found:#?}");
}

impl Walk {
    /// Every step, before a question is answered and after.
    fn take_lesson(&mut self, name: &str) {
        let lesson = Lesson::open(name).expect("a built-in lesson");
        let language = session(&self.window).language();
        key(&mut self.window, Key::N);
        // It may stand further down the list.
        self.window.get_by_label(lesson.title.in_language(language)).click_accesskit();
        self.until("the lesson", |window| window.state().lesson() == Some((name, 0)));
        for (place, step) in lesson.steps.iter().enumerate() {
            let page = format!("{name}, step {}", place + 1);
            self.look(&page, Hidden::Nothing);
            if let Some(question) = &step.ask {
                press(&mut self.window, question.answers[0].in_language(language));
                self.look(&format!("{page}, answered"), Hidden::Nothing);
            }
            // Whoever is in a hurry comes to the end of the step first.
            while self.window.state().lesson() == Some((name, place)) && place + 1 < lesson.steps.len() {
                key(&mut self.window, Key::PageDown);
            }
        }
        self.look(&format!("{name}, the end"), Hidden::Nothing);
    }
}
