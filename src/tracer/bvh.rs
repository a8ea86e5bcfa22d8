//! A hierarchy of bounding boxes over solids.

use crate::geometry::{Aabb, Ray};

/// A binary tree of boxes in depth-first order: a node's first child follows it.
#[derive(Debug, Default)]
pub(super) struct Bvh {
    nodes: Vec<Node>,
    roots: Vec<u32>,
}

#[derive(Debug)]
struct Node {
    bounds: Aabb,
    /// An inner node: where its second child is. A leaf: its first root.
    to: u32,
    /// How many roots a leaf has; 0 in an inner node.
    count: u32,
}

/// Below this depth the tree is halved by count, so that [`Pending`] always suffices.
const MAX_UNBALANCED: u32 = 32;
/// Boxes still to be visited, and where the ray enters them: 32 unbalanced levels, and 32 that halve at most 2³²
/// solids. Kept from ray to ray, since clearing it would cost more than a box.
#[derive(Debug)]
pub(super) struct Pending([(f64, u32); 64]);

impl Default for Pending {
    fn default() -> Self {
        Self([(0.0, 0); 64])
    }
}

impl Bvh {
    pub fn new(mut solids: Vec<(u32, Aabb)>) -> Self {
        let mut bvh = Self::default();
        if !solids.is_empty() {
            bvh.build(&mut solids, 0);
        }
        bvh
    }

    pub fn roots(&self) -> impl Iterator<Item = u32> {
        self.roots.iter().copied()
    }

    /// Visits the solids whose boxes `ray` meets before `t_max`, nearer boxes first. `visit` answers with a new
    /// `t_max`; a negative one ends the search.
    #[inline(always)]
    pub fn visit(
        &self,
        ray: &Ray,
        mut t_max: f64,
        Pending(stack): &mut Pending,
        mut visit: impl FnMut(u32, f64) -> f64,
    ) {
        let Some(top) = self.nodes.first().and_then(|node| node.bounds.entry(ray, 0.0, t_max)) else { return };
        let mut depth = 0;
        let (mut entry, mut at) = (top, 0);
        loop {
            let node = &self.nodes[at as usize];
            if entry <= t_max {
                if node.count > 0 {
                    for &root in &self.roots[node.to as usize..(node.to + node.count) as usize] {
                        t_max = visit(root, t_max);
                    }
                    if t_max < 0.0 {
                        return;
                    }
                } else {
                    let (first, second) = (at + 1, node.to);
                    let meet = |child: u32| self.nodes[child as usize].bounds.entry(ray, 0.0, t_max);
                    let next = match (meet(first), meet(second)) {
                        (Some(a), Some(b)) => {
                            let (near, far) =
                                if a <= b { ((a, first), (b, second)) } else { ((b, second), (a, first)) };
                            stack[depth] = far;
                            depth += 1;
                            Some(near)
                        }
                        (Some(a), None) => Some((a, first)),
                        (None, Some(b)) => Some((b, second)),
                        (None, None) => None,
                    };
                    if let Some(next) = next {
                        (entry, at) = next;
                        continue;
                    }
                }
            }
            if depth == 0 {
                return;
            }
            depth -= 1;
            (entry, at) = stack[depth];
        }
    }

    /// Splits where the surface area heuristic expects least work (MacDonald and Booth 1990).
    fn build(&mut self, solids: &mut [(u32, Aabb)], depth: u32) {
        let bounds = solids.iter().fold(Aabb::EMPTY, |all, (_, bounds)| all.union(*bounds));
        let node = self.nodes.len();
        self.nodes.push(Node { bounds, to: self.roots.len() as u32, count: solids.len() as u32 });
        let Some((axis, split)) = best_split(solids, &bounds, depth) else {
            self.roots.extend(solids.iter().map(|(root, _)| root));
            return;
        };
        sort_along(solids, axis);
        let (first, second) = solids.split_at_mut(split);
        self.build(first, depth + 1);
        self.nodes[node].to = self.nodes.len() as u32;
        self.nodes[node].count = 0;
        self.build(second, depth + 1);
    }
}

/// The axis to sort along and the number of solids in the first part; nothing, if no split pays.
fn best_split(solids: &mut [(u32, Aabb)], bounds: &Aabb, depth: u32) -> Option<(usize, usize)> {
    /// Work of meeting a box, as a part of that of meeting a solid.
    const BOX: f64 = 0.5;
    if solids.len() < 2 {
        return None;
    }
    if depth >= MAX_UNBALANCED {
        return Some((0, solids.len() / 2));
    }
    let area = bounds.half_area();
    let mut best = (solids.len() as f64 * area - 2.0 * BOX * area, None);
    for axis in 0..3 {
        sort_along(solids, axis);
        let mut after = vec![Aabb::EMPTY; solids.len()];
        let mut all = Aabb::EMPTY;
        for (index, (_, bounds)) in solids.iter().enumerate().rev() {
            all = all.union(*bounds);
            after[index] = all;
        }
        let mut before = Aabb::EMPTY;
        for split in 1..solids.len() {
            before = before.union(solids[split - 1].1);
            let work = split as f64 * before.half_area() + (solids.len() - split) as f64 * after[split].half_area();
            if work < best.0 {
                best = (work, Some((axis, split)));
            }
        }
    }
    best.1
}

fn sort_along(solids: &mut [(u32, Aabb)], axis: usize) {
    // By number where centres are equal, so that the same scene always gives the same tree.
    solids
        .sort_by(|(a, a_box), (b, b_box)| a_box.centre()[axis].total_cmp(&b_box.centre()[axis]).then_with(|| a.cmp(b)));
}
