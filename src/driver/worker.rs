//! A worker on its emulated machine: traces atoms piece by piece, each as long as the machine takes for it. What else
//! its thread has to do runs between two pieces, and while it waits.

use std::collections::VecDeque;
use std::mem;
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use super::meter::{Batch, Meter};
use super::port::{Incoming, Port, Stopped};
use super::shared::Order;
use super::{TracePixels, Update};
use crate::balance::{Event, NodeId};
use crate::picture::{Atom, Colour, Division};
use crate::record::What;
use crate::runlog::Header;
use crate::scenario::Command;
use crate::sim::Machine;
use crate::time::Time;
use crate::tracer::Scratch;

/// A worker looks for messages, changed speeds, pauses and the run's end after at most this many pixels.
const PIECE: u32 = 64;

/// A machine may be ahead of the clock by this much, so that its thread does not sleep after each atom.
const AHEAD: Duration = Duration::from_millis(1);

/// What a worker's thread does besides tracing.
pub(super) trait Duties {
    /// Answers a message or a timer.
    fn event(&mut self, event: Event, worker: &mut Worker);

    /// Obeys what comes through the pipe, if the worker has a thread of its own.
    fn order(&mut self, order: Order, worker: &mut Worker) {
        let _ = (order, worker);
        unreachable!("only a worker with a thread of its own has a pipe")
    }

    /// Takes over a traced atom, whose pixels are the worker's last. At full speed its `cost` is only an estimate.
    fn traced(&mut self, atom: Atom, cost: Duration, worker: &mut Worker);

    /// Whether there is nothing to wait for.
    fn is_over(&self) -> bool;
}

/// A worker, to be made and kept on the thread on which it traces.
pub(super) struct Worker {
    pub id: NodeId,
    pub port: Port,
    /// Atoms that wait for the worker, and since when.
    pub pipe: VecDeque<(Atom, Time)>,
    /// Pixels of the atoms that are traced and not sent, and after them those of the atom in hand.
    pub pixels: Vec<Colour>,
    trace: Arc<TracePixels>,
    division: Division,
    machine: Machine,
    hand: Option<Hand>,
    scratch: Scratch,
    meter: Meter,
    /// Atoms by the index of their record.
    batch: Batch,
}

/// The atom that the worker has in hand.
struct Hand {
    atom: Atom,
    /// Pixels still to be traced.
    rest: Range<u32>,
    /// What it has cost, as far as that is known.
    cost: Duration,
    /// Wall time of its other pieces, whose cost is known only when the batch is split.
    wall: Duration,
}

impl Worker {
    /// The worker of node `id`.
    pub fn new(id: NodeId, header: &Header, port: Port, trace: Arc<TracePixels>) -> Self {
        Self {
            id,
            port,
            pipe: VecDeque::new(),
            pixels: Vec::new(),
            trace,
            division: header.division,
            machine: Machine::new(header.speeds[usize::from(id)], header.pace),
            hand: None,
            scratch: Scratch::default(),
            meter: Meter::new(),
            batch: Batch::default(),
        }
    }

    /// Does what there is to do until the duties are over.
    pub fn work(&mut self, duties: &mut impl Duties) -> Result<(), Stopped> {
        while !duties.is_over() {
            self.turn(duties)?;
        }
        Ok(())
    }

    /// Traces an atom for whoever has nothing in the pipe.
    pub fn trace_atom(&mut self, atom: Atom, duties: &mut impl Duties) -> Result<(), Stopped> {
        self.pipe.push_back((atom, self.port.time()));
        while self.hand.is_some() || !self.pipe.is_empty() {
            self.turn(duties)?;
        }
        Ok(())
    }

    /// When the machine can begin what it could have had since `available`.
    pub fn ready(&self, available: Time) -> Time {
        self.machine.ready(available, self.port.shared.clock.now())
    }

    /// Takes the pixels of these atoms, which are the first of all that were traced.
    pub fn take_pixels(&mut self, atoms: &[Range<Atom>]) -> Vec<Colour> {
        take_pixels(&mut self.pixels, self.division, atoms)
    }

    /// Tells the records so far.
    pub fn flush(&mut self) {
        self.split_batch();
        self.port.flush();
    }

    /// What the thread has done since the last atom does not count.
    pub fn skip(&mut self) {
        self.split_batch();
        self.meter.lap();
    }

    /// The last that is heard of the worker.
    pub fn end(mut self) {
        self.flush();
        self.port.update(Update::Rays(self.scratch.rays));
    }

    /// Handles what has come, then traces one piece, or waits.
    fn turn(&mut self, duties: &mut impl Duties) -> Result<(), Stopped> {
        let now = self.step()?;
        self.handle_until(duties, |worker| worker.next_start(now).unwrap_or(now));
        // Asked again, since a message may have brought atoms or stopped the machine, and took its time.
        if let Some(start) = self.next_start(self.port.shared.clock.now()) {
            self.trace_piece(start, duties)?;
        } else if !duties.is_over() {
            self.split_batch();
            self.port.wait(None);
            self.meter.lap();
        }
        Ok(())
    }

    fn step(&mut self) -> Result<Time, Stopped> {
        // Not `self.split_batch()`, since the port is taken.
        let (batch, meter) = (&mut self.batch, &mut self.meter);
        self.port.step(|port| {
            split(batch, meter, port);
            port.flush();
        })
    }

    /// When the worker begins its next piece; `None` while it has nothing to do or stands still.
    fn next_start(&self, now: Time) -> Option<Time> {
        let available = match (&self.hand, self.pipe.front()) {
            (Some(_), _) => Time::ZERO,
            (None, Some(&(_, since))) => since,
            (None, None) => return None,
        };
        (!self.machine.is_stopped()).then(|| self.machine.ready(available, now))
    }

    /// Handles one by one what happens until `horizon`, which each may change: who was given atoms must not hear of
    /// anything later before they are done, even if its thread woke too late for both.
    fn handle_until(&mut self, duties: &mut impl Duties, horizon: impl Fn(&Self) -> Time) {
        while let Some(incoming) = self.port.next(horizon(self)) {
            match incoming {
                Incoming::Event(event, _) => duties.event(event, self),
                Incoming::Command(command) => self.obey(command),
                Incoming::Order(order) => duties.order(order, self),
            }
        }
    }

    fn obey(&mut self, command: Command) {
        let (node, at) = (self.id, self.port.time());
        let what = match command {
            Command::Speed { speed, .. } => {
                self.machine.set_speed(speed, at);
                What::SpeedSet { node, speed }
            }
            Command::Pause { paused, .. } if paused == self.machine.is_paused() => return,
            Command::Pause { paused, .. } => {
                self.machine.set_paused(paused, at);
                if paused { What::Paused { node } } else { What::Resumed { node } }
            }
            Command::Condition { .. } | Command::Link { .. } => return,
            Command::Latency(_) => unreachable!("the parent notes down the latency"),
        };
        self.port.record(what);
        // At another speed costs are measured otherwise.
        self.split_batch();
        self.meter.lap();
        if let Some(hand) = &mut self.hand {
            hand.cost += mem::take(&mut hand.wall);
        }
    }

    /// Traces one piece of the atom in hand, or of the next in the pipe, and waits until the emulated machine has
    /// done as much.
    fn trace_piece(&mut self, start: Time, duties: &mut impl Duties) -> Result<(), Stopped> {
        if self.hand.is_none()
            && let Some((atom, _)) = self.pipe.pop_front()
        {
            self.port.advance(start);
            self.port.record(What::AtomStarted { node: self.id, atom });
            self.hand =
                Some(Hand { atom, rest: self.division.pixels(atom), cost: Duration::ZERO, wall: Duration::ZERO });
        }
        let Some(hand) = &mut self.hand else { return Ok(()) };
        let cut = hand.rest.end.min(hand.rest.start + PIECE);
        let piece = mem::replace(&mut hand.rest.start, cut)..cut;
        if self.machine.is_full() {
            (self.trace)(piece, &mut self.scratch, &mut self.pixels);
            let end = self.port.shared.clock.now();
            // A full machine starts when the clock says so.
            hand.wall += end.since(start);
            self.machine.finish(end);
        } else {
            self.meter.lap();
            (self.trace)(piece, &mut self.scratch, &mut self.pixels);
            let cost = self.meter.lap();
            hand.cost += cost;
            self.machine.begin(start, cost);
            self.wait_until_due(duties)?;
        }
        if let Some(hand) = self.hand.take_if(|hand| hand.rest.is_empty()) {
            self.finish_atom(hand, duties);
        }
        Ok(())
    }

    /// Waits until the piece in hand is due, unless that is near; handles what happens meanwhile.
    fn wait_until_due(&mut self, duties: &mut impl Duties) -> Result<(), Stopped> {
        let mut near = AHEAD;
        loop {
            let now = self.step()?;
            let due = self.machine.due();
            if let Some(due) = due.filter(|&due| due <= now + near) {
                self.machine.finish(due);
                return Ok(());
            }
            // Who waits at all waits for the full time, or the thread would wake for each piece.
            near = Duration::ZERO;
            self.handle_until(duties, |worker| worker.machine.due().map_or(now, |due| due.min(now)));
            self.port.wait(self.machine.due());
        }
    }

    fn finish_atom(&mut self, Hand { atom, cost, wall, .. }: Hand, duties: &mut impl Duties) {
        self.port.advance(self.machine.time());
        let index = self.port.record(What::AtomDone { node: self.id, atom, cost });
        if !wall.is_zero() {
            self.batch.push(index, wall);
            if self.batch.is_full() {
                self.split_batch();
            }
        }
        duties.traced(atom, cost + wall, self);
    }

    fn split_batch(&mut self) {
        split(&mut self.batch, &mut self.meter, &mut self.port);
    }
}

/// Traces `pixels` for whoever has no machine, in pieces. Whether it did: it ends when it `is_over`.
pub(super) fn trace_pieces(
    trace: &TracePixels,
    pixels: Range<u32>,
    scratch: &mut Scratch,
    out: &mut Vec<Colour>,
    is_over: impl Fn() -> bool,
) -> bool {
    for start in pixels.clone().step_by(PIECE as usize) {
        if is_over() {
            return false;
        }
        trace(start..pixels.end.min(start + PIECE), scratch, out);
    }
    true
}

/// Takes the pixels of these atoms, which are the first of `pixels`.
pub(super) fn take_pixels(pixels: &mut Vec<Colour>, division: Division, atoms: &[Range<Atom>]) -> Vec<Colour> {
    let count: u32 = atoms.iter().map(|range| division.pixels_in(range)).sum();
    let rest = pixels.split_off(count as usize);
    mem::replace(pixels, rest)
}

/// Gives each atom of the batch its share of the CPU time since the last reading.
fn split(batch: &mut Batch, meter: &mut Meter, port: &mut Port) {
    if batch.is_empty() {
        return;
    }
    for (index, share) in batch.split(meter.lap()) {
        if let What::AtomDone { cost, .. } = port.recorded(index) {
            *cost += share;
        }
    }
}
