//! The shown time of a run, and its state at that time.

pub mod clock;
pub mod compared_run;
pub mod details;
pub mod run_view;
pub mod snapshots;
