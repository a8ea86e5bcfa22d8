//! A run as it is kept: what it was asked to do, what happened, and what that amounts to.

mod header;

pub use header::{Header, Link};
