//! What is said beside the nodes, and how much of it there is room for.
//!
//! The room depends on the size and the number of nodes alone, never on what is said, so that nothing jumps.

use super::display::{Anchor, Hue, Mark, Point, TextSize};
use super::node::{Activity, NodeState};
use super::plan::Plan;
use super::state::RunState;
use super::words::{activity_word, count, fraction, percent, rate_words};
use crate::balance::NodeId;
use crate::language::{say, word};
use crate::time::Time;

/// How labels look in a ring of some size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Labels {
    form: Form,
    /// How much larger than usual words are: in a large ring they grow with it.
    pub(super) text: f32,
}

/// How much is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// How much is left, and below it what the node does.
    TwoLines,
    /// How much is left.
    OneLine,
    /// A mere number.
    Number,
    Nothing,
}

/// Beyond this many nodes only the selected one has a label; the rows have the numbers of all.
const LABELLED: usize = 16;
/// Up to this height or width words have their usual size.
const USUAL: f32 = 500.0;
/// Between labels and the edge.
const EDGE: f32 = 2.0;

/// The most letters in a first line, as in `6 144 left`, in a second one, as in `10 % · 62/s`, and in a number.
fn longest() -> usize {
    word!(10, 12)
}
pub(super) const SECOND: usize = 12;
const NUMBER: usize = 5;

impl Form {
    /// From which height and width on it is thought of, and what part of these the rail's radius is at least: words
    /// are not worth more.
    fn least(self) -> [f32; 2] {
        match self {
            Self::TwoLines => [380.0, 0.25],
            Self::OneLine => [190.0, 0.3],
            Self::Number => [190.0, 0.2],
            Self::Nothing => [0.0, 0.0],
        }
    }
}

impl Labels {
    /// The most that there is room for, and the rail's radius that leaves this room.
    pub(super) fn fit(nodes: usize, [width, height]: Point) -> (Self, f32) {
        let room = width.min(height);
        let rail = |labels: Self| {
            let [beside, above] = labels.room();
            (height / 2.0 - above).min(width / 2.0 - beside)
        };
        let fits = |labels: &Self| {
            let ([least, part], rail) = (labels.form.least(), rail(*labels));
            room >= least && rail >= part * room && labels.are_apart(nodes, rail)
        };
        let text = (room / USUAL).clamp(1.0, 1.4);
        let forms = [(Form::TwoLines, text), (Form::OneLine, 1.0), (Form::Number, 1.0)];
        let fitting = forms.map(|(form, text)| Self { form, text }).into_iter().find(fits);
        let labels = fitting.unwrap_or(Self { form: Form::Nothing, text: 1.0 });
        (labels, rail(labels))
    }

    /// Whether there is little room for words.
    pub(super) fn are_small(&self) -> bool {
        self.form != Form::TwoLines
    }

    /// How large what is to be read is.
    pub(super) fn size(&self) -> TextSize {
        if self.are_small() { TextSize::Small(1.0) } else { TextSize::Body(self.text) }
    }

    /// What a label takes at most.
    fn extent(&self) -> Point {
        let (size, second) = (self.size(), TextSize::Small(self.text));
        match self.form {
            Form::TwoLines => [size.width(longest()).max(second.width(SECOND)), size.line() + second.line()],
            Form::OneLine => [size.width(longest()), size.line()],
            Form::Number => [size.width(NUMBER), size.line()],
            Form::Nothing => [0.0, 0.0],
        }
    }

    /// From the rail to the labels: offers need room there.
    pub(super) fn gap(&self) -> f32 {
        match self.form {
            Form::TwoLines => 18.0 * self.text,
            Form::OneLine | Form::Number => 12.0,
            Form::Nothing => 10.0,
        }
    }

    /// What the labels need beside the rail, and above it.
    fn room(&self) -> [f32; 2] {
        self.extent().map(|extent| self.gap() + extent + EDGE)
    }

    /// The place of a label seen from the centre: as near to the rail as its height allows. To the right of the ring a
    /// text begins at its place, to the left it ends there, so that it may have any length.
    fn place(&self, angle: f32, rail: f32) -> (Point, Anchor) {
        let (radius, half) = (rail + self.gap(), self.extent()[1] / 2.0);
        let (cos, sin) = (angle.cos(), angle.sin());
        if cos.abs() <= 0.2 {
            let away = (radius + half) / sin.abs();
            return ([away * cos, away * sin], Anchor::Centre);
        }
        // The corner nearest to the centre is `radius` away from it, or the middle of the near side where that is nearer.
        let corner = half * sin.abs() + (radius * radius - (half * cos).powi(2)).max(0.0).sqrt();
        let away = if corner * sin.abs() < half { radius / cos.abs() } else { corner };
        ([away * cos, away * sin], if cos > 0.0 { Anchor::Left } else { Anchor::Right })
    }

    /// Whether no two labels touch even if all are as long as they get.
    fn are_apart(&self, nodes: usize, rail: f32) -> bool {
        let [width, height] = self.extent();
        let reach = |node: usize| {
            let ([x, y], anchor) = self.place(Plan::direction(node, nodes), rail);
            (anchor.left(x, width), y)
        };
        !(2..=LABELLED).contains(&nodes)
            || (0..nodes).all(|node| {
                let ((x, y), (u, v)) = (reach(node), reach((node + 1) % nodes));
                (x - u).abs() >= width || (y - v).abs() >= height
            })
    }
}

/// Puts the words on a node beside the rail.
pub(super) fn label(
    plan: &Plan,
    state: &RunState,
    (node, of): (NodeId, &NodeState),
    activity: Activity,
    now: Time,
    marks: &mut Vec<Mark>,
) {
    let labels = &plan.labels;
    let ([dx, dy], anchor) = labels.place(plan.angle(node), plan.rail);
    let [x, y] = [plan.centre[0] + dx, plan.centre[1] + dy];
    let ink = if activity.is_out() { Hue::Quiet } else { Hue::Text }.full();
    let (size, small) = (labels.size(), TextSize::Small(labels.text));
    let [first, second] = match labels.form {
        Form::Nothing => return,
        Form::Number => [number(state, of, activity), String::new()],
        Form::OneLine => [words(state, of, activity, now)[0].clone(), String::new()],
        Form::TwoLines => words(state, of, activity, now),
    };
    let top = if second.is_empty() { y } else { y - small.line() / 2.0 };
    marks.push(Mark::Label { at: [x, top], anchor, text: first, size, ink });
    if !second.is_empty() {
        let (at, ink) = ([x, y + size.line() / 2.0], Hue::Quiet.full());
        marks.push(Mark::Label { at, anchor, text: second, size: small, ink });
    }
}

/// Whether a node has a label.
pub(super) fn is_labelled(plan: &Plan, is_selected: bool) -> bool {
    plan.nodes <= LABELLED || is_selected
}

/// What is said of a node: what it still has to do, and what matters most of how it does it; at the end, what it has
/// done.
fn words(state: &RunState, of: &NodeState, activity: Activity, now: Time) -> [String; 2] {
    let (rest, made) = (if of.left() == 1 { "resta" } else { "restam" }, if of.done == 1 { "feito" } else { "feitos" });
    let [left, done] = [of.left(), of.done].map(short);
    let (left, done) = (say!("{left} left", "{rest} {left}"), say!("{done} done", "{done} {made}"));
    match activity {
        _ if state.finished().is_some() && activity != Activity::Spare => [done, percent(of.done, state.atoms())],
        Activity::Waiting | Activity::Spare => [activity_word(activity).into(), String::new()],
        _ if activity.is_out() => [done, activity_word(activity).into()],
        Activity::Computing => {
            let rate = rate_words(of.rate(now));
            let both = format!("{} · {rate}", fraction(of.speed));
            [left, if of.speed < 0.995 && both.chars().count() <= SECOND { both } else { rate }]
        }
        _ => [left, activity_word(activity).into()],
    }
}

/// The same in a number.
fn number(state: &RunState, of: &NodeState, activity: Activity) -> String {
    let done = state.finished().is_some() || activity.is_out();
    short(if done { of.done } else { of.left() })
}

/// A count in at most five letters.
fn short(number: u32) -> String {
    match number {
        0..10_000 => count(number),
        10_000..1_000_000 => format!("{}k", number / 1000),
        _ => format!("{}M", number / 1_000_000),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::sample;
    use super::*;
    use crate::balance::{Message, Party};
    use crate::record::{Record, What};

    #[test]
    fn there_are_labels_at_all_sizes_and_two_lines_where_there_is_room() {
        for nodes in 1..=32 {
            for size in [[240.0, 240.0], [240.0, 900.0], [1000.0, 240.0], [330.0, 300.0]] {
                assert_ne!(Labels::fit(nodes, size).0.form, Form::Nothing, "{nodes} nodes at {size:?}");
            }
            assert_eq!(Labels::fit(nodes, [640.0, 490.0]).0.form, Form::TwoLines, "{nodes} nodes");
            if nodes <= 12 {
                assert_eq!(Labels::fit(nodes, [480.0, 480.0]).0.form, Form::TwoLines, "{nodes} nodes");
            }
        }
        assert_eq!(Labels::fit(8, [180.0, 180.0]).0.form, Form::Nothing);
    }

    proptest! {
        #[test]
        fn labels_are_no_longer_than_their_room(left in 0..1_000_000_000u32, done in 0..1_000_000_000u32, speed in 0.0..1.0f64) {
            let mut state = RunState::new(&sample::header(&[1.0], 9));
            for ms in 0..done % 3000 {
                state.nodes[0].atom_done(true, Time(u64::from(ms) * 1_000_000));
            }
            let mut of = state.nodes[0].clone();
            (of.speed, of.left, of.done) = (speed, i64::from(left), done);
            for activity in [Activity::Computing, Activity::Receiving, Activity::Retired, Activity::Done, Activity::Waiting] {
                let [first, second] = words(&state, &of, activity, Time::from_secs(2.0)).map(|line| line.chars().count());
                prop_assert!(first <= longest() && second <= SECOND, "{:?}", words(&state, &of, activity, Time::ZERO));
                prop_assert!(number(&state, &of, activity).chars().count() <= NUMBER);
            }
        }
    }

    #[test]
    fn the_second_line_says_what_matters() {
        let mut state = RunState::new(&sample::header(&[1.0, 0.1], 300));
        let mut apply = |ms: u64, what| state.apply(&Record { at: Time(ms * 1_000_000), what });
        for (id, node) in [(0, 0), (1, 1)] {
            let (to, message) = (Party::Node(node), Message::Band(150 * id..150 * (id + 1)));
            let (from, id, arrives) = (Party::Parent, u64::from(id), Time::ZERO);
            apply(0, What::Sent { id, from, to, message, bytes: 0, arrives });
            apply(0, What::Received { id, by: to });
        }
        for (node, each) in [(0, 20), (1, 200)] {
            for i in 1..=1000 / each {
                let atom = 150 * u32::from(node) + i as u32;
                apply(i * each, What::AtomDone { node, atom, cost: std::time::Duration::ZERO });
            }
        }
        let said = |state: &RunState, node: NodeId| {
            let now = Time::from_secs(1.0);
            words(state, &state.nodes()[usize::from(node)], state.activity(node, now), now).join(", ")
        };
        assert_eq!([said(&state, 0), said(&state, 1)], ["100 left, 50/s", "145 left, 10 % · 5/s"]);
        state.apply(&Record { at: Time::from_secs(1.0), what: What::Paused { node: 1 } });
        assert_eq!(said(&state, 1), "145 left, paused");
        state.nodes[0].left = 0;
        assert_eq!(said(&state, 0), "0 left, idle");
        state.nodes[0].retired = true;
        assert_eq!(said(&state, 0), "50 done, retired");
    }
}
