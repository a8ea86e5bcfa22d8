//! Error of a run in virtual time with the costs of a recorded one.

use thiserror::Error;

use crate::picture::Size;

/// Why the costs of a recorded run cannot be used for another run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MeasuredError {
    /// The recorded run is of another division of the picture.
    #[error("it is of a picture of {} in atoms of {} pixels, not of {} in atoms of {}", measured.0, measured.1, asked.0, asked.1)]
    OtherDivision {
        /// Size of the recorded picture, and the pixels in an atom of it.
        measured: (Size, u32),
        /// Size of the picture that is to be run, and the pixels in an atom of it.
        asked: (Size, u32),
    },
    /// The recorded run has not traced all atoms, so that costs are missing.
    #[error("not all atoms were traced")]
    NotAllTraced,
}
