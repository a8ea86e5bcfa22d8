//! The window in Portuguese: no page has English words, and nothing is cut off.

use std::collections::BTreeSet;

use anel::gui::{Launch, Opening, Phase};
use anel::language::Language;
use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::{NodeT, Queryable};

use super::driving::*;

/// English words that are not Portuguese and not part of the names of scenes, materials, files or keys.
const ENGLISH: [&str; 96] = [
    "the",
    "is",
    "are",
    "and",
    "of",
    "with",
    "its",
    "it",
    "has",
    "for",
    "from",
    "by",
    "at",
    "on",
    "in",
    "not",
    "that",
    "this",
    "what",
    "when",
    "who",
    "which",
    "machine",
    "machines",
    "node",
    "nodes",
    "atom",
    "atoms",
    "parent",
    "worker",
    "band",
    "bands",
    "offer",
    "offers",
    "picture",
    "pictures",
    "speed",
    "pause",
    "paused",
    "save",
    "saved",
    "open",
    "close",
    "find",
    "step",
    "help",
    "undo",
    "redo",
    "restart",
    "scenes",
    "accuracy",
    "compare",
    "dark",
    "slower",
    "faster",
    "timeline",
    "done",
    "left",
    "idle",
    "event",
    "sample",
    "samples",
    "rate",
    "run",
    "runs",
    "recorded",
    "waiting",
    "waits",
    "computing",
    "stopped",
    "asking",
    "traced",
    "trace",
    "traces",
    "nothing",
    "nobody",
    "pixels of",
    "size",
    "strategy",
    "quality",
    "levels",
    "rays",
    "ray",
    "seed",
    "pace",
    "slowly",
    "beginning",
    "select",
    "selected",
    "keys",
    "efficiency",
    "messages",
    "error",
    "worst",
    "wrong",
    "lights",
];

/// All labels, values and placeholders, also those for screen readers only.
fn texts(window: &Window) -> BTreeSet<String> {
    let words = |node: egui_kittest::Node<'_>| {
        let node = node.accesskit_node();
        [node.label(), node.value(), node.placeholder().map(str::to_owned)]
    };
    window.query_all_by(|_| true).flat_map(words).flatten().filter(|text| !text.is_empty()).collect()
}

fn assert_portuguese(window: &Window, page: &str) {
    let mut wrong = BTreeSet::new();
    for text in texts(window) {
        // The button back to English, and the article's symbols.
        let lower = ["In English", "Ks Is", "Kt It"].iter().fold(text.clone(), |text, own| text.replace(own, ""));
        let lower = lower.to_lowercase();
        let words: Vec<&str> = lower.split(|c: char| !c.is_alphanumeric() && c != '-').collect();
        let letters: Vec<char> = text.chars().collect();
        let has_point =
            letters.windows(3).any(|three| three[0].is_ascii_digit() && three[1] == '.' && three[2].is_ascii_digit());
        if has_point || words.iter().any(|word| ENGLISH.contains(word)) {
            wrong.insert(text);
        }
    }
    assert!(wrong.is_empty(), "{page}: {wrong:#?}");
}

/// Checks the hint of each button, slider and field. Returns the number of hints.
fn assert_hints(window: &mut Window, page: &str) -> usize {
    let of = |role| {
        let rects: Vec<Rect> = window.query_all_by_role(role).map(|node| node.rect()).collect();
        rects
    };
    let places: Vec<Rect> =
        [Role::Button, Role::Slider, Role::SpinButton, Role::CheckBox].into_iter().flat_map(of).collect();
    let mut seen = 0;
    for place in places {
        let before = texts(window).len();
        window.hover_at(place.center());
        window.run_steps(4);
        seen += usize::from(texts(window).len() > before);
        assert_portuguese(window, page);
    }
    seen
}

fn open_portuguese(size: [f32; 2]) -> Window {
    restore_portuguese(size, &Storage::default())
}

/// Opens a Portuguese window with the demonstration's scene and these settings.
fn restore_portuguese(size: [f32; 2], storage: &Storage) -> Window {
    let opening = Some(Opening::read("ten-objects").expect("a built-in scene"));
    launch_with(size, storage, Launch { opening, language: Language::Portuguese, ..Launch::default() })
}

fn shift_l(window: &mut Window) {
    window.key_press_modifiers(Modifiers::SHIFT, Key::L);
    window.run_steps(3);
}

#[test]
fn change_of_language_translates_the_events_of_the_run() {
    let mut window = open(SIZE);
    until(&mut window, "many atoms", |window| done(window) > 600);
    key(&mut window, Key::Num3);
    shift_l(&mut window);
    assert_portuguese(&window, "a run");
    key(&mut window, Key::Num3);
    press(&mut window, "Ajustar");
    press(&mut window, "Total");
    until(&mut window, "the end", |window| session(window).stage().phase == Phase::Finished);
    press(&mut window, "Ajustar");
    assert_portuguese(&window, "the end");
    window.get_by_label("Resultado");
    shift_l(&mut window);
    window.get_by_label("Result");
    window.get_by_role_and_label(Role::Button, "Restart");
    let language = session(&window).language();
    let events = session(&window).stage().narrator().events();
    let events: Vec<_> = events.map(|(_, event)| event.sentence(language)).collect();
    assert!(events.iter().any(|event| event == "The picture is complete"), "{events:?}");
    assert!(events.iter().all(|event| !event.contains("máquina")), "{events:?}");
}

#[test]
fn every_page_is_portuguese() {
    let mut window = open_portuguese(SIZE);
    assert!(assert_hints(&mut window, "the run") > 1);
    // The list of moments has no hints.
    key(&mut window, Key::F);
    window.run_steps(3);
    assert_portuguese(&window, "find");
    key(&mut window, Key::Escape);
    for (open, page) in [
        (Key::E, "what is set"),
        (Key::O, "the scenes"),
        (Key::S, "saving"),
        (Key::T, "the timeline"),
        (Key::F1, "the keys"),
        (Key::W, "the words"),
    ] {
        key(&mut window, open);
        window.run_steps(3);
        assert_hints(&mut window, page);
        match open {
            Key::E | Key::T => key(&mut window, open),
            _ => escape(&mut window),
        }
    }
    key(&mut window, Key::K);
    until(&mut window, "three runs", |window| window.state().compared().len() == 3);
    window.run_steps(3);
    assert_portuguese(&window, "compare");
    key(&mut window, Key::Escape);
}

#[test]
fn lists_and_changes_are_portuguese() {
    let mut window = open_portuguese(SIZE);
    key(&mut window, Key::E);
    for list in ["Estratégia", "Tamanhos usuais"] {
        window.get_by_role_and_label(Role::ComboBox, list).click();
        window.run_steps(3);
        assert_portuguese(&window, list);
        key(&mut window, Key::Escape);
    }
    press(&mut window, "Mais…");
    assert_portuguese(&window, "the quality");
    key(&mut window, Key::Escape);
    for preset in ["Iguais", "Uma lenta", "Aleatórias", "Laboratório antigo"] {
        press(&mut window, preset);
    }
    type_number(&mut window, "Número de máquinas", "3");
    until(&mut window, "three machines", |window| session(window).header().speeds.len() == 3);
    assert_portuguese(&window, "a change");
    ctrl(&mut window, Key::Z);
    assert_portuguese(&window, "an undone change");
}

#[test]
fn inspector_and_accuracy_are_portuguese() {
    // A small picture is quickly measured.
    let settings = "(settings: (size: (width: 24, height: 18), atom: 1))";
    let mut window = restore_portuguese(SIZE, &Storage(Some(settings.into())));
    let middle = window.get_by_label("Imagem").rect().center();
    window.hover_at(middle);
    window.run_steps(4);
    assert_portuguese(&window, "the hint of a pixel");
    window.drag_at(middle);
    window.step();
    window.drop_at(middle);
    until(&mut window, "the pixel", |window| !session(window).is_inspecting());
    window.run_steps(2);
    window.get_by_label("Árvore de raios");
    assert_portuguese(&window, "a pixel");
    key(&mut window, Key::Escape);
    key(&mut window, Key::A);
    assert_portuguese(&window, "accuracy at first");
    until(&mut window, "a point", |window| window.state().points_measured() > 1);
    let point = window.get_by_role_and_label(Role::Button, "Ponto 1").rect().center();
    window.hover_at(point);
    window.run_steps(4);
    assert_portuguese(&window, "accuracy");
}

#[test]
fn nothing_is_cut_off_in_windows_of_every_size() {
    for size in [[1280.0, 800.0], [1024.0, 640.0], [800.0, 500.0], [683.0, 427.0]] {
        let window = open_portuguese(size);
        let rect = |name: &str| window.get_by_label(name).rect();
        let whole = Rect::from_min_size(egui::Pos2::ZERO, size.into()).expand(1.0);
        let buttons = ["Cenas", "Pausar", "Reiniciar", "Desfazer", "Ajustar", "Salvar…", "Escuro ou claro", "Ajuda"];
        let time = [
            "Passo atrás",
            "Unidade do passo",
            "Passo adiante",
            "Mais lento",
            "Mais rápido",
            "O tempo da execução",
            "Ao vivo",
            "Achar",
        ];
        for pair in time.windows(2).chain(buttons.windows(2).skip(1)) {
            assert!(rect(pair[0]).right() <= rect(pair[1]).left(), "{pair:?} at {size:?}");
        }
        assert!(rect("O tempo da execução").width() > 90.0, "{size:?}");
        for name in buttons.into_iter().chain(time) {
            assert!(whole.contains_rect(rect(name)) && rect(name).area() > 0.0, "{name} at {size:?}");
        }
    }
}
