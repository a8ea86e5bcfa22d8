//! Why a study fails.

use std::error::Error;
use std::io;

use thiserror::Error;

use super::peer::PovRayError;
use crate::ron_file::FileError;

/// An error of another module.
type Source = Box<dyn Error + Send + Sync>;

/// Why a study could not be finished.
#[derive(Debug, Error)]
pub enum StudyError {
    /// A picture cannot have the size that the study asks for.
    #[error("the study cannot trace its picture: {0}")]
    Size(#[source] Source),
    /// A scene that belongs to the study cannot be opened.
    #[error("the study's own scene cannot be opened: {0}")]
    Scene(#[from] FileError),
    /// A picture could not be traced, or a run did not end.
    #[error("a run failed: {0}; try again")]
    Run(#[source] Source),
    /// A measurement was cancelled.
    #[error("the measurement was cancelled; start it again")]
    Cancelled,
    /// A row could not become JSON.
    #[error("a row of the study cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A file of the study could not be encoded.
    #[error("the study cannot make {file}: {source}")]
    File {
        /// The file's name.
        file: String,
        /// What went wrong.
        source: io::Error,
    },
    /// POV-Ray did not do its part.
    #[error(transparent)]
    PovRay(#[from] PovRayError),
}

impl StudyError {
    /// Wraps the error of a size.
    pub(super) fn size(source: impl Into<Source>) -> Self {
        Self::Size(source.into())
    }

    /// Wraps the error of a run or of a traced picture.
    pub(super) fn run(source: impl Into<Source>) -> Self {
        Self::Run(source.into())
    }

    /// Wraps what went wrong while the file of this name was encoded.
    pub(super) fn file(file: impl Into<String>, source: impl Into<io::Error>) -> Self {
        Self::File { file: file.into(), source: source.into() }
    }
}
