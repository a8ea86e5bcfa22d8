//! What can be opened: a scene, a recorded run, or a lesson.

use std::path::Path;
use std::sync::Arc;

use crate::lesson::{self, Lesson};
use crate::runlog::{RunLog, is_run_file};
use crate::scene::Opened;

/// What the window shows.
#[derive(Clone, Debug)]
pub enum Opening {
    /// A scene, to be traced.
    Scene(Arc<Opened>),
    /// A recorded run, to be played again.
    Run(Arc<RunLog>),
    /// A lesson, to be taken.
    Lesson(Arc<Lesson>),
}

impl Opening {
    /// Reads the file of a scene, a run or a lesson, or the built-in scene of that name.
    ///
    /// # Errors
    /// A sentence that names the file, and the line and column of a mistake in it.
    pub fn read(argument: &str) -> Result<Self, String> {
        let path = Path::new(argument);
        if is_run_file(path) {
            let log = RunLog::load(path).map_err(|error| error.to_string())?;
            return Ok(Self::Run(Arc::new(log)));
        }
        if lesson::is_lesson_file(path) {
            let lesson = Lesson::open(argument).map_err(|error| error.to_string())?;
            return Ok(Self::Lesson(Arc::new(lesson)));
        }
        let opened = Opened::new(argument).map_err(|error| error.to_string())?;
        Ok(Self::Scene(Arc::new(opened)))
    }
}
