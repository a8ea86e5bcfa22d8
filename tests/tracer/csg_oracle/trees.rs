//! Random trees, and the intervals of a line inside them.

use std::cmp::Ordering;

use anel::csg::Solid;
use fastrand::Rng;
use glam::DAffine3;

use super::exact::{GivenUp, Place};
use super::leaves::{Grid, Leaf, Line};

/// With at most two crossings for each leaf, the intervals of a line fit into the bits of a `u128`.
const MAX_LEAVES: usize = 63;

/// A solid and its exact leaves, by their tags.
pub struct Scene {
    pub solid: Solid,
    pub leaves: Vec<Leaf>,
}

/// The intervals of a line inside each leaf. Bit i is the open interval before place i.
pub struct Passage {
    /// All crossings, in order, each place once.
    pub places: Vec<Place>,
    /// The intervals inside each leaf.
    pub inside: Vec<u128>,
    /// Whether two leaves are crossed at one place, or one is touched on an edge.
    pub coincides: bool,
}

struct Growing<'a> {
    rng: &'a mut Rng,
    grid: Grid,
    motion: DAffine3,
    leaves: Vec<Leaf>,
}

impl Scene {
    /// A random tree of this depth on the grid, moved.
    pub fn random(rng: &mut Rng, depth: usize, grid: Grid, motion: DAffine3) -> Self {
        let mut growing = Growing { rng, grid, motion, leaves: Vec::new() };
        let solid = growing.tree(depth);
        Self { solid, leaves: growing.leaves }
    }

    pub fn passage(&self, line: &Line) -> Result<Passage, GivenUp> {
        let spans = self.leaves.iter().map(|leaf| leaf.spans(line)).collect::<Result<Vec<_>, _>>()?;
        let mut crossings: Vec<Place> = spans.iter().flatten().flatten().copied().collect();
        crossings.retain(|place| place.near.is_finite());
        crossings.sort_by(|a, b| a.near.total_cmp(&b.near));
        let mut places: Vec<Place> = Vec::new();
        for place in &crossings {
            match places.last_mut() {
                Some(last) if last.order(place)? == Ordering::Equal => last.blur = last.blur.max(place.blur),
                _ => places.push(*place),
            }
        }
        // The intervals after a place.
        let after = |place: &Place| match place.near {
            f64::NEG_INFINITY => u128::MAX,
            f64::INFINITY => 0,
            _ => {
                let at = places.iter().position(|other| other.order(place) == Ok(Ordering::Equal));
                u128::MAX << (at.expect("every crossing has its place") + 1)
            }
        };
        let inside = spans.iter().map(|spans| spans.iter().fold(0, |sum, [from, to]| sum | (after(from) & !after(to))));
        Ok(Passage { inside: inside.collect(), coincides: places.len() < crossings.len(), places })
    }
}

impl Passage {
    /// The intervals inside the solid.
    pub fn of(&self, solid: &Solid) -> u128 {
        match solid {
            Solid::Placed { tag, .. } => self.inside[tag.index()],
            Solid::Union(solids) => solids.iter().fold(0, |sum, solid| sum | self.of(solid)),
            Solid::Intersection(solids) if solids.is_empty() => 0,
            Solid::Intersection(solids) => solids.iter().fold(u128::MAX, |common, solid| common & self.of(solid)),
            Solid::Difference(solids) => match solids.split_first() {
                Some((first, others)) => others.iter().fold(self.of(first), |rest, solid| rest & !self.of(solid)),
                None => 0,
            },
        }
    }
}

impl Growing<'_> {
    fn leaf(&mut self, large: bool) -> Leaf {
        if !self.leaves.is_empty() && self.grid.step > 1 && self.rng.u8(0..4) == 0 {
            return self.leaves[self.rng.usize(0..self.leaves.len())].clone();
        }
        Leaf::random(self.rng, self.grid, large)
    }

    fn placed(&mut self, leaf: Leaf) -> Solid {
        let solid = leaf.placed(self.rng, &self.motion, self.leaves.len() as u32);
        self.leaves.push(leaf);
        solid
    }

    /// An operand beside the deepest one. Large operands keep it visible in an intersection, small ones elsewhere.
    fn operand(&mut self, depth: usize, large: bool) -> Solid {
        let large = large != (self.rng.u8(0..4) == 0);
        match self.rng.u8(0..32) {
            0 if !large => Solid::Intersection(vec![]),
            1 => {
                let leaf = self.leaf(large).out_of_reach();
                self.placed(leaf)
            }
            2..7 if depth > 0 => {
                let depth = self.rng.usize(1..=depth.min(2));
                self.tree(depth)
            }
            _ => {
                let leaf = self.leaf(large);
                self.placed(leaf)
            }
        }
    }

    fn tree(&mut self, depth: usize) -> Solid {
        let Some(below) = depth.checked_sub(1) else {
            let large = self.rng.bool();
            let leaf = self.leaf(large);
            return self.placed(leaf);
        };
        let operation = self.rng.u8(0..3);
        let mut solids = vec![self.tree(below)];
        let others = [0, 1, 1, 1, 1, 1, 2, 2, 3][self.rng.usize(0..9)];
        for _ in 0..others {
            if self.leaves.len() + 6 < MAX_LEAVES {
                let operand = self.operand(below, operation == 1);
                solids.push(operand);
            }
        }
        // In most differences the deepest operand is the first.
        if operation < 2 || self.rng.u8(0..3) == 0 {
            self.rng.shuffle(&mut solids);
        }
        match operation {
            0 => Solid::Union(solids),
            1 => Solid::Intersection(solids),
            _ => Solid::Difference(solids),
        }
    }
}
