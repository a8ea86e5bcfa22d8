//! What leaves the program: a scene for another renderer.

mod pov;

pub use pov::to_pov;
