//! The parent on its thread: it passes placed pixels on to whoever started the run, in merged batches.

use std::mem;
use std::ops::Range;

use super::Update;
use super::port::{Incoming, Port, Stopped};
use super::shared::Command;
use crate::balance::{Action, Event, Message, NodeId, Parent};
use crate::picture::{Atom, Colour};
use crate::record::What;
use crate::runlog::Header;

/// What the parent's thread holds.
pub(super) struct ParentThread<'run> {
    parent: Parent,
    port: Port<'run>,
    placed: Placed,
    finished: bool,
}

/// Placed and not yet passed on.
#[derive(Default)]
struct Placed {
    atoms: Vec<Range<Atom>>,
    pixels: Vec<Colour>,
}

impl Placed {
    fn add(&mut self, atoms: &[Range<Atom>], pixels: Vec<Colour>) {
        self.atoms.extend_from_slice(atoms);
        if self.pixels.is_empty() {
            self.pixels = pixels;
        } else {
            self.pixels.extend(pixels);
        }
    }
}

impl<'run> ParentThread<'run> {
    /// The parent of the run that `header` describes.
    pub fn new(header: &Header, port: Port<'run>) -> Self {
        let parent = Parent::new(header.strategy, header.division, header.speeds.len() as NodeId);
        Self { parent, port, placed: Placed::default(), finished: false }
    }

    /// Runs the parent until the picture is complete, or until the run is stopped.
    pub fn run(mut self) {
        let _ = self.assemble();
        flush(&mut self.port, &mut self.placed);
    }

    fn assemble(&mut self) -> Result<(), Stopped> {
        self.port.advance(self.port.shared.clock.now());
        self.hand_over(Event::Started);
        while !self.finished {
            let now = self.port.step(|port| flush(port, &mut self.placed))?;
            match self.port.next(now) {
                Some(Incoming::Event(event, pixels)) => {
                    if let Event::Message { message: Message::Results(atoms), .. } = &event {
                        self.placed.add(atoms, pixels);
                    }
                    self.hand_over(event);
                }
                Some(Incoming::Command(Command::Latency(latency))) => {
                    self.port.record(What::LatencySet { latency });
                }
                Some(Incoming::Command(other)) => unreachable!("the parent has no machine for {other:?}"),
                None => self.port.wait(None),
            }
        }
        Ok(())
    }

    fn hand_over(&mut self, event: Event) {
        let mut actions = Vec::new();
        self.parent.handle(self.port.time(), event, &mut actions);
        for action in actions {
            match action {
                Action::Send { to, message } => self.port.send(to, message, Vec::new()),
                Action::Finish => {
                    self.port.record(What::Finished);
                    self.finished = true;
                }
                other => unreachable!("a parent never asks for {other:?}"),
            }
        }
    }
}

fn flush(port: &mut Port<'_>, placed: &mut Placed) {
    if !placed.atoms.is_empty() {
        let Placed { atoms, pixels } = mem::take(placed);
        port.update(Update::Placed { atoms, pixels });
    }
    port.flush();
}
