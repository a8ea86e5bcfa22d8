//! The picture, and how much of it is render and how much owners.

use std::ops::Range;

use egui::{
    Align2, Color32, ColorImage, Painter, Pos2, Rect, Sense, Stroke, TextureHandle, TextureOptions, Ui, Vec2, pos2,
    vec2,
};

use super::session::Session;
use super::theme::{self, GRID, Look};
use super::widgets;
use crate::view::{Canvas, atom_words, percent};

/// What the panel needs below the picture, in points.
pub const BELOW: f32 = 5.0 * GRID;

/// The picture's texture, which lives as long as the window, and the blend.
pub struct PicturePanel {
    texture: Option<TextureHandle>,
    /// 0 is the render, 100 the owners.
    pub blend: f64,
}

impl Default for PicturePanel {
    fn default() -> Self {
        Self { texture: None, blend: 70.0 }
    }
}

impl PicturePanel {
    /// Shows the picture as large as it gets, and the slider below it.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let look = Look::of(ui.ctx());
        let blend = self.blend_share();
        let canvas = session.stage_mut().canvas(blend, theme::rgb(look.ground));
        self.upload(ui, canvas);
        let size = vec2(canvas.size().width() as f32, canvas.size().height() as f32);
        let room = vec2(ui.available_width(), (ui.available_height() - BELOW).max(GRID));
        let scale = (room.x / size.x).min(room.y / size.y);
        let slack = (room - size * scale).max(Vec2::ZERO);
        let place = Rect::from_min_size(ui.cursor().min + slack / 2.0, size * scale);
        let response = ui.allocate_rect(place, Sense::click());
        let state = &session.stage().state;
        widgets::describe(&response, "Picture", || format!("{} done", percent(state.done(), state.atoms())));
        if let Some(texture) = &self.texture {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter().image(texture.id(), place, whole, Color32::WHITE);
        }
        if response.clicked() {
            // Whoever has no pointer begins in the middle, and goes on with the arrows.
            let at = response.interact_pointer_pos().unwrap_or(place.center());
            session.inspect(pixel_at(session, (at - place.min) / scale));
            response.surrender_focus();
        }
        if let Some([x, y]) = session.inspected_place() {
            cross_hair(ui.painter(), place.min + (vec2(x as f32, y as f32) + Vec2::splat(0.5)) * scale, scale);
        }
        if let Some(at) = response.hover_pos() {
            let [x, y] = pixel_at(session, (at - place.min) / scale);
            let atom = (y * session.header().size.width() + x) / session.header().division.atom_pixels();
            let words = atom_words(&session.stage().state, atom, session.now());
            response.on_hover_text_at_pointer(format!("{words}\nClick to inspect pixel {x}, {y}"));
        }
        let below = Rect::from_min_size(place.left_bottom(), vec2(place.width(), BELOW));
        self.blend_slider(ui, below, look);
    }

    /// How much of the picture is owners, 0 to 1.
    pub fn blend_share(&self) -> f32 {
        (self.blend / 100.0) as f32
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
            widgets::slider(ui, &mut self.blend, (0.0..=100.0, true), width, look.accent, "Render or owners")
                .on_hover_text("From the render to who traced it");
        });
    }

    /// Hands the changed rows to the graphics card; the whole picture only once. A picture that is larger than a texture
    /// can be is shown with fewer pixels.
    fn upload(&mut self, ui: &Ui, canvas: &mut Canvas) {
        let (width, height) = (canvas.size().width(), canvas.size().height());
        let most = ui.input(|input| input.max_texture_side).max(1) as u32;
        let step = width.max(height).div_ceil(most);
        let shown = [width.div_ceil(step) as usize, height.div_ceil(step) as usize];
        let dirty = canvas.take_dirty();
        match &mut self.texture {
            Some(texture) if texture.size() == shown => {
                for rows in dirty {
                    let first = rows.start.div_ceil(step);
                    if let Some(image) = image(canvas, first..rows.end.div_ceil(step), step) {
                        texture.set_partial([0, first as usize], image, TextureOptions::LINEAR);
                    }
                }
            }
            texture => {
                let image = image(canvas, 0..height.div_ceil(step), step);
                *texture = image.map(|image| ui.ctx().load_texture("picture", image, TextureOptions::LINEAR));
            }
        }
    }
}

/// Some rows of the texture, each `step`th of the picture's, and of those each `step`th pixel.
fn image(canvas: &Canvas, rows: Range<u32>, step: u32) -> Option<ColorImage> {
    let width = canvas.size().width();
    let pixels: Vec<_> = rows
        .clone()
        .flat_map(|row| canvas.rows(row * step..row * step + 1).iter().step_by(step as usize))
        .map(|&pixel| theme::colour(pixel))
        .collect();
    let size = [width.div_ceil(step) as usize, rows.len()];
    (!pixels.is_empty()).then(|| ColorImage::new(size, pixels))
}

/// The pixel at a place in the picture, in pixels.
fn pixel_at(session: &Session, place: Vec2) -> [u32; 2] {
    let size = session.header().size;
    [(place.x.max(0.0) as u32).min(size.width() - 1), (place.y.max(0.0) as u32).min(size.height() - 1)]
}

/// Marks a pixel of so many points, and leaves it free.
fn cross_hair(painter: &Painter, centre: Pos2, side: f32) {
    let (inner, outer) = (side / 2.0 + 3.0, side / 2.0 + 12.0);
    // Seen on every picture.
    for stroke in [Stroke::new(4.0, Color32::BLACK), Stroke::new(1.75, Color32::WHITE)] {
        for way in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
            painter.line_segment([centre + way * inner, centre + way * outer], stroke);
        }
    }
}
