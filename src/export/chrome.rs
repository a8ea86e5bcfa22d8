//! A run in Chrome's trace format, which Perfetto (<https://ui.perfetto.dev>) shows: the atoms of each machine, the
//! messages in flight, and the share of machines that trace.
//!
//! Machines and messages are separate processes. A slice (`X`) never overlaps another on its track: a machine traces
//! one atom at a time, and messages in flight together have separate tracks. Arrows (`s`, `t`, `f`) lead from an
//! offer's hop to the next and to its answer, and with atoms from their sender to the first of them that the receiver
//! traces.

use std::collections::BTreeMap;
use std::io::{self, Write};

use serde_json::{Value, json};

use super::party_name;
use crate::balance::{Condition, Message, NodeId, Party};
use crate::picture::{Atom, atoms_in};
use crate::record::RecordKind;
use crate::runlog::RunLog;
use crate::time::Time;
use crate::view::{Lanes, Traced, fraction, node_name};

/// Processes of the trace: the machines, and three kinds of messages.
const MACHINES: u32 = 1;
const ATOMS: u32 = 2;
const OFFERS: u32 = 3;
const RESULTS: u32 = 4;

/// Number of intervals for which the share of tracing machines is written.
const INTERVALS: u64 = 400;

/// Writes a run in Chrome's trace format.
///
/// # Errors
/// The error of writing to `to`.
pub fn write_chrome(mut to: impl Write, log: &RunLog) -> io::Result<()> {
    let lanes = Lanes::of(log);
    let header = &log.header;
    let about = json!({
        "scene": header.scene,
        "strategy": header.scheduler().name(),
        "driver": header.driver.name(),
        "title": header.caption.title,
        "memo": header.caption.memo,
        "machine": header.caption.machine,
    });
    write!(to, "{{\"displayTimeUnit\":\"ms\",\"otherData\":{about},\"traceEvents\":[")?;
    let mut events = TraceEvents { to, any: false };
    name_tracks(log, &mut events)?;
    let traced = write_atoms(&lanes, &mut events)?;
    let message_slices = write_messages(log, &mut events)?;
    write_offer_arrows(log, &message_slices, &mut events)?;
    write_atom_arrows(log, &traced, &message_slices, &mut events)?;
    write_instants(log, &mut events)?;
    write_usage(&lanes, &mut events)?;
    writeln!(events.to, "\n]}}")
}

/// Writer of trace events, one a line.
struct TraceEvents<W> {
    to: W,
    any: bool,
}

impl<W: Write> TraceEvents<W> {
    fn put(&mut self, event: &Value) -> io::Result<()> {
        self.to.write_all(if self.any { b",\n" } else { b"\n" })?;
        self.any = true;
        serde_json::to_writer(&mut self.to, event).map_err(io::Error::from)
    }

    /// Writes an arrow through slices; with a single slice it has no end and is omitted.
    fn arrow(&mut self, (id, name): (u64, &str), through: &[TrackPoint]) -> io::Result<()> {
        if through.len() < 2 {
            return Ok(());
        }
        for (i, &TrackPoint { process, track, at }) in through.iter().enumerate() {
            let phase = match i {
                0 => "s",
                _ if i + 1 == through.len() => "f",
                _ => "t",
            };
            let mut event = json!({
                "ph": phase, "cat": "message", "name": name, "id": id, "pid": process, "tid": track, "ts": micros(at),
            });
            if phase == "f" {
                // Binds to the slice that begins here, not to the next one.
                event["bp"] = "e".into();
            }
            self.put(&event)?;
        }
        Ok(())
    }
}

/// A point on a track, which selects the slice that contains it.
#[derive(Clone, Copy)]
struct TrackPoint {
    process: u32,
    track: usize,
    at: Time,
}

/// By atom: the node that traced it, and when.
type AtomPlaces = BTreeMap<Atom, (NodeId, Traced)>;

/// By message: its slice in flight.
type MessageSlices = BTreeMap<u64, TrackPoint>;

fn name_tracks(log: &RunLog, events: &mut TraceEvents<impl Write>) -> io::Result<()> {
    let run = format!("{}, {}", log.header.title(), log.header.scheduler().name());
    let processes = [
        (MACHINES, run.as_str()),
        (ATOMS, "atoms in flight"),
        (OFFERS, "offers and requests in flight"),
        (RESULTS, "results in flight"),
    ];
    for (process, name) in processes {
        let order =
            json!({ "ph": "M", "name": "process_sort_index", "pid": process, "args": { "sort_index": process } });
        events.put(&json!({ "ph": "M", "name": "process_name", "pid": process, "args": { "name": name } }))?;
        events.put(&order)?;
    }
    for (node, speed) in (0..).zip(&log.header.speeds) {
        let name = format!("machine {} ({})", node_name(node), fraction(*speed));
        let track = track_of(node);
        let about =
            |what: &str, args: Value| json!({ "ph": "M", "name": what, "pid": MACHINES, "tid": track, "args": args });
        events.put(&about("thread_name", json!({ "name": name })))?;
        events.put(&about("thread_sort_index", json!({ "sort_index": track })))?;
    }
    Ok(())
}

/// Writes a slice for each atom.
fn write_atoms(lanes: &Lanes, events: &mut TraceEvents<impl Write>) -> io::Result<AtomPlaces> {
    let mut places = AtomPlaces::new();
    for (node, lane) in (0..).zip(lanes.lanes()) {
        let mut free = Time::ZERO;
        for &bar in lane.bars() {
            // Whatever a file says, a machine traces one atom at a time.
            let from = bar.from.max(free);
            free = bar.to.max(from);
            let name = format!("atom {}", bar.atom);
            events.put(&slice(
                &name,
                "atom",
                TrackPoint { process: MACHINES, track: track_of(node), at: from },
                free,
                json!({}),
            ))?;
            places.insert(bar.atom, (node, Traced { from, to: free, ..bar }));
        }
    }
    Ok(places)
}

/// Writes a slice for each message, from departure to arrival, on the first free track of its kind.
fn write_messages(log: &RunLog, events: &mut TraceEvents<impl Write>) -> io::Result<MessageSlices> {
    let mut message_slices = MessageSlices::new();
    // By kind and track: the time until which it is taken.
    let mut taken: BTreeMap<u32, Vec<Time>> = BTreeMap::new();
    for record in log.records() {
        let RecordKind::Sent { id, from, to, message, bytes, arrives } = &record.kind else { continue };
        let (process, what) = match message {
            Message::Band(_) => (ATOMS, "band"),
            Message::Part(_) => (ATOMS, "part"),
            Message::Transfer(_) => (ATOMS, "transfer"),
            Message::Offer { who, .. } if Party::Node(*who) == *from => (OFFERS, "offer"),
            Message::Offer { .. } => (OFFERS, "hop"),
            Message::Request => (OFFERS, "request"),
            Message::Join => (OFFERS, "join"),
            Message::Shutdown => (OFFERS, "shutdown"),
            Message::Results(_) => (RESULTS, "results"),
            Message::Again(_) => (ATOMS, "again"),
            Message::Wake => (OFFERS, "wake"),
            Message::Beat { .. } => (RESULTS, "beat"),
            Message::Gone(_) => (RESULTS, "gone"),
            Message::Placed(_) => (RESULTS, "placed"),
            Message::Failed(_) => (RESULTS, "failed"),
        };
        let tracks = taken.entry(process).or_default();
        let track = tracks.iter().position(|until| *until <= record.at).unwrap_or(tracks.len());
        if track == tracks.len() {
            tracks.push(Time::ZERO);
            let (track, name) = (track + 1, format!("{}", track + 1));
            events.put(&json!({
                "ph": "M", "name": "thread_name", "pid": process, "tid": track, "args": { "name": name },
            }))?;
        }
        tracks[track] = *arrives;
        let place = TrackPoint { process, track: track + 1, at: record.at };
        let name = format!("{what} {} → {}", party_name(*from), party_name(*to));
        let args = json!({ "message": id, "atoms": atoms_in(message.ranges()), "bytes": bytes });
        events.put(&slice(&name, what, place, *arrives, args))?;
        message_slices.insert(*id, place);
    }
    Ok(message_slices)
}

/// Writes an arrow through the hops of each offer, to the transfer that answers it.
fn write_offer_arrows(
    log: &RunLog,
    message_slices: &MessageSlices,
    events: &mut TraceEvents<impl Write>,
) -> io::Result<()> {
    // By machine: the number of its last offer, and the slices of its hops.
    let mut out: BTreeMap<NodeId, (u64, Vec<TrackPoint>)> = BTreeMap::new();
    for record in log.records() {
        let RecordKind::Sent { id, from, to, message, .. } = &record.kind else { continue };
        let Some(&place) = message_slices.get(id) else { continue };
        match (message, to) {
            (Message::Offer { who, .. }, _) => {
                if Party::Node(*who) == *from
                    && let Some((before, through)) = out.insert(*who, (*id, Vec::new()))
                {
                    events.arrow((2 * before, "offer"), &through)?;
                }
                if let Some((_, through)) = out.get_mut(who) {
                    through.push(place);
                }
            }
            (Message::Transfer(_), Party::Node(who)) => {
                if let Some((before, mut through)) = out.remove(who) {
                    through.push(place);
                    events.arrow((2 * before, "offer"), &through)?;
                }
            }
            _ => {}
        }
    }
    let mut left: Vec<_> = out.into_values().collect();
    left.sort_by_key(|(id, _)| *id);
    left.iter().try_for_each(|(id, through)| events.arrow((2 * id, "offer"), through))
}

/// Writes an arrow from the sender of atoms through their message to the first of them that is traced.
fn write_atom_arrows(
    log: &RunLog,
    traced: &AtomPlaces,
    message_slices: &MessageSlices,
    events: &mut TraceEvents<impl Write>,
) -> io::Result<()> {
    // By machine: its traced atoms, by time.
    let mut by_node: BTreeMap<NodeId, Vec<Traced>> = BTreeMap::new();
    traced.values().for_each(|(node, bar)| by_node.entry(*node).or_default().push(*bar));
    by_node.values_mut().for_each(|bars| bars.sort_by_key(|bar| (bar.from, bar.to)));
    for record in log.records() {
        let RecordKind::Sent { id, from, to: Party::Node(to), message, arrives, .. } = &record.kind else { continue };
        if !matches!(message, Message::Band(_) | Message::Part(_) | Message::Transfer(_)) {
            continue;
        }
        let mut through = Vec::new();
        if let Party::Node(giver) = from
            && let Some(bars) = by_node.get(giver)
            && let Some(bar) = bars[..bars.partition_point(|bar| bar.from <= record.at)].last()
            && record.at <= bar.to
        {
            through.push(TrackPoint { process: MACHINES, track: track_of(*giver), at: record.at });
        }
        through.extend(message_slices.get(id));
        let here = message.ranges().iter().cloned().flatten().filter_map(|atom| traced.get(&atom));
        let first = here.filter(|(node, bar)| node == to && bar.from >= *arrives).min_by_key(|(_, bar)| bar.from);
        through.extend(first.map(|(_, bar)| TrackPoint { process: MACHINES, track: track_of(*to), at: bar.from }));
        events.arrow((2 * id + 1, "atoms"), &through)?;
    }
    Ok(())
}

/// Writes an instant for each change of a machine, and for the end.
fn write_instants(log: &RunLog, events: &mut TraceEvents<impl Write>) -> io::Result<()> {
    for record in log.records() {
        let (node, what) = match &record.kind {
            RecordKind::Paused { node } => (Some(*node), "paused".into()),
            RecordKind::Resumed { node } => (Some(*node), "resumed".into()),
            RecordKind::Retired { node } => (Some(*node), "retired".into()),
            RecordKind::Condition { node, condition } => (Some(*node), condition_words(*condition).into()),
            RecordKind::SpeedSet { node, speed } => (Some(*node), format!("speed {:.0} %", 100.0 * speed)),
            RecordKind::LatencySet { latency } => (None, format!("latency {latency:?}")),
            RecordKind::OwnLatencySet { party, latency } => {
                let latency = latency.map_or("none".into(), |latency| format!("{latency:?}"));
                (None, format!("own latency of {}: {latency}", party_name(*party)))
            }
            RecordKind::Finished => (None, "the picture is complete".into()),
            _ => continue,
        };
        let (track, scope) = node.map_or((0, "g"), |node| (track_of(node), "t"));
        let ts = micros(record.at);
        events.put(
            &json!({ "ph": "i", "name": what, "cat": "run", "pid": MACHINES, "tid": track, "ts": ts, "s": scope }),
        )?;
    }
    Ok(())
}

fn condition_words(condition: Condition) -> &'static str {
    match condition {
        Condition::Well => "well again",
        Condition::Hung => "hangs",
        Condition::CutOff => "cut off",
        Condition::Off => "switched off",
    }
}

/// Writes the share of machines that trace, by interval.
fn write_usage(lanes: &Lanes, events: &mut TraceEvents<impl Write>) -> io::Result<()> {
    let bars = || lanes.lanes().iter().flat_map(|lane| lane.bars());
    let end = bars().map(|bar| bar.to.0).max().unwrap_or_default();
    let length = end.div_ceil(INTERVALS).max(1);
    let mut busy = vec![0_u64; INTERVALS as usize];
    for bar in bars() {
        for interval in bar.from.0 / length..=(bar.to.0.saturating_sub(1) / length) {
            let (start, stop) = (interval * length, (interval + 1).saturating_mul(length));
            if let Some(busy) = busy.get_mut(interval as usize) {
                *busy += bar.to.0.min(stop).saturating_sub(bar.from.0.max(start));
            }
        }
    }
    let whole = length as f64 * lanes.lanes().len().max(1) as f64;
    for (interval, busy) in (0..).zip(busy) {
        let part = 100.0 * busy as f64 / whole;
        events.put(&json!({
            "ph": "C", "name": "machines tracing (%)", "pid": MACHINES, "tid": 0, "ts": micros(Time(interval * length)),
            "args": { "part": part },
        }))?;
    }
    Ok(())
}

/// Makes a slice from its point until a time.
fn slice(name: &str, kind: &str, place: TrackPoint, until: Time, args: Value) -> Value {
    let TrackPoint { process, track, at } = place;
    json!({
        "ph": "X", "name": name, "cat": kind, "pid": process, "tid": track, "ts": micros(at),
        "dur": micros(Time(until.0.saturating_sub(at.0))), "args": args,
    })
}

/// Returns a node's track; 0 is the parent's.
fn track_of(node: NodeId) -> usize {
    usize::from(node) + 1
}

/// Converts to microseconds, the format's unit; nanoseconds are decimals.
fn micros(time: Time) -> f64 {
    time.0 as f64 / 1e3
}
