//! An octree over boxes, and the traversal of it by a ray.

use glam::DVec3;

use crate::geometry::{Aabb, Ray};

/// A box that is divided into octants again and again while it contains too many boxes. Non-empty leaves are numbered
/// in Morton order, which keeps neighbours close; empty cells are not leaves.
#[derive(Debug)]
pub struct Octree {
    bounds: Aabb,
    /// The first is the root.
    cells: Vec<Cell>,
    leaves: Vec<LeafCell>,
}

/// A non-empty cell that is not divided.
#[derive(Clone, Copy, Debug)]
pub struct LeafCell {
    /// The cell's box.
    pub bounds: Aabb,
    /// The number of the octree's boxes that intersect it; at least 1.
    pub boxes: u32,
}

#[derive(Clone, Copy, Debug)]
enum Cell {
    Empty,
    Leaf(u32),
    /// The index of the first of eight cells. In a cell's offset among them x is the lowest bit, z the highest.
    Inner(u32),
}

impl Octree {
    /// A cell with at most this many boxes is not divided, nor is one that all its boxes fill.
    pub const MAX_BOXES: usize = 4;
    /// The greatest depth of a cell: 64 cells along each side of the root.
    pub const MAX_DEPTH: u32 = 6;

    /// `boxes` must be finite. The octree's own box is padded, so that rays in the plane of its faces are not lost.
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

    /// Visits the leaves that `ray` crosses up to the distance `to`, by number, each once and in order along the ray. A
    /// point between cells belongs to one of them.
    pub fn walk(&self, ray: &Ray, to: f64, mut visit: impl FnMut(u32)) {
        if let Some(span) = self.bounds.span(ray, 0.0, to) {
            self.walk_cell(0, self.bounds, ray, span, &mut visit);
        }
    }

    fn fill(&mut self, cell: usize, bounds: Aabb, boxes: &[Aabb], depth: u32) {
        if boxes.is_empty() {
            return;
        }
        // If the boxes fill the cell, its octants would contain just as many.
        let octants_have_fewer = boxes.iter().any(|one| one.intersection(bounds) != bounds);
        if boxes.len() <= Self::MAX_BOXES || depth == Self::MAX_DEPTH || !octants_have_fewer {
            self.cells[cell] = Cell::Leaf(self.leaves.len() as u32);
            self.leaves.push(LeafCell { bounds, boxes: boxes.len() as u32 });
            return;
        }
        let first = self.cells.len();
        self.cells[cell] = Cell::Inner(first as u32);
        self.cells.extend([Cell::Empty; 8]);
        for octant in 0..8 {
            let part = octant_of(bounds, octant);
            let inside: Vec<_> = boxes.iter().copied().filter(|one| !one.intersection(part).is_empty()).collect();
            self.fill(first + octant, part, &inside, depth + 1);
        }
    }

    /// Walks through a cell. The cell's middle planes split the ray's span in it into one span for each octant that it
    /// crosses: at each plane the octant changes along one axis. So the spans join without gaps, whatever rounding
    /// does.
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
            // A ray through an edge crosses two planes at once.
            if planes[axis] > at {
                self.walk_cell(first + octant, octant_of(bounds, octant), ray, [at, planes[axis]], visit);
                at = planes[axis];
            }
            octant ^= 1 << axis;
        }
        self.walk_cell(first + octant, octant_of(bounds, octant), ray, [at, to], visit);
    }
}

/// An octant of a box.
fn octant_of(bounds: Aabb, octant: usize) -> Aabb {
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

    /// Points that often coincide, or lie on the planes between cells.
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

    /// The ray's span in a leaf that is grown by `by` on all sides (shrunk if negative).
    fn span(octree: &Octree, leaf: u32, by: f64, ray: &Ray, to: f64) -> Option<[f64; 2]> {
        let Aabb { min, max } = octree.leaves()[leaf as usize].bounds;
        Aabb { min: min - by, max: max + by }.span(ray, 0.0, to)
    }

    proptest! {
        #[test]
        fn walk_visits_each_leaf_on_ray_once_and_in_order(
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
                // Shrunk leaves do not touch, so their order is certain.
                let spans = [pair[0], pair[1]].map(|leaf| span(&octree, leaf, -SLACK, &ray, to));
                if let [Some([_, leaves]), Some([enters, _])] = spans {
                    prop_assert!(leaves <= enters, "{leaves} is after {enters}");
                }
            }
        }

        #[test]
        fn leaves_contain_intersecting_boxes_up_to_limit(boxes in boxes(), point in place()) {
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
            let contains = |one: &Aabb| !one.intersection(Aabb { min: point, max: point }).is_empty();
            let in_leaf = octree.leaves().iter().any(|leaf| contains(&leaf.bounds));
            prop_assert!(in_leaf || !boxes.iter().any(contains), "{point} is in a box, but in no leaf");
        }
    }
}
