//! Polylines: clipping, dashes, and spreading of labels.

use super::display_list::Point;

/// Farthest coordinate, in sizes of the plot: beyond it a point's distance does not change the visible part of a line.
const MAX_COORDINATE: f64 = 1e6;

/// Clips a line through points to a plot with the corners 0, 0 and 1, 1. The line is broken where a point is missing; a
/// point without neighbours is a line of one point.
pub(crate) fn clipped(places: &[Option<[f64; 2]>]) -> Vec<Vec<[f64; 2]>> {
    let mut lines: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut before = None;
    for place in places {
        let place = place.map(|place| place.map(|v| v.clamp(-MAX_COORDINATE, MAX_COORDINATE)));
        let seen = match (before, place) {
            (Some(from), Some(to)) => clip(from, to),
            (None, Some(lone)) => is_inside(lone).then_some((lone, lone)),
            (_, None) => None,
        };
        if let Some((from, to)) = seen {
            match lines.last_mut() {
                Some(line) if line.last() == Some(&from) => line.push(to),
                _ => lines.push(vec![from, to]),
            }
        }
        before = place;
    }
    lines.iter_mut().for_each(Vec::dedup);
    lines
}

/// Whether a point is in the plot.
pub(crate) fn is_inside(place: [f64; 2]) -> bool {
    place.iter().all(|v| (0.0..=1.0).contains(v))
}

/// Clips a straight line to the plot (Liang and Barsky 1984).
fn clip(from: [f64; 2], to: [f64; 2]) -> Option<([f64; 2], [f64; 2])> {
    let (mut start, mut end) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        let way = to[axis] - from[axis];
        if way == 0.0 && !(0.0..=1.0).contains(&from[axis]) {
            return None;
        } else if way != 0.0 {
            let (one, other) = (-from[axis] / way, (1.0 - from[axis]) / way);
            start = start.max(one.min(other));
            end = end.min(one.max(other));
        }
    }
    let at = |share: f64| match share {
        // The ends themselves, so that the next part of the line begins where this one ends.
        0.0 => from,
        1.0 => to,
        _ => std::array::from_fn(|axis| (from[axis] + share * (to[axis] - from[axis])).clamp(0.0, 1.0)),
    };
    (start <= end).then(|| (at(start), at(end)))
}

/// Cuts a line into pieces of length `dash`, `gap` apart.
pub(crate) fn dashes(points: &[Point], dash: f32, gap: f32) -> Vec<Vec<Point>> {
    let mut pieces = Vec::new();
    let mut piece: Vec<Point> = points.first().copied().into_iter().collect();
    let (mut is_drawn, mut left) = (true, dash);
    for two in points.windows(2) {
        let (mut from, to) = (two[0], two[1]);
        loop {
            let way = [to[0] - from[0], to[1] - from[1]];
            let length = way[0].hypot(way[1]);
            if length <= left {
                left -= length;
                piece.push(to);
                break;
            }
            from = [from[0] + way[0] * left / length, from[1] + way[1] * left / length];
            piece.push(from);
            let done = std::mem::replace(&mut piece, vec![from]);
            if is_drawn {
                pieces.push(done);
            }
            is_drawn = !is_drawn;
            left = if is_drawn { dash } else { gap };
        }
    }
    if is_drawn && piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

/// Returns the positions nearest to those wanted (least squares) that have the same order, a distance of at least
/// `apart`, and lie between `from` and `to` as far as there is room.
pub(crate) fn spread(wanted: &[f32], apart: f32, from: f32, to: f32) -> Vec<f32> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by(|&i, &j| wanted[i].total_cmp(&wanted[j]));
    // After subtracting the distances this is isotonic regression: neighbours in the wrong order are put at their mean
    // (pool adjacent violators).
    let mut groups: Vec<(f32, usize)> = Vec::new();
    for (rank, &i) in order.iter().enumerate() {
        let mut group = (wanted[i] - rank as f32 * apart, 1);
        while let Some((sum, count)) = groups.pop_if(|(sum, count)| *sum / *count as f32 >= group.0 / group.1 as f32) {
            group = (group.0 + sum, group.1 + count);
        }
        groups.push(group);
    }
    let last = (to - wanted.len().saturating_sub(1) as f32 * apart).max(from);
    let means = groups.iter().flat_map(|&(sum, count)| std::iter::repeat_n(sum / count as f32, count));
    let mut places = vec![0.0; wanted.len()];
    for ((rank, &i), mean) in order.iter().enumerate().zip(means) {
        places[i] = mean.clamp(from, last) + rank as f32 * apart;
    }
    places
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn line_is_clipped_to_the_plot() {
        let places =
            [Some([0.5, 0.5]), Some([0.5, 1.5]), None, Some([2.0, 0.5]), Some([-1.0, 0.5]), None, Some([0.1, 0.2])];
        let lines = [vec![[0.5, 0.5], [0.5, 1.0]], vec![[1.0, 0.5], [0.0, 0.5]], vec![[0.1, 0.2]]];
        assert_eq!(clipped(&places), lines);
        assert!(clipped(&[Some([-1.0, 0.5]), Some([0.5, 2.1])]).is_empty(), "it passes the corner");
    }

    #[test]
    fn dashes_turn_corners() {
        let pieces = dashes(&[[0.0, 0.0], [6.0, 0.0], [6.0, 8.0]], 8.0, 3.0);
        let first = vec![[0.0, 0.0], [6.0, 0.0], [6.0, 2.0]];
        assert_eq!(pieces, [first, vec![[6.0, 5.0], [6.0, 8.0]]]);
        assert!(dashes(&[[1.0, 1.0]], 8.0, 3.0).is_empty());
    }

    #[test]
    fn labels_at_one_position_are_spread_round_it() {
        assert_eq!(spread(&[50.0, 50.0, 10.0], 20.0, 0.0, 100.0), [40.0, 60.0, 10.0]);
        assert_eq!(spread(&[99.0, 98.0], 20.0, 0.0, 100.0), [100.0, 80.0]);
    }

    proptest! {
        #[test]
        fn clipped_line_has_exactly_the_points_inside(
            places in prop::collection::vec(prop::option::weighted(0.9, [-1.0..2.0f64, -1.0..2.0f64]), 0..20),
        ) {
            let lines = clipped(&places);
            prop_assert!(lines.iter().flatten().all(|&place| is_inside(place)), "{lines:?}");
            for place in places.into_iter().flatten().filter(|&place| is_inside(place)) {
                prop_assert!(lines.iter().flatten().any(|&seen| seen == place), "{place:?} is not in {lines:?}");
            }
        }

        #[test]
        fn spread_keeps_order_distance_and_bounds(
            wanted in prop::collection::vec(-50.0..350.0f32, 0..9), apart in 1.0..30.0f32,
        ) {
            let places = spread(&wanted, apart, 0.0, 300.0);
            prop_assert!(places.iter().all(|place| (-0.01..=300.01).contains(place)), "{places:?}");
            for (i, one) in places.iter().enumerate() {
                for (j, other) in places.iter().enumerate().filter(|(j, _)| *j != i) {
                    prop_assert!((one - other).abs() > apart - 0.01, "{places:?}");
                    prop_assert!(wanted[i] >= wanted[j] || one < other, "{wanted:?} {places:?}");
                }
            }
            let are_apart = |places: &[f32]| {
                let mut sorted = places.to_vec();
                sorted.sort_by(f32::total_cmp);
                sorted.windows(2).all(|two| two[1] - two[0] >= apart)
            };
            if are_apart(&wanted) && wanted.iter().all(|place| (0.0..=300.0).contains(place)) {
                let stay = wanted.iter().zip(&places).all(|(one, other)| (one - other).abs() < 0.01);
                prop_assert!(stay, "{wanted:?} {places:?}");
            }
        }
    }
}
