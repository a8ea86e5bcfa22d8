//! The run in sentences. Nodes are numbered from 1 for people.

use std::time::Duration;

use super::flight::atoms_in;
use super::node::Activity;
use super::state::RunState;
use crate::balance::{Message, NodeId, Party};
use crate::record::{Record, What};
use crate::time::Time;

/// Says what happens, one sentence at a time: each stays long enough to be read, unless something weightier
/// happens.
#[derive(Clone, Debug, Default)]
pub struct Narrator {
    told: Option<Told>,
}

#[derive(Clone, Debug)]
struct Told {
    at: Time,
    weight: u8,
    sentence: String,
}

impl Narrator {
    /// Takes in a record; `state` already knows it.
    pub fn apply(&mut self, record: &Record, state: &RunState) {
        /// How long a sentence stays when others like it follow.
        const READ: Duration = Duration::from_millis(1600);
        let Some((weight, sentence)) = tell(record, state) else { return };
        let free = self.told.as_ref().is_none_or(|told| weight > told.weight || record.at >= told.at + READ);
        if free {
            self.told = Some(Told { at: record.at, weight, sentence });
        }
    }

    /// What is to be read at `now`: the last event while it is fresh, else how things stand.
    pub fn sentence(&self, state: &RunState, now: Time) -> String {
        const FRESH: Duration = Duration::from_secs(3);
        match &self.told {
            Some(told) if now < told.at + FRESH || state.finished().is_some() => told.sentence.clone(),
            _ => standing(state),
        }
    }
}

/// A node's name for people: its number from 1.
pub fn node_name(node: NodeId) -> u32 {
    u32::from(node) + 1
}

/// A count with its thousands apart: `6 144`, with a narrow space that does not break.
pub fn count(number: u32) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{a0}');
        }
        text.push(digit);
    }
    text
}

/// What a node is doing, in a word.
pub fn activity_word(activity: Activity) -> &'static str {
    match activity {
        Activity::Waiting => "waiting",
        Activity::Computing => "computing",
        Activity::Stopped => "stopped",
        Activity::Offering => "offering",
        Activity::Receiving => "receiving",
        Activity::Idle => "idle",
        Activity::Retired => "retired",
        Activity::Done => "done",
    }
}

/// The result of a finished run in a sentence.
pub fn result(state: &RunState, makespan: Duration, efficiency: f64) -> String {
    format!(
        "Done in {:.1} s: {} machines shared {} atoms and used {:.0} % of what they could",
        makespan.as_secs_f64(),
        state.nodes().len(),
        count(state.atoms()),
        efficiency * 100.0,
    )
}

fn tell(record: &Record, state: &RunState) -> Option<(u8, String)> {
    let told = match &record.what {
        What::Sent { from: Party::Node(from), to: Party::Node(to), message: Message::Transfer(ranges), .. } => {
            let (giver, offerer, atoms) = (node_name(*from), node_name(*to), atoms_in(ranges));
            let atoms = if atoms == 1 { "its last spare atom".into() } else { format!("{} atoms", count(atoms)) };
            (3, format!("{offerer} has finished and offers help; {giver} is still busy: gives it {atoms}"))
        }
        What::Sent { from: Party::Node(from), message: Message::Offer { who, .. }, .. } if from == who => {
            (1, format!("{} has finished and offers help round the ring", node_name(*who)))
        }
        What::Sent { from: Party::Parent, message: Message::Band(_), .. } => {
            (2, format!("The parent gives each of {} machines an equal band of the picture", state.nodes().len()))
        }
        What::SpeedSet { node, speed } => {
            let name = node_name(*node);
            let share = if *speed == 0.0 { "is stopped".into() } else { format!("now runs at {:.0} %", speed * 100.0) };
            (4, format!("Machine {name} {share}: the others will make up for it"))
        }
        What::Retired { node } => (2, format!("{}'s offer came back, nobody needs help: it retires", node_name(*node))),
        What::Finished => (5, "The picture is complete".into()),
        _ => return None,
    };
    Some(told)
}

/// How things stand while nothing happens.
fn standing(state: &RunState) -> String {
    let nodes = state.nodes();
    let busy: Vec<_> = (0..).zip(nodes).filter(|(_, node)| node.left() > 0).collect();
    match busy.iter().max_by_key(|(_, node)| node.left()) {
        None => "Waiting for the parent".into(),
        Some((node, last)) if busy.len() == 1 => {
            format!("Only {} still computes: {} atoms left", node_name(*node), count(last.left()))
        }
        Some((node, last)) if last.speed < 0.5 => format!(
            "{} of {} machines compute; {} is slow and has most left: {} atoms",
            busy.len(),
            nodes.len(),
            node_name(*node),
            count(last.left())
        ),
        Some(_) if busy.len() == nodes.len() => format!("All {} machines compute their own atoms", nodes.len()),
        Some((node, _)) => {
            format!("{} of {} machines compute; {} has most left", busy.len(), nodes.len(), node_name(*node))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    #[test]
    fn the_story_of_a_slow_machine() {
        let header = sample::header(&[1.0, 1.0, 0.1], 2400);
        let (mut state, mut narrator, mut heard) = (RunState::new(&header), Narrator::default(), Vec::new());
        for record in sample::records(&header) {
            state.apply(&record);
            narrator.apply(&record, &state);
            heard.push(narrator.sentence(&state, record.at));
        }
        heard.dedup();
        let says = |part: &str| heard.iter().any(|sentence| sentence.contains(part));
        assert!(says("The parent gives each of 3 machines an equal band"), "{heard:#?}");
        assert!(says("3 machines compute"), "{heard:#?}");
        assert!(says("has finished and offers help; 3 is still busy: gives it "), "{heard:#?}");
        assert_eq!(heard.last().map(String::as_str), Some("The picture is complete"));
    }

    #[test]
    fn a_sentence_stays_until_it_is_read_or_outweighed() {
        let state = RunState::new(&sample::header(&[1.0, 1.0], 9));
        let mut narrator = Narrator::default();
        let at = |ms: u64| Time(ms * 1_000_000);
        let mut say = |ms, what| {
            narrator.apply(&Record { at: at(ms), what }, &state);
            narrator.sentence(&state, at(ms))
        };
        assert!(say(0, What::Retired { node: 0 }).starts_with("1's offer"));
        assert!(say(100, What::Retired { node: 1 }).starts_with("1's offer"));
        assert!(say(200, What::SpeedSet { node: 1, speed: 0.25 }).starts_with("Machine 2 now runs at 25 %"));
        assert!(say(2000, What::Retired { node: 1 }).starts_with("2's offer"));
    }

    #[test]
    fn thousands_stand_apart() {
        assert_eq!(count(0), "0");
        assert_eq!(count(144), "144");
        assert_eq!(count(1_234_567), "1\u{a0}234\u{a0}567");
    }
}
