//! Where a hierarchy of boxes is split.

use super::Aabb;

/// Below this depth [`split`] halves by count, so that no hierarchy is deeper than this and the number of times that
/// its boxes can be halved.
pub const MAX_SAH_DEPTH: u32 = 32;

/// Orders numbered boxes so that those before the place that is returned are one part, and the others another: where
/// the surface area heuristic expects least work for a ray (MacDonald and Booth, *Heuristics for ray tracing using
/// space subdivision*, 1990). Returns nothing, if no split pays. `depth` is 0 for all boxes, 1 for the parts of the
/// first split, and so on.
pub fn split<Id: Ord>(boxes: &mut [(Id, Aabb)], depth: u32) -> Option<usize> {
    /// Work of meeting a box, as a part of that of meeting what is in it.
    const BOX: f64 = 0.5;
    if boxes.len() < 2 {
        return None;
    }
    if depth >= MAX_SAH_DEPTH {
        sort_along(boxes, 0);
        return Some(boxes.len() / 2);
    }
    let area = boxes.iter().fold(Aabb::EMPTY, |all, (_, bounds)| all.union(*bounds)).half_area();
    let mut least = boxes.len() as f64 * area - 2.0 * BOX * area;
    let mut best = None;
    for axis in 0..3 {
        sort_along(boxes, axis);
        let mut after = vec![Aabb::EMPTY; boxes.len()];
        let mut all = Aabb::EMPTY;
        for (index, (_, bounds)) in boxes.iter().enumerate().rev() {
            all = all.union(*bounds);
            after[index] = all;
        }
        let mut before = Aabb::EMPTY;
        for place in 1..boxes.len() {
            before = before.union(boxes[place - 1].1);
            let work = place as f64 * before.half_area() + (boxes.len() - place) as f64 * after[place].half_area();
            if work < least {
                (least, best) = (work, Some((axis, place)));
            }
        }
    }
    let (axis, place) = best?;
    sort_along(boxes, axis);
    Some(place)
}

fn sort_along<Id: Ord>(boxes: &mut [(Id, Aabb)], axis: usize) {
    // By number where centres are equal, so that the same boxes are always split in the same way.
    boxes
        .sort_by(|(a, a_box), (b, b_box)| a_box.centre()[axis].total_cmp(&b_box.centre()[axis]).then_with(|| a.cmp(b)));
}
