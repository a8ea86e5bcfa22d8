//! Constructive solid geometry (the article, §2): primitives, the tree of boolean operations, and the spans of
//! a ray inside it. A hit carries the number of a surface; this module knows no material and no light.

mod build;
mod coincidence;
mod compiled;
mod merge;
mod primitive;
mod quadratic;
mod reduction;
mod shape;
mod solid;
mod span;
mod torus;

pub use compiled::{Dropped, Hit, Stack, Start, Tree, rank};
pub use merge::Event;
pub use primitive::{Primitive, QuadricCoefficients};
pub use reduction::{Reduction, Reductions};
pub use shape::{Leaf, Surface};
pub use solid::Solid;
