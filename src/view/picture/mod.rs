//! The picture as the window shows it: pixels and what is laid over them.

pub mod canvas;
pub mod false_colour;
pub mod outlines;
pub mod overlay;
