//! The picture, and how much of it is render and how much owners.

use egui::{Align2, Color32, ColorImage, Rect, Sense, TextureHandle, TextureOptions, Ui, pos2, vec2};

use super::session::Session;
use super::theme::{self, GRID, Look};
use super::widgets;
use crate::palette::Rgb;
use crate::view::{Canvas, percent};

/// What the panel needs below the picture, in points.
pub const BELOW: f32 = 5.0 * GRID;

/// The picture's texture, which lives as long as the window, and the blend.
pub struct PicturePanel {
    texture: Option<TextureHandle>,
    /// 0 is the render, 100 the owners.
    blend: f64,
}

impl Default for PicturePanel {
    fn default() -> Self {
        Self { texture: None, blend: 55.0 }
    }
}

impl PicturePanel {
    /// Shows the picture as large as it gets, and the slider below it.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let look = Look::of(ui.ctx());
        let canvas = session.canvas((self.blend / 100.0) as f32, theme::rgb(look.ground));
        self.upload(ui, canvas);
        let size = vec2(canvas.size().width() as f32, canvas.size().height() as f32);
        let room = vec2(ui.available_width(), (ui.available_height() - BELOW).max(GRID));
        let scale = (room.x / size.x).min(room.y / size.y);
        let slack = (room - size * scale).max(egui::Vec2::ZERO);
        let place = Rect::from_min_size(ui.cursor().min + slack / 2.0, size * scale);
        let response = ui.allocate_rect(place, Sense::hover());
        let done = percent(session.state().done(), session.state().atoms());
        widgets::describe(&response, "Picture", || format!("{done} done"));
        if let Some(texture) = &self.texture {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter().image(texture.id(), place, whole, Color32::WHITE);
        }
        let below = Rect::from_min_size(place.left_bottom(), vec2(place.width(), BELOW));
        self.blend_slider(ui, below, look);
    }

    fn blend_slider(&mut self, ui: &mut Ui, row: Rect, look: Look) {
        let (middle, font) = (row.center().y + GRID / 2.0, theme::regular(theme::SMALL));
        let fits = row.width() > 30.0 * GRID;
        let words = |x: f32, anchor, text: &str, strength: f64| {
            // Under a small picture the slider has no room for words; its hint says them.
            if !fits {
                return -1.5 * GRID;
            }
            let colour = look.quiet.lerp_to_gamma(look.text, strength as f32 / 100.0);
            ui.painter().text(pos2(x, middle), anchor, text, font.clone(), colour).width()
        };
        let left = words(row.left(), Align2::LEFT_CENTER, "Render", 100.0 - self.blend) + 1.5 * GRID;
        let right = words(row.right(), Align2::RIGHT_CENTER, "Who traced it", self.blend) + 1.5 * GRID;
        let width = (row.width() - left - right).max(4.0 * GRID);
        let place = Rect::from_min_size(pos2(row.left() + left, middle - 1.25 * GRID), vec2(width, 2.5 * GRID));
        ui.scope_builder(egui::UiBuilder::new().max_rect(place), |ui| {
            widgets::slider(ui, &mut self.blend, width, look.accent, "Render or owners")
                .on_hover_text("From the render to who traced it");
        });
    }

    /// Hands the changed rows to the graphics card; the whole picture only once.
    fn upload(&mut self, ui: &Ui, canvas: &mut Canvas) {
        let (width, height) = (canvas.size().width(), canvas.size().height());
        let dirty = canvas.take_dirty();
        let fits = |texture: &TextureHandle| texture.size() == [width as usize, height as usize];
        match &mut self.texture {
            Some(texture) if fits(texture) => {
                for rows in dirty {
                    let image = image(width, canvas.rows(rows.clone()));
                    texture.set_partial([0, rows.start as usize], image, TextureOptions::LINEAR);
                }
            }
            texture => {
                let image = image(width, canvas.rows(0..height));
                *texture = Some(ui.ctx().load_texture("picture", image, TextureOptions::LINEAR));
            }
        }
    }
}

fn image(width: u32, pixels: &[Rgb]) -> ColorImage {
    let width = width as usize;
    let pixels: Vec<_> = pixels.iter().map(|&pixel| theme::colour(pixel)).collect();
    ColorImage::new([width, pixels.len() / width], pixels)
}
