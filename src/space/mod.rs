//! The way of sharing that the article weighs and rejects (§5): the scene's space is divided, not the picture.
//!
//! An octree over the scene is dealt to owners; each intersects rays only with what lies in its cells, and sends a ray
//! that leaves them to the next owner. Nothing here renders so. It is *counted*, on the rays of a usual render, how
//! often they would change hands: that is what a network would have to carry.
//!
//! Where there is a choice the count is kind to this way of sharing, so that it is a lower bound: everybody knows which
//! cells are empty, and sends no ray there; solids without bounds are copied to every owner; how much work each cell
//! brings is known beforehand; and a primary ray is made by the first owner that it meets.

mod octree;
mod owners;
mod traffic;

pub use octree::{LeafCell, Octree};
pub use owners::{Partition, assign_owners};
pub use traffic::{ANSWER_BYTES, RAY_BYTES, Traffic, traffic};
