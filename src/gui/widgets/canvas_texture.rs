//! Texture of a canvas.

use std::ops::Range;

use egui::{ColorImage, Context, TextureHandle, TextureId, TextureOptions};

use super::theme;
use crate::view::Canvas;

/// Texture of a canvas, kept between frames.
#[derive(Default)]
pub struct CanvasTexture {
    texture: Option<TextureHandle>,
    /// Whether pixels are drawn as squares instead of interpolated.
    shows_pixels: bool,
}

impl CanvasTexture {
    /// Uploads the changed rows of the canvas, or all of it for a new texture. A picture that exceeds the largest
    /// texture is shown with fewer pixels. Returns `None` for an empty picture.
    pub fn upload(&mut self, ctx: &Context, canvas: &mut Canvas, shows_pixels: bool) -> Option<TextureId> {
        let (width, height) = (canvas.size().width(), canvas.size().height());
        let max_side = ctx.input(|input| input.max_texture_side).max(1) as u32;
        let step = width.max(height).div_ceil(max_side);
        let size = [width.div_ceil(step) as usize, height.div_ceil(step) as usize];
        let dirty = canvas.take_dirty();
        let is_same = std::mem::replace(&mut self.shows_pixels, shows_pixels) == shows_pixels;
        let options = if shows_pixels { TextureOptions::NEAREST } else { TextureOptions::LINEAR };
        match &mut self.texture {
            Some(texture) if texture.size() == size && is_same => {
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

/// Returns rows of the texture: every `step`th pixel of every `step`th row of the canvas.
fn image(canvas: &Canvas, rows: Range<u32>, step: u32) -> Option<ColorImage> {
    let width = canvas.size().width();
    let pixels: Vec<_> = if step == 1 {
        // The usual case, as fast as possible.
        canvas.rows(rows.clone()).iter().map(|&pixel| theme::colour(pixel)).collect()
    } else {
        let every = rows.clone().flat_map(|row| canvas.rows(row * step..row * step + 1).iter().step_by(step as usize));
        every.map(|&pixel| theme::colour(pixel)).collect()
    };
    let size = [width.div_ceil(step) as usize, rows.len()];
    (!pixels.is_empty()).then(|| ColorImage::new(size, pixels))
}
