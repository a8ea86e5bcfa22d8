//! Layout of the picture and the ring.

use egui::Rect;

use crate::gui::panels::picture;
use crate::gui::widgets::theme::GRID;

/// Splits the area into the rectangles of the picture and of the ring, side by side and as large as possible.
/// `aspect` is width / height of the picture.
pub(super) fn split_main_area(area: Rect, aspect: f32) -> (Rect, Rect) {
    const GAP_PT: f32 = 3.0 * GRID;
    // Width / height; the labels of the ring stand at its sides.
    const RING_ASPECT: f32 = 1.15;
    let fair = (area.width() - GAP_PT).max(0.0) * aspect / (aspect + RING_ASPECT);
    let widest = (area.height() - picture::CONTROLS_HEIGHT_PT).max(0.0) * aspect;
    let split = area.left() + fair.min(widest);
    (area.with_max_x(split), area.with_min_x((split + GAP_PT).min(area.right())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn picture_and_ring_share_the_area() {
        for size in [[1248.0, 470.0], [1888.0, 800.0], [650.0, 180.0], [300.0, 900.0], [10.0, 10.0]] {
            let area = Rect::from_min_size(egui::pos2(16.0, 60.0), size.into());
            let (picture, ring) = split_main_area(area, 4.0 / 3.0);
            assert!(area.contains_rect(picture) && area.contains_rect(ring), "{size:?}");
            assert!(picture.right() < ring.left() || ring.width() < 1.0);
            assert!(picture.width() * 0.75 <= (area.height() - picture::CONTROLS_HEIGHT_PT).max(0.0) + 0.1);
        }
    }
}
