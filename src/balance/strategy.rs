//! The strategies, as arms of one enum.

use serde::{Deserialize, Serialize};

/// How the atoms are shared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Strategy {
    /// One node traces all.
    Serial,
    /// The article's ring.
    Ring,
}

/// STUB.
#[derive(Debug)]
pub struct Node;
