//! The state that the next window restores.

use serde::{Deserialize, Serialize};

use super::{App, stored_path};
use crate::gui::panels::save_sheet::FilmOptions;
use crate::gui::settings::Settings;
use crate::language::Language;

/// The state that the next window restores, beside egui's own.
#[derive(Default, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct StoredState {
    pub settings: Settings,
    pub scene: Option<String>,
    pub recent: Vec<String>,
    pub blend: Option<f64>,
    #[serde(rename = "setup")]
    pub is_setup_open: bool,
    #[serde(rename = "timeline")]
    pub shows_timeline: bool,
    /// Height of the table or the timeline, as a share of the window's.
    pub split: Option<f32>,
    pub language: Option<Language>,
    pub projector: bool,
    pub film: FilmOptions,
    /// Whether a changed scene is reloaded without a question.
    pub always_reload: bool,
}

impl App {
    /// Returns the state to be stored.
    pub(super) fn stored(&self) -> StoredState {
        let scene = self.session.opened().and_then(|opened| match &opened.path {
            Some(path) => std::path::absolute(path).ok().map(|path| stored_path::write(&path)),
            None => crate::scene::built_in(&opened.name).map(|_| opened.name.clone()),
        });
        StoredState {
            settings: self.session.settings().clone(),
            scene,
            recent: self.session.recent().iter().map(|path| stored_path::write(path)).collect(),
            blend: Some(self.picture.blend),
            is_setup_open: self.setup.open,
            shows_timeline: self.timeline_before_lesson.unwrap_or(self.shows_timeline),
            split: self.split.share,
            language: Some(self.session.language()),
            projector: self.projector,
            film: self.save_sheet.film(),
            always_reload: self.session.always_reloads(),
        }
    }
}
