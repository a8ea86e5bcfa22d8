//! Traces the whole picture on all cores, and counts the rays of each atom: they are the costs of a run in virtual
//! time.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::Duration;

use super::TracePixels;
use super::error::ThreadError;
use super::supervisor::Threads;
use super::worker::trace_pieces;
use crate::cancel::CancelToken;
use crate::parallel::cores;
use crate::picture::{Atom, Colour, Division, Frame, Size};
use crate::sim::PixelCosts;
use crate::tracer::{RayCounts, Scratch, Tracer};

/// Cost of a ray of any kind on the reference machine, unless the atoms' costs were measured. It is about the cost on a
/// core of 2025. It is the same on every computer, so that runs in virtual time are the same too.
pub const RAY_COST: Duration = Duration::from_nanos(100);

/// A traced picture, with the number of rays of each atom.
#[derive(Clone, Debug, Default)]
pub struct TracedPicture {
    /// All pixels in scan order.
    pub pixels: Vec<Colour>,
    /// By atom: the number of its rays, of all kinds.
    pub rays: Vec<u32>,
    /// The number of rays of the whole picture, by kind.
    pub counts: RayCounts,
}

impl TracedPicture {
    /// Traces all atoms of `division`, and tells `done` from time to time how many more are traced.
    ///
    /// # Errors
    /// If a thread cannot be started, or panics.
    pub fn of(tracer: &Arc<Tracer>, division: Division, done: &(dyn Fn(u32) + Sync)) -> Result<Self, ThreadError> {
        Self::unless_cancelled(tracer, division, done, &CancelToken::default()).map(Option::unwrap_or_default)
    }

    /// Does the same as [`TracedPicture::of`]; returns `None` if cancelled before the end.
    ///
    /// # Errors
    /// As [`TracedPicture::of`].
    pub fn unless_cancelled(
        tracer: &Arc<Tracer>,
        division: Division,
        done: &(dyn Fn(u32) + Sync),
        cancel: &CancelToken,
    ) -> Result<Option<Self>, ThreadError> {
        let tracer = tracer.clone();
        let trace =
            move |pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>| tracer.trace(pixels, scratch, out);
        Self::trace(division, &trace, done, cancel)
    }

    /// Does the same as [`TracedPicture::trace`] for a picture of `size`; if cancelled before the end, returns the part
    /// that is traced instead.
    ///
    /// # Errors
    /// As [`TracedPicture::of`].
    pub fn or_part(
        size: Size,
        division: Division,
        trace: &TracePixels,
        done: &(dyn Fn(u32) + Sync),
        cancel: &CancelToken,
    ) -> Result<Result<Self, PartialPicture>, ThreadError> {
        let (pieces, is_whole) = trace_in_pieces(division, trace, done, cancel)?;
        if is_whole {
            return Ok(Ok(Self::of_pieces(pieces)));
        }
        let mut part = PartialPicture { frame: Frame::new(size), atoms: 0, counts: RayCounts::default() };
        for (first, piece) in pieces {
            let atoms = first..first + piece.rays.len() as Atom;
            let pixels = division.pixels_of(&atoms);
            // The last atom of a piece may be incomplete.
            part.frame.place(pixels.clone(), &piece.pixels[..pixels.len()]);
            part.atoms += atoms.len() as u32;
            part.counts += piece.counts;
        }
        Ok(Err(part))
    }

    /// Returns the cost of each atom on the reference machine in virtual time.
    pub fn costs(&self) -> Vec<Duration> {
        // Every atom has a ray, but a test's tracer may count none.
        self.rays.iter().map(|&rays| RAY_COST * rays.max(1)).collect()
    }

    /// Traces all atoms of `division` with `trace`, and tells `done` how many more are traced. Returns `None` if
    /// cancelled before the end.
    ///
    /// # Errors
    /// As [`TracedPicture::of`].
    pub fn trace(
        division: Division,
        trace: &TracePixels,
        done: &(dyn Fn(u32) + Sync),
        cancel: &CancelToken,
    ) -> Result<Option<Self>, ThreadError> {
        let (pieces, is_whole) = trace_in_pieces(division, trace, done, cancel)?;
        Ok(is_whole.then(|| Self::of_pieces(pieces)))
    }

    /// Joins all pieces of a picture, in scan order.
    fn of_pieces(pieces: Vec<(Atom, Piece)>) -> Self {
        let mut picture = Self::default();
        for (_, Piece { pixels, rays, counts }) in pieces {
            picture.pixels.extend(pixels);
            picture.rays.extend(rays);
            picture.counts += counts;
        }
        picture
    }
}

/// A traced picture with the cost of each pixel, for runs in virtual time with atoms of any size. It takes 20 bytes a
/// pixel.
#[derive(Debug)]
pub struct CostedPicture {
    /// All pixels in scan order.
    pub pixels: Vec<Colour>,
    /// The cost of each pixel on the reference machine in virtual time.
    pub costs: PixelCosts,
    /// The number of its rays, by kind.
    pub counts: RayCounts,
}

impl CostedPicture {
    /// Traces the picture on all cores, and tells `done` from time to time how many more pixels are traced. Returns
    /// `None` if cancelled before the end.
    ///
    /// # Errors
    /// As [`TracedPicture::of`].
    pub fn trace(
        tracer: &Arc<Tracer>,
        done: &(dyn Fn(u32) + Sync),
        cancel: &CancelToken,
    ) -> Result<Option<Self>, ThreadError> {
        let size = tracer.size();
        let picture = TracedPicture::unless_cancelled(tracer, Division::new(size.pixels(), 1), done, cancel)?;
        Ok(picture.map(|picture| {
            let costs = PixelCosts::new(size, &picture.costs());
            Self { pixels: picture.pixels, costs, counts: picture.counts }
        }))
    }
}

/// The part of a picture that was traced before its tracing was cancelled.
#[derive(Clone, Debug)]
pub struct PartialPicture {
    /// The picture; missing pixels are black.
    pub frame: Frame,
    /// The number of atoms in it.
    pub atoms: u32,
    /// The number of its rays, by kind.
    pub counts: RayCounts,
}

struct Piece {
    pixels: Vec<Colour>,
    rays: Vec<u32>,
    counts: RayCounts,
}

/// Traces all atoms of `division` with `trace`, and tells `done` how many more are traced. Returns the pieces in scan
/// order, each with its first atom, and whether they are the whole picture.
fn trace_in_pieces(
    division: Division,
    trace: &TracePixels,
    done: &(dyn Fn(u32) + Sync),
    cancel: &CancelToken,
) -> Result<(Vec<(Atom, Piece)>, bool), ThreadError> {
    /// Pixels that a thread takes at a time: few enough that all threads end together, enough that they do not wait
    /// for each other.
    const PIXELS_AT_A_TIME: u32 = 1024;
    let atoms = (PIXELS_AT_A_TIME / division.atom_pixels()).max(1);
    let (next, failed) = (AtomicU32::new(0), CancelToken::default());
    let is_over = || cancel.is_cancelled() || failed.is_cancelled();
    let (sender, pieces) = crossbeam_channel::unbounded();
    thread::scope(|scope| {
        let mut threads = Threads::new(scope, || failed.cancel());
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
                    // Cannot fail: the receiver outlives the threads.
                    let _ = sender.send((first, piece));
                }
            };
            threads.start(&format!("tracer {index}"), work);
        }
        threads.join()
    })?;
    drop(sender);
    let mut pieces: Vec<(Atom, Piece)> = pieces.iter().collect();
    pieces.sort_by_key(|(first, _)| *first);
    let traced: usize = pieces.iter().map(|(_, piece)| piece.rays.len()).sum();
    Ok((pieces, traced == division.atoms() as usize))
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
