//! Executes the protocol: each party a thread, each node an emulated machine, each message on a link.

use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use crossbeam_channel::Receiver;

use crate::balance::NodeId;
use crate::picture::{Atom, Colour};
use crate::record::Record;
use crate::runlog::Header;
use crate::time::Time;
use crate::tracer::{RayCounts, Tracer};

/// What a run tells whoever started it, in merged batches; the channel is unbounded, but each atom crosses it once.
#[derive(Debug)]
pub enum Update {
    /// Records of one party, in the order of their times; those of different parties may interleave.
    Records(Vec<Record>),
    /// Pixels that the parent has placed.
    Placed {
        /// The atoms, in the order of `pixels`.
        atoms: Vec<Range<Atom>>,
        /// Their pixels, one atom after the other.
        pixels: Vec<Colour>,
    },
    /// A node's thread has ended and gives its sums.
    Totals {
        /// Which node.
        node: NodeId,
        /// Rays that its worker traced.
        rays: RayCounts,
        /// CPU time in the tracer.
        work: Duration,
    },
    /// All threads have ended and the picture is complete; the last update.
    Finished,
    /// The run cannot go on (a sentence says why); the last update.
    Failed(String),
}

/// A run that goes on in its own threads. Dropping it stops them and waits for them.
pub struct Run {
    updates: Receiver<Update>,
}

impl Run {
    /// Starts the run that `header` describes. Its own options are all in the header, so that a saved run can be
    /// started again.
    pub fn start(tracer: Arc<Tracer>, header: &Header) -> Self {
        let _ = (tracer, header);
        todo!()
    }

    /// What has happened since, oldest first.
    pub fn updates(&self) -> &Receiver<Update> {
        &self.updates
    }

    /// The run's clock; it stands still while the run is paused.
    pub fn now(&self) -> Time {
        todo!()
    }

    /// Changes a node's speed (0 to 1) at once, in the middle of an atom too.
    pub fn set_speed(&self, node: NodeId, speed: f64) {
        let _ = (node, speed);
        todo!()
    }

    /// Stops the run's clock, and with it all machines and all messages.
    pub fn pause(&self) {
        todo!()
    }

    /// Lets the run go on after [`Run::pause`].
    pub fn resume(&self) {
        todo!()
    }
}
