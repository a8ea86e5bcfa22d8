//! Machines and links as they are emulated, and whole runs in virtual time: the same protocol, the same records, no
//! thread and no clock, so that the same run gives the same records to the byte.

mod event_queue;
mod failures;
mod faults;
mod link;
mod machine;
mod sim_node;
mod simulation;
mod trial;

pub use faults::Faults;
pub use link::{Link, Wire};
pub use machine::Machine;
pub use simulation::Sim;
pub use trial::{Change, PixelCosts, Trial};
