//! A bounding volume hierarchy over solids.

use crate::csg::RootId;
use crate::geometry::{Aabb, MAX_SAH_DEPTH, Ray, fast_max, fast_min, split};

/// A binary tree of boxes. A node stores the boxes of both its children, so that one visit tests both.
#[derive(Debug, Default)]
pub(super) struct Bvh {
    top: Option<(Aabb, Child)>,
    nodes: Vec<Node>,
    roots: Vec<RootId>,
}

/// The boxes of two children, by axis and then by child.
#[derive(Debug, Default)]
struct Node {
    min: [[f64; 2]; 3],
    max: [[f64; 2]; 3],
    children: [Child; 2],
}

#[derive(Clone, Copy, Debug, Default)]
struct Child {
    /// For an inner node its index, for a leaf the index of its first root.
    to: u32,
    /// The number of roots in a leaf; 0 for an inner node.
    count: u32,
}

/// The boxes that a ray has yet to visit, and where it enters them: at most one for each level, of which
/// [`MAX_SAH_DEPTH`] are split by area, and 32 halve at most 2³² solids. Kept from ray to ray, since clearing it would
/// cost more than a box.
#[derive(Debug)]
pub(super) struct Pending([(f64, Child); MAX_SAH_DEPTH as usize + 32]);

impl Default for Pending {
    fn default() -> Self {
        Self([(0.0, Child::default()); _])
    }
}

impl Bvh {
    pub fn new(mut solids: Vec<(RootId, Aabb)>) -> Self {
        let mut bvh = Self::default();
        if !solids.is_empty() {
            bvh.top = Some(bvh.build(&mut solids, 0));
        }
        bvh
    }

    /// All solids in one box, without a hierarchy.
    pub fn flat(solids: Vec<(RootId, Aabb)>) -> Self {
        let bounds = solids.iter().fold(Aabb::EMPTY, |all, (_, bounds)| all.union(*bounds));
        let roots: Vec<_> = solids.iter().map(|(root, _)| *root).collect();
        let top = (!roots.is_empty()).then_some((bounds, Child { to: 0, count: roots.len() as u32 }));
        Self { top, nodes: Vec::new(), roots }
    }

    pub fn roots(&self) -> impl Iterator<Item = RootId> {
        self.roots.iter().copied()
    }

    /// Visits the solids whose boxes `ray` meets before `t_max`, nearer boxes first. `visit` returns the new `t_max`; a
    /// negative one ends the search.
    #[inline(always)]
    pub fn visit(
        &self,
        ray: &Ray,
        mut t_max: f64,
        Pending(stack): &mut Pending,
        mut visit: impl FnMut(RootId, f64) -> f64,
    ) {
        let Some((bounds, mut at)) = self.top else { return };
        let Some(mut entry) = bounds.entry(ray, 0.0, t_max) else { return };
        let mut depth = 0;
        loop {
            if entry <= t_max {
                if at.count > 0 {
                    for &root in &self.roots[at.to as usize..(at.to + at.count) as usize] {
                        t_max = visit(root, t_max);
                    }
                    if t_max < 0.0 {
                        return;
                    }
                } else {
                    let node = &self.nodes[at.to as usize];
                    let [first, second] = node.entries(ray, t_max);
                    let [a, b] = node.children;
                    let (near, far) =
                        if first <= second { ((first, a), (second, b)) } else { ((second, b), (first, a)) };
                    if far.0 < f64::INFINITY {
                        stack[depth] = far;
                        depth += 1;
                    }
                    if near.0 < f64::INFINITY {
                        (entry, at) = near;
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

    fn build(&mut self, solids: &mut [(RootId, Aabb)], depth: u32) -> (Aabb, Child) {
        let bounds = solids.iter().fold(Aabb::EMPTY, |all, (_, bounds)| all.union(*bounds));
        let Some(place) = split(solids, depth) else {
            let leaf = Child { to: self.roots.len() as u32, count: solids.len() as u32 };
            self.roots.extend(solids.iter().map(|(root, _)| root));
            return (bounds, leaf);
        };
        let number = self.nodes.len();
        self.nodes.push(Node::default());
        let (first, second) = solids.split_at_mut(place);
        let parts = [self.build(first, depth + 1), self.build(second, depth + 1)];
        let node = &mut self.nodes[number];
        for (side, (bounds, child)) in parts.into_iter().enumerate() {
            for axis in 0..3 {
                (node.min[axis][side], node.max[axis][side]) = (bounds.min[axis], bounds.max[axis]);
            }
            node.children[side] = child;
        }
        (bounds, Child { to: number as u32, count: 0 })
    }
}

impl Node {
    /// The distances at which `ray` enters the children's boxes before `t_max`; infinite for a box that it misses. The
    /// same as [`Aabb::entry`], for two boxes at once, so that the compiler can use vector instructions.
    #[inline(always)]
    fn entries(&self, ray: &Ray, t_max: f64) -> [f64; 2] {
        let (mut near, mut far) = ([0.0; 2], [t_max; 2]);
        for axis in 0..3 {
            let (origin, inverse) = (ray.origin[axis], ray.inverse_direction[axis]);
            let distance = |places: [f64; 2]| places.map(|place| (place - origin) * inverse);
            let (a, b) = (distance(self.min[axis]), distance(self.max[axis]));
            for side in 0..2 {
                near[side] = fast_max(fast_min(a[side], b[side]), near[side]);
                far[side] = fast_min(fast_max(a[side], b[side]), far[side]);
            }
        }
        [0, 1].map(|side| if near[side] <= far[side] { near[side] } else { f64::INFINITY })
    }
}
