//! Messages of a farm: requests and the parts that answer them, on two sides of a spoke, and the queue at the parent.

use super::angles::ease;
use super::layers::{RingLayer, RingMarks};
use super::layout::RingLayout;
use crate::balance::{NodeId, Party};
use crate::time::Time;
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::run_state::RunState;
use crate::view::text::format::count;

/// Draws requests, parts, and the queue at the parent.
pub(crate) fn draw(layout: &RingLayout, state: &RunState, now: Time, marks: &mut RingMarks) {
    if state.opacity(now) == 0.0 {
        return;
    }
    let marks = marks.layer(RingLayer::FarmMessages);
    queue(layout, state, now, marks);
    for disc in discs(layout, state, now) {
        disc.draw(layout, marks);
    }
}

/// Finds the request or the part that is drawn at `point`, and its layer.
pub(crate) fn message_at<'a>(
    layout: &RingLayout,
    state: &'a RunState,
    now: Time,
    [x, y]: Point,
) -> Option<(RingLayer, &'a Flight)> {
    let covers = |disc: &FarmDisc<'_>| {
        let [u, v] = disc.centre;
        disc.flight.shown().contains(&now) && (x - u).abs() <= disc.half[0] && (y - v).abs() <= disc.half[1]
    };
    discs(layout, state, now).into_iter().rev().find(covers).map(|disc| (RingLayer::FarmMessages, disc.flight))
}

/// A request or its answer beside a spoke.
struct FarmDisc<'a> {
    flight: &'a Flight,
    node: NodeId,
    centre: Point,
    /// Half its width and height.
    half: Point,
    text: String,
    hue: Hue,
    alpha: f32,
}

/// In a larger farm, discs with text would cover each other.
const MAX_NODES_WITH_TEXT: usize = 12;

fn discs<'a>(layout: &RingLayout, state: &'a RunState, now: Time) -> Vec<FarmDisc<'a>> {
    let disc = |flight: &'a Flight| {
        let alpha = flight.opacity(now) * state.opacity(now);
        if flight.sent > now || !flight.shown().contains(&now) || alpha == 0.0 {
            return None;
        }
        let here = ease(flight.progress(now));
        let (node, text, hue, way, side) = match (flight.from, flight.to, &flight.cargo) {
            (Party::Node(node), _, Cargo::Request) => (node, "?".into(), Hue::Node(node), 1.0 - here, 1.0),
            // An empty part says that the parent has no more atoms.
            (_, Party::Node(node), Cargo::Part(part)) => {
                let hue = if part.is_empty() { Hue::Quiet } else { Hue::Node(node) };
                (node, format!("×{}", count(flight.cargo.atoms())), hue, here, -1.0)
            }
            _ => return None,
        };
        let has_text = layout.nodes <= MAX_NODES_WITH_TEXT;
        let letters = text.chars().count();
        let size = part_text_size(layout);
        let half = match &flight.cargo {
            Cargo::Request => [request_radius(layout); 2],
            _ if has_text => [size.width(letters) / 2.0 + 3.0, size.line() / 2.0],
            _ => [0.16 * layout.node_radius; 2],
        };
        let centre = beside_spoke(layout, node, way, half, side);
        let text = if has_text { text } else { String::new() };
        Some(FarmDisc { flight, node, centre, half, text, hue, alpha })
    };
    state.flights().iter().filter_map(disc).collect()
}

impl FarmDisc<'_> {
    fn draw(&self, layout: &RingLayout, marks: &mut Vec<Mark>) {
        let (centre, alpha, [width, height]) = (self.centre, self.alpha, self.half);
        let is_request = self.flight.cargo == Cargo::Request;
        let round = if is_request { width } else { 4.0 };
        let half = [width + 1.5, height + 1.5];
        marks.push(Mark::Box { centre, half, round: round + 1.5, ink: Hue::Ground.faint(alpha) });
        marks.push(Mark::Box { centre, half: self.half, round, ink: self.hue.faint(alpha) });
        let hue = if self.hue == Hue::Quiet { Hue::Ground } else { Hue::OnNode(self.node) };
        if !self.text.is_empty() {
            let size = if is_request { TextSize::Fit(1.5 * width) } else { part_text_size(layout) };
            let text = self.text.clone();
            marks.push(Mark::Label { at: centre, anchor: Anchor::Centre, text, size, ink: hue.faint(alpha) });
        }
    }
}

/// Draws the messages that wait at the parent as dots, each on its sender's spoke.
fn queue(layout: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>) {
    /// More dots would reach the node.
    const MAX_DOTS: usize = 6;
    let mut lengths = vec![0; layout.nodes];
    for flight in state.in_line(now) {
        let Party::Node(node) = flight.from else { continue };
        let Some(before) = lengths.get_mut(usize::from(node)) else { continue };
        if *before == MAX_DOTS {
            continue;
        }
        let (dot, large) = (dot_radius(layout), request_radius(layout));
        let radius = layout.parent_radius + large + *before as f32 * 2.4 * dot;
        let (centre, ink) = (layout.at(layout.angle(node), radius), Hue::Node(node).full());
        marks.push(Mark::Disc { centre, radius: dot + 1.0, ink: Hue::Ground.full() });
        marks.push(Mark::Disc { centre, radius: dot, ink });
        *before += 1;
    }
}

/// Returns the radius of a message in the queue.
fn dot_radius(layout: &RingLayout) -> f32 {
    (layout.rail_radius * 0.016).clamp(1.5, 4.0)
}

/// Returns the text size of a part: as labels, but smaller where it would cover the nodes of a small ring.
fn part_text_size(layout: &RingLayout) -> TextSize {
    TextSize::Fit((TextSize::SMALL * layout.labels.text_scale).min(0.6 * layout.node_radius))
}

/// Returns the radius of a request.
fn request_radius(layout: &RingLayout) -> f32 {
    (layout.node_radius * 0.3).clamp(2.5, 9.0)
}

/// Returns the centre of a box beside the spoke of `node`: `way` is 0 at the parent and 1 at the node, `side` is 1 or
/// -1.
fn beside_spoke(layout: &RingLayout, node: NodeId, way: f32, [width, height]: Point, side: f32) -> Point {
    let angle = layout.angle(node);
    let (cos, sin) = (angle.cos().abs(), angle.sin().abs());
    let along = width * cos + height * sin;
    let (start, end) = (layout.parent_radius + along, layout.seat_radius - layout.node_reach() - along);
    // Results move on the spoke itself.
    let apart = (dot_radius(layout) + 2.0 + width * sin + height * cos) * side;
    let [x, y] = layout.at(angle, start + (end - start) * way);
    [x - apart * angle.sin(), y + apart * angle.cos()]
}

#[cfg(test)]
mod tests {
    use crate::language::Language;
    use std::collections::BTreeSet;
    use std::time::Duration;

    use super::super::{RingOverlay, message_at as topmost_at, ring};
    use super::*;
    use crate::balance::{Rules, Strategy};
    use crate::runlog::Header;
    use crate::view::state::node_state::Activity;
    use crate::view::tests::sample_runs;
    use crate::view::text::tooltips::flight_words;

    const SIZE: Point = [520.0, 480.0];

    /// A run by `strategy` whose parent needs `handling` milliseconds for a message.
    fn header(strategy: Strategy, speeds: &[f64], handling: u64) -> Header {
        let plain = sample_runs::header(speeds, 240);
        let rules = Rules {
            strategy: strategy.clone(),
            part: strategy.usual_part(plain.division, speeds.len()).max(3),
            ..plain.rules
        };
        Header { rules, handling: Duration::from_millis(handling), ..plain }
    }

    /// Calls `see` with the state of a run after each record.
    fn for_each_record(header: &Header, mut see: impl FnMut(&RunState, Time)) {
        let mut state = RunState::new(header);
        for record in sample_runs::records(header) {
            state.apply(&record);
            see(&state, record.at);
        }
    }

    fn texts(state: &RunState, now: Time, size: Point, language: Language) -> Vec<String> {
        let layout = RingLayout::new(state.nodes().len(), size, language);
        let marks = ring(&layout, state, &RingOverlay::default(), now, language);
        marks
            .into_iter()
            .filter_map(|mark| if let Mark::Label { text, .. } = mark { Some(text) } else { None })
            .collect()
    }

    #[test]
    fn only_farms_draw_requests_and_parts() {
        let language = Language::English;
        for (strategy, is_farm) in [(Strategy::Farm, true), (Strategy::Static, false), (Strategy::Ring, false)] {
            let mut seen = BTreeSet::new();
            for_each_record(&header(strategy.clone(), &[1.0, 1.0, 0.2], 0), |state, now| {
                seen.extend(texts(state, now, SIZE, language))
            });
            for text in ["?", "×5", "×0"] {
                assert_eq!(seen.contains(text), is_farm, "{text} {strategy} {seen:?}");
            }
        }
    }

    #[test]
    fn message_under_pointer_has_words() {
        let language = Language::English;
        let mut words_seen = BTreeSet::new();
        for_each_record(&header(Strategy::Farm, &[1.0, 1.0, 0.2], 0), |state, now| {
            let layout = RingLayout::new(3, SIZE, language);
            for disc in discs(&layout, state, now) {
                words_seen
                    .extend(topmost_at(&layout, state, now, disc.centre).map(|flight| flight_words(flight, language)));
            }
        });
        for words in
            ["1 asks the parent for atoms", "5 atoms for 2, which asked for them", "the parent has no more atoms for 1"]
        {
            assert!(words_seen.contains(words), "{words} {words_seen:?}");
        }
    }

    #[test]
    fn queue_at_slow_parent_is_counted_and_drawn() {
        let language = Language::English;
        let (mut most, mut said, mut activities) = (0, BTreeSet::new(), BTreeSet::new());
        for_each_record(&header(Strategy::Farm, &[1.0; 8], 20), |state, now| {
            let waiting = state.line_length(now);
            most = most.max(waiting);
            let drawn = texts(state, now, [640.0, 490.0], language);
            assert_eq!(drawn.iter().any(|text| *text == format!("{waiting} waiting")), waiting > 1, "{drawn:?}");
            said.extend(drawn);
            activities.extend((0..8).map(|node| format!("{:?}", state.activity(node, now))));
        });
        assert!(most >= 8, "{most} waited at most");
        assert!(said.contains("in line") && said.contains("no more"), "{said:?}");
        for activity in [Activity::Asking, Activity::InLine, Activity::Receiving, Activity::NoMore] {
            assert!(activities.contains(&format!("{activity:?}")), "{activity:?} {activities:?}");
        }
        // A parent that needs no time has no queue.
        for_each_record(&header(Strategy::Farm, &[1.0; 8], 0), |state, now| assert_eq!(state.line_length(now), 0));
    }

    #[test]
    fn discs_stay_inside_at_every_size() {
        let language = Language::English;
        for (nodes, size) in [(1, [240.0, 240.0]), (8, SIZE), (8, [380.0, 260.0]), (32, [640.0, 400.0])] {
            for_each_record(&header(Strategy::FarmBySpeed, &vec![1.0; nodes], 5), |state, now| {
                let (layout, inside) =
                    (RingLayout::new(nodes, size, language), |at: f32, most: f32| (0.0..=most).contains(&at));
                for FarmDisc { centre: [x, y], half: [w, h], .. } in discs(&layout, state, now) {
                    assert!(inside(x - w, size[0]) && inside(x + w, size[0]), "{x} {w}");
                    assert!(inside(y - h, size[1]) && inside(y + h, size[1]), "{y} {h}");
                }
            });
        }
    }

    #[test]
    fn estimating_parent_has_caption() {
        let language = Language::English;
        let mut said = Vec::new();
        for_each_record(&header(Strategy::StaticEstimate, &[1.0; 3], 0), |state, now| {
            said.push(texts(state, now, SIZE, language).contains(&"estimating".to_owned()));
        });
        said.dedup();
        assert_eq!(said, [true, false]);
    }
}
