//! Steps through a run's records, and landmarks to jump to.

use crate::balance::{Message, NodeId, Party};
use crate::language::{Language, say, word};
use crate::picture::{Atom, atoms_in};
use crate::record::{Record, RecordKind};
use crate::runlog::RunLog;
use crate::time::Time;
use crate::view::text::format::{atoms_words, count, duration, node_name};

/// Unit of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepUnit {
    /// A message is sent or handled, a machine retires, or the user changes something. Results are left out: they are
    /// many.
    Event,
    /// An atom is traced.
    Atom,
    /// A machine sends its own offer, which then goes round the ring.
    Lap,
}

impl StepUnit {
    /// All units, the smallest last.
    pub const ALL: [Self; 3] = [Self::Lap, Self::Event, Self::Atom];

    /// Returns its name, in a word or two.
    pub fn name(self, language: Language) -> &'static str {
        match self {
            Self::Event => word!(language, "event", "evento"),
            Self::Atom => word!(language, "atom", "átomo"),
            Self::Lap => word!(language, "lap", "volta"),
        }
    }

    /// Whether a step of this unit ends at a record of kind `what`.
    fn matches(self, kind: &RecordKind) -> bool {
        match (self, kind) {
            (Self::Atom, RecordKind::AtomDone { .. }) => true,
            (Self::Lap, RecordKind::Sent { from: Party::Node(from), message, .. }) => {
                message.own_offer(*from).is_some()
            }
            (
                Self::Event,
                RecordKind::Sent { message: Message::Results(_), .. } | RecordKind::Received { by: Party::Parent, .. },
            ) => false,
            (Self::Event, RecordKind::AtomStarted { .. } | RecordKind::AtomDone { .. }) => false,
            (Self::Event, _) => true,
            (Self::Atom | Self::Lap, _) => false,
        }
    }
}

/// Returns how many records lie before the end of a step that starts after the first `records` records of `log`; `None`
/// if there is no step. A step back from the first event leads to the beginning.
pub fn step(log: &RunLog, records: usize, by: StepUnit, forward: bool) -> Option<usize> {
    let is_end = |record: &Record| by.matches(&record.kind);
    let (before, after) = log.records().split_at(records.min(log.records().len()));
    if forward {
        return after.iter().position(is_end).map(|further| before.len() + further + 1);
    }
    let (_, before) = before.split_last()?;
    Some(before.iter().rposition(is_end).map_or(0, |last| last + 1))
}

/// An event to jump to.
#[derive(Clone, Debug, PartialEq)]
pub struct Landmark {
    /// Its name and its facts.
    pub words: String,
    /// Number of records up to it, its own included.
    pub records: usize,
    /// Its time.
    pub at: Time,
    /// Its machine, atom or message.
    pub subject: Subject,
}

/// A machine, an atom or a message that can be selected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A machine.
    Node(NodeId),
    /// An atom.
    Atom(Atom),
    /// A message, by its id in the run.
    Message(u64),
}

/// Finds the landmarks of a run, in the order in which they are of interest.
pub fn landmarks(log: &RunLog, language: Language) -> Vec<Landmark> {
    let (mut offer, mut transfer, mut biggest, mut retired, mut dearest) = (None, None, None, None, None);
    let mut user_change = None;
    let records = until_finished(log);
    for (index, record) in records.iter().enumerate() {
        let mark = |words: String, subject| Landmark { words, records: index + 1, at: record.at, subject };
        match &record.kind {
            RecordKind::Sent { id, from: Party::Node(from), message: Message::Offer { who, .. }, .. }
                if from == who =>
            {
                let name = node_name(*who);
                let words = || {
                    say!(
                        language,
                        "The first offer of help: {name} has finished",
                        "A primeira oferta de ajuda: {name} terminou"
                    )
                };
                offer.get_or_insert_with(|| mark(words(), Subject::Message(*id)));
            }
            RecordKind::Sent {
                id,
                from: Party::Node(from),
                to: Party::Node(to),
                message: Message::Transfer(ranges),
                ..
            } => {
                let atoms = atoms_in(ranges);
                let words = || {
                    let (atoms, from, to) = (atoms_words(atoms, language), node_name(*from), node_name(*to));
                    say!(language, "{atoms} from {from} to {to}", "{atoms} de {from} para {to}")
                };
                transfer.get_or_insert_with(|| {
                    let words = words();
                    mark(
                        say!(language, "The first transfer: {words}", "A primeira transferência: {words}"),
                        Subject::Message(*id),
                    )
                });
                if biggest.as_ref().is_none_or(|(most, _)| atoms > *most) {
                    let words = words();
                    let words = say!(language, "The biggest transfer: {words}", "A maior transferência: {words}");
                    biggest = Some((atoms, mark(words, Subject::Message(*id))));
                }
            }
            RecordKind::AtomDone { atom, cost, .. } if dearest.as_ref().is_none_or(|(most, _)| cost > most) => {
                let took = duration(*cost, language);
                let name = count(atom.saturating_add(1));
                let words = say!(
                    language,
                    "The costliest atom: {took} for atom {name}",
                    "O átomo mais caro: {took} do átomo {name}"
                );
                dearest = Some((*cost, mark(words, Subject::Atom(*atom))));
            }
            RecordKind::Retired { node } => {
                let name = node_name(*node);
                let words =
                    || say!(language, "The first machine to retire: {name}", "A primeira máquina dispensada: {name}");
                retired.get_or_insert_with(|| mark(words(), Subject::Node(*node)));
            }
            RecordKind::SpeedSet { node, .. } | RecordKind::Paused { node } | RecordKind::Condition { node, .. } => {
                let name = node_name(*node);
                let words = || {
                    say!(
                        language,
                        "The first change by the user: machine {name}",
                        "A primeira intervenção: máquina {name}"
                    )
                };
                user_change.get_or_insert_with(|| mark(words(), Subject::Node(*node)));
            }
            _ => {}
        }
    }
    // Listed once if they are the same.
    let transfer =
        transfer.filter(|first: &Landmark| biggest.as_ref().is_none_or(|(_, mark)| mark.subject != first.subject));
    let slowest = slowest(records, log.header.speeds.len(), language);
    let [biggest, dearest] = [biggest.map(|(_, mark)| mark), dearest.map(|(_, mark)| mark)];
    [offer, transfer, biggest, retired, slowest, dearest, user_change].into_iter().flatten().collect()
}

/// Returns the records until the picture is complete: the shown time ends there.
fn until_finished(log: &RunLog) -> &[Record] {
    let records = log.records();
    let end = records.iter().position(|record| record.kind == RecordKind::Finished);
    &records[..end.map_or(records.len(), |end| end + 1)]
}

/// Finds the machine with the lowest rate while it traced. Its landmark is the end of the run, where its rate is known.
fn slowest(records: &[Record], nodes: usize, language: Language) -> Option<Landmark> {
    let (mut started, mut busy, mut atoms) = (vec![None; nodes], vec![0.0; nodes], vec![0_u32; nodes]);
    for record in records {
        match record.kind {
            RecordKind::AtomStarted { node, .. } if usize::from(node) < nodes => {
                started[usize::from(node)] = Some(record.at);
            }
            RecordKind::AtomDone { node, .. } if usize::from(node) < nodes => {
                let node = usize::from(node);
                atoms[node] += 1;
                busy[node] += started[node].take().map_or(0.0, |since| record.at.since(since).as_secs_f64());
            }
            _ => {}
        }
    }
    let rate = |node: &usize| f64::from(atoms[*node]) / busy[*node];
    let slowest = (0..nodes).filter(|&node| busy[node] > 0.0).min_by(|one, other| rate(one).total_cmp(&rate(other)))?;
    let node = slowest as NodeId;
    let (name, traced) = (node_name(node), atoms_words(atoms[slowest], language));
    let words = say!(language, "The slowest machine: {name}, {traced}", "A máquina mais lenta: {name}, {traced}");
    let (records, at) = (records.len(), records.last()?.at);
    (nodes > 1).then_some(Landmark { words, records, at, subject: Subject::Node(node) })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::view::tests::sample_runs;

    proptest! {
        #[test]
        fn steps_back_are_the_steps_forward(speeds in prop::collection::vec(0.1..1.0f64, 1..5), atoms in 1..200u32) {
            let log = sample_runs::log(&speeds, atoms);
            for by in StepUnit::ALL {
                let mut places = vec![0];
                while let Some(next) = step(&log, places[places.len() - 1], by, true) {
                    prop_assert!(by.matches(&log.records()[next - 1].kind));
                    places.push(next);
                }
                let mut back = vec![places[places.len() - 1]];
                while let Some(next) = step(&log, back[back.len() - 1], by, false) {
                    back.push(next);
                }
                back.reverse();
                prop_assert_eq!(places, back);
            }
        }
    }

    #[test]
    fn every_atom_is_a_step() {
        let log = sample_runs::log(&[1.0, 0.3], 57);
        let ends = |by: StepUnit| log.records().iter().filter(|record| by.matches(&record.kind)).count();
        assert_eq!(ends(StepUnit::Atom), 57);
        assert!(ends(StepUnit::Lap) >= 2 && ends(StepUnit::Event) > ends(StepUnit::Lap));
    }

    #[test]
    fn landmarks_of_a_run_are_found() {
        let language = Language::English;
        let mut log = sample_runs::log(&[1.0, 1.0, 1.0, 1.0, 0.02], 900);
        // Without these records nobody retires: the last atoms keep all machines busy.
        let retires = |secs, node| Record { at: Time::from_secs(secs), kind: RecordKind::Retired { node } };
        log.add(vec![retires(0.001, 0)]);
        let end = log.end();
        log.add(vec![retires(9e3, 1)]);
        let found = landmarks(&log, language);
        let says = |start: &str| found.iter().find(|mark| mark.words.starts_with(start)).map(|mark| mark.subject);
        assert!(matches!(says("The first offer of help: "), Some(Subject::Message(_))));
        assert!(matches!(says("The biggest transfer: "), Some(Subject::Message(_))));
        assert!(matches!(says("The first machine to retire: "), Some(Subject::Node(0))));
        assert_eq!(says("The slowest machine: 5, "), Some(Subject::Node(4)));
        assert!(matches!(says("The costliest atom: "), Some(Subject::Atom(_))));
        assert!(found.iter().all(|mark| log.records()[mark.records - 1].at == mark.at));
        assert!(found.iter().all(|mark| mark.at <= end), "no landmark is after the end: {found:?}");
        assert_eq!(landmarks(&RunLog::new(log.header), language), []);
    }
}
