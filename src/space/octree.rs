//! An octree over boxes, and a ray's walk through it.

use glam::DVec3;

use crate::geometry::{Aabb, Ray};

/// A box that is cut into eight, and each part again, while it holds too much. Leaves that hold something are numbered
/// in Morton order, which keeps neighbours close; those that hold nothing are not leaves at all.
#[derive(Debug)]
pub struct Octree {
    bounds: Aabb,
    /// The first is the whole.
    cells: Vec<Cell>,
    leaves: Vec<LeafCell>,
}

/// A cell that is not cut any more.
#[derive(Clone, Copy, Debug)]
pub struct LeafCell {
    /// Where it is.
    pub bounds: Aabb,
    /// How many of the octree's boxes reach into it; at least 1.
    pub boxes: u32,
}

#[derive(Clone, Copy, Debug)]
enum Cell {
    Empty,
    Leaf(u32),
    /// The number of the first of eight cells: x is the lowest bit of a cell's place among them, z the highest.
    Inner(u32),
}

impl Octree {
    /// A cell that holds no more boxes than this is not cut; nor is one that all its boxes fill.
    pub const MAX_BOXES: usize = 4;
    /// Nor is one that was cut out of others this many times: 64 cells along each side of the whole.
    pub const MAX_DEPTH: u32 = 6;

    /// `boxes` must be finite. The octree's own box is padded, so that no ray in the plane of its faces is lost.
    pub fn new(boxes: &[Aabb]) -> Self {
        let bounds = boxes.iter().fold(Aabb::EMPTY, |all, one| all.union(*one));
        let mut octree = Self { bounds: bounds.padded(), cells: vec![Cell::Empty], leaves: Vec::new() };
        octree.fill(0, octree.bounds, boxes, 0);
        octree
    }

    /// The leaves by number.
    pub fn leaves(&self) -> &[LeafCell] {
        &self.leaves
    }

    /// Hands over the numbers of the leaves that `ray` crosses up to the distance `to`, each once, in the order in
    /// which it does. A point between cells belongs to one of them.
    pub fn walk(&self, ray: &Ray, to: f64, mut visit: impl FnMut(u32)) {
        if let Some(stay) = self.bounds.span(ray, 0.0, to) {
            self.walk_cell(0, self.bounds, ray, stay, &mut visit);
        }
    }

    fn fill(&mut self, cell: usize, bounds: Aabb, boxes: &[Aabb], depth: u32) {
        if boxes.is_empty() {
            return;
        }
        // Where boxes fill the cell, its parts would hold as many.
        let parts_hold_less = boxes.iter().any(|one| one.intersection(bounds) != bounds);
        if boxes.len() <= Self::MAX_BOXES || depth == Self::MAX_DEPTH || !parts_hold_less {
            self.cells[cell] = Cell::Leaf(self.leaves.len() as u32);
            self.leaves.push(LeafCell { bounds, boxes: boxes.len() as u32 });
            return;
        }
        let first = self.cells.len();
        self.cells[cell] = Cell::Inner(first as u32);
        self.cells.extend([Cell::Empty; 8]);
        for octant in 0..8 {
            let part = part(bounds, octant);
            let inside: Vec<_> = boxes.iter().copied().filter(|one| !one.intersection(part).is_empty()).collect();
            self.fill(first + octant, part, &inside, depth + 1);
        }
    }

    /// The cell's middle planes cut the ray's stay in it into one stay in each part that it crosses: at each plane it
    /// changes sides. So the parts' stays join without gaps, whatever rounding says.
    fn walk_cell(&self, cell: usize, bounds: Aabb, ray: &Ray, [from, to]: [f64; 2], visit: &mut impl FnMut(u32)) {
        let first = match self.cells[cell] {
            Cell::Empty => return,
            Cell::Leaf(leaf) => return visit(leaf),
            Cell::Inner(first) => first as usize,
        };
        let planes = (bounds.centre() - ray.origin) * ray.inverse_direction;
        let mut octant = 0;
        for axis in 0..3 {
            let (is_ahead, goes_up) = (planes[axis] > from, ray.inverse_direction[axis] > 0.0);
            octant |= usize::from(is_ahead != goes_up) << axis;
        }
        let mut order = [0, 1, 2];
        order.sort_by(|&a: &usize, &b| planes[a].total_cmp(&planes[b]));
        let mut at = from;
        for axis in order.into_iter().filter(|&axis| planes[axis] > from && planes[axis] < to) {
            // A ray through an edge passes two planes at once.
            if planes[axis] > at {
                self.walk_cell(first + octant, part(bounds, octant), ray, [at, planes[axis]], visit);
                at = planes[axis];
            }
            octant ^= 1 << axis;
        }
        self.walk_cell(first + octant, part(bounds, octant), ray, [at, to], visit);
    }
}

/// One eighth of a box.
fn part(bounds: Aabb, octant: usize) -> Aabb {
    let middle = bounds.centre();
    let is_high = |axis: usize| octant >> axis & 1 == 1;
    let corner = |low: DVec3, high: DVec3| {
        DVec3::from_array([0, 1, 2].map(|axis| if is_high(axis) { high[axis] } else { low[axis] }))
    };
    Aabb { min: corner(bounds.min, middle), max: corner(middle, bounds.max) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Places that often coincide, and lie on the planes of cells.
    fn place() -> impl Strategy<Value = DVec3> {
        let number = || prop_oneof![(-4i32..=4).prop_map(f64::from), -4.0..4.0];
        (number(), number(), number()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    fn boxes() -> impl Strategy<Value = Vec<Aabb>> {
        let size = (0.0..1.0, 0.0..1.0, 0.0..1.0).prop_map(|(x, y, z)| DVec3::new(x, y, z));
        let one = (place(), size).prop_map(|(min, size)| Aabb { min, max: min + size });
        prop::collection::vec(one, 0..30)
    }

    fn walk(octree: &Octree, ray: &Ray, to: f64) -> Vec<u32> {
        let mut walked = Vec::new();
        octree.walk(ray, to, |leaf| walked.push(leaf));
        walked
    }

    /// Where the ray is in a leaf that is grown by `by` on all sides (shrunk, if negative).
    fn span(octree: &Octree, leaf: u32, by: f64, ray: &Ray, to: f64) -> Option<[f64; 2]> {
        let Aabb { min, max } = octree.leaves()[leaf as usize].bounds;
        Aabb { min: min - by, max: max + by }.span(ray, 0.0, to)
    }

    proptest! {
        #[test]
        fn a_walk_meets_every_leaf_on_the_way_once_and_in_order(
            boxes in boxes(),
            origin in place(),
            aim in place(),
            to in prop_oneof![Just(f64::INFINITY), 0.0..9.0],
        ) {
            const SLACK: f64 = 1e-7;
            prop_assume!(origin != aim);
            let octree = Octree::new(&boxes);
            let ray = Ray::new(origin, (aim - origin).normalize());
            let walked = walk(&octree, &ray, to);
            for leaf in 0..octree.leaves().len() as u32 {
                let times = walked.iter().filter(|&&other| other == leaf).count();
                if span(&octree, leaf, -SLACK, &ray, to).is_some() {
                    prop_assert_eq!(times, 1, "leaf {} is crossed", leaf);
                } else if span(&octree, leaf, SLACK, &ray, to).is_none() {
                    prop_assert_eq!(times, 0, "leaf {} is far from the ray", leaf);
                } else {
                    prop_assert!(times <= 1, "leaf {} is met twice", leaf);
                }
            }
            for pair in walked.windows(2) {
                // Stays in what is shrunk touch nowhere, so their order leaves no doubt.
                let spans = [pair[0], pair[1]].map(|leaf| span(&octree, leaf, -SLACK, &ray, to));
                if let [Some([_, leaves]), Some([enters, _])] = spans {
                    prop_assert!(leaves <= enters, "{leaves} is after {enters}");
                }
            }
        }

        #[test]
        fn leaves_hold_what_reaches_into_them_and_no_more_than_is_allowed(boxes in boxes(), point in place()) {
            let octree = Octree::new(&boxes);
            let finest = (octree.bounds.max - octree.bounds.min) / f64::from(1 << Octree::MAX_DEPTH);
            for leaf in octree.leaves() {
                let reach = boxes.iter().filter(|one| !one.intersection(leaf.bounds).is_empty()).count();
                prop_assert_eq!(reach, leaf.boxes as usize);
                let fills = |one: &&Aabb| one.intersection(leaf.bounds) == leaf.bounds;
                let is_filled = boxes.iter().filter(fills).count() == reach;
                let is_finest = (leaf.bounds.max - leaf.bounds.min).cmple(finest * 1.001).all();
                prop_assert!(reach > 0 && (reach <= Octree::MAX_BOXES || is_finest || is_filled));
            }
            let holds = |one: &Aabb| !one.intersection(Aabb { min: point, max: point }).is_empty();
            let in_leaf = octree.leaves().iter().any(|leaf| holds(&leaf.bounds));
            prop_assert!(in_leaf || !boxes.iter().any(holds), "{point} is in a box, but in no leaf");
        }
    }
}
