//! Quads and lines of a timeline, and sums over its columns of pixels.

use crate::view::draw::display_list::Ink;

/// A rectangle of one colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quad {
    /// Left, top, right, bottom.
    pub place: [f32; 4],
    /// Its colour.
    pub ink: Ink,
}

/// Drawing of a timeline.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timeline {
    /// Rectangles, under the lines.
    pub quads: Vec<Quad>,
    /// Messages between lanes: start, end, and ink.
    pub lines: Vec<([f32; 2], [f32; 2], Ink)>,
}

/// Adds to each column the share of it that lies between `left` and `right`, in columns.
pub(super) fn add_to_columns(columns: &mut [f32], left: f32, right: f32) {
    let (left, right) = (left.max(0.0), right.min(columns.len() as f32));
    if right <= left {
        return;
    }
    let (first, last) = (left as usize, (right as usize).min(columns.len() - 1));
    if first == last {
        columns[first] += right - left;
        return;
    }
    columns[first] += (first + 1) as f32 - left;
    columns[first + 1..last].iter_mut().for_each(|column| *column += 1.0);
    columns[last] += right - last as f32;
}

/// Neighbouring columns of one level, from `start` to before `end`.
pub(super) struct ColumnRun {
    pub(super) start: usize,
    pub(super) end: usize,
    pub(super) level: u8,
}

/// Joins neighbouring columns of one level; columns of level 0 are left out.
pub(super) fn column_runs(levels: impl Iterator<Item = u8>) -> Vec<ColumnRun> {
    let mut runs: Vec<ColumnRun> = Vec::new();
    for (column, level) in levels.enumerate() {
        match runs.last_mut() {
            Some(run) if run.level == level && run.end == column => run.end += 1,
            _ => runs.push(ColumnRun { start: column, end: column + 1, level }),
        }
    }
    runs.retain(|run| run.level > 0);
    runs
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
    #[test]
        fn columns_sum_up_the_covered_length(left in -50.0..150.0f32, length in 0.0..90.0f32) {
            let mut columns = vec![0.0; 100];
            add_to_columns(&mut columns, left, left + length);
            let inside = (left + length).min(100.0) - left.max(0.0);
            prop_assert!((columns.iter().sum::<f32>() - inside.max(0.0)).abs() < 1e-3);
            prop_assert!(columns.iter().all(|column| (0.0..=1.0 + 1e-4).contains(column)));
        }
    }
}
