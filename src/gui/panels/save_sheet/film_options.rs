//! Length and width of a saved animation.

use std::time::Duration;

use egui::{RichText, Ui};
use serde::{Deserialize, Serialize};

use crate::export::Film;
use crate::gui::widgets::live_number_field;
use crate::gui::widgets::theme::{self, GRID, Look};
use crate::language::{Language, word};
use crate::view::Layer;

/// Length and width of a saved animation, as the user has set them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FilmOptions {
    /// Duration of the run in the animation, in seconds.
    seconds: f64,
    /// Length of the picture's longer side, in pixels.
    width: u32,
}

impl Default for FilmOptions {
    fn default() -> Self {
        let Film { length, width, .. } = Film::default();
        Self { seconds: length.as_secs_f64(), width }
    }
}

impl FilmOptions {
    /// Returns the options with all values in their ranges; a stored file may say anything.
    pub(super) fn in_range(self) -> Self {
        let width = self.width.clamp(*Film::WIDTHS.start(), *Film::WIDTHS.end());
        let seconds = if self.seconds.is_finite() { self.seconds } else { Self::default().seconds };
        Self { seconds: seconds.clamp(*Film::SECONDS.start(), *Film::SECONDS.end()), width }
    }

    /// Returns the animation with this look of the picture.
    pub(super) fn film(self, look: (Layer, f32)) -> Film {
        Film { width: self.width, length: Duration::from_secs_f64(self.seconds), look }
    }

    /// Shows the fields.
    pub(super) fn show(&mut self, ui: &mut Ui, language: Language) {
        let quiet = Look::of(ui.ctx()).quiet;
        let label = |ui: &mut Ui, text: &str| {
            ui.label(RichText::new(text).font(theme::regular(theme::BODY)).color(quiet));
        };
        ui.horizontal(|ui| {
            label(ui, word!(language, "lasts", "dura"));
            let name = word!(language, "Seconds of the animation", "Segundos do filme");
            live_number_field(ui, &mut self.seconds, Film::SECONDS, " s", 8.0 * GRID, (name, language));
            label(ui, word!(language, "picture", "imagem"));
            let name = word!(language, "Width of the picture in the animation", "Largura da imagem no filme");
            live_number_field(ui, &mut self.width, Film::WIDTHS, " px", 10.0 * GRID, (name, language));
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stored_options_come_into_their_ranges() {
        let wrong = FilmOptions { seconds: f64::NAN, width: 7 };
        assert_eq!(wrong.in_range(), FilmOptions { seconds: 10.0, width: 100 });
        assert_eq!(FilmOptions { seconds: 1e9, width: 9999 }.in_range(), FilmOptions { seconds: 120.0, width: 1920 });
        assert_eq!(FilmOptions::default().in_range().film((Layer::Owners, 0.7)), Film::default());
    }
}
