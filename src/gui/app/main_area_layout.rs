//! Where the picture and the ring go.

use egui::Rect;

use crate::gui::panels::picture;
use crate::gui::widgets::theme::GRID;

/// Where the picture and the ring go: beside each other, as large as they get. `aspect` is the picture's width
/// divided by its height.
pub(super) fn heroes(area: Rect, aspect: f32) -> (Rect, Rect) {
    const GAP: f32 = 3.0 * GRID;
    // The ring wants a little more breadth than height, for its labels.
    const RING: f32 = 1.15;
    let fair = (area.width() - GAP).max(0.0) * aspect / (aspect + RING);
    let highest = (area.height() - picture::BELOW).max(0.0) * aspect;
    let split = area.left() + fair.min(highest);
    (area.with_max_x(split), area.with_min_x((split + GAP).min(area.right())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn picture_and_ring_share_the_area() {
        for size in [[1248.0, 470.0], [1888.0, 800.0], [650.0, 180.0], [300.0, 900.0], [10.0, 10.0]] {
            let area = Rect::from_min_size(egui::pos2(16.0, 60.0), size.into());
            let (picture, ring) = heroes(area, 4.0 / 3.0);
            assert!(area.contains_rect(picture) && area.contains_rect(ring), "{size:?}");
            assert!(picture.right() < ring.left() || ring.width() < 1.0);
            assert!(picture.width() * 0.75 <= (area.height() - picture::BELOW).max(0.0) + 0.1);
        }
    }
}
