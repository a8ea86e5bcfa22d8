//! A bounding volume hierarchy over solids, beside those without bounds.

use crate::csg::RootId;
use crate::geometry::{Aabb, MAX_SAH_DEPTH, Ray, fast_max, fast_min, split};

/// A binary tree of boxes. A node stores the boxes of both its children, so that one visit tests both.
#[derive(Debug, Default)]
pub(super) struct Bvh {
    top: Option<(Aabb, Child)>,
    nodes: Vec<Node>,
    /// The roots without bounds, then those of the leaves.
    roots: Vec<RootId>,
    unbounded: u32,
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
    /// Puts the bounded solids into a hierarchy.
    pub fn new(unbounded: Vec<RootId>, mut bounded: Vec<(RootId, Aabb)>) -> Self {
        let mut bvh = Self::of_unbounded(unbounded);
        if !bounded.is_empty() {
            bvh.top = Some(bvh.build(&mut bounded, 0));
        }
        bvh
    }

    /// All bounded solids in one box, without a hierarchy.
    pub fn flat(unbounded: Vec<RootId>, bounded: Vec<(RootId, Aabb)>) -> Self {
        let mut bvh = Self::of_unbounded(unbounded);
        if !bounded.is_empty() {
            bvh.top = Some(bvh.add_leaf(&bounded));
        }
        bvh
    }

    fn of_unbounded(roots: Vec<RootId>) -> Self {
        Self { unbounded: roots.len() as u32, roots, ..Self::default() }
    }

    /// All roots: those without bounds, and the others.
    pub fn roots(&self) -> (&[RootId], &[RootId]) {
        self.roots.split_at(self.unbounded as usize)
    }

    /// Starts the walk of `ray` through the solids that it may meet before `t_max`.
    #[inline(always)]
    pub fn walk<'a>(&'a self, ray: &'a Ray, t_max: f64, Pending(pending): &'a mut Pending) -> Walk<'a> {
        let mut depth = 0;
        if let Some((bounds, top)) = self.top
            && let Some(entry) = bounds.entry(ray, 0.0, t_max)
        {
            pending[depth] = (entry, top);
            depth += 1;
        }
        if self.unbounded > 0 {
            pending[depth] = (0.0, Child { to: 0, count: self.unbounded });
            depth += 1;
        }
        Walk { bvh: self, ray, pending, depth }
    }

    fn build(&mut self, solids: &mut [(RootId, Aabb)], depth: u32) -> (Aabb, Child) {
        let Some(place) = split(solids, depth) else {
            return self.add_leaf(solids);
        };
        let bounds = bounds_of(solids);
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

    fn add_leaf(&mut self, solids: &[(RootId, Aabb)]) -> (Aabb, Child) {
        let leaf = Child { to: self.roots.len() as u32, count: solids.len() as u32 };
        self.roots.extend(solids.iter().map(|(root, _)| root));
        (bounds_of(solids), leaf)
    }
}

fn bounds_of(solids: &[(RootId, Aabb)]) -> Aabb {
    solids.iter().fold(Aabb::EMPTY, |all, (_, bounds)| all.union(*bounds))
}

/// A ray's walk through a hierarchy: first the solids without bounds, then those whose boxes the ray meets, in the
/// order in which it enters the boxes.
#[derive(Debug)]
pub(super) struct Walk<'a> {
    bvh: &'a Bvh,
    ray: &'a Ray,
    /// Boxes to be visited, the next one last, and where the ray enters them.
    pending: &'a mut [(f64, Child)],
    depth: usize,
}

impl<'a> Walk<'a> {
    /// Returns the next solids that the ray may meet before `t_max`, which may be less with each call.
    #[inline(always)]
    pub fn next(&mut self, t_max: f64) -> Option<&'a [RootId]> {
        while self.depth > 0 {
            self.depth -= 1;
            let (entry, mut at) = self.pending[self.depth];
            if entry > t_max {
                continue;
            }
            loop {
                if at.count > 0 {
                    return Some(&self.bvh.roots[at.to as usize..(at.to + at.count) as usize]);
                }
                let node = &self.bvh.nodes[at.to as usize];
                let [first, second] = node.entries(self.ray, t_max);
                let [a, b] = node.children;
                let (near, far) = if first <= second { ((first, a), (second, b)) } else { ((second, b), (first, a)) };
                if far.0 < f64::INFINITY {
                    self.pending[self.depth] = far;
                    self.depth += 1;
                }
                if near.0 == f64::INFINITY {
                    break;
                }
                at = near.1;
            }
        }
        None
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
