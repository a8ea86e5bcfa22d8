//! The tree of boolean operations as the scene states it.

use glam::{DAffine3, DVec3};

use super::{MaterialTag, Primitive};

/// A solid: a placed primitive, or a composition of solids.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// A primitive with its transform.
    Placed {
        /// The primitive in its own coordinates.
        primitive: Primitive,
        /// Transforms the primitive's coordinates to the scene's; invertible.
        scene_from_local: DAffine3,
        /// The caller's tag for its surface: in a scene, its material.
        tag: MaterialTag,
    },
    /// The points in at least one operand.
    Union(Vec<Solid>),
    /// The points in all operands; no points if there are no operands.
    Intersection(Vec<Solid>),
    /// The points in the first operand and in none of the others.
    Difference(Vec<Solid>),
}

impl Solid {
    /// Whether `point` lies in the solid. On its boundary either answer is possible.
    pub fn contains(&self, point: DVec3) -> bool {
        match self {
            Self::Placed { primitive, scene_from_local, .. } => {
                primitive.contains(scene_from_local.inverse().transform_point3(point))
            }
            Self::Union(solids) => solids.iter().any(|solid| solid.contains(point)),
            Self::Intersection(solids) => !solids.is_empty() && solids.iter().all(|solid| solid.contains(point)),
            Self::Difference(solids) => match solids.split_first() {
                Some((first, others)) => first.contains(point) && !others.iter().any(|solid| solid.contains(point)),
                None => false,
            },
        }
    }
}
