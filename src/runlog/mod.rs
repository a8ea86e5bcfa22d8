//! The run log: the settings of a run, its records, its file, and the metrics that are computed from them.

#[cfg(test)]
pub(crate) mod examples;
mod file;
mod file_error;
mod header;
mod link_settings;
mod log;
mod messages;
mod metadata;
mod metrics;
mod results_in_flight;
mod validate;

pub use file::is_run_file;
pub use file_error::{LineError, LogError};
pub use header::{Driver, Header};
pub use link_settings::{LinkSettings, OwnLink};
pub use log::RunLog;
pub use messages::MessageCounts;
pub use metadata::{Metadata, text_lines};
pub use metrics::Metrics;
pub use results_in_flight::ResultsInFlight;
pub use validate::{InvalidHeader, InvalidRecord};
