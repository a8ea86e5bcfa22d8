//! A solid before it is compiled: its leaves, and what is known of where each of its compositions lies.

use super::bounds::Extent;
use super::merge::Operation;
use super::{Leaf, Pass, Passes, Solid};
use crate::geometry::Aabb;

/// A solid with the extent of each of its parts, each by itself.
pub(super) struct Outline {
    pub extent: Extent,
    /// Its extent if nothing is subtracted, where that is another. It contains the solid however much of what is
    /// subtracted is left out.
    pub upper: Option<Extent>,
    pub kind: OutlineKind,
}

pub(super) enum OutlineKind {
    Leaf(Box<Leaf>),
    Composition(Operation, Vec<Outline>),
}

impl Outline {
    pub fn new(solid: &Solid, passes: Passes) -> Self {
        let (operation, solids) = match solid {
            Solid::Placed { primitive, scene_from_local, tag } => {
                let (leaf, bounds) = Leaf::new(primitive, scene_from_local, *tag, passes.has(Pass::SceneShapes));
                let extent = Extent::of_primitive(primitive, scene_from_local, bounds);
                return Self { extent, upper: None, kind: OutlineKind::Leaf(Box::new(leaf)) };
            }
            Solid::Union(solids) => (Operation::Union, solids),
            Solid::Intersection(solids) => (Operation::Intersection, solids),
            Solid::Difference(solids) => (Operation::Difference, solids),
        };
        let operands: Vec<_> = solids.iter().map(|solid| Self::new(solid, passes)).collect();
        let upper_of = |operand: &Self| operand.upper.as_ref().unwrap_or(&operand.extent).clone();
        let has_upper = operation == Operation::Difference || operands.iter().any(|operand| operand.upper.is_some());
        let mut upper = has_upper.then(|| Self::extent_of(operation, operands.iter().map(upper_of)));
        let mut extent = Self::extent_of(operation, operands.iter().map(|operand| operand.extent.clone()));
        if operation == Operation::Difference {
            solids.iter().skip(1).for_each(|solid| extent.add_outside(solid));
        }
        if passes.has(Pass::FoundBounds) {
            extent.close();
            upper.iter_mut().for_each(Extent::close);
        } else {
            extent = Extent::within(extent.bounds);
        }
        Self { extent, upper, kind: OutlineKind::Composition(operation, operands) }
    }

    /// The extent of a composition, of whose operands only the first is subtracted from.
    fn extent_of(operation: Operation, mut operands: impl Iterator<Item = Extent>) -> Extent {
        match operation {
            Operation::Union => Extent::within(operands.fold(Aabb::EMPTY, |all, operand| all.union(operand.bounds))),
            Operation::Difference => operands.next().unwrap_or(Extent::ALL),
            Operation::Intersection => operands.fold(Extent::ALL, |mut all, operand| {
                all.add(&operand);
                all
            }),
        }
    }
}
