//! Indices into the compiled tree: a type for each kind, so that one cannot be taken for another.

use serde::Serialize;

/// A solid of the compiled tree. Roots are ordered as their solids are in the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct RootId(pub(crate) u32);

/// The caller's number for a primitive's surface: in a scene, the index of its material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MaterialTag(pub u32);

/// A leaf of the compiled tree. Leaves are ordered as their primitives are in the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct LeafIndex(pub(super) u32);

/// A node of the compiled tree: a leaf, an intersection of convex leaves, or a composition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct NodeIndex(pub u32);

impl LeafIndex {
    /// The leaf of the `number`-th primitive, from 0.
    pub(crate) fn of(number: u32) -> Self {
        Self(number)
    }
}

impl MaterialTag {
    /// The tag as an index.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl LeafIndex {
    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

impl NodeIndex {
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl RootId {
    /// The node at which the solid begins.
    pub(super) fn node(self) -> NodeIndex {
        NodeIndex(self.0)
    }
}
