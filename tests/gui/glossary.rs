//! Captions explain themselves from the glossary, and the list of words has all of it.

use anel::gui::{Launch, Opening, Phase};
use anel::language::Language;
use anel::view::{Definition, DefinitionGroup};
use egui::accesskit::Role;
use egui::{Key, Rect};
use egui_kittest::kittest::{NodeT, Queryable};

use super::driving::*;

const LANGUAGE: Language = Language::English;

/// Returns the place of a caption.
fn caption(window: &Window, name: &str) -> Rect {
    let is_it = |node: &egui_kittest::Node<'_>| {
        let node = node.accesskit_node();
        node.label().or(node.value()).is_some_and(|label| label.eq_ignore_ascii_case(name))
    };
    let of = |role| window.query_all_by_role(role).find(is_it);
    let found = of(Role::Label).or_else(|| of(Role::Image)).unwrap_or_else(|| panic!("no caption {name}"));
    found.rect()
}

/// Points at each caption, and checks that its definition shows and does not cover it.
fn assert_explained(window: &mut Window, definitions: &[Definition]) {
    for definition in definitions {
        let (name, text) = (definition.name(LANGUAGE), definition.text(LANGUAGE));
        assert!(window.query_by_label(text).is_none(), "{name}");
        let mut place = caption(window, name);
        for _ in 0..10 {
            window.hover_at(place.center());
            window.run_steps(4);
            // A message that comes or goes moves the caption.
            if window.query_by_label(text).is_some() {
                break;
            }
            place = caption(window, name);
        }
        let tooltip = window.query_by_label(text).unwrap_or_else(|| panic!("no tooltip of {name}")).rect();
        assert!(!tooltip.intersects(place), "{name} at {place:?} is covered by {tooltip:?}");
        window.hover_at(egui::Pos2::ZERO);
        window.run_steps(4);
    }
}

#[test]
fn captions_of_table_timeline_result_and_comparison_explain_themselves() {
    use Definition as D;
    let settings = Storage(Some("(settings: (size: (width: 48, height: 36), atom: 1))".into()));
    let opening = Some(Opening::read("ten-objects").expect("a built-in scene"));
    let mut window = launch_with(SIZE, &settings, Launch { opening, ..Launch::default() });
    until(&mut window, "many atoms", |window| done(window) > 100);
    assert_explained(&mut window, &[D::SPEED, D::DONE_AND_LEFT, D::DONE, D::LEFT, D::RATE, D::IDLE, D::NOW_COLUMN]);
    assert_explained(&mut window, &[D::WHO_TRACED]);
    key(&mut window, Key::T);
    assert_explained(&mut window, &[D::TIME_USED, D::IMBALANCE, D::ON_THE_WAY, D::MESSAGES, D::IN_USE]);
    press(&mut window, "Set up");
    press(&mut window, "Full speed");
    until(&mut window, "the end", |window| session(window).stage().phase == Phase::Finished);
    press(&mut window, "Set up");
    assert_explained(&mut window, &[D::MAKESPAN, D::IDEAL, D::EFFICIENCY, D::SPREAD]);
    key(&mut window, Key::K);
    until(&mut window, "three runs", |window| window.state().compared().len() == 3);
    window.run_steps(3);
    assert_explained(&mut window, &[D::TIME, D::IDEAL, D::MESSAGES_TO_SHARE, D::ATOMS_GIVEN_AWAY, D::ALONE]);
    press(&mut window, "Where the time went");
    assert_explained(&mut window, &[D::SPENT_TRACING, D::SPENT_WAITING]);
}

#[test]
fn list_of_words_has_every_definition() {
    let mut window = open(SIZE);
    key(&mut window, Key::W);
    for definition in DefinitionGroup::ALL.iter().flat_map(|group| group.definitions) {
        window.get_by_label(&format!("{}  {}", definition.name(LANGUAGE), definition.text(LANGUAGE)));
    }
    press(&mut window, "Keys");
    window.get_by_label("What the keys do");
    key(&mut window, Key::W);
    key(&mut window, Key::W);
    assert!(window.query_by_label("Close help").is_none());
}
