//! Whether what a file says is possible, so that nobody who shows or counts a loaded run has to ask again.

use std::ops::Range;
use std::time::Duration;

use super::Header;
use crate::balance::{Message, NodeId, Party, Strategy, estimate};
use crate::picture::{Atom, Division, Size};
use crate::record::{Record, RecordKind};
use crate::time::Time;

/// Nobody waits longer for a message.
const HOUR: Duration = Duration::from_secs(3600);
/// No atom takes longer, so that sums of what they take have an end.
const YEAR: Duration = Duration::from_secs(365 * 24 * 3600);
/// Not even the whole picture as one message weighs as much, in bytes.
const HEAVIEST: u64 = 1 << 32;
/// A run sends every pixel a few times at most. So many are more than the largest picture thirty times.
const MOST_SENT: u64 = u32::MAX as u64;

/// What is impossible about a header.
pub(super) fn header(header: &Header) -> Result<(), String> {
    let size = Size::new(header.size.width(), header.size.height())?;
    ensure(
        header.division == Division::new(size.pixels(), header.division.atom_pixels()),
        "the division is not that of a picture of this size",
    )?;
    ensure(header.division.atoms() <= Division::MAX_ATOMS, "there are more atoms than a run can have")?;
    header.quality.check()?;
    ensure((1..=1024).contains(&header.speeds.len()), "there must be 1 to 1024 speeds")?;
    ensure(usize::from(header.spares) < header.speeds.len(), "all machines are spares")?;
    ensure(header.spares == 0 || header.rules.strategy == Strategy::Adaptive, "only a ring that adapts has spares")?;
    ensure(header.link.latency <= HOUR && header.handling <= HOUR, "a message takes longer than an hour")?;
    let beat = header.rules.beat;
    ensure(beat >= Duration::from_millis(1) && beat <= YEAR, "a beat is not between a millisecond and a year")?;
    ensure(header.speeds.iter().all(|speed| (0.0..=1.0).contains(speed)), "a speed is not between 0 and 1")?;
    ensure(header.pace > 0.0 && header.pace <= 1.0, "the pace is not above 0 and at most 1")?;
    ensure(header.link.bandwidth.is_none_or(|bandwidth| bandwidth > 0.0), "the bandwidth is not above 0")
}

/// Checks the records of a run, one after the other.
pub(super) struct Checker<'a> {
    header: &'a Header,
    last: Time,
    /// Pixels in all messages so far, traced or not.
    sent: u64,
}

impl<'a> Checker<'a> {
    /// Nothing has happened yet in a run with this header.
    pub fn new(header: &'a Header) -> Self {
        Self { header, last: Time::ZERO, sent: 0 }
    }

    /// What is impossible about the next record.
    pub fn record(&mut self, record: &Record) -> Result<(), String> {
        let header = self.header;
        ensure(record.at >= self.last, "this record is earlier than the one before")?;
        self.last = record.at;
        match &record.what {
            RecordKind::Sent { from, to, message, bytes, arrives, .. } => {
                party(header, *from)?;
                party(header, *to)?;
                ensure(*arrives >= record.at, "a message arrives before it is sent")?;
                ensure(*bytes < HEAVIEST, "a message is heavier than any can be")?;
                self.message(message)
            }
            RecordKind::Received { by, .. } => party(header, *by),
            RecordKind::AtomStarted { node: id, atom } => {
                self.atom(*atom)?;
                node(header, *id)
            }
            RecordKind::AtomDone { node: id, atom, cost } => {
                self.atom(*atom)?;
                possible_cost(cost)?;
                node(header, *id)
            }
            RecordKind::SpeedSet { node: id, speed } => {
                ensure((0.0..=1.0).contains(speed), "a speed is not between 0 and 1")?;
                node(header, *id)
            }
            RecordKind::Paused { node: id } | RecordKind::Resumed { node: id } | RecordKind::Retired { node: id } => {
                node(header, *id)
            }
            RecordKind::Condition { node: id, .. } => node(header, *id),
            RecordKind::Link { one, other, .. } => {
                party(header, *one)?;
                party(header, *other)
            }
            RecordKind::Delayed { from, to, until } => {
                party(header, *from)?;
                party(header, *to)?;
                ensure(until.since(record.at) <= HOUR, "messages are held up for more than an hour")
            }
            RecordKind::AtomFailed { node: id, atom } => {
                self.atom(*atom)?;
                node(header, *id)
            }
            RecordKind::GivenUp { atom } => self.atom(*atom),
            RecordKind::LatencySet { latency } => ensure(*latency <= HOUR, "a message takes longer than an hour"),
            RecordKind::Estimated { costs } => {
                let stretches = estimate::samples(header.division).len();
                ensure(costs.len() == stretches, "the sample is not of this picture")?;
                costs.iter().try_for_each(possible_cost)
            }
            RecordKind::Estimating | RecordKind::Lost { .. } | RecordKind::Finished => Ok(()),
        }
    }

    fn message(&mut self, message: &Message) -> Result<(), String> {
        match message {
            Message::Band(range) | Message::Part(range) => self.atoms(range),
            Message::Transfer(ranges) | Message::Results(ranges) | Message::Again(ranges) => {
                ranges.iter().try_for_each(|range| self.atoms(range))
            }
            Message::Beat { holds: ranges, .. } | Message::Placed(ranges) => {
                ranges.iter().try_for_each(|range| self.range(range))
            }
            Message::Gone(nodes) => nodes.iter().try_for_each(|id| node(self.header, *id)),
            Message::Failed(atom) => self.atom(*atom),
            Message::Offer { who, .. } => node(self.header, *who),
            Message::Request | Message::Wake | Message::Shutdown => Ok(()),
        }
    }

    fn atoms(&mut self, range: &Range<Atom>) -> Result<(), String> {
        let division = self.header.division;
        self.range(range)?;
        self.sent += u64::from(division.pixels_in(range));
        ensure(self.sent <= MOST_SENT, "by now more atoms have been sent than a run can send")
    }

    fn range(&self, range: &Range<Atom>) -> Result<(), String> {
        let atoms = self.header.division.atoms();
        ensure(range.start <= range.end && range.end <= atoms, "there are no such atoms")
    }

    fn atom(&self, atom: Atom) -> Result<(), String> {
        ensure(atom < self.header.division.atoms(), "there is no such atom")
    }
}

fn party(header: &Header, party: Party) -> Result<(), String> {
    match party {
        Party::Parent => Ok(()),
        Party::Node(id) => node(header, id),
    }
}

fn possible_cost(cost: &Duration) -> Result<(), String> {
    ensure(*cost <= YEAR, "an atom takes longer than a year")
}

fn node(header: &Header, node: NodeId) -> Result<(), String> {
    ensure(usize::from(node) < header.speeds.len(), "there is no such node")
}

fn ensure(possible: bool, why: &str) -> Result<(), String> {
    if possible { Ok(()) } else { Err(why.to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::super::examples;
    use super::super::examples::{at, done, sent};
    use super::*;

    /// What is said of the first record that is refused.
    fn complaint(records: &[Record]) -> Result<(), String> {
        let header = examples::header(&[1.0]);
        let mut checker = Checker::new(&header);
        records.iter().try_for_each(|record| checker.record(record))
    }

    #[test]
    fn what_no_run_amounts_to_is_refused() {
        let (parent, node) = (Party::Parent, Party::Node(0));
        assert_eq!(complaint(&[sent(1, parent, node, Message::Band(0..20)), done(2, 0, 0, 9)]), Ok(()));
        let long = done(2, 0, 0, 2 * YEAR.as_secs());
        assert_eq!(complaint(&[long]), Err("an atom takes longer than a year".into()));
        let sample = at(2, RecordKind::Estimated { costs: vec![Duration::MAX] });
        assert_eq!(complaint(&[sample]), Err("an atom takes longer than a year".into()));
        let heavy = RecordKind::Sent {
            id: 0,
            from: parent,
            to: node,
            message: Message::Shutdown,
            bytes: HEAVIEST,
            arrives: Time(9),
        };
        assert_eq!(complaint(&[at(0, heavy)]), Err("a message is heavier than any can be".into()));
    }

    #[test]
    fn a_run_that_sends_its_atoms_again_and_again_is_refused() {
        let size = Size::new(10_000, 10_000).expect("a large picture");
        let header = Header::plain(size, 100, Strategy::Ring, vec![1.0]);
        let record = |times| sent(1, Party::Node(0), Party::Parent, Message::Results(vec![0..1_000_000; times]));
        let mut checker = Checker::new(&header);
        assert_eq!(checker.record(&record(20)), Ok(()));
        assert_eq!(checker.record(&record(23)), Err("by now more atoms have been sent than a run can send".into()));
    }

    #[test]
    fn a_picture_of_more_atoms_than_a_run_can_have_is_refused() {
        let size = Size::new(4097, 4096).expect("a large picture");
        let plain = Header::plain(size, 1, Strategy::Ring, vec![1.0]);
        assert_eq!(header(&plain), Err("there are more atoms than a run can have".into()));
        assert_eq!(header(&Header { division: Division::new(size.pixels(), 2), ..plain }), Ok(()));
    }
}
