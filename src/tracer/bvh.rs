//! A bounding volume hierarchy over solids, beside those without bounds. A node has up to eight children, whose boxes a
//! ray tests at once (see [`Boxes`]).

use crate::csg::RootId;
use crate::geometry::{Aabb, BoxFrame, BoxRay, Boxes, Ray, WIDTH, split, split_into};

/// A tree of boxes.
#[derive(Debug)]
pub(super) struct Bvh {
    frame: BoxFrame,
    nodes: Vec<Node>,
    /// The roots without bounds, then those of the leaves.
    roots: Vec<RootId>,
    unbounded: u32,
}

#[derive(Debug)]
struct Node {
    boxes: Boxes,
    children: [Child; WIDTH],
}

#[derive(Clone, Copy, Debug, Default)]
struct Child {
    /// For an inner node its index, for a leaf the index of its first root.
    to: u32,
    /// The number of roots in a leaf; 0 for an inner node.
    count: u32,
}

/// The boxes that a ray has yet to visit, the next one last, and where the ray enters them. Kept from ray to ray.
#[derive(Debug, Default)]
pub(super) struct Pending(Vec<(f32, Child)>);

impl Bvh {
    /// Puts the bounded solids into a hierarchy.
    pub fn new(unbounded: Vec<RootId>, mut bounded: Vec<(RootId, Aabb)>) -> Self {
        let mut bvh = Self::of_unbounded(unbounded, bounds_of(&bounded));
        if !bounded.is_empty() {
            bvh.add_node(split_into(&mut bounded, 0, WIDTH, split));
        }
        bvh
    }

    /// All bounded solids in one box, without a hierarchy.
    pub fn flat(unbounded: Vec<RootId>, bounded: Vec<(RootId, Aabb)>) -> Self {
        let bounds = bounds_of(&bounded);
        let mut bvh = Self::of_unbounded(unbounded, bounds);
        if !bounded.is_empty() {
            let mut node = Node { boxes: Boxes::NONE, children: [Child::default(); WIDTH] };
            node.boxes.add(bounds, &bvh.frame);
            node.children[0] = bvh.add_leaf(&bounded);
            bvh.nodes.push(node);
        }
        bvh
    }

    fn of_unbounded(roots: Vec<RootId>, bounds: Aabb) -> Self {
        let unbounded = roots.len() as u32;
        Self { frame: BoxFrame::new(bounds), nodes: Vec::new(), unbounded, roots }
    }

    /// All roots: those without bounds, and the others.
    pub fn roots(&self) -> (&[RootId], &[RootId]) {
        self.roots.split_at(self.unbounded as usize)
    }

    /// Starts the walk of `ray`.
    #[inline(always)]
    pub fn walk<'a>(&'a self, ray: &Ray, order: Order, Pending(pending): &'a mut Pending) -> Walk<'a> {
        pending.clear();
        let ray = self.frame.ray(ray);
        Walk { bvh: self, pending, order, stage: Stage::Unbounded, start: ray.place(0.0), ray }
    }

    fn build(&mut self, solids: &mut [(RootId, Aabb)], depth: u32) -> Child {
        let groups = split_into(solids, depth, WIDTH, split);
        if let [(only, _)] = &groups[..] { self.add_leaf(only) } else { self.add_node(groups) }
    }

    /// Adds a node for groups of solids, each with its depth.
    fn add_node(&mut self, groups: Vec<(&mut [(RootId, Aabb)], u32)>) -> Child {
        let number = self.nodes.len();
        self.nodes.push(Node { boxes: Boxes::NONE, children: [Child::default(); WIDTH] });
        for (place, (group, depth)) in groups.into_iter().enumerate() {
            self.nodes[number].boxes.add(bounds_of(group), &self.frame);
            self.nodes[number].children[place] = self.build(group, depth);
        }
        Child { to: number as u32, count: 0 }
    }

    fn add_leaf(&mut self, solids: &[(RootId, Aabb)]) -> Child {
        let leaf = Child { to: self.roots.len() as u32, count: solids.len() as u32 };
        self.roots.extend(solids.iter().map(|(root, _)| root));
        leaf
    }
}

fn bounds_of(solids: &[(RootId, Aabb)]) -> Aabb {
    solids.iter().fold(Aabb::EMPTY, |all, (_, bounds)| all.union(*bounds))
}

/// A ray's walk through a hierarchy: first the solids without bounds, then those whose boxes the ray meets, nearly in
/// the order in which it enters the boxes.
#[derive(Debug)]
pub(super) struct Walk<'a> {
    bvh: &'a Bvh,
    pending: &'a mut Vec<(f32, Child)>,
    order: Order,
    stage: Stage,
    ray: BoxRay,
    /// The place of the ray's origin.
    start: f32,
}

/// The order of a walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    /// Nearly that in which the ray enters the boxes.
    Nearest,
    /// Any, for a ray that stops at the first solid that it meets.
    Any,
}

/// What a walk comes to next.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// The solids without bounds.
    Unbounded,
    /// The first node.
    Top,
    /// The boxes that are pending.
    Below,
}

impl<'a> Walk<'a> {
    /// Returns the next solids that the ray may meet before `t_max`, which may be less with each call.
    #[inline(always)]
    pub fn next(&mut self, t_max: f64) -> Option<&'a [RootId]> {
        // Boxes have more room than what this is rounded by.
        let end = self.ray.place(t_max);
        match self.stage {
            Stage::Unbounded => {
                self.stage = Stage::Top;
                return Some(self.bvh.roots().0);
            }
            Stage::Top => {
                self.stage = Stage::Below;
                if let Some(top) = self.bvh.nodes.first() {
                    self.visit(top, end);
                }
            }
            Stage::Below => {}
        }
        while let Some((entry, at)) = self.pending.pop() {
            if entry > end {
                continue;
            }
            if at.count > 0 {
                return Some(&self.bvh.roots[at.to as usize..(at.to + at.count) as usize]);
            }
            self.visit(&self.bvh.nodes[at.to as usize], end);
        }
        None
    }

    /// Adds the children that the ray meets before `end`, the nearest last.
    #[inline(always)]
    fn visit(&mut self, node: &Node, end: f32) {
        let mut entry = [0.0; WIDTH];
        let mut met = self.ray.meets(&node.boxes, [self.start, end], &mut entry);
        let first = self.pending.len();
        while met != 0 {
            let child = met.trailing_zeros() as usize;
            met &= met - 1;
            self.pending.push((entry[child], node.children[child]));
            let mut place = self.pending.len() - 1;
            while self.order == Order::Nearest && place > first && self.pending[place - 1].0 < self.pending[place].0 {
                self.pending.swap(place - 1, place);
                place -= 1;
            }
        }
    }
}
