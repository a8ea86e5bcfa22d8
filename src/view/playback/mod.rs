//! The shown time of a run, and what is known at it.

pub mod clock;
pub mod compared_run;
pub mod details;
pub mod run_view;
pub mod snapshots;
