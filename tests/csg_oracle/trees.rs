//! Random trees, and what is inside them between a line's crossings.

use std::cmp::Ordering;

use anel::csg::Solid;
use fastrand::Rng;
use glam::DAffine3;

use super::exact::{GivenUp, Place};
use super::leaves::{Grid, Leaf, Line};

/// With at most two crossings a leaf, a line has no more intervals than a `u128` bits.
const MOST_LEAVES: usize = 63;

/// A solid and what its leaves are, by their tags.
pub struct Scene {
    pub solid: Solid,
    pub leaves: Vec<Leaf>,
}

/// Where a line is in which leaf. Bit i stands for the open interval before place i.
pub struct Passage {
    /// Where it crosses anything, in order, each place once.
    pub places: Vec<Place>,
    /// The intervals in each leaf.
    pub inside: Vec<u128>,
    /// Two leaves are crossed at one place, or one is touched on an edge.
    pub coincides: bool,
}

struct Growing<'a> {
    rng: &'a mut Rng,
    grid: Grid,
    motion: DAffine3,
    leaves: Vec<Leaf>,
}

impl Scene {
    /// A tree of that depth on the grid, moved.
    pub fn random(rng: &mut Rng, depth: usize, grid: Grid, motion: DAffine3) -> Self {
        let mut growing = Growing { rng, grid, motion, leaves: Vec::new() };
        let solid = growing.tree(depth);
        Self { solid, leaves: growing.leaves }
    }

    pub fn passage(&self, line: &Line) -> Result<Passage, GivenUp> {
        let stays = self.leaves.iter().map(|leaf| leaf.stays(line)).collect::<Result<Vec<_>, _>>()?;
        let mut crossings: Vec<Place> = stays.iter().flatten().flatten().copied().collect();
        crossings.retain(|place| place.near.is_finite());
        crossings.sort_by(|a, b| a.near.total_cmp(&b.near));
        let mut places: Vec<Place> = Vec::new();
        for place in &crossings {
            match places.last_mut() {
                Some(last) if last.order(place)? == Ordering::Equal => last.blur = last.blur.max(place.blur),
                _ => places.push(*place),
            }
        }
        // Bit i of the intervals that come after a place, or all of them.
        let after = |place: &Place| match place.near {
            f64::NEG_INFINITY => u128::MAX,
            f64::INFINITY => 0,
            _ => {
                let at = places.iter().position(|other| other.order(place) == Ok(Ordering::Equal));
                u128::MAX << (at.expect("every crossing has its place") + 1)
            }
        };
        let inside = stays.iter().map(|stays| stays.iter().fold(0, |sum, [from, to]| sum | (after(from) & !after(to))));
        Ok(Passage { inside: inside.collect(), coincides: places.len() < crossings.len(), places })
    }
}

impl Passage {
    /// The intervals in the solid.
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

    /// What is beside the deepest operand; large things let it be seen in an intersection, small ones elsewhere.
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
            if self.leaves.len() + 6 < MOST_LEAVES {
                let operand = self.operand(below, operation == 1);
                solids.push(operand);
            }
        }
        // What is subtracted from is the deepest operand more often than not.
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
