//! Pages that take the place of the run: accuracy, comparison, lessons, scenes, keys.

pub mod accuracy;
pub mod compare;
pub mod gallery;
pub mod help;
pub mod learn;
