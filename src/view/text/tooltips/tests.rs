use std::collections::BTreeSet;

use super::*;
use crate::record::{Record, RecordKind};
use crate::view::tests::sample_runs;

fn value<'a>(words: &'a [(&str, String)], label: &str) -> &'a str {
    words.iter().find(|(other, _)| *other == label).map_or("", |(_, value)| value)
}

#[test]
fn node_facts_follow_the_run() {
    let language = Language::English;
    let header = sample_runs::header(&[1.0, 1.0, 0.1], 600);
    let mut state = RunState::new(&header);
    sample_runs::records(&header).iter().for_each(|record| state.apply(record));
    let slow = node_words(&state, 2, state.head(), language);
    let given = state.nodes()[2].given;
    assert!(given.count > 1);
    assert_eq!(value(&slow, "gave"), format!("{} atoms in {} parcels", given.atoms, given.count));
    assert_eq!((value(&slow, "state"), value(&slow, "speed")), ("done", "10 %"));
    assert_eq!((value(&slow, "left"), value(&slow, "in the pipe")), ("0 atoms", "nothing"));
    assert!(value(&slow, "offers of help").starts_with(&format!("{} made, ", state.nodes()[2].offers)));
    assert!(node_words(&state, 3, state.head(), language).is_empty());
}

#[test]
fn paused_node_is_called_paused() {
    let language = Language::English;
    let header = sample_runs::header(&[1.0, 1.0], 60);
    let mut state = RunState::new(&header);
    sample_runs::records(&header).iter().take(30).for_each(|record| state.apply(record));
    let state_of = |state: &RunState| value(&node_words(state, 0, state.head(), language), "state").to_owned();
    let pipe_of = |state: &RunState| value(&node_words(state, 0, state.head(), language), "in the pipe").to_owned();
    assert_eq!((&*state_of(&state), &*pipe_of(&state)), ("tracing", "two atoms, one of which it traces"));
    state.apply(&Record { at: state.head(), kind: RecordKind::Paused { node: 0 } });
    assert_eq!((&*state_of(&state), &*pipe_of(&state)), ("paused", "two atoms, which wait"));
    state.nodes[0].left = 0;
    assert_eq!((&*state_of(&state), &*pipe_of(&state)), ("idle, paused", "nothing"));
}

#[test]
fn parent_has_placed_every_pixel_at_the_end() {
    let language = Language::English;
    let header = sample_runs::header(&[1.0, 0.3], 40);
    let mut state = RunState::new(&header);
    assert_eq!(value(&parent_words(&state, Time::ZERO, language), "placed"), "0 of 2\u{a0}000 pixels, 0 %");
    let records = sample_runs::records(&header);
    records.iter().for_each(|record| state.apply(record));
    let words = parent_words(&state, Time::from_secs(2.0), language);
    assert_eq!(value(&words, "placed"), "2\u{a0}000 of 2\u{a0}000 pixels, 100 %");
    assert_eq!(value(&words, "a hop takes"), "40 ms");
    let is_handled = |record: &&Record| matches!(record.kind, RecordKind::Received { by: Party::Parent, .. });
    let handled = records.iter().filter(is_handled).count();
    assert!(value(&words, "messages").starts_with(&format!("{handled} handled, ")), "{words:?}");
}

#[test]
fn atom_is_followed_from_the_parent_to_the_picture() {
    let language = Language::English;
    let header = sample_runs::header(&[1.0, 1.0, 0.1], 90);
    let mut state = RunState::new(&header);
    let mut told: Vec<String> = Vec::new();
    told.push(atom_words(&state, 89, Time::ZERO, language));
    for record in sample_runs::records(&header) {
        state.apply(&record);
        let words = atom_words(&state, 89, record.at, language);
        told.push(words.split(" for ").next().unwrap_or_default().to_owned());
    }
    told.dedup();
    assert_eq!(told[0], "Atom 90: still with the parent");
    assert_eq!(told[1], "Atom 90: on its way to 3, in its band");
    assert_eq!(told[2], "Atom 90: has been in the queue of 3");
    assert!(told[3].starts_with("Atom 90: on its way from 3 to "), "{told:#?}");
    assert!(told.iter().any(|told| told.ends_with(" traces it now")), "{told:#?}");
    assert!(told.last().is_some_and(|told| told.ends_with(", at a cost of 1.0 ms")), "{told:#?}");
    assert_eq!(atom_words(&state, 90, Time::ZERO, language), "");
}

#[test]
fn begun_atom_has_the_reason_for_its_delay() {
    let language = Language::English;
    let header = sample_runs::header(&[1.0], 9);
    let mut state = RunState::new(&header);
    sample_runs::records(&header).iter().take(3).for_each(|record| state.apply(record));
    assert_eq!(atom_words(&state, 0, state.head(), language), "Atom 1: 1 traces it now");
    let later = state.head() + Duration::from_secs(3);
    assert_eq!(atom_words(&state, 8, later, language), "Atom 9: has been in the queue of 1 for 3.0 s");
    state.apply(&Record { at: later, kind: RecordKind::SpeedSet { node: 0, speed: 0.0 } });
    assert_eq!(atom_words(&state, 0, later, language), "Atom 1: 1 has begun it, but its speed is 0 %");
    state.apply(&Record { at: later, kind: RecordKind::Paused { node: 0 } });
    assert_eq!(atom_words(&state, 0, later, language), "Atom 1: 1 has begun it, but is paused");
}

#[test]
fn each_message_is_described() {
    let header = sample_runs::header(&[1.0, 1.0, 0.1], 300);
    let mut state = RunState::new(&header);
    let mut told = BTreeSet::new();
    for record in sample_runs::records(&header) {
        state.apply(&record);
        told.extend(state.flights().iter().map(|flight| flight_words(flight, Language::English)));
    }
    for part in ["100 atoms for 3, its band", "2 atoms that 2 has traced, for the parent", " atoms from 3 to "] {
        assert!(told.iter().any(|told| told.contains(part)), "{part}: {told:#?}");
    }
    assert!(told.contains("The offer of 1 to help, on its way from 1 to 3"), "{told:#?}");
}
