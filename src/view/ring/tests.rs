//! Tests of the ring's drawing as a whole.

use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::time::Duration;

use proptest::prelude::*;

use super::*;
use crate::balance::{Condition, Strategy};
use crate::record::{Record, RecordKind};
use crate::runlog::Header;
use crate::view::draw::display_list::{Ink, TextSize};
use crate::view::state::flight::Cargo;
use crate::view::tests::sample_runs;

const SIZE: Point = [520.0, 480.0];

/// The layout of a run's ring in an area of `size`.
fn layout(state: &RunState, size: Point) -> RingLayout {
    RingLayout::new(state.nodes().len(), size, Language::English)
}

/// The ring in an area of `size`.
fn drawn(state: &RunState, overlay: &RingOverlay, now: Time, size: Point) -> Vec<Mark> {
    ring(&layout(state, size), state, overlay, now, Language::English)
}

/// Points that bound a mark.
fn bounds(mark: &Mark) -> Vec<Point> {
    match mark {
        Mark::Disc { centre, radius, .. } => corners(*centre, [*radius; 2]),
        Mark::Box { centre, half, .. } => corners(*centre, *half),
        Mark::Line { points, .. } | Mark::Trail { points, .. } => points.clone(),
        Mark::Label { .. } => {
            let [left, top, right, bottom] = extent(mark).expect("a label");
            vec![[left, top], [right, bottom]]
        }
    }
}

fn corners([x, y]: Point, [w, h]: Point) -> Vec<Point> {
    vec![[x - w, y - h], [x + w, y + h]]
}

/// Left, top, right and bottom of a label; `None` for another mark.
fn extent(mark: &Mark) -> Option<[f32; 4]> {
    let Mark::Label { at: [x, y], anchor, text, size, .. } = mark else { return None };
    let (width, half) = (size.width(text.chars().count()), size.line() / 2.0);
    let left = anchor.left(*x, width);
    Some([left, y - half, left + width, y + half])
}

/// Extents of the labels beside the rail; labels on nodes, offers and parcels are left out.
fn labels(marks: &[Mark]) -> Vec<[f32; 4]> {
    let beside = |mark: &&Mark| matches!(mark, Mark::Label { text, size, .. } if !matches!(size, TextSize::Fit(_)) && !text.starts_with('×'));
    marks.iter().filter(beside).filter_map(extent).collect()
}

fn texts(marks: &[Mark]) -> Vec<&str> {
    let text = |mark: &'_ Mark| matches!(mark, Mark::Label { .. });
    marks
        .iter()
        .filter(|mark| text(mark))
        .filter_map(|mark| if let Mark::Label { text, .. } = mark { Some(&**text) } else { None })
        .collect()
}

/// The state of a run with these speeds after `part` of its records, with its first node paused, and its time.
fn state_after(speeds: &[f64], part: f64) -> (RunState, Time) {
    let header = sample_runs::header(speeds, 60);
    let (records, mut state) = (sample_runs::records(&header), RunState::new(&header));
    let count = (records.len() as f64 * part) as usize;
    records[..count].iter().for_each(|record| state.apply(record));
    let now = state.head();
    state.apply(&Record { at: now, kind: RecordKind::Paused { node: 0 } });
    (state, now)
}

proptest! {
    #[test]
    fn marks_stay_inside(
        speeds in prop::collection::vec(0.05..1.0f64, 1..33), part in 0.0..1.0f64, selected in 0..33u16,
        width in 240.0..1000.0f32, height in 240.0..1000.0f32,
    ) {
        let (state, now) = state_after(&speeds, part);
        for later in 0..8 {
            let overlay = RingOverlay { selected: Some(selected), ..RingOverlay::default() };
            let now = now + Duration::from_millis(150 * later);
            for point in drawn(&state, &overlay, now, [width, height]).iter().flat_map(bounds) {
                prop_assert!((0.0..=width).contains(&point[0]) && (0.0..=height).contains(&point[1]), "{point:?}");
            }
        }
    }

    #[test]
    fn labels_touch_neither_each_other_nor_the_rail(
        speeds in prop::collection::vec(0.05..1.0f64, 1..33), part in 0.0..1.0f64, selected in 0..33u16,
        width in 240.0..1000.0f32, height in 240.0..1000.0f32,
    ) {
        let (state, now) = state_after(&speeds, part);
        let selected = selected % speeds.len() as u16;
        let overlay = RingOverlay { selected: Some(selected), ..RingOverlay::default() };
        let layout = RingLayout::new(speeds.len(), [width, height], Language::English);
        let [x, y] = layout.centre;
        let nearest = |[left, top, right, bottom]: [f32; 4]| {
            (left - x).max(x - right).max(0.0).hypot((top - y).max(y - bottom).max(0.0))
        };
        let mut labels = labels(&drawn(&state, &overlay, now, [width, height]));
        // Leaves out the texts in the centre.
        labels.retain(|&label| nearest(label) > layout.parent_radius);
        let least = if speeds.len() <= 16 { speeds.len() } else { 1 };
        prop_assert!(labels.len() >= least, "{labels:?}");
        prop_assert!(labels.len() <= 2 * speeds.len().min(16));
        for (i, one) in labels.iter().enumerate() {
            prop_assert!(nearest(*one) > layout.rail_radius + 9.0, "{one:?} lies on the rail");
            for other in &labels[..i] {
                let apart = [one[0] - other[2], other[0] - one[2], one[1] - other[3], other[1] - one[3]];
                let apart = apart.into_iter().fold(f32::NEG_INFINITY, f32::max);
                prop_assert!(apart > -0.01, "{one:?} and {other:?} overlap by {apart}");
            }
        }
    }

    #[test]
    fn node_under_pointer_is_found(nodes in 1..33usize, width in 240.0..1000.0f32, height in 240.0..1000.0f32) {
        let layout = RingLayout::new(nodes, [width, height], Language::English);
        for node in 0..nodes as NodeId {
            prop_assert_eq!(ring_at(&layout, layout.seat(node)), Some(RingSpot::Node(node)));
        }
        prop_assert_eq!(ring_at(&layout, layout.centre), Some(RingSpot::Parent));
        prop_assert_eq!(ring_at(&layout, [1.0, 1.0]), None);
        prop_assert_eq!(ring_at(&layout, layout.at(0.3, layout.interior_radius() * 0.9)), None);
    }
}

/// Calls `see` with the marks of the ring at moments of a run by `strategy`, for several sizes.
fn for_each_moment(strategy: Strategy, speeds: &[f64], mut see: impl FnMut(&RingLayout, &[Mark])) {
    let mut header = sample_runs::header(speeds, 40 * speeds.len() as u32);
    header.rules.strategy = strategy;
    let (mut state, records) = (RunState::new(&header), sample_runs::records(&header));
    for (i, record) in records.iter().enumerate() {
        state.apply(record);
        if i % 23 == 0 {
            for size in [[411.0, 411.0], [737.0, 411.0], [1000.0, 640.0]] {
                let layout = layout(&state, size);
                see(&layout, &drawn(&state, &RingOverlay::default(), record.at, size));
            }
        }
    }
}

/// The boxes with a count, each with its extent.
fn count_boxes(marks: &[Mark]) -> Vec<[f32; 4]> {
    let is_count = |mark: &&[Mark]| matches!(&mark[1], Mark::Label { text, .. } if text.starts_with('×'));
    let boxes = marks.windows(2).filter(is_count).filter_map(|pair| match pair[0] {
        Mark::Box { centre: [x, y], half: [w, h], ink, .. } if ink.alpha > 0.02 => Some([x - w, y - h, x + w, y + h]),
        _ => None,
    });
    boxes.collect()
}

/// The discs of offers, each with centre and radius.
fn offer_discs(layout: &RingLayout, marks: &[Mark]) -> Vec<(Point, f32)> {
    let disc = |mark: &Mark| match *mark {
        Mark::Disc { centre: [x, y], radius, ink: Ink { hue: Hue::Node(_), alpha } } if alpha > 0.02 => {
            let away = (x - layout.centre[0]).hypot(y - layout.centre[1]);
            (away > layout.rail_radius - 1.0).then_some(([x, y], radius))
        }
        _ => None,
    };
    marks.iter().filter_map(disc).collect()
}

#[test]
fn counts_and_offers_meet_neither_discs_nor_each_other() {
    let (mut counts, mut offers) = (0, 0);
    for strategy in [Strategy::Ring, Strategy::Adaptive] {
        for nodes in [2, 3, 8, 16, 32] {
            let mut speeds = vec![1.0; nodes];
            speeds[nodes / 2] = 0.1;
            for_each_moment(strategy.clone(), &speeds, |layout, marks| {
                let boxes = count_boxes(marks);
                let reach = layout.node_reach();
                let machines = (0..nodes as NodeId).map(|node| (layout.seat(node), reach));
                let discs: Vec<_> = machines.chain([(layout.centre, layout.parent_radius)]).collect();
                let away = |[x, y]: Point, [left, top, right, bottom]: [f32; 4]| {
                    (left - x).max(x - right).max(0.0).hypot((top - y).max(y - bottom).max(0.0))
                };
                for (i, &one) in boxes.iter().enumerate() {
                    for &(centre, radius) in &discs {
                        assert!(away(centre, one) > radius, "{one:?} of {nodes} covers the disc at {centre:?}");
                    }
                    for other in &boxes[..i] {
                        let apart = [one[0] - other[2], other[0] - one[2], one[1] - other[3], other[1] - one[3]];
                        assert!(apart.into_iter().fold(f32::MIN, f32::max) > 0.0, "{one:?} meets {other:?}");
                    }
                }
                let tokens = offer_discs(layout, marks);
                for (i, (one, radius)) in tokens.iter().enumerate() {
                    for (centre, reach) in discs.iter().chain(&tokens[..i]) {
                        let apart = (one[0] - centre[0]).hypot(one[1] - centre[1]) - radius - reach;
                        assert!(apart > -0.1, "an offer among {nodes} meets the disc at {centre:?} by {apart}");
                    }
                }
                (counts, offers) = (counts + boxes.len(), offers + tokens.len());
            });
        }
    }
    assert!(counts > 100 && offers > 100, "{counts} counts, {offers} offers");
}

#[test]
fn parcels_of_a_pair_are_drawn_as_one_with_the_sum_of_their_atoms() {
    let mut merged = 0;
    for (strategy, nodes) in [(Strategy::Ring, 3), (Strategy::Adaptive, 8), (Strategy::Adaptive, 16)] {
        let mut header = sample_runs::header(&vec![1.0; nodes], 200 * nodes as u32);
        (header.rules.strategy, header.speeds[nodes / 2]) = (strategy, 0.05);
        let mut state = RunState::new(&header);
        for record in &sample_runs::records(&header) {
            state.apply(record);
            let now = record.at;
            let is_shown = |flight: &&Flight| {
                matches!(flight.cargo, Cargo::Transfer(_) | Cargo::Again(_)) && flight.shown().contains(&now)
            };
            let shown: Vec<_> = state.flights().iter().filter(is_shown).collect();
            let leader = |of: &Flight| shown.iter().find(|flight| of.carrier.is_some_and(|by| by.id == flight.id));
            for (other, leader) in shown.iter().filter_map(|other| Some((other, leader(other)?))) {
                assert_eq!((other.from, other.to, other.shown().end), (leader.from, leader.to, leader.shown().end));
                assert_eq!(other.progress(now), leader.progress(now));
                assert!(other.arrives <= other.shown().end, "it is not drawn at its end before it arrives");
                merged += 1;
            }
            if state.opacity(now) > 0.0 {
                let sum: u32 = shown.iter().map(|flight| flight.cargo.atoms()).sum();
                assert_eq!(parcels::atoms_drawn(&layout(&state, SIZE), &state, now), sum, "at {} s", now.secs());
            }
        }
    }
    assert!(merged > 20, "{merged}");
}

#[test]
fn parcel_is_found_where_it_is_drawn() {
    let (state, now) = state_after(&[1.0, 1.0, 0.1], 0.7);
    let marks = drawn(&state, &RingOverlay::default(), now, SIZE);
    let label = |mark: &Mark| match mark {
        Mark::Label { at, text, .. } if text.starts_with('×') => Some((*at, text.clone())),
        _ => None,
    };
    let (at, text) = marks.iter().rev().find_map(label).expect("a parcel");
    let flight = message_at(&layout(&state, SIZE), &state, now, at).expect("the parcel");
    assert_eq!(text, format!("×{}", flight.cargo.atoms()));
    assert_eq!(message_at(&layout(&state, SIZE), &state, now, [1.0, 1.0]), None);
}

#[test]
fn offer_is_found_where_it_is_drawn() {
    let found = |part: u32| {
        let (state, now) = state_after(&[1.0, 1.0, 0.1], f64::from(part) / 20.0);
        let offer = |mark: &Mark| {
            let Mark::Label { at, text, ink: Ink { hue: Hue::Text, .. }, .. } = mark else { return false };
            let Ok(name) = text.parse::<NodeId>() else { return false };
            let (at, who) = (*at, name - 1);
            message_at(&layout(&state, SIZE), &state, now, at)
                .is_some_and(|flight| flight.cargo == Cargo::Offer { who })
        };
        drawn(&state, &RingOverlay::default(), now, SIZE).iter().any(offer)
    };
    assert!((1..20).any(found));
}

#[test]
fn pause_selection_and_pipe_are_drawn() {
    let (mut state, now) = state_after(&[1.0, 1.0, 0.1], 0.4);
    // By then no band is on its way.
    let now = now + Duration::from_millis(1200);
    let full = drawn(&state, &RingOverlay::default(), now, [640.0, 490.0]);
    state.nodes.iter_mut().for_each(|node| node.left = 2);
    // Slots are square, bars are high, parcels are wide.
    let boxes = |marks: &[Mark], shape: Ordering| {
        let has = |mark: &&Mark| matches!(mark, Mark::Box { half: [w, h], .. } if h.total_cmp(w) == shape);
        marks.iter().filter(has).count()
    };
    let draw = |state: &RunState, selected| {
        drawn(state, &RingOverlay { selected, ..RingOverlay::default() }, now, [640.0, 490.0])
    };
    let paused = draw(&state, None);
    assert!(texts(&paused).contains(&"paused"));
    assert_eq!(draw(&state, Some(1)).len(), paused.len() + 1);
    state.apply(&Record { at: now, kind: RecordKind::Resumed { node: 0 } });
    let going = draw(&state, None);
    assert!(!texts(&going).contains(&"paused"));
    assert_eq!([boxes(&paused, Ordering::Greater), boxes(&going, Ordering::Greater)], [2, 0], "bars");
    assert_eq!([boxes(&paused, Ordering::Equal), boxes(&going, Ordering::Equal)], [6, 6], "slots");
    assert_eq!(boxes(&full, Ordering::Equal), 0, "others can take atoms");
    let small = drawn(&state, &RingOverlay::default(), now, [240.0, 240.0]);
    assert_eq!(boxes(&small, Ordering::Equal), 0, "too small to be seen");
}

#[test]
fn retired_looks_unlike_idle() {
    let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0], 60));
    state.nodes[0].band_at = Some(Time::ZERO);
    let draw = |state: &RunState| drawn(state, &RingOverlay::default(), Time::ZERO, SIZE);
    let idle = draw(&state);
    state.nodes[0].retired = true;
    let retired = draw(&state);
    assert!(texts(&idle).contains(&"idle") && texts(&retired).contains(&"retired"));
    let lines = |marks: &[Mark]| marks.iter().filter(|mark| matches!(mark, Mark::Line { .. })).count();
    assert!(lines(&retired) >= lines(&idle) + 4, "a dashed outline");
}

#[test]
fn every_state_of_a_machine_has_its_own_shape_and_word() {
    let mut header = sample_runs::header(&[1.0; 4], 60);
    header.rules.strategy = Strategy::Adaptive;
    let draw = |spares, kinds: &[RecordKind]| {
        let mut state = RunState::new(&Header { spares, ..header.clone() });
        state.nodes[3].band_at = Some(Time::ZERO);
        kinds.iter().for_each(|kind| state.apply(&Record { at: Time::ZERO, kind: kind.clone() }));
        drawn(&state, &RingOverlay::default(), Time::ZERO, [640.0, 490.0])
    };
    let becomes = |condition| vec![RecordKind::Condition { node: 3, condition }];
    let seen = [
        ("idle", draw(0, &[])),
        ("asleep", draw(0, &[RecordKind::Retired { node: 3 }])),
        ("hung", draw(0, &becomes(Condition::Hung))),
        ("cut off", draw(0, &becomes(Condition::CutOff))),
        ("off", draw(0, &becomes(Condition::Off))),
        ("spare", draw(1, &[])),
    ];
    // Without colours and words.
    let shapes = |marks: &[Mark]| -> Vec<String> {
        let shape = |mark: &Mark| match mark {
            Mark::Label { text, .. } if text == "z" => Some(text.clone()),
            Mark::Label { .. } => None,
            Mark::Line { points, .. } => Some(format!("{points:?}")),
            Mark::Disc { centre, radius, .. } => Some(format!("{centre:?} {radius}")),
            other => Some(format!("{:?}", std::mem::discriminant(other))),
        };
        marks.iter().filter_map(shape).collect()
    };
    for (i, (word, marks)) in seen.iter().enumerate() {
        assert!(texts(marks).contains(word), "{word} {:?}", texts(marks));
        for (other, others) in &seen[..i] {
            assert!(shapes(marks) != shapes(others), "{word} looks like {other}");
        }
    }
}

#[test]
fn parcels_show_their_counts() {
    let header = sample_runs::header(&[1.0, 1.0, 0.1], 300);
    let mut state = RunState::new(&header);
    let mut seen = BTreeSet::new();
    for record in sample_runs::records(&header) {
        state.apply(&record);
        let marks = drawn(&state, &RingOverlay::default(), record.at, SIZE);
        seen.extend(texts(&marks).into_iter().filter(|text| text.starts_with('×')).map(str::to_owned));
    }
    assert!(seen.contains("×100"), "bands {seen:?}");
    assert!(seen.len() > 2, "transfers {seen:?}");
}

#[test]
fn result_replaces_the_parent() {
    let state = RunState::new(&sample_runs::header(&[1.0, 1.0], 30));
    let (makespan, ideal) = (Duration::from_millis(20_440), Duration::from_millis(19_890));
    let summary = Summary { makespan, ideal, efficiency: 0.973, spread: Duration::ZERO, disturbance: 0.0 };
    let marks =
        drawn(&state, &RingOverlay { summary: Some(summary), ..RingOverlay::default() }, Time::from_secs(21.0), SIZE);
    assert!(texts(&marks).contains(&"20.4 s") && texts(&marks).contains(&"97 %"));
}
