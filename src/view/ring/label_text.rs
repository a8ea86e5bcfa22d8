//! Texts of the labels beside the nodes.

use super::labels::{LabelForm, MAX_LABELLED_NODES};
use super::layout::RingLayout;
use crate::balance::{NodeId, Remedy};
use crate::language::{Language, say};
use crate::time::Time;
use crate::view::draw::display_list::{Hue, Mark, TextSize};
use crate::view::state::node_state::{Activity, NodeState};
use crate::view::state::run_state::RunState;
use crate::view::text::format::{activity_word, count, fraction, percent, rate_words};

/// Draws the label of a node beside the rail.
pub(crate) fn draw(
    layout: &RingLayout,
    state: &RunState,
    (node, of): (NodeId, &NodeState),
    activity: Activity,
    now: Time,
    marks: &mut Vec<Mark>,
    language: Language,
) {
    let labels = &layout.labels;
    let ([dx, dy], anchor) = labels.place(layout.angle(node), layout.rail_radius, language);
    let [x, y] = [layout.centre[0] + dx, layout.centre[1] + dy];
    let ink = if activity.is_out() { Hue::Quiet } else { Hue::Text }.full();
    let (size, small) = (labels.size(), TextSize::Small(labels.text_scale));
    let [first, second] = match labels.form {
        LabelForm::Nothing => return,
        LabelForm::Number => [number(state, of, activity), String::new()],
        LabelForm::OneLine => [lines(state, of, activity, now, language)[0].clone(), String::new()],
        LabelForm::TwoLines => lines(state, of, activity, now, language),
    };
    let top = if second.is_empty() { y } else { y - small.line() / 2.0 };
    marks.push(Mark::Label { at: [x, top], anchor, text: first, size, ink });
    if !second.is_empty() {
        let (at, ink) = ([x, y + size.line() / 2.0], Hue::Quiet.full());
        marks.push(Mark::Label { at, anchor, text: second, size: small, ink });
    }
}

/// Whether a node has a label: in a large ring only the selected one does.
pub(crate) fn is_labelled(layout: &RingLayout, is_selected: bool) -> bool {
    layout.nodes <= MAX_LABELLED_NODES || is_selected
}

/// Returns the two lines of a label: the atoms left, and the activity, the rate, or a low speed. After the run or for a
/// machine that is out: the atoms done.
fn lines(state: &RunState, of: &NodeState, activity: Activity, now: Time, language: Language) -> [String; 2] {
    let (rest, made) = (if of.left() == 1 { "resta" } else { "restam" }, if of.done == 1 { "feito" } else { "feitos" });
    let [left, done] = [of.left(), of.done].map(short_count);
    let (left, done) = (say!(language, "{left} left", "{rest} {left}"), say!(language, "{done} done", "{done} {made}"));
    match activity {
        _ if state.finished().is_some() && activity != Activity::Spare => {
            let share = percent(of.done, state.atoms());
            [done, say!(language, "{share} of all", "{share} de tudo")]
        }
        Activity::NoBand | Activity::Spare => [activity_word(activity, language).into(), String::new()],
        Activity::Off if of.lost_atoms > 0 && !state.has(Remedy::Leases) => {
            let lost = short_count(of.lost_atoms);
            [say!(language, "{lost} lost", "perdeu {lost}"), activity_word(activity, language).into()]
        }
        _ if activity.is_out() => [done, activity_word(activity, language).into()],
        Activity::Tracing => {
            let speed = fraction(of.speed);
            let slow = say!(language, "at {speed}", "a {speed}");
            [left, if of.speed < 0.995 { slow } else { rate_words(of.rate(now), language) }]
        }
        _ => [left, activity_word(activity, language).into()],
    }
}

/// Returns the label of one number: atoms left, or atoms done.
fn number(state: &RunState, of: &NodeState, activity: Activity) -> String {
    let done = state.finished().is_some() || activity.is_out();
    short_count(if done { of.done } else { of.left() })
}

/// Formats a count in at most five letters.
fn short_count(number: u32) -> String {
    match number {
        0..10_000 => count(number),
        10_000..1_000_000 => format!("{}k", number / 1000),
        _ => format!("{}M", number / 1_000_000),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::labels::{NUMBER_LETTERS, first_line_letters, second_line_letters};
    use super::*;
    use crate::balance::{Message, Party};
    use crate::record::{Record, RecordKind};
    use crate::view::tests::sample_runs;

    proptest! {
        #[test]
        fn labels_fit_their_room(left in 0..1_000_000_000u32, done in 0..1_000_000_000u32, speed in 0.0..1.0f64) {
            let language = Language::English;
            let mut state = RunState::new(&sample_runs::header(&[1.0], 9));
            for ms in 0..done % 3000 {
                state.nodes[0].atom_done(true, Time(u64::from(ms) * 1_000_000));
            }
            let mut of = state.nodes[0].clone();
            (of.speed, of.left, of.done) = (speed, i64::from(left), done);
            for activity in [Activity::Tracing, Activity::Receiving, Activity::Retired, Activity::Done, Activity::NoBand] {
                let [first, second] = lines(&state, &of, activity, Time::from_secs(2.0), language).map(|line| line.chars().count());
                prop_assert!(first <= first_line_letters(language) && second <= second_line_letters(language), "{:?}", lines(&state, &of, activity, Time::ZERO, language));
                prop_assert!(number(&state, &of, activity).chars().count() <= NUMBER_LETTERS);
            }
        }
    }

    #[test]
    fn second_line_has_rate_or_low_speed_or_activity() {
        let language = Language::English;
        let mut state = RunState::new(&sample_runs::header(&[1.0, 0.1], 300));
        let mut apply = |ms: u64, kind| state.apply(&Record { at: Time(ms * 1_000_000), kind });
        for (id, node) in [(0, 0), (1, 1)] {
            let (to, message) = (Party::Node(node), Message::Band(150 * id..150 * (id + 1)));
            let (from, id, arrives) = (Party::Parent, u64::from(id), Time::ZERO);
            apply(0, RecordKind::Sent { id, from, to, message, bytes: 0, arrives });
            apply(0, RecordKind::Received { id, by: to });
        }
        for (node, each) in [(0, 20), (1, 200)] {
            for i in 1..=1000 / each {
                let atom = 150 * u32::from(node) + i as u32;
                apply(i * each, RecordKind::AtomDone { node, atom, cost: std::time::Duration::ZERO });
            }
        }
        let said = |state: &RunState, node: NodeId| {
            let now = Time::from_secs(1.0);
            lines(state, &state.nodes()[usize::from(node)], state.activity(node, now), now, language).join(", ")
        };
        assert_eq!([said(&state, 0), said(&state, 1)], ["100 left, 50/s", "145 left, at 10 %"]);
        state.apply(&Record { at: Time::from_secs(1.0), kind: RecordKind::Paused { node: 1 } });
        assert_eq!(said(&state, 1), "145 left, paused");
        state.nodes[0].left = 0;
        assert_eq!(said(&state, 0), "0 left, idle");
        state.nodes[0].retired = true;
        assert_eq!(said(&state, 0), "50 done, retired");
    }
}
