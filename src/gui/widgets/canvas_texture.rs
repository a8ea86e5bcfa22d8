//! A picture on the graphics card.

use std::ops::Range;

use egui::{ColorImage, Context, TextureHandle, TextureId, TextureOptions};

use super::theme;
use crate::view::Canvas;

/// A canvas's texture, which lives as long as whoever shows it.
#[derive(Default)]
pub struct CanvasTexture {
    texture: Option<TextureHandle>,
    /// Whether pixels of the texture are to be told apart.
    shows_pixels: bool,
}

impl CanvasTexture {
    /// Hands the changed rows to the graphics card; the whole picture only once. A picture that is larger than a texture
    /// can be is shown with fewer pixels.
    pub fn upload(&mut self, ctx: &Context, canvas: &mut Canvas, shows_pixels: bool) -> Option<TextureId> {
        let (width, height) = (canvas.size().width(), canvas.size().height());
        let most = ctx.input(|input| input.max_texture_side).max(1) as u32;
        let step = width.max(height).div_ceil(most);
        let shown = [width.div_ceil(step) as usize, height.div_ceil(step) as usize];
        let dirty = canvas.take_dirty();
        let is_same = std::mem::replace(&mut self.shows_pixels, shows_pixels) == shows_pixels;
        let options = if shows_pixels { TextureOptions::NEAREST } else { TextureOptions::LINEAR };
        match &mut self.texture {
            Some(texture) if texture.size() == shown && is_same => {
                for rows in dirty {
                    let first = rows.start.div_ceil(step);
                    if let Some(image) = image(canvas, first..rows.end.div_ceil(step), step) {
                        texture.set_partial([0, first as usize], image, options);
                    }
                }
            }
            texture => {
                let image = image(canvas, 0..height.div_ceil(step), step);
                *texture = image.map(|image| ctx.load_texture("picture", image, options));
            }
        }
        self.texture.as_ref().map(TextureHandle::id)
    }
}

/// Some rows of the texture, each `step`th of the picture's, and of those each `step`th pixel.
fn image(canvas: &Canvas, rows: Range<u32>, step: u32) -> Option<ColorImage> {
    let width = canvas.size().width();
    let pixels: Vec<_> = if step == 1 {
        // The usual case, at once for all rows: there are many pixels, and frames.
        canvas.rows(rows.clone()).iter().map(|&pixel| theme::colour(pixel)).collect()
    } else {
        let every = rows.clone().flat_map(|row| canvas.rows(row * step..row * step + 1).iter().step_by(step as usize));
        every.map(|&pixel| theme::colour(pixel)).collect()
    };
    let size = [width.div_ceil(step) as usize, rows.len()];
    (!pixels.is_empty()).then(|| ColorImage::new(size, pixels))
}
