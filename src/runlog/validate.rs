//! Validates headers and records of run files, so that views and metrics can rely on them.

use std::ops::Range;
use std::time::Duration;

use thiserror::Error;

use super::Header;
use crate::balance::{Message, NodeId, Party, estimate};
use crate::picture::{Atom, Division, QualityError, Size, SizeError};
use crate::record::{Record, RecordKind};
use crate::time::Time;

/// Longest time of a message, a delay and the parent's handling.
const HOUR: Duration = Duration::from_secs(3600);
/// Longest time of an atom and of a beat; it keeps sums of times in range.
const YEAR: Duration = Duration::from_secs(365 * 24 * 3600);
/// Bound of a message's size in bytes; the whole picture in one message is smaller.
const MAX_MESSAGE_BYTES: u64 = 1 << 32;
/// Most pixels in all messages of a run: more than thirty times the largest picture, while a run sends every pixel a
/// few times.
const MAX_PIXELS_SENT: u64 = u32::MAX as u64;

/// Why a header is invalid.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum InvalidHeader {
    /// The size of the picture is impossible.
    #[error(transparent)]
    Size(SizeError),
    /// The quality is impossible.
    #[error(transparent)]
    Quality(QualityError),
    /// The division does not fit the size of the picture.
    #[error("the number of atoms does not fit the size of the picture")]
    WrongDivision,
    /// A run has at most [`Division::MAX_ATOMS`] atoms.
    #[error("there are too many atoms for a run")]
    TooManyAtoms,
    /// A run has 1 to 1024 nodes.
    #[error("there must be 1 to 1024 speeds")]
    WrongNumberOfSpeeds,
    /// At least one machine must be on at first.
    #[error("all machines are spares; at least one must be on")]
    OnlySpares,
    /// No other strategy lets machines join.
    #[error("only the adaptive ring and the farm with leases can have spare machines")]
    SparesCannotJoin,
    /// More nodes have links of their own than there are nodes.
    #[error("there are more links than speeds")]
    WrongNumberOfLinks,
    /// A latency or a handling time is longer than an hour.
    #[error("a message takes longer than an hour")]
    SlowMessages,
    /// The interval of the heartbeat is out of range.
    #[error("the beat is not between a millisecond and a year")]
    ImpossibleBeat,
    /// A speed is out of range.
    #[error("a speed is not between 0 and 1")]
    ImpossibleSpeed,
    /// The pace is out of range.
    #[error("the pace is not above 0, or is above 1")]
    ImpossiblePace,
    /// The bandwidth is out of range.
    #[error("the bandwidth is not above 0")]
    ImpossibleBandwidth,
}

/// Why a record is invalid.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum InvalidRecord {
    /// Records must be in the order of time.
    #[error("this record is earlier than the one before")]
    NotInOrder,
    /// A message arrives before it is sent.
    #[error("a message arrives before it is sent")]
    ArrivesBeforeSent,
    /// A message has more bytes than the whole picture.
    #[error("a message is larger than the whole picture")]
    HeavyMessage,
    /// A speed is out of range.
    #[error("a speed is not between 0 and 1")]
    ImpossibleSpeed,
    /// A delay is longer than an hour.
    #[error("a delay is longer than an hour")]
    LongDelay,
    /// A latency or a handling time is longer than an hour.
    #[error("a message takes longer than an hour")]
    SlowMessages,
    /// An estimate has another number of stretches than the picture.
    #[error("the estimate is not for this picture")]
    WrongSample,
    /// All messages together carry more atoms than a run can send.
    #[error("the messages so far carry more atoms than a run can send")]
    TooManyAtomsSent,
    /// A range exceeds the atoms of the picture.
    #[error("there are no atoms of these numbers")]
    UnknownAtoms,
    /// The picture has no atom of this number.
    #[error("there is no atom of this number")]
    UnknownAtom,
    /// An atom costs more than a year.
    #[error("an atom takes longer than a year")]
    ImpossibleCost,
    /// The header has no node of this number.
    #[error("there is no node of this number")]
    UnknownNode,
}

/// Checks a header.
pub(super) fn header(header: &Header) -> Result<(), InvalidHeader> {
    let size = Size::new(header.size.width(), header.size.height()).map_err(InvalidHeader::Size)?;
    ensure(
        header.division == Division::new(size.pixels(), header.division.atom_pixels()),
        InvalidHeader::WrongDivision,
    )?;
    ensure(header.division.atoms() <= Division::MAX_ATOMS, InvalidHeader::TooManyAtoms)?;
    header.quality.check().map_err(InvalidHeader::Quality)?;
    ensure((1..=1024).contains(&header.speeds.len()), InvalidHeader::WrongNumberOfSpeeds)?;
    ensure(usize::from(header.spares) < header.speeds.len(), InvalidHeader::OnlySpares)?;
    ensure(header.spares == 0 || header.rules.strategy.survives_losses(), InvalidHeader::SparesCannotJoin)?;
    let link = &header.link;
    let own = || link.nodes.iter().chain([&link.parent]);
    ensure(link.nodes.len() <= header.speeds.len(), InvalidHeader::WrongNumberOfLinks)?;
    let latencies = own().filter_map(|own| own.latency).chain([link.latency, header.handling]);
    ensure(latencies.max() <= Some(HOUR), InvalidHeader::SlowMessages)?;
    let beat = header.rules.beat;
    ensure(beat >= Duration::from_millis(1) && beat <= YEAR, InvalidHeader::ImpossibleBeat)?;
    ensure(header.speeds.iter().all(|speed| (0.0..=1.0).contains(speed)), InvalidHeader::ImpossibleSpeed)?;
    ensure(header.pace > 0.0 && header.pace <= 1.0, InvalidHeader::ImpossiblePace)?;
    let mut bandwidths = own().filter_map(|own| own.bandwidth).chain(link.bandwidth);
    ensure(bandwidths.all(|bandwidth| bandwidth > 0.0), InvalidHeader::ImpossibleBandwidth)
}

/// Checks the records of a run, one after the other.
pub(super) struct Checker<'a> {
    header: &'a Header,
    last: Time,
    /// Pixels in all messages so far, traced or not traced.
    sent: u64,
}

impl<'a> Checker<'a> {
    /// Creates a checker for the records under this header.
    pub fn new(header: &'a Header) -> Self {
        Self { header, last: Time::ZERO, sent: 0 }
    }

    /// Checks the next record.
    pub fn record(&mut self, record: &Record) -> Result<(), InvalidRecord> {
        let header = self.header;
        ensure(record.at >= self.last, InvalidRecord::NotInOrder)?;
        self.last = record.at;
        match &record.kind {
            RecordKind::Sent { from, to, message, bytes, arrives, .. } => {
                party(header, *from)?;
                party(header, *to)?;
                ensure(*arrives >= record.at, InvalidRecord::ArrivesBeforeSent)?;
                ensure(*bytes < MAX_MESSAGE_BYTES, InvalidRecord::HeavyMessage)?;
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
                ensure((0.0..=1.0).contains(speed), InvalidRecord::ImpossibleSpeed)?;
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
                ensure(until.since(record.at) <= HOUR, InvalidRecord::LongDelay)
            }
            RecordKind::AtomFailed { node: id, atom } => {
                self.atom(*atom)?;
                node(header, *id)
            }
            RecordKind::GivenUp { atom } => self.atom(*atom),
            RecordKind::LatencySet { latency } => ensure(*latency <= HOUR, InvalidRecord::SlowMessages),
            RecordKind::OwnLatencySet { party: of, latency } => {
                party(header, *of)?;
                ensure(latency.unwrap_or_default() <= HOUR, InvalidRecord::SlowMessages)
            }
            RecordKind::Estimated { costs } => {
                let stretches = estimate::samples(header.division).len();
                ensure(costs.len() == stretches, InvalidRecord::WrongSample)?;
                costs.iter().try_for_each(possible_cost)
            }
            RecordKind::Estimating | RecordKind::Lost { .. } | RecordKind::Finished => Ok(()),
        }
    }

    fn message(&mut self, message: &Message) -> Result<(), InvalidRecord> {
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
            Message::Request | Message::Join | Message::Wake | Message::Shutdown => Ok(()),
        }
    }

    fn atoms(&mut self, range: &Range<Atom>) -> Result<(), InvalidRecord> {
        let division = self.header.division;
        self.range(range)?;
        self.sent += u64::from(division.pixels_in(range));
        ensure(self.sent <= MAX_PIXELS_SENT, InvalidRecord::TooManyAtomsSent)
    }

    fn range(&self, range: &Range<Atom>) -> Result<(), InvalidRecord> {
        let atoms = self.header.division.atoms();
        ensure(range.start <= range.end && range.end <= atoms, InvalidRecord::UnknownAtoms)
    }

    fn atom(&self, atom: Atom) -> Result<(), InvalidRecord> {
        ensure(atom < self.header.division.atoms(), InvalidRecord::UnknownAtom)
    }
}

fn party(header: &Header, party: Party) -> Result<(), InvalidRecord> {
    match party {
        Party::Parent => Ok(()),
        Party::Node(id) => node(header, id),
    }
}

fn possible_cost(cost: &Duration) -> Result<(), InvalidRecord> {
    ensure(*cost <= YEAR, InvalidRecord::ImpossibleCost)
}

fn node(header: &Header, node: NodeId) -> Result<(), InvalidRecord> {
    ensure(usize::from(node) < header.speeds.len(), InvalidRecord::UnknownNode)
}

fn ensure<E>(possible: bool, why: E) -> Result<(), E> {
    if possible { Ok(()) } else { Err(why) }
}

#[cfg(test)]
mod tests {
    use super::super::examples;
    use super::super::examples::{at, done, sent};
    use super::*;
    use crate::balance::Strategy;

    /// Checks the records of a run with one node up to the first that is refused.
    fn check(records: &[Record]) -> Result<(), InvalidRecord> {
        let header = examples::header(&[1.0]);
        let mut checker = Checker::new(&header);
        records.iter().try_for_each(|record| checker.record(record))
    }

    #[test]
    fn impossible_costs_and_sizes_are_refused() {
        let (parent, node) = (Party::Parent, Party::Node(0));
        assert_eq!(check(&[sent(1, parent, node, Message::Band(0..20)), done(2, 0, 0, 9)]), Ok(()));
        let long = done(2, 0, 0, 2 * YEAR.as_secs());
        assert_eq!(check(&[long]), Err(InvalidRecord::ImpossibleCost));
        let sample = at(2, RecordKind::Estimated { costs: vec![Duration::MAX] });
        assert_eq!(check(&[sample]), Err(InvalidRecord::ImpossibleCost));
        let heavy = RecordKind::Sent {
            id: 0,
            from: parent,
            to: node,
            message: Message::Shutdown,
            bytes: MAX_MESSAGE_BYTES,
            arrives: Time(9),
        };
        assert_eq!(check(&[at(0, heavy)]), Err(InvalidRecord::HeavyMessage));
    }

    #[test]
    fn run_that_sends_atoms_too_often_is_refused() {
        let size = Size::new(10_000, 10_000).expect("a large picture");
        let header = Header::plain(size, 100, Strategy::Ring, vec![1.0]);
        let record = |times| sent(1, Party::Node(0), Party::Parent, Message::Results(vec![0..1_000_000; times]));
        let mut checker = Checker::new(&header);
        assert_eq!(checker.record(&record(20)), Ok(()));
        assert_eq!(checker.record(&record(23)), Err(InvalidRecord::TooManyAtomsSent));
    }

    #[test]
    fn picture_with_too_many_atoms_is_refused() {
        let size = Size::new(4097, 4096).expect("a large picture");
        let plain = Header::plain(size, 1, Strategy::Ring, vec![1.0]);
        assert_eq!(header(&plain), Err(InvalidHeader::TooManyAtoms));
        assert_eq!(header(&Header { division: Division::new(size.pixels(), 2), ..plain }), Ok(()));
    }
}
