//! Which part of a picture is seen, and how large.

use egui::{Pos2, Rect, Vec2, vec2};

/// How near one looks at a picture, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureView {
    /// How many times as large as it would fit; at least 1.
    zoom: f32,
    /// What of the picture is in the middle, as shares of its width and height.
    centre: Vec2,
}

/// A pixel is never larger than this, in points.
const LARGEST: f32 = 48.0;

impl Default for PictureView {
    fn default() -> Self {
        Self { zoom: 1.0, centre: Vec2::splat(0.5) }
    }
}

impl PictureView {
    /// Whether all of it is seen.
    pub fn shows_all(&self) -> bool {
        self.zoom == 1.0
    }

    /// Where all of a picture of `size` pixels would be, of which `room` is seen, and how large a pixel is.
    pub fn place(&self, size: Vec2, room: Rect) -> (Rect, f32) {
        let scale = self.zoom * fit(size, room);
        let corner = room.center() - self.centre * size * scale;
        (Rect::from_min_size(corner, size * scale), scale)
    }

    /// Comes nearer (more than 1) or goes further away, so that what is at `at` stays there.
    pub fn zoom(&mut self, factor: f32, at: Pos2, size: Vec2, room: Rect) {
        let (place, _) = self.place(size, room);
        let share = (at - place.min) / place.size();
        self.zoom = (self.zoom * factor).clamp(1.0, (LARGEST / fit(size, room)).max(1.0));
        let (place, _) = self.place(size, room);
        self.centre += share - (at - place.min) / place.size();
        self.keep_inside(size, room);
    }

    /// Moves what is seen by so many points.
    pub fn pan(&mut self, by: Vec2, size: Vec2, room: Rect) {
        let (place, _) = self.place(size, room);
        self.centre -= by / place.size();
        self.keep_inside(size, room);
    }

    /// Nothing beyond the picture's edge is seen where there is enough of it.
    fn keep_inside(&mut self, size: Vec2, room: Rect) {
        let (place, _) = self.place(size, room);
        let half = (room.size() / place.size() / 2.0).min(Vec2::splat(0.5));
        self.centre = vec2(self.centre.x.clamp(half.x, 1.0 - half.x), self.centre.y.clamp(half.y, 1.0 - half.y));
    }
}

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
        fn what_is_under_the_pointer_stays_there(x in 0.3..0.7f32, y in 0.3..0.7f32, factor in 1.5..20.0f32) {
            let at = room().lerp_inside(vec2(x, y));
            let mut view = PictureView::default();
            let of = |view: &PictureView| (at - view.place(SIZE, room()).0.min) / view.place(SIZE, room()).1;
            let before = of(&view);
            view.zoom(factor, at, SIZE, room());
            prop_assert!((of(&view) - before).length() < 0.05, "{:?} {before:?}", of(&view));
        }

        #[test]
        fn the_room_is_always_full(
            moves in prop::collection::vec((0.2..4.0f32, 0.0..1.0f32, 0.0..1.0f32, -300.0..300.0f32), 1..20),
        ) {
            let mut view = PictureView::default();
            for (factor, x, y, by) in moves {
                view.zoom(factor, room().lerp_inside(vec2(x, y)), SIZE, room());
                view.pan(vec2(by, -by), SIZE, room());
                let (place, scale) = view.place(SIZE, room());
                prop_assert!(place.expand(0.5).contains_rect(room()) && scale <= LARGEST + 1e-3);
            }
        }
    }
}
