//! STUB: the real scene comes with the tracer; only `Scene::parse` and `built_in` will stay as they are here.

/// A scene.
#[derive(Clone, Debug)]
pub struct Scene;

/// The scenes that are built into the program: their names and texts.
pub const BUILT_IN: &[(&str, &str)] = &[("ten-objects", "()")];

/// The text of a built-in scene.
pub fn built_in(name: &str) -> Option<&'static str> {
    BUILT_IN.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// What is wrong with a scene's text.
#[derive(Debug, thiserror::Error)]
#[error("stub")]
pub struct SceneError;

impl Scene {
    /// Reads the text of a scene file.
    pub fn parse(_text: &str) -> Result<Self, SceneError> {
        Ok(Self)
    }
}
