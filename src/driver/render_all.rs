//! The whole picture at once, on all cores, and how many rays each of its atoms takes: what a run in virtual time needs.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::Duration;

use super::TracePixels;
use super::pace::cores;
use super::supervisor::Threads;
use super::worker::trace_pieces;
use crate::picture::{Atom, Colour, Division};
use crate::sim::PixelCosts;
use crate::tracer::{RayCounts, Scratch, Tracer};

/// What a ray of any kind takes the reference machine, unless an atom's cost is known otherwise. It is about what one
/// takes a core of 2025, and the same on every computer, so that a run in virtual time is the same too.
pub const RAY: Duration = Duration::from_nanos(100);

/// A picture that is traced, and what its atoms take.
#[derive(Clone, Debug, Default)]
pub struct TracedPicture {
    /// All pixels in scan order.
    pub pixels: Vec<Colour>,
    /// By atom: how many rays of all kinds it takes.
    pub rays: Vec<u32>,
    /// The rays of the whole picture.
    pub counts: RayCounts,
}

impl TracedPicture {
    /// Traces all atoms of `division`, and tells `done` from time to time how many more are traced.
    ///
    /// # Errors
    /// A sentence, if a thread could not be started, or failed.
    pub fn of(tracer: &Arc<Tracer>, division: Division, done: &(dyn Fn(u32) + Sync)) -> Result<Self, String> {
        Self::unless(tracer, division, done, &|| false).map(Option::unwrap_or_default)
    }

    /// As [`TracedPicture::of`], but `None` if it `is_over` before.
    ///
    /// # Errors
    /// As [`TracedPicture::of`].
    pub fn unless(
        tracer: &Arc<Tracer>,
        division: Division,
        done: &(dyn Fn(u32) + Sync),
        is_over: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, String> {
        let tracer = tracer.clone();
        let trace =
            move |pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>| tracer.trace(pixels, scratch, out);
        Self::trace(division, &trace, done, is_over)
    }

    /// Traces the picture pixel by pixel, so that it can be cut into atoms of any size: all pixels in scan order, and what
    /// each costs the reference machine in virtual time. `None` if it `is_over` before.
    ///
    /// # Errors
    /// As [`TracedPicture::of`].
    pub fn by_pixel(
        tracer: &Arc<Tracer>,
        done: &(dyn Fn(u32) + Sync),
        is_over: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<(Vec<Colour>, PixelCosts)>, String> {
        let size = tracer.size();
        let whole = Self::unless(tracer, Division::new(size.pixels(), 1), done, is_over)?;
        Ok(whole.map(|whole| {
            let costs = PixelCosts::new(size, &whole.costs());
            (whole.pixels, costs)
        }))
    }

    /// What each atom costs the reference machine in virtual time.
    pub fn costs(&self) -> Vec<Duration> {
        // An atom of no ray does not exist, but a tracer may count none.
        self.rays.iter().map(|&rays| RAY * rays.max(1)).collect()
    }

    /// Traces all atoms of `division`, and tells `done` how many more are traced. `None` if it `is_over` before.
    ///
    /// # Errors
    /// A sentence, if a thread could not be started, or what one said that panicked.
    pub(super) fn trace(
        division: Division,
        trace: &TracePixels,
        done: &(dyn Fn(u32) + Sync),
        is_over: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, String> {
        /// Threads take so many pixels at a time: few enough to end together, many enough not to get in each other's way.
        const TAKEN: u32 = 1024;
        let atoms = (TAKEN / division.atom_pixels()).max(1);
        let (next, failed) = (AtomicU32::new(0), AtomicU32::new(0));
        let is_over = || is_over() || failed.load(Ordering::Relaxed) > 0;
        let (sender, pieces) = crossbeam_channel::unbounded();
        thread::scope(|scope| {
            let mut threads = Threads::new(scope, || _ = failed.fetch_add(1, Ordering::Relaxed));
            for index in 0..cores() {
                let (sender, next, is_over) = (sender.clone(), &next, &is_over);
                let work = move || {
                    let mut scratch = Scratch::default();
                    loop {
                        let first = next.fetch_add(atoms, Ordering::Relaxed);
                        if first >= division.atoms() || is_over() {
                            break;
                        }
                        let last = division.atoms().min(first.saturating_add(atoms));
                        let piece = trace_atoms(division, first..last, trace, &mut scratch, is_over);
                        done(last - first);
                        // The receiver outlives the threads.
                        let _ = sender.send((first, piece));
                    }
                };
                threads.start(&format!("tracer {index}"), work);
            }
            threads.join()
        })?;
        drop(sender);
        if is_over() {
            return Ok(None);
        }
        let mut pieces: Vec<(Atom, Piece)> = pieces.iter().collect();
        pieces.sort_by_key(|(first, _)| *first);
        let mut whole = Self::default();
        for (_, Piece { pixels, rays, counts }) in pieces {
            whole.pixels.extend(pixels);
            whole.rays.extend(rays);
            whole.counts += counts;
        }
        Ok(Some(whole))
    }
}

struct Piece {
    pixels: Vec<Colour>,
    rays: Vec<u32>,
    counts: RayCounts,
}

fn trace_atoms(
    division: Division,
    atoms: Range<Atom>,
    trace: &TracePixels,
    scratch: &mut Scratch,
    is_over: impl Fn() -> bool,
) -> Piece {
    let mut piece = Piece { pixels: Vec::new(), rays: Vec::new(), counts: RayCounts::default() };
    for atom in atoms {
        scratch.rays = RayCounts::default();
        if !trace_pieces(trace, division.pixels(atom), scratch, &mut piece.pixels, &is_over) {
            break;
        }
        piece.rays.push(u32::try_from(scratch.rays.total()).unwrap_or(u32::MAX));
        piece.counts += scratch.rays;
    }
    piece
}
