//! Division of the scene's space instead of the picture, which the article considers and rejects (§5).
//!
//! An octree over the scene is divided among owners. Each owner intersects rays with the primitives in its own cells
//! only, and sends a ray that leaves them to the next owner. Nothing is rendered in this way. For the rays of a normal
//! render the program *counts* how often they would change owners: these are the messages that a network would have to
//! carry.
//!
//! Where there is a choice, the count favours this division, so that it is a lower bound: every owner knows which cells
//! are empty, and sends no ray there; unbounded solids are copied to every owner; the work of each cell is known in
//! advance; and a primary ray is made by the first owner that it meets.

mod octree;
mod owners;
mod traffic;

pub use octree::{LeafCell, Octree};
pub use owners::{Partition, assign_owners};
pub use traffic::{ANSWER_BYTES, RAY_BYTES, Traffic, traffic};
