//! Drawings as data: marks, inks, polylines.

pub mod display_list;
pub mod polyline;
