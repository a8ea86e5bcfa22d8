//! Executes the protocol: each party a thread, each node an emulated machine, each message on a link.
//!
//! The threads of a run: one a node (its handler and its worker), one for the parent, and one that started them, waits
//! for their end, and says how it went. Parties share nothing but the clock and each other's inboxes.
//!
//! Each party has a time of its own, at which it acts and which its records bear. It is that of the emulated machine: a
//! thread may wake a little late, or work a little ahead of the clock, but what it does is dated to when the machine
//! would have done it, and what comes of it is due accordingly. Machines at full speed are not emulated: their times
//! are the clock's.
//!
//! Two kinds of runs are there to be compared with this one: that with two threads a node, as the article has it, and
//! that in which rayon shares the atoms by work stealing. Their workers, their parent and their ports are the same.
//!
//! Machines and links may fail, as they do in virtual time (`sim`): a node's thread goes on while its machine hangs or is
//! off, since it is the machine. A node that cannot hear that the run is over ends with it all the same.
//!
//! A recorded run has no parties any more: its records are known, and threads trace its picture again.

mod clock;
mod dedup;
mod endpoint;
mod failures;
mod meter;
mod node_thread;
mod pace;
mod pair_threads;
mod panic_guard;
mod parent_thread;
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

pub use pace::{auto_pace, cores};
pub use probe::{Probe, probe};
pub use render_all::{RAY, TracedPicture};
pub use render_tiled::trace_strips;
pub use render_timed::TimedPicture;
pub use retrace::Retrace;
pub use run::Run;
pub use run_to_end::run_to_end;

use std::ops::Range;

use crate::picture::{Atom, Colour};
use crate::record::Record;
use crate::tracer::{RayCounts, Scratch};

/// What a run tells whoever started it, in merged batches; the channel is unbounded, but each atom crosses
/// it once.
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
    /// How many rays a node's worker has traced; its thread has ended.
    Rays(RayCounts),
    /// All threads have ended, and the picture is complete (or as complete as the log of a recorded run); the last update.
    Finished,
    /// It cannot go on (a sentence says why); the last update.
    Failed(String),
}

/// Appends the colours of pixels (positions in scan order) to a vector, as
/// [`Tracer::trace`](crate::tracer::Tracer::trace) does.
pub type TracePixels = dyn Fn(Range<u32>, &mut Scratch, &mut Vec<Colour>) + Send + Sync;
