//! The parts of the main page, in the order of their imports: `timeline` uses `nodes`.

pub mod inspector;
pub mod narration;
pub mod nodes;
pub mod notice;
pub mod picture;
mod picture_captions;
pub mod ring;
pub mod save_sheet;
pub mod setup;
pub mod time;
pub mod timeline;
pub mod top_bar;
