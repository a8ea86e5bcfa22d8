//! The scene file: RON, with errors that say where.

use std::path::{Path, PathBuf};

use super::resolve::resolve;
use super::syntax::SceneFile;
use super::{BUILT_IN, Camera, Scene, built_in};
use crate::ron_file::{self, FileError, find_name};

/// A scene, with its file's name and text.
#[derive(Clone, Debug)]
pub struct Opened {
    /// The file's name without its extension.
    pub name: String,
    /// The path that it was read from; none for a built-in scene or a text.
    pub path: Option<PathBuf>,
    /// The text of the file.
    pub text: String,
    /// The scene that the text describes.
    pub scene: Scene,
    /// The camera before it was moved.
    pub home_camera: Camera,
}

impl Opened {
    /// Reads the scene file at the path `argument`, which need not be UTF-8, or the built-in scene of that name if
    /// there is no such file.
    ///
    /// # Errors
    /// A [`FileError`] that names the file.
    pub fn new(argument: impl AsRef<Path>) -> Result<Self, FileError> {
        let path = argument.as_ref();
        let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        if !path.exists()
            && let Some(text) = path.to_str().and_then(built_in)
        {
            return Self::from_text(&name, text);
        }
        let text = ron_file::read(path, "scene", BUILT_IN.iter().map(|(name, _)| *name));
        text.map_err(FileError::from)
            .and_then(|text| Self::from_text(&name, &text))
            .map(|opened| Self { path: Some(path.into()), ..opened })
            .map_err(|error| error.in_file(path))
    }

    /// Parses a scene file's text, without a path.
    ///
    /// # Errors
    /// The errors of [`Scene::parse`].
    pub fn from_text(name: &str, text: &str) -> Result<Self, FileError> {
        let scene = Scene::parse(text)?;
        let home_camera = scene.camera;
        Ok(Self { name: name.into(), path: None, text: text.into(), scene, home_camera })
    }
}

impl Scene {
    /// Parses the text of a scene file.
    ///
    /// # Errors
    /// The first mistake, with its line, column and field.
    pub fn parse(text: &str) -> Result<Self, FileError> {
        const DEEP: &str = "solids are nested too deep; give the inner ones names";
        let file: SceneFile = ron_file::parse(text, "scene", "a camera and objects", DEEP)?;
        resolve(file).map_err(|error| {
            FileError::new(error.name.as_deref().and_then(|name| find_name(text, name)), &error.to_string())
        })
    }
}
