//! A run as it is kept: what it was asked to do, what happened, and what that amounts to.

#[cfg(test)]
pub(crate) mod examples;
mod file;
mod header;
mod log;
mod messages;
mod metadata;
mod metrics;
mod validate;

pub use file::{LogError, is_run_file};
pub use header::{Driver, Header, Link};
pub use log::RunLog;
pub use messages::Messages;
pub use metadata::Caption;
pub use metrics::Tally;
