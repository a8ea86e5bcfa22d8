//! The parent on its thread. It sends placed pixels to the run's owner in merged batches.

use std::mem;
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use super::dedup::PlacedOnce;
use super::endpoint::{Endpoint, Incoming, Stopped};
use super::error::UntraceableAtom;
use super::meter::Meter;
use super::{TracePixels, Update};
use crate::balance::{Action, Event, Message, NodeId, Parent, estimate};
use crate::picture::{Atom, Colour, Division, Size};
use crate::record::RecordKind;
use crate::runlog::Header;
use crate::scenario::Command;
use crate::sim::Machine;
use crate::tracer::Scratch;

/// The state of the parent's thread.
pub(super) struct ParentThread {
    parent: Parent,
    endpoint: Endpoint,
    trace: Arc<TracePixels>,
    size: Size,
    division: Division,
    /// The machine of the estimate, as fast as the reference machine.
    machine: Machine,
    placed: Placed,
    placed_once: PlacedOnce,
    /// Whether the parent has asked for an estimate.
    wants_estimate: bool,
    finished: bool,
}

/// Pixels that are placed and not sent to the run's owner yet.
#[derive(Default)]
struct Placed {
    atoms: Vec<Range<Atom>>,
    pixels: Vec<Colour>,
}

impl ParentThread {
    /// Creates the parent of the run that `header` describes.
    pub fn new(header: &Header, endpoint: Endpoint, trace: Arc<TracePixels>) -> Self {
        let nodes = header.speeds.len() as NodeId;
        let parent = Parent::with_spares(&header.rules, header.division, nodes, header.spares);
        let machine = Machine::new(1.0, header.pace);
        let (division, placed) = (header.division, Placed::default());
        let size = header.size;
        let placed_once = PlacedOnce::new(division);
        Self {
            parent,
            endpoint,
            trace,
            size,
            division,
            machine,
            placed,
            placed_once,
            wants_estimate: false,
            finished: false,
        }
    }

    /// Runs the parent until the picture is complete, or until the run is stopped.
    pub fn run(mut self) {
        let _ = self.assemble();
        flush(&mut self.endpoint, &mut self.placed);
    }

    fn assemble(&mut self) -> Result<(), Stopped> {
        self.endpoint.advance(self.endpoint.shared.clock.now());
        self.handle_event(Event::Started);
        if self.wants_estimate {
            let costs = self.estimate()?;
            self.endpoint.record(RecordKind::Estimated { costs: costs.clone() });
            self.handle_event(Event::Estimated(costs));
        }
        while !self.finished {
            let now = self.endpoint.step(|endpoint| flush(endpoint, &mut self.placed))?;
            match self.endpoint.next(now) {
                Some(Incoming::Event(event, pixels)) => {
                    if let Event::Message { message: Message::Results(atoms), .. } = &event {
                        self.place(atoms, &pixels);
                    }
                    self.handle_event(event);
                }
                Some(Incoming::Command(Command::Latency(latency))) => {
                    self.endpoint.record(RecordKind::LatencySet { latency });
                }
                Some(Incoming::Command(Command::OwnLatency { party, latency })) => {
                    self.endpoint.record(RecordKind::OwnLatencySet { party, latency });
                }
                Some(Incoming::Command(Command::Link { one, other, cut })) => {
                    self.endpoint.record(RecordKind::Link { one, other, cut });
                }
                Some(Incoming::Command(Command::Delay { from, .. })) => self.endpoint.record_delay(from),
                Some(Incoming::Command(other)) => unreachable!("the parent has no machine for {other:?}"),
                Some(Incoming::WorkerOrder(_)) => unreachable!("the parent is no worker"),
                None => self.endpoint.wait(None),
            }
        }
        Ok(())
    }

    /// Keeps the pixels of those atoms that are not in the picture yet, to send them to the run's owner.
    fn place(&mut self, atoms: &[Range<Atom>], pixels: &[Colour]) {
        for (range, (place, colours)) in atoms.iter().zip(self.division.placed(atoms, pixels)) {
            for new in self.placed_once.take(range.clone()) {
                let pixels = self.division.pixels_of(&new);
                let [from, to] = [pixels.start, pixels.end].map(|pixel| (pixel - place.start) as usize);
                self.placed.pixels.extend_from_slice(&colours[from..to]);
                self.placed.atoms.push(new);
            }
        }
    }

    /// Samples the cost of the picture, by stretch, and waits until the reference machine would have done the same
    /// work.
    fn estimate(&mut self) -> Result<Vec<Duration>, Stopped> {
        self.endpoint.record(RecordKind::Estimating);
        let (mut meter, mut scratch, mut pixels) = (Meter::new(), Scratch::default(), Vec::new());
        let mut costs = Vec::new();
        for samples in estimate::samples(self.division) {
            self.endpoint.step(Endpoint::flush)?;
            meter.lap();
            for pixel in samples {
                (self.trace)(pixel..pixel + 1, &mut scratch, &mut pixels);
            }
            costs.push(meter.lap());
            pixels.clear();
        }
        if self.machine.is_full() {
            self.endpoint.advance(self.endpoint.shared.clock.now());
            return Ok(costs);
        }
        self.machine.begin(self.endpoint.time(), costs.iter().sum());
        // The reference machine never stands still.
        let due = self.machine.due().unwrap_or(self.endpoint.time());
        while self.endpoint.step(Endpoint::flush)? < due {
            self.endpoint.wait(Some(due));
        }
        self.endpoint.advance(due);
        Ok(costs)
    }

    fn handle_event(&mut self, event: Event) {
        let mut actions = Vec::new();
        self.parent.handle(self.endpoint.time(), event, &mut actions);
        // Before the shutdown leaves, so that the nodes that it cannot reach end as well.
        if actions.contains(&Action::Finish) {
            self.endpoint.shared.finish();
        }
        for action in actions {
            match action {
                Action::Send { to, message } => self.endpoint.send(to, message, Vec::new()),
                Action::Finish => {
                    self.endpoint.record(RecordKind::Finished);
                    self.finished = true;
                }
                Action::Estimate => self.wants_estimate = true,
                Action::SetTimer(at) => self.endpoint.set_timer(at),
                Action::Fail(atom) => {
                    self.endpoint.record(RecordKind::GivenUp { atom });
                    self.finished = true;
                    self.endpoint.shared.fail(self.untraceable(atom));
                }
                other => unreachable!("a parent never asks for {other:?}"),
            }
        }
    }

    fn untraceable(&self, atom: Atom) -> UntraceableAtom {
        let (first, width) = (self.division.pixels(atom).start, self.size.width());
        UntraceableAtom { atom, column: first % width, row: first / width }
    }
}

fn flush(endpoint: &mut Endpoint, placed: &mut Placed) {
    if !placed.atoms.is_empty() {
        let Placed { atoms, pixels } = mem::take(placed);
        endpoint.update(Update::Placed { atoms, pixels });
    }
    endpoint.flush();
}
