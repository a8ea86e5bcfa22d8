//! Layout of the table of machines and of its rows.

use egui::{Rect, pos2, vec2};

use crate::gui::widgets::theme::GRID;

/// How close the rows are, from far apart to close.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Density {
    /// Large text.
    Normal,
    /// Low rows with small text, for many machines.
    Dense,
    /// Lower and narrower rows, in more columns.
    Compact,
}

impl Density {
    /// Least and largest height of a row, in points.
    fn row_heights(self) -> [f32; 2] {
        match self {
            Self::Normal => [4.0 * GRID, 5.0 * GRID],
            Self::Dense => [3.0 * GRID, 4.0 * GRID],
            Self::Compact => [17.0, 3.0 * GRID],
        }
    }

    /// Distance between columns, in points.
    fn gap(self) -> f32 {
        if self == Self::Compact { 3.0 * GRID } else { 4.0 * GRID }
    }

    /// Least width of a row, in points.
    pub fn min_width(self) -> f32 {
        if self == Self::Compact { 36.0 * GRID } else { 42.0 * GRID }
    }
}

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
    /// How close the rows are.
    pub density: Density,
}

impl RowGrid {
    /// Most rows with the normal height; more are dense.
    const MAX_NORMAL_ROWS: usize = 16;

    /// Arranges this number of rows in a room, in points: as far apart as its height allows. The closest rows may need
    /// more height.
    pub fn new(rows: usize, [width, height]: [f32; 2]) -> Self {
        let densities = [Density::Normal, Density::Dense, Density::Compact].into_iter();
        let grids = densities.skip(usize::from(Self::are_many(rows))).map(|density| Self::of(rows, width, density));
        let mut grid = Self::of(rows, width, Density::Compact);
        for candidate in grids {
            if candidate.height() <= height {
                grid = candidate;
                break;
            }
        }
        let [least, most] = grid.density.row_heights();
        grid.row = ((height - grid.head() - 0.5) / grid.lines as f32).clamp(least, most);
        grid
    }

    /// Whether these are too many rows for the normal height.
    pub fn are_many(rows: usize) -> bool {
        rows > Self::MAX_NORMAL_ROWS
    }

    /// Returns the height of captions and rows where there is more room than they need.
    pub fn usual_height(&self) -> f32 {
        let [least, _] = self.density.row_heights();
        let row = if self.density == Density::Compact { self.row.min(2.75 * GRID) } else { least };
        self.head() + self.lines as f32 * row
    }

    /// Returns the height of the captions above the rows, in points.
    pub fn head(&self) -> f32 {
        if self.density == Density::Compact { 2.0 * GRID } else { 2.5 * GRID }
    }

    /// Arranges rows of the least height in a width of `room` points.
    fn of(rows: usize, room: f32, density: Density) -> Self {
        let (gap, least) = (density.gap(), density.min_width());
        // Two columns are used even if their rows lose parts; more columns only if there are many rows.
        let columns = match density {
            Density::Normal if room < 2.0 * least + gap => 1,
            Density::Normal => (((room + gap) / 632.0) as usize).max(2),
            _ => (((room + gap) / (least + gap)) as usize).max(1),
        };
        let lines = rows.div_ceil(columns).max(1);
        let columns = rows.div_ceil(lines).max(1);
        Self { columns, lines, width: (room + gap) / columns as f32 - gap, row: density.row_heights()[0], density }
    }

    /// Returns the height of captions and rows.
    pub fn height(&self) -> f32 {
        self.head() + self.lines as f32 * self.row
    }

    /// Returns the left edge of a column.
    pub fn left(&self, column: usize) -> f32 {
        column as f32 * (self.width + self.density.gap())
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
    /// Whether the row has small text.
    pub is_small: bool,
}

impl RowLayout {
    /// Lays out a row of this rectangle, or the captions above such rows.
    pub fn new(row: Rect, density: Density) -> Self {
        let is_compact = density == Density::Compact;
        let number_width = if is_compact { 5.5 } else { 7.0 } * GRID;
        let rate_width = if density == Density::Normal { 8.0 } else { 6.5 } * GRID;
        let within = |left: f32, width: f32, height: f32| {
            Rect::from_min_size(pos2(left, row.center().y - height / 2.0), vec2(width, height))
        };
        // The least width has the necessary parts; optional parts follow in the order of their importance.
        let mut spare = row.width() - density.min_width();
        let mut room = |width: f32| {
            let fits = spare >= width;
            spare -= if fits { width } else { 0.0 };
            fits
        };
        let (idle_width, bar_width) = (6.0 * GRID, 8.5 * GRID);
        let ([has_done, has_bar], [has_rate, has_idle]);
        if density == Density::Normal {
            [has_done, has_bar] = [room(number_width), room(bar_width)];
            [has_rate, has_idle] = [room(rate_width), room(idle_width)];
        } else {
            // A bar in a low row shows little.
            [has_rate, has_idle] = [room(rate_width), room(idle_width)];
            [has_done, has_bar] = [room(number_width), room(bar_width)];
        }
        // From the left edge to the slider, its width, that of the speed and of the pause button, and of the activity.
        let [before, slider, speed, pause, activity] =
            if is_compact { [3.5, 6.0, 6.5, 2.5, 9.5] } else { [4.5, 8.0, 7.5, 3.0, 10.0] }.map(|width| width * GRID);
        let slider =
            within(row.left() + before, slider + (spare * 0.4).clamp(0.0, 7.0 * GRID), row.height().min(2.5 * GRID));
        let speed = within(slider.right() + GRID, speed, row.height() - if is_compact { 1.0 } else { 0.5 * GRID });
        let pause = within(speed.right() + 0.5 * GRID, pause, pause);
        let activity = row.right() - activity;
        // The numbers are aligned at the right.
        let mut right = activity - if is_compact { GRID } else { 2.0 * GRID };
        let mut number = |there: bool, width: f32| {
            let end = right;
            right -= if there { width } else { 0.0 };
            there.then_some(end)
        };
        let (idle, rate) = (number(has_idle, 6.0 * GRID), number(has_rate, rate_width));
        let left = right;
        right -= number_width;
        let done = has_done.then_some(right);
        right -= if has_done { number_width } else { 0.0 };
        let bar = within(pause.right() + 1.5 * GRID, (right - pause.right() - 2.0 * GRID).max(0.0), GRID);
        let bar = (has_bar && bar.width() > 4.0 * GRID).then_some(bar);
        Self { row, slider, speed, pause, bar, done, left, rate, idle, activity, is_small: density != Density::Normal }
    }

    /// Returns the side of the chip.
    pub fn side(&self) -> f32 {
        (self.row.height() - if self.is_small { 2.0 } else { 0.5 * GRID }).min(3.0 * GRID)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn parts_of_a_row_never_overlap(width in 0.0..600.0f32) {
            for density in [Density::Normal, Density::Dense, Density::Compact] {
                let size = vec2(density.min_width() + width, density.row_heights()[0]);
                let layout = RowLayout::new(Rect::from_min_size(pos2(16.0, 100.0), size), density);
                // Large numbers have at most six digits left of their ends, small ones at most five.
                let letters = if density == Density::Compact { 4.5 } else { 5.5 };
                let numbers = [layout.done, Some(layout.left), layout.rate, layout.idle];
                let ends: Vec<f32> = numbers.into_iter().flatten().collect();
                prop_assert!(ends.windows(2).all(|pair| pair[1] - pair[0] >= letters * GRID), "{ends:?}");
                let first = ends[0] - (letters - 0.5) * GRID;
                let before = layout.bar.map_or(layout.pause.right(), |bar| bar.right());
                prop_assert!(before <= first, "{before} {first} {density:?}");
                prop_assert!(layout.slider.right() < layout.speed.left() && layout.speed.right() < layout.pause.left());
                prop_assert!(ends[ends.len() - 1] < layout.activity && layout.activity < layout.row.right());
                prop_assert!(layout.row.x_range().contains(layout.slider.left()));
            }
        }

        #[test]
        fn rows_use_the_height_and_stay_inside_it(rows in 1..33usize, width in 700.0..1900.0f32, height in 190.0..500.0f32) {
            let grid = RowGrid::new(rows, [width, height]);
            prop_assert!(grid.columns * grid.lines >= rows);
            prop_assert!(grid.width >= grid.density.min_width() - 0.1);
            prop_assert!(grid.height() <= height + 0.1 || grid.density == Density::Compact && width < 1230.0);
        }
    }
}
