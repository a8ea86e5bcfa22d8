//! Pages that replace the main page: accuracy, comparison, scenes, lessons, keys.

pub mod accuracy;
pub mod compare;
pub mod gallery;
pub mod help;
pub mod learn;
