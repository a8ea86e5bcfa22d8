//! Splitting of bounding volumes by the surface area heuristic.

use super::Aabb;

/// From this depth on [`split`] halves by count, so that no hierarchy is deeper than this plus the number of halvings
/// of its boxes.
const MAX_SAH_DEPTH: u32 = 32;

/// Reorders the boxes and returns an index that splits them in two parts where the surface area heuristic expects the
/// least work for a ray (MacDonald and Booth, *Heuristics for ray tracing using space subdivision*, 1990). Returns
/// nothing if no split pays. `depth` is 0 for all boxes, 1 for the parts of the first split, and so on.
pub fn split<Id: Ord>(boxes: &mut [(Id, Aabb)], depth: u32) -> Option<usize> {
    /// The work of testing a box, relative to that of testing its content.
    const BOX_COST: f64 = 0.5;
    if boxes.len() < 2 {
        return None;
    }
    if depth >= MAX_SAH_DEPTH {
        sort_along(boxes, 0);
        return Some(boxes.len() / 2);
    }
    let area = boxes.iter().fold(Aabb::EMPTY, |all, (_, bounds)| all.union(*bounds)).half_area();
    let mut least = boxes.len() as f64 * area - 2.0 * BOX_COST * area;
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
        for middle in 1..boxes.len() {
            before = before.union(boxes[middle - 1].1);
            let work = middle as f64 * before.half_area() + (boxes.len() - middle) as f64 * after[middle].half_area();
            if work < least {
                (least, best) = (work, Some((axis, middle)));
            }
        }
    }
    let (axis, middle) = best?;
    sort_along(boxes, axis);
    Some(middle)
}

/// Splits boxes into at most `count` groups of neighbours, the largest group again and again by `split`, which returns
/// nothing for what is to stay whole. Returns each group with its depth.
pub fn split_into<Id>(
    boxes: &mut [(Id, Aabb)],
    depth: u32,
    count: usize,
    split: impl Fn(&mut [(Id, Aabb)], u32) -> Option<usize>,
) -> Vec<(&mut [(Id, Aabb)], u32)> {
    let mut groups = vec![(boxes, depth)];
    let mut whole = Vec::new();
    while groups.len() + whole.len() < count {
        let size = |group: &[(Id, Aabb)]| group.iter().fold(Aabb::EMPTY, |all, (_, one)| all.union(*one)).half_area();
        let sizes = groups.iter().map(|(group, _)| size(group)).enumerate();
        let Some((largest, _)) = sizes.max_by(|(_, a), (_, b)| a.total_cmp(b)) else { break };
        let (group, depth) = groups.swap_remove(largest);
        match if group.len() > 1 { split(group, depth) } else { None } {
            Some(place) => {
                let (first, second) = group.split_at_mut(place);
                groups.extend([(first, depth + 1), (second, depth + 1)]);
            }
            None => whole.push((group, depth)),
        }
    }
    whole.extend(groups);
    whole
}

fn sort_along<Id: Ord>(boxes: &mut [(Id, Aabb)], axis: usize) {
    // Equal centres are ordered by id, so that the same boxes are always split in the same way.
    boxes
        .sort_by(|(a, a_box), (b, b_box)| a_box.centre()[axis].total_cmp(&b_box.centre()[axis]).then_with(|| a.cmp(b)));
}
