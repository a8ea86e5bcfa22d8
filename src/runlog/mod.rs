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
pub use header::{Driver, Header, LinkSettings};
pub use log::RunLog;
pub use messages::MessageCounts;
pub use metadata::Metadata;
pub use metrics::Metrics;
