//! Constructive solid geometry (the article, §2): primitives, the tree of boolean operations, and a ray's spans in it.
//! A hit carries the tag of a surface; this module knows no materials and no lights.

mod boundary;
mod bounds;
mod build;
mod coincidence;
mod id;
mod merge;
mod outline;
mod parts;
mod passes;
mod primitive;
mod quadratic;
mod shape;
mod solid;
mod span;
mod span_diagram;
mod torus;
mod traverse;
mod tree;

pub use boundary::{Hit, Rank, RayStart};
pub use id::{LeafIndex, MaterialTag, RootId};
pub use merge::{Crossing, Operation};
pub use passes::{Pass, Passes};
pub use primitive::{Primitive, QuadricCoefficients};
pub use shape::{Leaf, Surface};
pub use solid::Solid;
pub use span_diagram::{SolidKind, SpanDiagram};
pub use traverse::Stack;
pub use tree::{DroppedCounts, Tree};
