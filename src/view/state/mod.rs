//! Folds a run's records into its state at one time: machines, atoms, messages, lanes.

pub mod activity;
pub mod atom_state;
pub mod flight;
pub mod flights;
pub mod lane;
pub mod lanes;
pub mod node_rows;
pub mod node_state;
pub mod run_state;
pub mod throughput;
