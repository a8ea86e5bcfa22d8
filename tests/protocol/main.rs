//! The protocol: its rules one by one, and whole runs in virtual time and on threads.

#[path = "../common/virtual_time.rs"]
mod virtual_time;
#[path = "../common/watched.rs"]
mod watched;

mod adaptive_rules;
mod failing_workers;
mod farm_leases_rules;
mod links;
mod protocol_rules;
mod random_runs;
mod retrace;
mod same_image;
mod strategy_rules;
mod work_stealing;
