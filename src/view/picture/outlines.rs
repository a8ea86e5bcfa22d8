//! Outlines of pieces of a picture.

use std::ops::Range;

/// Returns the outline of ranges of pixels, in scan order, of a picture with a width in pixels: lines from x, y to x, y
/// in pixels. There is no line where two ranges touch. The number of lines is about proportional to the number of rows.
pub fn outlines(pieces: impl Iterator<Item = Range<u32>>, width: u32) -> Vec<[u32; 4]> {
    let mut rows: Vec<(u32, Range<u32>)> = Vec::new();
    for piece in pieces.filter(|piece| !piece.is_empty()) {
        for row in piece.start / width..=(piece.end - 1) / width {
            let start = piece.start.max(row * width) - row * width;
            rows.push((row, start..piece.end.min((row + 1) * width) - row * width));
        }
    }
    rows.sort_by_key(|(row, run)| (*row, run.start));
    let mut merged: Vec<(u32, Range<u32>)> = Vec::new();
    for (row, run) in rows {
        match merged.last_mut() {
            Some((last, before)) if *last == row && before.end >= run.start => before.end = before.end.max(run.end),
            _ => merged.push((row, run)),
        }
    }
    let runs = |row: u32| {
        let first = merged.partition_point(|(other, _)| *other < row);
        merged[first..].iter().take_while(move |(other, _)| *other == row).map(|(_, run)| run.clone())
    };
    let mut lines = Vec::new();
    let mut touched: Vec<u32> = merged.iter().flat_map(|(row, _)| [*row, row + 1]).collect();
    touched.dedup();
    touched.sort_unstable();
    touched.dedup();
    for row in touched {
        let above: Vec<_> = row.checked_sub(1).map_or_else(Vec::new, |above| runs(above).collect());
        // There is a line between two rows where only one of them has a piece.
        let mut edges: Vec<u32> = above.iter().cloned().chain(runs(row)).flat_map(|run| [run.start, run.end]).collect();
        edges.sort_unstable();
        let (pairs, _) = edges.as_chunks::<2>();
        lines.extend(pairs.iter().filter(|[from, to]| from < to).map(|&[from, to]| [from, row, to, row]));
        lines
            .extend(runs(row).flat_map(|run| [[run.start, row, run.start, row + 1], [run.end, row, run.end, row + 1]]));
    }
    lines
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn lines_are_between_inside_and_outside(
            pieces in prop::collection::vec((0..60u32, 0..25u32), 0..5), width in 1..12u32,
        ) {
            let pieces: Vec<_> = pieces.into_iter().map(|(start, length)| start..start + length).collect();
            let inside: BTreeSet<(i64, i64)> = pieces
                .iter()
                .cloned()
                .flatten()
                .map(|pixel| (i64::from(pixel % width), i64::from(pixel / width)))
                .collect();
            let mut expected = BTreeSet::new();
            for &(x, y) in &inside {
                for (beside, line) in [
                    ((x - 1, y), (x, y, false)), ((x + 1, y), (x + 1, y, false)),
                    ((x, y - 1), (x, y, true)), ((x, y + 1), (x, y + 1, true)),
                ] {
                    if !inside.contains(&beside) {
                        expected.insert(line);
                    }
                }
            }
            let mut drawn = BTreeSet::new();
            for [x0, y0, x1, y1] in outlines(pieces.into_iter(), width) {
                prop_assert!(x0 <= x1 && y0 <= y1 && (x0 == x1) != (y0 == y1));
                let along = if x0 == x1 { vec![(x0, y0, false)] } else { (x0..x1).map(|x| (x, y0, true)).collect() };
                drawn.extend(along.into_iter().map(|(x, y, flat)| (i64::from(x), i64::from(y), flat)));
            }
            prop_assert_eq!(drawn, expected);
        }
    }
}
