//! A worker on its emulated machine. It traces atoms piece by piece, and waits after each piece as long as the machine
//! would take. Its thread handles events between two pieces and while it waits.

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
use crate::balance::{Condition, Event, NodeId, Transition};
use crate::picture::{Atom, Colour, Division};
use crate::record::RecordKind;
use crate::runlog::Header;
use crate::scenario::Command;
use crate::sim::Machine;
use crate::time::Time;
use crate::tracer::Scratch;

/// Pixels in a piece: after each piece the worker looks for messages, commands and the run's end.
const PIECE_PIXELS: u32 = 64;

/// Longest time that a machine may be ahead of the clock, so that its thread does not sleep after each atom.
const MAX_AHEAD: Duration = Duration::from_millis(1);

/// Handler of a worker's events: what its thread does besides tracing.
pub(super) trait WorkerHandler {
    /// Handles a message or the timer.
    fn event(&mut self, event: Event, worker: &mut Worker);

    /// Executes an order from the pipe, if the worker has its own thread.
    fn order(&mut self, order: WorkerOrder, worker: &mut Worker) {
        let _ = (order, worker);
        unreachable!("only a worker with its own thread gets orders")
    }

    /// Handles a traced atom, whose pixels are the worker's last. At full speed its `cost` is an estimate.
    fn traced(&mut self, atom: Atom, cost: Duration, worker: &mut Worker);

    /// Handles an atom that the worker has failed to trace.
    fn failed(&mut self, atom: Atom, worker: &mut Worker) {
        let _ = worker;
        unreachable!("only a strategy that survives losses continues after a worker has failed to trace atom {atom}")
    }

    /// Handles the loss of the machine's memory: the node starts afresh.
    fn lose_memory(&mut self) {}

    /// Returns whether the worker should end.
    fn is_over(&self) -> bool;

    /// Returns whether the atom in hand is not needed any more.
    fn is_atom_unneeded(&self) -> bool {
        false
    }
}

/// A worker; create it on the thread on which it traces, and keep it there.
pub(super) struct Worker {
    pub id: NodeId,
    pub endpoint: Endpoint,
    /// Atoms that wait for the worker, with the time since which they wait.
    pub pipe: VecDeque<(Atom, Time)>,
    /// Pixels of the atoms that are traced and not sent, then those of the atom in hand.
    pub pixels: Vec<Colour>,
    tracer: GuardedTracer,
    division: Division,
    machine: Machine,
    /// Whether the user has paused the worker; a machine that hangs stands still too.
    paused: bool,
    in_hand: Option<AtomInHand>,
    meter: Meter,
    /// Atoms whose costs are not known yet.
    batch: Batch,
}

/// The atom that the worker is tracing.
struct AtomInHand {
    atom: Atom,
    /// Pixels still to be traced.
    rest: Range<u32>,
    /// Its cost so far, as far as measured.
    cost: Duration,
    /// Wall time of its other pieces; their cost is known when the batch is split.
    wall: Duration,
    /// Whether the tracer has panicked.
    failed: bool,
}

impl Worker {
    /// Creates the worker of node `id`.
    pub fn new(id: NodeId, header: &Header, endpoint: Endpoint, trace: Arc<TracePixels>) -> Self {
        Self {
            id,
            endpoint,
            pipe: VecDeque::new(),
            pixels: Vec::new(),
            tracer: GuardedTracer::new(trace, header.rules.strategy.survives_losses()),
            division: header.division,
            machine: Machine::new(header.speeds[usize::from(id)], header.pace),
            paused: false,
            in_hand: None,
            meter: Meter::new(),
            batch: Batch::default(),
        }
    }

    /// Traces atoms and handles events until the handler is over.
    pub fn work(&mut self, handler: &mut impl WorkerHandler) -> Result<(), Stopped> {
        while !handler.is_over() {
            self.run_once(handler)?;
        }
        Ok(())
    }

    /// Traces one atom; the pipe must be empty.
    pub fn trace_atom(&mut self, atom: Atom, handler: &mut impl WorkerHandler) -> Result<(), Stopped> {
        self.pipe.push_back((atom, self.endpoint.time()));
        while self.in_hand.is_some() || !self.pipe.is_empty() {
            self.run_once(handler)?;
        }
        Ok(())
    }

    /// Returns when the machine can begin work that has been available since `available`.
    pub fn ready(&self, available: Time) -> Time {
        self.machine.ready(available, self.endpoint.shared.clock.now())
    }

    /// Removes and returns the pixels of these atoms, which must be the first ones.
    pub fn take_pixels(&mut self, atoms: &[Range<Atom>]) -> Vec<Colour> {
        take_pixels(&mut self.pixels, self.division, atoms)
    }

    /// Sends the records so far to the run's owner.
    pub fn flush(&mut self) {
        self.split_batch();
        self.endpoint.flush();
    }

    /// Excludes the thread's work since the last atom from all costs.
    pub fn skip(&mut self) {
        self.split_batch();
        self.meter.lap();
    }

    /// Ends the worker: sends the last records and the number of rays.
    pub fn end(mut self) {
        self.flush();
        self.endpoint.update(Update::Rays(self.tracer.rays()));
    }

    /// Handles events that are due, then traces one piece, or waits.
    fn run_once(&mut self, handler: &mut impl WorkerHandler) -> Result<(), Stopped> {
        let now = self.step()?;
        self.handle_until(handler, |worker| worker.next_start(now).unwrap_or(now));
        // Computed again, since an event may have brought atoms or stopped the machine, and took time.
        if let Some(start) = self.next_start(self.endpoint.shared.clock.now()) {
            self.trace_piece(start, handler)?;
        } else if !handler.is_over() {
            self.split_batch();
            self.endpoint.wait(None);
            self.meter.lap();
        }
        Ok(())
    }

    fn step(&mut self) -> Result<Time, Stopped> {
        // Not `self.split_batch()`, since the endpoint is borrowed.
        let (batch, meter) = (&mut self.batch, &mut self.meter);
        self.endpoint.step(|endpoint| {
            split(batch, meter, endpoint);
            endpoint.flush();
        })
    }

    /// Returns when the worker begins its next piece; `None` if it has no atom or stands still.
    fn next_start(&self, now: Time) -> Option<Time> {
        let available = match (&self.in_hand, self.pipe.front()) {
            (Some(_), _) => Time::ZERO,
            (None, Some(&(_, since))) => since,
            (None, None) => return None,
        };
        (!self.machine.is_stopped()).then(|| self.machine.ready(available, now))
    }

    /// Handles events one by one up to `horizon`, which each event may change: a worker that has got atoms must not
    /// handle events after their end before it has traced them, even if its thread woke after both.
    fn handle_until(&mut self, handler: &mut impl WorkerHandler, horizon: impl Fn(&Self) -> Time) {
        while let Some(incoming) = self.endpoint.next(horizon(self)) {
            match incoming {
                Incoming::Event(event, _) => handler.event(event, self),
                Incoming::Command(command) => self.handle_command(command, handler),
                Incoming::WorkerOrder(order) => handler.order(order, self),
            }
        }
    }

    fn handle_command(&mut self, command: Command, handler: &mut impl WorkerHandler) {
        let (node, at) = (self.id, self.endpoint.time());
        let what = match command {
            Command::Speed { speed, .. } => {
                self.machine.set_speed(speed, at);
                RecordKind::SpeedSet { node, speed }
            }
            Command::Pause { paused, .. } if paused == self.paused => return,
            Command::Pause { paused, .. } => {
                self.paused = paused;
                self.update_pause(at);
                if paused { RecordKind::Paused { node } } else { RecordKind::Resumed { node } }
            }
            Command::Condition { condition, .. } => return self.set_condition(condition, handler),
            Command::Delay { from, .. } => return self.endpoint.record_delay(from),
            Command::Link { .. } | Command::Latency(_) | Command::OwnLatency { .. } => {
                unreachable!("the parent records commands to the network")
            }
        };
        self.endpoint.record(what);
        self.restart_measurement();
    }

    /// Sets the condition of the machine, with the effects of the [`Transition`].
    fn set_condition(&mut self, condition: Condition, handler: &mut impl WorkerHandler) {
        let at = self.endpoint.time();
        let Some(transition) = self.endpoint.set_condition(condition) else { return };
        self.update_pause(at);
        self.restart_measurement();
        match transition {
            Transition::MemoryLost => {
                self.pipe.clear();
                self.pixels.clear();
                self.in_hand = None;
                self.machine.finish(at.max(self.machine.time()));
                handler.lose_memory();
            }
            Transition::FreshStart => handler.event(Event::Started, self),
            // The endpoint hands out the messages that waited during a hang.
            Transition::Resumed | Transition::MemoryKept => {}
        }
    }

    /// Pauses the machine or lets it continue, by the user's pause and its condition.
    fn update_pause(&mut self, at: Time) {
        self.machine.set_paused(self.paused || self.endpoint.condition() == Condition::Hung, at);
    }

    /// Ends the present measurement, since at another speed costs are measured in another way.
    fn restart_measurement(&mut self) {
        self.split_batch();
        self.meter.lap();
        if let Some(in_hand) = &mut self.in_hand {
            in_hand.cost += mem::take(&mut in_hand.wall);
        }
    }

    /// Traces one piece of the atom in hand, or of the next in the pipe, and waits until the emulated machine has done
    /// the same work.
    fn trace_piece(&mut self, start: Time, handler: &mut impl WorkerHandler) -> Result<(), Stopped> {
        if self.in_hand.is_none()
            && let Some((atom, _)) = self.pipe.pop_front()
        {
            self.endpoint.advance(start);
            self.endpoint.record(RecordKind::AtomStarted { node: self.id, atom });
            let (rest, cost, wall) = (self.division.pixels(atom), Duration::ZERO, Duration::ZERO);
            self.in_hand = Some(AtomInHand { atom, rest, cost, wall, failed: false });
        }
        let Some(in_hand) = &mut self.in_hand else { return Ok(()) };
        let cut = in_hand.rest.end.min(in_hand.rest.start + PIECE_PIXELS);
        let piece = mem::replace(&mut in_hand.rest.start, cut)..cut;
        let is_full = self.machine.is_full();
        if !is_full {
            self.meter.lap();
        }
        if !self.tracer.trace(piece.clone(), &mut self.pixels) {
            // Drop the pixels of the atom so far.
            let traced = piece.start - self.division.pixels(in_hand.atom).start;
            self.pixels.truncate(self.pixels.len() - traced as usize);
            in_hand.rest.start = in_hand.rest.end;
            in_hand.failed = true;
        }
        if is_full {
            let end = self.endpoint.shared.clock.now();
            // A machine at full speed has started at the time of the clock.
            in_hand.wall += end.since(start);
            self.machine.finish(end);
        } else {
            let cost = self.meter.lap();
            in_hand.cost += cost;
            self.machine.begin(start, cost);
            self.wait_until_due(handler)?;
        }
        match self.in_hand.take_if(|in_hand| in_hand.rest.is_empty()) {
            Some(AtomInHand { atom, failed: true, .. }) => {
                self.endpoint.advance(self.machine.time());
                self.endpoint.record(RecordKind::AtomFailed { node: self.id, atom });
                handler.failed(atom, self);
            }
            Some(in_hand) => self.finish_atom(in_hand, handler),
            None => {}
        }
        Ok(())
    }

    /// Waits until the piece in hand is due, unless that is soon, and handles events meanwhile. Drops an atom that is
    /// not needed any more.
    fn wait_until_due(&mut self, handler: &mut impl WorkerHandler) -> Result<(), Stopped> {
        let mut tolerance = MAX_AHEAD;
        loop {
            let now = self.step()?;
            let due = self.machine.due();
            if let Some(due) = due.filter(|&due| due <= now + tolerance) {
                self.machine.finish(due);
                return Ok(());
            }
            // If it waits at all, it waits for the full time; otherwise the thread would wake for each piece.
            tolerance = Duration::ZERO;
            self.handle_until(handler, |worker| worker.machine.due().map_or(now, |due| due.min(now)));
            if handler.is_atom_unneeded() {
                self.in_hand = None;
                return Ok(());
            }
            self.endpoint.wait(self.machine.due());
        }
    }

    fn finish_atom(&mut self, AtomInHand { atom, cost, wall, .. }: AtomInHand, handler: &mut impl WorkerHandler) {
        self.endpoint.advance(self.machine.time());
        let index = self.endpoint.record(RecordKind::AtomDone { node: self.id, atom, cost });
        if !wall.is_zero() {
            self.batch.push(index, wall);
            if self.batch.is_full() {
                self.split_batch();
            }
        }
        handler.traced(atom, cost + wall, self);
    }

    fn split_batch(&mut self) {
        split(&mut self.batch, &mut self.meter, &mut self.endpoint);
    }
}

/// Traces `pixels` piece by piece, without emulating a machine. Returns false if `is_over` has ended it early.
pub(super) fn trace_pieces(
    trace: &TracePixels,
    pixels: Range<u32>,
    scratch: &mut Scratch,
    out: &mut Vec<Colour>,
    is_over: impl Fn() -> bool,
) -> bool {
    for start in pixels.clone().step_by(PIECE_PIXELS as usize) {
        if is_over() {
            return false;
        }
        trace(start..pixels.end.min(start + PIECE_PIXELS), scratch, out);
    }
    true
}

/// Removes and returns the pixels of these atoms, which must be the first of `pixels`.
pub(super) fn take_pixels(pixels: &mut Vec<Colour>, division: Division, atoms: &[Range<Atom>]) -> Vec<Colour> {
    let count: u32 = atoms.iter().map(|range| division.pixels_in(range)).sum();
    let rest = pixels.split_off(count as usize);
    mem::replace(pixels, rest)
}

/// Adds to the cost of each atom of the batch its share of the CPU time since the last reading.
fn split(batch: &mut Batch, meter: &mut Meter, endpoint: &mut Endpoint) {
    if batch.is_empty() {
        return;
    }
    for (index, share) in batch.split(meter.lap()) {
        if let RecordKind::AtomDone { cost, .. } = endpoint.record_mut(index) {
            *cost += share;
        }
    }
}
