//! Reading of scenes, recorded runs and lessons.

use std::fmt::Display;
use std::path::Path;
use std::sync::Arc;

use crate::language::{Language, say};
use crate::lesson::{self, Lesson};
use crate::runlog::{RunLog, is_run_file};
use crate::scene::Opened;

/// A scene, a recorded run or a lesson, read and checked.
#[derive(Clone, Debug)]
pub enum Opening {
    /// A scene.
    Scene(Arc<Opened>),
    /// A recorded run.
    Run(Arc<RunLog>),
    /// A lesson.
    Lesson(Arc<Lesson>),
}

impl Opening {
    /// Reads a file of a scene, a run or a lesson, or the built-in scene of that name.
    ///
    /// # Errors
    /// A sentence with the file's name, and the line and column of a mistake in it.
    pub fn read(argument: impl AsRef<Path>) -> Result<Self, String> {
        let path = argument.as_ref();
        if is_run_file(path) {
            let log = RunLog::load(path).map_err(|error| error.to_string())?;
            return Ok(Self::Run(Arc::new(log)));
        }
        if lesson::is_lesson_file(path) {
            let lesson = Lesson::open(path).map_err(|error| error.to_string())?;
            return Ok(Self::Lesson(Arc::new(lesson)));
        }
        let opened = Opened::new(path).map_err(|error| error.to_string())?;
        Ok(Self::Scene(Arc::new(opened)))
    }
}

/// Says that the scene in a run file cannot be read.
pub(super) fn unreadable_scene(error: &impl Display, language: Language) -> String {
    say!(
        language,
        "The scene in the run file cannot be read ({error}). Record the run again",
        "A cena no arquivo da execução não pode ser lida ({error}). Grave a execução de novo"
    )
}
