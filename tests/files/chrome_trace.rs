//! Runs in Chrome's trace format, checked against the format's rules: the fields of each phase, slices that do not
//! overlap, and arrows that begin and end at slices.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use anel::balance::{Condition, Rules, Strategy as Sharing};
use anel::export::write_chrome;
use anel::picture::Size;
use anel::runlog::{Header, LinkSettings, RunLog};
use anel::scenario::Command;
use anel::sim::Sim;
use anel::time::Time;
use proptest::prelude::*;
use serde_json::Value;

use crate::virtual_time;

/// Process and track.
type Track = (u64, u64);

/// A point of an arrow: its phase, its time in nanoseconds, and its track.
type Point = (String, u64, Track);

fn events(log: &RunLog) -> Vec<Value> {
    let mut text = Vec::new();
    write_chrome(&mut text, log).expect("memory takes everything");
    let mut whole: Value = serde_json::from_slice(&text).expect("it is JSON");
    let Value::Array(events) = whole["traceEvents"].take() else { panic!("no list of events") };
    events
}

fn track(event: &Value) -> Track {
    let number = |key: &str| event[key].as_u64().unwrap_or_else(|| panic!("no {key} in {event}"));
    (number("pid"), number("tid"))
}

/// Reads a field, which the format gives in microseconds, as whole nanoseconds.
fn nanos(event: &Value, key: &str) -> u64 {
    let micros = event[key].as_f64().unwrap_or_else(|| panic!("no {key} in {event}"));
    assert!(micros.is_finite() && micros >= 0.0, "{event}");
    (micros * 1e3).round() as u64
}

/// Checks the events against the rules of the format. Returns the number of events of each phase.
fn check(events: &[Value]) -> BTreeMap<String, usize> {
    let mut phases: BTreeMap<String, usize> = BTreeMap::new();
    let mut slices: BTreeMap<Track, Vec<(u64, u64)>> = BTreeMap::new();
    let mut arrows: BTreeMap<(String, u64), Vec<Point>> = BTreeMap::new();
    let (mut named, mut used) = (BTreeSet::new(), BTreeSet::new());
    for event in events {
        let phase = event["ph"].as_str().expect("a phase");
        *phases.entry(phase.into()).or_default() += 1;
        assert!(event["name"].as_str().is_some_and(|name| !name.is_empty()), "{event}");
        assert!(event["pid"].is_u64(), "{event}");
        match phase {
            "M" => {
                let name = event["name"].as_str().unwrap_or_default();
                let known = ["process_name", "process_sort_index", "thread_name", "thread_sort_index"];
                assert!(known.contains(&name) && event["args"].is_object(), "{event}");
                if name == "thread_name" {
                    assert!(named.insert(track(event)), "named twice: {event}");
                }
            }
            "X" => {
                let (from, length) = (nanos(event, "ts"), nanos(event, "dur"));
                assert!(event["cat"].is_string());
                used.insert(track(event));
                slices.entry(track(event)).or_default().push((from, from + length));
            }
            "s" | "t" | "f" => {
                assert_eq!(event["bp"] == "e", phase == "f", "{event}");
                let id = event["id"].as_u64().expect("a number");
                let key = (format!("{} {}", event["cat"], event["name"]), id);
                arrows.entry(key).or_default().push((phase.into(), nanos(event, "ts"), track(event)));
            }
            "i" => {
                assert!(["g", "p", "t"].contains(&event["s"].as_str().unwrap_or_default()), "{event}");
                nanos(event, "ts");
            }
            "C" => {
                nanos(event, "ts");
                let args = event["args"].as_object().expect("counters have values");
                let part = args["part"].as_f64().expect("a number");
                assert!((0.0..=100.0 + 1e-6).contains(&part), "{event}");
            }
            _ => panic!("an unknown phase: {event}"),
        }
    }
    assert!(used.is_subset(&named), "tracks without names: {:?}", used.difference(&named));
    for (track, slices) in &mut slices {
        slices.sort_unstable();
        assert!(slices.windows(2).all(|pair| pair[0].1 <= pair[1].0), "slices overlap on {track:?}");
    }
    for (arrow, points) in &arrows {
        let phases: Vec<&str> = points.iter().map(|(phase, ..)| phase.as_str()).collect();
        let [first, middle @ .., last] = &phases[..] else { panic!("{arrow:?} has one end") };
        assert!((*first, *last) == ("s", "f") && middle.iter().all(|phase| *phase == "t"), "{arrow:?}: {phases:?}");
        assert!(points.is_sorted_by_key(|(_, at, _)| *at), "{arrow:?} goes back in time: {points:?}");
        for (_, at, track) in points {
            let bound =
                slices.get(track).is_some_and(|slices| slices.iter().any(|(from, to)| (*from..=*to).contains(at)));
            assert!(bound, "{arrow:?} points at nothing at {at} on {track:?}");
        }
    }
    phases
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    #[test]
    fn any_run_makes_a_valid_trace(
        speeds in prop::collection::vec(prop::sample::select(&[0.05, 0.3, 1.0][..]), 1..9),
        (width, height, atom) in (1..50u32, 1..12u32, 1..40u32),
        strategy in prop::sample::select(&Sharing::ALL),
        (latency, handling) in (prop::sample::select(&[0_u64, 1, 40, 1000][..]), 0..3u64),
        bandwidth in prop::option::of(1e4..1e6f64),
        script in prop::collection::vec((0..2000u64, 0..9u16, any::<bool>()), 0..6),
    ) {
        let nodes = speeds.len() as u16;
        let plain = Header::plain(Size::new(width, height).expect("a small picture"), atom, strategy, speeds);
        let link = LinkSettings { latency: Duration::from_millis(latency), bandwidth, ..LinkSettings::default() };
        let rules = Rules { batch: Some(Duration::from_millis(5)), ..plain.rules };
        let header = Header { link, rules, handling: Duration::from_millis(handling), ..plain };
        let ms = |at: u64| Time(at * 1_000_000);
        let mut commands = Vec::new();
        for (at, node, pauses) in script {
            let node = node % nodes;
            if pauses {
                commands.push((ms(at), Command::Pause { node, paused: true }));
                commands.push((ms(at + 500), Command::Pause { node, paused: false }));
            } else {
                commands.push((ms(at), Command::Speed { node, speed: 0.5 }));
            }
        }
        let log = virtual_time::run(&header, &commands, |atom| f64::from(1 + atom % 5) * 1e-3);
        let phases = check(&events(&log));
        let atoms = header.division.atoms() as usize;
        prop_assert!(phases["X"] > atoms, "one slice for each atom, and slices for messages: {phases:?}");
    }
}

#[test]
fn ring_with_a_slow_machine_has_arrows_for_offers_and_atoms() {
    let plain = Header::plain(Size::new(100, 30).unwrap(), 10, Sharing::Ring, vec![1.0, 1.0, 0.1]);
    let log = virtual_time::run(&plain, &[], |_| 1e-3);
    let events = events(&log);
    check(&events);
    let arrows = |name: &str| events.iter().filter(|event| event["ph"] == "f" && event["name"] == name).count();
    assert!(arrows("offer") > 2 && arrows("atoms") > 2, "{} {}", arrows("offer"), arrows("atoms"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    #[test]
    fn machines_that_fail_make_a_valid_trace(
        fails in prop::collection::vec(
            (0..900u64, 0..4u16, prop::sample::select(&[Condition::Off, Condition::Hung, Condition::CutOff][..])), 1..4,
        ),
        strategy in prop::sample::select(&[Sharing::Adaptive, Sharing::Ring][..]),
    ) {
        let plain = Header::plain(Size::new(100, 30).expect("a small picture"), 10, strategy, vec![1.0; 4]);
        let link = LinkSettings { latency: Duration::from_millis(4), ..plain.link };
        let header = Header { link, pace: 0.1, ..plain };
        let ms = |at: u64| Time(at * 1_000_000);
        let mut script = Vec::new();
        for (at, node, condition) in fails {
            script.push((ms(at), Command::Condition { node, condition }));
            script.push((ms(at + 600), Command::Condition { node, condition: Condition::Well }));
        }
        script.sort_by_key(|(at, _)| *at);
        let mut log = RunLog::new(header.clone());
        let mut records = Vec::new();
        Sim::new(&header, &script, |_| Duration::from_millis(1)).run(&mut |record| records.push(record));
        log.add(records);
        let events = events(&log);
        check(&events);
        let expected = ["switched off", "hangs", "cut off", "the picture is complete"];
        let is_told = |what: &&str| events.iter().any(|event| event["ph"] == "i" && event["name"] == **what);
        prop_assert!(expected.iter().any(is_told));
    }
}

#[test]
fn incomplete_run_makes_a_valid_trace() {
    let plain = Header::plain(Size::new(100, 30).unwrap(), 10, Sharing::Ring, vec![1.0, 1.0, 0.1]);
    let whole = virtual_time::run(&plain, &[], |_| 1e-3);
    for records in [0, 1, 7, whole.records().len() / 2] {
        let mut log = RunLog::new(plain.clone());
        log.add(whole.records()[..records].to_vec());
        check(&events(&log));
    }
}
