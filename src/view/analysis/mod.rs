//! What a run amounts to, and why two runs differ.

pub mod compare_runs;
pub mod disturbance;
pub mod summary;
pub mod time_budget;
