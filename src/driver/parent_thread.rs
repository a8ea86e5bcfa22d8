//! The parent on its thread: it passes placed pixels on to whoever started the run, in merged batches.

use std::mem;
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use super::dedup::PlacedOnce;
use super::endpoint::{Endpoint, Incoming, Stopped};
use super::meter::Meter;
use super::{TracePixels, Update};
use crate::balance::{Action, Event, Message, NodeId, Parent, estimate};
use crate::picture::{Atom, Colour, Division, Size};
use crate::record::RecordKind;
use crate::runlog::Header;
use crate::scenario::Command;
use crate::sim::Machine;
use crate::tracer::Scratch;

/// What the parent's thread holds.
pub(super) struct ParentThread {
    parent: Parent,
    port: Endpoint,
    trace: Arc<TracePixels>,
    size: Size,
    division: Division,
    /// Traces for an estimate, as fast as the reference machine.
    machine: Machine,
    placed: Placed,
    firsts: PlacedOnce,
    /// Whether the parent has asked for an estimate.
    estimate: bool,
    finished: bool,
}

/// Placed and not yet passed on.
#[derive(Default)]
struct Placed {
    atoms: Vec<Range<Atom>>,
    pixels: Vec<Colour>,
}

impl ParentThread {
    /// The parent of the run that `header` describes.
    pub fn new(header: &Header, port: Endpoint, trace: Arc<TracePixels>) -> Self {
        let nodes = header.speeds.len() as NodeId;
        let parent = Parent::with_spares(&header.rules, header.division, nodes, header.spares);
        let machine = Machine::new(1.0, header.pace);
        let (division, placed) = (header.division, Placed::default());
        let size = header.size;
        let firsts = PlacedOnce::new(division);
        Self { parent, port, trace, size, division, machine, placed, firsts, estimate: false, finished: false }
    }

    /// Runs the parent until the picture is complete, or until the run is stopped.
    pub fn run(mut self) {
        let _ = self.assemble();
        flush(&mut self.port, &mut self.placed);
    }

    fn assemble(&mut self) -> Result<(), Stopped> {
        self.port.advance(self.port.shared.clock.now());
        self.hand_over(Event::Started);
        if self.estimate {
            let costs = self.estimate()?;
            self.port.record(RecordKind::Estimated { costs: costs.clone() });
            self.hand_over(Event::Estimated(costs));
        }
        while !self.finished {
            let now = self.port.step(|port| flush(port, &mut self.placed))?;
            match self.port.next(now) {
                Some(Incoming::Event(event, pixels)) => {
                    if let Event::Message { message: Message::Results(atoms), .. } = &event {
                        self.place(atoms, &pixels);
                    }
                    self.hand_over(event);
                }
                Some(Incoming::Command(Command::Latency(latency))) => {
                    self.port.record(RecordKind::LatencySet { latency });
                }
                Some(Incoming::Command(Command::Link { one, other, cut })) => {
                    self.port.record(RecordKind::Link { one, other, cut });
                }
                Some(Incoming::Command(Command::Delay { from, .. })) => self.port.delayed(from),
                Some(Incoming::Command(other)) => unreachable!("the parent has no machine for {other:?}"),
                Some(Incoming::WorkerOrder(_)) => unreachable!("the parent is no worker"),
                None => self.port.wait(None),
            }
        }
        Ok(())
    }

    /// Keeps the pixels of those of these atoms that are not in the picture yet, to be passed on.
    fn place(&mut self, atoms: &[Range<Atom>], pixels: &[Colour]) {
        for (range, (place, colours)) in atoms.iter().zip(self.division.placed(atoms, pixels)) {
            for new in self.firsts.take(range.clone()) {
                let pixels = self.division.pixels_of(&new);
                let [from, to] = [pixels.start, pixels.end].map(|pixel| (pixel - place.start) as usize);
                self.placed.pixels.extend_from_slice(&colours[from..to]);
                self.placed.atoms.push(new);
            }
        }
    }

    /// Samples what the picture costs, and waits until the reference machine would have done as much.
    fn estimate(&mut self) -> Result<Vec<Duration>, Stopped> {
        self.port.record(RecordKind::Estimating);
        let (mut meter, mut scratch, mut pixels) = (Meter::new(), Scratch::default(), Vec::new());
        let mut costs = Vec::new();
        for samples in estimate::samples(self.division) {
            self.port.step(Endpoint::flush)?;
            meter.lap();
            for pixel in samples {
                (self.trace)(pixel..pixel + 1, &mut scratch, &mut pixels);
            }
            costs.push(meter.lap());
            pixels.clear();
        }
        if self.machine.is_full() {
            self.port.advance(self.port.shared.clock.now());
            return Ok(costs);
        }
        self.machine.begin(self.port.time(), costs.iter().sum());
        // The reference machine never stands still.
        let due = self.machine.due().unwrap_or(self.port.time());
        while self.port.step(Endpoint::flush)? < due {
            self.port.wait(Some(due));
        }
        self.port.advance(due);
        Ok(costs)
    }

    fn hand_over(&mut self, event: Event) {
        let mut actions = Vec::new();
        self.parent.handle(self.port.time(), event, &mut actions);
        // Before its last message leaves, so that whoever is not told knows that it will not be.
        if actions.contains(&Action::Finish) {
            self.port.shared.finish();
        }
        for action in actions {
            match action {
                Action::Send { to, message } => self.port.send(to, message, Vec::new()),
                Action::Finish => {
                    self.port.record(RecordKind::Finished);
                    self.finished = true;
                }
                Action::Estimate => self.estimate = true,
                Action::SetTimer(at) => self.port.set_timer(at),
                Action::Fail(atom) => {
                    self.port.record(RecordKind::GivenUp { atom });
                    self.finished = true;
                    self.port.shared.fail(self.no_way_to_trace(atom));
                }
                other => unreachable!("a parent never asks for {other:?}"),
            }
        }
    }

    fn no_way_to_trace(&self, atom: Atom) -> String {
        let (first, width) = (self.division.pixels(atom).start, self.size.width());
        let (column, row) = (first % width, first / width);
        format!("no worker could trace atom {atom}, whose first pixel is at {column},{row}")
    }
}

fn flush(port: &mut Endpoint, placed: &mut Placed) {
    if !placed.atoms.is_empty() {
        let Placed { atoms, pixels } = mem::take(placed);
        port.update(Update::Placed { atoms, pixels });
    }
    port.flush();
}
