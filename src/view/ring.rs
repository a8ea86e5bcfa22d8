//! The ring as a display list: nodes on a circle, offers on a rail round it, transfers across, the parent within.
//!
//! Numbers rise clockwise from the top, so an offer, which goes to the left neighbour, always runs anticlockwise:
//! at the top of the ring to the left.

use std::f32::consts::{PI, TAU};

use super::display::{Anchor, Hue, Mark, Point, TextSize};
use super::node::{Activity, NodeState};
use super::outcome::Outcome;
use super::plan::Plan;
use super::state::RunState;
use super::traffic;
use super::words::{activity_word, count, node_name, percent};
use crate::balance::NodeId;
use crate::time::Time;

/// Beyond this many the labels would run into each other; the rows have the numbers.
const LABELLED: usize = 16;

/// The ring at `now`, for an area of `size` whose corner is at 0, 0; the text sizes are taken to be in its units.
pub fn ring(state: &RunState, outcome: Option<Outcome>, now: Time, size: Point) -> Vec<Mark> {
    let plan = Plan::new(state.nodes().len(), size);
    let mut marks = Vec::new();
    rail(&plan, &mut marks);
    spokes(&plan, &mut marks);
    traffic::results(&plan, state, now, &mut marks);
    traffic::offers(&plan, state, now, &mut marks);
    for (node, of) in (0..).zip(state.nodes()) {
        let activity = state.activity(node, now);
        draw_node(&plan, node, of, activity, &mut marks);
        if plan.nodes <= LABELLED && !plan.tiny {
            let words = words(state, of, activity);
            label(&plan, plan.angle(node), words, activity, &mut marks);
        }
    }
    centre(&plan, state, outcome, &mut marks);
    traffic::parcels(&plan, state, now, &mut marks);
    marks
}

fn rail(plan: &Plan, marks: &mut Vec<Mark>) {
    let ink = Hue::Hairline.full();
    marks.push(Mark::Line { points: Plan::arc(plan.centre, plan.rail, 0.0, TAU), width: 1.5, ink });
    // Arrowheads half-way between neighbours say which way offers go.
    let wing = (plan.rail * 0.022).clamp(3.0, 8.0);
    for node in 0..plan.nodes {
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

/// The ways between parent and nodes.
fn spokes(plan: &Plan, marks: &mut Vec<Mark>) {
    for node in 0..plan.nodes {
        let angle = plan.angle(node as NodeId);
        let (inner, outer) = (plan.at(angle, plan.parent), plan.at(angle, plan.seats - plan.node * 1.3));
        marks.push(Mark::Line { points: vec![inner, outer], width: 1.0, ink: Hue::Hairline.faint(0.7) });
    }
}

/// A machine is as large as its speed; its arc says how much of its work is done.
fn draw_node(plan: &Plan, node: NodeId, of: &NodeState, activity: Activity, marks: &mut Vec<Mark>) {
    let centre = plan.seat(node);
    let colour = Hue::Node(node);
    let track = plan.node * 1.2;
    let width = (plan.node * 0.13).max(2.0);
    let work = of.done + of.left();
    let done = if work == 0 { 0.0 } else { of.done as f32 / work as f32 };
    marks.push(Mark::Disc { centre, radius: track + width, ink: Hue::Ground.full() });
    marks.push(Mark::Line { points: Plan::arc(centre, track, 0.0, TAU), width, ink: colour.faint(0.2) });
    if done > 0.0 {
        let strength = if activity == Activity::Retired { 0.5 } else { 1.0 };
        let points = Plan::arc(centre, track, -PI / 2.0, TAU * done);
        marks.push(Mark::Line { points, width, ink: colour.faint(strength) });
    }
    let radius = plan.node * (0.5 + 0.5 * of.speed.clamp(0.0, 1.0).sqrt() as f32);
    let (fill, number) = match activity {
        Activity::Computing | Activity::Done => (1.0, Hue::OnNode(node)),
        Activity::Receiving => (0.55, Hue::Text),
        Activity::Waiting | Activity::Offering | Activity::Idle | Activity::Stopped | Activity::Paused => {
            (0.18, Hue::Text)
        }
        Activity::Retired => (0.08, Hue::Quiet),
    };
    marks.push(Mark::Disc { centre, radius, ink: colour.faint(fill) });
    if fill < 1.0 {
        let strength = if activity == Activity::Retired { 0.3 } else { 0.9 };
        let points = Plan::arc(centre, radius - 0.75, 0.0, TAU);
        marks.push(Mark::Line { points, width: 1.5, ink: colour.faint(strength) });
    }
    marks.push(Mark::Label {
        at: centre,
        anchor: Anchor::Centre,
        text: node_name(node).to_string(),
        size: TextSize::Fit(plan.node * 0.86),
        ink: number.full(),
    });
}

/// What is said of a node beside it: what it still has to do and what it does; at the end, what it has done.
fn words(state: &RunState, of: &NodeState, activity: Activity) -> [String; 2] {
    let left = || format!("{} left", count(of.left()));
    let done = || format!("{} done", count(of.done));
    match activity {
        _ if state.finished().is_some() => [done(), percent(of.done, state.atoms())],
        Activity::Retired => [done(), "retired".into()],
        _ if of.left() == 0 => [activity_word(activity).into(), String::new()],
        Activity::Receiving | Activity::Paused => [left(), activity_word(activity).into()],
        _ if of.speed < 0.995 => [left(), format!("at {:.0} %", of.speed * 100.0)],
        _ => [left(), String::new()],
    }
}

/// Puts words outside the rail, on one line or two.
fn label(plan: &Plan, angle: f32, [first, second]: [String; 2], activity: Activity, marks: &mut Vec<Mark>) {
    let [x, y] = plan.at(angle, plan.rail + if plan.small { 16.0 } else { 22.0 * plan.text });
    // To the right of the ring a text begins at its place, to the left it ends there.
    let anchor = match angle.cos() {
        cos if cos > 0.2 => Anchor::Left,
        cos if cos < -0.2 => Anchor::Right,
        _ => Anchor::Centre,
    };
    let two = !second.is_empty() && !plan.small;
    let y = y + if plan.small { 0.0 } else { 10.0 * plan.text * angle.sin() };
    let spread = if two { 9.0 * plan.text } else { 0.0 };
    let ink = if activity == Activity::Retired { Hue::Quiet } else { Hue::Text }.full();
    let size = plan.text_size();
    marks.push(Mark::Label { at: [x, y - spread], anchor, text: first, size, ink });
    if two {
        let (at, ink) = ([x, y + spread], Hue::Quiet.full());
        marks.push(Mark::Label { at, anchor, text: second, size: TextSize::Small(plan.text), ink });
    }
}

/// The parent, and how far the picture is; when it is done, the result.
fn centre(plan: &Plan, state: &RunState, outcome: Option<Outcome>, marks: &mut Vec<Mark>) {
    let [x, y] = plan.centre;
    let large = (plan.rail * 0.15).clamp(10.0, 48.0);
    let mut text = |dy: f32, text: String, size: TextSize, hue: Hue| {
        marks.push(Mark::Label { at: [x, y + dy], anchor: Anchor::Centre, text, size, ink: hue.full() });
    };
    let small = TextSize::Small(plan.text);
    if let Some(Outcome { makespan, efficiency, .. }) = outcome {
        let large = large * 1.1;
        let (time, used) = (format!("{:.1} s", makespan.as_secs_f64()), format!("{:.0} %", efficiency * 100.0));
        // What explains them has no room within a small ring; the sentence below says it too.
        let lines = if plan.small { [-0.65, 0.65] } else { [-1.3, 0.65] };
        text(large * lines[0], time, TextSize::Fit(large), Hue::Text);
        text(large * lines[1], used, TextSize::Fit(large), Hue::Text);
        if !plan.small {
            text(-large * 0.45, "start to finish".into(), small, Hue::Quiet);
            text(large * 1.5, "efficiency".into(), small, Hue::Quiet);
        }
        return;
    }
    let done = state.done() as f32 / state.atoms().max(1) as f32;
    let lift = if plan.small { 0.0 } else { large * 0.25 };
    text(-lift, percent(state.done(), state.atoms()), TextSize::Fit(large), Hue::Text);
    if !plan.small {
        text(large * 0.6, "parent".into(), small, Hue::Quiet);
    }
    let points = Plan::arc(plan.centre, plan.parent, 0.0, TAU);
    marks.push(Mark::Line { points, width: 1.5, ink: Hue::Hairline.full() });
    if done > 0.0 {
        let points = Plan::arc(plan.centre, plan.parent, -PI / 2.0, TAU * done);
        marks.push(Mark::Line { points, width: 2.5, ink: Hue::Text.full() });
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::time::Duration;

    use proptest::prelude::*;

    use super::super::sample;
    use super::*;

    const SIZE: Point = [520.0, 480.0];

    fn places(mark: &Mark) -> Vec<Point> {
        match mark {
            Mark::Disc { centre, radius, .. } => [-radius, *radius].map(|d| [centre[0] + d, centre[1] + d]).to_vec(),
            Mark::Parcel { centre, .. } => vec![*centre],
            Mark::Line { points, .. } | Mark::Trail { points, .. } => points.clone(),
            Mark::Label { at, .. } => vec![*at],
        }
    }

    fn texts(marks: &[Mark]) -> Vec<&str> {
        let text = |mark: &'_ Mark| matches!(mark, Mark::Label { .. });
        marks
            .iter()
            .filter(|mark| text(mark))
            .filter_map(|mark| if let Mark::Label { text, .. } = mark { Some(&**text) } else { None })
            .collect()
    }

    proptest! {
        #[test]
        fn everything_stays_inside(speeds in prop::collection::vec(0.05..1.0f64, 1..24), width in 240.0..1000.0f32, height in 240.0..1000.0f32) {
            let header = sample::header(&speeds, 60);
            let mut state = RunState::new(&header);
            for (i, record) in sample::records(&header).iter().enumerate() {
                state.apply(record);
                if i % 17 == 0 {
                    for point in ring(&state, None, record.at, [width, height]).iter().flat_map(places) {
                        prop_assert!((0.0..=width).contains(&point[0]) && (0.0..=height).contains(&point[1]), "{point:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn parcels_show_their_counts() {
        let header = sample::header(&[1.0, 1.0, 0.1], 300);
        let mut state = RunState::new(&header);
        let mut seen = BTreeSet::new();
        for record in sample::records(&header) {
            state.apply(&record);
            let marks = ring(&state, None, record.at, SIZE);
            seen.extend(texts(&marks).into_iter().filter(|text| text.starts_with('×')).map(str::to_owned));
        }
        assert!(seen.contains("×100"), "bands {seen:?}");
        assert!(seen.len() > 2, "transfers {seen:?}");
    }

    #[test]
    fn the_result_takes_the_centre() {
        let state = RunState::new(&sample::header(&[1.0, 1.0], 30));
        let (makespan, ideal) = (Duration::from_millis(20_440), Duration::from_millis(19_890));
        let outcome = Outcome { makespan, ideal, efficiency: 0.973, spread: Duration::ZERO };
        let marks = ring(&state, Some(outcome), Time::from_secs(21.0), SIZE);
        assert!(texts(&marks).contains(&"20.4 s") && texts(&marks).contains(&"97 %"));
    }
}
