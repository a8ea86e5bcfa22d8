//! The records of a run as CSV, one row per record, in order of time.

use std::io::{self, Write};
use std::ops::Range;
use std::time::Duration;

use serde::Serialize;

use super::party_name;
use crate::balance::{Condition, Message, NodeId, OfferDetails, Party};
use crate::picture::{Atom, atoms_in};
use crate::record::{Record, RecordKind};
use crate::runlog::RunLog;
use crate::time::Time;

/// The row of a record. Fields that a record does not have are empty; machines are numbered from 1, as in the window.
#[derive(Default, Serialize)]
struct RecordRow {
    /// Seconds since the run began, to the nanosecond.
    time_s: String,
    /// Kind of the record.
    what: &'static str,
    /// The machine of the event.
    node: Option<String>,
    /// Sender of the message.
    from: Option<String>,
    /// Receiver of the message.
    to: Option<String>,
    /// Number of the message in the run.
    message: Option<u64>,
    /// The machine that made the offer.
    offerer: Option<String>,
    /// The atoms, as `4` or `4-9`, separated by spaces.
    atoms: Option<String>,
    /// Number of atoms; of an offer, the number that its machine has traced.
    count: Option<u32>,
    /// Size of the message.
    bytes: Option<u64>,
    /// Time of arrival.
    arrives_s: Option<String>,
    /// CPU seconds in the tracer.
    cost_s: Option<String>,
    /// New speed, as a fraction of the reference machine's.
    speed: Option<f64>,
    /// New latency of all nodes, or of one; of a delay, its duration.
    latency_s: Option<String>,
}

/// Writes the records of a run as CSV, with a header row.
///
/// # Errors
/// The error of writing to `to`.
pub fn write_csv(to: impl Write, log: &RunLog) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(to);
    if log.records().is_empty() {
        // Without a row the writer would omit the header.
        table.write_record(COLUMNS)?;
    }
    log.records().iter().try_for_each(|record| table.serialize(row(record)))?;
    table.flush()
}

const COLUMNS: [&str; 14] = [
    "time_s",
    "what",
    "node",
    "from",
    "to",
    "message",
    "offerer",
    "atoms",
    "count",
    "bytes",
    "arrives_s",
    "cost_s",
    "speed",
    "latency_s",
];

fn row(record: &Record) -> RecordRow {
    let of = |what, node: NodeId| RecordRow { what, node: Some(party_name(Party::Node(node))), ..RecordRow::default() };
    let row = match &record.kind {
        RecordKind::Sent { id, from, to, message, bytes, arrives } => RecordRow {
            from: Some(party_name(*from)),
            to: Some(party_name(*to)),
            message: Some(*id),
            bytes: Some(*bytes),
            arrives_s: Some(at(*arrives)),
            ..sent(*from, message)
        },
        RecordKind::Received { id, by } => {
            RecordRow { what: "received", node: Some(party_name(*by)), message: Some(*id), ..RecordRow::default() }
        }
        RecordKind::AtomStarted { node, atom } => {
            RecordRow { atoms: Some(atom.to_string()), count: Some(1), ..of("started", *node) }
        }
        RecordKind::AtomDone { node, atom, cost } => RecordRow {
            atoms: Some(atom.to_string()),
            count: Some(1),
            cost_s: Some(seconds(*cost)),
            ..of("done", *node)
        },
        RecordKind::SpeedSet { node, speed } => RecordRow { speed: Some(*speed), ..of("speed", *node) },
        RecordKind::Paused { node } => of("paused", *node),
        RecordKind::Resumed { node } => of("resumed", *node),
        RecordKind::Retired { node } => of("retired", *node),
        RecordKind::LatencySet { latency } => {
            RecordRow { what: "latency", latency_s: Some(seconds(*latency)), ..RecordRow::default() }
        }
        RecordKind::OwnLatencySet { party, latency } => RecordRow {
            what: "own latency",
            node: Some(party_name(*party)),
            latency_s: latency.map(seconds),
            ..RecordRow::default()
        },
        RecordKind::Estimating => RecordRow { what: "estimating", ..RecordRow::default() },
        RecordKind::Estimated { costs } => {
            RecordRow { what: "estimated", cost_s: Some(seconds(costs.iter().sum())), ..RecordRow::default() }
        }
        RecordKind::Condition { node, condition } => {
            let what = match condition {
                Condition::Well => "well",
                Condition::Hung => "hung",
                Condition::CutOff => "cut off",
                Condition::Off => "off",
            };
            of(what, *node)
        }
        RecordKind::Link { one, other, cut } => {
            let what = if *cut { "link cut" } else { "link mended" };
            RecordRow { what, from: Some(party_name(*one)), to: Some(party_name(*other)), ..RecordRow::default() }
        }
        RecordKind::Delayed { from, to, until } => RecordRow {
            what: "held up",
            from: Some(party_name(*from)),
            to: Some(party_name(*to)),
            latency_s: Some(seconds(until.since(record.at))),
            ..RecordRow::default()
        },
        RecordKind::Lost { id } => RecordRow { what: "lost", message: Some(*id), ..RecordRow::default() },
        RecordKind::AtomFailed { node, atom } => {
            RecordRow { atoms: Some(atom.to_string()), count: Some(1), ..of("failed", *node) }
        }
        RecordKind::GivenUp { atom } => {
            RecordRow { what: "given up", atoms: Some(atom.to_string()), ..RecordRow::default() }
        }
        RecordKind::Finished => RecordRow { what: "finished", ..RecordRow::default() },
    };
    RecordRow { time_s: at(record.at), ..row }
}

/// Makes the part of a sent message's row that depends on its kind.
fn sent(from: Party, message: &Message) -> RecordRow {
    let ranges = message.ranges();
    let carried =
        |what| RecordRow { what, atoms: Some(atoms(ranges)), count: Some(atoms_in(ranges)), ..RecordRow::default() };
    match message {
        Message::Band(_) => carried("band"),
        Message::Part(_) => carried("part"),
        Message::Transfer(_) => carried("transfer"),
        Message::Results(_) => carried("results"),
        Message::Request => RecordRow { what: "request", ..RecordRow::default() },
        Message::Join => RecordRow { what: "join", ..RecordRow::default() },
        Message::Again(_) => carried("again"),
        Message::Wake => RecordRow { what: "wake", ..RecordRow::default() },
        Message::Beat { holds, .. } => {
            RecordRow { what: "beat", atoms: Some(atoms(holds)), count: Some(atoms_in(holds)), ..RecordRow::default() }
        }
        Message::Gone(nodes) => RecordRow { what: "gone", count: Some(nodes.len() as u32), ..RecordRow::default() },
        Message::Placed(placed) => RecordRow {
            what: "placed",
            atoms: Some(atoms(placed)),
            count: Some(atoms_in(placed)),
            ..RecordRow::default()
        },
        Message::Failed(atom) => RecordRow { what: "failed", atoms: Some(atom.to_string()), ..RecordRow::default() },
        Message::Shutdown => RecordRow { what: "shutdown", ..RecordRow::default() },
        Message::Offer { who, done, help } => {
            let what = match help {
                Some(OfferDetails { left: None, .. }) => "note",
                _ if from == Party::Node(*who) => "offer",
                _ => "hop",
            };
            RecordRow { what, offerer: Some(party_name(Party::Node(*who))), count: Some(*done), ..RecordRow::default() }
        }
    }
}

fn atoms(ranges: &[Range<Atom>]) -> String {
    let shown = |range: &Range<Atom>| match range.len() {
        1 => range.start.to_string(),
        _ => format!("{}-{}", range.start, range.end - 1),
    };
    let ranges: Vec<_> = ranges.iter().filter(|range| !range.is_empty()).map(shown).collect();
    ranges.join(" ")
}

fn at(time: Time) -> String {
    seconds(Duration::from_nanos(time.0))
}

/// Formats seconds with nine decimals, without loss.
fn seconds(length: Duration) -> String {
    format!("{}.{:09}", length.as_secs(), length.subsec_nanos())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use proptest::prelude::*;

    use super::*;
    use crate::balance::Strategy as Sharing;
    use crate::picture::Size;
    use crate::runlog::{Driver, Header, Metrics};
    use crate::sim::Sim;

    fn log(speeds: Vec<f64>, pixels: u32, strategy: Sharing) -> RunLog {
        let plain = Header::plain(Size::new(pixels, 10).expect("a small picture"), 10, strategy, speeds);
        let header = Header { driver: Driver::Sim, ..plain };
        let (mut log, mut records) = (RunLog::new(header.clone()), Vec::new());
        Sim::new(&header, &[], |atom| Duration::from_micros(100 + u64::from(atom % 7)))
            .run(&mut |record| records.push(record));
        log.add(records);
        log
    }

    /// Writes the table of a run and reads it back: the rows, by column name.
    fn read(log: &RunLog) -> Vec<BTreeMap<String, String>> {
        let mut text = Vec::new();
        write_csv(&mut text, log).expect("writing to memory cannot fail");
        csv::Reader::from_reader(&text[..]).deserialize().collect::<Result<_, _>>().expect("a table")
    }

    proptest! {
        #[test]
        fn table_matches_records(
            speeds in prop::collection::vec(0.1..1.0f64, 1..6), pixels in 1..60u32, strategy in prop::sample::select(&Sharing::ALL),
        ) {
            let log = log(speeds, pixels, strategy);
            let (rows, metrics) = (read(&log), Metrics::of(&log));
            prop_assert_eq!(rows.len(), log.records().len());
            let rows_of = |what: &str| rows.iter().filter(|row| row["what"] == what).count() as u64;
            let messages = metrics.messages();
            let told = [rows_of("offer"), rows_of("hop"), rows_of("transfer"), rows_of("request"), rows_of("results")];
            let counted = [messages.offers, messages.hops, messages.transfers, messages.requests, messages.results];
            prop_assert_eq!(told, counted);
            let sum = |column: &str| rows.iter().filter_map(|row| row[column].parse::<f64>().ok()).sum::<f64>();
            prop_assert_eq!(sum("bytes") as u64, messages.bytes);
            let costs = rows.iter().filter(|row| row["what"] == "done").map(|row| row["cost_s"].parse::<f64>().expect("a number"));
            prop_assert!((costs.sum::<f64>() - (metrics.work() + metrics.twice()).as_secs_f64()).abs() < 1e-9);
            let times: Vec<f64> = rows.iter().map(|row| row["time_s"].parse().expect("a time")).collect();
            prop_assert!(times.is_sorted());
        }
    }

    #[test]
    fn atoms_are_written_as_ranges() {
        assert_eq!(atoms(&[4..5, 7..7, 9..12]), "4 9-11");
        assert_eq!((at(Time(1)), at(Time(12_000_000_345))), ("0.000000001".into(), "12.000000345".into()));
    }

    #[test]
    fn run_without_records_has_column_names() {
        let some = log(vec![1.0], 1, Sharing::Ring);
        let columns = |log: &RunLog| {
            let mut text = Vec::new();
            write_csv(&mut text, log).expect("writing to memory cannot fail");
            String::from_utf8_lossy(&text).lines().next().map(str::to_owned)
        };
        assert_eq!(columns(&RunLog::new(some.header.clone())), columns(&some));
    }
}
