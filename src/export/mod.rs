//! What leaves the program: a scene for another renderer, a drawing for paper and slides.

mod pov;
mod svg;

pub use pov::to_pov;
pub use svg::to_svg;
