//! Tests of the list of events.

use std::time::Duration;

use proptest::prelude::*;

use super::list::MAX_EVENTS;
use super::*;
use crate::language::Language;
use crate::view::tests::sample_runs;

fn sentences(events: &EventLog) -> Vec<String> {
    events.iter().map(|(_, event)| event.sentence(Language::English)).collect()
}

/// The events of `records`, at their times in ms.
fn events_of(nodes: usize, records: impl IntoIterator<Item = (u64, RecordKind)>) -> EventLog {
    let (mut state, mut events) = (RunState::new(&sample_runs::header(&vec![1.0; nodes], 900)), EventLog::default());
    for (ms, kind) in records {
        let record = Record { at: Time(ms * 1_000_000), kind };
        state.apply(&record);
        events.apply(&record, &state);
    }
    events
}

fn transfer(from: NodeId, to: NodeId, atoms: u32) -> RecordKind {
    let (from, to) = (Party::Node(from), Party::Node(to));
    let message = Message::Transfer(std::iter::once(0..atoms).collect());
    RecordKind::Sent { id: 0, from, to, message, bytes: 0, arrives: Time::ZERO }
}

proptest! {
    #[test]
    fn events_of_a_run_are_few_and_in_order(
        speeds in prop::collection::vec(0.02..1.0f64, 1..9), atoms in 1..400u32,
    ) {
        let header = sample_runs::header(&speeds, atoms);
        let (mut state, mut events) = (RunState::new(&header), EventLog::default());
        for record in sample_runs::records(&header) {
            state.apply(&record);
            events.apply(&record, &state);
            prop_assert!(events.events.len() <= MAX_EVENTS);
        }
        prop_assert!(events.events.iter().is_sorted_by_key(|event| event.at));
        for sentence in sentences(&events) {
            prop_assert!(sentence.chars().count() <= 95, "{sentence}");
        }
        prop_assert!(sentences(&events).contains(&Happening::Complete.sentence(Language::English)));
        // Every node makes offers at the end; only the first is an event.
        for node in 0..speeds.len() as NodeId {
            let offers = events.events.iter().filter(|event| event.kind == EventKind::Offer(node)).count();
            prop_assert!(offers == 1 || events.events.len() == MAX_EVENTS);
        }
    }
}

#[test]
fn list_names_the_slow_machine_and_its_transfers() {
    let header = sample_runs::header(&[1.0, 1.0, 0.1], 600);
    let (mut state, mut events) = (RunState::new(&header), EventLog::default());
    for record in sample_runs::records(&header) {
        state.apply(&record);
        events.apply(&record, &state);
    }
    let sentences = sentences(&events);
    assert_eq!(sentences[0], "The parent gives each of 3 emulated machines an equal band of the picture");
    assert_eq!(sentences[1], "1 has finished its band and offers help round the ring");
    assert!(sentences.iter().any(|event| event.starts_with("3, slow at 10 %, gave ")), "{sentences:#?}");
}

#[test]
fn small_transfers_of_a_machine_are_one_event() {
    let [one, two, more] = [1, 2, 40].map(|atoms| move |from, to| transfer(from, to, atoms));
    let events = events_of(8, [(0, one(6, 1)), (10, one(6, 7)), (20, one(4, 2)), (30, more(6, 3)), (40, one(6, 2))]);
    assert_eq!(
        sentences(&events),
        ["5 gave 1 atom to 3", "7 gave 40 atoms to 4, which had finished", "7 gave 1 atom to 2, 3 and 8"]
    );
    let events = events_of(8, [(0, one(6, 1)), (10, two(6, 1)), (20, two(6, 3)), (9000, one(6, 1))]);
    assert_eq!(sentences(&events), ["7 gave few atoms at a time to 2 and 4: 5 in 3 parcels", "7 gave 1 atom to 2"]);
}

#[test]
fn many_small_transfers_do_not_crowd_out_other_events() {
    let small = (0..500).map(|i: u16| (u64::from(i), transfer(i % 7, i % 3 + 7, 1)));
    let events = events_of(12, std::iter::once((0, transfer(0, 1, 99))).chain(small));
    assert_eq!(events.events.len(), 8);
    assert_eq!(sentences(&events)[0], "1 gave 99 atoms to 2, which had finished");
}

#[test]
fn machines_that_retire_together_are_one_event() {
    let events = events_of(4, [2, 0, 3].map(|node| (10 * u64::from(node), RecordKind::Retired { node })));
    assert_eq!(sentences(&events), ["1, 3 and 4 retire: their offers came back, nobody needs their help"]);
}

#[test]
fn dragged_slider_is_one_event() {
    let speed = |node, percent: u64| RecordKind::SpeedSet { node, speed: percent as f64 / 100.0 };
    let ms = Duration::from_millis;
    let events = events_of(
        3,
        [
            (0, speed(1, 80)),
            (100, transfer(0, 2, 50)),
            (200, speed(1, 30)),
            (300, RecordKind::LatencySet { latency: ms(90) }),
            (400, RecordKind::LatencySet { latency: ms(200) }),
            (500, speed(2, 60)),
            (6000, speed(1, 40)),
            (6100, RecordKind::Paused { node: 2 }),
            (6200, RecordKind::Resumed { node: 2 }),
        ],
    );
    assert_eq!(
        sentences(&events),
        [
            "1 gave 50 atoms to 3, which had finished",
            "Machine 2 now runs at 30 %: the others will take over its work",
            "A hop now takes 200 ms",
            "Machine 3 now runs at 60 %: the others will take over its work",
            "Machine 2 now runs at 40 %: it can take more work",
            "Machine 3 is paused: the others will take over its work",
            "Machine 3 continues",
        ]
    );
}

#[test]
fn only_the_last_events_are_kept() {
    let records = (0..200).map(|i| (i, transfer(0, 1, 100 + i as u32)));
    let events = events_of(2, records);
    assert_eq!(events.events.len(), MAX_EVENTS);
    assert_eq!(sentences(&events)[MAX_EVENTS - 1], "1 gave 299 atoms to 2, which had finished");
}
