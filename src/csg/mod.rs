//! Constructive solid geometry (the article, §2): primitives, the tree of boolean operations, and the spans of
//! a ray inside it. A hit carries the number of a surface; this module knows no material and no light.

mod build;
mod coincidence;
mod merge;
mod passes;
mod primitive;
mod quadratic;
mod shape;
mod solid;
mod span;
mod span_diagram;
mod torus;
mod tree;

pub use merge::{Event, Operation};
pub use passes::{Reduction, Reductions};
pub use primitive::{Primitive, QuadricCoefficients};
pub use shape::{Leaf, Surface};
pub use solid::Solid;
pub use span_diagram::{Figure, What};
pub use tree::{Dropped, Hit, Stack, Start, Tree, rank};
