//! The picture as the window shows it: pixels, and layers of colour on them.

pub mod bands_cost;
pub mod canvas;
pub mod false_colour;
pub mod outlines;
pub mod overlay;
