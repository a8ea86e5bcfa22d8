//! Executes the protocol on threads: each party is a thread, each node an emulated machine, each message travels on a
//! link.
//!
//! The threads of a run are one for each node (its handler and its worker), one for the parent, and a supervisor that
//! starts them, waits for their end and reports the outcome. Parties share only the clock, the network and each other's
//! inboxes.
//!
//! Each party has its own time, at which it acts and which its records bear: the time of the emulated machine. A thread
//! may wake a little late, or work a little ahead of the clock, but its actions are dated to the time at which the
//! machine would have done them, and their consequences are due accordingly. Machines at full speed are not emulated:
//! their times are those of the clock.
//!
//! Two other kinds of runs serve for comparison: two threads for each node, as in the article, and rayon's work
//! stealing. They use the same workers, parent and endpoints.
//!
//! Machines and links may fail, as in virtual time (`sim`). A node's thread continues while its machine hangs or is
//! off, since the thread emulates the machine. A node that the shutdown cannot reach ends with the run all the same.
//!
//! A recorded run has no parties any more: its records are known, and threads trace its picture again.

mod clock;
mod dedup;
mod endpoint;
mod error;
mod failures;
mod meter;
mod node_thread;
mod pace;
mod pair_threads;
mod panic_guard;
mod parent_thread;
mod picture_cache;
mod probe;
mod render_all;
mod render_tiled;
mod render_timed;
mod retrace;
mod retrace_plan;
mod run;
mod run_context;
mod run_to_end;
mod shared;
mod sim_thread;
mod stealing;
mod supervisor;
mod worker;

pub use error::{RunError, ThreadError, UntraceableAtom};
pub use pace::auto_pace;
pub use picture_cache::PictureCache;
pub use probe::{Probe, probe};
pub use render_all::{CostedPicture, PartialPicture, RAY_COST, TracedPicture};
pub use render_tiled::trace_strips;
pub use render_timed::TimedPicture;
pub use retrace::Retrace;
pub use run::Run;
pub use run_to_end::run_to_end;

use std::ops::Range;

use crate::picture::{Atom, Colour};
use crate::record::Record;
use crate::tracer::{RayCounts, Scratch};

/// An update of a run for its owner, in merged batches. The channel is unbounded, but each atom crosses it once.
#[derive(Debug)]
pub enum Update {
    /// Records of one party, in the order of their times; those of different parties may interleave.
    Records(Vec<Record>),
    /// Pixels that the parent has placed in the picture.
    Placed {
        /// The atoms, in the order of `pixels`.
        atoms: Vec<Range<Atom>>,
        /// Their pixels, one atom after the other.
        pixels: Vec<Colour>,
    },
    /// The number of rays that a worker has traced; its thread has ended.
    Rays(RayCounts),
    /// All threads have ended, and the picture is complete, or as complete as the log of a recorded run; the last
    /// update.
    Finished,
    /// The run cannot go on, for this reason; the last update.
    Failed(RunError),
}

/// Appends the colours of pixels (positions in scan order) to a vector, as
/// [`Tracer::trace`](crate::tracer::Tracer::trace) does.
pub type TracePixels = dyn Fn(Range<u32>, &mut Scratch, &mut Vec<Colour>) + Send + Sync;
