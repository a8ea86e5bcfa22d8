//! A solid before it is compiled: its leaves, and what is known of where each of its compositions lies.

use super::bounds::Extent;
use super::merge::Operation;
use super::{Leaf, Pass, Passes, Solid};
use crate::geometry::Aabb;

/// A solid with the extent of each of its parts, each by itself.
pub(super) struct Outline {
    pub extent: Extent,
    pub kind: OutlineKind,
}

pub(super) enum OutlineKind {
    Leaf(Leaf),
    Composition(Operation, Vec<Outline>),
}

impl Outline {
    pub fn new(solid: &Solid, passes: Passes) -> Self {
        let (operation, solids) = match solid {
            Solid::Placed { primitive, scene_from_local, tag } => {
                let (leaf, bounds) = Leaf::new(primitive, scene_from_local, *tag, passes.has(Pass::SceneShapes));
                let extent = Extent::of_primitive(primitive, scene_from_local, bounds);
                return Self { extent, kind: OutlineKind::Leaf(leaf) };
            }
            Solid::Union(solids) => (Operation::Union, solids),
            Solid::Intersection(solids) => (Operation::Intersection, solids),
            Solid::Difference(solids) => (Operation::Difference, solids),
        };
        let operands: Vec<_> = solids.iter().map(|solid| Self::new(solid, passes)).collect();
        let mut extent = match operation {
            Operation::Union => {
                let boxes = operands.iter().map(|operand| operand.extent.bounds);
                Extent::within(boxes.fold(Aabb::EMPTY, Aabb::union))
            }
            Operation::Intersection => {
                let mut all = Extent::ALL;
                operands.iter().for_each(|operand| all.add(&operand.extent));
                all
            }
            Operation::Difference => {
                let mut all = operands.first().map_or(Extent::ALL, |first| first.extent.clone());
                solids.iter().skip(1).for_each(|solid| all.add_outside(solid));
                all
            }
        };
        if passes.has(Pass::FoundBounds) {
            extent.close();
        } else {
            extent = Extent::within(extent.bounds);
        }
        Self { extent, kind: OutlineKind::Composition(operation, operands) }
    }
}
