//! What moves between the nodes of a farm and their parent, each on its own side of the spoke: requests, and the parts
//! that answer them; and what has arrived at the parent and waits there.

use super::angles::ease;
use super::layout::RingLayout;
use crate::balance::{NodeId, Party};
use crate::time::Time;
use crate::view::draw::display_list::{Anchor, Hue, Mark, Point, TextSize};
use crate::view::state::flight::{Cargo, Flight};
use crate::view::state::run_state::RunState;
use crate::view::text::format::count;

/// Draws requests, parts, and the line at the parent.
pub(crate) fn draw(plan: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>) {
    if state.opacity(now) == 0.0 {
        return;
    }
    line(plan, state, now, marks);
    for token in tokens(plan, state, now) {
        token.draw(plan, marks);
    }
}

/// The request or the part that is drawn at `point`.
pub(crate) fn token_at<'a>(plan: &RingLayout, state: &'a RunState, now: Time, [x, y]: Point) -> Option<&'a Flight> {
    let covers = |token: &FarmDisc<'_>| {
        let [u, v] = token.centre;
        token.flight.shown().contains(&now) && (x - u).abs() <= token.half[0] && (y - v).abs() <= token.half[1]
    };
    tokens(plan, state, now).into_iter().rev().find(covers).map(|token| token.flight)
}

/// What lies on a spoke of the parent: a request, or its answer.
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

/// In so large a farm tokens would hide each other if they bore words.
const WORDED: usize = 12;

fn tokens<'a>(plan: &RingLayout, state: &'a RunState, now: Time) -> Vec<FarmDisc<'a>> {
    let token = |flight: &'a Flight| {
        let alpha = flight.opacity(now) * state.opacity(now);
        if flight.sent > now || !flight.shown().contains(&now) || alpha == 0.0 {
            return None;
        }
        let here = ease(flight.progress(now));
        let (node, text, hue, way, side) = match (flight.from, flight.to, &flight.cargo) {
            (Party::Node(node), _, Cargo::Request) => (node, "?".into(), Hue::Node(node), 1.0 - here, 1.0),
            // An empty one says that there are no more.
            (_, Party::Node(node), Cargo::Part(part)) => {
                let hue = if part.is_empty() { Hue::Quiet } else { Hue::Node(node) };
                (node, format!("×{}", count(flight.cargo.atoms())), hue, here, -1.0)
            }
            _ => return None,
        };
        let is_worded = plan.nodes <= WORDED;
        let letters = text.chars().count();
        let size = part(plan);
        let half = match &flight.cargo {
            Cargo::Request => [request(plan); 2],
            _ if is_worded => [size.width(letters) / 2.0 + 3.0, size.line() / 2.0],
            _ => [0.16 * plan.node; 2],
        };
        let centre = beside(plan, node, way, half, side);
        let text = if is_worded { text } else { String::new() };
        Some(FarmDisc { flight, node, centre, half, text, hue, alpha })
    };
    state.flights().iter().filter_map(token).collect()
}

impl FarmDisc<'_> {
    fn draw(&self, plan: &RingLayout, marks: &mut Vec<Mark>) {
        let (centre, alpha, [width, height]) = (self.centre, self.alpha, self.half);
        let is_request = self.flight.cargo == Cargo::Request;
        let round = if is_request { width } else { 4.0 };
        let half = [width + 1.5, height + 1.5];
        marks.push(Mark::Box { centre, half, round: round + 1.5, ink: Hue::Ground.faint(alpha) });
        marks.push(Mark::Box { centre, half: self.half, round, ink: self.hue.faint(alpha) });
        let hue = if self.hue == Hue::Quiet { Hue::Ground } else { Hue::OnNode(self.node) };
        if !self.text.is_empty() {
            let size = if is_request { TextSize::Fit(1.5 * width) } else { part(plan) };
            let text = self.text.clone();
            marks.push(Mark::Label { at: centre, anchor: Anchor::Centre, text, size, ink: hue.faint(alpha) });
        }
    }
}

/// What waits at the parent stands in line before it, each message on its sender's spoke.
fn line(plan: &RingLayout, state: &RunState, now: Time, marks: &mut Vec<Mark>) {
    /// More than that would reach the node.
    const MOST: usize = 6;
    let mut lengths = vec![0; plan.nodes];
    for flight in state.in_line(now) {
        let Party::Node(node) = flight.from else { continue };
        let Some(before) = lengths.get_mut(usize::from(node)) else { continue };
        if *before == MOST {
            continue;
        }
        let (dot, large) = (dot(plan), request(plan));
        let radius = plan.parent + large + *before as f32 * 2.4 * dot;
        let (centre, ink) = (plan.at(plan.angle(node), radius), Hue::Node(node).full());
        marks.push(Mark::Disc { centre, radius: dot + 1.0, ink: Hue::Ground.full() });
        marks.push(Mark::Disc { centre, radius: dot, ink });
        *before += 1;
    }
}

/// Radius of a message in line.
fn dot(plan: &RingLayout) -> f32 {
    (plan.rail * 0.016).clamp(1.5, 4.0)
}

/// The text of a part: that of labels, unless it would hide the nodes of a small ring.
fn part(plan: &RingLayout) -> TextSize {
    TextSize::Fit((TextSize::SMALL * plan.labels.text).min(0.6 * plan.node))
}

/// Radius of a request.
fn request(plan: &RingLayout) -> f32 {
    (plan.node * 0.3).clamp(2.5, 9.0)
}

/// The middle of a box beside the spoke of `node`, `way` of the way from the parent to it; `side` says on which side.
fn beside(plan: &RingLayout, node: NodeId, way: f32, [width, height]: Point, side: f32) -> Point {
    let angle = plan.angle(node);
    let (cos, sin) = (angle.cos().abs(), angle.sin().abs());
    let along = width * cos + height * sin;
    let (start, end) = (plan.parent + along, plan.seats - plan.reach() - along);
    // Results run on the spoke itself.
    let apart = (dot(plan) + 2.0 + width * sin + height * cos) * side;
    let [x, y] = plan.at(angle, start + (end - start) * way);
    [x - apart * angle.sin(), y + apart * angle.cos()]
}

#[cfg(test)]
mod tests {
    use crate::language::Language;
    use std::collections::BTreeSet;
    use std::time::Duration;

    use super::super::{RingOverlay, message_at, ring};
    use super::*;
    use crate::balance::{Rules, Strategy};
    use crate::runlog::Header;
    use crate::view::state::node_state::Activity;
    use crate::view::tests::sample_runs;
    use crate::view::text::tooltips::flight_words;

    const SIZE: Point = [520.0, 480.0];

    /// A run by this strategy whose parent takes so many milliseconds for a message.
    fn header(strategy: Strategy, speeds: &[f64], handling: u64) -> Header {
        let plain = sample_runs::header(speeds, 240);
        let rules = Rules { strategy, part: strategy.usual_part(plain.division, speeds.len()).max(3), ..plain.rules };
        Header { rules, handling: Duration::from_millis(handling), ..plain }
    }

    /// Every state of a run at the times of its records.
    fn moments(header: &Header, mut see: impl FnMut(&RunState, Time)) {
        let mut state = RunState::new(header);
        for record in sample_runs::records(header) {
            state.apply(&record);
            see(&state, record.at);
        }
    }

    fn texts(state: &RunState, now: Time, size: Point, language: Language) -> Vec<String> {
        let marks = ring(state, &RingOverlay::default(), now, size, language);
        marks
            .into_iter()
            .filter_map(|mark| if let Mark::Label { text, .. } = mark { Some(text) } else { None })
            .collect()
    }

    #[test]
    fn requests_parts_and_their_end_are_drawn_in_a_farm_and_nowhere_else() {
        let language = Language::English;
        for (strategy, is_farm) in [(Strategy::Farm, true), (Strategy::Static, false), (Strategy::Ring, false)] {
            let mut seen = BTreeSet::new();
            moments(&header(strategy, &[1.0, 1.0, 0.2], 0), |state, now| {
                seen.extend(texts(state, now, SIZE, language))
            });
            for text in ["?", "×5", "×0"] {
                assert_eq!(seen.contains(text), is_farm, "{text} {strategy} {seen:?}");
            }
        }
    }

    #[test]
    fn what_is_pointed_at_is_told() {
        let language = Language::English;
        let mut told = BTreeSet::new();
        moments(&header(Strategy::Farm, &[1.0, 1.0, 0.2], 0), |state, now| {
            let plan = RingLayout::new(3, SIZE, language);
            for token in tokens(&plan, state, now) {
                told.extend(
                    message_at(state, now, SIZE, token.centre, language).map(|flight| flight_words(flight, language)),
                );
            }
        });
        for words in
            ["1 asks the parent for atoms", "5 atoms for 2, which asked for them", "the parent has no more atoms for 1"]
        {
            assert!(told.contains(words), "{words} {told:?}");
        }
    }

    #[test]
    fn what_waits_at_a_slow_parent_is_counted_and_drawn() {
        let language = Language::English;
        let (mut most, mut said, mut activities) = (0, BTreeSet::new(), BTreeSet::new());
        moments(&header(Strategy::Farm, &[1.0; 8], 20), |state, now| {
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
        // A parent that takes no time has no line.
        moments(&header(Strategy::Farm, &[1.0; 8], 0), |state, now| assert_eq!(state.line_length(now), 0));
    }

    #[test]
    fn everything_stays_inside_whatever_the_size() {
        let language = Language::English;
        for (nodes, size) in [(1, [240.0, 240.0]), (8, SIZE), (8, [380.0, 260.0]), (32, [640.0, 400.0])] {
            moments(&header(Strategy::FarmBySpeed, &vec![1.0; nodes], 5), |state, now| {
                let (plan, inside) =
                    (RingLayout::new(nodes, size, language), |at: f32, most: f32| (0.0..=most).contains(&at));
                for FarmDisc { centre: [x, y], half: [w, h], .. } in tokens(&plan, state, now) {
                    assert!(inside(x - w, size[0]) && inside(x + w, size[0]), "{x} {w}");
                    assert!(inside(y - h, size[1]) && inside(y + h, size[1]), "{y} {h}");
                }
            });
        }
    }

    #[test]
    fn a_parent_that_estimates_says_so() {
        let language = Language::English;
        let mut said = Vec::new();
        moments(&header(Strategy::StaticEstimate, &[1.0; 3], 0), |state, now| {
            said.push(texts(state, now, SIZE, language).contains(&"estimating".to_owned()));
        });
        said.dedup();
        assert_eq!(said, [true, false]);
    }
}
