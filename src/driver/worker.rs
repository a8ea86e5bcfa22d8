//! A worker on its emulated machine: traces atoms piece by piece, each as long as the machine takes for it. What else
//! its thread has to do runs between two pieces, and while it waits.

use std::collections::VecDeque;
use std::mem;
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use super::endpoint::{Endpoint, Incoming, Stopped};
use super::meter::{Batch, Meter};
use super::panic_guard::GuardedTracer;
use super::shared::WorkerOrder;
use super::{TracePixels, Update};
use crate::balance::{Condition, Event, NodeId, Strategy, Transition};
use crate::picture::{Atom, Colour, Division};
use crate::record::RecordKind;
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
pub(super) trait WorkerHandler {
    /// Answers a message or a timer.
    fn event(&mut self, event: Event, worker: &mut Worker);

    /// Obeys what comes through the pipe, if the worker has a thread of its own.
    fn order(&mut self, order: WorkerOrder, worker: &mut Worker) {
        let _ = (order, worker);
        unreachable!("only a worker with a thread of its own has a pipe")
    }

    /// Takes over a traced atom, whose pixels are the worker's last. At full speed its `cost` is only an estimate.
    fn traced(&mut self, atom: Atom, cost: Duration, worker: &mut Worker);

    /// The worker has failed to trace an atom.
    fn failed(&mut self, atom: Atom, worker: &mut Worker) {
        let _ = worker;
        unreachable!("only a worker of the ring that adapts fails at atom {atom} and goes on")
    }

    /// The machine is switched off.
    fn lose_all(&mut self) {}

    /// Whether there is nothing to wait for.
    fn is_over(&self) -> bool;

    /// Whether nobody needs the atom in hand any more.
    fn is_void(&self) -> bool {
        false
    }
}

/// A worker, to be made and kept on the thread on which it traces.
pub(super) struct Worker {
    pub id: NodeId,
    pub port: Endpoint,
    /// Atoms that wait for the worker, and since when.
    pub pipe: VecDeque<(Atom, Time)>,
    /// Pixels of the atoms that are traced and not sent, and after them those of the atom in hand.
    pub pixels: Vec<Colour>,
    tracer: GuardedTracer,
    division: Division,
    machine: Machine,
    /// Whether the user has paused the worker; a machine that hangs stands still too.
    paused: bool,
    hand: Option<Hand>,
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
    /// Whether it cannot be traced.
    failed: bool,
}

impl Worker {
    /// The worker of node `id`.
    pub fn new(id: NodeId, header: &Header, port: Endpoint, trace: Arc<TracePixels>) -> Self {
        Self {
            id,
            port,
            pipe: VecDeque::new(),
            pixels: Vec::new(),
            tracer: GuardedTracer::new(trace, header.rules.strategy == Strategy::Adaptive),
            division: header.division,
            machine: Machine::new(header.speeds[usize::from(id)], header.pace),
            paused: false,
            hand: None,
            meter: Meter::new(),
            batch: Batch::default(),
        }
    }

    /// Does what there is to do until the duties are over.
    pub fn work(&mut self, duties: &mut impl WorkerHandler) -> Result<(), Stopped> {
        while !duties.is_over() {
            self.turn(duties)?;
        }
        Ok(())
    }

    /// Traces an atom for whoever has nothing in the pipe.
    pub fn trace_atom(&mut self, atom: Atom, duties: &mut impl WorkerHandler) -> Result<(), Stopped> {
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
        self.port.update(Update::Rays(self.tracer.rays()));
    }

    /// Handles what has come, then traces one piece, or waits.
    fn turn(&mut self, duties: &mut impl WorkerHandler) -> Result<(), Stopped> {
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
    fn handle_until(&mut self, duties: &mut impl WorkerHandler, horizon: impl Fn(&Self) -> Time) {
        while let Some(incoming) = self.port.next(horizon(self)) {
            match incoming {
                Incoming::Event(event, _) => duties.event(event, self),
                Incoming::Command(command) => self.handle_command(command, duties),
                Incoming::WorkerOrder(order) => duties.order(order, self),
            }
        }
    }

    fn handle_command(&mut self, command: Command, duties: &mut impl WorkerHandler) {
        let (node, at) = (self.id, self.port.time());
        let what = match command {
            Command::Speed { speed, .. } => {
                self.machine.set_speed(speed, at);
                RecordKind::SpeedSet { node, speed }
            }
            Command::Pause { paused, .. } if paused == self.paused => return,
            Command::Pause { paused, .. } => {
                self.paused = paused;
                self.stand_still(at);
                if paused { RecordKind::Paused { node } } else { RecordKind::Resumed { node } }
            }
            Command::Condition { condition, .. } => return self.set_condition(condition, duties),
            Command::Delay { from, .. } => return self.port.delayed(from),
            Command::Link { .. } | Command::Latency(_) => {
                unreachable!("the parent notes down what is done to the network")
            }
        };
        self.port.record(what);
        self.measure_anew();
    }

    /// Something becomes of the machine.
    fn set_condition(&mut self, condition: Condition, duties: &mut impl WorkerHandler) {
        let at = self.port.time();
        let Some(transition) = self.port.set_condition(condition) else { return };
        self.stand_still(at);
        self.measure_anew();
        match transition {
            Transition::MemoryLost => {
                self.pipe.clear();
                self.pixels.clear();
                self.hand = None;
                self.machine.finish(at.max(self.machine.time()));
                duties.lose_all();
            }
            Transition::FreshStart => duties.event(Event::Started, self),
            // The endpoint hands out the messages that waited during a hang.
            Transition::Resumed | Transition::MemoryKept => {}
        }
    }

    /// Lets the machine stand still, if it is to, or go on.
    fn stand_still(&mut self, at: Time) {
        self.machine.set_paused(self.paused || self.port.condition() == Condition::Hung, at);
    }

    /// At another speed costs are measured otherwise.
    fn measure_anew(&mut self) {
        self.split_batch();
        self.meter.lap();
        if let Some(hand) = &mut self.hand {
            hand.cost += mem::take(&mut hand.wall);
        }
    }

    /// Traces one piece of the atom in hand, or of the next in the pipe, and waits until the emulated machine has
    /// done as much.
    fn trace_piece(&mut self, start: Time, duties: &mut impl WorkerHandler) -> Result<(), Stopped> {
        if self.hand.is_none()
            && let Some((atom, _)) = self.pipe.pop_front()
        {
            self.port.advance(start);
            self.port.record(RecordKind::AtomStarted { node: self.id, atom });
            let (rest, cost, wall) = (self.division.pixels(atom), Duration::ZERO, Duration::ZERO);
            self.hand = Some(Hand { atom, rest, cost, wall, failed: false });
        }
        let Some(hand) = &mut self.hand else { return Ok(()) };
        let cut = hand.rest.end.min(hand.rest.start + PIECE);
        let piece = mem::replace(&mut hand.rest.start, cut)..cut;
        let is_full = self.machine.is_full();
        if !is_full {
            self.meter.lap();
        }
        if !self.tracer.trace(piece.clone(), &mut self.pixels) {
            // What there is of the atom is dropped.
            let traced = piece.start - self.division.pixels(hand.atom).start;
            self.pixels.truncate(self.pixels.len() - traced as usize);
            hand.rest.start = hand.rest.end;
            hand.failed = true;
        }
        if is_full {
            let end = self.port.shared.clock.now();
            // A full machine starts when the clock says so.
            hand.wall += end.since(start);
            self.machine.finish(end);
        } else {
            let cost = self.meter.lap();
            hand.cost += cost;
            self.machine.begin(start, cost);
            self.wait_until_due(duties)?;
        }
        match self.hand.take_if(|hand| hand.rest.is_empty()) {
            Some(Hand { atom, failed: true, .. }) => {
                self.port.advance(self.machine.time());
                self.port.record(RecordKind::AtomFailed { node: self.id, atom });
                duties.failed(atom, self);
            }
            Some(hand) => self.finish_atom(hand, duties),
            None => {}
        }
        Ok(())
    }

    /// Waits until the piece in hand is due, unless that is near; handles what happens meanwhile. An atom that nobody needs any
    /// more is dropped.
    fn wait_until_due(&mut self, duties: &mut impl WorkerHandler) -> Result<(), Stopped> {
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
            if duties.is_void() {
                self.hand = None;
                return Ok(());
            }
            self.port.wait(self.machine.due());
        }
    }

    fn finish_atom(&mut self, Hand { atom, cost, wall, .. }: Hand, duties: &mut impl WorkerHandler) {
        self.port.advance(self.machine.time());
        let index = self.port.record(RecordKind::AtomDone { node: self.id, atom, cost });
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
fn split(batch: &mut Batch, meter: &mut Meter, port: &mut Endpoint) {
    if batch.is_empty() {
        return;
    }
    for (index, share) in batch.split(meter.lap()) {
        if let RecordKind::AtomDone { cost, .. } = port.recorded(index) {
            *cost += share;
        }
    }
}
