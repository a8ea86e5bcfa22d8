//! A node and its worker on one thread: the node's handler runs between two pieces of the worker's, and while it waits.
//!
//! One thread and not two, since the article's own complaint (§10) is that child and grandchild compete for the
//! processor.

use std::collections::VecDeque;
use std::mem;
use std::ops::Range;
use std::time::Duration;

use super::meter::{Batch, Meter};
use super::port::{Incoming, Port, Stopped};
use super::{TracePixels, Update};
use crate::balance::{Action, Event, Message, Node, NodeId};
use crate::picture::{Atom, Colour, Division};
use crate::record::What;
use crate::runlog::Header;
use crate::scenario::Command;
use crate::sim::Machine;
use crate::time::Time;
use crate::tracer::Scratch;

/// A worker looks for messages, changed speeds, pauses and the run's end after at most this many pixels.
pub(super) const PIECE: u32 = 64;

/// A machine may be ahead of the clock by this much, so that its thread does not sleep after each atom.
const AHEAD: Duration = Duration::from_millis(1);

/// What a node's thread holds.
pub(super) struct NodeThread<'run> {
    id: NodeId,
    node: Node,
    port: Port<'run>,
    trace: &'run TracePixels,
    division: Division,
    machine: Machine,
    /// Atoms that wait for the worker, and since when.
    pipe: VecDeque<(Atom, Time)>,
    hand: Option<Hand>,
    /// Pixels of the atoms that are traced and not sent, and after them those of the atom in hand.
    pixels: Vec<Colour>,
    scratch: Scratch,
    meter: Meter,
    /// Atoms by the index of their record.
    batch: Batch,
    actions: Vec<Action>,
    finished: bool,
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

impl<'run> NodeThread<'run> {
    /// To be called on the node's own thread.
    pub fn new(id: NodeId, header: &Header, port: Port<'run>, trace: &'run TracePixels) -> Self {
        Self {
            id,
            node: Node::new(&header.rules, id, header.speeds.len() as NodeId),
            port,
            trace,
            division: header.division,
            machine: Machine::new(header.speeds[usize::from(id)], header.pace),
            pipe: VecDeque::new(),
            hand: None,
            pixels: Vec::new(),
            scratch: Scratch::default(),
            meter: Meter::new(),
            batch: Batch::default(),
            actions: Vec::new(),
            finished: false,
        }
    }

    /// Runs the node until its shutdown, or until the run is stopped.
    pub fn run(mut self) {
        let _ = self.work_until_shutdown();
        self.split_batch();
        self.port.flush();
        self.port.update(Update::Rays(self.scratch.rays));
    }

    fn work_until_shutdown(&mut self) -> Result<(), Stopped> {
        loop {
            let now = self.step()?;
            self.handle_until(|node| node.next_start(now).unwrap_or(now));
            if self.finished {
                return Ok(());
            }
            // Asked again, since a message may have brought atoms or stopped the machine, and took its time.
            if let Some(start) = self.next_start(self.port.shared.clock.now()) {
                self.trace_piece(start)?;
            } else {
                self.split_batch();
                self.port.wait(None);
                self.meter.lap();
            }
        }
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
    fn handle_until(&mut self, horizon: impl Fn(&Self) -> Time) {
        while let Some(incoming) = self.port.next(horizon(self)) {
            match incoming {
                Incoming::Event(event, _) => self.hand_over(event),
                Incoming::Command(command) => self.obey(command),
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
    fn trace_piece(&mut self, start: Time) -> Result<(), Stopped> {
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
            self.wait_until_due()?;
        }
        if let Some(hand) = self.hand.take_if(|hand| hand.rest.is_empty()) {
            self.finish_atom(hand);
        }
        Ok(())
    }

    /// Waits until the piece in hand is due, unless that is near; handles what happens meanwhile.
    fn wait_until_due(&mut self) -> Result<(), Stopped> {
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
            self.handle_until(|node| node.machine.due().map_or(now, |due| due.min(now)));
            self.port.wait(self.machine.due());
        }
    }

    fn finish_atom(&mut self, Hand { atom, cost, wall, .. }: Hand) {
        self.port.advance(self.machine.time());
        let index = self.port.record(What::AtomDone { node: self.id, atom, cost });
        if !wall.is_zero() {
            self.batch.push(index, wall);
            if self.batch.is_full() {
                self.split_batch();
            }
        }
        self.hand_over(Event::AtomDone { atom, cost: cost + wall });
    }

    fn split_batch(&mut self) {
        split(&mut self.batch, &mut self.meter, &mut self.port);
    }

    /// Hands the node an event and carries out what it asks for.
    fn hand_over(&mut self, event: Event) {
        let mut actions = mem::take(&mut self.actions);
        self.node.handle(self.port.time(), event, &mut actions);
        actions.drain(..).for_each(|action| self.carry_out(action));
        self.actions = actions;
    }

    fn carry_out(&mut self, action: Action) {
        match action {
            Action::Send { to, message } => {
                let pixels = self.pixels_of(&message);
                self.port.send(to, message, pixels);
            }
            Action::Trace(atom) => self.pipe.push_back((atom, self.port.time())),
            Action::SetTimer(at) => self.port.set_timer(at),
            Action::Retire => _ = self.port.record(What::Retired { node: self.id }),
            Action::Finish => self.finished = true,
            Action::Estimate => unreachable!("only the parent estimates"),
        }
    }

    /// Takes the pixels of the atoms in `message`, which are the first that were traced.
    fn pixels_of(&mut self, message: &Message) -> Vec<Colour> {
        let Message::Results(atoms) = message else { return Vec::new() };
        let count: u32 = atoms.iter().map(|range| self.division.pixels_in(range)).sum();
        let rest = self.pixels.split_off(count as usize);
        mem::replace(&mut self.pixels, rest)
    }
}

/// Gives each atom of the batch its share of the CPU time since the last reading.
fn split(batch: &mut Batch, meter: &mut Meter, port: &mut Port<'_>) {
    if batch.is_empty() {
        return;
    }
    for (index, share) in batch.split(meter.lap()) {
        if let What::AtomDone { cost, .. } = port.recorded(index) {
            *cost += share;
        }
    }
}
