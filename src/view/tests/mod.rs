//! Tests of several views together, and sample runs for all tests of views.

mod faults;
mod portuguese;
mod random_words;
pub mod sample_runs;
