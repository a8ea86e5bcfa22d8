//! Hatches: patterns of lines that distinguish nodes without colour.

use std::fmt::Write;

/// Side of the tile that a pattern repeats.
pub(super) const TILE_SIDE: f32 = 12.0;

/// Returns the lines of a node's tile as SVG path data. Eight neighbouring nodes differ in direction, the next eight in
/// density; from the 25th on the patterns repeat.
pub(super) fn pattern(node: u16) -> String {
    let (kind, dense) = (node % 8, 1 + node / 8 % 3);
    let mut path = String::new();
    let mut line = |from: [f32; 2], to: [f32; 2]| {
        // Writing to a String cannot fail.
        let _ = write!(path, "M{} {}L{} {}", from[0], from[1], to[0], to[1]);
    };
    let step = TILE_SIDE / f32::from(dense);
    // Slanted lines begin and end outside, so that no corner is missing where tiles meet.
    for i in -i16::try_from(dense).unwrap_or(1)..=2 * i16::try_from(dense).unwrap_or(1) {
        let at = f32::from(i) * step;
        let inside = (0.0..TILE_SIDE).contains(&at);
        if matches!(kind, 1 | 6) {
            line([at - 1.0, -1.0], [at + TILE_SIDE + 1.0, TILE_SIDE + 1.0]);
        }
        if matches!(kind, 2 | 6) {
            line([at + 1.0, -1.0], [at - TILE_SIDE - 1.0, TILE_SIDE + 1.0]);
        }
        if matches!(kind, 3 | 5) && inside {
            line([at + step / 2.0, 0.0], [at + step / 2.0, TILE_SIDE]);
        }
        if matches!(kind, 4 | 5) && inside {
            line([0.0, at + step / 2.0], [TILE_SIDE, at + step / 2.0]);
        }
        if kind == 7 && inside {
            // Dots.
            line([at + step / 2.0 - 0.9, TILE_SIDE / 4.0], [at + step / 2.0 + 0.9, TILE_SIDE / 4.0]);
            line([at + step / 2.0 - 0.9, 0.75 * TILE_SIDE], [at + step / 2.0 + 0.9, 0.75 * TILE_SIDE]);
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn nodes_have_distinct_hatches() {
        let patterns: BTreeSet<String> = (0..24).map(pattern).collect();
        // The first of each eight has no lines: plain colour is its hatch.
        assert_eq!(patterns.len(), 22);
        assert!((0..100).all(|node| pattern(node) != pattern(node + 1)));
    }
}
