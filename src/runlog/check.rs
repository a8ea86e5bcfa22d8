//! Whether what a file says is possible, so that nobody who shows or counts a loaded run has to ask again.

use std::ops::Range;
use std::time::Duration;

use super::Header;
use crate::balance::{Message, NodeId, Party, estimate};
use crate::picture::{Atom, Division, Size};
use crate::record::{Record, What};

/// Nobody waits longer for a message.
const HOUR: Duration = Duration::from_secs(3600);

/// What is impossible about a header.
pub(super) fn header(header: &Header) -> Result<(), String> {
    let size = Size::new(header.size.width(), header.size.height())?;
    ensure(
        header.division == Division::new(size.pixels(), header.division.atom_pixels()),
        "the division is not that of a picture of this size",
    )?;
    ensure((1..=64).contains(&header.samples), "the samples are not 1 to 64")?;
    ensure((1..=1024).contains(&header.speeds.len()), "there must be 1 to 1024 speeds")?;
    ensure(header.link.latency <= HOUR && header.handling <= HOUR, "a message takes longer than an hour")?;
    ensure(header.speeds.iter().all(|speed| (0.0..=1.0).contains(speed)), "a speed is not between 0 and 1")?;
    ensure(header.pace > 0.0 && header.pace <= 1.0, "the pace is not above 0 and at most 1")?;
    ensure(header.link.bandwidth.is_none_or(|bandwidth| bandwidth > 0.0), "the bandwidth is not above 0")
}

/// What is impossible about a record of a run with this header.
pub(super) fn record(header: &Header, record: &Record) -> Result<(), String> {
    let atoms = header.division.atoms();
    let party = |party| match party {
        Party::Parent => Ok(()),
        Party::Node(id) => node(header, id),
    };
    match &record.what {
        What::Sent { from, to, message: said, arrives, .. } => {
            party(*from)?;
            party(*to)?;
            ensure(*arrives >= record.at, "a message arrives before it is sent")?;
            message(header, said)
        }
        What::Received { by, .. } => party(*by),
        What::AtomStarted { node: id, atom } | What::AtomDone { node: id, atom, .. } => {
            ensure(*atom < atoms, "there is no such atom")?;
            node(header, *id)
        }
        What::SpeedSet { node: id, speed } => {
            ensure((0.0..=1.0).contains(speed), "a speed is not between 0 and 1")?;
            node(header, *id)
        }
        What::Paused { node: id } | What::Resumed { node: id } | What::Retired { node: id } => node(header, *id),
        What::LatencySet { latency } => ensure(*latency <= HOUR, "a message takes longer than an hour"),
        What::Estimated { costs } => {
            let stretches = estimate::samples(header.division).len();
            ensure(costs.len() == stretches, "the sample is not of this picture")
        }
        What::Estimating | What::Finished => Ok(()),
    }
}

fn message(header: &Header, message: &Message) -> Result<(), String> {
    let possible = |range: &Range<Atom>| {
        ensure(range.start <= range.end && range.end <= header.division.atoms(), "there are no such atoms")
    };
    match message {
        Message::Band(range) | Message::Part(range) => possible(range),
        Message::Transfer(ranges) | Message::Results(ranges) => ranges.iter().try_for_each(possible),
        Message::Offer { who, .. } => node(header, *who),
        Message::Request | Message::Shutdown => Ok(()),
    }
}

fn node(header: &Header, node: NodeId) -> Result<(), String> {
    ensure(usize::from(node) < header.speeds.len(), "there is no such node")
}

fn ensure(possible: bool, why: &str) -> Result<(), String> {
    if possible { Ok(()) } else { Err(why.to_owned()) }
}
