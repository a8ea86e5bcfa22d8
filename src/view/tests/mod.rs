//! Tests of the views together, and the runs that all tests of views share.

mod portuguese;
pub mod sample_runs;
