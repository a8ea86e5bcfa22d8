//! The model of machines and links, and a discrete event simulator: whole runs in virtual time, with the same protocol
//! and the same records as on threads, but without threads and clocks. So the same run gives the same records, byte for
//! byte.

mod event_queue;
mod failures;
mod faults;
mod link;
mod machine;
mod measured_error;
mod sim_node;
mod simulation;
mod trial;

pub use faults::Faults;
pub use link::{Link, Wire};
pub use machine::Machine;
pub use measured_error::MeasuredError;
pub use simulation::Sim;
pub use trial::{Change, PixelCosts, Trial};
