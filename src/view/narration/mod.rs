//! A run in sentences: its events, its failures, and its status.

pub mod event_sentences;
pub mod events;
pub mod failure;
pub mod failure_sentences;
pub mod happening;
pub mod narrator;
pub mod record_sentences;
pub mod share;
pub mod status;
mod transfer_sentences;
pub mod unreached;
