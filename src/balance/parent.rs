//! The parent.

/// STUB.
#[derive(Debug)]
pub struct Parent;
