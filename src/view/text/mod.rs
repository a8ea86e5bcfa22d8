//! Numbers and names in words, and texts that several views share.

pub mod format;
pub mod glossary;
pub mod media;
pub mod quality;
pub mod remedies;
pub mod scene_stats;
pub mod scheduler_names;
pub mod tooltips;
pub mod trial_names;
