//! Errors of runs and of their threads.

use std::io;

use thiserror::Error;

use crate::picture::Atom;

/// Why a run, or the tracing of a recorded one, has no result.
#[derive(Debug, Error)]
pub enum RunError {
    /// [`Run::stop`](super::Run::stop) or [`Retrace::stop`](super::Retrace::stop) was called.
    #[error("the run was stopped")]
    Stopped,
    /// Several workers have failed to trace an atom.
    #[error(transparent)]
    UntraceableAtom(#[from] UntraceableAtom),
    /// A thread could not be started, or has panicked.
    #[error(transparent)]
    Thread(#[from] ThreadError),
    /// The run's threads have ended without a last update.
    #[error("the run ended without a result")]
    NoResult,
}

/// An atom that several workers have failed to trace.
#[derive(Clone, Copy, Debug, Error)]
#[error("no worker could trace atom {atom}, whose first pixel is at {column},{row}")]
pub struct UntraceableAtom {
    /// The atom.
    pub atom: Atom,
    /// Column of its first pixel, from 0.
    pub column: u32,
    /// Row of its first pixel, from 0 at the top.
    pub row: u32,
}

/// Why a thread did not do its work.
#[derive(Debug, Error)]
pub enum ThreadError {
    /// The system has started no thread.
    #[error("the thread of {name} could not be started: {source}")]
    NotStarted {
        /// The thread's name.
        name: String,
        /// The system's reason.
        source: io::Error,
    },
    /// The thread has panicked.
    #[error("{name} failed: {message}")]
    Panicked {
        /// The thread's name.
        name: String,
        /// The message of the panic.
        message: String,
    },
}
