//! Files that the program reads, refuses and writes.

#[path = "../common/virtual_time.rs"]
mod virtual_time;

mod bad_input;
mod chrome_trace;
mod exports;
mod fuzz;
mod names;
mod old_runs;
mod pictures;
