//! Tests of several views together, and sample runs for all tests of views.

mod portuguese;
pub mod sample_runs;
