//! Layout of the picture, the ring, and the table or the timeline below them.

use egui::{CursorIcon, Rect, Sense, Stroke, Ui, WidgetInfo, pos2};

use crate::gui::panels::picture;
use crate::gui::widgets::hint_above;
use crate::gui::widgets::theme::{GRID, Look};
use crate::language::{Language, word};

/// Least height of the picture and the ring, in points, if the window is not lower.
const MIN_MAIN_HEIGHT_PT: f32 = 15.0 * GRID;
/// Least height of the table or the timeline, in points.
const MIN_BELOW_HEIGHT_PT: f32 = 10.0 * GRID;

/// The split between the picture and the ring above, and the table or the timeline below.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Split {
    /// Height of the table or the timeline as a share of the window's, if the user has chosen one.
    pub share: Option<f32>,
}

impl Split {
    /// Returns the height of the table or the timeline. `usual` is the height without a choice; `most` leaves no room
    /// for picture and ring.
    pub fn height(self, ui: &Ui, usual: f32, most: f32) -> f32 {
        let Some(share) = self.share else { return usual };
        let most = (most - MIN_MAIN_HEIGHT_PT).max(usual);
        (share * ui.ctx().content_rect().height()).clamp(MIN_BELOW_HEIGHT_PT.min(most), most)
    }

    /// Lets the upper edge of the table or the timeline be dragged. A double click restores its usual height.
    pub fn drag(&mut self, ui: &Ui, below: Rect, language: Language) {
        const GRIP_WIDTH_PT: f32 = 4.0 * GRID;
        let edge = Rect::from_x_y_ranges(below.x_range(), below.top() - 4.0..=below.top() + 3.0);
        let response = ui.interact(edge, ui.scope_id().with("split"), Sense::CLICK | Sense::DRAG);
        let name = word!(language, "Height of picture and ring", "Altura da imagem e do anel");
        response.widget_info(|| WidgetInfo::labeled(egui::Role::Splitter, true, name));
        let response = response.on_hover_cursor(CursorIcon::ResizeVertical);
        if response.double_clicked() {
            self.share = None;
        } else if let Some(at) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            self.share = Some((below.bottom() - at.y) / ui.ctx().content_rect().height());
        }
        let look = Look::of(ui.ctx());
        let is_active = response.hovered() || response.dragged();
        let (middle, ink) = (below.center().x, if is_active { look.text } else { look.quiet.gamma_multiply(0.6) });
        let grip = [-0.5, 0.5].map(|side| pos2(middle + side * GRIP_WIDTH_PT, below.top()));
        ui.painter().line_segment(grip, Stroke::new(3.0, ink));
        let hint = word!(
            language,
            "Drag: larger or smaller. Double click: as usual",
            "Arrastar: maior ou menor. Duplo clique: como sempre"
        );
        hint_above(response, hint);
    }
}

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
            let area = Rect::from_min_size(pos2(16.0, 60.0), size.into());
            let (picture, ring) = split_main_area(area, 4.0 / 3.0, 0.0);
            let ring = ring.expect("without a sheet the ring is shown");
            assert!(area.contains_rect(picture) && area.contains_rect(ring), "{size:?}");
            assert!(picture.right() < ring.left() || ring.width() < 1.0);
            assert!(picture.width() * 0.75 <= (area.height() - picture::CONTROLS_HEIGHT_PT).max(0.0) + 0.1);
        }
    }

    #[test]
    fn sheet_takes_its_place_from_the_ring() {
        let whole = Rect::from_min_size(pos2(16.0, 60.0), [1248.0, 410.0].into());
        let (before, _) = split_main_area(whole, 4.0 / 3.0, 0.0);
        for (sheet, has_ring) in [(400.0, true), (700.0, false)] {
            let (picture, ring) = split_main_area(whole.with_max_x(whole.right() - sheet), 4.0 / 3.0, sheet);
            assert_eq!((picture, ring.is_some()), (before, has_ring), "{sheet}");
        }
    }
}
