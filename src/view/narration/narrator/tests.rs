//! Tests of the sentences that are read while a run goes on.

use std::collections::BTreeSet;
use std::ops::Range;

use super::*;
use crate::balance::{NodeId, Rules, Strategy};
use crate::runlog::{Driver, Header};
use crate::scenario::Command;
use crate::sim::Sim;
use crate::view::tests::sample_runs;

#[test]
fn slow_machine_is_told_of() {
    let language = Language::English;
    let header = sample_runs::header(&[1.0, 1.0, 0.1], 2400);
    let (mut state, mut narrator, mut heard) = (RunState::new(&header), Narrator::default(), Vec::new());
    for record in sample_runs::records(&header) {
        state.apply(&record);
        narrator.apply(&record, &state);
        heard.push(narrator.sentence(&state, record.at, language));
    }
    heard.dedup();
    let says = |part: &str| heard.iter().any(|sentence| sentence.contains(part));
    assert!(says("The parent gives each of 3 emulated machines an equal band"), "{heard:#?}");
    assert!(says("3 machines compute; 3 is slow (10 %)"), "{heard:#?}");
    assert!(says("from 3 (slow, 10 %): "), "{heard:#?}");
    assert_eq!(heard.last().map(String::as_str), Some("The picture is complete"));
    assert!(heard.iter().all(|sentence| sentence.chars().count() <= 110), "{heard:#?}");
}

#[test]
fn sentence_stays_until_read_or_outweighed() {
    let language = Language::English;
    let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0], 9));
    let mut narrator = Narrator::default();
    let at = |ms: u64| Time(ms * 1_000_000);
    let mut say = |ms, kind| {
        let record = Record { at: at(ms), kind };
        state.apply(&record);
        narrator.apply(&record, &state);
        narrator.sentence(&state, record.at, language)
    };
    assert!(say(0, RecordKind::Retired { node: 0 }).starts_with("1's offer"));
    assert!(say(100, RecordKind::Retired { node: 1 }).starts_with("1's offer"));
    assert!(say(200, RecordKind::SpeedSet { node: 1, speed: 0.25 }).starts_with("Machine 2 now runs at 25 %"));
    assert!(say(300, RecordKind::Retired { node: 1 }).starts_with("Machine 2"));
    assert!(
        say(400, RecordKind::LatencySet { latency: Duration::from_millis(200) }).starts_with("A hop now takes 200 ms")
    );
    assert!(say(2100, RecordKind::Retired { node: 1 }).starts_with("2's offer"));
    assert!(say(2200, RecordKind::Finished).starts_with("The picture"));
    assert!(say(9000, RecordKind::SpeedSet { node: 1, speed: 0.5 }).starts_with("The picture"));
}

#[test]
fn slow_playback_shows_skipped_events() {
    let language = Language::English;
    let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0, 1.0], 9));
    let mut narrator = Narrator::default();
    let at = |ms: u64| Time(ms * 1_000_000);
    for (ms, node) in [(0, 0), (100, 1), (200, 2)] {
        let record = Record { at: at(ms), kind: RecordKind::Retired { node } };
        state.apply(&record);
        narrator.apply(&record, &state);
    }
    let mut says = |rate, ms| {
        state.set_rate(rate);
        narrator.sentence(&state, at(ms), language)
    };
    assert!(says(1.0, 250).starts_with("1's offer"));
    assert!(says(0.01, 210).starts_with("3's offer"));
    assert!(says(0.1, 250).starts_with("3's offer"), "the second stays for 160 ms");
    assert_eq!(says(0.01, 250), "The machines wait for the parent", "it was fresh for 30 ms");
}

#[test]
fn transfer_of_twice_the_atoms_outweighs_another() {
    let language = Language::English;
    let state = RunState::new(&sample_runs::header(&[1.0, 1.0, 0.1], 900));
    let mut narrator = Narrator::default();
    let mut say = |ms: u64, from, atoms| {
        let (from, to, at) = (Party::Node(from), Party::Node(0), Time(ms * 1_000_000));
        let message = Message::Transfer(std::iter::once(0..atoms).collect());
        let kind = RecordKind::Sent { id: ms, from, to, message, bytes: 0, arrives: at };
        narrator.apply(&Record { at, kind }, &state);
        narrator.sentence(&state, at, language)
    };
    assert!(say(0, 1, 20).contains(" takes all 20 atoms that wait from 2: "));
    assert!(say(100, 1, 30).contains("takes all 20 atoms"));
    assert!(say(200, 2, 200).contains("takes all 200 atoms that wait from 3 (slow, 10 %): "));
    assert!(say(300, 1, 20).contains("takes all 200 atoms"));
}

#[test]
fn sentence_on_a_speed_follows_the_slider() {
    let language = Language::English;
    let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0, 0.1], 9));
    let mut narrator = Narrator::default();
    let mut set = |ms: u64, node, speed| {
        let record = Record { at: Time(ms * 1_000_000), kind: RecordKind::SpeedSet { node, speed } };
        state.apply(&record);
        narrator.apply(&record, &state);
        narrator.sentence(&state, record.at, language)
    };
    for (ms, speed) in [(0, 0.86), (50, 0.4), (100, 0.01)] {
        let expected = format!("Machine 2 now runs at {:.0} %: the others will take over its work", speed * 100.0);
        assert_eq!(set(ms, 1, speed), expected);
    }
    assert_eq!(set(150, 1, 0.0), "Machine 2 is stopped: the others will take over its work");
    assert_eq!(set(200, 1, 0.7), "Machine 2 now runs at 70 %: the others will take over its work");
    assert_eq!(set(250, 1, 1.0), "Machine 2 now runs at 100 %");
    assert_eq!(set(300, 2, 0.6), "Machine 3 now runs at 60 %: it can take more work");
    assert_eq!(set(350, 2, 1.0), "Machine 3 now runs at 100 %: it can take more work");
    assert_eq!(set(9000, 2, 0.9), "Machine 3 now runs at 90 %: the others will take over its work");
}

/// The sentences of a run by `strategy` whose last machine is slow, and the list of events at its end.
fn story(strategy: Strategy, handling: u64, language: Language) -> (BTreeSet<String>, Vec<String>) {
    let plain = sample_runs::header(&[1.0, 1.0, 1.0, 1.0, 0.1], 2000);
    let rules = Rules { strategy: strategy.clone(), part: strategy.usual_part(plain.division, 5), ..plain.rules };
    let header = Header { rules, handling: Duration::from_millis(handling), ..plain };
    let (mut state, mut narrator, mut heard) = (RunState::new(&header), Narrator::default(), BTreeSet::new());
    for record in sample_runs::records(&header) {
        // The status before it.
        heard.insert(narrator.sentence(&state, record.at, language));
        state.apply(&record);
        narrator.apply(&record, &state);
        heard.insert(narrator.sentence(&state, record.at, language));
    }
    assert!(heard.iter().all(|sentence| sentence.chars().count() <= 105), "{heard:#?}");
    let listed: Vec<_> = narrator.events().map(|(_, event)| event.sentence(language)).collect();
    assert!(listed.iter().all(|sentence| sentence.chars().count() <= 110), "{listed:#?}");
    (heard, listed)
}

/// Asserts that each part is in a sentence, and that no sentence is about a ring.
fn assert_heard(heard: &BTreeSet<String>, parts: &[&str]) {
    for part in parts {
        assert!(heard.iter().any(|sentence| sentence.contains(part)), "{part}: {heard:#?}");
    }
    let of_the_ring = |sentence: &&String| sentence.contains("offer") || sentence.contains("retire");
    assert_eq!(heard.iter().find(of_the_ring), None);
}

#[test]
fn parts_of_a_farm_are_one_event() {
    let language = Language::English;
    let (heard, listed) = story(Strategy::Farm, 0, language);
    assert_heard(
        &heard,
        &[
            "The parent gives each of 5 emulated machines a first part: 25 atoms",
            " asks the parent for more and gets 25 atoms",
            " asks for more, but the parent has no more: ",
        ],
    );
    let parts = listed.iter().filter(|event| event.starts_with("The parent has handed out")).count();
    assert!(parts == 1 && listed.len() < 12, "{listed:#?}");
    assert!(listed.iter().any(|event| event.ends_with(" asked for more, but the parent has no more")), "{listed:#?}");
}

#[test]
fn queue_at_slow_parent_is_told_of() {
    let language = Language::English;
    let (heard, listed) = story(Strategy::Farm, 40, language);
    assert_heard(&heard, &[" messages wait at the parent; it needs 40 ms for each"]);
    let jams = listed.iter().filter(|event| event.contains("messages wait")).count();
    assert!((1..40).contains(&jams), "{listed:#?}");
}

#[test]
fn with_fixed_bands_all_wait_for_the_slow_machine() {
    let language = Language::English;
    let (heard, listed) = story(Strategy::Static, 0, language);
    assert_heard(
        &heard,
        &[
            "The parent gives each of 5 emulated machines an equal band",
            "1 has finished and waits: nobody shares with it",
            "All wait for 5, which is slow (10 %): ",
        ],
    );
    assert!(listed.iter().any(|event| event == "1, 2, 3 and 4 have finished and wait: nobody shares with them"));
    let (heard, _) = story(Strategy::StaticEstimate, 0, language);
    assert_heard(
        &heard,
        &[&Happening::Estimating.sentence(Language::English), "a band that should cost the same", "All wait for 5"],
    );
    let (heard, _) = story(Strategy::Serial, 0, language);
    assert_heard(&heard, &["one machine the whole picture", "1 computes alone: "]);
}

#[test]
fn thefts_are_told_of() {
    let language = Language::English;
    let header = Header { driver: Driver::WorkStealing, ..sample_runs::header(&[1.0, 1.0, 0.1], 600) };
    let mut state = RunState::new(&header);
    let mut narrator = Narrator::default();
    let mut say = |ms: u64, from, atoms| {
        let (from, to, at) = (Party::Node(from), Party::Node(2), Time(ms * 1_000_000));
        let message = Message::Transfer(std::iter::once(0..atoms).collect());
        let record = Record { at, kind: RecordKind::Sent { id: ms, from, to, message, bytes: 0, arrives: at } };
        state.apply(&record);
        narrator.apply(&record, &state);
        narrator.sentence(&state, at, language)
    };
    assert_eq!(say(0, 0, 96), "3 steals 96 atoms from 1");
    assert_eq!(say(9000, 1, 1), "3 steals 1 atom from 2");
    let listed: Vec<_> = narrator.events().map(|(_, event)| event.sentence(Language::English)).collect();
    assert_eq!(listed, ["3 steals 96 atoms from 1", "3 steals few atoms at a time from 2: 1 atom"]);
}

/// The state of a ring in which each machine has nine atoms.
fn ring_of(machines: NodeId) -> RunState {
    let mut state = RunState::new(&sample_runs::header(&vec![1.0; usize::from(machines)], 9 * u32::from(machines)));
    for node in 0..machines {
        let (id, to, at) = (u64::from(node), Party::Node(node), Time::ZERO);
        let message = Message::Band(9 * u32::from(node)..9 * u32::from(node) + 9);
        let from = Party::Parent;
        state.apply(&Record { at, kind: RecordKind::Sent { id, from, to, message, bytes: 0, arrives: at } });
        state.apply(&Record { at, kind: RecordKind::Received { id, by: to } });
    }
    state
}

#[test]
fn list_has_every_event_but_the_one_of_the_sentence() {
    let language = Language::English;
    let (mut state, mut narrator) = (ring_of(3), Narrator::default());
    let at = |ms: u64| Time(ms * 1_000_000);
    for (ms, kind) in [
        (0, RecordKind::Paused { node: 2 }),
        (5000, RecordKind::Retired { node: 0 }),
        (9000, RecordKind::SpeedSet { node: 1, speed: 0.5 }),
        (9200, RecordKind::Retired { node: 1 }),
    ] {
        let record = Record { at: at(ms), kind };
        state.apply(&record);
        narrator.apply(&record, &state);
    }
    let now = at(9300);
    assert!(narrator.sentence(&state, now, language).starts_with("Machine 2 now runs at 50 %"));
    assert_eq!((narrator.event_time(&state, now), narrator.events_so_far()), (Some(at(9000)), 4));
    let listed: Vec<Time> = narrator.other_events(&state, now).map(|(at, _)| at).collect();
    assert_eq!(listed, [at(0), at(5000), at(9200)]);
    assert_eq!((narrator.event_time(&state, at(30_000)), narrator.other_events(&state, at(30_000)).count()), (None, 4));
}

#[test]
fn faster_machine_is_promised_work_only_while_there_is_some() {
    let language = Language::English;
    let effect = |state: &RunState| {
        let sentence = Happening::speed(state, 0, 0.1, 1.0).sentence(language);
        sentence.split_once(": ").map(|(_, effect)| effect.to_owned())
    };
    let mut state = ring_of(2);
    assert_eq!(effect(&state).as_deref(), Some("it can take more work"));
    let trace = |state: &mut RunState, atoms: Range<u32>, node| {
        for atom in atoms {
            let kind = RecordKind::AtomDone { node, atom, cost: Duration::ZERO };
            state.apply(&Record { at: Time::from_secs(1.0), kind });
        }
    };
    trace(&mut state, 9..17, 1);
    assert_eq!(effect(&state).as_deref(), Some("it will trace its last atoms sooner"));
    trace(&mut state, 0..9, 0);
    assert_eq!(effect(&state), None);
    state.apply(&Record { at: Time::from_secs(2.0), kind: RecordKind::Retired { node: 0 } });
    assert_eq!(effect(&state).as_deref(), Some("it has retired and takes no more work"));
}

#[test]
fn neighbour_that_answers_first_is_named() {
    let language = Language::English;
    let header = sample_runs::header(&[0.2, 1.0, 1.0], 900);
    let (mut state, mut narrator, mut heard) = (RunState::new(&header), Narrator::default(), BTreeSet::new());
    let script = [(Time::from_secs(1.0), Command::Pause { node: 2, paused: true })];
    Sim::new(&header, &script, |_| sample_runs::COST).run(&mut |record| {
        state.apply(&record);
        narrator.apply(&record, &state);
        heard.insert(narrator.sentence(&state, record.at, language));
    });
    let says = |begins: &str, ends: &str| heard.iter().any(|said| said.starts_with(begins) && said.ends_with(ends));
    assert!(says("Machine 3 is paused: 1 answers offers first, then the others take over its work", ""), "{heard:#?}");
    let with = "paused since 1.0 s with 204 atoms";
    assert!(says("2 takes ", &format!(" from 1, so its offer does not reach 3, {with}")), "{heard:#?}");
}
