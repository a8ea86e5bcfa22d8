//! The window.

use std::path::PathBuf;
use std::sync::Arc;

use crate::runlog::Header;
use crate::scene::Opened;
use crate::tracer::Tracer;

/// STUB.
pub struct Launch {
    /// The scene.
    pub scene: Opened,
    /// The log.
    pub log: Option<PathBuf>,
}

/// STUB.
pub fn open(_launch: Launch) -> Result<(), String> {
    Err("stub".into())
}

/// STUB.
pub fn demonstration(_scene: &Opened) -> (Arc<Tracer>, Header) {
    todo!()
}
