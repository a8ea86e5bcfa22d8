//! The ring as a display list: nodes on a circle, offers on a rail round it, transfers across, the parent within.
//!
//! Numbers rise clockwise from the top, so an offer, which goes to the left neighbour, always runs anticlockwise:
//! at the top of the ring to the left.

mod angles;
mod centre;
mod condition_badge;
mod farm_messages;
mod label_text;
pub(crate) mod labels;
mod layout;
mod lost_messages;
mod machine;
mod messages;

use std::f32::consts::TAU;

use super::analysis::summary::Summary;
use super::draw::display_list::{Hue, Mark, Point};
use super::state::flight::Flight;
use super::state::run_state::RunState;
use super::state::scheduler::Sharing;
use crate::balance::NodeId;
use crate::language::Language;
use crate::time::Time;
use angles::arc;
use label_text::{is_labelled, label};
use layout::RingLayout;
use machine::machine;

/// What is laid over the ring.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RingOverlay {
    /// The result, which takes the centre.
    pub outcome: Option<Summary>,
    /// The node that is marked.
    pub selected: Option<NodeId>,
    /// Nodes that stand out.
    pub lit: Vec<NodeId>,
    /// A message that stands out.
    pub message: Option<u64>,
}

/// What can be pointed at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RingSpot {
    /// A node, with its progress arc.
    Node(NodeId),
    /// The parent in the centre.
    Parent,
}

/// The ring at `now`, for an area of `size` whose corner is at 0, 0; the text sizes are taken to be in its units.
pub fn ring(state: &RunState, overlay: &RingOverlay, now: Time, size: Point, language: Language) -> Vec<Mark> {
    let plan = RingLayout::new(state.nodes().len(), size, language);
    let mut marks = Vec::new();
    if state.sharing.is_ring() {
        rail(&plan, &mut marks);
    }
    if state.sharing != Sharing::Stealing {
        spokes(&plan, state.sharing.is_farm(), &mut marks);
    }
    messages::results(&plan, state, now, &mut marks);
    messages::offers(&plan, state, now, overlay.message, &mut marks);
    for node in 0..state.nodes().len() as NodeId {
        let of = &*state.node_as_drawn(node, now);
        let (activity, is_selected) = (state.activity(node, now), overlay.selected == Some(node));
        machine(&plan, (node, of), activity, is_selected || overlay.lit.contains(&node), &mut marks);
        if is_labelled(&plan, is_selected) {
            label(&plan, state, (node, of), activity, now, &mut marks, language);
        }
    }
    match overlay.outcome {
        Some(outcome) => centre::result(&plan, &outcome, &mut marks, language),
        None => centre::parent(&plan, state, now, &mut marks, language),
    }
    farm_messages::draw(&plan, state, now, &mut marks);
    lost_messages::sparks(&plan, state, now, &mut marks);
    messages::parcels(&plan, state, now, overlay.message, &mut marks);
    lost_messages::crosses(&plan, state, now, &mut marks);
    marks
}

/// What of a ring of `nodes` in an area of `size` is at `point`.
pub fn ring_at(nodes: usize, size: Point, point: Point, language: Language) -> Option<RingSpot> {
    let plan = RingLayout::new(nodes, size, language);
    let from = |[x, y]: Point| (point[0] - x).hypot(point[1] - y);
    let away = |node: &NodeId| from(plan.seat(*node));
    let nearest = (0..nodes as NodeId).min_by(|one, other| away(one).total_cmp(&away(other)));
    match nearest {
        Some(node) if away(&node) <= plan.reach() => Some(RingSpot::Node(node)),
        _ => (from(plan.centre) <= plan.parent).then_some(RingSpot::Parent),
    }
}

/// The message that is drawn at `point` at `now`, in an area of `size`: atoms, an offer, a request, or its answer.
pub fn message_at(state: &RunState, now: Time, size: Point, point: Point, language: Language) -> Option<&Flight> {
    let plan = RingLayout::new(state.nodes().len(), size, language);
    messages::parcel_at(&plan, state, now, point)
        .or_else(|| farm_messages::token_at(&plan, state, now, point))
        .or_else(|| messages::offer_at(&plan, state, now, point))
}

/// Arrowheads on the rail, and spokes.
const MOST_LINES: usize = 64;

fn rail(plan: &RingLayout, marks: &mut Vec<Mark>) {
    let ink = Hue::Hairline.full();
    marks.push(Mark::Line { points: arc(plan.centre, plan.rail, 0.0, TAU), width: 1.5, ink });
    // Arrowheads half-way between neighbours say which way offers go.
    let wing = (plan.rail * 0.022).clamp(3.0, 8.0);
    // As many as can be told apart.
    for node in (0..plan.nodes).step_by(plan.nodes.div_ceil(MOST_LINES)) {
        let angle = plan.angle(node as NodeId) - plan.step() / 2.0;
        let back = wing / plan.rail;
        let points = vec![
            plan.at(angle + back, plan.rail - wing),
            plan.at(angle - back * 0.2, plan.rail),
            plan.at(angle + back, plan.rail + wing),
        ];
        marks.push(Mark::Line { points, width: 1.5, ink: Hue::Quiet.faint(0.7) });
    }
}

/// The ways between parent and nodes; in a farm, where everything goes that way, they are `strong`.
fn spokes(plan: &RingLayout, strong: bool, marks: &mut Vec<Mark>) {
    let (width, ink) = if strong { (1.5, Hue::Hairline.full()) } else { (1.0, Hue::Hairline.faint(0.7)) };
    for node in (0..plan.nodes).step_by(plan.nodes.div_ceil(MOST_LINES)) {
        let angle = plan.angle(node as NodeId);
        let (inner, outer) = (plan.at(angle, plan.parent), plan.at(angle, plan.seats - plan.node * 1.3));
        marks.push(Mark::Line { points: vec![inner, outer], width, ink });
    }
}

#[cfg(test)]
mod tests {
    use std::cmp::Ordering;
    use std::collections::BTreeSet;
    use std::time::Duration;

    use proptest::prelude::*;

    use super::super::draw::display_list::{Ink, TextSize};
    use super::super::state::flight::Cargo;
    use super::super::tests::sample_runs;
    use super::*;
    use crate::balance::{Condition, Strategy};
    use crate::record::{Record, RecordKind};
    use crate::runlog::Header;

    const SIZE: Point = [520.0, 480.0];

    /// The corners of what holds a mark.
    fn places(mark: &Mark) -> Vec<Point> {
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

    /// Left, top, right and bottom of a label.
    fn extent(mark: &Mark) -> Option<[f32; 4]> {
        let Mark::Label { at: [x, y], anchor, text, size, .. } = mark else { return None };
        let (width, half) = (size.width(text.chars().count()), size.line() / 2.0);
        let left = anchor.left(*x, width);
        Some([left, y - half, left + width, y + half])
    }

    /// The labels beside the rail, not those on nodes, offers or parcels.
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

    /// A ring of these speeds after a part of its records, with its first node paused.
    fn moment(speeds: &[f64], part: f64) -> (RunState, Time) {
        let header = sample_runs::header(speeds, 60);
        let (records, mut state) = (sample_runs::records(&header), RunState::new(&header));
        let count = (records.len() as f64 * part) as usize;
        records[..count].iter().for_each(|record| state.apply(record));
        let now = state.head();
        state.apply(&Record { at: now, what: RecordKind::Paused { node: 0 } });
        (state, now)
    }

    proptest! {
        #[test]
        fn everything_stays_inside(
            speeds in prop::collection::vec(0.05..1.0f64, 1..33), part in 0.0..1.0f64, selected in 0..33u16,
            width in 240.0..1000.0f32, height in 240.0..1000.0f32,
        ) {
        let language = Language::English;
            let (state, now) = moment(&speeds, part);
            for later in 0..8 {
                let overlay = RingOverlay { selected: Some(selected), ..RingOverlay::default() };
                let now = now + Duration::from_millis(150 * later);
                for point in ring(&state, &overlay, now, [width, height], language).iter().flat_map(places) {
                    prop_assert!((0.0..=width).contains(&point[0]) && (0.0..=height).contains(&point[1]), "{point:?}");
                }
            }
        }

        #[test]
        fn labels_touch_neither_each_other_nor_the_rail(
            speeds in prop::collection::vec(0.05..1.0f64, 1..33), part in 0.0..1.0f64, selected in 0..33u16,
            width in 240.0..1000.0f32, height in 240.0..1000.0f32,
        ) {
        let language = Language::English;
            let (state, now) = moment(&speeds, part);
            let selected = selected % speeds.len() as u16;
            let overlay = RingOverlay { selected: Some(selected), ..RingOverlay::default() };
            let plan = RingLayout::new(speeds.len(), [width, height], language);
            let [x, y] = plan.centre;
            let nearest = |[left, top, right, bottom]: [f32; 4]| {
                (left - x).max(x - right).max(0.0).hypot((top - y).max(y - bottom).max(0.0))
            };
            let mut labels = labels(&ring(&state, &overlay, now, [width, height], language));
            // What stands in the centre.
            labels.retain(|&label| nearest(label) > plan.parent);
            let least = if speeds.len() <= 16 { speeds.len() } else { 1 };
            prop_assert!(labels.len() >= least, "{labels:?}");
            prop_assert!(labels.len() <= 2 * speeds.len().min(16));
            for (i, one) in labels.iter().enumerate() {
                prop_assert!(nearest(*one) > plan.rail + 9.0, "{one:?} lies on the rail");
                for other in &labels[..i] {
                    let apart = [one[0] - other[2], other[0] - one[2], one[1] - other[3], other[1] - one[3]];
                    let apart = apart.into_iter().fold(f32::NEG_INFINITY, f32::max);
                    prop_assert!(apart > -0.01, "{one:?} and {other:?} overlap by {apart}");
                }
            }
        }

        #[test]
        fn whatever_is_pointed_at_is_found(nodes in 1..33usize, width in 240.0..1000.0f32, height in 240.0..1000.0f32) {
        let language = Language::English;
            let (size, plan) = ([width, height], RingLayout::new(nodes, [width, height], language));
            for node in 0..nodes as NodeId {
                prop_assert_eq!(ring_at(nodes, size, plan.seat(node), language), Some(RingSpot::Node(node)));
            }
            prop_assert_eq!(ring_at(nodes, size, plan.centre, language), Some(RingSpot::Parent));
            prop_assert_eq!(ring_at(nodes, size, [1.0, 1.0], language), None);
            prop_assert_eq!(ring_at(nodes, size, plan.at(0.3, plan.interior() * 0.9), language), None);
        }
    }

    #[test]
    fn a_parcel_is_found_where_it_is_drawn() {
        let language = Language::English;
        let (state, now) = moment(&[1.0, 1.0, 0.1], 0.7);
        let marks = ring(&state, &RingOverlay::default(), now, SIZE, language);
        let label = |mark: &Mark| match mark {
            Mark::Label { at, text, .. } if text.starts_with('×') => Some((*at, text.clone())),
            _ => None,
        };
        let (at, text) = marks.iter().rev().find_map(label).expect("a parcel");
        let flight = message_at(&state, now, SIZE, at, language).expect("the parcel");
        assert_eq!(text, format!("×{}", flight.cargo.atoms()));
        assert_eq!(message_at(&state, now, SIZE, [1.0, 1.0], language), None);
    }

    #[test]
    fn an_offer_is_found_where_its_token_runs() {
        let language = Language::English;
        let found = |part: u32| {
            let (state, now) = moment(&[1.0, 1.0, 0.1], f64::from(part) / 20.0);
            let offer = |mark: &Mark| {
                let Mark::Label { at, ink: Ink { hue: Hue::OnNode(who), .. }, .. } = *mark else { return false };
                message_at(&state, now, SIZE, at, language).is_some_and(|flight| flight.cargo == Cargo::Offer { who })
            };
            ring(&state, &RingOverlay::default(), now, SIZE, language).iter().any(offer)
        };
        assert!((1..20).any(found));
    }

    #[test]
    fn a_pause_the_selection_and_the_pipe_are_seen() {
        let language = Language::English;
        let (mut state, now) = moment(&[1.0, 1.0, 0.1], 0.4);
        // The bands have left each other by then, and so have their counts.
        let now = now + Duration::from_millis(400);
        // Slots are as high as wide, bars higher, parcels wider.
        let boxes = |marks: &[Mark], shape: Ordering| {
            let has = |mark: &&Mark| matches!(mark, Mark::Box { half: [w, h], .. } if h.total_cmp(w) == shape);
            marks.iter().filter(has).count()
        };
        let draw = |state: &RunState, selected| {
            ring(state, &RingOverlay { selected, ..RingOverlay::default() }, now, [640.0, 490.0], language)
        };
        let paused = draw(&state, None);
        assert!(texts(&paused).contains(&"paused"));
        assert_eq!(draw(&state, Some(1)).len(), paused.len() + 1);
        state.apply(&Record { at: now, what: RecordKind::Resumed { node: 0 } });
        let going = draw(&state, None);
        assert!(!texts(&going).contains(&"paused"));
        assert_eq!([boxes(&paused, Ordering::Greater), boxes(&going, Ordering::Greater)], [2, 0], "bars");
        assert_eq!([boxes(&paused, Ordering::Equal), boxes(&going, Ordering::Equal)], [6, 6], "slots");
        let small = ring(&state, &RingOverlay::default(), now, [240.0, 240.0], language);
        assert_eq!(boxes(&small, Ordering::Equal), 0, "too small to be seen");
    }

    #[test]
    fn who_has_retired_looks_unlike_who_is_idle() {
        let language = Language::English;
        let mut state = RunState::new(&sample_runs::header(&[1.0, 1.0], 60));
        state.nodes[0].band_at = Some(Time::ZERO);
        let draw = |state: &RunState| ring(state, &RingOverlay::default(), Time::ZERO, SIZE, language);
        let idle = draw(&state);
        state.nodes[0].retired = true;
        let retired = draw(&state);
        assert!(texts(&idle).contains(&"idle") && texts(&retired).contains(&"retired"));
        let lines = |marks: &[Mark]| marks.iter().filter(|mark| matches!(mark, Mark::Line { .. })).count();
        assert!(lines(&retired) >= lines(&idle) + 4, "a broken outline");
    }

    #[test]
    fn every_state_of_a_machine_has_a_sign_and_a_word_of_its_own() {
        let language = Language::English;
        let mut header = sample_runs::header(&[1.0; 4], 60);
        header.rules.strategy = Strategy::Adaptive;
        let draw = |spares, whats: &[RecordKind]| {
            let mut state = RunState::new(&Header { spares, ..header.clone() });
            state.nodes[3].band_at = Some(Time::ZERO);
            whats.iter().for_each(|what| state.apply(&Record { at: Time::ZERO, what: what.clone() }));
            ring(&state, &RingOverlay::default(), Time::ZERO, [640.0, 490.0], language)
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
        let language = Language::English;
        let header = sample_runs::header(&[1.0, 1.0, 0.1], 300);
        let mut state = RunState::new(&header);
        let mut seen = BTreeSet::new();
        for record in sample_runs::records(&header) {
            state.apply(&record);
            let marks = ring(&state, &RingOverlay::default(), record.at, SIZE, language);
            seen.extend(texts(&marks).into_iter().filter(|text| text.starts_with('×')).map(str::to_owned));
        }
        assert!(seen.contains("×100"), "bands {seen:?}");
        assert!(seen.len() > 2, "transfers {seen:?}");
    }

    #[test]
    fn the_result_takes_the_centre() {
        let language = Language::English;
        let state = RunState::new(&sample_runs::header(&[1.0, 1.0], 30));
        let (makespan, ideal) = (Duration::from_millis(20_440), Duration::from_millis(19_890));
        let outcome = Summary { makespan, ideal, efficiency: 0.973, spread: Duration::ZERO };
        let marks = ring(
            &state,
            &RingOverlay { outcome: Some(outcome), ..RingOverlay::default() },
            Time::from_secs(21.0),
            SIZE,
            language,
        );
        assert!(texts(&marks).contains(&"20.4 s") && texts(&marks).contains(&"97 %"));
    }
}
