//! The run in sentences. Nodes are numbered from 1 for people.

use std::cmp::Ordering;
use std::time::Duration;

use super::flight::atoms_in;
use super::node::{Activity, NodeState};
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
    /// If it tells of a speed: whose, and the one before somebody began to change it.
    speed: Option<(NodeId, f64)>,
}

/// Of a speed that somebody sets: it follows the hand.
const SPEED: u8 = 4;

/// How long an event is fresh.
const FRESH: Duration = Duration::from_secs(3);

impl Narrator {
    /// Takes in a record; `state` already knows it.
    pub fn apply(&mut self, record: &Record, state: &RunState) {
        /// How long a sentence stays when others like it follow.
        const READ: Duration = Duration::from_millis(1600);
        if let What::SpeedSet { node, speed } = record.what {
            return self.tell_speed(node, speed, record.at, state);
        }
        let Some((weight, sentence)) = tell(record, state) else { return };
        let free = self.told.as_ref().is_none_or(|told| weight > told.weight || record.at >= told.at + READ);
        if free {
            self.told = Some(Told { at: record.at, weight, sentence, speed: None });
        }
    }

    /// A new speed is told at once, or the first of a slider's many would stand there.
    fn tell_speed(&mut self, node: NodeId, speed: f64, at: Time, state: &RunState) {
        if self.told.as_ref().is_some_and(|told| told.weight > SPEED) {
            return;
        }
        let Some(machine) = state.nodes().get(usize::from(node)) else { return };
        let dragged = self.told.as_ref().filter(|told| at < told.at + FRESH).and_then(|told| told.speed);
        let before = dragged.filter(|(other, _)| *other == node).map_or(machine.speed_before, |(_, before)| before);
        let mut others = (0..).zip(state.nodes()).filter(|(other, _)| *other != node);
        let helped = others.any(|(_, other)| other.speed > 0.0);
        let sentence = speed_words(node_name(node), before, speed, helped);
        self.told = Some(Told { at, weight: SPEED, sentence, speed: Some((node, before)) });
    }

    /// What is to be read at `now`: the last event while it is fresh, else how things stand.
    pub fn sentence(&self, state: &RunState, now: Time) -> String {
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

/// How many of `whole` are `part`, in whole per cent, the same everywhere: all of it only when nothing is missing.
pub fn percent(part: u32, whole: u32) -> String {
    let rounded = (200 * u64::from(part) + u64::from(whole)) / (2 * u64::from(whole)).max(1);
    format!("{} %", if part < whole { rounded.min(99) } else { rounded })
}

/// What a node is doing, in a word.
pub fn activity_word(activity: Activity) -> &'static str {
    match activity {
        Activity::Waiting => "waiting",
        Activity::Computing => "computing",
        Activity::Stopped => "stopped",
        Activity::Paused => "paused",
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
            let atoms = if atoms == 1 { "one atom".into() } else { atoms_words(atoms) };
            (3, format!("{offerer} has finished and offers help; {giver} is still busy: gives it {atoms}"))
        }
        What::Sent { from: Party::Node(from), message: Message::Offer { who, .. }, .. } if from == who => {
            (1, format!("{} has finished and offers help round the ring", node_name(*who)))
        }
        What::Sent { from: Party::Parent, message: Message::Band(_), .. } => {
            (2, format!("The parent gives each of {} machines an equal band of the picture", state.nodes().len()))
        }
        What::Retired { node } => (2, format!("{}'s offer came back, nobody needs help: it retires", node_name(*node))),
        What::Finished => (5, "The picture is complete".into()),
        _ => return None,
    };
    Some(told)
}

/// What a new speed means; `helped` if any other machine runs.
fn speed_words(name: u32, before: f64, speed: f64, helped: bool) -> String {
    let runs = if speed == 0.0 { "is stopped".into() } else { format!("now runs at {:.0} %", speed * 100.0) };
    let runs = format!("Machine {name} {runs}");
    match speed.total_cmp(&before) {
        Ordering::Less if helped => format!("{runs}: the others will make up for it"),
        Ordering::Less => runs,
        Ordering::Equal => runs,
        Ordering::Greater => format!("{runs}: it can take more work"),
    }
}

/// How things stand while nothing happens.
fn standing(state: &RunState) -> String {
    let nodes = state.nodes();
    let with_atoms = || (0..).zip(nodes).filter(|(_, node)| node.left() > 0);
    let busy: Vec<(NodeId, _)> = with_atoms().filter(|(_, node)| node.computes()).collect();
    match busy.iter().max_by_key(|(_, node)| node.left()) {
        None if state.has_atoms_under_way() => "Atoms are on their way".into(),
        None => stuck(state, &with_atoms().collect::<Vec<_>>()),
        Some((node, last)) if busy.len() == 1 => {
            format!("Only {} still computes: {} left", node_name(*node), atoms_words(last.left()))
        }
        Some((node, last)) if last.speed < 0.5 => format!(
            "{} of {} machines compute; {} is slow and has most left: {}",
            busy.len(),
            nodes.len(),
            node_name(*node),
            atoms_words(last.left())
        ),
        Some(_) if busy.len() == nodes.len() => format!("All {} machines compute their own atoms", nodes.len()),
        Some((node, _)) => {
            format!("{} of {} machines compute; {} has most left", busy.len(), nodes.len(), node_name(*node))
        }
    }
}

/// How things stand while nobody computes; `stopped` are the machines that have atoms, all at speed 0.
fn stuck(state: &RunState, stopped: &[(NodeId, &NodeState)]) -> String {
    /// What a machine's pipe holds at most: more than that lies in its queue.
    const PIPE: u32 = 2;
    match stopped {
        [] => "Waiting for the parent".into(),
        [(node, machine)] => {
            let (name, left) = (node_name(*node), machine.left());
            let still = format!("Machine {name} stands still at 0 %");
            let mut others = (0..).zip(state.nodes()).filter(|(other, _)| other != node);
            let nobody_asks = others.all(|(_, other)| other.retired);
            match left {
                1 => format!(
                    "{still} and keeps its last atom: nobody can take it out of its pipe. Raise its speed to finish."
                ),
                2..=PIPE => format!(
                    "{still} and keeps its last {left} atoms: nobody can take them out of its pipe. \
                     Raise its speed to finish."
                ),
                _ if nobody_asks => format!(
                    "{still} and keeps {}: nobody asks for them any more. Raise its speed to finish.",
                    atoms_words(left)
                ),
                _ => format!("{still} with {}: the others offer to take them", atoms_words(left)),
            }
        }
        _ if stopped.len() == state.nodes().len() => {
            "All machines stand still at 0 %: raise a speed and the work goes on".into()
        }
        _ => {
            let left = stopped.iter().map(|(_, node)| node.left()).sum();
            let machines = stopped.len();
            format!(
                "{machines} machines stand still at 0 % and keep {}: raise their speed to finish",
                atoms_words(left)
            )
        }
    }
}

/// `1 atom`, `2 atoms`.
fn atoms_words(atoms: u32) -> String {
    if atoms == 1 { "1 atom".into() } else { format!("{} atoms", count(atoms)) }
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
        assert!(say(300, What::Retired { node: 1 }).starts_with("Machine 2"));
        assert!(say(2000, What::Retired { node: 1 }).starts_with("2's offer"));
    }

    #[test]
    fn a_sentence_on_a_speed_follows_the_hand() {
        let mut state = RunState::new(&sample::header(&[1.0, 1.0, 0.1], 9));
        let mut narrator = Narrator::default();
        let mut set = |ms: u64, node, speed| {
            let record = Record { at: Time(ms * 1_000_000), what: What::SpeedSet { node, speed } };
            state.apply(&record);
            narrator.apply(&record, &state);
            narrator.sentence(&state, record.at)
        };
        for (ms, speed) in [(0, 0.86), (50, 0.4), (100, 0.01)] {
            let expected = format!("Machine 2 now runs at {:.0} %: the others will make up for it", speed * 100.0);
            assert_eq!(set(ms, 1, speed), expected);
        }
        assert_eq!(set(150, 1, 0.0), "Machine 2 is stopped: the others will make up for it");
        assert_eq!(set(200, 1, 0.7), "Machine 2 now runs at 70 %: the others will make up for it");
        assert_eq!(set(250, 1, 1.0), "Machine 2 now runs at 100 %");
        assert_eq!(set(300, 2, 0.6), "Machine 3 now runs at 60 %: it can take more work");
        assert_eq!(set(350, 2, 1.0), "Machine 3 now runs at 100 %: it can take more work");
        assert_eq!(set(9000, 2, 0.9), "Machine 3 now runs at 90 %: the others will make up for it");
    }

    /// How things stand when these machines have so many atoms left, at these speeds; the others have retired.
    fn stands(machines: &[(u32, f64)]) -> String {
        let mut state = RunState::new(&sample::header(&vec![1.0; machines.len()], 900));
        let apply = |state: &mut RunState, what| state.apply(&Record { at: Time::ZERO, what });
        for ((id, node), &(left, speed)) in (0..).zip(0..).zip(machines) {
            let (to, message) = (Party::Node(node), Message::Band(100 * id as u32..100 * id as u32 + left));
            let (from, at) = (Party::Parent, Time::ZERO);
            apply(&mut state, What::Sent { id, from, to, message, bytes: 0, arrives: at });
            apply(&mut state, What::Received { id, by: to });
            apply(&mut state, What::SpeedSet { node, speed });
            if left == 0 {
                apply(&mut state, What::Retired { node });
            }
        }
        standing(&state)
    }

    #[test]
    fn only_those_that_compute_are_counted() {
        assert_eq!(stands(&[(5, 1.0), (5, 1.0), (5, 1.0)]), "All 3 machines compute their own atoms");
        assert_eq!(stands(&[(5, 0.0), (5, 1.0), (9, 1.0)]), "2 of 3 machines compute; 3 has most left");
        assert_eq!(stands(&[(50, 0.0), (1, 1.0), (0, 1.0)]), "Only 2 still computes: 1 atom left");
        assert_eq!(stands(&[(0, 1.0), (0, 1.0)]), "Waiting for the parent");
    }

    #[test]
    fn a_machine_that_stands_still_with_the_last_atoms_is_named() {
        let last = "Machine 1 stands still at 0 % and keeps its last 2 atoms: nobody can take them out of its pipe. \
                    Raise its speed to finish.";
        assert_eq!(stands(&[(2, 0.0), (0, 1.0), (0, 1.0)]), last);
        assert!(stands(&[(0, 1.0), (1, 0.0)]).starts_with("Machine 2 stands still at 0 % and keeps its last atom:"));
        assert!(stands(&[(90, 0.0), (0, 1.0)]).contains("keeps 90 atoms: nobody asks for them any more"));
        assert!(stands(&[(2, 0.0), (2, 0.0), (0, 1.0)]).starts_with("2 machines stand still at 0 % and keep 4 atoms"));
        assert!(stands(&[(5, 0.0), (5, 0.0)]).starts_with("All machines stand still at 0 %"));
    }

    #[test]
    fn only_the_whole_is_a_hundred_per_cent() {
        let said =
            [(0, 6144), (3901, 6144), (6143, 6144), (6144, 6144), (0, 0)].map(|(part, whole)| percent(part, whole));
        assert_eq!(said, ["0 %", "63 %", "99 %", "100 %", "0 %"]);
        assert_eq!([percent(1, 8), percent(635, 1000)], ["13 %", "64 %"]);
    }

    #[test]
    fn thousands_stand_apart() {
        assert_eq!(count(0), "0");
        assert_eq!(count(144), "144");
        assert_eq!(count(1_234_567), "1\u{a0}234\u{a0}567");
    }
}
