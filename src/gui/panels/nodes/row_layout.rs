//! Layout of the table of machines and of its rows.

use egui::{Rect, pos2, vec2};

use crate::gui::widgets::theme::GRID;

/// Height of the captions above the rows, in points.
pub const HEAD_HEIGHT_PT: f32 = 2.5 * GRID;

/// Grid of rows in columns, filled from top to bottom.
pub struct RowGrid {
    /// Number of columns.
    pub columns: usize,
    /// Rows in a column.
    pub lines: usize,
    /// Width of a column, in points.
    pub width: f32,
    /// Height of a row, in points.
    pub row: f32,
}

impl RowGrid {
    const GAP_PT: f32 = 4.0 * GRID;
    /// Most rows with the normal height; more are dense.
    const MAX_NORMAL_ROWS: usize = 16;

    /// Arranges this number of rows in a width of `room` points.
    pub fn new(rows: usize, room: f32) -> Self {
        // Two columns are used even if their rows lose parts; more columns only if there are many rows.
        let is_dense = rows > Self::MAX_NORMAL_ROWS;
        let columns = if room < 2.0 * RowLayout::MIN_WIDTH_PT + Self::GAP_PT {
            1
        } else {
            (((room + Self::GAP_PT) / 632.0) as usize).max(2)
        };
        let columns = if is_dense {
            (((room + Self::GAP_PT) / (RowLayout::MIN_WIDTH_PT + Self::GAP_PT)) as usize).max(1)
        } else {
            columns
        };
        let lines = rows.div_ceil(columns).max(1);
        let columns = rows.div_ceil(lines).max(1);
        let row = if is_dense { 3.0 } else { 4.0 } * GRID;
        Self { columns, lines, width: (room + Self::GAP_PT) / columns as f32 - Self::GAP_PT, row }
    }

    /// Whether the rows are low, because there are many.
    pub fn is_dense(&self) -> bool {
        self.row < 4.0 * GRID
    }

    /// Returns the height of captions and rows.
    pub fn height(&self) -> f32 {
        HEAD_HEIGHT_PT + self.lines as f32 * self.row
    }

    /// Returns the left edge of a column.
    pub fn left(&self, column: usize) -> f32 {
        column as f32 * (self.width + Self::GAP_PT)
    }
}

/// Positions of the parts of a row, from left to right; `None` for parts without room.
pub struct RowLayout {
    /// The whole row.
    pub row: Rect,
    /// Slider of the speed.
    pub slider: Rect,
    /// Number field of the speed.
    pub speed: Rect,
    /// Pause button.
    pub pause: Rect,
    /// Bar of the atoms done and left.
    pub bar: Option<Rect>,
    /// Right end of the atoms done.
    pub done: Option<f32>,
    /// Right end of the atoms left.
    pub left: f32,
    /// Right end of the atoms per second.
    pub rate: Option<f32>,
    /// Right end of the idle share.
    pub idle: Option<f32>,
    /// Left end of the activity.
    pub activity: f32,
    /// Whether the row is low and has small text.
    pub is_dense: bool,
}

impl RowLayout {
    /// Least width of a row, in points.
    pub const MIN_WIDTH_PT: f32 = 42.0 * GRID;

    /// Lays out a row of this rectangle, or the captions above such rows.
    pub fn new(row: Rect, is_dense: bool) -> Self {
        const NUMBER_WIDTH_PT: f32 = 7.0 * GRID;
        let rate_width = if is_dense { 6.5 } else { 8.0 } * GRID;
        let within = |left: f32, width: f32, height: f32| {
            Rect::from_min_size(pos2(left, row.center().y - height / 2.0), vec2(width, height))
        };
        // The least width has the necessary parts; optional parts follow in the order of their importance.
        let mut spare = row.width() - Self::MIN_WIDTH_PT;
        let mut room = |width: f32| {
            let fits = spare >= width;
            spare -= if fits { width } else { 0.0 };
            fits
        };
        let (has_rate, has_idle) = (room(rate_width), room(6.0 * GRID));
        let (has_done, has_bar) = (room(NUMBER_WIDTH_PT), room(9.0 * GRID));
        let slider = within(row.left() + 4.5 * GRID, 8.0 * GRID + (spare * 0.4).clamp(0.0, 7.0 * GRID), 2.5 * GRID);
        let speed = within(slider.right() + GRID, 7.5 * GRID, row.height() - 0.5 * GRID);
        let pause = within(speed.right() + 0.5 * GRID, 3.0 * GRID, 3.0 * GRID);
        let activity = row.right() - 10.0 * GRID;
        // The numbers are aligned at the right.
        let mut right = activity - 2.0 * GRID;
        let mut number = |there: bool, width: f32| {
            let end = right;
            right -= if there { width } else { 0.0 };
            there.then_some(end)
        };
        let (idle, rate) = (number(has_idle, 6.0 * GRID), number(has_rate, rate_width));
        let left = right;
        right -= NUMBER_WIDTH_PT;
        let done = has_done.then_some(right);
        right -= if has_done { NUMBER_WIDTH_PT } else { 0.0 };
        let bar = within(pause.right() + 1.5 * GRID, (right - pause.right() - 2.0 * GRID).max(0.0), GRID);
        let bar = (has_bar && bar.width() > 4.0 * GRID).then_some(bar);
        Self { row, slider, speed, pause, bar, done, left, rate, idle, activity, is_dense }
    }

    /// Returns the side of the chip.
    pub fn side(&self) -> f32 {
        (self.row.height() - 0.5 * GRID).min(3.0 * GRID)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn parts_of_a_row_never_overlap(width in RowLayout::MIN_WIDTH_PT..900.0f32) {
            let row = Rect::from_min_size(pos2(16.0, 100.0), vec2(width, 4.0 * GRID));
            let layout = RowLayout::new(row, false);
            // A number has at most six digits left of its end.
            let numbers = [layout.done, Some(layout.left), layout.rate, layout.idle];
            let ends: Vec<f32> = numbers.into_iter().flatten().collect();
            prop_assert!(ends.windows(2).all(|pair| pair[1] - pair[0] >= 5.5 * GRID), "{ends:?}");
            let first = ends[0] - 5.0 * GRID;
            let before = layout.bar.map_or(layout.pause.right(), |bar| bar.right());
            prop_assert!(before <= first, "{before} {first}");
            prop_assert!(layout.slider.right() < layout.speed.left() && layout.speed.right() < layout.pause.left());
            prop_assert!(ends[ends.len() - 1] < layout.activity && layout.activity < row.right());
            prop_assert!(row.contains_rect(layout.slider) && row.contains_rect(layout.pause));
        }
    }
}
