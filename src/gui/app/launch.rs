//! Options with which the window opens.

use std::path::PathBuf;

use crate::gui::session::opening::Opening;
use crate::language::Language;

/// Options with which the window opens.
#[derive(Clone, Debug, Default)]
pub struct Launch {
    /// The scene, run or lesson to open; `None` opens the last scene again.
    pub opening: Option<Opening>,
    /// File for the records of each run, written when the run ends or the window closes.
    pub log: Option<PathBuf>,
    /// Language of the window, unless the user has chosen one before.
    pub language: Language,
}
