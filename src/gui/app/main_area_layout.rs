//! Layout of the picture and the ring.

use egui::Rect;

use crate::gui::panels::picture;
use crate::gui::widgets::theme::GRID;

/// Splits the area into the rectangles of the picture and of the ring, side by side and as large as possible.
/// `aspect` is width / height of the picture. A save sheet of this width at the right takes its place from the ring, of
/// which nothing is left where it has no room: the picture stays where it is.
pub(super) fn split_main_area(area: Rect, aspect: f32, sheet: f32) -> (Rect, Option<Rect>) {
    const GAP_PT: f32 = 3.0 * GRID;
    // Width / height; the labels of the ring stand at its sides.
    const RING_ASPECT: f32 = 1.15;
    // In less its labels have no room.
    const MIN_RING_WIDTH_PT: f32 = 30.0 * GRID;
    let fair = (area.width() + sheet - GAP_PT).max(0.0) * aspect / (aspect + RING_ASPECT);
    let widest = (area.height() - picture::CONTROLS_HEIGHT_PT).max(0.0) * aspect;
    let split = area.left() + fair.min(widest).min(area.width());
    let ring = area.with_min_x((split + GAP_PT).min(area.right()));
    (area.with_max_x(split), Some(ring).filter(|ring| sheet == 0.0 || ring.width() >= MIN_RING_WIDTH_PT))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn picture_and_ring_share_the_area() {
        for size in [[1248.0, 470.0], [1888.0, 800.0], [650.0, 180.0], [300.0, 900.0], [10.0, 10.0]] {
            let area = Rect::from_min_size(egui::pos2(16.0, 60.0), size.into());
            let (picture, ring) = split_main_area(area, 4.0 / 3.0, 0.0);
            let ring = ring.expect("without a sheet the ring is shown");
            assert!(area.contains_rect(picture) && area.contains_rect(ring), "{size:?}");
            assert!(picture.right() < ring.left() || ring.width() < 1.0);
            assert!(picture.width() * 0.75 <= (area.height() - picture::CONTROLS_HEIGHT_PT).max(0.0) + 0.1);
        }
    }

    #[test]
    fn sheet_takes_its_place_from_the_ring() {
        let whole = Rect::from_min_size(egui::pos2(16.0, 60.0), [1248.0, 410.0].into());
        let (before, _) = split_main_area(whole, 4.0 / 3.0, 0.0);
        for (sheet, has_ring) in [(400.0, true), (700.0, false)] {
            let (picture, ring) = split_main_area(whole.with_max_x(whole.right() - sheet), 4.0 / 3.0, sheet);
            assert_eq!((picture, ring.is_some()), (before, has_ring), "{sheet}");
        }
    }
}
