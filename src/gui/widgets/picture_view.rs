//! Zoom and pan of a picture.

use egui::{Pos2, Rect, Vec2, vec2};

/// Zoom and centre of a picture's visible part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureView {
    /// Scale relative to the scale at which the whole picture fits; at least 1.
    zoom: f32,
    /// Point of the picture at the centre, as shares of its width and height.
    centre: Vec2,
}

/// Largest side of a pixel, in points.
const MAX_PIXEL_PT: f32 = 48.0;

impl Default for PictureView {
    fn default() -> Self {
        Self { zoom: 1.0, centre: Vec2::splat(0.5) }
    }
}

impl PictureView {
    /// Whether the whole picture is visible.
    pub fn shows_all(&self) -> bool {
        self.zoom == 1.0
    }

    /// Returns the rectangle of the whole picture, of which `room` is visible, and the side of a pixel in points.
    /// `size` is in pixels.
    pub fn picture_rect(&self, size: Vec2, room: Rect) -> (Rect, f32) {
        let scale = self.zoom * fit(size, room);
        let corner = room.center() - self.centre * size * scale;
        (Rect::from_min_size(corner, size * scale), scale)
    }

    /// Zooms in (`factor` > 1) or out, keeping the point under `at` in place.
    pub fn zoom(&mut self, factor: f32, at: Pos2, size: Vec2, room: Rect) {
        let (rect, _) = self.picture_rect(size, room);
        let share = (at - rect.min) / rect.size();
        self.zoom = (self.zoom * factor).clamp(1.0, (MAX_PIXEL_PT / fit(size, room)).max(1.0));
        let (rect, _) = self.picture_rect(size, room);
        self.centre += share - (at - rect.min) / rect.size();
        self.keep_inside(size, room);
    }

    /// Moves the picture by this many points.
    pub fn pan(&mut self, by: Vec2, size: Vec2, room: Rect) {
        let (rect, _) = self.picture_rect(size, room);
        self.centre -= by / rect.size();
        self.keep_inside(size, room);
    }

    /// Moves the centre so that no margin beyond the picture's edge is visible, unless the picture is smaller than the
    /// room.
    fn keep_inside(&mut self, size: Vec2, room: Rect) {
        let (rect, _) = self.picture_rect(size, room);
        let half = (room.size() / rect.size() / 2.0).min(Vec2::splat(0.5));
        self.centre = vec2(self.centre.x.clamp(half.x, 1.0 - half.x), self.centre.y.clamp(half.y, 1.0 - half.y));
    }
}

/// Returns the scale at which a picture of this size just fits.
fn fit(size: Vec2, room: Rect) -> f32 {
    (room.width() / size.x).min(room.height() / size.y)
}

#[cfg(test)]
mod tests {
    use egui::pos2;
    use proptest::prelude::*;

    use super::*;

    const SIZE: Vec2 = vec2(640.0, 480.0);

    fn room() -> Rect {
        Rect::from_min_size(pos2(16.0, 60.0), vec2(550.0, 412.5))
    }

    proptest! {
        #[test]
        fn zoom_keeps_the_point_under_the_pointer(x in 0.3..0.7f32, y in 0.3..0.7f32, factor in 1.5..20.0f32) {
            let at = room().lerp_inside(vec2(x, y));
            let mut view = PictureView::default();
            let of = |view: &PictureView| {
            let (rect, scale) = view.picture_rect(SIZE, room());
            (at - rect.min) / scale
            };
            let before = of(&view);
            view.zoom(factor, at, SIZE, room());
            prop_assert!((of(&view) - before).length() < 0.05, "{:?} {before:?}", of(&view));
        }

        #[test]
        fn picture_always_fills_the_room(
            moves in prop::collection::vec((0.2..4.0f32, 0.0..1.0f32, 0.0..1.0f32, -300.0..300.0f32), 1..20),
        ) {
            let mut view = PictureView::default();
            for (factor, x, y, by) in moves {
                view.zoom(factor, room().lerp_inside(vec2(x, y)), SIZE, room());
                view.pan(vec2(by, -by), SIZE, room());
                let (rect, scale) = view.picture_rect(SIZE, room());
                prop_assert!(rect.expand(0.5).contains_rect(room()) && scale <= MAX_PIXEL_PT + 1e-3);
            }
        }
    }
}
