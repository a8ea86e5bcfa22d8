//! Where the parts of a node's row go.

use egui::{Rect, pos2, vec2};

use crate::gui::widgets::theme::GRID;

/// The height of the line above the rows.
pub const HEAD: f32 = 2.5 * GRID;

/// Rows in columns, filled from top to bottom.
pub struct RowGrid {
    /// How many columns there are.
    pub columns: usize,
    /// How many rows a column has.
    pub lines: usize,
    /// The width of a column.
    pub width: f32,
    /// The height of a row.
    pub row: f32,
}

impl RowGrid {
    const GAP: f32 = 4.0 * GRID;
    /// More rows than this stand closer.
    const MANY: usize = 16;

    /// So many rows in so much room.
    pub fn new(rows: usize, room: f32) -> Self {
        // Two columns are worth some squeezing, more only where there are many rows.
        let is_dense = rows > Self::MANY;
        let columns =
            if room < 2.0 * RowLayout::LEAST + Self::GAP { 1 } else { (((room + Self::GAP) / 632.0) as usize).max(2) };
        let columns =
            if is_dense { (((room + Self::GAP) / (RowLayout::LEAST + Self::GAP)) as usize).max(1) } else { columns };
        let lines = rows.div_ceil(columns).max(1);
        let columns = rows.div_ceil(lines).max(1);
        let row = if is_dense { 3.0 } else { 4.0 } * GRID;
        Self { columns, lines, width: (room + Self::GAP) / columns as f32 - Self::GAP, row }
    }

    /// Whether there are so many rows that they stand closer.
    pub fn is_dense(&self) -> bool {
        self.row < 4.0 * GRID
    }

    /// The height of all.
    pub fn height(&self) -> f32 {
        HEAD + self.lines as f32 * self.row
    }

    /// Where a column begins.
    pub fn left(&self, column: usize) -> f32 {
        column as f32 * (self.width + Self::GAP)
    }
}

/// Where the parts of a row go, from left to right. What there is no room for is not there.
pub struct RowLayout {
    /// All of it.
    pub row: Rect,
    /// The slider of its speed.
    pub slider: Rect,
    /// The exact speed.
    pub speed: Rect,
    /// Pause.
    pub pause: Rect,
    /// Done and left as a bar.
    pub bar: Option<Rect>,
    /// The right end of the atoms done.
    pub done: Option<f32>,
    /// The right end of the atoms left.
    pub left: f32,
    /// The right end of the atoms a second.
    pub rate: Option<f32>,
    /// The right end of how long it was idle.
    pub idle: Option<f32>,
    /// The left end of what it does.
    pub activity: f32,
    /// Whether rows stand close, so that text has to be small.
    pub is_dense: bool,
}

impl RowLayout {
    /// The least width of a row.
    pub const LEAST: f32 = 42.0 * GRID;

    /// The parts of a row of this width, or of the line above such rows.
    pub fn new(row: Rect, is_dense: bool) -> Self {
        const NUMBER: f32 = 7.0 * GRID;
        let rate_width = if is_dense { 6.5 } else { 8.0 } * GRID;
        let within = |left: f32, width: f32, height: f32| {
            Rect::from_min_size(pos2(left, row.center().y - height / 2.0), vec2(width, height))
        };
        // First what a row cannot do without, then what there is still room for, from what is needed most.
        let mut spare = row.width() - Self::LEAST;
        let mut room = |width: f32| {
            let fits = spare >= width;
            spare -= if fits { width } else { 0.0 };
            fits
        };
        let (has_rate, has_idle) = (room(rate_width), room(6.0 * GRID));
        let (has_done, has_bar) = (room(NUMBER), room(9.0 * GRID));
        let slider = within(row.left() + 4.5 * GRID, 8.0 * GRID + (spare * 0.4).clamp(0.0, 7.0 * GRID), 2.5 * GRID);
        let speed = within(slider.right() + GRID, 7.5 * GRID, row.height() - 0.5 * GRID);
        let pause = within(speed.right() + 0.5 * GRID, 3.0 * GRID, 3.0 * GRID);
        let activity = row.right() - 10.0 * GRID;
        // The numbers stand at the right, side by side.
        let mut right = activity - 2.0 * GRID;
        let mut number = |there: bool, width: f32| {
            let end = right;
            right -= if there { width } else { 0.0 };
            there.then_some(end)
        };
        let (idle, rate) = (number(has_idle, 6.0 * GRID), number(has_rate, rate_width));
        let left = right;
        right -= NUMBER;
        let done = has_done.then_some(right);
        right -= if has_done { NUMBER } else { 0.0 };
        let bar = within(pause.right() + 1.5 * GRID, (right - pause.right() - 2.0 * GRID).max(0.0), GRID);
        let bar = (has_bar && bar.width() > 4.0 * GRID).then_some(bar);
        Self { row, slider, speed, pause, bar, done, left, rate, idle, activity, is_dense }
    }

    /// The side of what is square.
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
        fn nothing_overlaps_in_a_row_of_any_width(width in RowLayout::LEAST..900.0f32) {
            let row = Rect::from_min_size(pos2(16.0, 100.0), vec2(width, 4.0 * GRID));
            let places = RowLayout::new(row, false);
            // The numbers take at most six digits' room to the left of their ends.
            let numbers = [places.done, Some(places.left), places.rate, places.idle];
            let ends: Vec<f32> = numbers.into_iter().flatten().collect();
            prop_assert!(ends.windows(2).all(|pair| pair[1] - pair[0] >= 5.5 * GRID), "{ends:?}");
            let first = ends[0] - 5.0 * GRID;
            let before = places.bar.map_or(places.pause.right(), |bar| bar.right());
            prop_assert!(before <= first, "{before} {first}");
            prop_assert!(places.slider.right() < places.speed.left() && places.speed.right() < places.pause.left());
            prop_assert!(ends[ends.len() - 1] < places.activity && places.activity < row.right());
            prop_assert!(row.contains_rect(places.slider) && row.contains_rect(places.pause));
        }
    }
}
