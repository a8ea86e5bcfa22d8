//! Error of a run in virtual time with the costs of a recorded one.

use thiserror::Error;

use crate::picture::Size;

/// Why the costs of a recorded run cannot be used for another run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MeasuredError {
    /// The recorded run is of another division of the picture.
    #[error(
        "its picture has {0} pixels in atoms of {1}, but this run has {2} pixels in atoms of {3}; \
         use the same size and the same atoms",
        measured.0, measured.1, asked.0, asked.1
    )]
    OtherDivision {
        /// Size of the recorded picture, and the pixels in an atom of it.
        measured: (Size, u32),
        /// Size of the picture that is to be run, and the pixels in an atom of it.
        asked: (Size, u32),
    },
    /// The recorded run has not traced all atoms, so that costs are missing.
    #[error("it has not traced all atoms; use a run that is complete")]
    NotAllTraced,
}
