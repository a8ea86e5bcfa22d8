//! A run as it is kept: what it was asked to do, what happened, and what that amounts to.

mod caption;
mod check;
#[cfg(test)]
pub(crate) mod examples;
mod file;
mod header;
mod log;
mod messages;
mod tally;

pub use caption::Caption;
pub use file::{LogError, is_run_file};
pub use header::{Driver, Header, Link};
pub use log::RunLog;
pub use messages::Messages;
pub use tally::Tally;
