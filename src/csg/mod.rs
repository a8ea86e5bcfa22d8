//! Boolean spans.
