//! The tree of boolean operations, as a scene gives it.

use glam::{DAffine3, DVec3};

use super::{MaterialTag, Primitive};

/// A solid: a placed primitive, or a composition of solids.
#[derive(Clone, Debug, PartialEq)]
pub enum Solid {
    /// A primitive at its place.
    Placed {
        /// What it is, in its own coordinates.
        primitive: Primitive,
        /// Puts it into the scene; invertible.
        scene_from_local: DAffine3,
        /// The caller's number for its surface (which material it has).
        tag: MaterialTag,
    },
    /// What is in at least one of them.
    Union(Vec<Solid>),
    /// What is in all of them; nothing, if there are none.
    Intersection(Vec<Solid>),
    /// What is in the first and in none of the others.
    Difference(Vec<Solid>),
}

impl Solid {
    /// Whether `point` is in the solid; for points on its boundary the answer may be either.
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
