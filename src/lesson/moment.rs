//! The moments of a run to which steps of a lesson go.

use serde::Deserialize;

use crate::balance::{Message, Party};
use crate::picture::atoms_in;
use crate::record::{Record, RecordKind};
use crate::runlog::RunLog;
use crate::time::Time;
use crate::view::Subject;

/// A moment of a run.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub enum Moment {
    /// Before anything has happened.
    Start,
    /// A time after the beginning, in seconds.
    Seconds(f64),
    /// When a share of the atoms is traced, 0 to 1.
    Traced(f64),
    /// A machine offers help for the first time.
    FirstOffer,
    /// Atoms go from one machine to another for the first time.
    FirstTransfer,
    /// The transfer of most atoms; the first of equals.
    BiggestTransfer,
    /// The transfer of fewest atoms; the last of equals.
    SmallestTransfer,
    /// A machine's own offer comes back for the first time: it retires, or sleeps in the adaptive ring.
    FirstRetired,
    /// The condition of a machine changes for the first time.
    FirstFailure,
    /// The ring closes round a machine, or opens for one, for the first time.
    FirstGone,
    /// Late or lost atoms are given out again for the first time.
    FirstAgain,
    /// A sleeping machine is woken for the first time.
    FirstWake,
    /// From here on only one machine traces.
    LastAlone,
    /// Everything has happened.
    End,
}

impl Moment {
    /// Returns the number of records up to the moment, and the subject of the last of them. `None` if the run does not
    /// have the moment.
    pub fn of(self, log: &RunLog) -> Option<(usize, Option<Subject>)> {
        let records = log.records();
        let first = |is_it: &dyn Fn(&RecordKind) -> bool| records.iter().position(|record| is_it(&record.kind));
        let index = match self {
            Self::Start => return Some((0, None)),
            Self::End => return Some((records.len(), None)),
            Self::Seconds(seconds) => {
                let (at, end) = (Time::from_secs(seconds), records.last()?.at);
                return (at <= end).then(|| (log.until(at), None));
            }
            Self::Traced(part) => {
                let wanted = (part * f64::from(log.header.division.atoms())).ceil() as usize;
                let mut done = (0..records.len()).filter(|&i| matches!(records[i].kind, RecordKind::AtomDone { .. }));
                return Some((done.nth(wanted.saturating_sub(1))? + 1, None));
            }
            Self::FirstOffer => first(&|kind| is_own_offer(kind)),
            Self::FirstTransfer => first(&|kind| moved(kind) > 0),
            Self::BiggestTransfer => {
                transfers(records).max_by_key(|&(i, atoms)| (atoms, std::cmp::Reverse(i))).map(|(i, _)| i)
            }
            Self::SmallestTransfer => {
                transfers(records).min_by_key(|&(i, atoms)| (atoms, std::cmp::Reverse(i))).map(|(i, _)| i)
            }
            Self::FirstRetired => first(&|kind| matches!(kind, RecordKind::Retired { .. })),
            Self::FirstFailure => first(&|kind| matches!(kind, RecordKind::Condition { .. })),
            Self::FirstGone => records.iter().position(|record| {
                // At time 0 the ring closes round the spare machines, which are off at first.
                record.at > Time::ZERO && matches!(record.kind, RecordKind::Sent { message: Message::Gone(_), .. })
            }),
            Self::FirstAgain => first(&|kind| matches!(kind, RecordKind::Sent { message: Message::Again(_), .. })),
            Self::FirstWake => first(&|kind| matches!(kind, RecordKind::Sent { message: Message::Wake, .. })),
            Self::LastAlone => alone(log),
        }?;
        let about = match &records[index].kind {
            RecordKind::Sent { id, .. } => Some(Subject::Message(*id)),
            RecordKind::Retired { node } | RecordKind::Condition { node, .. } => Some(Subject::Node(*node)),
            _ => None,
        };
        Some((index + 1, about))
    }
}

fn is_own_offer(kind: &RecordKind) -> bool {
    matches!(kind, RecordKind::Sent { from: Party::Node(from), message, .. } if message.own_offer(*from).is_some())
}

/// The number of atoms that the record sends from one machine to another.
fn moved(kind: &RecordKind) -> u32 {
    match kind {
        RecordKind::Sent { message: Message::Transfer(ranges), .. } => atoms_in(ranges),
        _ => 0,
    }
}

/// The transfers: index of the record, and number of atoms.
fn transfers(records: &[Record]) -> impl Iterator<Item = (usize, u32)> {
    records.iter().enumerate().map(|(i, record)| (i, moved(&record.kind))).filter(|(_, atoms)| *atoms > 0)
}

/// The index of the last atom's record of the last machine but one: from there on one machine traces alone.
fn alone(log: &RunLog) -> Option<usize> {
    let mut ends = vec![None; log.header.speeds.len()];
    for (i, record) in log.records().iter().enumerate() {
        if let RecordKind::AtomDone { node, .. } = record.kind
            && let Some(end) = ends.get_mut(usize::from(node))
        {
            *end = Some(i);
        }
    }
    let mut ends: Vec<usize> = ends.into_iter().flatten().collect();
    ends.sort_unstable();
    ends.pop();
    ends.pop()
}
