//! Errors of reading a run file.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use super::validate::{InvalidHeader, InvalidRecord};

/// Version of the format that this program writes, and the only one that it reads.
pub(super) const VERSION: u32 = 3;

/// Why a run file could not be read.
#[derive(Debug, Error)]
pub enum LogError {
    /// The file could not be read.
    #[error("cannot read {path}: {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The file is not a run file, or a damaged one.
    #[error("{path}, line {line}: {why}")]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The error.
        #[source]
        why: LineError,
    },
}

/// An error in a line of a run file.
#[derive(Debug, Error)]
pub enum LineError {
    /// The file does not begin as a run file does.
    #[error("this is not a run file of anel")]
    NotARun,
    /// The file has an older version of the format.
    #[error(
        "the file is from an older anel (its format's version is {0}; this program reads version {VERSION}); \
         make the run anew"
    )]
    Older(u32),
    /// The file has a newer version of the format.
    #[error(
        "the file is from a newer anel (its format's version is {0}; this program reads version {VERSION}); \
         open it with that one"
    )]
    Newer(u32),
    /// The line is no text.
    #[error("the line is not text (UTF-8)")]
    NotText,
    /// The line is no JSON, or not the JSON that is expected.
    #[error("{what}, at column {column}")]
    Json {
        /// The message of the parser, without the line.
        what: String,
        /// The column, from 1.
        column: usize,
    },
    /// The header is impossible.
    #[error(transparent)]
    Header(#[from] InvalidHeader),
    /// The record is impossible.
    #[error(transparent)]
    Record(#[from] InvalidRecord),
}
