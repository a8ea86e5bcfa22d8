//! The scene file: RON, and errors that say where.

use std::path::{Path, PathBuf};

use super::resolve::resolve;
use super::syntax::SceneFile;
use super::{BUILT_IN, Scene, built_in};
use crate::ron_file::{self, FileError, find_name};

/// A scene with what a run has to know of its file.
#[derive(Clone, Debug)]
pub struct Opened {
    /// The file's name without its ending.
    pub name: String,
    /// The file that it was read from; `None` if it is built in or was given as text.
    pub path: Option<PathBuf>,
    /// The file's text.
    pub text: String,
    /// What it says.
    pub scene: Scene,
}

impl Opened {
    /// Reads the scene file `argument`, or the built-in scene of that name if there is no such file.
    ///
    /// # Errors
    /// A [`FileError`] that names the file.
    pub fn new(argument: &str) -> Result<Self, FileError> {
        let path = Path::new(argument);
        let name = path.file_stem().map_or_else(|| argument.into(), |stem| stem.to_string_lossy().into_owned());
        if !path.exists()
            && let Some(text) = built_in(argument)
        {
            return Self::from_text(&name, text);
        }
        let text = ron_file::read(path, "scene", BUILT_IN.iter().map(|(name, _)| *name));
        text.map_err(FileError::from)
            .and_then(|text| Self::from_text(&name, &text))
            .map(|opened| Self { path: Some(path.into()), ..opened })
            .map_err(|error| error.in_file(argument))
    }

    /// # Errors
    /// Those of [`Scene::parse`].
    pub fn from_text(name: &str, text: &str) -> Result<Self, FileError> {
        Ok(Self { name: name.into(), path: None, text: text.into(), scene: Scene::parse(text)? })
    }
}

impl Scene {
    /// Reads the text of a scene file.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line, its column and its field.
    pub fn parse(text: &str) -> Result<Self, FileError> {
        const DEEP: &str = "solids stand in solids too deep; give the inner ones names";
        let file: SceneFile = ron_file::parse(text, "scene", "a camera and objects", DEEP)?;
        resolve(file).map_err(|error| {
            FileError::new(error.name.as_deref().and_then(|name| find_name(text, name)), &error.to_string())
        })
    }
}
